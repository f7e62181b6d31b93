// SPDX-License-Identifier: LGPL-2.1-or-later
#include "condensed_solver.h"

#include "failures.h"
#include "kept_parts.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Springs that are stiffer than the body by more than this are beyond
     * multigrid alone; those above the second number are then filtered, and
     * soft in the multigrid method. */
    constexpr double stiff = 20.;
    constexpr double filtered = 5.;

    /** Make the blocks of springs of @p soft those of its diagonal. */
    void soften_blocks(const Condensate &stiff, Condensate &soft)
    {
      const RowBlocks &blocks = soft.blocks;
      for (int block = 0; !blocks.empty() && block < blocks.n_blocks(); ++block)
        for (int r = 0, k = blocks.size(block); r < k; ++r)
          for (int c = 0; c < k; ++c)
          {
            const int i = blocks.first[block] + r, j = blocks.first[block] + c;
            const double wanted = soft.stiffness[i] * soft.stiffness[j];
            if (wanted > 0.)
              soft.spring[blocks.at[block] + r * k + c] *=
                  std::sqrt(wanted / (stiff.stiffness[i] * stiff.stiffness[j]));
          }
    }

    /** Whether the blocks of the point with row @p i first differ: a slip that
     * turns changes neither pivots nor diagonals. */
    bool differ_in_block(const Condensate &a, const Condensate &b, const int i)
    {
      if (a.blocks.empty() || b.blocks.empty())
        return a.blocks.empty() != b.blocks.empty();
      const std::vector<int> &first = a.blocks.first;
      const auto block = std::lower_bound(first.begin(), first.end(), i);
      if (block == first.end() || *block != i)
        return false;
      const auto at = a.blocks.at[block - first.begin()];
      const auto end = a.blocks.at[block - first.begin() + 1];
      const auto differ =
          [&](const std::vector<double> &x, const std::vector<double> &y)
      { return !std::equal(x.begin() + at, x.begin() + end, y.begin() + at); };
      return differ(a.spring, b.spring) || differ(a.trial, b.trial)
             || differ(a.test, b.test);
    }

    /** Ends an iteration with factors of another matrix where it would take
     * longer than to factorise: that costs as much as this many iterations. */
    class NearControl : public dealii::SolverControl
    {
    public:
      explicit NearControl(const double tolerance)
          : dealii::SolverControl(most, tolerance, false, false)
      {
      }

      State check(const unsigned int step, const double value) override
      {
        if (step == 0)
          first_ = value;
        const State state = dealii::SolverControl::check(step, value);
        // Digits that are due by now, but for a few.
        constexpr double slack = 100.;
        const double due =
            slack * first_
            * std::pow(tolerance() / first_, step / double(most));
        return state == iterate && step > 0 && value > due ? failure : state;
      }

    private:
      static constexpr unsigned int most = 10;
      double first_ = 0.;
    };

    /** Unknowns of all and of this rank. */
    std::pair<dealii::types::global_dof_index, std::size_t>
    system_size(const la::Matrix &matrix)
    {
      return {matrix.m(), matrix.local_size()};
    }
  } // namespace

  CondensedSolver::CondensedSolver(const SolverParameters &parameters,
                                   const PreconditionerKeeper &keeper)
      : parameters_(parameters), choice_(parameters), keeper_(keeper)
  {
  }

  CondensedSolver::~CondensedSolver()
  {
    if (assembled_ != nullptr && space_.reuses_factors
        && space_.kept->step == step_)
      space_.kept->condensed = std::move(assembled_);
    if (geometric_ == nullptr)
      return;
    space_.kept->geometric = std::move(geometric_);
    space_.kept->geometric_of = geometric_of_;
  }

  void CondensedSolver::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
    step_ = space.kept->step;
    assembled_.reset();
    geometric_.reset();
  }

  void CondensedSolver::reinit(const Stiffness &stiffness,
                               const PointOperator &rows,
                               const std::vector<double> &row_stiffness)
  {
    set_stiffness(stiffness, rows, row_stiffness);
    keeper_.forget();
    filter_.reset();
    multigrid_.reset();
  }

  void CondensedSolver::renew(const Stiffness &stiffness,
                              const PointOperator &rows,
                              const std::vector<double> &row_stiffness)
  {
    // The last one may be gone.
    stiffness_ = &stiffness.matrix();
    // Multigrid looks at the matrix that it was built on, which must be an own
    // copy to last.
    if (!keeper_.is_built() || is_direct()
        || (!is_assembled_ && geometric_ == nullptr)
        || built_.pivot.size() != static_cast<std::size_t>(rows.n_rows()))
      reinit(stiffness, rows, row_stiffness);
    else
      set_stiffness(stiffness, rows, row_stiffness);
  }

  void CondensedSolver::set_stiffness(const Stiffness &stiffness,
                                      const PointOperator &rows,
                                      const std::vector<double> &row_stiffness)
  {
    CondensateSolver::set_stiffness(stiffness, rows);
    stiffness_ = &stiffness.matrix();
    values_ = stiffness.values();
    row_stiffness_ = row_stiffness;
    choice_.choose(*stiffness_, space_, is_symmetric_);
  }

  bool CondensedSolver::is_direct() const
  {
    return choice_.is_direct();
  }

  bool CondensedSolver::is_outdated() const
  {
    if (keeper_.must_build())
      return true;
    const Condensate &now = matrix_.condensate();
    double n_changed = 0., n_in_contact = 0.;
    bool is_freed = false;
    for (int i = 0; i < rows_->n_rows(); ++i)
    {
      is_freed = is_freed
                 || (built_.pivot[i] != Condensate::none
                     && now.pivot[i] != built_.pivot[i]);
      const double unit = rows_->weight(i) * row_stiffness_[i];
      const double ratio =
          (unit + now.stiffness[i]) / (unit + built_.stiffness[i]);
      const bool changed =
          now.pivot[i] != built_.pivot[i]
          || PreconditionerKeeper::is_change(ratio, is_direct())
          || (is_direct() && differ_in_block(now, built_, i));
      const bool any = now.pivot[i] != Condensate::none
                       || built_.pivot[i] != Condensate::none
                       || now.stiffness[i] > 0. || built_.stiffness[i] > 0.;
      n_changed += changed;
      // Each row of a point with friction may change, but it is one contact.
      n_in_contact += any && (is_direct() || !rows_->is_tangent(i));
    }
    // A cycle that holds an unknown never moves it.
    if (choice_.is_geometric()
        && MPI::logical_or(is_freed, rows_->communicator()))
      return true;
    return PreconditionerKeeper::are_too_many(
        n_changed, n_in_contact, is_direct(), rows_->communicator());
  }

  Condensate CondensedSolver::without_friction_forces() const
  {
    // Springs of slipping points grow beyond all bounds at the border to stick.
    constexpr double stiffest = 100.;
    Condensate result = matrix_.condensate();
    result.test = result.trial;
    const RowBlocks &blocks = result.blocks;
    for (int block = 0; block < blocks.n_blocks(); ++block)
    {
      const int k = blocks.size(block), first = blocks.first[block];
      double *const spring = &result.spring[blocks.at[block]];
      double scale[ABUT_CONDENSE_COMPONENTS];
      for (int r = 0; r < k; ++r)
      {
        const double limit =
            stiffest * rows_->weight(first + r) * row_stiffness_[first + r];
        double &diagonal = spring[r * k + r];
        diagonal = std::max(diagonal, 0.);
        scale[r] = rows_->is_tangent(first + r) && diagonal > limit
                       ? std::sqrt(limit / diagonal)
                       : 1.;
      }
      // The force along the surface due to the pressure of a spring is no
      // stiffness, see subtract_friction().
      for (int r = 1; r < k; ++r)
        spring[r * k] = spring[r] = 0.;
      for (int r = 0; r < k; ++r)
        for (int c = 0; c <= r; ++c)
        {
          const double mean = 0.5 * (spring[r * k + c] + spring[c * k + r]);
          spring[r * k + c] = spring[c * k + r] = mean * scale[r] * scale[c];
        }
      for (int r = 0; r < k; ++r)
        result.stiffness[first + r] = spring[r * k + r];
    }
    return result;
  }

  std::vector<std::uint8_t> CondensedSolver::held_by_pivots() const
  {
    std::vector<std::uint8_t> held(diagonal_.size(), 0);
    for (const std::int64_t pivot : built_.pivot)
      if (pivot != Condensate::none)
        held[rows_->column(pivot)] = 1;
    return held;
  }

  std::unique_ptr<Multigrid>
  CondensedSolver::make_cycle(const la::Matrix &system) const
  {
    if (!choice_.is_geometric())
      return make_multigrid(system, parameters_, space_, matrix_.has_blocks());
    auto result = std::make_unique<GeometricMultigrid>(system, *space_.meshes);
    result->set_constrained(held_by_pivots(), {});
    return result;
  }

  bool CondensedSolver::has_stiff_springs() const
  {
    double stiffest = 0.;
    for (int i = 0; i < rows_->n_rows(); ++i)
      stiffest =
          std::max(stiffest, built_.stiffness[i]
                                 / (rows_->weight(i) * row_stiffness_[i]));
    return MPI::max(stiffest, rows_->communicator()) > stiff;
  }

  void CondensedSolver::build_geometric()
  {
    CondensedMatrix condensed;
    condensed.reinit(*stiffness_, *rows_);
    condensed.set(built_);
    LocalMatrix terms;
    condensed.for_each_term(
        [&](const auto row, const auto &columns, const auto &values)
        { terms.add(row, columns, values); });
    const MPI_Comm communicator = rows_->communicator();
    std::vector<dealii::types::global_dof_index> touched;
    if (MPI::n_mpi_processes(communicator) > 1)
      touched = terms.unknowns();
    if (geometric_ == nullptr)
    {
      geometric_ = std::move(space_.kept->geometric);
      geometric_of_ = space_.kept->geometric_of;
    }
    if (MPI::logical_or(geometric_ == nullptr
                            || !geometric_->knows(*stiffness_, touched),
                        communicator))
    {
      // More of them for the sets that will come.
      const std::vector<dealii::types::global_dof_index> ghosts =
          versions::indices(rows_->ghosts());
      touched.insert(touched.end(), ghosts.begin(), ghosts.end());
      geometric_.reset();
      geometric_ = std::make_unique<GeometricMultigrid>(
          *stiffness_, *space_.meshes, touched);
    }
    else if (geometric_of_ != values_)
      geometric_->renew_matrix(*stiffness_);
    geometric_of_ = values_;
    geometric_->set_terms(terms);
    geometric_->set_constrained(held_by_pivots(), {});
  }

  void CondensedSolver::build()
  {
    filter_.reset();
    multigrid_.reset();
    softened_.reset();
    const bool has_model =
        matrix_.has_blocks() && !is_direct() && !matrix_.is_plain();
    built_ = has_model ? without_friction_forces() : matrix_.condensate();
    keeper_.record_build();
    const bool is_filtered =
        !is_direct() && parameters_.contact_filter && has_stiff_springs();
    if (choice_.is_geometric() && !is_filtered)
    {
      is_assembled_ = false;
      assembled_.reset();
      build_geometric();
      return;
    }
    geometric_.reset();
    assemble(has_model);
    if (is_direct())
      assembled_->factorise();
    else if (is_filtered)
      build_filter();
    else
      multigrid_ = make_cycle(system());
  }

  void CondensedSolver::take_kept()
  {
    if (assembled_ == nullptr && space_.kept->step == step_)
      assembled_ = std::move(space_.kept->condensed);
  }

  void CondensedSolver::assemble(const bool has_model)
  {
    is_assembled_ = is_direct() || !matrix_.is_plain();
    if (!is_assembled_)
    {
      assembled_.reset();
      return;
    }
    take_kept();
    if (assembled_ == nullptr || !space_.reuses_factors)
      assembled_ = std::make_unique<FactorisedMatrix>();
    if (!has_model)
    {
      matrix_.assemble(assembled_->matrix);
      return;
    }
    CondensedMatrix symmetric;
    symmetric.reinit(*stiffness_, *rows_);
    symmetric.set(built_);
    symmetric.assemble(assembled_->matrix);
  }

  void CondensedSolver::build_filter()
  {
    const auto relative = [&](const int i)
    { return built_.stiffness[i] / (rows_->weight(i) * row_stiffness_[i]); };
    std::vector<std::uint8_t> wanted(rows_->n_rows());
    Condensate soft = built_;
    for (int i = 0; i < rows_->n_rows(); ++i)
      if (relative(i) > filtered)
      {
        wanted[i] = 1;
        soft.stiffness[i] = filtered * rows_->weight(i) * row_stiffness_[i];
      }
    soften_blocks(built_, soft);
    CondensedMatrix softened;
    softened.reinit(*stiffness_, *rows_);
    softened.set(soft);
    softened_ = std::make_unique<KeptMatrix>();
    softened.assemble(*softened_);
    multigrid_ = make_cycle(softened_->matrix());
    la::Vector count(rows_->owned(), rows_->communicator());
    rows_->add_counts(wanted.data(), count);
    matrix_.zero_pivots(count);
    std::vector<std::uint8_t> picked(la::n_owned(count));
    for (std::size_t i = 0; i < picked.size(); ++i)
      picked[i] = la::data(count)[i] > 0.;
    filter_ = std::make_unique<ContactFilter>(system(), *multigrid_, picked);
  }

  PreconditionerState CondensedSolver::state() const
  {
    // With friction it is built again.
    if (!built_.blocks.empty())
      return {};
    return {keeper_, built_.stiffness, built_.pivot, {}, {}};
  }

  void CondensedSolver::restore(const PreconditionerState &state)
  {
    if (!state.keeper.is_built())
      return;
    matrix_.set({state.stiffness, state.pivot});
    build();
    keeper_.restore(state.keeper);
  }

  LinearReport CondensedSolver::prepare(const Condensate &condensate)
  {
    LinearReport report;
    const dealii::Timer timer;
    matrix_.set(condensate);
    find_friction();
    keeper_.record_reuse();
    const bool is_old = is_outdated();
    has_old_factors_ = is_old && is_direct() && has_near_factors();
    if (is_old && !has_old_factors_)
    {
      build();
      report.n_setups = 1;
    }
    report.method = method();
    report.setup_seconds = timer.wall_time();
    return report;
  }

  std::string CondensedSolver::method() const
  {
    if (is_direct())
      return choice_.direct(DirectSolver::name(*stiffness_));
    return krylov_method() + ", " + preconditioner();
  }

  std::string CondensedSolver::preconditioner() const
  {
    return choice_.preconditioner() + (filter_ ? " with contact filter" : "");
  }

  void CondensedSolver::find_friction()
  {
    friction_.clear();
    const Condensate &now = matrix_.condensate();
    const RowBlocks &blocks = now.blocks;
    if (!matrix_.has_blocks() || is_direct())
      return;
    bool any = false;
    std::vector<double> part(rows_->n_rows(), 0.);
    for (int b = 0; b < blocks.n_blocks(); ++b)
    {
      const int i = blocks.first[b], k = blocks.size(b);
      const double *const spring = &now.spring[blocks.at[b]];
      const double resisting = spring[0] + rows_->weight(i) * row_stiffness_[i];
      for (int r = 1; r < k && spring[0] > 0.; ++r)
      {
        part[i + r] = spring[r * k] / resisting;
        any = any || part[i + r] != 0.;
      }
    }
    if (!MPI::logical_or(any, rows_->communicator()))
      return;
    la::Vector ones(rows_->owned(), rows_->communicator());
    ones = 1.;
    const std::vector<double> size = rows_->squares(ones);
    for (int b = 0; b < blocks.n_blocks(); ++b)
      for (int i = blocks.first[b], r = 1; r < blocks.size(b); ++r)
        part[i + r] = size[i] > 0. ? part[i + r] / size[i] : 0.;
    friction_ = std::move(part);
    // Ranks without rows take part, too.
    friction_.resize(std::max<std::size_t>(friction_.size(), 1), 0.);
  }

  void CondensedSolver::subtract_friction(la::Vector &force) const
  {
    const RowBlocks &blocks = matrix_.condensate().blocks;
    std::vector<double> normal(rows_->n_rows() + 1), factor(normal.size(), 0.);
    rows_->times(force, normal.data());
    for (int b = 0; b < blocks.n_blocks(); ++b)
      for (int i = blocks.first[b], r = 1; r < blocks.size(b); ++r)
        factor[i + r] = -friction_[i + r] * normal[i];
    rows_->add_transposed(factor.data(), force);
  }

  void CondensedSolver::precondition(la::Vector &dst,
                                     const la::Vector &src) const
  {
    if (!friction_.empty())
    {
      la::Vector force(src);
      subtract_friction(force);
      cycle(dst, force);
    }
    else
      cycle(dst, src);
  }

  void CondensedSolver::cycle(la::Vector &dst, const la::Vector &src) const
  {
    if (is_direct())
      assembled_->factors().solve(dst, src);
    else if (filter_)
      filter_->vmult(dst, src);
    else if (geometric_)
      geometric_->vmult(dst, src);
    else
      multigrid_->vmult(dst, src);
    // A kept preconditioner may act on unknowns that are pivots now.
    matrix_.zero_pivots(dst);
  }

  bool CondensedSolver::refresh()
  {
    if (!keeper_.is_kept())
      return false;
    build();
    return true;
  }

  bool CondensedSolver::iterate(const la::Vector &rhs,
                                const unsigned int max_iterations,
                                const double digits, const double tolerance,
                                la::Vector &x, LinearReport &report)
  {
    dealii::SolverControl control(max_iterations, tolerance, false, false);
    bool converged = true;
    try
    {
      CondensateSolver::iterate(rhs, control, x, report);
    }
    catch (const dealii::SolverControl::NoConvergence &failure)
    {
      converged = false;
      if (!keeper_.is_kept() && !choice_.may_give_up())
        throw_failure(krylov_method(), failure, tolerance);
    }
    report.n_matvecs += control.last_step() * (filter_ ? 2 : 0);
    if (converged)
      keeper_.record_speed(digits, control.last_step());
    return converged;
  }

  void CondensedSolver::solve_iteratively(const la::Vector &rhs,
                                          const double tolerance, la::Vector &x,
                                          LinearReport &report)
  {
    // A kept preconditioner may have become bad, and the coarser meshes may be
    // of no use: neither is worth waiting for.
    const double digits = std::log10(rhs.l2_norm() / tolerance);
    while (!is_direct())
    {
      const unsigned int patience =
          keeper_.is_kept() ? keeper_.patience() : choice_.patience(digits);
      if (iterate(rhs, std::min(parameters_.max_iterations, patience), digits,
                  tolerance, x, report))
        return;
      const dealii::Timer timer;
      if (!keeper_.is_kept())
        choice_.give_up(patience);
      build();
      report.method = method();
      ++report.n_setups;
      report.setup_seconds += timer.wall_time();
      x = 0.;
    }
    solve_directly(rhs, tolerance, x, report);
  }

  bool CondensedSolver::has_near_factors()
  {
    if (!space_.reuses_factors)
      return false;
    take_kept();
    return assembled_ != nullptr && assembled_->has_factors()
           && system_size(assembled_->matrix.matrix())
                  == system_size(*stiffness_);
  }

  bool CondensedSolver::iterate_with_near_factors(const la::Vector &rhs,
                                                  const double tolerance,
                                                  la::Vector &x,
                                                  LinearReport &report) const
  {
    // Newton's method shall take the same steps.
    constexpr double part = 1e-5, round_off = 1e-14;
    NearControl control(std::min(
        tolerance, std::max(part * tolerance, round_off * rhs.l2_norm())));
    LinearReport count;
    bool has_converged = true;
    try
    {
      CondensateSolver::iterate(rhs, control, x, count);
    }
    catch (const dealii::SolverControl::NoConvergence &)
    {
      has_converged = false;
    }
    report.n_matvecs += count.n_matvecs;
    return has_converged;
  }

  void CondensedSolver::solve_directly(const la::Vector &rhs,
                                       const double tolerance, la::Vector &x,
                                       LinearReport &report)
  {
    // Again with the residual: factors of stiff springs lose accuracy, those of
    // fields without stiffness, as pressures, more of it on several ranks.
    constexpr int most = 8;
    constexpr double slow = 0.5;
    if (has_old_factors_)
    {
      if (iterate_with_near_factors(rhs, tolerance, x, report))
        return;
      const dealii::Timer timer;
      x = 0.;
      build();
      has_old_factors_ = false;
      ++report.n_setups;
      report.setup_seconds += timer.wall_time();
    }
    la::Vector residual(rhs), correction(rhs);
    double before = INFINITY, after = rhs.l2_norm();
    for (int step = 0; step < most && after <= slow * before; ++step)
    {
      before = after;
      assembled_->factors().solve(correction, residual);
      matrix_.zero_pivots(correction);
      x.add(1., correction);
      matrix_.vmult(residual, x);
      ++report.n_matvecs;
      residual.sadd(-1., 1., rhs);
      after = residual.l2_norm();
      if (after <= tolerance)
        return;
    }
    check_direct_solution(rhs.l2_norm(), after);
  }

  LinearReport CondensedSolver::solve(const la::Vector &rhs,
                                      const double tolerance, la::Vector &x)
  {
    LinearReport report;
    const dealii::Timer timer;
    x = 0.;
    // With factors a solve to full accuracy costs no more.
    if (!(rhs.l2_norm() <= (is_direct() ? 0. : tolerance)))
    {
      if (is_direct())
        solve_directly(rhs, tolerance, x, report);
      else
        solve_iteratively(rhs, tolerance, x, report);
    }
    report.solve_seconds = timer.wall_time() - report.setup_seconds;
    return report;
  }
} // namespace abut::solve

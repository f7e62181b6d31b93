// SPDX-License-Identifier: LGPL-2.1-or-later
#include "saddle_point.h"

#include "failures.h"

#include <deal.II/base/timer.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include <algorithm>
#include <functional>

namespace abut::solve
{
  using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;
  namespace MPI = dealii::Utilities::MPI;

  struct SaddlePoint::System
  {
    std::vector<int> row; ///< number of each constraint's row
    /** Multiplies the second equation, so that its residual is a force; a
     * direct solver gets its pressures divided by it, too. */
    std::vector<double> scale;
    std::vector<double> right; ///< h
    std::vector<double> schur; ///< 3 w / ((1 + gamma) s)
    /** Terms condensed into the first equation: D, augmented for iterations. */
    Condensate leading;
    la::Vector force; ///< f
    dealii::types::global_dof_index n_constraints = 0;
    dealii::types::global_dof_index first_constraint = 0;
  };

  namespace
  {
    /** The diagonal Schur complement as a multiple of w / ((1 + gamma) s). With
     * 1 in place of it a fourth more iterations are needed. */
    constexpr double schur_factor = 3.;

    dealii::types::global_dof_index
    sum_of_lower_ranks(const dealii::types::global_dof_index mine,
                       const MPI_Comm communicator)
    {
      unsigned long long value = mine, sum = 0;
      MPI_Exscan(&value, &sum, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM,
                 communicator);
      return MPI::this_mpi_process(communicator) == 0 ? 0 : sum;
    }

    /** The augmented system with its second equation scaled. */
    template <typename System> class AugmentedOperator
    {
    public:
      AugmentedOperator(const CondensedMatrix &leading,
                        const PointOperator &rows,
                        const LocalElimination &local, const System &system)
          : leading_(leading),
            rows_(rows),
            local_(local),
            system_(system),
            gap_(rows.n_rows())
      {
      }

      void vmult(BlockVector &dst, const BlockVector &src) const
      {
        leading_.vmult(dst.block(0), src.block(0));
        rows_.times(src.block(0), gap_.data());
        local_.project(gap_);
        double *out = la::data(dst.block(1));
        for (std::size_t k = 0; k < system_.row.size(); ++k)
          out[k] = -system_.scale[k] * rows_.weight(system_.row[k])
                   * gap_[system_.row[k]];
        const double *p = la::data(src.block(1));
        std::fill(gap_.begin(), gap_.end(), 0.);
        for (std::size_t k = 0; k < system_.row.size(); ++k)
          gap_[system_.row[k]] = -rows_.weight(system_.row[k]) * p[k];
        local_.distribute(gap_);
        rows_.add_transposed(gap_.data(), dst.block(0));
      }

    private:
      const CondensedMatrix &leading_;
      const PointOperator &rows_;
      const LocalElimination &local_;
      const System &system_;
      mutable std::vector<double> gap_;
    };

    /** Upper block-triangular preconditioner. */
    template <typename System> class TriangularPreconditioner
    {
    public:
      TriangularPreconditioner(const CondensedSolver &leading,
                               const PointOperator &rows,
                               const LocalElimination &local,
                               const System &system, const la::Vector &model)
          : leading_(leading),
            rows_(rows),
            local_(local),
            system_(system),
            force_(model),
            factor_(rows.n_rows())
      {
      }

      void vmult(BlockVector &dst, const BlockVector &src) const
      {
        const double *gap = la::data(src.block(1));
        double *p = la::data(dst.block(1));
        std::fill(factor_.begin(), factor_.end(), 0.);
        for (std::size_t k = 0; k < system_.row.size(); ++k)
        {
          p[k] = -gap[k] / (system_.scale[k] * system_.schur[k]);
          factor_[system_.row[k]] = rows_.weight(system_.row[k]) * p[k];
        }
        local_.distribute(factor_);
        force_ = src.block(0);
        rows_.add_transposed(factor_.data(), force_);
        leading_.precondition(dst.block(0), force_);
      }

    private:
      const CondensedSolver &leading_;
      const PointOperator &rows_;
      const LocalElimination &local_;
      const System &system_;
      mutable la::Vector force_;
      mutable std::vector<double> factor_;
    };
  } // namespace

  SaddlePoint::SaddlePoint(const SolverParameters &parameters)
      : parameters_(parameters), leading_(parameters)
  {
  }

  void SaddlePoint::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
    leading_.set_near_null_space(space);
  }

  void SaddlePoint::reinit(const Stiffness &stiffness,
                           const PointOperator &rows,
                           const std::vector<double> &row_stiffness)
  {
    stiffness_ = &stiffness.matrix();
    rows_ = &rows;
    leading_.reinit(stiffness, rows, row_stiffness);
  }

  void SaddlePoint::renew(const Stiffness &stiffness, const PointOperator &rows,
                          const std::vector<double> &row_stiffness)
  {
    stiffness_ = &stiffness.matrix();
    rows_ = &rows;
    leading_.renew(stiffness, rows, row_stiffness);
  }

  std::vector<PreconditionerState> SaddlePoint::state() const
  {
    return {leading_.state()};
  }

  void SaddlePoint::restore(const std::vector<PreconditionerState> &state)
  {
    leading_.restore(state.at(0));
  }

  Condensate SaddlePoint::springs() const
  {
    Condensate result(local_.spring(), std::vector<std::int64_t>(
                                           rows_->n_rows(), Condensate::none));
    result.blocks = local_.blocks();
    result.spring = local_.spring_blocks();
    // No row determines an unknown.
    result.trial.assign(result.spring.size(), 0.);
    result.test = result.trial;
    return result;
  }

  SaddlePoint::System SaddlePoint::assemble(const la::Vector &residual,
                                            const abut_request &request) const
  {
    System system;
    system.leading = springs();
    std::vector<double> force(rows_->n_rows(), 0.);
    for (int i = 0; i < rows_->n_rows(); ++i)
      if (local_.is_held(i))
      {
        const double w = rows_->weight(i);
        const double s = leading_.row_stiffness()[i];
        force[i] = w * request.pressure[i];
        system.row.push_back(i);
        system.right.push_back(-w * local_.value()[i]);
        system.scale.push_back(s);
        system.schur.push_back(schur_factor * w
                               / ((1. + parameters_.augmentation) * s));
      }
    local_.distribute(force);
    for (int i = 0; i < rows_->n_rows(); ++i)
      force[i] += local_.force()[i];
    system.force = residual;
    system.force *= -1.;
    rows_->add_transposed(force.data(), system.force);

    const MPI_Comm communicator = stiffness_->get_mpi_communicator();
    system.n_constraints = system.row.size();
    system.first_constraint =
        sum_of_lower_ranks(system.n_constraints, communicator);
    system.n_constraints = MPI::sum(system.n_constraints, communicator);
    return system;
  }

  void SaddlePoint::augment(System &system, la::Vector &force) const
  {
    std::vector<double> factor(rows_->n_rows(), 0.);
    std::vector<double> push(rows_->n_rows(), 0.);
    for (const int i : system.row)
    {
      factor[i] = parameters_.augmentation * rows_->weight(i)
                  * leading_.row_stiffness()[i];
      push[i] = factor[i] * local_.value()[i];
    }
    local_.distribute(push);
    rows_->add_transposed(push.data(), force);

    Condensate &leading = system.leading;
    const RowBlocks &blocks = leading.blocks;
    for (int i = 0; blocks.empty() && i < rows_->n_rows(); ++i)
      leading.stiffness[i] += factor[i];
    for (int b = 0; !blocks.empty() && b < blocks.n_blocks(); ++b)
      for (int r = 0, k = blocks.size(b); r < k; ++r)
      {
        double *const spring = &leading.spring[blocks.at[b] + r * k];
        for (int h = 0; h < k; ++h)
          for (int c = 0; c < k; ++c)
            spring[c] += local_.test()[blocks.at[b] + h * k + r]
                         * factor[blocks.first[b] + h]
                         * local_.trial()[blocks.at[b] + h * k + c];
        leading.stiffness[blocks.first[b] + r] = spring[r];
      }
  }

  unsigned int SaddlePoint::solve_iteratively(const System &system,
                                              const la::Vector &force,
                                              const double tolerance,
                                              la::Vector &increment,
                                              std::vector<double> &multiplier)
  {
    dealii::IndexSet constraints(system.n_constraints);
    constraints.add_range(system.first_constraint,
                          system.first_constraint + system.row.size());
    const MPI_Comm communicator = stiffness_->get_mpi_communicator();
    BlockVector right({la::owned_rows(*stiffness_), constraints}, communicator);
    right.block(0) = force;
    for (std::size_t k = 0; k < system.row.size(); ++k)
      la::data(right.block(1))[k] = system.scale[k] * system.right[k];
    BlockVector solution(right);
    solution = 0.;

    const AugmentedOperator<System> matrix(leading_.matrix(), *rows_, local_,
                                           system);
    const TriangularPreconditioner<System> preconditioner(
        leading_, *rows_, local_, system, increment);
    unsigned int n_iterations = 0;
    const double attainable = std::max(tolerance, 1e-14 * right.l2_norm());
    bool again = right.l2_norm() > tolerance;
    while (again)
    {
      again = false;
      dealii::SolverControl control(parameters_.max_iterations, attainable,
                                    false, false);
      dealii::SolverFGMRES<BlockVector> fgmres(
          control, dealii::SolverFGMRES<BlockVector>::AdditionalData(60));
      try
      {
        fgmres.solve(matrix, solution, right, preconditioner);
      }
      catch (const dealii::SolverControl::NoConvergence &failure)
      {
        // A preconditioner of an earlier system may be to blame.
        again = leading_.refresh();
        if (!again)
          throw_failure("FGMRES on the saddle-point system", failure,
                        tolerance);
        solution = 0.;
      }
      n_iterations += control.last_step();
    }
    increment = solution.block(0);
    const double *p = la::data(solution.block(1));
    multiplier.assign(p, p + system.row.size());
    return n_iterations;
  }

  template <typename Function>
  void SaddlePoint::for_each_constraint(const System &system,
                                        const Function &function) const
  {
    auto line = stiffness_->m() + system.first_constraint;
    const RowBlocks &blocks = local_.blocks();
    for (std::size_t k = 0; blocks.empty() && k < system.row.size(); ++k)
      function(line++, system.row[k], 1., 1.);
    for (int b = 0; !blocks.empty() && b < blocks.n_blocks(); ++b)
      for (int h = 0, k = blocks.size(b); h < k; ++h)
      {
        if (!local_.is_held(blocks.first[b] + h))
          continue;
        for (int c = 0; c < k; ++c)
        {
          const auto number = blocks.at[b] + h * k + c;
          const double trial = local_.trial()[number];
          const double test = local_.test()[number];
          if (trial != 0. || test != 0.)
            function(line, blocks.first[b] + c, trial, test);
        }
        ++line;
      }
  }

  la::Matrix SaddlePoint::assemble_matrix(const System &system) const
  {
    const auto n = stiffness_->m();
    dealii::IndexSet owned(n + system.n_constraints);
    owned.add_indices(rows_->owned());
    owned.add_range(n + system.first_constraint,
                    n + system.first_constraint + system.row.size());

    dealii::IndexSet ghosts(owned.size());
    ghosts.add_indices(rows_->ghosts());
    CondensedMatrix leading;
    leading.reinit(*stiffness_, *rows_);
    leading.set(system.leading);
    KeptMatrix with_springs;
    if (!leading.is_plain())
      leading.assemble(with_springs);
    const la::Matrix &first =
        leading.is_plain() ? *stiffness_ : with_springs.matrix();
    const la::LocalRows stiffness = la::local_rows(first);

    std::vector<dealii::types::global_dof_index> columns;
    std::vector<double> values;
    const auto for_each_line = [&](const auto &visit)
    {
      for (int i = 0; i < stiffness.n_rows; ++i)
      {
        columns.clear();
        for (int e = stiffness.start[i]; e < stiffness.start[i + 1]; ++e)
          columns.push_back(la::global_column(first, stiffness.column[e]));
        values.assign(stiffness.value + stiffness.start[i],
                      stiffness.value + stiffness.start[i + 1]);
        visit(rows_->global_column(i), columns, values);
      }
      for_each_constraint(
          system,
          [&](const dealii::types::global_dof_index line, const int row,
              const double trial, const double test)
          {
            // As stiffnesses and forces, in whatever units: the residual of a
            // matrix with other numbers in its lines does not show whether it
            // is solved.
            const double scale =
                system.scale[line - n - system.first_constraint];
            for (auto e = rows_->begin(row); e < rows_->end(row); ++e)
            {
              const auto unknown = rows_->global_column(rows_->column(e));
              const double b =
                  scale * rows_->weight(row) * rows_->coefficient(e);
              visit(line, {unknown}, {-trial * b});
              visit(unknown, {line}, {-test * b});
            }
            visit(line, {line}, {0.});
          });
    };
    return la::assemble(owned, ghosts, rows_->communicator(), for_each_line);
  }

  std::string SaddlePoint::solve_directly(const System &system,
                                          const double smallest_residual,
                                          la::Vector &increment,
                                          std::vector<double> &multiplier) const
  {
    const la::Matrix matrix = assemble_matrix(system);
    const dealii::IndexSet owned = la::owned_rows(matrix);
    const MPI_Comm communicator = stiffness_->get_mpi_communicator();
    la::Vector right(owned, communicator), solution(owned, communicator);
    const int n_unknowns = la::n_owned(increment);
    std::transform(system.right.begin(), system.right.end(),
                   system.scale.begin(), la::data(right) + n_unknowns,
                   std::multiplies<>());
    std::copy_n(la::data(system.force), n_unknowns, la::data(right));

    const DirectSolver solver(matrix);
    solver.solve(solution, right);
    la::Vector rest(right), correction(right);
    const double before = right.l2_norm();
    double after = matrix.residual(rest, solution, right);
    if (after > 1e-12 * before)
    {
      // Once more: an indefinite matrix loses accuracy.
      solver.solve(correction, rest);
      solution += correction;
      after = matrix.residual(rest, solution, right);
    }
    if (after > smallest_residual)
      check_direct_solution(before, after);
    const double *values = la::data(solution);
    std::copy(values, values + n_unknowns, la::data(increment));
    multiplier.resize(system.row.size());
    std::transform(system.scale.begin(), system.scale.end(),
                   values + n_unknowns, multiplier.begin(),
                   std::multiplies<>());
    return DirectSolver::name(matrix);
  }

  void SaddlePoint::recover(const abut_request &request, const System &system,
                            const std::vector<double> &multiplier,
                            const la::Vector &increment) const
  {
    rows_->times(increment, request.gap_change);
    for (std::size_t k = 0; k < system.row.size(); ++k)
      request.pressure_change[system.row[k]] = multiplier[k];
    local_.recover(request);
  }

  LinearReport SaddlePoint::solve(const la::Vector &residual,
                                  const abut_request &request,
                                  const double smallest_residual,
                                  la::Vector &increment)
  {
    local_.reinit(request, rows_->n_rows(), rows_->weights(),
                  rows_->communicator());
    System system = assemble(residual, request);

    std::vector<double> multiplier;
    LinearReport report;
    const dealii::Timer timer;
    if (leading_.is_direct() && system.n_constraints > 0)
    {
      report.method =
          "saddle point, "
          + solve_directly(system, smallest_residual, increment, multiplier);
      report.n_setups = 1;
      report.setup_seconds = timer.wall_time();
      recover(request, system, multiplier, increment);
      return report;
    }
    la::Vector force(system.force);
    augment(system, force);
    report = leading_.prepare(system.leading);
    const double tolerance = std::max(
        request.linear_tolerance * leading_.load(force), smallest_residual);
    if (system.n_constraints > 0)
    {
      report.method = "saddle point, FGMRES, " + leading_.preconditioner();
      report.n_iterations =
          solve_iteratively(system, force, tolerance, increment, multiplier);
      report.n_matvecs = report.n_iterations;
      report.solve_seconds = timer.wall_time() - report.setup_seconds;
    }
    else
      report += leading_.solve(force, tolerance, increment);
    recover(request, system, multiplier, increment);
    return report;
  }
} // namespace abut::solve

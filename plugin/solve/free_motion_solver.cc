// SPDX-License-Identifier: LGPL-2.1-or-later
#include "free_motion_solver.h"

#include "pivot_choice.h"

#include <abut/dealii/coded.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Distance beyond a touch, as a part of the size and of the distance:
     * facets that are nearly parallel to the other side close together. */
    constexpr double beyond_size = 1e-6, beyond_distance = 1e-3;

    /** Distance beyond the point where a slip is reversed, as a part of the
     * size: above round-off of slips, below slips that matter. */
    constexpr double beyond_slip = 1e-11;

    constexpr double infinite = std::numeric_limits<double>::infinity();

    bool is_open(const PointOperator &rows, const abut_request &request,
                 const int i)
    {
      return !rows.is_tangent(i) && rows.bilateral()[i] == 0
             && request.state[i] == ABUT_STATE_OPEN;
    }
  } // namespace

  FreeMotionSolver::FreeMotionSolver(std::unique_ptr<RowSolver> inner)
      : inner_(std::move(inner))
  {
  }

  void FreeMotionSolver::set_near_null_space(const NearNullSpace &space)
  {
    space_ = space;
    inner_->set_near_null_space(space);
  }

  void FreeMotionSolver::set_bodies(const Stiffness &bodies)
  {
    bodies_ = bodies;
  }

  void FreeMotionSolver::reinit(const Stiffness &stiffness,
                                const PointOperator &rows,
                                const std::vector<double> &row_stiffness)
  {
    inner_->reinit(set_stiffness(stiffness, rows, row_stiffness), rows,
                   row_stiffness);
  }

  void FreeMotionSolver::renew(const Stiffness &stiffness,
                               const PointOperator &rows,
                               const std::vector<double> &row_stiffness)
  {
    inner_->renew(set_stiffness(stiffness, rows, row_stiffness), rows,
                  row_stiffness);
  }

  std::vector<PreconditionerState> FreeMotionSolver::state() const
  {
    return inner_->state();
  }

  void FreeMotionSolver::restore(const std::vector<PreconditionerState> &state)
  {
    inner_->restore(state);
  }

  const Stiffness &
  FreeMotionSolver::set_stiffness(const Stiffness &stiffness,
                                  const PointOperator &rows,
                                  const std::vector<double> &row_stiffness)
  {
    rows_ = &rows;
    row_stiffness_ = row_stiffness;
    unsupported_.reinit(bodies_ ? *bodies_ : stiffness, rows, space_);
    find_turning(stiffness);
    diagonal_ =
        unsupported_.empty() ? std::vector<double>() : stiffness.diagonal();
    uncoupled_ = unresisted(unsupported_.free_motions(
        rows, std::vector<std::uint8_t>(rows.n_rows(), 1)));
    fixed_.clear();
    if (uncoupled_.empty() || !stiffness.has_matrix())
      return stiffness;
    fix_uncoupled(stiffness);
    return stiffness_;
  }

  void FreeMotionSolver::fix_uncoupled(const Stiffness &stiffness)
  {
    const std::size_t n = uncoupled_.size();
    std::vector<la::Vector> motions;
    for (const Combination &combination : uncoupled_)
    {
      motions.push_back(stiffness.make_vector());
      unsupported_.add(combination, motions.back());
    }
    const std::vector<double> &diagonal = stiffness.diagonal();
    const auto pinned = choose_pivots_of_span(
        diagonal.size(), static_cast<unsigned int>(n),
        [&](const std::size_t i)
        {
          std::vector<double> values(n);
          for (std::size_t k = 0; k < n; ++k)
            values[k] = la::data(motions[k])[i];
          return values;
        },
        stiffness.communicator());
    la::copy(stiffness.matrix(), fixed_);
    const la::LocalRows matrix = la::local_rows(fixed_);
    for (const std::size_t i : pinned)
      for (int k = matrix.start[i]; k < matrix.start[i + 1]; ++k)
        if (matrix.column[k] == static_cast<int>(i))
          matrix.value[k] *= 2.;
    stiffness_ = Stiffness(fixed_);
  }

  void FreeMotionSolver::find_turning(const Stiffness &stiffness)
  {
    turning_.clear();
    if (!bodies_ || unsupported_.empty())
      return;
    const std::size_t n = unsupported_.size();
    std::vector<double> works;
    for (std::size_t j = 0; j < n; ++j)
    {
      Combination one(n, 0.);
      one[j] = 1.;
      la::Vector motion = stiffness.make_vector();
      la::Vector force(motion);
      unsupported_.add(one, motion);
      stiffness.vmult(force, motion);
      const std::vector<double> work = unsupported_.work(force);
      works.insert(works.end(), work.begin(), work.end());
    }
    turning_ = works;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        turning_[j * n + k] = 0.5 * (works[j * n + k] + works[k * n + j]);
  }

  FreeMotionSolver::Combinations
  FreeMotionSolver::unresisted(const Combinations &motions) const
  {
    constexpr double weak = 1e-3, round_off = 1e-13;
    double reference = 0., diagonal = 0.;
    for (const double value : turning_)
      reference += value * value;
    reference = std::sqrt(reference);
    for (const double value : diagonal_)
      diagonal += std::abs(value);
    diagonal = MPI::sum(diagonal, rows_->communicator());
    if (motions.empty() || reference <= round_off * diagonal)
      return motions;
    const unsigned int n = motions.size();
    dealii::LAPACKFullMatrix<double> matrix(n, n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < n; ++k)
      {
        double sum = 0.;
        const std::size_t all = unsupported_.size();
        for (std::size_t a = 0; a < all; ++a)
          for (std::size_t b = 0; b < all; ++b)
            sum += motions[j][a] * turning_[a * all + b] * motions[k][b];
        matrix(j, k) = sum;
      }
    dealii::Vector<double> values;
    dealii::FullMatrix<double> vectors;
    matrix.compute_eigenvalues_symmetric(-10. * n * reference, weak * reference,
                                         0., values, vectors);
    Combinations result;
    for (unsigned int k = 0; k < values.size(); ++k)
    {
      std::vector<double> coefficients;
      for (unsigned int j = 0; j < n; ++j)
        coefficients.push_back(vectors(j, k));
      result.push_back(combine(motions, coefficients));
    }
    return result;
  }

  double FreeMotionSolver::work_tolerance() const
  {
    // Strains at points that move have the round-off of positions, by facets.
    constexpr double round_off = 1e-15, facet = 1e-2;
    const bool has_positions = bodies_ && !space_.point.empty();
    double internal = 0.;
    for (std::size_t i = 0; i < diagonal_.size(); ++i)
    {
      double size = std::abs(la::data(moved_)[i]);
      if (iteration_.start != nullptr)
        size += std::abs(la::data(*iteration_.start)[i]);
      if (has_positions)
        size += facet * dealii::Tensor<1, 3>(space_.point[i]).norm();
      internal += std::abs(diagonal_[i]) * size;
    }
    return UnsupportedBodies::no_work * iteration_.load
           + round_off * MPI::sum(internal, rows_->communicator());
  }

  FreeMotionSolver::Combinations
  FreeMotionSolver::coupled(const Combinations &motions) const
  {
    if (uncoupled_.empty())
      return motions;
    // Gram and Schmidt: both are orthonormal, and one spans the other.
    constexpr double none = 1e-6;
    Combinations result, basis(uncoupled_);
    for (Combination motion : motions)
    {
      for (const Combination &other : basis)
      {
        const double along =
            std::inner_product(motion.begin(), motion.end(), other.begin(), 0.);
        for (std::size_t k = 0; k < motion.size(); ++k)
          motion[k] -= along * other[k];
      }
      const double length = std::sqrt(
          std::inner_product(motion.begin(), motion.end(), motion.begin(), 0.));
      if (length < none)
        continue;
      for (double &value : motion)
        value /= length;
      basis.push_back(motion);
      result.push_back(motion);
    }
    return result;
  }

  bool FreeMotionSolver::check_uncoupled(const la::Vector &residual)
  {
    if (uncoupled_.empty())
      return false;
    const Combinations refused =
        has_begun_ && fixed_.m() > 0
            ? unsupported_.along_which_works(uncoupled_, residual, no_work_)
            : uncoupled_;
    if (!refused.empty() && has_begun_ && iteration_.turns)
      deferred_ = refused;
    else if (!refused.empty())
      unsupported_.fail(
          refused,
          n_resisting(*rows_, std::vector<std::uint8_t>(rows_->n_rows(), 1)),
          "contact rows, open or not", "or tie it");
    return !refused.empty();
  }

  FreeMotionSolver::Free
  FreeMotionSolver::find_free(const la::Vector &residual,
                              const abut_request &request) const
  {
    Free free;
    free.resisting =
        UnsupportedBodies::resisting(*rows_, local_, request, row_stiffness_);
    free.motions = unsupported_.free_motions(*rows_, free.resisting.now);
    if (free.motions.empty())
      return free;
    bool slips = false;
    for (int i = 0; i < rows_->n_rows() && free.resisting.has_friction; ++i)
      slips = slips || (free.resisting.sticks[i] && !free.resisting.now[i]);
    free.slips = MPI::logical_or(slips, rows_->communicator());
    if (!free.slips)
      free.motions = unresisted(free.motions);
    find_work(residual, free);
    return free;
  }

  void FreeMotionSolver::find_work(const la::Vector &residual, Free &free) const
  {
    const std::vector<double> work = unsupported_.work(residual);
    for (const Combination &motion : free.motions)
    {
      const double sum =
          -std::inner_product(motion.begin(), motion.end(), work.begin(), 0.);
      free.works = free.works || std::abs(sum) > no_work_;
      free.forces.push_back(sum);
    }
    find_mass(free);
  }

  void FreeMotionSolver::find_mass(Free &free) const
  {
    const std::size_t n = free.motions.size(), all = unsupported_.size();
    std::vector<double> products, unused;
    unsupported_.project(moved_, products, unused);
    free.mass.assign(n * n, 0.);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t a = 0; a < all; ++a)
          for (std::size_t b = 0; b < all; ++b)
            free.mass[j * n + k] +=
                free.motions[j][a] * free.motions[k][b] * products[a * all + b];
  }

  std::vector<double>
  FreeMotionSolver::divide_by_mass(const Free &free,
                                   const std::vector<double> &right)
  {
    return UnsupportedBodies::divide(free.mass, right);
  }

  FreeMotionSolver::Combination
  FreeMotionSolver::combine(const Combinations &motions,
                            const std::vector<double> &coefficients) const
  {
    Combination result(unsupported_.size(), 0.);
    for (std::size_t j = 0; j < motions.size(); ++j)
      for (std::size_t k = 0; k < result.size(); ++k)
        result[k] += coefficients[j] * motions[j][k];
    return result;
  }

  la::Vector FreeMotionSolver::balanced(const Free &free,
                                        const la::Vector &residual) const
  {
    la::Vector result(residual), motion(residual);
    motion = 0.;
    unsupported_.add(combine(free.motions, divide_by_mass(free, free.forces)),
                     motion);
    for (int i = 0; i < la::n_owned(result); ++i)
      la::data(result)[i] += unsupported_.share(i) * la::data(motion)[i];
    return result;
  }

  LinearReport FreeMotionSolver::solve_with_springs(
      const Free &free, const la::Vector &residual, const abut_request &request,
      const double smallest_residual, la::Vector &increment,
      std::vector<double> &force)
  {
    std::vector<std::vector<double>> gap_change;
    for (const Combination &motion : coupled(free.motions))
      gap_change.push_back(unsupported_.gap_change(motion));
    const std::size_t n = gap_change.size();
    const RowBlocks blocks(request);
    std::vector<std::int64_t> own(rows_->n_rows());
    for (int i = 0; i < rows_->n_rows(); ++i)
      own[i] = i;
    for (int b = 0; !blocks.empty() && b < blocks.n_blocks(); ++b)
      for (int r = 0, k = blocks.size(b); r < k; ++r)
        own[blocks.first[b] + r] = blocks.at[b] + std::int64_t(r) * (k + 1);
    const auto springs = choose_pivots_of_span(
        rows_->n_rows(), static_cast<unsigned int>(n),
        [&](const std::size_t i)
        {
          std::vector<double> values(n, 0.);
          for (std::size_t k = 0; k < n && !free.resisting.now[i]
                                  && request.d_pressure[own[i]] != 0.;
               ++k)
            values[k] = gap_change[k][i];
          return values;
        },
        rows_->communicator());
    const std::int64_t n_numbers =
        blocks.empty() ? rows_->n_rows() : blocks.n_numbers();
    std::vector<double> slope(request.d_gap, request.d_gap + n_numbers);
    for (const std::size_t i : springs)
      slope[own[i]] += request.d_pressure[own[i]] * row_stiffness_[i];
    abut_request with_springs = request;
    with_springs.d_gap = slope.data();
    const LinearReport report =
        inner_->solve(residual, with_springs, smallest_residual, increment);
    force.assign(rows_->n_rows(), 0.);
    for (const std::size_t i : springs)
    {
      const double pressure = row_stiffness_[i] * request.gap_change[i];
      request.pressure_change[i] += pressure;
      force[i] = rows_->weight(i) * pressure;
    }
    return report;
  }

  void FreeMotionSolver::find_spring_forces(Free &free) const
  {
    free.works = false;
    free.forces.assign(free.motions.size(), 0.);
    const double tolerance =
        std::max(no_work_, 10. * iteration_.linear_tolerance * iteration_.load);
    for (std::size_t k = 0; k < free.motions.size(); ++k)
    {
      const std::vector<double> change =
          unsupported_.gap_change(free.motions[k]);
      double sum = 0.;
      for (std::size_t i = 0; i < free.springs.size(); ++i)
        sum += free.springs[i] * change[i];
      free.forces[k] = MPI::sum(sum, rows_->communicator());
      free.works = free.works || std::abs(free.forces[k]) > tolerance;
    }
  }

  std::vector<std::uint8_t>
  FreeMotionSolver::groups_apart(const abut_request &request) const
  {
    const auto &group = iteration_.group;
    std::vector<double> touched(iteration_.n_groups, 0.);
    for (int i = 0; i < rows_->n_rows() && !group.empty(); ++i)
      if (request.state[i] != ABUT_STATE_OPEN)
        touched[group[i]] = 1.;
    MPI::max(touched, rows_->communicator(), touched);
    std::vector<std::uint8_t> result;
    for (const double value : touched)
      result.push_back(value == 0.);
    return result;
  }

  double FreeMotionSolver::distance_to_contact(const Combination &motion,
                                               const abut_request &request,
                                               const bool others) const
  {
    constexpr double parallel = 1e-10;
    const std::vector<double> change = unsupported_.gap_change(motion);
    const auto &group = iteration_.group;
    const std::vector<std::uint8_t> apart =
        others ? groups_apart(request) : std::vector<std::uint8_t>();
    double largest = 0.;
    for (const double value : change)
      largest = std::max(largest, std::abs(value));
    largest = MPI::max(largest, rows_->communicator());
    double way = -infinite;
    for (int i = 0; i < rows_->n_rows(); ++i)
      if (is_open(*rows_, request, i) && change[i] < -parallel * largest
          && (!others || group.empty() || apart[group[i]] != 0))
        way = std::max(way, ((*iteration_.gap)[i] + request.gap_change[i])
                                / change[i]);
    return -MPI::max(way, rows_->communicator());
  }

  double FreeMotionSolver::distance_to_stick(const Combination &motion,
                                             const abut_request &request) const
  {
    const std::vector<double> change = unsupported_.gap_change(motion);
    const int n = rows_->n_rows();
    double way = -infinite;
    for (int i = 0; i < n; ++i)
    {
      if (rows_->is_tangent(i))
        continue;
      // Slip and change of it along the traction, against which it slips.
      double slip = 0., rate = 0., traction = 0., length = 0.;
      for (int k = i + 1; k < n && rows_->is_tangent(k); ++k)
      {
        const double t = request.pressure[k] + request.pressure_change[k];
        slip += t * ((*iteration_.gap)[k] + request.gap_change[k]);
        rate += t * change[k];
        traction += t * t;
        length += change[k] * change[k];
      }
      constexpr double across = 1e-6;
      if (request.state[i] == ABUT_STATE_SLIP
          && rate > across * std::sqrt(traction * length))
        way = std::max(way, slip / rate);
    }
    return -MPI::max(way, rows_->communicator());
  }

  void FreeMotionSolver::move(const Combination &motion, const double distance,
                              const abut_request &request,
                              la::Vector &increment) const
  {
    Combination part(motion);
    for (double &value : part)
      value *= distance;
    unsupported_.add(part, increment);
    const std::vector<double> change = unsupported_.gap_change(part);
    for (int i = 0; i < rows_->n_rows(); ++i)
      request.gap_change[i] += change[i];
  }

  void FreeMotionSolver::approach(const Combination &motion,
                                  const double distance,
                                  const abut_request &request,
                                  la::Vector &increment) const
  {
    const std::vector<double> before(request.gap_change,
                                     request.gap_change + rows_->n_rows());
    move(motion, distance, request, increment);
    if (!iteration_.approach)
      return;
    std::vector<std::uint8_t> apart = groups_apart(request);
    for (std::size_t g = 0; g < iteration_.pressed.size(); ++g)
      if (iteration_.pressed[g] != 0)
        apart[g] = 0;
    for (int i = 0; i < rows_->n_rows(); ++i)
      if (rows_->is_tangent(i) && apart[iteration_.group[i]] != 0)
        request.gap_change[i] = before[i];
    Combination part(motion);
    for (double &value : part)
      value *= distance;
    iteration_.approach(unsupported_.of_bodies(part), apart);
  }

  FreeMotionSolver::Combination FreeMotionSolver::driven(const Free &free) const
  {
    Combination motion =
        combine(free.motions, divide_by_mass(free, free.forces));
    double largest = 0.;
    for (const double value : motion)
      largest = std::max(largest, std::abs(value));
    for (double &value : motion)
      value /= largest;
    return motion;
  }

  FreeMotionSolver::Free FreeMotionSolver::pivots(const Free &free) const
  {
    Free result;
    result.resisting = free.resisting;
    result.motions = unsupported_.free_motions(*rows_, free.resisting.sticks);
    result.springs = free.springs;
    find_spring_forces(result);
    find_mass(result);
    return result;
  }

  void FreeMotionSolver::advance(const Free &free, const abut_request &request,
                                 la::Vector &increment)
  {
    const Combination motion = driven(free);
    const double way = distance_to_contact(motion, request, free.slips);
    const double to_stick =
        free.slips ? distance_to_stick(motion, request) : infinite;
    if (to_stick < infinite && to_stick <= way)
    {
      move(motion,
           std::max(0., to_stick) * (1. + beyond_distance)
               + beyond_slip * unsupported_.smallest_radius(),
           request, increment);
      return;
    }
    if (way < infinite)
    {
      if (way > 0.)
        approach(motion, way, request, increment);
      move(motion,
           std::max(0., way) * beyond_distance
               + beyond_size * unsupported_.smallest_radius(),
           request, increment);
      return;
    }
    const Free pivot = free.slips ? pivots(free) : Free();
    if (pivot.works)
      advance(pivot, request, increment);
    else if (iteration_.turns && !free.slips)
      deferred_ = {motion};
    else if (!free.slips || !pivot.motions.empty())
      unsupported_.fail_driven({motion}, *rows_,
                               n_resisting(*rows_, free.resisting.now));
    else
      slipping_ = motion;
  }

  void FreeMotionSolver::settle(const Free &free, const abut_request &request,
                                la::Vector &increment) const
  {
    la::Vector moved(moved_);
    moved += increment;
    std::vector<double> products, work, right;
    unsupported_.project(moved, products, work);
    for (const Combination &motion : free.motions)
    {
      double sum = 0.;
      for (std::size_t k = 0; k < work.size(); ++k)
        sum -= motion[k] * work[k];
      right.push_back(sum);
    }
    const Combination motion =
        combine(free.motions, divide_by_mass(free, right));
    const double way = distance_to_contact(motion, request, false);
    move(motion, std::max(0., std::min(1., way)), request, increment);
  }

  LinearReport FreeMotionSolver::solve(const la::Vector &given_residual,
                                       const abut_request &request,
                                       const double smallest_residual,
                                       la::Vector &increment)
  {
    slipping_.clear();
    deferred_.clear();
    if (unsupported_.empty())
      return inner_->solve(given_residual, request, smallest_residual,
                           increment);
    local_.reinit(request, rows_->n_rows(), rows_->weights(),
                  rows_->communicator());
    if (!has_begun_)
    {
      check_uncoupled(given_residual);
      unsupported_.check(*rows_, local_, request, row_stiffness_);
      return inner_->solve(given_residual, request, smallest_residual,
                           increment);
    }
    if (moved_.size() != increment.size())
      moved_.reinit(increment);
    no_work_ = work_tolerance();
    la::Vector forces(given_residual);
    if (check_uncoupled(forces))
    {
      Free uncoupled;
      uncoupled.motions = uncoupled_;
      find_work(forces, uncoupled);
      forces = balanced(uncoupled, forces);
    }
    const la::Vector &residual = forces;
    Free free = find_free(residual, request);
    LinearReport report;
    if (free.motions.empty())
      report = inner_->solve(residual, request, smallest_residual, increment);
    else
    {
      report = solve_with_springs(
          free, free.slips ? residual : balanced(free, residual), request,
          smallest_residual, increment, free.springs);
      if (free.slips)
        find_spring_forces(free);
      if (free.works)
        advance(free, request, increment);
      else
        settle(free, request, increment);
    }
    moved_ += increment;
    return report;
  }

  void FreeMotionSolver::begin_iteration(const ContactIteration &iteration)
  {
    iteration_ = iteration;
    has_begun_ = true;
    moved_ = la::Vector();
    slipping_.clear();
  }

  std::vector<BodyMotion>
  FreeMotionSolver::rigid_motions(const la::Vector &displacement) const
  {
    return unsupported_.rigid_part(displacement);
  }

  std::vector<FreeMotion>
  FreeMotionSolver::end_iteration(const abut_request &request)
  {
    if (!slipping_.empty())
      unsupported_.fail_slipping(slipping_);
    if (unsupported_.empty())
      return {};
    double weight = 0.;
    for (int i = 0; i < rows_->n_rows(); ++i)
      weight += rows_->weight(i);
    weight = MPI::sum(weight, rows_->communicator());
    const double no_pressure = weight > 0. ? no_work_ / weight : 0.;
    // Rows that are closed by chance resist nothing.
    std::vector<std::uint8_t> resists(rows_->n_rows(), 0);
    bool is_pressed = false;
    for (int i = 0; i < rows_->n_rows(); ++i)
    {
      const std::uint8_t state = request.state[i];
      if (!rows_->is_tangent(i))
        is_pressed = rows_->bilateral()[i] != 0
                     || (state != ABUT_STATE_OPEN
                         && std::abs(request.pressure[i]) > no_pressure);
      resists[i] = is_pressed;
    }
    const double pressed = std::count(resists.begin(), resists.end(), 1);
    if (!deferred_.empty() && MPI::sum(pressed, rows_->communicator()) == 0.)
      unsupported_.fail_driven(deferred_, *rows_, 0.);
    std::vector<FreeMotion> result;
    for (const Combination &motion :
         unresisted(unsupported_.free_motions(*rows_, resists)))
      result.push_back(
          {unsupported_.body(motion), unsupported_.describe(motion)});
    return result;
  }
} // namespace abut::solve

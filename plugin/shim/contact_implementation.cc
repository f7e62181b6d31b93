// SPDX-License-Identifier: LGPL-2.1-or-later
// From obstacles to constraint rows and a started strategy.
#include "contact_implementation.h"

#include "solve/nodal_condensation.h"
#include "solve/projected_gauss_seidel.h"
#include "solve/saddle_point.h"

#include <cmath>
#include <limits>

namespace abut
{
  using dealii::types::global_dof_index;
  using shim::row_id;
  using shim::upper_bit;
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Throw @p message on all ranks if it is not empty on one: that of the
     * lowest such rank. Collective. */
    template <typename Error>
    void throw_everywhere(const MPI_Comm communicator,
                          const std::string &message)
    {
      const unsigned int me = MPI::this_mpi_process(communicator);
      const unsigned int none = std::numeric_limits<unsigned int>::max();
      const unsigned int rank =
          MPI::min(message.empty() ? none : me, communicator);
      if (rank != none)
        throw Error(MPI::broadcast(communicator, message, rank));
    }

    abut_status reduce_over_ranks(void *user, const abut_reduction operation,
                                  double *values, const std::int32_t n)
    {
      const MPI_Comm communicator = *static_cast<const MPI_Comm *>(user);
      const int status = MPI_Allreduce(
          MPI_IN_PLACE, values, n, MPI_DOUBLE,
          operation == ABUT_REDUCTION_SUM ? MPI_SUM : MPI_MAX, communicator);
      return status == MPI_SUCCESS ? ABUT_SUCCESS : ABUT_CALLBACK_FAILED;
    }

    /** Values of an obstacle at all nodes; none, or +-infinity, where there
     * is no obstacle. */
    template <int dim>
    std::vector<double> evaluate(
        const std::shared_ptr<const dealii::Function<dim>> &function,
        const std::vector<typename shim::NodalCandidates<dim>::Node> &nodes,
        const double otherwise)
    {
      std::vector<double> values(nodes.size(), otherwise);
      if (function == nullptr)
        return values;
      std::vector<dealii::Point<dim>> points;
      points.reserve(nodes.size());
      for (const auto &node : nodes)
        points.push_back(node.point);
      function->value_list(points, values);
      return values;
    }

    template <int dim> std::string at(const dealii::Point<dim> &point)
    {
      std::ostringstream text;
      text << " at (" << point << ")";
      return text.str();
    }
  } // namespace

  template <int dim>
  void
  ContactAssembler<dim>::Implementation::check(const abut_status status) const
  {
    std::string message;
    if (status != ABUT_SUCCESS)
    {
      message = abut_context_message(context.get());
      if (message.empty())
        message = abut_status_text(status);
    }
    throw_everywhere<std::runtime_error>(communicator, message);
  }

  template <int dim>
  int ContactAssembler<dim>::Implementation::unknown(const int row) const
  {
    return static_cast<int>(view.column[view.row_start[row]]
                            - static_cast<std::int64_t>(first_unknown));
  }

  template <int dim>
  bool ContactAssembler<dim>::Implementation::is_upper(const int row) const
  {
    return (view.id[row] & upper_bit) != 0;
  }

  template <int dim>
  double
  ContactAssembler<dim>::Implementation::row_pressure(const int row) const
  {
    return is_started ? request.pressure[row] : 0.;
  }

  template <int dim>
  la::Vector ContactAssembler<dim>::Implementation::nodal_vector() const
  {
    return la::Vector(dof_handler->locally_owned_dofs(), communicator);
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::check_obstacles(
      const std::vector<double> &lower, const std::vector<double> &upper) const
  {
    std::string message;
    for (std::size_t i = 0; i < lower.size() && message.empty(); ++i)
    {
      if (std::isnan(lower[i]) || lower[i] == INFINITY)
        message = "The obstacle is not a number or is infinite";
      else if (std::isnan(upper[i]) || upper[i] == -INFINITY)
        message = "The upper obstacle is not a number or is infinite";
      else if (upper[i] < lower[i])
        message = "No displacement can lie between the upper obstacle, "
                  + std::to_string(upper[i]) + ", and the obstacle, "
                  + std::to_string(lower[i]) + ",";
      if (!message.empty())
        message += at(candidates.free[i].point) + ".";
    }
    throw_everywhere<ObstacleError>(communicator, message);
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::check_prescribed_values() const
  {
    const auto lower =
        evaluate<dim>(obstacle.lower, candidates.prescribed, -INFINITY);
    const auto upper =
        evaluate<dim>(obstacle.upper, candidates.prescribed, INFINITY);
    // Round-off of a formula that is 0 at a node is measured by its values
    // elsewhere.
    double largest = 0.;
    for (const auto &line : constraints->get_lines())
      largest = std::max(largest, std::abs(line.inhomogeneity));
    for (std::size_t i = 0; i < lower.size(); ++i)
      largest = std::max({largest, obstacle.lower ? std::abs(lower[i]) : 0.,
                          obstacle.upper ? std::abs(upper[i]) : 0.});
    const double slack = 1e-10 * MPI::max(largest, communicator);
    std::string message;
    for (std::size_t i = 0; i < lower.size() && message.empty(); ++i)
    {
      const auto &node = candidates.prescribed[i];
      const double value = constraints->get_inhomogeneity(node.dof);
      if (value < lower[i] - slack)
        message = "The obstacle (" + std::to_string(lower[i])
                  + ") lies above the prescribed value ("
                  + std::to_string(value) + ")" + at(node.point)
                  + ". Lower the obstacle there or raise the Dirichlet value.";
      else if (value > upper[i] + slack)
        message = "The upper obstacle (" + std::to_string(upper[i])
                  + ") lies below the prescribed value ("
                  + std::to_string(value) + ")" + at(node.point)
                  + ". Raise the obstacle there or lower the Dirichlet value.";
    }
    throw_everywhere<ObstacleError>(communicator, message);
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::append_rows(
      const std::vector<double> &lower, const std::vector<double> &upper)
  {
    check(abut_rows_clear(rows.get()));
    const bool both = obstacle.lower && obstacle.upper;
    const auto n = static_cast<std::int32_t>(lower.size() * (both ? 2 : 1));
    check(abut_rows_reserve(rows.get(), n, n));

    const double plus = 1., minus = -1.;
    abut_status status = ABUT_SUCCESS;
    for (std::size_t i = 0; i < lower.size() && status == ABUT_SUCCESS; ++i)
    {
      const auto &node = candidates.free[i];
      const auto column = static_cast<std::int64_t>(node.dof);
      if (lower[i] != -INFINITY)
        status = abut_rows_append(rows.get(), row_id(node.dof, false),
                                  node.weight, -lower[i], 0, 1, &column, &plus);
      if (upper[i] != INFINITY && status == ABUT_SUCCESS)
        status = abut_rows_append(rows.get(), row_id(node.dof, true),
                                  node.weight, upper[i], 0, 1, &column, &minus);
    }
    check(status);
    check(abut_rows_get(rows.get(), &view));
    n_rows = MPI::sum(static_cast<global_dof_index>(view.n_rows), communicator);
  }

  template <int dim> void ContactAssembler<dim>::Implementation::find_rows()
  {
    const auto lower =
        evaluate<dim>(obstacle.lower, candidates.free, -INFINITY);
    const auto upper = evaluate<dim>(obstacle.upper, candidates.free, INFINITY);
    check_obstacles(lower, upper);
    check_prescribed_values();
    append_rows(lower, upper);
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::compute_gap(
      const la::Vector &displacement)
  {
    gap.resize(view.n_rows);
    const auto range = displacement.local_range();
    check(abut_rows_gap(rows.get(), la::data(displacement),
                        static_cast<std::int64_t>(range.first),
                        la::n_owned(displacement), gap.data()));
  }

  template <int dim>
  void
  ContactAssembler<dim>::Implementation::set_scales(const la::Matrix &matrix,
                                                    const la::Vector &residual)
  {
    // Internal forces at the start measure the load when the residual is
    // small because the start is good.
    la::Vector internal(residual);
    matrix.vmult(internal, start_displacement);
    double *force = la::data(internal);
    const dealii::IndexSet &owned = dof_handler->locally_owned_dofs();
    for (int i = 0; i < la::n_owned(internal); ++i)
      if (constraints->is_constrained(owned.nth_index_in_set(i)))
        force[i] = 0.;
    smallest_residual = method.options.final_linear_tolerance
                        * std::max(residual.l2_norm(), internal.l2_norm());

    double weight = 0.;
    for (int i = 0; i < view.n_rows; ++i)
      weight += view.weight[i];
    weight = MPI::sum(weight, communicator);
    const double load = std::max(residual.l1_norm(), internal.l1_norm());
    abut_strategy_options &options = method.options;
    options.pressure_scale = load > 0. && weight > 0. ? load / weight : 1.;
    options.length_scale = length_scale();
  }

  template <int dim>
  double ContactAssembler<dim>::Implementation::length_scale() const
  {
    const double displacement = start_displacement.linfty_norm();
    if (displacement > 0.)
      return displacement;
    // The harmonic mean of the gaps: parts of an obstacle that are out of
    // reach do not count.
    double sums[2] = {0., 0.};
    for (int i = 0; i < view.n_rows; ++i)
      if (gap[i] != 0.)
      {
        sums[0] += view.weight[i];
        sums[1] += view.weight[i] / std::abs(gap[i]);
      }
    MPI::sum(sums, communicator, sums);
    return sums[1] > 0. ? sums[0] / sums[1] : 1.;
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::begin(const la::Matrix &matrix,
                                                    const la::Vector &residual)
  {
    set_scales(matrix, residual);
    method.options.reduce = reduce_over_ranks;
    method.options.user = const_cast<MPI_Comm *>(&communicator);
    strategy = shim::create_strategy(context.get(), method.options);

    const std::vector<double> stiffness = solve::row_stiffness(matrix, view);
    std::vector<double> pressure(view.n_rows, 0.);
    if (!start_pressure.empty())
      for (int i = 0; i < view.n_rows; ++i)
      {
        const double p = start_pressure[unknown(i)];
        pressure[i] = std::max(0., is_upper(i) ? -p : p);
      }
    check(abut_strategy_start(
        strategy.get(), view.n_rows, view.id, view.weight, stiffness.data(),
        view.bilateral, gap.data(), pressure.data(),
        start_state.empty() ? nullptr : start_state.data()));
    is_started = true;
    next();
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::prepare_solver(
      const la::Matrix &matrix)
  {
    if (solver_is_ready && constant_matrix)
      return;
    if (solver == nullptr)
    {
      if (method.system == System::saddle_point)
        solver = std::make_unique<solve::SaddlePoint>(solver_parameters);
      else
        solver = std::make_unique<solve::NodalCondensation>(solver_parameters);
    }
    solver->reinit(matrix, view);
    solver_is_ready = true;
  }

  template <int dim> void ContactAssembler<dim>::Implementation::next()
  {
    check(abut_strategy_next(strategy.get(), gap.data(), &request));
  }

  template <int dim>
  void
  ContactAssembler<dim>::Implementation::push_inside(la::Vector &displacement)
  {
    // On the path of the barrier p g = mu, as far as the start knows p.
    double largest = 0.;
    for (const double p : start_pressure)
      largest = std::max(largest, std::abs(p));
    largest = MPI::max(largest, communicator);
    const bool warm = largest > 0.;
    const double barrier = warm ? std::min(1e-4, method.options.barrier_start)
                                : method.options.barrier_start;
    const double margin = barrier * length_scale();
    double *u = la::data(displacement);
    for (int i = 0; i < view.n_rows; ++i)
    {
      // Between two obstacles the margin is at most a quarter of the room.
      const bool paired = i + 1 < view.n_rows && unknown(i) == unknown(i + 1);
      const bool second = i > 0 && unknown(i) == unknown(i - 1);
      double room = margin;
      if (warm)
      {
        const double p = start_pressure[unknown(i)] * (is_upper(i) ? -1. : 1.);
        room *= largest / std::max(p, 1e-2 * largest);
      }
      if (paired || second)
      {
        const int other = paired ? i + 1 : i - 1;
        room = std::min(room,
                        0.25 * (view.initial_gap[i] + view.initial_gap[other]));
      }
      const double slope = is_upper(i) ? -1. : 1.;
      const double g = view.initial_gap[i] + slope * u[unknown(i)];
      if (g < room)
        u[unknown(i)] += slope * (room - g);
    }
    displacement.compress(dealii::VectorOperation::insert);
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::relax(const la::Matrix &matrix,
                                                    const la::Vector &residual,
                                                    const unsigned int n_sweeps,
                                                    la::Vector &displacement)
  {
    const double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> lower(la::n_owned(displacement), -infinity);
    std::vector<double> upper(la::n_owned(displacement), infinity);
    for (int i = 0; i < view.n_rows; ++i)
      if (is_upper(i))
        upper[unknown(i)] = gap[i];
      else
        lower[unknown(i)] = -gap[i];

    la::Vector correction = nodal_vector();
    solve::projected_gauss_seidel(matrix, residual, lower, upper, n_sweeps,
                                  correction);
    const double *d = la::data(correction);
    start_state.resize(view.n_rows);
    for (int i = 0; i < view.n_rows; ++i)
      start_state[i] =
          (is_upper(i) ? d[unknown(i)] >= gap[i] : d[unknown(i)] <= -gap[i])
              ? ABUT_STATE_CLOSED
              : ABUT_STATE_OPEN;
    displacement += correction;
  }

  template struct ContactAssembler<2>::Implementation;
  template struct ContactAssembler<3>::Implementation;
} // namespace abut

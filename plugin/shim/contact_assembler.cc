// SPDX-License-Identifier: LGPL-2.1-or-later
#include <abut/dealii/contact_assembler.h>

#include "handles.h"
#include "nodal_candidates.h"
#include "solve/nodal_condensation.h"
#include "solve/projected_gauss_seidel.h"
#include "solve/saddle_point.h"

#include <abut/rows.h>

#include <cmath>
#include <limits>

namespace abut
{
  namespace
  {
    using dealii::ExcMessage;
    using dealii::types::global_dof_index;
    namespace MPI = dealii::Utilities::MPI;

    /** Row numbers: two per unknown, so that numbers are unique over ranks
     * and sorted by unknown. */
    constexpr std::int64_t upper_bit = 1;

    std::int64_t row_id(const global_dof_index dof, const bool upper)
    {
      return 2 * static_cast<std::int64_t>(dof) + (upper ? upper_bit : 0);
    }

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

  template <int dim> struct ContactAssembler<dim>::Implementation
  {
    explicit Implementation(const MPI_Comm communicator)
        : communicator(communicator)
    {
    }

    void check(const abut_status status) const;
    void check_obstacles(const std::vector<double> &lower,
                         const std::vector<double> &upper) const;
    void check_prescribed_values() const;
    void append_rows(const std::vector<double> &lower,
                     const std::vector<double> &upper);
    void compute_gap(const la::Vector &displacement);
    void set_scales(const la::Matrix &matrix, const la::Vector &residual);
    double length_scale() const;
    void begin(const la::Matrix &matrix, const la::Vector &residual);
    void prepare_solver(const la::Matrix &matrix);
    void push_inside(la::Vector &displacement);
    void relax(const la::Matrix &matrix, const la::Vector &residual,
               unsigned int n_sweeps, la::Vector &displacement);
    void next();
    double row_pressure(int row) const;
    /** Local number of the unknown of a row. */
    int unknown(int row) const;
    bool is_upper(int row) const;
    la::Vector nodal_vector() const;

    const MPI_Comm communicator;
    Obstacle<dim> obstacle;
    MethodParameters method;
    SolverParameters solver_parameters;
    bool constant_matrix = false;

    const dealii::DoFHandler<dim> *dof_handler = nullptr;
    const dealii::AffineConstraints<double> *constraints = nullptr;
    shim::NodalCandidates<dim> candidates;
    std::set<dealii::types::boundary_id> candidates_of;
    bool candidates_are_known = false;
    const dealii::Mapping<dim> *mapping = nullptr;

    shim::Handle<abut_context> context = shim::create_context();
    shim::Handle<abut_rows> rows = shim::create_rows(context.get());
    shim::Handle<abut_strategy> strategy;
    abut_rows_view view = {};
    global_dof_index n_rows = 0;
    global_dof_index first_unknown = 0; ///< owned ones are consecutive

    /** [owned] signed nodal pressure to start from; empty: 0. */
    std::vector<double> start_pressure;
    std::vector<std::uint8_t> start_state; ///< [rows]; empty: from p and g
    la::Vector start_displacement;
    std::vector<double> gap; ///< [rows] at the present displacement
    double smallest_residual = 0.;

    std::unique_ptr<solve::RowSolver> solver;
    bool solver_is_ready = false;
    bool is_started = false;
    bool was_added = false; ///< by add(): the host solves
    abut_request request = {};
    LinearReport report;
  };

  // --- errors and small queries -------------------------------------------

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

  // --- rows -----------------------------------------------------------------

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

  // --- start
  // ------------------------------------------------------------------

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

  // --- public functions
  // -------------------------------------------------------

  template <int dim>
  ContactAssembler<dim>::ContactAssembler(const MPI_Comm communicator)
      : implementation(std::make_unique<Implementation>(communicator))
  {
  }

  template <int dim> ContactAssembler<dim>::~ContactAssembler() = default;

  template <int dim>
  void ContactAssembler<dim>::declare_parameters(dealii::ParameterHandler &prm)
  {
    MethodParameters::declare_parameters(prm);
    SolverParameters::declare_parameters(prm);
  }

  template <int dim>
  void ContactAssembler<dim>::parse_parameters(dealii::ParameterHandler &prm)
  {
    MethodParameters method;
    SolverParameters solver;
    method.parse_parameters(prm);
    solver.parse_parameters(prm);
    set_parameters(method, solver);
  }

  template <int dim>
  void ContactAssembler<dim>::set_parameters(const MethodParameters &method,
                                             const SolverParameters &solver)
  {
    implementation->method = method;
    implementation->solver_parameters = solver;
    implementation->solver.reset();
  }

  template <int dim>
  void ContactAssembler<dim>::set_obstacle(const Obstacle<dim> &obstacle)
  {
    implementation->obstacle = obstacle;
  }

  template <int dim>
  void ContactAssembler<dim>::assume_constant_matrix(const bool constant)
  {
    implementation->constant_matrix = constant;
  }

  template <int dim>
  void ContactAssembler<dim>::reinit(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler,
      const dealii::AffineConstraints<double> &constraints)
  {
    Implementation &i = *implementation;
    AssertThrow(dof_handler.get_fe().n_components() == 1,
                ExcMessage("Obstacles need a scalar field: the finite element "
                           "has "
                           + std::to_string(dof_handler.get_fe().n_components())
                           + " components."));
    AssertThrow(dof_handler.locally_owned_dofs().is_contiguous(),
                ExcMessage("The unknowns of a rank must be numbered "
                           "consecutively."));
    i.first_unknown = dof_handler.locally_owned_dofs().n_elements() > 0
                          ? *dof_handler.locally_owned_dofs().begin()
                          : 0;
    i.mapping = &mapping;
    i.dof_handler = &dof_handler;
    i.constraints = &constraints;
    i.candidates_are_known = false;
    i.solver_is_ready = false;
    i.start_pressure.clear();
    i.is_started = false;
    i.report = LinearReport();
  }

  template <int dim>
  void ContactAssembler<dim>::detect(const la::Vector &displacement)
  {
    Implementation &i = *implementation;
    AssertThrow(i.dof_handler != nullptr,
                ExcMessage("Call reinit() before detect()."));
    AssertThrow(i.obstacle.lower || i.obstacle.upper,
                ExcMessage("There is no obstacle: call set_obstacle() first."));
    if (!i.candidates_are_known || i.candidates_of != i.obstacle.boundary_ids)
    {
      i.candidates = shim::collect_nodal_candidates(
          *i.mapping, *i.dof_handler, *i.constraints, i.obstacle.boundary_ids);
      i.candidates_of = i.obstacle.boundary_ids;
      i.candidates_are_known = true;
      i.solver_is_ready = false;
    }
    if (i.is_started)
    {
      // The pressures reached so far are the start of the next solve.
      const la::Vector p = pressure();
      i.start_pressure.assign(la::data(p), la::data(p) + la::n_owned(p));
    }
    const auto lower =
        evaluate<dim>(i.obstacle.lower, i.candidates.free, -INFINITY);
    const auto upper =
        evaluate<dim>(i.obstacle.upper, i.candidates.free, INFINITY);
    i.check_obstacles(lower, upper);
    i.check_prescribed_values();
    i.append_rows(lower, upper);
    i.is_started = false;
    i.was_added = false;
    i.start_state.clear();
    i.start_displacement = displacement;
    i.compute_gap(displacement);
  }

  template <int dim>
  void ContactAssembler<dim>::set_pressure(const la::Vector &pressure)
  {
    implementation->start_pressure.assign(
        la::data(pressure), la::data(pressure) + la::n_owned(pressure));
  }

  template <int dim>
  void ContactAssembler<dim>::add_to_sparsity(
      dealii::DynamicSparsityPattern &pattern) const
  {
    const Implementation &i = *implementation;
    for (int row = 0; row < i.view.n_rows; ++row)
      pattern.add(i.view.column[i.view.row_start[row]],
                  i.view.column[i.view.row_start[row]]);
  }

  template <int dim>
  void ContactAssembler<dim>::relax(const la::Matrix &matrix,
                                    const la::Vector &residual,
                                    const unsigned int n_sweeps,
                                    la::Vector &displacement)
  {
    Implementation &i = *implementation;
    AssertThrow(!i.is_started, ExcMessage("Call relax() between detect() and "
                                          "the first solve()."));
    if (i.method.options.law->outer == ABUT_OUTER_BARRIER)
      i.push_inside(displacement);
    else
      i.relax(matrix, residual, n_sweeps, displacement);
    i.start_displacement = displacement;
    i.compute_gap(displacement);
  }

  template <int dim>
  LinearReport ContactAssembler<dim>::solve(const la::Matrix &matrix,
                                            const la::Vector &residual,
                                            la::Vector &increment)
  {
    Implementation &i = *implementation;
    AssertThrow(i.view.row_start != nullptr || i.n_rows == 0,
                ExcMessage("Call detect() before solve()."));
    i.prepare_solver(matrix);
    AssertThrow(!i.is_started || i.request.action == ABUT_ACTION_SOLVE,
                ExcMessage("The contact iteration has stopped: call detect() "
                           "to begin a new one."));
    // An infeasible start stops a barrier at once; update() then says so.
    increment = 0.;
    if (!i.is_started)
      i.begin(matrix, residual);
    LinearReport report;
    while (i.request.action == ABUT_ACTION_SOLVE
           || i.request.action == ABUT_ACTION_SOLVE_AGAIN)
    {
      report.n_systems += i.request.action == ABUT_ACTION_SOLVE;
      report +=
          i.solver->solve(residual, i.request, i.smallest_residual, increment);
      i.next();
    }
    if (i.request.action == ABUT_ACTION_MOVE && i.request.step_length != 1.)
      increment *= i.request.step_length;
    i.report += report;
    return report;
  }

  template <int dim>
  void ContactAssembler<dim>::add(la::Matrix &matrix, la::Vector &residual)
  {
    Implementation &i = *implementation;
    const std::uint32_t hard = ABUT_LAW_HARD | ABUT_LAW_INTERIOR;
    AssertThrow((i.method.options.law->flags & hard) == 0,
                ExcMessage(std::string("The law '") + i.method.options.law->name
                           + "' cannot be added to a matrix row by row: use "
                             "ContactAssembler::solve()."));
    if (!i.is_started)
      i.begin(matrix, residual);
    for (int row = 0; row < i.view.n_rows; ++row)
    {
      const auto dof =
          static_cast<global_dof_index>(i.view.column[i.view.row_start[row]]);
      const double slope = i.view.coefficient[i.view.row_start[row]];
      const double w = i.view.weight[row];
      const double a = i.request.d_pressure[row];
      matrix.add(dof, dof, w * slope * slope * i.request.d_gap[row] / a);
      residual(dof) -=
          w * slope * (i.request.pressure[row] - i.request.residual[row] / a);
    }
    matrix.compress(dealii::VectorOperation::add);
    residual.compress(dealii::VectorOperation::add);
    i.was_added = true;
  }

  template <int dim>
  bool ContactAssembler<dim>::update(const la::Vector &displacement)
  {
    Implementation &i = *implementation;
    AssertThrow(i.is_started,
                ExcMessage("Call solve() or add() before update()."));
    if (i.request.action == ABUT_ACTION_STOP)
      return false;
    const std::vector<double> before = i.gap;
    i.compute_gap(displacement);
    if (i.was_added)
    {
      for (int row = 0; row < i.view.n_rows; ++row)
      {
        i.request.gap_change[row] = i.gap[row] - before[row];
        i.request.pressure_change[row] =
            -(i.request.residual[row]
              + i.request.d_gap[row] * i.request.gap_change[row])
            / i.request.d_pressure[row];
      }
      i.was_added = false;
      i.next();
    }
    i.next();
    return i.request.action != ABUT_ACTION_STOP;
  }

  template <int dim> abut_reason ContactAssembler<dim>::reason() const
  {
    return implementation->is_started ? implementation->request.reason
                                      : ABUT_REASON_NONE;
  }

  template <int dim> std::string ContactAssembler<dim>::explanation() const
  {
    const std::string seen =
        abut_context_message(implementation->context.get());
    const bool failed =
        reason() != ABUT_REASON_NONE && reason() != ABUT_REASON_CONVERGED;
    return abut_reason_text(reason())
           + (failed && !seen.empty() ? " (" + seen + ")" : "");
  }

  template <int dim> abut_progress ContactAssembler<dim>::progress() const
  {
    abut_progress progress = {};
    if (implementation->is_started)
      shim::check(
          implementation->context.get(),
          abut_strategy_progress(implementation->strategy.get(), &progress));
    return progress;
  }

  template <int dim> global_dof_index ContactAssembler<dim>::n_rows() const
  {
    return implementation->n_rows;
  }

  template <int dim> global_dof_index ContactAssembler<dim>::n_active() const
  {
    return static_cast<global_dof_index>(progress().n_active);
  }

  template <int dim> double ContactAssembler<dim>::contact_force() const
  {
    const Implementation &i = *implementation;
    double force = 0.;
    for (int row = 0; row < i.view.n_rows; ++row)
      force += i.view.weight[row] * i.row_pressure(row)
               * (i.is_upper(row) ? -1. : 1.);
    return MPI::sum(force, i.communicator);
  }

  template <int dim> double ContactAssembler<dim>::complementarity() const
  {
    const Implementation &i = *implementation;
    double sums[2] = {0., 0.};
    for (int row = 0; row < i.view.n_rows; ++row)
    {
      const double p = i.row_pressure(row);
      sums[0] += i.view.weight[row] * std::abs(p * i.gap[row]);
      sums[1] += i.view.weight[row] * std::abs(p);
    }
    MPI::sum(sums, i.communicator, sums);
    return sums[1] > 0. ? sums[0] / sums[1] : 0.;
  }

  template <int dim> double ContactAssembler<dim>::penetration() const
  {
    double largest = 0.;
    for (const double g : implementation->gap)
      largest = std::max(largest, -g);
    return MPI::max(largest, implementation->communicator);
  }

  template <int dim> la::Vector ContactAssembler<dim>::pressure() const
  {
    const Implementation &i = *implementation;
    la::Vector result = i.nodal_vector();
    double *p = la::data(result);
    for (int row = 0; row < i.view.n_rows; ++row)
      p[i.unknown(row)] += (i.is_upper(row) ? -1. : 1.) * i.row_pressure(row);
    result.compress(dealii::VectorOperation::insert);
    return result;
  }

  template <int dim> la::Vector ContactAssembler<dim>::gap() const
  {
    const Implementation &i = *implementation;
    la::Vector result = i.nodal_vector();
    double *g = la::data(result);
    int previous = -1;
    for (int row = 0; row < i.view.n_rows; ++row)
    {
      const int u = i.unknown(row);
      g[u] = u == previous ? std::min(g[u], i.gap[row]) : i.gap[row];
      previous = u;
    }
    result.compress(dealii::VectorOperation::insert);
    return result;
  }

  template <int dim> la::Vector ContactAssembler<dim>::status() const
  {
    const Implementation &i = *implementation;
    la::Vector result = i.nodal_vector();
    result = -1.;
    double *s = la::data(result);
    for (int row = 0; row < i.view.n_rows; ++row)
    {
      const int u = i.unknown(row);
      s[u] = std::max(s[u], 0.);
      if (i.is_started && i.request.state[row] != ABUT_STATE_OPEN)
        s[u] = i.is_upper(row) ? 2. : 1.;
    }
    result.compress(dealii::VectorOperation::insert);
    return result;
  }

  template <int dim>
  const LinearReport &ContactAssembler<dim>::linear_report() const
  {
    return implementation->report;
  }

  template class ContactAssembler<2>;
  template class ContactAssembler<3>;
} // namespace abut

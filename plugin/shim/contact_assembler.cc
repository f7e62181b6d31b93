// SPDX-License-Identifier: LGPL-2.1-or-later
// The order in which a host calls the assembler, and what each call does.
#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/contact_loop.h>
#include <abut/dealii/versions.h>

#include "contact_problem.h"
#include "host_cells.h"

#include <algorithm>
#include <cmath>

namespace abut
{
  using dealii::ExcMessage;
  using dealii::types::global_dof_index;

  namespace
  {
    /** Whether these are the same pairs, but for gaps. */
    template <int dim>
    bool differ_in_gaps(const std::vector<ContactPair<dim>> &a,
                        const std::vector<ContactPair<dim>> &b)
    {
      return std::equal(
          a.begin(), a.end(), b.begin(), b.end(),
          [](const ContactPair<dim> &x, const ContactPair<dim> &y)
          {
            return x.name == y.name && x.secondary == y.secondary
                   && x.primary == y.primary && x.obstacle == y.obstacle
                   && x.friction == y.friction
                   && x.geometric_gap == y.geometric_gap && x.tied == y.tied
                   && x.holds_body == y.holds_body
                   && x.may_be_apart == y.may_be_apart && x.reach == y.reach;
          });
    }

    /** Programs without MPI of their own need it, too: Trilinos does. */
    void check_mpi()
    {
      AssertThrow(dealii::Utilities::MPI::job_supports_mpi(),
                  ExcMessage("MPI is not initialised. Begin main() with: "
                             "dealii::Utilities::MPI::MPI_InitFinalize "
                             "mpi(argc, argv, 1);"));
    }
  } // namespace

  template <int dim>
  ContactAssembler<dim>::ContactAssembler(const MPI_Comm communicator)
      : implementation(
          (check_mpi(),
           std::make_unique<shim::ContactProblem<dim>>(communicator)))
  {
  }

  template <int dim> ContactAssembler<dim>::~ContactAssembler() = default;

  template <int dim>
  void ContactAssembler<dim>::declare_parameters(dealii::ParameterHandler &prm)
  {
    MethodParameters::declare_parameters(prm);
    SolverParameters::declare_parameters(prm);
    SearchParameters::declare_parameters(prm);
  }

  template <int dim>
  void ContactAssembler<dim>::parse_parameters(dealii::ParameterHandler &prm)
  {
    MethodParameters method;
    SolverParameters solver;
    SearchParameters search;
    method.parse_parameters(prm);
    solver.parse_parameters(prm);
    search.parse_parameters(prm);
    set_parameters(method, solver);
    set_search_parameters(search);
  }

  template <int dim>
  void ContactAssembler<dim>::set_parameters(const MethodParameters &method,
                                             const SolverParameters &solver)
  {
    implementation->input.method = method;
    if (method.options.law == nullptr)
      implementation->input.method.options.law = abut_law_find("lagrange");
    implementation->input.solver = solver;
    implementation->system.solver.reset();
    // How rows of pairs are made is a matter of the method, too.
    if (!implementation->input.pairs.empty())
      implementation->source_is_outdated = true;
  }

  template <int dim>
  void ContactAssembler<dim>::set_obstacle(const Obstacle<dim> &obstacle)
  {
    implementation->input.obstacle = obstacle;
    implementation->input.pairs.clear();
    implementation->source_is_outdated = true;
  }

  template <int dim>
  void
  ContactAssembler<dim>::set_search_parameters(const SearchParameters &search)
  {
    implementation->input.search = search;
    if (!implementation->input.pairs.empty())
      implementation->source_is_outdated = true;
  }

  template <int dim>
  void
  ContactAssembler<dim>::set_pairs(const std::vector<ContactPair<dim>> &pairs)
  {
    auto &i = *implementation;
    if (i.surfaces != nullptr && !i.source_is_outdated
        && differ_in_gaps(i.input.pairs, pairs))
      i.surface_search.has_new_gaps = true;
    else
      i.source_is_outdated = true;
    i.input.pairs = pairs;
    i.input.has_pairs = true;
  }

  template <int dim>
  void ContactAssembler<dim>::set_body_names(std::vector<std::string> names)
  {
    implementation->input.body_names = std::move(names);
  }

  template <int dim>
  void ContactAssembler<dim>::set_axisymmetric(const bool axisymmetric)
  {
    implementation->input.axisymmetric = axisymmetric;
    implementation->source_is_outdated = true;
  }

  template <int dim>
  void
  ContactAssembler<dim>::set_vertex_origins(std::vector<VertexOrigin> origins)
  {
    implementation->host.set_vertex_origins(std::move(origins));
  }

  template <int dim>
  void ContactAssembler<dim>::set_surface_traction(
      std::shared_ptr<const SurfaceTraction<dim>> traction)
  {
    implementation->nitsche.set_traction(std::move(traction));
  }

  template <int dim>
  void ContactAssembler<dim>::assume_constant_matrix(const bool constant)
  {
    implementation->input.constant_matrix = constant;
  }

  template <int dim>
  void ContactAssembler<dim>::reinit(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler,
      const dealii::AffineConstraints<double> &constraints)
  {
    auto &i = *implementation;
    namespace MPI = dealii::Utilities::MPI;
    AssertThrow(
        MPI::n_mpi_processes(i.communicator)
            == MPI::n_mpi_processes(versions::communicator(dof_handler)),
        ExcMessage("The communicator given to ContactAssembler must be "
                   "that of the triangulation: MPI_COMM_SELF for one "
                   "that is not distributed."));
    AssertThrow(constraints.is_closed(),
                ExcMessage("Call close() for the constraints before they are "
                           "given to reinit()."));
    AssertThrow(dof_handler.locally_owned_dofs().is_contiguous(),
                ExcMessage("The unknowns of a rank must be numbered "
                           "consecutively."));
    const Message reason = shim::cell_refusal(mapping, dof_handler);
    if (!reason.empty())
      throw ContactError(reason);
    i.record_present();
    i.history.leave_ranks();
    i.surface_search.elements.forget();
    i.start.forget_history();
    i.rows.mesh = 0;
    i.rows.are_found = false;
    i.host.reinit(mapping, dof_handler, constraints);
    i.clear_source();
    i.system.solver.reset();
    i.system.kept_preconditioner.clear();
    // Assigned again, they would keep the ranks that unknowns had before, where
    // the number of unknowns is the same.
    i.abandon_iteration();
    i.start_displacement = la::Vector();
    i.present_displacement = la::Vector();
    i.residual_check.clear(true);
    i.committed.leave_mesh();
    i.rows.slip_reference = {};
    i.scales.law_compliance = la::Vector();
    i.system.report = LinearReport();
  }

  template <int dim>
  void ContactAssembler<dim>::detect(const la::VectorView &given_displacement)
  {
    auto &i = *implementation;
    i.host.check_mesh("detect()");
    i.host.check_places("detect()");
    const la::Vector &displacement =
        i.host.vector("detect()", "displacement", given_displacement);
    // The pressures reached so far are the start of the next solve.
    i.record_present();
    if (i.is_started || i.start.is_restarted())
      i.start.use_history();
    if (i.source_is_outdated)
    {
      if (i.source != nullptr && i.rows.mesh != 0)
        i.start.keep_field(*i.source, i.row_pressures());
      i.create_source();
    }
    else if (i.surface_search.has_new_gaps)
      i.surfaces->set().set_gaps(i.input.pairs);
    i.surface_search.has_new_gaps = false;
    i.rows.are_found = false;
    i.raises.clear();
    i.check_approach(displacement);
    i.find_rows_in_reach(displacement);
    i.rows.are_found = true;
    i.find_pressed();
    i.check_committed();
    i.start.set_state({});
    i.start.set_restarted(false);
    i.system.tolerance = 0.;
    i.begin_at(displacement);
  }

  template <int dim>
  bool ContactAssembler<dim>::search_farther(
      const la::VectorView &given_displacement)
  {
    auto &i = *implementation;
    const la::Vector &displacement =
        i.given("search_farther()", "displacement", given_displacement);
    const auto n_rows = [&]
    {
      return dealii::Utilities::MPI::sum(double(i.rows.coefficients.n_rows()),
                                         i.communicator);
    };
    const double before = n_rows();
    while (i.widen_search())
    {
      i.return_to_history();
      detect(displacement);
      if (n_rows() > before)
        return true;
    }
    return false;
  }

  template <int dim>
  void
  ContactAssembler<dim>::linearise(const la::VectorView &given_displacement,
                                   const double linear_tolerance)
  {
    auto &i = *implementation;
    const la::Vector &displacement =
        i.given("linearise()", "displacement", given_displacement);
    AssertThrow(!i.input.is_nitsche(),
                ExcMessage("Nitsche's method is for linear "
                           "elastic bodies: do not call "
                           "linearise() with it."));
    if (i.moves())
      i.move_rows(displacement, i.row_values());
    else if (i.is_started)
    {
      i.record_present();
      i.start_from_present();
    }
    i.system.tolerance = linear_tolerance;
    i.system.has_new_matrix = true;
    i.begin_at(displacement);
  }

  template <int dim>
  void ContactAssembler<dim>::follow(const la::VectorView &given_displacement)
  {
    auto &i = *implementation;
    const la::Vector &displacement =
        i.given("follow()", "displacement", given_displacement);
    if (i.moves())
      i.follow(displacement);
  }

  template <int dim>
  bool
  ContactAssembler<dim>::raise_gaps(const la::VectorView &given_displacement)
  {
    auto &i = *implementation;
    const la::Vector &displacement =
        i.given("raise_gaps()", "displacement", given_displacement);
    if (!i.raises.raise(displacement))
      return false;
    i.compute_gap(displacement);
    return true;
  }

  template <int dim>
  bool ContactAssembler<dim>::limit_raises(
      const la::MutableVectorView &given_displacement)
  {
    auto &i = *implementation;
    i.check_rows("limit_raises()");
    la::Vector &displacement = i.host.mutable_vector(
        "limit_raises()", "displacement", given_displacement);
    shim::RowValues values;
    if (!i.raises.limit(displacement, values))
      return false;
    i.move_rows(displacement, values);
    i.is_started = false;
    return true;
  }

  template <int dim> bool ContactAssembler<dim>::points_move() const
  {
    return implementation->moves();
  }

  template <int dim>
  void
  ContactAssembler<dim>::relax(const Tangent &tangent,
                               const la::VectorView &given_residual,
                               const unsigned int n_sweeps,
                               const la::MutableVectorView &given_displacement)
  {
    auto &i = *implementation;
    const la::Vector &residual = i.given("relax()", "residual", given_residual);
    la::Vector &displacement =
        i.host.mutable_vector("relax()", "displacement", given_displacement);
    AssertThrow(!i.is_started, ExcMessage("Call relax() between detect() and "
                                          "the first solve()."));
    if (abut_law_needs_open_start(i.input.method.options.law))
      i.push_inside(displacement);
    else
      i.start.set_state(i.source->relax(i.host.stiffness("relax()", tangent),
                                        residual, i.rows.gap, n_sweeps,
                                        displacement));
    i.start_displacement = displacement;
    i.compute_gap(displacement);
  }

  template <int dim>
  LinearReport
  ContactAssembler<dim>::solve(const Tangent &tangent,
                               const la::VectorView &given_residual,
                               const la::MutableVectorView &given_increment)
  {
    auto &i = *implementation;
    i.check_rows("solve()");
    i.host.check_places("solve()");
    const solve::Stiffness matrix = i.host.constant_stiffness(
        "solve()", tangent,
        !i.input.constant_matrix || i.system.has_new_matrix);
    const la::Vector &residual =
        i.host.residual("solve()", given_residual, !i.is_started);
    la::Vector &increment =
        i.host.mutable_vector("solve()", "increment", given_increment);
    i.prepare_solver(matrix);
    AssertThrow(!i.is_started || i.request.action == ABUT_ACTION_SOLVE,
                ExcMessage("The contact iteration has stopped: call detect() "
                           "to begin a new one."));
    // An infeasible start stops a barrier at once; update() then reports it.
    increment = 0.;
    if (!i.is_started)
      i.begin(matrix, residual);
    else
      i.residual_check.compare(matrix, residual, i.present_displacement,
                               i.scales.round_off());
    la::Vector moved;
    if (i.moving.has_geometry())
      moved = i.moving.with_geometry(residual);
    const la::Vector &forces = i.moving.has_geometry() ? moved : residual;
    LinearReport report;
    double tolerance = 0.;
    while (i.request.action == ABUT_ACTION_SOLVE
           || i.request.action == ABUT_ACTION_SOLVE_AGAIN)
    {
      report.n_systems += i.request.action == ABUT_ACTION_SOLVE;
      tolerance = i.request.linear_tolerance;
      report += i.system.solver->solve(forces, i.request,
                                       i.scales.smallest_residual, increment);
      i.next();
    }
    if (i.request.action == ABUT_ACTION_MOVE && i.request.step_length != 1.)
      increment *= i.request.step_length;
    i.moving.apply_substitution(increment);
    report.tolerance = tolerance;
    i.system.report += report;
    return report;
  }

  template <int dim>
  bool ContactAssembler<dim>::update(const la::VectorView &given_displacement)
  {
    auto &i = *implementation;
    const la::Vector &displacement =
        i.given("update()", "displacement", given_displacement);
    AssertThrow(i.is_started,
                ExcMessage("Call solve() or add() before update()."));
    if (i.request.action == ABUT_ACTION_STOP)
      return false;
    i.present_displacement = displacement;
    i.moving.move_to(displacement);
    std::vector<double> before;
    if (i.system.was_added)
      before.swap(i.rows.gap);
    i.update_gap(displacement);
    if (i.system.was_added)
    {
      for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
        i.request.gap_change[row] = i.rows.gap[row] - before[row];
      i.system.local.recover(i.request);
      i.system.was_added = false;
      i.next();
    }
    i.next();
    i.record_end();
    return i.request.action != ABUT_ACTION_STOP;
  }

  template <int dim>
  LinearReport ContactAssembler<dim>::solve_linearised(
      const Tangent &given_tangent, const la::VectorView &given_residual,
      const la::MutableVectorView &given_step)
  {
    auto &i = *implementation;
    const la::Vector &residual =
        i.given("solve_linearised()", "residual", given_residual);
    la::Vector &step =
        i.host.mutable_vector("solve_linearised()", "step", given_step);
    const Tangent tangent =
        i.host.stiffness("solve_linearised()", given_tangent);
    const la::Vector start(i.start_displacement);
    la::Vector end(start);
    const LinearReport cost =
        iterate_contact(*this, tangent, end,
                        [&](const la::Vector &present, la::Vector &forces)
                        {
                          la::Vector way(present);
                          way -= start;
                          tangent.vmult(forces, way);
                          forces += residual;
                          i.host.constraints().set_zero(forces);
                        });
    i.host.constraints().distribute(end);
    step = end;
    step -= start;
    return cost;
  }

  template <int dim>
  double ContactAssembler<dim>::evaluate(
      const la::VectorView &given_displacement,
      const la::MutableVectorView &given_forces) const
  {
    const auto &i = *implementation;
    const la::Vector &displacement =
        i.given("evaluate()", "displacement", given_displacement);
    la::Vector &forces =
        i.host.mutable_vector("evaluate()", "force", given_forces);
    AssertThrow(i.is_started, ExcMessage("Call solve() before evaluate()."));
    if (i.moves())
      return implementation->evaluate_moved(displacement, forces);
    forces = 0.;
    i.add_forces_of_law(forces);
    std::vector<double> gap(i.rows.coefficients.n_rows());
    i.rows.coefficients.gap(displacement, gap.data());
    i.rows.slip_reference.subtract_from(gap);
    double sum = 0.;
    for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
    {
      const double defect = i.law_defect(row, gap[row]);
      sum += i.rows.coefficients.weight(row) * i.scales.stiffness[row] * defect
             * defect;
    }
    return std::sqrt(dealii::Utilities::MPI::sum(sum, i.communicator));
  }

  template <int dim>
  void ContactAssembler<dim>::set_reference_stiffness(const Tangent &tangent)
  {
    auto &i = *implementation;
    i.host.check_mesh("set_reference_stiffness()");
    i.host.set_reference("set_reference_stiffness()", tangent);
    i.scales.law_compliance = la::Vector();
    i.system.has_new_matrix = true;
  }

  template <int dim>
  void ContactAssembler<dim>::set_length_scale(const double length)
  {
    AssertThrow(length >= 0. && std::isfinite(length),
                ExcMessage("A length scale must be positive, or 0."));
    implementation->scales.given_length = length;
  }

  template <int dim>
  double ContactAssembler<dim>::length_scale(
      const la::VectorView &given_displacement) const
  {
    const auto &i = *implementation;
    const la::Vector &displacement =
        i.given("length_scale()", "displacement", given_displacement);
    const double length = i.scales.length_scale(displacement);
    // Obstacles may come to bodies that rest.
    const bool may_come =
        i.surfaces != nullptr
        && (i.surfaces->set().has_steps()
            || std::any_of(i.input.pairs.begin(), i.input.pairs.end(),
                           [](const ContactPair<dim> &pair)
                           { return pair.may_be_apart; }));
    return length == 0. && may_come ? i.surfaces->set().facet_size() : length;
  }

  template <int dim> IterationReport ContactAssembler<dim>::iteration() const
  {
    const auto &i = *implementation;
    IterationReport result;
    result.progress = i.progress();
    result.reason = i.is_started ? i.request.reason : ABUT_REASON_NONE;
    result.failure = abut_reason_failure(
        result.reason, i.input.method.options.law, &result.progress);
    const std::string seen = shim::core_message(i.context.get());
    const bool failed = result.reason != ABUT_REASON_NONE
                        && result.reason != ABUT_REASON_CONVERGED;
    // Remedies for other methods that do not contract are of no use with
    // friction.
    const abut_failure_entry *known = abut_failure_get(result.failure);
    result.explanation =
        (known != nullptr && known->failure == ABUT_FAILURE_STICK_SLIP
             ? std::string(known->name) + ": " + known->remedy
             : std::string(abut_reason_text(result.reason)))
        + (failed && !seen.empty() ? " (" + seen + ")" : "");
    if (result.reason == ABUT_REASON_CONVERGED)
      for (const std::string &pair : i.pairs_without_rows())
        result.explanation +=
            ", but no node of '" + pair
            + "' has a constraint: nothing of it can touch. See "
              "ContactChecks::pairs() for the cause";
    return result;
  }

  template <int dim>
  const ContactResults<dim> &ContactAssembler<dim>::results() const
  {
    return *implementation->results;
  }

  template <int dim>
  const ContactChecks<dim> &ContactAssembler<dim>::checks() const
  {
    return *implementation->checks;
  }

  template <int dim> ContactState &ContactAssembler<dim>::state()
  {
    return *implementation->state;
  }

  template <int dim>
  Tangent ContactAssembler<dim>::copy_of(const Tangent &tangent) const
  {
    const auto &i = *implementation;
    i.host.check_mesh("copy_of()");
    return tangent.other() == nullptr ? tangent
                                      : i.host.stiffness("copy_of()", tangent);
  }

  template <int dim>
  la::Vector ContactAssembler<dim>::copy_of(const la::VectorView &vector) const
  {
    const auto &i = *implementation;
    i.host.check_mesh("copy_of()");
    return i.host.vector("copy_of()", "vector", vector);
  }

  template class ContactAssembler<2>;
  template class ContactAssembler<3>;
} // namespace abut

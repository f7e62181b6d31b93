// SPDX-License-Identifier: LGPL-2.1-or-later
// From a row source to a started strategy.
#include "contact_problem.h"

#include "agree.h"
#include "deformation.h"
#include "fnv_hash.h"
#include "host_cells.h"
#include "nodal_obstacle_rows.h"
#include "pair_detection.h"
#include "solve/make_row_solver.h"
#include "solve/row_stiffness.h"
#include "solve/unsupported_bodies.h"
#include "solver_space.h"

#include <abut/dealii/coded.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace abut::shim
{
  using dealii::ExcMessage;
  using dealii::types::global_dof_index;
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    abut_status reduce_over_ranks(void *user, const abut_reduction operation,
                                  double *values, const std::int32_t n)
    {
      const MPI_Comm communicator = *static_cast<const MPI_Comm *>(user);
      const int status = MPI_Allreduce(
          MPI_IN_PLACE, values, n, MPI_DOUBLE,
          operation == ABUT_REDUCTION_SUM ? MPI_SUM : MPI_MAX, communicator);
      return status == MPI_SUCCESS ? ABUT_SUCCESS : ABUT_CALLBACK_FAILED;
    }

    template <int dim>
    abut_status project_on_nodes(void *user, std::int32_t, double *values)
    {
      try
      {
        static_cast<const SurfaceRows<dim> *>(user)->multipliers().project(
            values);
      }
      catch (const std::exception &)
      {
        return ABUT_CALLBACK_FAILED;
      }
      return ABUT_SUCCESS;
    }

    /** Gaps below this part of the size of the smallest body are closed at the
     * start. */
    constexpr double touching = 1e-8;

    /** Whether the penalty is part of the answer. */
    bool is_penalty(const abut_law &law)
    {
      return abut_law_has_penalty(&law) && !abut_law_updates_multipliers(&law);
    }

    /** Number that distinguishes operators: their values, but for gaps. */
    std::uint64_t signature(const solve::PointOperator &rows)
    {
      FnvHash hash;
      const auto add = [&](const double value)
      {
        std::uint64_t word = 0;
        std::memcpy(&word, &value, sizeof(value));
        hash.mix(word);
      };
      for (int i = 0; i < rows.n_rows(); ++i)
      {
        hash.mix(rows.ids()[i]);
        hash.mix(rows.end(i) - rows.begin(i));
        add(rows.weight(i));
        for (auto e = rows.begin(i); e < rows.end(i); ++e)
        {
          hash.mix(rows.global_column(rows.column(e)));
          add(rows.coefficient(e));
        }
      }
      return hash.value;
    }

    /** Keep the counts of an exchange that is about to go. */
    template <int dim> void count_messages(ContactProblem<dim> &i)
    {
      if (i.surface_search.exchange == nullptr)
        return;
      const CommunicationReport sent =
          i.surface_search.exchange->communication();
      i.surface_search.sent_before.messages += sent.messages;
      i.surface_search.sent_before.bytes += sent.bytes;
      i.surface_search.sent_before.gathered_bytes += sent.gathered_bytes;
    }

    template <int dim>
    void find_rows(ContactProblem<dim> &i, const la::Vector &displacement)
    {
      i.rows.mesh = 0;
      const auto change = i.find_points(displacement);
      if (change == RowSource::Change::points)
        i.set_up_rows();
      else if (change == RowSource::Change::constants)
        i.rows.coefficients.renew_constants(i.source->nodes());
      if (i.input.is_nitsche())
      {
        i.nitsche.find(i.surfaces, i.rows.coefficients.n_rows(),
                       i.input.method.nitsche_theta);
        i.system.solver.reset();
      }
      i.rows.mesh = i.rows.points_mesh;
      i.find_slip_reference();
      i.start.find(i.start_rows(), i.history);
    }

    /** Find the points that were open at the last commit(), all of them before
     * the first, and that are farther from the other side than the nearest
     * point of their pair: those close later in the step. @p pressure: [rows]
     * then, empty if it is not known on this mesh. Collective. */
    template <int dim>
    void find_late(ContactProblem<dim> &i,
                   const RowSource::FrictionalPoints &points,
                   const std::vector<double> &pressure)
    {
      i.rows.late.clear();
      la::Vector start(i.committed.displacement());
      const bool is_first = start.size() == 0;
      if (is_first)
        start.reinit(i.host.owned(), i.communicator);
      std::vector<double> gap(i.rows.coefficients.n_rows());
      i.rows.coefficients.gap(start, gap.data());
      const std::vector<int> pair = i.surfaces->points().row_pairs();
      std::vector<double> nearest(i.input.pairs.size(), INFINITY);
      for (const std::int32_t row : points.first)
        nearest[pair[row]] = std::min(nearest[pair[row]], gap[row]);
      for (double &least : nearest)
        least = MPI::min(least, i.communicator);
      const double least =
          touching * smallest_body(i.near_null_space(), i.communicator);
      for (const std::int32_t row : points.first)
        if (gap[row] > nearest[pair[row]] + least
            && (is_first || (!pressure.empty() && !(pressure[row] > 0.))))
          i.rows.late.push_back(row);
    }

    /** Give the strategy its data of friction. Collective. */
    template <int dim> void set_friction(ContactProblem<dim> &i)
    {
      i.rows.diagonal.clear();
      i.rows.late.clear();
      const auto points_with_friction = i.source->friction();
      if (!points_with_friction.any)
        return;
      std::vector<double> traction, pressure;
      if (i.history.knows(ABUT_HISTORY_COMMITTED, i.rows.mesh))
      {
        pressure = i.history.pressures(i.rows.numbers(), i.rows.placed,
                                       ABUT_HISTORY_COMMITTED);
        for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
          if (i.rows.coefficients.is_tangent(row))
            traction.push_back(pressure[row]);
      }
      find_late(i, points_with_friction, pressure);
      abut_strategy_friction friction = {};
      friction.struct_size = sizeof(friction);
      friction.n = static_cast<std::int32_t>(points_with_friction.first.size());
      friction.first = points_with_friction.first.data();
      friction.n_tangents = points_with_friction.n_tangents.data();
      friction.coefficient = points_with_friction.coefficient.data();
      friction.cap = points_with_friction.cap.data();
      friction.tangent = points_with_friction.tangent.data();
      friction.reference_traction =
          traction.empty() ? nullptr : traction.data();
      if (!abut_law_has_penalty(i.input.method.options.law))
      {
        friction.n_rivals =
            static_cast<std::int32_t>(points_with_friction.rival_point.size());
        friction.rival_point = points_with_friction.rival_point.data();
        friction.rival_row = points_with_friction.rival_row.data();
      }
      i.input.method.set_law(friction);
      i.check(abut_strategy_set_friction(i.strategy.get(), &friction));
    }

    /** Data of the iteration that begins, for the solver. */
    template <int dim>
    solve::ContactIteration iteration_of(ContactProblem<dim> &i)
    {
      solve::ContactIteration result;
      result.gap = &i.rows.gap;
      result.start = &i.start_displacement;
      if (i.surfaces != nullptr)
      {
        result.group = i.surfaces->points().row_pairs();
        result.n_groups = i.input.pairs.size();
        if (i.committed.pressed())
          result.pressed = *i.committed.pressed();
      }
      result.approach = [&i](const std::vector<solve::RigidMotion> &motions,
                             const std::vector<std::uint8_t> &is_apart)
      { i.add_approach(motions, is_apart); };
      result.turns = i.moves() && i.input.method.turning_terms
                     && !i.start.is_pressed(i.communicator);
      result.load = std::max(i.scales.present_load, i.scales.committed_load);
      result.linear_tolerance = i.input.method.options.final_linear_tolerance;
      return result;
    }

    /** Throws if a matrix is needed. */
    template <int dim> void check_host(const ContactProblem<dim> &i)
    {
      const auto need = [](const bool is_wanted, const std::string &what)
      {
        AssertThrow(!is_wanted,
                    ExcMessage(what
                               + " needs the matrix of the tangent, "
                                 "not a HostOperator."));
      };
      using Linear = SolverParameters::Linear;
      need(i.input.is_nitsche(), "Nitsche's method");
      need(i.input.method.system == System::saddle_point,
           "Method/System = saddle point");
      need(i.moves(), "Contact with Method/Contact geometry = current");
      need(i.input.solver.linear == Linear::direct,
           "Solver/Linear solver = direct");
      need(i.input.solver.linear == Linear::geometric,
           "Solver/Linear solver = geometric");
    }

    /** Build the preconditioner that was loaded, if there is one. */
    template <int dim> void restore_preconditioner(ContactProblem<dim> &i)
    {
      if (i.system.kept_preconditioner.empty())
        return;
      const bool other_rows = i.system.kept_rows != i.rows.signature;
      if (!dealii::Utilities::MPI::logical_or(other_rows, i.communicator))
        i.system.solver->restore(i.system.kept_preconditioner);
      i.system.kept_preconditioner.clear();
    }
  } // namespace

  template <int dim>
  void ContactProblem<dim>::check(const abut_status status) const
  {
    shim::check_everywhere(communicator, context.get(), status);
  }

  template <int dim>
  void ContactProblem<dim>::check_law(const abut_status status) const
  {
    if (input.method.user_law == nullptr)
      check(status);
    else
      shim::check_everywhere<SolverFailure>(communicator, context.get(),
                                            status);
  }

  template <int dim>
  double ContactProblem<dim>::row_pressure(const int row) const
  {
    return is_started ? request.pressure[row] : start.pressure(row);
  }

  template <int dim>
  std::vector<double> ContactProblem<dim>::row_pressures() const
  {
    std::vector<double> result(rows.coefficients.n_rows());
    for (int row = 0; row < rows.coefficients.n_rows(); ++row)
      result[row] = row_pressure(row);
    return result;
  }

  template <int dim>
  void ContactProblem<dim>::add_forces(la::Vector &forces) const
  {
    std::vector<double> force = row_pressures();
    for (int row = 0; row < rows.coefficients.n_rows(); ++row)
      force[row] *= rows.coefficients.weights()[row];
    rows.coefficients.add_transposed(force.data(), forces);
  }

  template <int dim>
  void ContactProblem<dim>::add_forces_of_law(la::Vector &forces) const
  {
    AssertThrow(!input.is_nitsche(),
                ExcMessage("Forces of Nitsche's method do not "
                           "follow from its pressures alone."));
    add_forces(forces);
  }

  template <int dim> abut_progress ContactProblem<dim>::progress() const
  {
    abut_progress progress = {};
    // A strategy whose law fails is not started any more.
    if (is_started)
      if (const abut_status status =
              abut_strategy_progress(strategy.get(), &progress);
          status != ABUT_WRONG_ORDER)
        shim::check(context.get(), status);
    return progress;
  }

  template <int dim>
  std::vector<std::uint8_t> ContactProblem<dim>::row_states() const
  {
    if (is_started)
      return {request.state, request.state + rows.coefficients.n_rows()};
    return start.states(rows.coefficients);
  }

  template <int dim>
  double ContactProblem<dim>::law_defect(const int row,
                                         const double gap_there) const
  {
    if (rows.coefficients.bilateral()[row] == 0
        && !rows.coefficients.is_tangent(row)
        && request.state[row] == ABUT_STATE_OPEN
        && !abut_law_is_interior(input.method.options.law))
      return std::min(0., gap_there);
    const auto at = rows.diagonal.empty() ? row : rows.diagonal[row];
    const double a = request.d_pressure[at], b = request.d_gap[at];
    const double size =
        std::max(std::abs(b), std::abs(a) * scales.stiffness[row]);
    return size > 0. ? (request.residual[row] + b * (gap_there - rows.gap[row]))
                           / size
                     : 0.;
  }

  template <int dim>
  std::vector<std::string> ContactProblem<dim>::pairs_without_rows() const
  {
    std::vector<std::string> result;
    const std::vector<PairCheck> seen = checks->pairs();
    for (std::size_t p = 0; p < seen.size(); ++p)
      if (seen[p].n_rows == 0 && !input.pairs[p].may_be_apart)
        result.push_back(seen[p].name);
    return result;
  }

  template <int dim> void ContactProblem<dim>::check_committed()
  {
    if (surfaces == nullptr || !committed.is_given() || moves()
        || !history.knows(ABUT_HISTORY_COMMITTED, rows.mesh))
      return;
    constexpr double visible = 1e-2;
    const int n = rows.coefficients.n_rows();
    const std::vector<double> pressure =
        history.pressures(rows.numbers(), rows.placed, ABUT_HISTORY_COMMITTED);
    std::vector<double> gap(n);
    rows.coefficients.gap(committed.displacement(), gap.data());
    const std::vector<int> pair = surfaces->points().row_pairs();
    const double length =
        MPI::max(committed.displacement().linfty_norm(), communicator);
    for (std::size_t p = 0; p < input.pairs.size(); ++p)
    {
      double largest = 0.;
      for (int row = 0; row < n; ++row)
        if (pair[row] == static_cast<int>(p) && pressure[row] > 0.
            && rows.coefficients.bilateral()[row] == 0
            && !rows.coefficients.is_tangent(row))
          largest = std::max(largest, gap[row]);
      largest = MPI::max(largest, communicator);
      if (!(largest > visible * length))
        continue;
      std::ostringstream text;
      text << "points that pressed at the last commit() have gaps of up to "
           << largest << " at the displacement given to set_committed(), whose "
           << "largest value is " << length
           << ". Give it the displacement of that commit(), on this mesh and "
              "in the numbering of its unknowns.";
      surfaces->points().checks()[p].warnings.push_back(
          coded(ABUT_FAILURE_SLIDING, text.str(),
                {{"gap", largest}, {"displacement", length}}));
    }
  }

  template <int dim>
  const RowSource &ContactProblem<dim>::present_source() const
  {
    AssertThrow(source != nullptr,
                ExcMessage("There are no rows: call detect() first."));
    return *source;
  }

  template <int dim>
  void ContactProblem<dim>::check_rows(const std::string &call) const
  {
    host.check_mesh(call);
    AssertThrow(rows.are_found,
                ExcMessage("Call detect() before " + call
                           + ": there are no rows since the last "
                             "reinit()."));
  }

  template <int dim> void ContactProblem<dim>::create_source()
  {
    surfaces = nullptr;
    const bool has_obstacle = input.obstacle.lower || input.obstacle.upper;
    if (!input.pairs.empty() || (input.has_pairs && !has_obstacle))
    {
      auto made = std::make_unique<SurfaceRows<dim>>(
          PairHost<dim>{host.mapping(), host.dof_handler(), host.constraints(),
                        input.method, input.search, input.axisymmetric,
                        context.get(), surface_search.detection},
          input.pairs, surface_search.exchange);
      surfaces = made.get();
      surfaces->set().foresee_motion(surface_search.foreseen_motion);
      if (committed.displacement().size() > 0)
        surfaces->set().record_commit(committed.displacement());
      if (surface_search.exchange != surfaces->set().exchange())
        count_messages(*this);
      surface_search.exchange = surfaces->set().exchange();
      source = std::move(made);
    }
    else
    {
      AssertThrow(has_obstacle,
                  ExcMessage("There is no obstacle and no pair: call "
                             "set_obstacle() or set_pairs() first."));
      AssertThrow(
          host.dof_handler().get_fe().n_components() == 1,
          ExcMessage(
              "Obstacles need a scalar field: the finite element has "
              + std::to_string(host.dof_handler().get_fe().n_components())
              + " components."));
      const Message reason = obstacle_refusal(
          host.dof_handler(), !input.obstacle.boundary_ids.empty());
      if (!reason.empty())
        throw ObstacleError(reason);
      source = std::make_unique<NodalObstacleRows<dim>>(
          host.mapping(), host.dof_handler(), host.constraints(),
          input.obstacle);
    }
    source_is_outdated = false;
    system.bodies.reset();
  }

  template <int dim> void ContactProblem<dim>::clear_source()
  {
    count_messages(*this);
    surface_search.exchange.reset();
    source.reset();
    surfaces = nullptr;
    source_is_outdated = true;
  }

  template <int dim>
  solve::PointOperator
  ContactProblem<dim>::make_operator(abut_points *const made,
                                     PairPoints<dim> *const elsewhere)
  {
    abut_points_view view = {};
    check(abut_points_get(made, &view));
    // Rows between nodes that cannot move are no measure.
    std::vector<std::uint8_t> keep =
        solve::rows_with_columns(view, source->nodes());
    if (elsewhere == nullptr)
      source->drop_needless(keep);
    else
      shim::drop_needless(*elsewhere, keep);
    if (MPI::logical_or(std::count(keep.begin(), keep.end(), 0) > 0,
                        communicator))
    {
      if (elsewhere == nullptr)
        source->filter(keep);
      else
        elsewhere->filter(keep);
      check(abut_points_get(made, &view));
    }
    return solve::PointOperator(host.owned(), view, source->nodes(),
                                communicator);
  }

  template <int dim>
  RowSource::Change
  ContactProblem<dim>::find_points(const la::Vector &displacement)
  {
    if (rows.points == nullptr || rows.dimension != source->dimension())
    {
      rows.coefficients = solve::PointOperator();
      rows.dimension = source->dimension();
      rows.points = create_points(context.get(), rows.dimension);
    }
    if (surfaces != nullptr && input.makes_points_at_commits())
    {
      committed.check(
          "Points of ABUT_KINEMATICS_UPDATED are created at the positions of");
      surfaces->set().set_place(committed.displacement());
    }
    if (surfaces != nullptr)
      committed.give_poses(surfaces->set().obstacles());
    try
    {
      return source->find(displacement, rows.points.get());
    }
    catch (...)
    {
      // The remaining points are not the ones that these were made of.
      rows.coefficients = solve::PointOperator();
      throw;
    }
  }

  template <int dim> void ContactProblem<dim>::set_up_rows()
  {
    rows.coefficients = make_operator(rows.points.get());
    rows.n_rows =
        MPI::sum(static_cast<global_dof_index>(rows.coefficients.n_rows()),
                 communicator);
    // A solver is kept as long as it would be made of the same rows: in the
    // reference configuration they are the same in most load steps.
    const std::uint64_t before = rows.signature;
    rows.signature = signature(rows.coefficients);
    if (MPI::logical_or(before != rows.signature, communicator))
      system.solver.reset();
    rows.points_mesh = source->mesh_signature();
    rows.placed = source->placed_rows();
  }

  template <int dim>
  void ContactProblem<dim>::find_rows_in_reach(const la::Vector &displacement)
  {
    for (bool is_found = false; !is_found;)
      try
      {
        find_rows(*this, displacement);
        is_found = true;
      }
      catch (const ContactError &error)
      {
        if (error.message().failure != ABUT_FAILURE_NO_PARTNER
            || surfaces == nullptr
            || solve::are_supported(near_null_space(), communicator)
            || !widen_search())
          throw;
      }
  }

  template <int dim> void ContactProblem<dim>::find_slip_reference()
  {
    rows.slip_reference = {};
    rows.has_friction =
        MPI::logical_or(rows.coefficients.has_tangents(), communicator);
    if (!rows.has_friction)
      return;
    committed.check("Slips with friction are measured from");
    committed.give_poses(surfaces->set().obstacles());
    surfaces->slip().set_approach(
        committed.approach(input.pairs.size(), [&](const auto &motions)
                           { return displacement_of(motions); }));
    rows.slip_reference = source->slip_reference(committed.displacement());
  }

  template <int dim>
  la::Vector ContactProblem<dim>::displacement_of(
      const std::vector<solve::RigidMotion> &motions) const
  {
    const solve::NearNullSpace &space = near_null_space();
    la::Vector result(host.owned(), communicator);
    for (std::size_t i = 0; i < space.point.size(); ++i)
    {
      const solve::RigidMotion &motion =
          motions[space.body.empty() ? 0 : space.body[i]];
      if (space.component[i] < dim
          && (space.prescribed.empty() || space.prescribed[i] == 0))
        la::data(result)[i] =
            motion.translation[space.component[i]]
            + cross_product_3d(
                motion.rotation,
                dealii::Tensor<1, 3>(space.point[i]))[space.component[i]];
    }
    return result;
  }

  template <int dim> void ContactProblem<dim>::find_pressed()
  {
    if (!rows.has_friction
        || (committed.pressed()
            && committed.pressed()->size() == input.pairs.size()))
      return;
    std::vector<unsigned int> pressed(input.pairs.size(), 0);
    // Interior methods press everywhere.
    if (!abut_law_is_interior(input.method.options.law))
    {
      const std::vector<int> pair = surfaces->points().row_pairs();
      for (int row = 0; row < rows.coefficients.n_rows(); ++row)
        if (!rows.coefficients.is_tangent(row) && start.pressure(row) > 0.)
          pressed[pair[row]] = 1;
    }
    MPI::max(pressed, communicator, pressed);
    committed.set_pressed({pressed.begin(), pressed.end()});
  }

  template <int dim>
  void ContactProblem<dim>::add_approach(
      const std::vector<solve::RigidMotion> &motions,
      const std::vector<std::uint8_t> &is_apart)
  {
    if (!rows.has_friction)
      return;
    committed.add_approach(motions, is_apart);
    find_slip_reference();
  }

  template <int dim>
  void ContactProblem<dim>::compute_gap(const la::Vector &displacement)
  {
    rows.gap.resize(rows.coefficients.n_rows());
    rows.coefficients.gap(displacement, rows.gap.data());
    rows.slip_reference.subtract_from(rows.gap);
    raises.add_to(rows.coefficients, rows.gap);
    if (input.is_nitsche())
      nitsche.move_to(displacement);
  }

  template <int dim> const double *ContactProblem<dim>::law_gap()
  {
    return input.is_nitsche() ? nitsche.law_gap(rows.gap) : rows.gap.data();
  }

  template <int dim>
  void ContactProblem<dim>::begin_at(const la::Vector &displacement)
  {
    is_started = false;
    system.was_added = false;
    start_displacement = present_displacement = displacement;
    residual_check.clear();
    compute_gap(displacement);
    find_geometry();
  }

  template <int dim>
  void ContactProblem<dim>::begin(const solve::Stiffness &matrix,
                                  const la::Vector &residual)
  {
    std::vector<double> &stiffness = scales.stiffness;
    stiffness = solve::row_stiffness(scales.law_compliance, rows.coefficients);
    if (surfaces != nullptr)
      surfaces->multipliers().spread_stiffness(stiffness);
    scales.set(matrix, residual);
    residual_check.begin(matrix, residual, start_displacement);
    input.method.options.reduce = reduce_over_ranks;
    input.method.options.user = const_cast<MPI_Comm *>(&communicator);
    const bool has_space = surfaces != nullptr && surfaces->set().has_points();
    input.method.options.project = has_space ? project_on_nodes<dim> : nullptr;
    input.method.options.project_user = surfaces;
    abut_strategy_options options = input.method.options;
    go_on_with_penalty(options);
    if (system.tolerance > 0.)
      options.linear_tolerance = options.final_linear_tolerance =
          system.tolerance;
    // evaluate_moved() measures the remaining error, and the iteration does not
    // end before it is small.
    if (moves())
      options.traction_tolerance =
          std::max(options.traction_tolerance, 0.1 * system.tolerance);
    strategy = create_strategy(context.get(), options);
    set_friction(*this);

    if (!input.is_nitsche() && surfaces != nullptr
        && is_penalty(*input.method.options.law))
      surfaces->multipliers().make_uniform(stiffness);
    if (surfaces != nullptr)
      surfaces->multipliers().copy_to_tangents(stiffness);
    if (input.is_nitsche())
    {
      input.method.options.penalty =
          abut_strategy_first_penalty(&input.method.options);
      nitsche.set_penalty(input.method.options.penalty, stiffness);
    }
    if (surfaces != nullptr && !start.is_restarted()
        && !abut_law_is_interior(input.method.options.law))
    {
      std::vector<double> scale(stiffness);
      for (double &c : scale)
        c *= input.method.options.complementarity;
      start.set_state(surfaces->multipliers().first_contact(
          rows.gap, start.pressure(), scale,
          touching * smallest_body(near_null_space(), communicator)));
    }
    if (system.solver != nullptr)
      system.solver->begin_iteration(iteration_of(*this));
    check_law(abut_strategy_start(
        strategy.get(), rows.coefficients.n_rows(), rows.coefficients.ids(),
        rows.coefficients.weights(), stiffness.data(),
        rows.coefficients.bilateral(), law_gap(),
        start.pressure().empty() ? nullptr : start.pressure().data(),
        start.state().empty() ? nullptr : start.state().data()));
    next();
    const solve::RowBlocks blocks(request);
    for (int block = 0; !blocks.empty() && block < blocks.n_blocks(); ++block)
      for (int r = 0, k = blocks.size(block); r < k; ++r)
        rows.diagonal.push_back(blocks.at[block] + std::int64_t(r) * (k + 1));
    start.give_field(la::Vector()); // is in the history now
    is_started = true;
  }

  template <int dim> void ContactProblem<dim>::record_end()
  {
    system.undetermined.clear();
    system.followed_motions.clear();
    if (request.action == ABUT_ACTION_STOP && system.solver != nullptr)
      system.undetermined = system.solver->end_iteration(request);
  }

  template <int dim> bool ContactProblem<dim>::widen_search()
  {
    // Parts of the size of the smallest body.
    constexpr double first = 0.5, growth = 4., last = 8.;
    if (surfaces == nullptr)
      return false;
    const double size = smallest_body(near_null_space(), communicator);
    const double next = surface_search.foreseen_motion > 0.
                            ? growth * surface_search.foreseen_motion
                            : first * size;
    if (next > 1.001 * last * size || size == 0.)
      return false;
    surface_search.foreseen_motion = next;
    surfaces->renew_points();
    surfaces->set().foresee_motion(next);
    return true;
  }

  template <int dim>
  const solve::NearNullSpace &ContactProblem<dim>::near_null_space() const
  {
    if (!system.bodies)
    {
      // Nitsche's method and hosts have their own multigrid.
      SolverParameters parameters = input.solver;
      if (input.is_nitsche() || !system.has_matrix)
        parameters.linear = SolverParameters::Linear::iterative;
      system.bodies = make_solver_space(host.mapping(), host.dof_handler(),
                                        host.constraints(), surfaces != nullptr,
                                        parameters, host.vertex_origins());
      system.bodies->names = input.body_names;
      system.bodies->reuses_factors = moves();
    }
    return *system.bodies;
  }

  template <int dim>
  void ContactProblem<dim>::prepare_solver(const solve::Stiffness &of_host)
  {
    if (of_host.has_matrix() != system.has_matrix)
    {
      system.solver.reset();
      system.bodies.reset();
    }
    system.has_matrix = of_host.has_matrix();
    if (!system.has_matrix)
      check_host(*this);
    const bool is_renewed = system.solver != nullptr && input.constant_matrix;
    if (is_renewed && !system.has_new_matrix)
      return;
    system.has_new_matrix = false;
    scales.find_compliance(of_host);
    const solve::Stiffness matrix =
        system.has_matrix && moving.has_geometry()
            ? solve::Stiffness(moving.with_geometry(of_host.matrix()))
            : of_host;
    if (system.solver == nullptr)
    {
      if (input.is_nitsche())
        system.solver = std::make_unique<solve::NitscheSolver>(input.solver,
                                                               nitsche.terms());
      else
        system.solver =
            solve::make_row_solver(input.method.system, input.solver,
                                   rows.coefficients, system.has_matrix);
      system.solver->set_near_null_space(near_null_space());
    }
    if (moves())
      system.solver->set_bodies(of_host);
    if (is_renewed)
    {
      system.solver->renew(matrix, rows.coefficients, scales.row_stiffness);
      return;
    }
    system.solver->reinit(matrix, rows.coefficients, scales.row_stiffness);
    restore_preconditioner(*this);
  }

  template <int dim> void ContactProblem<dim>::next()
  {
    check_law(abut_strategy_next(strategy.get(), law_gap(), &request));
  }

  template <int dim>
  void ContactProblem<dim>::push_inside(la::Vector &displacement)
  {
    // On the path of the barrier p g = mu, as far as the start knows p.
    double largest = 0.;
    for (const double p : start.pressure())
      largest = std::max(largest, p);
    largest = MPI::max(largest, communicator);
    const bool warm = largest > 0.;
    const double barrier =
        warm ? std::min(1e-4, input.method.options.barrier_start)
             : input.method.options.barrier_start;
    std::vector<double> margin(rows.coefficients.n_rows(),
                               barrier * scales.length_scale());
    if (warm)
      for (int i = 0; i < rows.coefficients.n_rows(); ++i)
        margin[i] *= largest / std::max(start.pressure(i), 1e-2 * largest);
    source->push_inside(rows.gap, margin, displacement);
  }

  template struct ContactProblem<2>;
  template struct ContactProblem<3>;
} // namespace abut::shim

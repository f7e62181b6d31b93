// SPDX-License-Identifier: LGPL-2.1-or-later
// Rows that move with the bodies: they are made at each linearisation, and go
// on from what rows of the same number had; what their forces change by because
// their directions do is a part of the tangent.
#include "contact_problem.h"

#include "solve/row_stiffness.h"

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** How gaps change because directions and partners do. Collective. */
    template <int dim> void find_substitution(ContactProblem<dim> &i)
    {
      // A row that is far open does not close in this linearisation, or as if
      // it were straight: its lever would move its node by too much.
      const double near = 0.3 * i.surfaces->set().facet_size();
      std::vector<std::uint8_t> wanted(i.rows.coefficients.n_rows());
      for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
        wanted[row] = i.row_pressure(row) > 0. || i.rows.gap[row] < near;
      i.moving.set_substitution(i.rows.coefficients,
                                i.source->gap_lines(wanted));
    }

    /** Another set of points, by the operator of its rows. */
    struct RowsElsewhere
    {
      Handle<abut_points> points;
      solve::PointOperator rows;
      RowSource::SlipReference slip_reference;
    };

    /** The rows at this displacement, while the present ones stay. Collective.
     */
    template <int dim>
    RowsElsewhere rows_at(ContactProblem<dim> &i,
                          const la::Vector &displacement)
    {
      RowsElsewhere result;
      result.points = create_points(i.context.get(), i.rows.dimension);
      i.surfaces->points().displacements_in_reach(displacement);
      i.surfaces->renew_points();
      PairPoints<dim> elsewhere(i.surfaces->set());
      i.surfaces->find_elsewhere(displacement, result.points.get(), elsewhere);
      // Tangents have their numbers by those of their point that stay.
      result.rows = i.make_operator(result.points.get(), &elsewhere);
      if (i.rows.has_friction)
        result.slip_reference =
            i.surfaces->slip().reference(elsewhere, i.committed.displacement());
      const abut_points_view &view = i.surfaces->points().view();
      std::vector<std::uint8_t> pressing(view.n_points);
      for (std::int32_t k = 0; k < view.n_points; ++k)
        pressing[k] = i.request.pressure[view.component_start[k]] > 0.;
      abut_place_changes changes;
      check(i.context.get(),
            abut_points_count_changes(i.surfaces->points().handle(),
                                      elsewhere.handle(), pressing.data(),
                                      &changes));
      i.moving.add_changes({static_cast<unsigned int>(changes.lost),
                            static_cast<unsigned int>(changes.jumped)});
      return result;
    }
  } // namespace

  template <int dim> bool ContactProblem<dim>::moves() const
  {
    if (source != nullptr && !source_is_outdated)
      return source->moves();
    return kinematics_info(input.method.kinematics).directions
               == ABUT_CONFIGURATION_CURRENT
           && std::any_of(input.pairs.begin(), input.pairs.end(),
                          [](const ContactPair<dim> &pair)
                          { return !pair.tied; });
  }

  template <int dim> RowValues ContactProblem<dim>::row_values() const
  {
    RowValues values;
    values.has_states = is_started || !start.state().empty();
    for (int row = 0; row < rows.coefficients.n_rows(); ++row)
      values.of[rows.coefficients.ids()[row]] = {
          row_pressure(row), is_started              ? request.state[row]
                             : start.state().empty() ? std::uint8_t(0)
                                                     : start.state()[row]};
    return values;
  }

  template <int dim>
  void ContactProblem<dim>::move_rows(const la::Vector &displacement,
                                      const RowValues &before)
  {
    record_present();
    start.set_restarted(start.is_restarted() || is_started);
    find_points(displacement);
    set_up_rows();
    // An iterate may have moved bodies far, and the next one back.
    check_approach(displacement);
    find_slip_reference();
    start.go_on(start_rows(), before);
  }

  template <int dim> void ContactProblem<dim>::find_geometry()
  {
    moving.clear();
    if (!moves())
      return;
    // The solver keeps what it was made of until it gets the next one.
    system.has_new_matrix = true;
    if (!input.method.turning_terms)
      return;
    const std::vector<MatrixLine> lines =
        source->geometric_lines(row_pressures().data());
    if (!MPI::logical_or(!lines.empty(), communicator))
      return;
    moving.set_geometry(lines, start_displacement);
    find_substitution(*this);
  }

  template <int dim>
  void ContactProblem<dim>::update_gap(const la::Vector &displacement)
  {
    compute_gap(moving.linear_displacement(displacement));
  }

  template <int dim>
  void ContactProblem<dim>::follow(const la::Vector &displacement)
  {
    const std::vector<std::int64_t> before = rows.numbers();
    if (system.solver != nullptr)
      system.followed_motions = system.solver->rigid_motions(displacement);
    surfaces->points().displacements_in_reach(displacement);
    PairPoints<dim> kept = surfaces->points();
    Handle<abut_points> old_points = std::move(rows.points);
    find_points(displacement);
    set_up_rows();
    // Rows come and go where gaps are as large as the reach: then the rows of
    // the last linearisation suffice.
    if (MPI::logical_or(before != rows.numbers(), communicator))
    {
      rows.points = std::move(old_points);
      surfaces->restore(std::move(kept));
      set_up_rows();
      find_slip_reference();
      return;
    }
    find_slip_reference();
    compute_gap(displacement);
  }

  template <int dim>
  double ContactProblem<dim>::evaluate_moved(const la::Vector &displacement,
                                             la::Vector &forces)
  {
    std::map<std::int64_t, int> row_of;
    for (int row = 0; row < rows.coefficients.n_rows(); ++row)
      row_of[rows.coefficients.ids()[row]] = row;
    const RowsElsewhere there = rows_at(*this, displacement);
    const solve::PointOperator &moved = there.rows;
    const int n = moved.n_rows();
    const std::vector<double> stiffness_there =
        solve::row_stiffness(scales.law_compliance, moved);
    std::vector<double> gap_there(n), force(n, 0.);
    moved.gap(displacement, gap_there.data());
    there.slip_reference.subtract_from(gap_there);
    raises.add_to(moved, gap_there);
    double sum = 0.;
    for (int row = 0; row < n; ++row)
    {
      if (moved.begin(row) == moved.end(row)) // between nodes that cannot move
        continue;
      const auto it = row_of.find(moved.ids()[row]);
      double defect = moved.is_tangent(row) ? 0. : std::min(0., gap_there[row]);
      if (it != row_of.end())
      {
        force[row] = moved.weight(row) * request.pressure[it->second];
        defect = law_defect(it->second, gap_there[row]);
        row_of.erase(it);
      }
      sum += moved.weight(row) * stiffness_there[row] * defect * defect;
    }
    forces = 0.;
    moved.add_transposed(force.data(), forces);
    // Rows that are gone there, as where a surface ends, press as before until
    // the next linearisation: no part of a step could balance without them.
    std::vector<double> gone(rows.coefficients.n_rows(), 0.);
    for (const auto &[id, row] : row_of)
      gone[row] = rows.coefficients.weight(row) * request.pressure[row];
    rows.coefficients.add_transposed(gone.data(), forces);
    return std::sqrt(MPI::sum(sum, communicator));
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template bool ContactProblem<dim>::moves() const;                            \
  template RowValues ContactProblem<dim>::row_values() const;                  \
  template void ContactProblem<dim>::move_rows(const la::Vector &,             \
                                               const RowValues &);             \
  template void ContactProblem<dim>::find_geometry();                          \
  template void ContactProblem<dim>::update_gap(const la::Vector &);           \
  template void ContactProblem<dim>::follow(const la::Vector &);               \
  template double ContactProblem<dim>::evaluate_moved(const la::Vector &,      \
                                                      la::Vector &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

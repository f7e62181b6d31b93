// SPDX-License-Identifier: LGPL-2.1-or-later
// The start of a solve, and the history that it leaves.
//
//   detect()     the rows' values so far become the trial version of the
//                history; rows of the next solve look theirs up by number
//   linearise()  the same rows go on from what they have
//   reinit()     entries stay where they are, though points may go to other
//                ranks; they are used again if set_pressure() has the same
//   set_pairs()  of other surfaces: numbers are others, the field of pressures
//                is what remains
//   commit()     the trial version is kept; rollback() brings it back
#include "contact_implementation.h"

#include <algorithm>

namespace abut
{
  template <int dim>
  void ContactAssembler<dim>::Implementation::record_present()
  {
    if (!is_started)
      return;
    // A strategy whose law fails is not started any more: 0 then.
    abut_progress progress = {};
    abut_strategy_progress(strategy.get(), &progress);
    penalty.reached = progress.penalty;
    history.record(rows_mesh, row_numbers(), placed_rows, row_pressures(),
                   row_states(), penalty);
  }

  template <int dim>
  std::vector<std::int64_t>
  ContactAssembler<dim>::Implementation::row_numbers() const
  {
    return {coefficients.ids(), coefficients.ids() + coefficients.n_rows()};
  }

  template <int dim> void ContactAssembler<dim>::Implementation::limit_start()
  {
    // A law of the user's may pull.
    if (abut_law_find(method.options.law->name) != method.options.law)
      return;
    for (int i = 0; i < coefficients.n_rows(); ++i)
      if (coefficients.bilateral()[i] == 0 && !coefficients.is_tangent(i))
        start_pressure[i] = std::max(0., start_pressure[i]);
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::start_from_history()
  {
    start_pressure = history.pressures(row_numbers(), placed_rows);
    resumed = history.penalty_to_resume();
    limit_start();
  }

  template <int dim> void ContactAssembler<dim>::Implementation::keep_field()
  {
    if (source != nullptr && rows_mesh != 0 && !is_forgotten)
      kept_field = source->pressure(row_pressures().data());
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::start_from_field(
      const la::Vector &given)
  {
    start_pressure = source->row_pressure(given);
    limit_start();
    if (history.knows(ABUT_HISTORY_TRIAL, rows_mesh))
    {
      // The field that the rows' own values make stands for these values.
      constexpr double same_field = 1e-8;
      const std::vector<double> own =
          history.pressures(row_numbers(), placed_rows);
      const la::Vector field = source->pressure(own.data());
      la::Vector difference(field);
      difference = given;
      difference -= field;
      if (difference.linfty_norm() <= same_field * field.linfty_norm())
      {
        start_from_history();
        return;
      }
    }
    history.record(rows_mesh, row_numbers(), placed_rows, start_pressure,
                   row_states(), shim::ContactHistory::Penalty());
    // Only this can be restored from another mesh.
    if (!history.knows(ABUT_HISTORY_COMMITTED, rows_mesh))
      history.commit();
  }

  template <int dim> void ContactAssembler<dim>::Implementation::find_start()
  {
    start_pressure.clear();
    resumed = shim::ContactHistory::Penalty();
    if (given_field.size() > 0)
      start_from_field(given_field);
    else if (is_forgotten)
      history.forget_trial();
    else if (history.knows(ABUT_HISTORY_TRIAL, rows_mesh))
      start_from_history();
    else if (kept_field.size() > 0)
      start_from_field(kept_field);
    kept_field = la::Vector();
    is_forgotten = false;
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::go_on_with_penalty(
      abut_strategy_options &options)
  {
    penalty = {
        std::string(options.law->name).substr(0, ABUT_HISTORY_LAW_BYTES - 1),
        abut_strategy_first_penalty(&options), 0.};
    if (resumed.reached > 0. && resumed.law == penalty.law
        && resumed.first == penalty.first)
      options.penalty = resumed.reached;
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::start_from_present()
  {
    start_pressure = row_pressures();
    limit_start();
    is_restarted = true;
    start_state.clear();
    if (!abut_law_is_interior(method.options.law))
      start_state.assign(request.state, request.state + coefficients.n_rows());
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::abandon_iteration()
  {
    is_started = is_restarted = was_added = false;
    given_field = la::Vector();
    start_state.clear();
    iteration_tolerance = 0.;
  }

  template <int dim>
  void ContactAssembler<dim>::Implementation::return_to_history()
  {
    abandon_iteration();
    is_forgotten = false;
    start_pressure.clear();
    if (history.knows(ABUT_HISTORY_TRIAL, rows_mesh))
      start_from_history();
  }

  template <int dim> void ContactAssembler<dim>::Implementation::record_poses()
  {
    committed_poses.clear();
    committed_times.clear();
    for (const ContactPair<dim> &pair : pairs)
    {
      committed_poses.push_back(
          pair.obstacle == nullptr ? RigidPose<dim>() : pair.obstacle->pose());
      committed_times.push_back(
          pair.obstacle == nullptr ? 0. : pair.obstacle->time());
    }
  }

  template <int dim>
  void ContactAssembler<dim>::commit(const la::VectorView &given_displacement)
  {
    Implementation &i = *implementation;
    i.check_mesh("commit()");
    const la::Vector &displacement =
        i.checked_vector("commit()", "displacement", given_displacement);
    i.record_present();
    i.history.commit();
    i.committed_load = std::max(i.committed_load, i.present_load);
    i.approach.clear();
    if (i.surfaces != nullptr && i.has_rows)
      i.elements.commit(i.surfaces->points().contact_elements(),
                        i.communicator);
    if (i.surfaces != nullptr)
      i.surfaces->set().record_commit(displacement);
    // Pairs with friction may be out of reach of each other as yet. Pairs that
    // reach each other later need a reference of slips.
    const bool is_wanted = i.makes_points_at_commits()
                           || std::any_of(i.pairs.begin(), i.pairs.end(),
                                          [](const ContactPair<dim> &pair)
                                          { return pair.friction != nullptr; });
    i.committed = is_wanted ? displacement : la::Vector();
    i.committed_is_lost = !is_wanted;
    i.record_poses();
    if (!is_wanted)
      return;
    if (i.has_rows)
      i.find_slip_reference();
  }

  template <int dim>
  void
  ContactAssembler<dim>::set_committed(const la::VectorView &given_displacement)
  {
    Implementation &i = *implementation;
    i.check_mesh("set_committed()");
    const la::Vector &displacement =
        i.checked_vector("set_committed()", "displacement", given_displacement);
    i.committed = displacement;
    i.approach.clear();
    i.committed_is_lost = false;
    if (i.surfaces != nullptr)
      i.surfaces->set().record_commit(displacement);
    i.record_poses();
    if (i.has_rows)
      i.find_slip_reference();
  }

  template <int dim> void ContactAssembler<dim>::rollback()
  {
    implementation->history.rollback();
    implementation->return_to_history();
  }

  template <int dim> void ContactAssembler<dim>::save(std::ostream &stream)
  {
    Implementation &i = *implementation;
    i.history.save(stream);
    i.elements.save(stream, i.communicator);
    if (i.surfaces != nullptr)
      i.exchange->self_contact().save(stream);
    // Who loads has no preconditioner, nor points that were made earlier: then
    // neither should this run.
    i.solver.reset();
    if (i.surfaces != nullptr)
      i.surfaces->renew_points();
  }

  template <int dim> void ContactAssembler<dim>::load(std::istream &stream)
  {
    Implementation &i = *implementation;
    i.check_mesh("load()");
    if (i.source_is_outdated)
      i.create_source();
    const std::uint64_t mesh = i.source->mesh_signature();
    shim::ContactElements elements;
    i.history.load(stream, mesh,
                   [&]
                   {
                     elements.load(stream, i.communicator);
                     if (i.surfaces != nullptr)
                       i.surfaces->load_sides(stream);
                   });
    i.elements = std::move(elements);
    // Displacements are the host's to keep: that of the commit() must come from
    // there, or slips would be measured from the reference configuration.
    if (i.committed.size() == 0
        && i.history.knows(ABUT_HISTORY_COMMITTED, mesh))
      i.committed_is_lost = true;
    i.return_to_history();
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void ContactAssembler<dim>::Implementation::record_present();       \
  template void ContactAssembler<dim>::Implementation::find_start();           \
  template void ContactAssembler<dim>::Implementation::keep_field();           \
  template void ContactAssembler<dim>::Implementation::go_on_with_penalty(     \
      abut_strategy_options &);                                                \
  template void ContactAssembler<dim>::Implementation::start_from_present();   \
  template void ContactAssembler<dim>::Implementation::abandon_iteration();    \
  template void ContactAssembler<dim>::Implementation::return_to_history();    \
  template void ContactAssembler<dim>::commit(const la::VectorView &);         \
  template void ContactAssembler<dim>::set_committed(const la::VectorView &);  \
  template void ContactAssembler<dim>::rollback();                             \
  template void ContactAssembler<dim>::save(std::ostream &);                   \
  template void ContactAssembler<dim>::load(std::istream &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut

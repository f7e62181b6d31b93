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
#include "contact_problem.h"

#include <algorithm>

namespace abut
{
  template <int dim> void shim::ContactProblem<dim>::record_present()
  {
    if (!is_started)
      return;
    // A strategy whose law fails is not started any more: 0 then.
    abut_progress progress = {};
    abut_strategy_progress(strategy.get(), &progress);
    penalty.reached = progress.penalty;
    history.record(rows.mesh, rows.numbers(), rows.placed, row_pressures(),
                   row_states(), penalty);
  }

  template <int dim>
  shim::StartRows shim::ContactProblem<dim>::start_rows() const
  {
    // A law of the user's may pull.
    return {*source, rows.coefficients, rows.placed, rows.mesh,
            abut_law_find(input.method.options.law->name)
                != input.method.options.law};
  }

  template <int dim>
  void
  shim::ContactProblem<dim>::go_on_with_penalty(abut_strategy_options &options)
  {
    penalty = {
        std::string(options.law->name).substr(0, ABUT_HISTORY_LAW_BYTES - 1),
        abut_strategy_first_penalty(&options), 0.};
    const double reached = start.resumed_penalty(penalty);
    if (reached > 0.)
      options.penalty = reached;
  }

  template <int dim> void shim::ContactProblem<dim>::start_from_present()
  {
    std::vector<std::uint8_t> state;
    if (!abut_law_is_interior(input.method.options.law))
      state = row_states();
    start.go_on(start_rows(), row_pressures(), std::move(state));
  }

  template <int dim> void shim::ContactProblem<dim>::abandon_iteration()
  {
    is_started = system.was_added = false;
    start.abandon();
    system.tolerance = 0.;
  }

  template <int dim> void shim::ContactProblem<dim>::return_to_history()
  {
    abandon_iteration();
    if (system.bodies)
      solve::forget_factors(*system.bodies->kept);
    moving.forget_pattern();
    if (source == nullptr)
      start.return_to_history(nullptr, history);
    else
    {
      const shim::StartRows rows = start_rows();
      start.return_to_history(&rows, history);
    }
  }

  template <int dim>
  void ContactAssembler<dim>::commit(const la::VectorView &given_displacement)
  {
    auto &i = *implementation;
    i.host.check_mesh("commit()");
    const la::Vector &displacement =
        i.host.vector("commit()", "displacement", given_displacement);
    i.record_present();
    i.history.commit();
    if (i.system.bodies)
      solve::forget_factors(*i.system.bodies->kept);
    i.moving.forget_pattern();
    i.scales.committed_load =
        std::max(i.scales.committed_load, i.scales.present_load);
    if (i.surfaces != nullptr && i.rows.are_found)
      i.surface_search.elements.commit(i.surfaces->points().contact_elements(),
                                       i.communicator);
    if (i.surfaces != nullptr)
      i.surfaces->set().record_commit(displacement);
    // Pairs with friction may be out of reach of each other as yet. Pairs that
    // reach each other later need a reference of slips.
    const bool is_wanted =
        i.input.makes_points_at_commits()
        || std::any_of(i.input.pairs.begin(), i.input.pairs.end(),
                       [](const ContactPair<dim> &pair)
                       { return pair.friction != nullptr; });
    i.committed.forget_pressed();
    i.committed.record(is_wanted ? displacement : la::Vector(), is_wanted,
                       i.input.pairs);
    if (!is_wanted)
      return;
    if (i.rows.are_found)
      i.find_slip_reference();
  }

  template <int dim> void ContactAssembler<dim>::rollback()
  {
    implementation->history.rollback();
    implementation->return_to_history();
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template shim::StartRows shim::ContactProblem<dim>::start_rows() const;      \
  template void shim::ContactProblem<dim>::record_present();                   \
  template void shim::ContactProblem<dim>::go_on_with_penalty(                 \
      abut_strategy_options &);                                                \
  template void shim::ContactProblem<dim>::start_from_present();               \
  template void shim::ContactProblem<dim>::abandon_iteration();                \
  template void shim::ContactProblem<dim>::return_to_history();                \
  template void ContactAssembler<dim>::commit(const la::VectorView &);         \
  template void ContactAssembler<dim>::rollback();

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut

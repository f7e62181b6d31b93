// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NODAL_FORCES_H
#define ABUT_APP_NODAL_FORCES_H

/** @file
 * The forces at the nodes by where they come from, as columns of a table.
 */

#include "app/pictures/nodal_table.h"
#include "contact_run_state.h"

#include "app/physics/discrete_problem.h"

#include <vector>

namespace abut::app
{
  /** Forces on the body beside loads, at all unknowns but hanging ones. */
  struct AppliedForces
  {
    la::Vector contact, reaction;
  };

  /** Those at the present displacement of @p run, see force_columns().
   * Collective. */
  template <int dim>
  AppliedForces applied_forces(const DiscreteProblem<dim> &problem,
                               const ContactRunState<dim> &run,
                               const NodalForces &forces, bool has_contact,
                               const la::Vector *unbalanced = nullptr);

  /** Columns `load`, `contact`, `reaction` and `held` (1 where a value is
   * prescribed): forces on the body at the
   * present displacement of @p run, whose nodal forces are @p forces, hanging
   * nodes by their parents, so that the sums are those of the bodies. Laws that
   * need the stress have no forces of their own at free nodes: theirs are what
   * is left of balance there. @p has_contact: whether there are rows at all. @p
   * unbalanced: what supports and contact hold, if it is not internal minus
   * external forces, as in a motion; or null. Collective. */
  template <int dim>
  std::vector<NodalColumn>
  force_columns(const DiscreteProblem<dim> &problem,
                const ContactRunState<dim> &run, const NodalForces &forces,
                bool has_contact, const la::Vector *unbalanced = nullptr);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_WORKS_H
#define ABUT_APP_WORKS_H

/** @file
 * What the forces of an answer do on its displacement, against what is stored.
 */

#include "app/physics/discrete_problem.h"
#include "contact_run_state.h"

namespace abut::app
{
  /** Works of the forces at all nodes on the whole displacement. In linear
   * statics what is stored twice is what all of them do together. */
  struct Works
  {
    double stored = 0.;    ///< by the internal forces: twice the energy
    double given = 0.;     ///< by loads and supports
    double contact = 0.;   ///< by contact
    double size = 0.;      ///< sum of the magnitudes of these two, by unknown
    double force = 0.;     ///< sum of the magnitudes of forces of contact
    double apart = 0.;     ///< if each unknown moved by itself
    double open_gaps = 0.; ///< by contact on gaps that are left at the end
    double before = 0.;    ///< largest energy that earlier answers had
  };

  /** Works at the present displacement of @p run, without `open_gaps`.
   * @param contact gets the forces of contact at the nodes, owned. Collective.
   */
  template <int dim>
  Works find_works(const DiscreteProblem<dim> &problem,
                   const ContactRunState<dim> &run, bool has_contact,
                   la::Vector &contact);
} // namespace abut::app

#endif

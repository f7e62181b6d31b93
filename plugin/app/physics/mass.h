// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MASS_H
#define ABUT_APP_MASS_H

/** @file
 * Mass matrices of bodies.
 */

#include "discrete_problem.h"

#include <abut/time.h>

#include <set>

namespace abut::app
{
  /** What a mass matrix is made of. */
  template <int dim> struct MassData
  {
    using Density = std::function<std::vector<double>(
        dealii::types::material_id, const std::vector<dealii::Point<dim>> &)>;

    /** Mass by volume of the mesh at points of a cell with this material id;
     * may throw InputError. */
    Density density;
    abut_time_mass kind = ABUT_TIME_MASS_MODIFIED;
    /** The secondary surfaces: their nodes have no mass if it is modified. */
    std::set<dealii::types::boundary_id> candidates;
  };

  /** The mass matrix over all unknowns, see whole_matrix(): the same for each
   * component. Throws InputError where a cell has no node that could take the
   * mass of the others. Collective. */
  template <int dim>
  la::Matrix mass_matrix(const DiscreteProblem<dim> &problem,
                         const MassData<dim> &data);

  /** The part of @p mass between unknowns that nothing prescribes.
   * Collective. */
  template <int dim>
  la::Matrix free_part(const DiscreteProblem<dim> &problem,
                       const la::Matrix &mass);
} // namespace abut::app

#endif

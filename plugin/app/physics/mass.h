// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MASS_H
#define ABUT_APP_MASS_H

/** @file
 * Mass matrices of bodies.
 */

#include "discrete_problem.h"
#include "material.h"

#include <abut/time.h>

#include <map>
#include <set>

namespace abut::app
{
  /** What a mass matrix is made of. */
  struct MassData
  {
    /** By material id of the cells. */
    std::map<dealii::types::material_id, double> density;
    abut_time_mass kind = ABUT_TIME_MASS_MODIFIED;
    /** The secondary surfaces: their nodes have no mass if it is modified. */
    std::set<dealii::types::boundary_id> candidates;
  };

  /** The mass matrix over all unknowns, prescribed ones included; hanging nodes
   * by their parents, with empty rows of their own. Throws InputError where a
   * cell has no node that could take the mass of the others. Collective. */
  template <int dim>
  la::Matrix mass_matrix(const DiscreteProblem<dim> &problem,
                         const Materials<dim> &materials, const MassData &data);

  /** The part of @p mass between unknowns that nothing prescribes.
   * Collective. */
  template <int dim>
  la::Matrix free_part(const DiscreteProblem<dim> &problem,
                       const la::Matrix &mass);
} // namespace abut::app

#endif

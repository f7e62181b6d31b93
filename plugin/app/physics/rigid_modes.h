// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RIGID_MODES_H
#define ABUT_APP_RIGID_MODES_H

#include "material.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace abut::app
{
  /** How a body can move without strain and without moving a support. */
  struct RigidFreedom
  {
    unsigned int n_modes = 0;
    std::vector<bool> translations; ///< by direction, whether it is free
    /** Directions of a free translation, "x", or "a rotation". */
    std::string description;
  };

  /** Number of the body that a cell belongs to. */
  template <int dim>
  using BodyOfCell = std::function<unsigned int(
      const typename dealii::Triangulation<dim>::cell_iterator &)>;

  /** The rigid motions that supports leave to each body: the
   * null space of the supported components of the nodes under the 3 or 6
   * rigid motions (1 for axisymmetric bodies).
   * @param body_of number of the body that a cell belongs to
   * @param supports components held, by boundary id. Collective. */
  template <int dim>
  std::vector<RigidFreedom> rigid_freedom(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler, unsigned int n_bodies,
      const BodyOfCell<dim> &body_of, PlaneModel plane,
      const std::map<dealii::types::boundary_id, dealii::ComponentMask>
          &supports);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_BODIES_OVERLAP_H
#define ABUT_SHIM_BODIES_OVERLAP_H

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <set>

namespace abut::shim
{
  /** A node in another body. */
  template <int dim> struct NodeInside
  {
    double depth = 0.; ///< length >= 0; 0: there is none
    dealii::Point<dim> place;
  };

  /** The node of two surfaces, given by their boundary ids, that is deepest
   * inside of another body, which the other surface belongs to, before anything
   * is displaced. Depths are those below the surface of the cell that the node
   * is in, or the size of a cell that has none; a hundredth of a cell counts as
   * 0. All ranks get the same. Some passes over the cells and O(log n) for each
   * cell of these bodies. Collective. */
  template <int dim>
  NodeInside<dim>
  deepest_inside(const dealii::Mapping<dim> &mapping,
                 const dealii::DoFHandler<dim> &dof_handler,
                 const std::set<dealii::types::boundary_id> &one,
                 const std::set<dealii::types::boundary_id> &other);
} // namespace abut::shim

#endif

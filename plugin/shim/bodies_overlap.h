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

  /** Of the nodes of facets with ids @p nodes the one that is deepest inside of
   * another body that has facets with ids @p others, before anything is
   * displaced. Depths are those below the surface of the cell that the node is
   * in, or the size of a cell that has none; a hundredth of a cell is none. All
   * ranks get the same. Two passes over the cells and O(log n) for each cell of
   * these bodies. Collective. */
  template <int dim>
  NodeInside<dim>
  deepest_inside(const dealii::Mapping<dim> &mapping,
                 const dealii::DoFHandler<dim> &dof_handler,
                 const std::set<dealii::types::boundary_id> &nodes,
                 const std::set<dealii::types::boundary_id> &others);
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_QUADRATIC_NODES_H
#define ABUT_SHIM_QUADRATIC_NODES_H

#include <deal.II/dofs/dof_handler.h>

#include <array>
#include <cstdint>
#include <vector>

namespace abut::shim
{
  /** A node of quadratic elements: a vertex, or the middle of a line, face or
   * cell. */
  struct QuadraticNode
  {
    /** Vertices that it is in the middle of; one: it is that vertex. */
    unsigned int n_vertices = 0;
    std::array<unsigned int, 8> vertex = {};
    /** Unknown of each component. */
    std::array<dealii::types::global_dof_index, 3> unknown = {};
    bool hangs = false; ///< on a coarser neighbour's line or face
  };

  /** The nodes whose unknowns this rank owns, in the order of these; @p hangs
   * [vertices] is true for vertices that hang. The element is FE_Q of degree 2
   * with nodes in the middle, FE_SimplexP(2), or a system of up to three of
   * one. */
  template <int dim>
  std::vector<QuadraticNode>
  own_quadratic_nodes(const dealii::DoFHandler<dim> &dof_handler,
                      const std::vector<std::uint8_t> &hangs);
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CONTACT_SURFACE_H
#define ABUT_SHIM_CONTACT_SURFACE_H

#include "solve/node_map.h"

#include <abut/facet.h>

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>
#include <deal.II/grid/cell_id.h>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace abut::shim
{
  /** Number of a node of a surface. */
  using NodeIndex = std::int32_t;

  template <int dim> using Direction = dealii::Tensor<1, dim>;

  /** The part of the contact surfaces that a rank knows: its own facets, those
   * around its nodes, and those that may touch one of these; with all data that
   * rows need of their nodes. Facets and nodes are sorted by numbers that do
   * not depend on how the mesh is distributed, so that sums over them have the
   * same order on any number of ranks. Indices into the arrays are local. */
  template <int dim> struct ContactSurface
  {
    using Index = dealii::types::global_dof_index;

    /** Most nodes of a facet. */
    static constexpr unsigned int max_nodes = dim == 2 ? 3 : 9;

    /** A support point of the field. */
    struct Node
    {
      dealii::Point<dim> point;   ///< in the reference configuration
      std::array<Index, dim> dof; ///< unknown of each component
      /** Unique over all ranks, >= 0: by the first facet that has the node; a
       * node without facets (a parent of hanging nodes) comes after the
       * others. */
      std::int64_t number;
    };

    /** A node that another hangs on, times a factor. */
    struct Parent
    {
      Index index;
      double factor;
    };

    /** A boundary face of an active cell. */
    struct Facet
    {
      dealii::CellId::binary_type cell; ///< as binary CellId
      std::uint32_t face;
      abut_facet_kind kind;
      dealii::types::boundary_id boundary_id;
      std::uint32_t owner; ///< rank of the cell
      std::int64_t number; ///< unique over all ranks: along the mesh
      /** In the order of abut/facet.h, outward. */
      std::array<std::int32_t, max_nodes> node;

      unsigned int n_nodes() const
      {
        return static_cast<unsigned int>(abut_facet_n_nodes(kind));
      }
    };

    std::vector<Facet> facets;
    std::vector<Node> nodes;
    /** The unknowns of each node by the host's constraints. */
    solve::NodeMap map{dim};
    /** [nodes] parents of a hanging node, by number; empty: does not hang. */
    std::vector<std::vector<Parent>> parents;
    /** Over all ranks. */
    std::int64_t n_facets_everywhere = 0;
    /** All numbers of nodes are below. */
    std::int64_t node_number_end = 0;
  };
} // namespace abut::shim

#endif

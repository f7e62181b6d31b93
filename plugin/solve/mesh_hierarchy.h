// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_MESH_HIERARCHY_H
#define ABUT_SOLVE_MESH_HIERARCHY_H

#include <cstdint>
#include <string>
#include <vector>

namespace abut::solve
{
  /** The meshes that a mesh was refined from, as abut/multigrid.h wants them.
   * On several ranks each has the nodes whose unknowns it owns, and the nodes
   * of each mesh are numbered over all ranks, one after the other. */
  struct MeshHierarchy
  {
    struct Mesh
    {
      std::int32_t n_nodes = 0;
      std::int32_t first = 0; ///< number of the first of them
      std::int32_t n_all = 0; ///< nodes of all ranks
      /** [n_nodes * components] prescribed, or components of hanging nodes. */
      std::vector<std::uint8_t> fixed;
      /** Weights of nodes of the next coarser mesh, by their numbers over all
       * ranks; empty on the coarsest. */
      std::vector<std::int64_t> start;
      std::vector<std::int32_t> parent;
      std::vector<double> weight;
    };

    /** Why there is none, as the end of a sentence; empty: there is one. */
    std::string missing;
    unsigned int n_components = 1;
    std::vector<Mesh> meshes; ///< from the finest to the coarsest
    /** [nodes * components] unknown of each node of the finest mesh, by its
     * number over all ranks. */
    std::vector<std::int32_t> unknown;
  };
} // namespace abut::solve

#endif

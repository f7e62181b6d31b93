// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_MESH_HIERARCHY_H
#define ABUT_SOLVE_MESH_HIERARCHY_H

#include <cstdint>
#include <string>
#include <vector>

namespace abut::solve
{
  /** The meshes that a mesh was refined from, as abut/multigrid.h wants them.
   */
  struct MeshHierarchy
  {
    struct Mesh
    {
      std::int32_t n_nodes = 0;
      /** [n_nodes * components] prescribed, or components of hanging nodes. */
      std::vector<std::uint8_t> fixed;
      /** Weights of nodes of the next coarser mesh; empty on the coarsest. */
      std::vector<std::int64_t> start;
      std::vector<std::int32_t> parent;
      std::vector<double> weight;
    };

    /** Why there is none, as the end of a sentence; empty: there is one. */
    std::string missing;
    unsigned int n_components = 1;
    std::vector<Mesh> meshes; ///< from the finest to the coarsest
    /** [nodes * components] unknown of each node of the finest mesh. */
    std::vector<std::int32_t> unknown;
  };
} // namespace abut::solve

#endif

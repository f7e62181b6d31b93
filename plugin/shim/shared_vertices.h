// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SHARED_VERTICES_H
#define ABUT_SHIM_SHARED_VERTICES_H

#include "solve/ask_ranks.h"

#include <array>
#include <vector>

namespace abut::shim
{
  /** Vertices that a vertex is in the middle of; none: it is one of the
   * coarsest mesh. */
  struct VertexParents
  {
    unsigned int n = 0;
    unsigned int vertex[8] = {};
    unsigned int cell = 0; ///< coarse cell and 1, of middles of cells
  };

  /** Name of a vertex on all ranks. */
  using VertexKey = std::array<std::uint64_t, 2>;

  /** Names of vertices of a tree of cells, as long as all ranks number the
   * vertices of the coarsest mesh alike: that of a middle comes from those that
   * it is in the middle of, however little of the tree a rank has. */
  std::vector<VertexKey> vertex_keys(const std::vector<VertexParents> &middle);

  /** Each rank describes some vertices, @p n_words Words for each, for others;
   * no two of the same vertex. Returns the Words for @p wanted; words of
   * vertices that no rank describes are unknown_vertex. Collective. */
  solve::Words find_vertices(MPI_Comm communicator,
                             const std::vector<VertexKey> &known,
                             const solve::Words &words, unsigned int n_words,
                             const std::vector<VertexKey> &wanted);

  /** See find_vertices(). */
  constexpr std::uint64_t unknown_vertex = ~std::uint64_t(0);
} // namespace abut::shim

#endif

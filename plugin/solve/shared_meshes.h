// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_SHARED_MESHES_H
#define ABUT_SOLVE_SHARED_MESHES_H

#include "mesh_hierarchy.h"
#include "node_copies.h"

#include <deal.II/base/index_set.h>

#include <unordered_map>

namespace abut::solve
{
  /** Meshes over several ranks as each of them needs them for
   * abut/multigrid.h: with copies of the nodes of other ranks that its part of
   * the matrix touches, and of all their parents. */
  class SharedMeshes
  {
  public:
    using Index = dealii::types::global_dof_index;

    /** @p ghosts are unknowns of other ranks that occur in columns, or rows, of
     * this one; @p owned is a contiguous range. Collective. */
    SharedMeshes(const MeshHierarchy &meshes, const dealii::IndexSet &owned,
                 const std::vector<Index> &ghosts, MPI_Comm communicator);

    /** The meshes on this rank, with parents by their places on it, and the
     * rows of unknowns: first the owned ones, then the ghosts in their order,
     * then the other unknowns of the nodes. */
    const MeshHierarchy &local() const
    {
      return local_;
    }

    /** Give local() back: nodes and rows stay. */
    void forget_weights()
    {
      local_ = {};
    }

    /** Nodes of a mesh. */
    const NodeCopies &copies(const int mesh) const
    {
      return copies_[mesh];
    }

    int n_meshes() const
    {
      return static_cast<int>(copies_.size());
    }

    MPI_Comm communicator() const
    {
      return communicator_;
    }

    /** Row of an unknown that is owned or one of the ghosts; -1: neither. */
    int row(Index unknown) const;

  private:
    Words places_of(const MeshHierarchy &meshes,
                    const std::vector<Index> &ghosts) const;
    void number_rows(const MeshHierarchy &meshes,
                     const std::vector<Index> &ghosts,
                     const Words &place_of_ghost);
    void add_mesh(const MeshHierarchy &meshes, int l,
                  std::vector<std::int32_t> nodes);
    void copy_weights(const MeshHierarchy::Mesh &own,
                      MeshHierarchy::Mesh &mesh) const;

    dealii::IndexSet owned_;
    MPI_Comm communicator_;
    MeshHierarchy local_;
    std::vector<NodeCopies> copies_;
    std::unordered_map<Index, int> row_of_ghost_;
  };
} // namespace abut::solve

#endif

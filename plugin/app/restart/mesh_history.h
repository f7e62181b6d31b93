// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MESH_HISTORY_H
#define ABUT_APP_MESH_HISTORY_H

#include <deal.II/distributed/tria.h>

#include <boost/signals2/connection.hpp>

#include <string>
#include <vector>

namespace abut::app
{
  /** What was refined and coarsened since the coarse mesh, on this rank.
   *
   * A mesh that p4est has saved and loaded has the same cells, but deal.II
   * numbers them in another order than one that has grown step by step. Sums
   * over cells, numbers of unknowns and aggregates of multigrid would follow,
   * and results would agree to the tolerance of the solvers only. The same
   * steps done once more, on the same number of ranks, give the same numbers
   * and hence the same results bit by bit. */
  template <int dim> class MeshHistory
  {
  public:
    using Mesh = dealii::Triangulation<dim>;

    /** Take notes of what is done to @p mesh, as long as this object lives. */
    explicit MeshHistory(Mesh &mesh);

    MeshHistory(const MeshHistory &) = delete;
    MeshHistory &operator=(const MeshHistory &) = delete;

    /** The notes of this rank; none after forget(). */
    const std::vector<std::string> &steps() const
    {
      return steps_;
    }

    /** Whether the notes tell how the mesh came about. */
    bool is_known() const
    {
      return is_known_;
    }

    /** The mesh was loaded: how it came about is not known any more. */
    void forget();

    /** Do those of @p steps to the mesh that have not been noted yet: what
     * has been must be their beginning. Collective. */
    void replay(const std::vector<std::string> &steps);

  private:
    void note();

    Mesh &mesh_;
    boost::signals2::scoped_connection connection_;
    bool is_known_ = true;
    std::vector<std::string> steps_; ///< '0' keep, '1' refine, '2' coarsen
  };
} // namespace abut::app

#endif

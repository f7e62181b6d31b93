// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SAVED_MESH_H
#define ABUT_APP_SAVED_MESH_H

#include "archive.h"
#include "mesh_history.h"

#include <deal.II/dofs/dof_handler.h>

#include <filesystem>
#include <functional>

namespace abut::app
{
  /** A rank's part of a mesh with nodal fields, for as many ranks as it was
   * saved on. The same is saved by p4est, for any number of ranks; of a mesh
   * that is not p4est's, which its scene makes as it was, the fields are. */
  struct MeshPart
  {
    bool is_known = false; ///< whether the steps lead to the mesh
    std::vector<std::string> steps;
    std::vector<std::vector<double>> fields; ///< owned values

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &is_known &steps &fields;
    }
  };

  /** Save a mesh and @p fields, without ghosts, into @p folder; the result is
   * to be saved by each rank. Collective. */
  template <int dim>
  MeshPart save_mesh(const std::filesystem::path &folder,
                     typename MeshHistory<dim>::Mesh &mesh,
                     const MeshHistory<dim> &history,
                     const dealii::DoFHandler<dim> &dof_handler,
                     const std::vector<la::Vector> &fields);

  /** Bring @p mesh, which is coarse, and fields back to what they were: bit by
   * bit from @p part where there is one, else from what any number of ranks can
   * load. @p setup distributes the unknowns. Collective. */
  template <int dim>
  std::vector<la::Vector> load_mesh(const std::filesystem::path &folder,
                                    const MeshPart *part, unsigned int n_fields,
                                    typename MeshHistory<dim>::Mesh &mesh,
                                    MeshHistory<dim> &history,
                                    const dealii::DoFHandler<dim> &dof_handler,
                                    const std::function<void()> &setup);
} // namespace abut::app

#endif

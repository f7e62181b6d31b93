// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_OUTLINE_H
#define ABUT_APP_OUTLINE_H

/** @file
 * `outline.json`: the boundary of the coarse mesh with its ids, for sketches of
 * a scene.
 */

#include <deal.II/grid/tria.h>

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>

namespace abut::app
{
  /** What the user calls a boundary. */
  struct SurfaceName
  {
    unsigned int body;             ///< from 1
    dealii::types::boundary_id id; ///< of that body
    std::string names;             ///< in the mesh file, may be empty
  };

  /** Write the file into @p folder (rank 0): by `body:id` the points of the
   * surface and its facets, curved ones in pieces. A mesh with very many
   * boundary faces leaves the surfaces out. Collective. */
  template <int dim>
  void write_outline(
      const std::filesystem::path &folder, MPI_Comm communicator,
      const dealii::Triangulation<dim> &mesh,
      const std::function<SurfaceName(dealii::types::boundary_id)> &name);
} // namespace abut::app

#endif

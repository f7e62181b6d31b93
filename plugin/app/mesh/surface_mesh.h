// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SURFACE_MESH_H
#define ABUT_APP_SURFACE_MESH_H

/** @file
 * A contact surface by itself: the boundary of a deal.II mesh, or a file of
 * triangles.
 */

#include "mesh.h"

#include <abut/surface.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** A section of a scene that describes a surface. */
  struct SurfaceParameters
  {
    MeshParameters mesh;
    unsigned int refinements = 0;
    std::string surface_ids;
    std::string map;

    /** Declare the parameters in the present section of @p prm. */
    static void declare(dealii::ParameterHandler &prm);

    /** Read them; @p section is the present section's full name. */
    void parse(dealii::ParameterHandler &prm, const std::string &section);
  };

  /** Arrays of a surface, as abut_surface_data takes them. */
  struct SurfaceArrays
  {
    std::int32_t dimension = 3;
    abut_facet_kind kind = ABUT_FACET_QUAD4;
    std::vector<double> position;
    std::vector<std::int32_t> connectivity;
    std::vector<std::int32_t> group; /**< boundary id of each facet */
    std::string origin;    /**< "file bolt.stl", "generator hyper_ball" */
    std::string parameter; /**< that names the origin, for messages */

    std::int32_t n_nodes() const
    {
      return static_cast<std::int32_t>(position.size())
             / static_cast<std::int32_t>(dimension);
    }
    std::int32_t n_facets() const
    {
      return static_cast<std::int32_t>(group.size());
    }
    std::set<std::int32_t> groups() const
    {
      return {group.begin(), group.end()};
    }
  };

  /** Make a surface: the boundary of a mesh (only cells at the surface are
   * refined), or, for a file that ends in .stl, its triangles; then apply the
   * map to all nodes. Throws InputError that names the parameter. Serial. */
  template <int dim>
  SurfaceArrays make_surface(const SurfaceParameters &parameters,
                             const RunOptions &options);
} // namespace abut::app

#endif

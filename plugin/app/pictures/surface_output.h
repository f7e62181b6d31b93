// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SURFACE_OUTPUT_H
#define ABUT_APP_SURFACE_OUTPUT_H

#include "app/mesh/surface_mesh.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** Fields of a surface, each with its name. */
  struct SurfaceFields
  {
    std::vector<std::pair<std::string, std::vector<double>>> nodal;
    std::vector<std::pair<std::string, std::vector<double>>> facets;
  };

  /** Write a surface of linear facets (line2, tri3, quad4) with its fields as
   * the VTU file @p file. */
  template <int dim>
  void write_surface(const std::filesystem::path &file,
                     const SurfaceArrays &surface, const SurfaceFields &fields);
} // namespace abut::app

#endif

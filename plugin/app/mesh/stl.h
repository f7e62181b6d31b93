// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_STL_H
#define ABUT_APP_STL_H

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  /** A surface of triangles. */
  struct Triangles
  {
    std::vector<std::array<double, 3>> vertices;
    /** Three vertices per triangle, counter-clockwise as seen from outside. */
    std::vector<std::int32_t> connectivity;
  };

  /** Read a surface from an STL file, text or binary. The format repeats the
   * vertices in each triangle: corners that are closer than 1e-7 of the
   * shortest side at either of them become one vertex.
   * Its normals are not looked at; the order of the vertices says where outside
   * is. Throws InputError that names @p parameter, file and, in a text file,
   * the line. */
  Triangles read_stl(const std::filesystem::path &file,
                     const std::string &parameter);
} // namespace abut::app

#endif

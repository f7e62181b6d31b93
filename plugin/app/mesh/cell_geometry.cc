// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cell_geometry.h"

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    Place difference(const Place &a, const Place &b)
    {
      return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
    }

    double determinant(const unsigned int dim, const Place &a, const Place &b,
                       const Place &c)
    {
      if (dim == 2)
        return a[0] * b[1] - a[1] * b[0];
      return a[0] * (b[1] * c[2] - b[2] * c[1])
             - a[1] * (b[0] * c[2] - b[2] * c[0])
             + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }

    /** The neighbours of a corner, in positive order. */
    std::array<unsigned int, 3> neighbours(const CellShape shape,
                                           const unsigned int corner)
    {
      switch (shape)
      {
      case CellShape::triangle:
        return {{(corner + 1) % 3, (corner + 2) % 3, 0}};
      case CellShape::quadrilateral:
        return {{(corner + 1) % 4, (corner + 3) % 4, 0}};
      case CellShape::hexahedron:
      {
        const unsigned int base = corner < 4 ? 0 : 4, turn = corner % 4;
        const unsigned int next = base + (turn + 1) % 4,
                           last = base + (turn + 3) % 4;
        return corner < 4
                   ? std::array<unsigned int, 3>{{next, last, corner + 4}}
                   : std::array<unsigned int, 3>{{last, next, corner - 4}};
      }
      default: // a tetrahedron; all its corners say the same
        return {{1, 2, 3}};
      }
    }
  } // namespace

  double distance(const Place &a, const Place &b)
  {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }

  Place middle_of(const Place &a, const Place &b)
  {
    return {{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])}};
  }

  Orientation orientation_of(const CellShape shape,
                             const std::vector<Place> &corners)
  {
    // Sines: round-off of a corner with an angle of 180 degrees, and of cells
    // without volume; part of the longest edge that is no length.
    constexpr double round_off = 1e-10, no_length = 1e-12;
    const ShapeInfo &info = shape_info(shape);
    double longest = 0., least = 1., largest = -1.;
    for (const auto &edge : info.edges)
      longest = std::max(longest, distance(corners[edge[0]], corners[edge[1]]));
    for (const auto &edge : info.edges)
      if (distance(corners[edge[0]], corners[edge[1]]) <= no_length * longest)
        return Orientation::none;
    const unsigned int n = shape == CellShape::tetrahedron ? 1 : info.n_corners;
    for (unsigned int corner = 0; corner < n; ++corner)
    {
      std::array<Place, 3> edges{};
      double product = 1.;
      for (unsigned int d = 0; d < info.dim; ++d)
      {
        const Place &end = corners[neighbours(shape, corner)[d]];
        edges[d] = difference(end, corners[corner]);
        product *= distance(end, corners[corner]);
      }
      const double sine =
          determinant(info.dim, edges[0], edges[1], edges[2]) / product;
      least = std::min(least, sine);
      largest = std::max(largest, sine);
    }
    if (largest > round_off && least > -round_off)
      return Orientation::positive;
    if (least < -round_off && largest < round_off)
      return Orientation::reversed;
    return Orientation::none;
  }

  void reverse_corners(const CellShape shape,
                       std::vector<unsigned int> &corners)
  {
    switch (shape)
    {
    case CellShape::triangle:
    case CellShape::tetrahedron:
      std::swap(corners[1], corners[2]);
      break;
    case CellShape::quadrilateral:
      std::swap(corners[1], corners[3]);
      break;
    case CellShape::hexahedron:
      for (unsigned int i = 0; i < 4; ++i)
        std::swap(corners[i], corners[i + 4]);
      break;
    default:
      break;
    }
  }

  double least_quadratic_jacobian(const CellShape shape,
                                  const std::vector<Place> &corners,
                                  const std::vector<Place> &middles)
  {
    const ShapeInfo &info = shape_info(shape);
    const auto with = [&](const std::vector<double> &weight)
    {
      // Derivatives by barycentric coordinates: 4 L - 1 of a corner's function
      // L (2 L - 1), 4 L of the other end of an edge's 4 L M.
      std::vector<Place> by(info.n_corners, Place{});
      for (unsigned int d = 0; d < 3; ++d)
      {
        for (unsigned int c = 0; c < info.n_corners; ++c)
          by[c][d] += (4. * weight[c] - 1.) * corners[c][d];
        for (std::size_t e = 0; e < info.edges.size(); ++e)
        {
          const auto [a, b] = info.edges[e];
          by[a][d] += 4. * weight[b] * middles[e][d];
          by[b][d] += 4. * weight[a] * middles[e][d];
        }
      }
      return determinant(info.dim, difference(by[1], by[0]),
                         difference(by[2], by[0]),
                         info.dim == 3 ? difference(by[3], by[0]) : Place{});
    };
    double least = 0.;
    bool is_first = true;
    const auto look = [&](const unsigned int a, const unsigned int b)
    {
      std::vector<double> weight(info.n_corners, 0.);
      weight[a] += 0.5;
      weight[b] += 0.5;
      const double value = with(weight);
      least = is_first ? value : std::min(least, value);
      is_first = false;
    };
    for (unsigned int c = 0; c < info.n_corners; ++c)
      look(c, c);
    for (const auto &edge : info.edges)
      look(edge[0], edge[1]);
    const double straight = determinant(
        info.dim, difference(corners[1], corners[0]),
        difference(corners[2], corners[0]),
        info.dim == 3 ? difference(corners[3], corners[0]) : Place{});
    return least / straight;
  }
} // namespace abut::app

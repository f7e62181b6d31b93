// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacle_output.h"

#include "surface_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace abut::app
{
  namespace
  {
    /** Points of the grid along each axis. */
    template <int dim> constexpr unsigned int n_points = dim == 2 ? 201 : 49;

    template <int dim> struct Corner
    {
      dealii::Point<dim> position;
      double distance;
    };

    template <int dim> using Simplex = std::array<Corner<dim>, dim + 1>;

    /** Append the part of a zero surface in a simplex, as lines or triangles;
     * none where a corner has no distance. */
    template <int dim>
    void cut(const Simplex<dim> &corners,
             std::vector<dealii::Point<dim>> &facets)
    {
      std::vector<Corner<dim>> inside, outside;
      for (const Corner<dim> &corner : corners)
      {
        if (std::isnan(corner.distance))
          return;
        (corner.distance < 0. ? inside : outside).push_back(corner);
      }
      std::vector<dealii::Point<dim>> ends;
      for (const Corner<dim> &a : inside)
        for (const Corner<dim> &b : outside)
          ends.push_back(a.position
                         + a.distance / (a.distance - b.distance)
                               * (b.position - a.position));
      for (std::size_t i = 0; i + dim <= ends.size(); ++i)
        facets.insert(facets.end(), ends.begin() + i, ends.begin() + i + dim);
    }

    template <int dim>
    std::vector<double> distances(const RigidObstacle<dim> &shape,
                                  const std::vector<dealii::Point<dim>> &points)
    {
      std::vector<double> result(points.size()), one;
      for (std::size_t i = 0; i < points.size(); ++i)
        try
        {
          shape.distance({points[i]}, one);
          result[i] = one[0];
        }
        catch (const std::exception &)
        {
          // A formula without a value there.
          result[i] = std::numeric_limits<double>::quiet_NaN();
        }
      return result;
    }

    /** The surface in a grid, each cube cut into simplices along its diagonal:
     * corners of lines or triangles, one after the other. */
    template <int dim>
    std::vector<dealii::Point<dim>>
    zero_surface(const RigidObstacle<dim> &shape,
                 const dealii::BoundingBox<dim> &box)
    {
      constexpr unsigned int n = n_points<dim>;
      unsigned int all = 1;
      std::array<unsigned int, dim> stride;
      for (unsigned int d = 0; d < dim; ++d, all *= n)
        stride[d] = all;
      std::vector<dealii::Point<dim>> points(all);
      for (unsigned int i = 0; i < all; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          points[i][d] = box.lower_bound(d)
                         + box.side_length(d) * (i / stride[d] % n) / (n - 1);
      const std::vector<double> distance = distances(shape, points);
      std::vector<dealii::Point<dim>> facets;
      for (unsigned int i = 0; i < all; ++i)
      {
        std::array<unsigned int, dim> axes;
        std::iota(axes.begin(), axes.end(), 0);
        if (std::any_of(axes.begin(), axes.end(),
                        [&](const unsigned int d)
                        { return i / stride[d] % n == n - 1; }))
          continue;
        do
        {
          Simplex<dim> corners;
          unsigned int at = i;
          corners[0] = {points[at], distance[at]};
          for (unsigned int d = 0; d < dim; ++d)
          {
            at += stride[axes[d]];
            corners[d + 1] = {points[at], distance[at]};
          }
          cut<dim>(corners, facets);
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
      return facets;
    }
  } // namespace

  template <int dim>
  void write_obstacles(const std::filesystem::path &file,
                       const std::vector<PlacedObstacle<dim>> &obstacles,
                       const dealii::BoundingBox<dim> &box)
  {
    SurfaceArrays arrays;
    arrays.dimension = dim;
    arrays.kind = dim == 2 ? ABUT_FACET_LINE2 : ABUT_FACET_TRI3;
    SurfaceFields fields;
    fields.facets.push_back({"obstacle", {}});
    for (unsigned int d = 0; d < dim; ++d)
      fields.facets.push_back({std::string("motion_") + "xyz" [d], {}});
    for (std::size_t o = 0; o < obstacles.size(); ++o)
    {
      const auto corners = zero_surface<dim>(*obstacles[o].shape, box);
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        for (unsigned int d = 0; d < dim; ++d)
          arrays.position.push_back(corners[i][d]);
        arrays.connectivity.push_back(
            static_cast<std::int32_t>(arrays.connectivity.size()));
        if (i % dim > 0)
          continue;
        arrays.group.push_back(static_cast<std::int32_t>(o));
        fields.facets[0].second.push_back(double(o) + 1.);
        for (unsigned int d = 0; d < dim; ++d)
          fields.facets[d + 1].second.push_back(obstacles[o].motion[d]);
      }
    }
    write_surface<dim>(file, arrays, fields);
  }

  template void write_obstacles<2>(const std::filesystem::path &,
                                   const std::vector<PlacedObstacle<2>> &,
                                   const dealii::BoundingBox<2> &);
  template void write_obstacles<3>(const std::filesystem::path &,
                                   const std::vector<PlacedObstacle<3>> &,
                                   const dealii::BoundingBox<3> &);
} // namespace abut::app

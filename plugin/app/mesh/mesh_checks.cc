// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_checks.h"

#include "app/input/expression.h"
#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "memory_check.h"

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace abut::app
{
  template <int dim>
  void check_cells(const std::string &parameter,
                   const dealii::Triangulation<dim> &triangulation)
  {
    using Geometry = dealii::GeometryInfo<dim>;
    // What round-off makes of a corner with an angle of 180 degrees.
    constexpr double round_off = 1e-10;
    // Sizes, as parts of the distance from the origin, that leave a cell five
    // digits, and half of all.
    constexpr double least_digits = 1e-11, few_digits = 1e-7;
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      const bool is_cube = cell->reference_cell().is_hyper_cube();
      dealii::Point<dim> vertices[Geometry::vertices_per_cell];
      dealii::Tensor<0, dim> forms[Geometry::vertices_per_cell];
      for (const unsigned int v : cell->vertex_indices())
        vertices[v] = cell->vertex(v);
      if (is_cube)
        Geometry::alternating_form_at_vertices(vertices, forms);
      else
      {
        dealii::Tensor<2, dim> edges;
        for (unsigned int d = 0; d < dim; ++d)
          edges[d] = vertices[d + 1] - vertices[0];
        std::fill(std::begin(forms), std::end(forms), determinant(edges));
      }
      const double measure = cell->measure(), size = cell->diameter(),
                   distance = cell->center().norm();
      bool is_good = measure > 0 && std::isfinite(measure)
                     && size > least_digits * distance;
      const double shortest = cell->minimum_vertex_distance();
      const bool is_outlier = shortest < least_digits * size;
      for (const auto &form : forms)
        is_good = is_good && form > -round_off * measure;
      if (is_good && !is_outlier)
        continue;
      std::ostringstream where;
      where << "cell " << cell->active_cell_index() << " of the mesh, around ("
            << cell->center() << "), "
            << (is_good ? "has corners " + short_number(shortest)
                              + " apart and a diameter of " + short_number(size)
                              + ": round-off does not allow both."
                : size > 0. && size < few_digits * distance
                    ? "is too far from the origin relative to its size: "
                      "round-off. Move the mesh nearer."
                    : "is folded or concave, or has no volume.");
      throw InputError(parameter, where.str());
    }
  }

  template <int dim> void check_repetitions(const MeshParameters &parameters)
  {
    const bool is_cube = parameters.generator == "subdivided_hyper_cube";
    if (!is_cube && parameters.generator != "subdivided_hyper_rectangle")
      return;
    const std::vector<std::string> all = split_list(parameters.arguments, ':');
    const std::string first = all.empty() ? "" : all[0];
    // Sizes of steps: a list for each direction.
    const bool are_sizes = first.find(';') != std::string::npos;
    double n_cells = 1.;
    const std::vector<std::string> words =
        split_list(first, are_sizes ? ';' : ',');
    // deal.II's release library reads beyond the end of shorter lists.
    if (!is_cube && words.size() != dim)
      throw InputError(parameters.section + "/Arguments",
                       "'" + first + "' are " + std::to_string(words.size())
                           + (are_sizes ? " lists of sizes" : " repetitions")
                           + " for " + std::to_string(dim) + " directions.");
    for (const std::string &word : words)
    {
      if (!are_sizes
          && word.find_first_not_of("0123456789") != std::string::npos)
        throw InputError(parameters.section + "/Arguments",
                         "'" + word
                             + "' is not a number of repetitions, which "
                               "is whole and positive.");
      n_cells *= are_sizes ? double(split_list(word, ',').size())
                           : std::max(1., std::atof(word.c_str()));
    }
    check_memory(dim, is_cube ? std::pow(n_cells, dim) : n_cells, 1,
                 MPI_COMM_SELF, parameters.section + "/Arguments");
  }

  void check_axis(const MeshParameters &parameters,
                  const dealii::Triangulation<2> &triangulation)
  {
    double least = 0., largest = 0.;
    for (const dealii::Point<2> &vertex : triangulation.get_vertices())
    {
      least = std::min(least, vertex[0]);
      largest = std::max(largest, std::abs(vertex[0]));
    }
    // Round-off of a mesh that was turned or moved to the axis.
    if (least < -1e-9 * largest)
      throw InputError(parameters.section
                           + (parameters.move.empty() ? "/Arguments" : "/Move"),
                       "the body reaches to x = " + short_number(least)
                           + ", a negative radius: with Solid/Plane = "
                             "axisymmetric, x is the radius.");
  }

  template void check_cells<2>(const std::string &,
                               const dealii::Triangulation<2> &);
  template void check_cells<3>(const std::string &,
                               const dealii::Triangulation<3> &);
  template void check_repetitions<2>(const MeshParameters &);
  template void check_repetitions<3>(const MeshParameters &);
} // namespace abut::app

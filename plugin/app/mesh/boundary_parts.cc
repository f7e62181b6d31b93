// SPDX-License-Identifier: LGPL-2.1-or-later
#include "boundary_parts.h"

#include "app/input/short_number.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::app
{
  namespace
  {
    /** Length, or area as half the product of the diagonals or two sides:
     * deal.II measures no quadrilateral that is not plane. */
    template <typename Face> double measure_of(const Face &face)
    {
      if (face->n_vertices() == 2)
        return face->vertex(0).distance(face->vertex(1));
      const unsigned int last = face->n_vertices() - 1;
      const auto a = face->vertex(last) - face->vertex(0),
                 b = face->vertex(last == 3 ? 2 : 1)
                     - face->vertex(last == 3 ? 1 : 0);
      return 0.5 * std::sqrt(std::max(0., a * a * (b * b) - a * b * (a * b)));
    }

    /** The outward normal times the measure, of a plane face. */
    template <int dim, typename Face>
    dealii::Tensor<1, dim> area_vector(const Face &face,
                                       const dealii::Point<dim> &inside)
    {
      dealii::Tensor<1, dim> result;
      const unsigned int last = face->n_vertices() - 1;
      const auto a = face->vertex(last) - face->vertex(0);
      if constexpr (dim == 2)
        result = dealii::cross_product_2d(a);
      else
        result = 0.5
                 * dealii::cross_product_3d(
                     a, face->vertex(last == 3 ? 2 : 1)
                            - face->vertex(last == 3 ? 1 : 0));
      return result * (face->center() - inside) < 0. ? -result : result;
    }
  } // namespace

  template <int dim>
  std::vector<BoundaryPart<dim>>
  boundary_parts(const dealii::Triangulation<dim> &triangulation,
                 const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    std::vector<BoundaryPart<dim>> parts;
    for (const dealii::types::boundary_id id : triangulation.get_boundary_ids())
    {
      // The largest coordinates and the negative of the least.
      double ends[2 * dim];
      std::fill(ends, ends + 2 * dim, -std::numeric_limits<double>::infinity());
      unsigned int n_faces = 0;
      double measure = 0.;
      dealii::Tensor<1, dim> normal;
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
        {
          const auto face = cell->face(f);
          if (!cell->is_locally_owned() || !face->at_boundary()
              || face->boundary_id() != id)
            continue;
          ++n_faces;
          measure += measure_of(face);
          normal += area_vector<dim>(face, cell->center());
          for (const unsigned int v : face->vertex_indices())
            for (unsigned int d = 0; d < dim; ++d)
            {
              ends[d] = std::max(ends[d], face->vertex(v)[d]);
              ends[dim + d] = std::max(ends[dim + d], -face->vertex(v)[d]);
            }
        }
      BoundaryPart<dim> part{id,
                             MPI::sum(n_faces, communicator),
                             MPI::sum(measure, communicator),
                             {},
                             {},
                             {}};
      part.normal = MPI::sum(normal, communicator) / part.measure;
      for (unsigned int d = 0; d < dim; ++d)
      {
        part.largest[d] = MPI::max(ends[d], communicator);
        part.least[d] = -MPI::max(ends[dim + d], communicator);
      }
      parts.push_back(part);
    }
    return parts;
  }

  template <int dim> std::string in_words(const BoundaryPart<dim> &part)
  {
    const char *const names[] = {"x", "y", "z"};
    std::string text =
        std::to_string(part.n_faces) + (part.n_faces == 1 ? " face" : " faces")
        + (dim == 2 ? ", length " : ", area ") + short_number(part.measure);
    double extent = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      extent = std::max(extent, part.largest[d] - part.least[d]);
    for (unsigned int d = 0; d < dim; ++d)
    {
      const bool is_flat = part.largest[d] - part.least[d] <= 1e-12 * extent;
      text += std::string(", ") + names[d] + (is_flat ? " = " : " from ")
              + short_number(part.least[d]);
      if (!is_flat)
        text += " to " + short_number(part.largest[d]);
    }
    constexpr double round_off = 1e-12;
    const double length = part.normal.norm();
    text += length < 1. - round_off ? ", mean normal (" : ", normal (";
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double x = part.normal[d];
      text += (d > 0 ? ", " : "")
              + short_number(std::abs(x) < round_off ? 0. : x, 3);
    }
    return text + ")";
  }

  template std::vector<BoundaryPart<2>>
  boundary_parts<2>(const dealii::Triangulation<2> &, MPI_Comm);
  template std::vector<BoundaryPart<3>>
  boundary_parts<3>(const dealii::Triangulation<3> &, MPI_Comm);
  template std::string in_words<2>(const BoundaryPart<2> &);
  template std::string in_words<3>(const BoundaryPart<3> &);
} // namespace abut::app

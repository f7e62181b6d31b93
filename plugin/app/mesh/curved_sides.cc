// SPDX-License-Identifier: LGPL-2.1-or-later
#include "curved_sides.h"

#include "app/input/boundary_expressions.h"
#include "app/input/expression.h"
#include "app/input/input_error.h"
#include "app/input/number_text.h"
#include "app/input/parameters.h"
#include "app/input/short_number.h"

#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <sstream>
#include <vector>

namespace abut::app
{
  namespace
  {
    using dealii::types::boundary_id;

    /** How far a node may be from its surface, as a part of the radius: files
     * are written with six digits, too. */
    constexpr double node_tolerance = 1e-4;

    /** A round surface: what has the same distance from a point or axis. */
    template <int dim> struct RoundSurface
    {
      std::string text; ///< the entry, for messages
      std::string kind;
      dealii::Point<dim> point;
      dealii::Tensor<1, dim> axis; ///< unit vector; zero: there is none

      double radius_at(const dealii::Point<dim> &x) const
      {
        dealii::Tensor<1, dim> offset = x - point;
        offset -= (offset * axis) * axis;
        return offset.norm();
      }

      std::unique_ptr<dealii::Manifold<dim>> manifold() const
      {
        if (kind == "flat")
          return std::make_unique<dealii::FlatManifold<dim>>();
        if constexpr (dim == 3)
          if (kind == "cylinder")
            return std::make_unique<dealii::CylindricalManifold<3>>(axis,
                                                                    point);
        return std::make_unique<dealii::SphericalManifold<dim>>(point);
      }
    };

    /** Vectors that an entry of this kind has behind its word. */
    template <int dim> std::map<std::string, std::size_t> kinds()
    {
      if (dim == 2)
        return {{"circle", 1}, {"flat", 0}};
      return {{"cylinder", 2}, {"flat", 0}, {"sphere", 1}};
    }

    template <int dim>
    dealii::Tensor<1, dim> read_vector(const std::string &text,
                                       const std::string &parameter)
    {
      const std::vector<double> numbers = parse_numbers(text, parameter);
      if (numbers.size() != dim)
        throw InputError(parameter,
                         "'" + text + "' has " + std::to_string(numbers.size())
                             + " coordinates; it needs " + std::to_string(dim)
                             + "." + misread_hint(text));
      dealii::Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = numbers[d];
      return result;
    }

    /** Read what stands behind the ids; @p parts[0] are these. */
    template <int dim>
    RoundSurface<dim> read_surface(const std::string &entry,
                                   const std::vector<std::string> &parts,
                                   const std::string &parameter)
    {
      const std::map<std::string, std::size_t> known = kinds<dim>();
      const std::string kind = parts.size() > 1 ? parts[1] : "";
      if (known.count(kind) == 0)
      {
        std::vector<std::string> words;
        std::string list;
        for (const auto &word : known)
        {
          words.push_back(word.first);
          list += (list.empty() ? "" : ", ") + word.first;
        }
        throw InputError(parameter, "'" + entry
                                        + "' names no surface: behind the ids "
                                        + "stands one of " + list + "."
                                        + did_you_mean(kind, words));
      }
      if (parts.size() != 2 + known.at(kind))
        throw InputError(parameter,
                         "'" + entry + "' is not of the form 'ids: " + kind
                             + (kind == "flat" ? ""
                                : kind == "cylinder"
                                    ? ": point of the axis: direction"
                                    : ": centre")
                             + "'.");
      RoundSurface<dim> surface;
      surface.text = entry;
      surface.kind = kind;
      if (parts.size() > 2)
        surface.point =
            dealii::Point<dim>(read_vector<dim>(parts[2], parameter));
      if (parts.size() > 3)
      {
        surface.axis = read_vector<dim>(parts[3], parameter);
        if (!(surface.axis.norm() > 0.))
          throw InputError(parameter,
                           "the direction in '" + entry + "' has no length.");
        surface.axis /= surface.axis.norm();
      }
      return surface;
    }

    template <int dim>
    void check_nodes(const RoundSurface<dim> &surface, const boundary_id id,
                     const std::string &parameter,
                     const dealii::Triangulation<dim> &triangulation)
    {
      std::map<unsigned int, double> radius; // by vertex
      for (const auto &face : triangulation.active_face_iterators())
        if (face->at_boundary() && face->boundary_id() == id)
          for (const unsigned int v : face->vertex_indices())
            radius[face->vertex_index(v)] = surface.radius_at(face->vertex(v));
      std::vector<double> sorted;
      for (const auto &node : radius)
        sorted.push_back(node.second);
      std::sort(sorted.begin(), sorted.end());
      const double median = sorted[sorted.size() / 2];
      for (const auto &[vertex, r] : radius)
        if (!(std::abs(r - median) <= node_tolerance * median))
        {
          std::ostringstream message;
          message << "'" << surface.text << "': the node ("
                  << triangulation.get_vertices()[vertex] << ") is "
                  << short_number(std::abs(r - median), 4) << " off the "
                  << surface.kind << " of radius " << short_number(median, 6)
                  << " on which most nodes with boundary id " << id
                  << " are. Correct the "
                  << (surface.kind == "cylinder" ? "axis" : "centre")
                  << ", or give sides of another shape their own id.";
          throw InputError(parameter, message.str());
        }
    }

    template <int dim>
    dealii::types::manifold_id
    free_manifold_id(const dealii::Triangulation<dim> &triangulation)
    {
      dealii::types::manifold_id id = 0;
      for (const auto used : triangulation.get_manifold_ids())
        if (used != dealii::numbers::flat_manifold_id)
          id = std::max(id, used + 1);
      return id;
    }
  } // namespace

  template <int dim>
  void set_curved_sides(const std::string &text, const std::string &parameter,
                        const BoundaryNames &names,
                        dealii::Triangulation<dim> &triangulation)
  {
    for (const std::string &entry : split_list(text, ';'))
    {
      if (entry.empty())
        continue;
      const std::vector<std::string> parts = split_list(entry, ':');
      const std::set<boundary_id> ids =
          parse_boundary_ids(parts[0], parameter, names);
      if (ids.empty())
        throw InputError(parameter, "'" + entry + "' names no boundary id.");
      const RoundSurface<dim> surface =
          read_surface<dim>(entry, parts, parameter);
      if (surface.kind != "flat")
        for (const boundary_id id : ids)
          check_nodes(surface, id, parameter, triangulation);
      const auto manifold = free_manifold_id(triangulation);
      for (const auto &face : triangulation.active_face_iterators())
        if (face->at_boundary() && ids.count(face->boundary_id()) > 0)
          face->set_all_manifold_ids(manifold);
      triangulation.set_manifold(manifold, *surface.manifold());
    }
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void set_curved_sides<dim>(                                         \
      const std::string &, const std::string &, const BoundaryNames &,         \
      dealii::Triangulation<dim> &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_points.h"

#include "app/input/input_error.h"
#include "app/input/number_text.h"
#include "app/input/parameters.h"
#include "app/input/short_number.h"
#include "app/mesh/nearest_node.h"

namespace abut::app
{
  namespace
  {
    const char *const points_name = "Output/Points";

    template <int dim> std::string in_words(const dealii::Point<dim> &point)
    {
      std::string text;
      for (unsigned int d = 0; d < dim; ++d)
        text += (d > 0 ? ", " : "") + short_number(point[d]);
      return text;
    }
  } // namespace

  template <int dim>
  std::vector<OutputPoint<dim>> read_points(const std::string &text,
                                            const Bodies<dim> &bodies)
  {
    std::vector<OutputPoint<dim>> points;
    for (const std::string &part : split_list(text, ';'))
    {
      const auto [body, numbers] = bodies.split_body(part, points_name);
      const std::vector<double> x = parse_numbers(numbers, points_name);
      if (x.size() != dim)
        throw InputError(points_name,
                         "'" + part + "' does not have " + std::to_string(dim)
                             + " coordinates." + misread_hint(numbers));
      OutputPoint<dim> point{body, {}};
      for (unsigned int d = 0; d < dim; ++d)
        point.place[d] = x[d];
      points.push_back(point);
    }
    return points;
  }

  template <int dim>
  void check_points(const std::vector<OutputPoint<dim>> &points,
                    const Elasticity<dim> &elasticity)
  {
    const la::Vector nothing = elasticity.ghosted(elasticity.vector());
    for (const OutputPoint<dim> &point : points)
    {
      const NodalValue<dim> node =
          nearest_node(elasticity.mapping, elasticity.dof_handler, nothing,
                       point.body, point.place);
      const double away = node.position.distance(point.place);
      // Within a body some node of the cell is nearer than its diameter.
      if (away > node.cell_diameter)
        throw InputError(points_name, "the point " + in_words(point.place)
                                          + " is outside of body "
                                          + std::to_string(point.body + 1)
                                          + ": the nearest node, "
                                          + in_words(node.position) + ", is "
                                          + short_number(away, 3) + " away.");
    }
  }

  template std::vector<OutputPoint<2>> read_points<2>(const std::string &,
                                                      const Bodies<2> &);
  template std::vector<OutputPoint<3>> read_points<3>(const std::string &,
                                                      const Bodies<3> &);
  template void check_points<2>(const std::vector<OutputPoint<2>> &,
                                const Elasticity<2> &);
  template void check_points<3>(const std::vector<OutputPoint<3>> &,
                                const Elasticity<3> &);
} // namespace abut::app

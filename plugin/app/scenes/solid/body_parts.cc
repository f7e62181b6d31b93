// SPDX-License-Identifier: LGPL-2.1-or-later
#include "body_parts.h"

#include "shim/bodies.h"

#include <map>
#include <sstream>

namespace abut::app
{
  template <int dim> std::string BodyPart<dim>::name() const
  {
    std::ostringstream text;
    text << "body " << body + 1
         << (given_name.empty() ? "" : " (" + given_name + ")");
    if (n_parts > 1)
      text << ", of whose " << n_parts << " parts the one with the corner ("
           << first << "),";
    return text.str();
  }

  template <int dim>
  std::vector<BodyPart<dim>>
  find_parts(const dealii::Triangulation<dim> &triangulation)
  {
    const shim::BodyNumbers<dim> numbers(triangulation);
    std::vector<BodyPart<dim>> parts(numbers.n_bodies());
    std::vector<bool> seen(parts.size(), false);
    std::map<unsigned int, unsigned int> n_parts;
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
    {
      const unsigned int number = numbers.of(cell);
      BodyPart<dim> &part = parts[number];
      if (!seen[number])
      {
        seen[number] = true;
        part.body = cell->material_id();
        part.part = n_parts[part.body]++;
        part.first = cell->vertex(0);
      }
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          part.ids.insert(cell->face(f)->boundary_id());
    }
    for (BodyPart<dim> &part : parts)
      part.n_parts = n_parts.at(part.body);
    return parts;
  }

  template struct BodyPart<2>;
  template struct BodyPart<3>;
  template std::vector<BodyPart<2>>
  find_parts(const dealii::Triangulation<2> &);
  template std::vector<BodyPart<3>>
  find_parts(const dealii::Triangulation<3> &);
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Each rank lists the edges between neighbouring nodes of its faces; rank 0
// chains them, beginning at nodes that end only one edge, then anywhere on
// what is left (closed lines).

#include "contact_line.h"

#include "app/restart/disk.h"
#include "contact_output.h"
#include "shim/by_element.h"
#include "shim/cell_quadrature.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

namespace abut::app
{
  namespace
  {
    using Key = dealii::types::global_dof_index;
    using Vector = dealii::Tensor<1, 2>;
    /** x, y, pressure, gap, status; traction, slip and friction in x and y; how
     * much of the pressure is along the normal of the facet that has told its
     * sign, <= 1 */
    using Values = std::array<double, 12>;
    using Node = std::pair<Key, Values>;
    using Edge = std::pair<Node, Node>;

    class FaceReader
    {
    public:
      using Cell = dealii::DoFHandler<2>::active_cell_iterator;

      FaceReader(const dealii::Mapping<2> &mapping,
                 const ContactLineFields &fields)
          : mapping(mapping), fields(fields)
      {
      }

      /** Append the edges of a face from node to node. */
      void read(const Cell &cell, const unsigned int f, std::vector<Edge> &out)
      {
        shim::get_dofs(cell, dofs);
        const auto &fe = cell->get_fe();
        const auto face = cell->face(f);
        const dealii::Tensor<1, 2> along = face->vertex(1) - face->vertex(0);
        const dealii::Tensor<1, 2> outward = face->center() - cell->center();
        std::map<double, Node> ordered;
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (shim::has_node_on_face(fe, i, f)
              && fe.system_to_component_index(i).first == 0)
          {
            const dealii::Point<2> x = mapping.transform_unit_to_real_cell(
                cell, fe.unit_support_point(i));
            ordered[(x - face->vertex(0)) * along] = {
                dofs[i], values(x, node_dofs(fe, i), outward)};
          }
        for (auto next = ordered.begin(); std::next(next) != ordered.end();
             ++next)
          out.emplace_back(next->second, std::next(next)->second);
      }

    private:
      /** Both unknowns of the node of shape function @p i. */
      std::array<Key, 2> node_dofs(const dealii::FiniteElement<2> &fe,
                                   const unsigned int i) const
      {
        std::array<Key, 2> result = {{dofs[i], dofs[i]}};
        for (unsigned int j = 0; j < dofs.size(); ++j)
          if (fe.system_to_component_index(j).first == 1
              && fe.unit_support_point(j).distance(fe.unit_support_point(i))
                     < 1e-10)
            result[1] = dofs[j];
        return result;
      }

      /** Of a node; null: 0. */
      static Vector at(const la::Vector *field, const std::array<Key, 2> &node)
      {
        return field == nullptr
                   ? Vector()
                   : Vector({(*field)(node[0]), (*field)(node[1])});
      }

      static double part_along(const Vector &vector, const Vector &direction)
      {
        const double size = vector.norm() * direction.norm();
        return size > 0. ? std::abs(vector * direction) / size : 0.;
      }

      /** Signed length of a nodal vector, positive outwards. */
      static double length(const la::Vector &field,
                           const std::array<Key, 2> &node,
                           const dealii::Tensor<1, 2> &outward)
      {
        const dealii::Tensor<1, 2> vector({field(node[0]), field(node[1])});
        return std::copysign(vector.norm(), vector * outward);
      }

      Values values(const dealii::Point<2> &x, const std::array<Key, 2> &node,
                    const dealii::Tensor<1, 2> &outward) const
      {
        const double gap =
            fields.gap != nullptr
                ? gap_of_row((*fields.gap)(node[0]), (*fields.gap)(node[1]))
                : 0.;
        const double status =
            fields.status != nullptr ? (*fields.status)(node[0]) : 0.;
        const Vector slip = at(fields.slip, node);
        const Vector friction = at(fields.along, node);
        const la::Vector &normal =
            fields.normal != nullptr ? *fields.normal : fields.traction;
        return {{x[0], x[1], -length(normal, node, outward), gap, status,
                 fields.traction(node[0]), fields.traction(node[1]), slip[0],
                 slip[1], friction[0], friction[1],
                 part_along(at(&normal, node), outward)}};
      }

      const dealii::Mapping<2> &mapping;
      const ContactLineFields &fields;
      std::vector<Key> dofs;
    };

    /** Tell pressure and friction apart, by tangents from neighbour to
     * neighbour unless @p friction is known. */
    void split(ContactLine &line, const std::vector<Vector> &traction,
               const std::vector<Vector> &slip,
               const std::vector<Vector> &friction, const bool is_known)
    {
      for (std::size_t i = 0; i < line.size(); ++i)
      {
        Vector along = line[std::min(i + 1, line.size() - 1)].place
                       - line[i > 0 ? i - 1 : 0].place;
        if (along.norm() > 0.)
          along /= along.norm();
        line[i].slip = slip[i] * along;
        if (is_known)
        {
          line[i].friction =
              std::copysign(friction[i].norm(), friction[i] * along);
          continue;
        }
        line[i].friction = traction[i] * along;
        line[i].pressure = std::copysign(
            (traction[i] - line[i].friction * along).norm(), line[i].pressure);
      }
    }

    /** Nodes and who is next to whom. */
    struct Graph
    {
      std::map<Key, Values> node;
      std::map<Key, std::vector<Key>> neighbors;

      explicit Graph(const std::vector<Edge> &edges)
      {
        for (const auto &[a, b] : edges)
        {
          take(a);
          take(b);
          neighbors[a.first].push_back(b.first);
          neighbors[b.first].push_back(a.first);
        }
      }

      /** At a corner the sign of the pressure is what the facet across it
       * says. */
      void take(const Node &read)
      {
        const auto found = node.insert(read).first;
        if (read.second.back() > found->second.back())
          found->second = read.second;
      }

      /** Walk from @p start over edges not used so far, which are removed. */
      ContactLine walk(const Key start, const bool has_friction,
                       const bool is_known)
      {
        ContactLine line;
        std::vector<Vector> traction, slip, friction;
        for (Key at = start;;)
        {
          const Values &v = node.at(at);
          const dealii::Point<2> place(v[0], v[1]);
          const double arc =
              line.empty()
                  ? 0.
                  : line.back().arc + line.back().place.distance(place);
          line.push_back({arc, place, v[2], v[3], v[4]});
          traction.push_back(Vector({v[5], v[6]}));
          slip.push_back(Vector({v[7], v[8]}));
          friction.push_back(Vector({v[9], v[10]}));
          std::vector<Key> &next = neighbors.at(at);
          if (next.empty())
          {
            if (has_friction)
              split(line, traction, slip, friction, is_known);
            return line;
          }
          const Key to = next.back();
          next.pop_back();
          std::vector<Key> &back = neighbors.at(to);
          back.erase(std::find(back.begin(), back.end(), at));
          at = to;
        }
      }

      /** Node from which to walk next: an end if there is one, the one with
       * the smallest x, then y, of several; or none. */
      const Key *next_start() const
      {
        const Key *best = nullptr;
        const auto rank = [this](const Key key)
        {
          const Values &v = node.at(key);
          return std::make_tuple(neighbors.at(key).size() != 1, v[0], v[1]);
        };
        for (const auto &[key, others] : neighbors)
          if (!others.empty() && (best == nullptr || rank(key) < rank(*best)))
            best = &key;
        return best;
      }
    };
  } // namespace

  std::vector<ContactLine>
  contact_lines(const dealii::Mapping<2> &mapping,
                const dealii::DoFHandler<2> &dof_handler,
                const std::set<dealii::types::boundary_id> &ids,
                const ContactLineFields &fields)
  {
    FaceReader reader(mapping, fields);
    std::vector<Edge> mine;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary()
              && ids.count(cell->face(f)->boundary_id()) > 0)
            reader.read(cell, f, mine);
    std::vector<Edge> edges;
    for (const auto &part : dealii::Utilities::MPI::gather(
             versions::communicator(dof_handler), mine))
      edges.insert(edges.end(), part.begin(), part.end());

    Graph graph(edges);
    std::vector<ContactLine> lines;
    while (const Key *start = graph.next_start())
      lines.push_back(
          graph.walk(*start, fields.slip != nullptr, fields.along != nullptr));
    std::stable_sort(lines.begin(), lines.end(),
                     [](const ContactLine &a, const ContactLine &b)
                     { return a.back().arc > b.back().arc; });
    return lines;
  }

  void write_contact_lines(const std::filesystem::path &file,
                           const std::vector<ContactLine> &lines)
  {
    std::ostringstream out;
    out << "line,arc,x,y,pressure,gap,status,friction,slip\n"
        << std::setprecision(17);
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (const ContactLineNode &node : lines[i])
        out << i + 1 << ',' << node.arc << ',' << node.place[0] << ','
            << node.place[1] << ',' << node.pressure << ',' << node.gap << ','
            << node.status << ',' << node.friction << ',' << node.slip << '\n';
    write_file(file, out.str());
  }

  void write_closed_form(const std::filesystem::path &file,
                         const std::vector<ContactLine> &lines,
                         const dealii::Function<2> &pressure,
                         const dealii::Function<2> &friction)
  {
    constexpr unsigned int n_parts = 8; ///< of the line between two nodes
    std::ostringstream out;
    out << "line,arc,x,y,pressure,friction\n" << std::setprecision(17);
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t k = 0; k + 1 < lines[i].size(); ++k)
        for (unsigned int part = k == 0 ? 0 : 1; part <= n_parts; ++part)
        {
          const ContactLineNode &a = lines[i][k], &b = lines[i][k + 1];
          const double t = double(part) / n_parts;
          const dealii::Point<2> x = a.place + t * (b.place - a.place);
          out << i + 1 << ',' << a.arc + t * (b.arc - a.arc) << ',' << x[0]
              << ',' << x[1] << ',' << pressure.value(x) << ','
              << friction.value(x) << '\n';
        }
    write_file(file, out.str());
  }
} // namespace abut::app

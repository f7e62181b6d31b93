// SPDX-License-Identifier: LGPL-2.1-or-later
/* From the contents of a file to a mesh: numbers become indices, cells are
 * chosen by dimension and checked one by one. Facets and sets are in
 * record_facets.cc. */
#include "mesh_record.h"

#include "app/input/number_text.h"
#include "app/input/short_number.h"
#include "cell_geometry.h"
#include "record_facets.h"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <unordered_set>

namespace abut::app
{
  std::string in_line(const std::size_t line)
  {
    return " in line " + std::to_string(line);
  }

  std::string words_of(const FileElement &element)
  {
    return "the element " + std::to_string(element.number)
           + in_line(element.line);
  }

  namespace
  {
    /** Part of an edge by which its middle node may be away from the middle;
     * of a half circle. */
    constexpr double largest_bow = 0.5;

    /** Part of an edge below which a middle node is in the middle. */
    constexpr double straight = 1e-9;

    /** Part of the size of a mesh in two dimensions that is no height. */
    constexpr double flatness = 1e-6;

    /** The same words, whatever their case. */
    bool is_like(const std::string &a, const std::string &b)
    {
      return lower_case(a) == lower_case(b);
    }

    class RecordMaker
    {
    public:
      RecordMaker(const FileMesh &file, const unsigned int dim,
                  const std::string &part)
          : file(file), dim(dim), part(part)
      {
      }

      MeshRecord make()
      {
        choose_part();
        number_nodes();
        number_elements();
        choose_cells();
        check_plane();
        number_vertices();
        for (const std::size_t cell : chosen)
          add_cell(file.elements[cell]);
        if (!is_curved)
          record.middles.clear();
        add_facets({file, dim, node_of, element_of, vertex_of, chosen, repeated,
                    is_whole},
                   record);
        if (!file.part.empty())
          record.body_names.push_back(file.part);
        return std::move(record);
      }

    private:
      [[noreturn]] static void complain(const std::string &what)
      {
        throw MeshFileError(what);
      }

      /** Elements of the part, unless that is the whole file. */
      void choose_part()
      {
        is_whole = part.empty() || is_like(part, file.part);
        bool is_found = is_whole;
        std::string names;
        for (const FileSet &set : file.sets)
        {
          if (set.name.empty() || set.elements.empty())
            continue;
          names += (names.empty() ? "'" : "', '") + set.name;
          is_found = is_found || is_like(part, set.name);
          if (!is_whole && is_like(part, set.name))
            wanted.insert(set.elements.begin(), set.elements.end());
        }
        if (!is_found)
          complain("it has no part '" + part + "'"
                   + (names.empty() ? " and no sets with names."
                                    : "; its sets are " + names + "'."));
      }

      bool is_wanted(const FileElement &element) const
      {
        return is_whole || wanted.count(element.number) > 0;
      }

      void number_nodes()
      {
        for (std::size_t i = 0; i < file.nodes.size(); ++i)
        {
          const auto [other, is_new] = node_of.emplace(file.nodes[i].number, i);
          if (!is_new)
            complain("the node " + std::to_string(file.nodes[i].number)
                     + in_line(file.nodes[i].line) + " stands in line "
                     + std::to_string(file.nodes[other->second].line)
                     + " too.");
        }
      }

      void number_elements()
      {
        for (std::size_t i = 0; i < file.elements.size(); ++i)
        {
          const FileElement &element = file.elements[i];
          const auto [other, is_new] = element_of.emplace(element.number, i);
          if (!is_new)
            complain(words_of(element) + " stands in line "
                     + std::to_string(file.elements[other->second].line)
                     + " too.");
          check_nodes_of(element);
        }
      }

      void check_nodes_of(const FileElement &element) const
      {
        std::vector<std::int64_t> sorted = element.nodes;
        for (const std::int64_t node : sorted)
          if (node_of.count(node) == 0)
            complain(words_of(element) + " has the node " + std::to_string(node)
                     + ", which does not exist.");
        std::sort(sorted.begin(), sorted.end());
        const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
        if (twice != sorted.end())
          complain(words_of(element) + ", a " + shape_info(element.shape).name
                   + ", has the node " + std::to_string(*twice)
                   + " twice: collapsed elements are not supported.");
      }

      static unsigned int degree_of(const FileElement &element)
      {
        return element.nodes.size() > shape_info(element.shape).n_corners ? 2
                                                                          : 1;
      }

      /** Cells of one kind, each once. */
      void choose_cells()
      {
        const FileElement *first = nullptr;
        for (std::size_t i = 0; i < file.elements.size(); ++i)
        {
          const FileElement &element = file.elements[i];
          const ShapeInfo &info = shape_info(element.shape);
          if (!is_wanted(element))
            continue;
          if (info.dim > dim)
            complain(words_of(element) + " is one of " + info.plural
                     + ", which are three-dimensional: set Dimension = 3.");
          if (info.dim < dim)
            continue;
          first = first != nullptr ? first : &element;
          if (element.shape != first->shape)
            complain(words_of(*first) + " is a " + shape_info(first->shape).name
                     + ", " + words_of(element) + " a " + info.name
                     + ": all cells of a body must be of one kind"
                     + (dim == 2 ? " (in gmsh: Recombine, or not)" : "")
                     + ". Cells of both kinds may be two bodies, each with a "
                       "part of the file (Mesh/Part).");
          if (degree_of(element) != degree_of(*first))
            complain(words_of(*first) + " is of degree "
                     + std::to_string(degree_of(*first)) + ", "
                     + words_of(element) + " of degree "
                     + std::to_string(degree_of(element))
                     + ": all cells of a body must be of one degree.");
          chosen.push_back(i);
        }
        if (first == nullptr)
          complain((is_whole ? "it" : "the part '" + part + "'")
                   + " has no cells, which are "
                   + (dim == 2 ? "triangles or quadrilaterals."
                               : "tetrahedra or hexahedra."));
        record.shape = first->shape;
        record.degree = degree_of(*first);
        drop_repeated_cells();
      }

      /** gmsh writes an element of several groups once for each, with other
       * numbers. */
      void drop_repeated_cells()
      {
        constexpr std::size_t most_corners = 8;
        std::vector<
            std::pair<std::array<std::int64_t, most_corners>, std::size_t>>
            sorted;
        for (const std::size_t cell : chosen)
        {
          const FileElement &element = file.elements[cell];
          std::array<std::int64_t, most_corners> key{};
          std::copy_n(element.nodes.begin(),
                      shape_info(element.shape).n_corners, key.begin());
          std::sort(key.begin(), key.end());
          sorted.emplace_back(key, cell);
        }
        std::sort(sorted.begin(), sorted.end());
        chosen.clear();
        for (std::size_t i = 0; i < sorted.size(); ++i)
          if (i == 0 || sorted[i].first != sorted[i - 1].first)
            chosen.push_back(sorted[i].second);
          else if (file.repeats_elements)
            repeated.emplace(sorted[i].second, chosen.back());
          else
            complain(words_of(file.elements[sorted[i].second])
                     + " has the nodes of another: "
                     + words_of(file.elements[sorted[i - 1].second]) + ".");
        std::sort(chosen.begin(), chosen.end());
      }

      /** Coordinates in the plane only, if all nodes of cells are in one. */
      void check_plane()
      {
        if (dim == 3)
          return;
        Place least, largest;
        bool is_first = true;
        const FileNode *lowest = nullptr, *highest = nullptr;
        for (const std::size_t cell : chosen)
          for (const std::int64_t number : file.elements[cell].nodes)
          {
            const FileNode &node = file.nodes[node_of.at(number)];
            for (unsigned int d = 0; d < 3; ++d)
            {
              least[d] =
                  is_first ? node.place[d] : std::min(least[d], node.place[d]);
              largest[d] = is_first ? node.place[d]
                                    : std::max(largest[d], node.place[d]);
            }
            is_first = false;
            if (lowest == nullptr || node.place[2] < lowest->place[2])
              lowest = &node;
            if (highest == nullptr || node.place[2] > highest->place[2])
              highest = &node;
          }
        const double size = distance(least, largest);
        if (largest[2] - least[2] > flatness * size)
          complain("it is not in a plane of constant z: the node "
                   + std::to_string(lowest->number) + in_line(lowest->line)
                   + " has z = " + short_number(least[2]) + ", the node "
                   + std::to_string(highest->number) + in_line(highest->line)
                   + " " + short_number(largest[2])
                   + ". A scene of 2 dimensions lies in x and y.");
      }

      void number_vertices()
      {
        vertex_of.assign(file.nodes.size(), no_vertex);
        for (const std::size_t cell : chosen)
        {
          const FileElement &element = file.elements[cell];
          for (unsigned int c = 0; c < shape_info(element.shape).n_corners; ++c)
            vertex_of[node_of.at(element.nodes[c])] = 0;
        }
        for (std::size_t node = 0; node < file.nodes.size(); ++node)
          if (vertex_of[node] != no_vertex)
          {
            vertex_of[node] = static_cast<unsigned int>(record.vertices.size());
            record.vertices.push_back(file.nodes[node].place);
          }
      }

      void add_cell(const FileElement &element)
      {
        const ShapeInfo &info = shape_info(element.shape);
        RecordCell cell;
        std::vector<Place> corners;
        for (unsigned int c = 0; c < info.n_corners; ++c)
        {
          cell.corners.push_back(vertex_of[node_of.at(element.nodes[c])]);
          corners.push_back(record.vertices[cell.corners.back()]);
        }
        const Orientation orientation = orientation_of(element.shape, corners);
        if (orientation == Orientation::none)
          complain(words_of(element) + ", a " + info.name
                   + ", is folded or concave, or has no volume.");
        if (record.degree == 2)
          add_middles(element, corners, cell.corners);
        if (orientation == Orientation::reversed)
          reverse_corners(element.shape, cell.corners);
        record.cells.push_back(std::move(cell));
      }

      void add_middles(const FileElement &element,
                       const std::vector<Place> &corners,
                       const std::vector<unsigned int> &vertices)
      {
        const ShapeInfo &info = shape_info(element.shape);
        std::vector<Place> middles;
        double bow = 0.;
        for (std::size_t e = 0; e < info.edges.size(); ++e)
        {
          const auto [a, b] = info.edges[e];
          const FileNode &node =
              file.nodes[node_of.at(element.nodes[info.n_corners + e])];
          const double length = distance(corners[a], corners[b]);
          const double away =
              distance(node.place, middle_of(corners[a], corners[b]));
          if (away > largest_bow * length)
            complain(words_of(element) + " has the node "
                     + std::to_string(node.number) + in_line(node.line)
                     + " in the middle of the edge from node "
                     + std::to_string(element.nodes[a]) + " to "
                     + std::to_string(element.nodes[b]) + "; it is "
                     + short_number(away) + " away from it, the edge "
                     + short_number(length) + " long.");
          bow = std::max(bow, away / length);
          middles.push_back(node.place);
          add_middle(element, node, std::minmax(vertices[a], vertices[b]));
        }
        if (info.n_corners == info.dim + 1
            && !(least_quadratic_jacobian(element.shape, corners, middles)
                 > 0.))
          complain(words_of(element) + " is inverted by its middle nodes.");
        if (info.n_corners != info.dim + 1)
          bow = std::max(bow, bow_inside(element, corners));
        is_curved = is_curved || bow > straight;
        if (bow > straight && info.n_corners != info.dim + 1)
          complain(words_of(element) + ", a " + info.name
                   + " of degree 2, has curved edges, which are not supported: "
                     "write a mesh of degree 1 and name the surfaces in "
                     "Curved sides.");
      }

      /** How far the nodes inside the faces and the cell are away from the
       * means of corners, as part of the first edge. */
      double bow_inside(const FileElement &element,
                        const std::vector<Place> &corners) const
      {
        const ShapeInfo &info = shape_info(element.shape);
        std::vector<std::vector<unsigned int>> parts = info.faces;
        parts.emplace_back();
        for (unsigned int c = 0; c < info.n_corners; ++c)
          parts.back().push_back(c);
        double largest = 0.;
        for (std::size_t i = info.n_corners + info.edges.size();
             i < element.nodes.size(); ++i)
        {
          const Place &node = file.nodes[node_of.at(element.nodes[i])].place;
          double least = std::numeric_limits<double>::infinity();
          for (const std::vector<unsigned int> &part : parts)
          {
            Place mean{};
            for (const unsigned int c : part)
              for (unsigned int d = 0; d < 3; ++d)
                mean[d] += corners[c][d] / double(part.size());
            least = std::min(least, distance(node, mean));
          }
          largest = std::max(largest, least);
        }
        return largest / distance(corners[0], corners[1]);
      }

      void add_middle(const FileElement &element, const FileNode &node,
                      const std::pair<unsigned int, unsigned int> &edge)
      {
        const auto [edge_of_node, is_new_node] =
            edge_of.emplace(node.number, edge);
        const auto [other, is_new_edge] =
            record.middles.emplace(edge, node.place);
        const bool is_corner = vertex_of[node_of.at(node.number)] != no_vertex;
        if (is_corner || is_new_node != is_new_edge
            || edge_of_node->second != edge || other->second != node.place)
          complain(words_of(element) + " has the node "
                   + std::to_string(node.number) + in_line(node.line)
                   + " in the middle of an edge"
                   + (is_corner     ? "; it is a corner of an element."
                      : is_new_node ? ", where another element has another "
                                      "node."
                                    : "; it is in the middle of another edge, "
                                      "too."));
      }

      const FileMesh &file;
      const unsigned int dim;
      const std::string part;
      bool is_whole = true;                    // no part is chosen
      std::unordered_set<std::int64_t> wanted; // elements of the part
      NodeNumbers node_of;
      ElementNumbers element_of;
      std::vector<unsigned int> vertex_of;                   // by node
      std::vector<std::size_t> chosen;                       // cells
      std::unordered_map<std::size_t, std::size_t> repeated; // to the first
      std::unordered_map<std::int64_t, std::pair<unsigned int, unsigned int>>
          edge_of; // by the number of the middle node
      bool is_curved = false;
      MeshRecord record;
    };
  } // namespace

  MeshRecord make_mesh_record(const FileMesh &file, const unsigned int dim,
                              const std::string &part)
  {
    return RecordMaker(file, dim, part).make();
  }
} // namespace abut::app

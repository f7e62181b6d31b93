// SPDX-License-Identifier: LGPL-2.1-or-later
/* All faces of cells, sorted by their corners: two neighbours in this order are
 * a face within the mesh, the others are the boundary. Each facet has a list of
 * the sets that it is in, and each different list becomes a boundary id. */
#include "record_facets.h"

#include "cell_geometry.h"

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    using FacetCorners = std::array<unsigned int, 4>;

    struct Face
    {
      FacetCorners key; ///< sorted
      unsigned int cell, side;
    };

    bool operator<(const Face &a, const Face &b)
    {
      return a.key < b.key;
    }

    /** Part of the extent within which vertices are at the same place. */
    constexpr double same_place = 1e-12;

    /** The vertex of smallest number at the same place as each of @p vertices,
     * where there are any. */
    std::map<unsigned int, unsigned int>
    first_at_place(const std::vector<Place> &places,
                   const std::vector<unsigned int> &vertices)
    {
      double extent = 0.;
      for (const unsigned int v : vertices)
        extent = std::max(extent, distance(places[v], places[vertices[0]]));
      const double reach = same_place * extent;
      std::map<std::array<double, 3>, unsigned int> cubes;
      std::map<unsigned int, unsigned int> result;
      const auto cube = [&](const Place &x, const unsigned int k)
      {
        std::array<double, 3> at;
        for (unsigned int d = 0; d < 3; ++d)
          at[d] = std::floor((x[d] + ((k >> d & 1) != 0 ? reach : -reach))
                             / (4. * reach));
        return at;
      };
      for (const unsigned int v : vertices)
      {
        result[v] = v;
        for (unsigned int k = 0; k < 8 && result[v] == v; ++k)
        {
          const auto found = cubes.find(cube(places[v], k));
          if (found != cubes.end()
              && distance(places[found->second], places[v]) <= reach)
            result[v] = found->second;
        }
        for (unsigned int k = 0; k < 8 && result[v] == v; ++k)
          cubes.emplace(cube(places[v], k), v);
      }
      return result;
    }

    class FacetMaker
    {
    public:
      FacetMaker(const RecordSource &source, MeshRecord &record)
          : source(source), record(record), info(shape_info(record.shape))
      {
      }

      void make()
      {
        make_faces();
        for (const FileElement &element : source.file.elements)
          if (source.is_whole
              && shape_info(element.shape).dim + 1 == source.dim)
            require_face(element);
        for (std::size_t i = 0; i < source.cells.size(); ++i)
          cell_of.emplace(source.cells[i], static_cast<unsigned int>(i));
        for (const auto &[element, first] : source.repeated)
          cell_of.emplace(element, cell_of.at(first));
        content.resize(source.file.sets.size());
        for (std::size_t set = 0; set < content.size(); ++set)
          fill(set);
        number_sets();
        number_facets();
        name_sets();
        warn_of_coincident_facets();
      }

    private:
      struct Content
      {
        std::size_t n_boundary = 0, n_inside = 0, n_cells = 0;
        bool is_partial = false; ///< a node beyond the facets
        unsigned int id = 0;
        std::set<unsigned int> ids; ///< of the facets
      };

      const FileElement &element_of_cell(const unsigned int cell) const
      {
        return source.file.elements[source.cells[cell]];
      }

      FacetCorners key_of(const std::vector<unsigned int> &corners) const
      {
        FacetCorners key;
        key.fill(no_vertex);
        std::copy(corners.begin(), corners.end(), key.begin());
        std::sort(key.begin(), key.end());
        return key;
      }

      std::vector<unsigned int> corners_of(const Face &face) const
      {
        std::vector<unsigned int> result;
        for (const unsigned int c : info.faces[face.side])
          result.push_back(record.cells[face.cell].corners[c]);
        return result;
      }

      void make_faces()
      {
        for (unsigned int c = 0; c < record.cells.size(); ++c)
          for (unsigned int s = 0; s < info.faces.size(); ++s)
            faces.push_back({key_of(corners_of({{}, c, s})), c, s});
        std::sort(faces.begin(), faces.end());
        sets_of.resize(faces.size());
        for (std::size_t i = 0; i < faces.size(); i += number_at(i))
          if (number_at(i) > 2
              || (number_at(i) == 2 && !are_opposite(faces[i], faces[i + 1])))
            throw MeshFileError(
                words_of(element_of_cell(faces[i].cell)) + " and "
                + words_of(element_of_cell(faces[i + 1].cell))
                + (number_at(i) > 2
                       ? " share a face with a third one: cells overlap."
                       : " share a face and lie on the same side of it: they "
                         "overlap."));
      }

      /** How many faces have the corners of the one at @p i, the first one. */
      std::size_t number_at(const std::size_t i) const
      {
        std::size_t n = 1;
        while (i + n < faces.size() && faces[i + n].key == faces[i].key)
          ++n;
        return n;
      }

      /** Whether corners go around a face in opposite directions. */
      bool are_opposite(const Face &a, const Face &b) const
      {
        const std::vector<unsigned int> one = corners_of(a),
                                        other = corners_of(b);
        const std::size_t n = one.size();
        const std::size_t i = static_cast<std::size_t>(
            std::find(other.begin(), other.end(), one[0]) - other.begin());
        return one[1] == other[(i + n - 1) % n] && (n > 2 || i == 1);
      }

      /** The first face with these corners, or the end. */
      std::size_t find_face(const std::vector<unsigned int> &corners) const
      {
        const Face wanted{key_of(corners), 0, 0};
        const auto found = std::lower_bound(faces.begin(), faces.end(), wanted);
        return found == faces.end() || found->key != wanted.key
                   ? faces.size()
                   : static_cast<std::size_t>(found - faces.begin());
      }

      std::vector<unsigned int> corners_of(const FileElement &element) const
      {
        std::vector<unsigned int> corners;
        for (unsigned int c = 0; c < shape_info(element.shape).n_corners; ++c)
          corners.push_back(
              source.vertex_of[source.node_of.at(element.nodes[c])]);
        return corners;
      }

      void require_face(const FileElement &element) const
      {
        const std::vector<unsigned int> corners = corners_of(element);
        if (corners.size() > 4 || find_face(corners) == faces.size())
          throw MeshFileError(words_of(element) + ", a "
                              + shape_info(element.shape).name
                              + ", is no face of a cell.");
      }

      std::string words_of_set(const FileSet &set) const
      {
        return std::string("the ") + set.kind
               + (set.name.empty() ? " " + std::to_string(set.id)
                                   : " '" + set.name + "'");
      }

      void add_to(const std::size_t set, const std::size_t face)
      {
        if (face == faces.size())
          return; // of another part
        if (number_at(face) > 1)
        {
          ++content[set].n_inside;
          return;
        }
        if (sets_of[face].empty() || sets_of[face].back() != set)
        {
          sets_of[face].push_back(static_cast<unsigned int>(set));
          ++content[set].n_boundary;
        }
      }

      /** The element of this number in a set; null if it need not exist. */
      const FileElement *member(const FileSet &set,
                                const std::int64_t number) const
      {
        const auto found = source.element_of.find(number);
        if (found != source.element_of.end())
          return &source.file.elements[found->second];
        if (!set.has_ranges)
          throw MeshFileError(words_of_set(set) + " has the element "
                              + std::to_string(number)
                              + ", which does not exist.");
        return nullptr;
      }

      void fill(const std::size_t index)
      {
        const FileSet &set = source.file.sets[index];
        for (const std::int64_t number : set.elements)
        {
          const FileElement *element = member(set, number);
          if (element == nullptr)
            continue;
          const unsigned int dim = shape_info(element->shape).dim;
          const auto cell = cell_of.find(source.element_of.at(number));
          if (cell != cell_of.end())
          {
            ++content[index].n_cells;
            of_material[cell->second].push_back(index);
          }
          else if (dim + 1 == source.dim)
            add_to(index, find_face(corners_of(*element)));
        }
        for (const auto &[number, side] : set.sides)
          add_side(index, number, side);
        if (!set.nodes.empty())
          add_node_set(index);
      }

      void add_side(const std::size_t index, const std::int64_t number,
                    const unsigned int side)
      {
        const FileSet &set = source.file.sets[index];
        const FileElement *element = member(set, number);
        if (element == nullptr)
          return;
        const ShapeInfo &shape = shape_info(element->shape);
        if (side == every_side)
        {
          for (unsigned int each = 0; each < shape.faces.size(); ++each)
            if (shape.dim == source.dim
                && is_boundary_face(find_face(face_of(*element, each))))
              add_side(index, number, each);
          return;
        }
        if (shape.dim != source.dim || side >= shape.faces.size())
          throw MeshFileError(words_of_set(set) + " has the face S"
                              + std::to_string(side + 1) + " of "
                              + words_of(*element) + ", a " + shape.name
                              + ", which has no such face.");
        add_to(index, find_face(face_of(*element, side)));
      }

      std::vector<unsigned int> face_of(const FileElement &cell,
                                        const unsigned int side) const
      {
        std::vector<unsigned int> corners;
        for (const unsigned int c : shape_info(cell.shape).faces[side])
          corners.push_back(source.vertex_of[source.node_of.at(cell.nodes[c])]);
        return corners;
      }

      bool is_boundary_face(const std::size_t face) const
      {
        return face < faces.size() && number_at(face) == 1;
      }

      void add_node_set(const std::size_t index)
      {
        const FileSet &set = source.file.sets[index];
        std::vector<bool> is_in(record.vertices.size(), false),
            is_reached(record.vertices.size(), false);
        for (const std::int64_t number : set.nodes)
        {
          const auto node = source.node_of.find(number);
          if (node == source.node_of.end() && !set.has_ranges)
            throw MeshFileError(words_of_set(set) + " has the node "
                                + std::to_string(number)
                                + ", which does not exist.");
          if (node != source.node_of.end()
              && source.vertex_of[node->second] != no_vertex)
            is_in[source.vertex_of[node->second]] = true;
        }
        for (std::size_t i = 0; i < faces.size(); i += number_at(i))
        {
          const std::vector<unsigned int> corners = corners_of(faces[i]);
          if (number_at(i) > 1
              || !std::all_of(corners.begin(), corners.end(),
                              [&](const unsigned int v) { return is_in[v]; }))
            continue;
          add_to(index, i);
          for (const unsigned int v : corners)
            is_reached[v] = true;
        }
        content[index].is_partial = is_in != is_reached;
      }

      bool is_boundary(const std::size_t set) const
      {
        return content[set].n_boundary > 0 && !content[set].is_partial;
      }

      /** Numbers of sets that have none, of boundary and of cells apart. */
      void number_sets()
      {
        unsigned int next_boundary = 1, next_material = 1;
        for (std::size_t set = 0; set < content.size(); ++set)
        {
          unsigned int &next = is_boundary(set) ? next_boundary : next_material;
          content[set].id = source.file.sets[set].id;
          if (content[set].id == 0
              && (is_boundary(set) || content[set].n_cells > 0))
            content[set].id = next++;
        }
        for (const auto &[cell, sets] : of_material)
          record.cells[cell].material = content[sets.front()].id;
      }

      /** An id for each list of sets that facets are in: that of its set, or of
       * one whose id no other list has, or a new one. */
      void number_facets()
      {
        std::map<std::vector<unsigned int>, unsigned int> id_of;
        for (std::vector<unsigned int> &list : sets_of)
        {
          list.erase(std::remove_if(list.begin(), list.end(),
                                    [&](const unsigned int set)
                                    { return !is_boundary(set); }),
                     list.end());
          if (!list.empty())
            id_of[list] = 0;
        }
        std::set<unsigned int> taken;
        unsigned int last = 0;
        for (std::size_t set = 0; set < content.size(); ++set)
          last = is_boundary(set) ? std::max(last, content[set].id) : last;
        for (auto &[list, id] : id_of)
          if (list.size() == 1)
            taken.insert(id = content[list.front()].id);
        for (auto &[list, id] : id_of)
        {
          for (const unsigned int set : list)
            if (id == 0 && taken.count(content[set].id) == 0)
              taken.insert(id = content[set].id);
          if (id == 0)
            id = ++last;
          for (const unsigned int set : list)
            content[set].ids.insert(id);
        }
        for (std::size_t i = 0; i < faces.size(); ++i)
          if (!sets_of[i].empty())
            record.facets.push_back(
                {corners_of(faces[i]), id_of.at(sets_of[i])});
      }

      void name_sets()
      {
        std::map<std::string, std::size_t> place; // in boundary_sets
        std::set<std::string> ambiguous;
        for (std::size_t i = 0; i < content.size(); ++i)
        {
          const FileSet &set = source.file.sets[i];
          const Content &has = content[i];
          if (has.n_cells > 0)
            record.materials.push_back({set.name, has.id, {has.id}});
          if (has.n_cells == record.cells.size() && !set.name.empty())
            record.body_names.push_back(set.name);
          if (!is_boundary(i))
          {
            if (!set.name.empty())
              record.other_sets.emplace(set.name, why_not(set, has));
            continue;
          }
          const bool is_named = !set.name.empty();
          const auto other = is_named ? place.find(set.name) : place.end();
          if (other == place.end())
          {
            if (is_named)
              place[set.name] = record.boundary_sets.size();
            record.boundary_sets.push_back({set.name, has.id, has.ids});
          }
          else if (record.boundary_sets[other->second].ids != has.ids)
            ambiguous.insert(set.name);
        }
        for (RecordSet &set : record.boundary_sets)
          record.other_sets.erase(set.name);
        for (const std::string &name : ambiguous)
        {
          record.boundary_sets[place.at(name)].name.clear();
          record.other_sets[name] =
              "is the name of a surface and of a set with other facets";
        }
      }

      static std::string why_not(const FileSet &set, const Content &has)
      {
        if (has.is_partial)
          return "is a node set with nodes beyond whole facets of the boundary";
        if (has.n_inside > 0)
          return std::string("is a ") + set.kind
                 + " within the mesh, not on its boundary";
        if (has.n_cells > 0)
          return std::string("is a ") + set.kind + " of cells";
        return std::string("is a ") + set.kind
               + " without facets of the boundary";
      }

      /** A slit, or nodes that were to be merged? */
      void warn_of_coincident_facets()
      {
        std::vector<std::size_t> boundary;
        std::vector<unsigned int> vertices;
        for (std::size_t i = 0; i < faces.size(); i += number_at(i))
          if (number_at(i) == 1)
          {
            boundary.push_back(i);
            for (const unsigned int v : corners_of(faces[i]))
              vertices.push_back(v);
          }
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()),
                       vertices.end());
        const auto first = first_at_place(record.vertices, vertices);
        std::map<FacetCorners, std::size_t> seen;
        std::size_t n_found = 0;
        const Face *a = nullptr, *b = nullptr;
        for (const std::size_t i : boundary)
        {
          std::vector<unsigned int> corners = corners_of(faces[i]);
          for (unsigned int &v : corners)
            v = first.at(v);
          const auto [other, is_new] = seen.emplace(key_of(corners), i);
          if (is_new || !sets_of[i].empty() || !sets_of[other->second].empty())
            continue;
          ++n_found;
          a = &faces[other->second];
          b = &faces[i];
        }
        if (n_found == 0)
          return;
        const std::string pair = words_of(element_of_cell(a->cell)) + " and "
                                 + words_of(element_of_cell(b->cell));
        if (boundary.size() == faces.size())
          throw MeshFileError("its cells share no nodes; " + pair
                              + ", for example, have separate nodes at the "
                                "same positions. Merge them.");
        record.warnings.push_back(
            std::to_string(n_found)
            + (n_found == 1 ? " facet lies" : " facets lie")
            + " on another with separate nodes, such as between " + pair
            + ": the mesh is not connected there. Merge the nodes, or give the "
              "sides of a slit boundary ids.");
      }

      const RecordSource &source;
      MeshRecord &record;
      const ShapeInfo &info;
      std::vector<Face> faces;
      std::vector<std::vector<unsigned int>> sets_of;        ///< by first face
      std::unordered_map<std::size_t, unsigned int> cell_of; ///< by element
      std::map<unsigned int, std::vector<std::size_t>> of_material; ///< by cell
      std::vector<Content> content;                                 ///< by set
    };
  } // namespace

  void add_facets(const RecordSource &source, MeshRecord &record)
  {
    FacetMaker(source, record).make();
  }
} // namespace abut::app

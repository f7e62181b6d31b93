// SPDX-License-Identifier: LGPL-2.1-or-later
// Red refinement with the shortest diagonal: J. Bey, Tetrahedral grid
// refinement, Computing 55 (1995); S. Zhang, Successive subdivisions of
// tetrahedra, Houston J. Math. 21 (1995). Bisection of longest edges: M.-C.
// Rivara, Int. J. Numer. Methods Eng. 20 (1984). Edges have an order, by length
// and then by number. In each round edges are cut that are the longest one of
// all cells around them: those that the longest edges of cells to bisect lead
// to, from longest edge to longest edge. So there are never hanging nodes.
#include "simplex_refinement.h"

#include <deal.II/grid/manifold.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace abut::app
{
  namespace
  {
    using Edge = std::pair<unsigned int, unsigned int>;

    template <std::size_t n> using VertexNumbers = std::array<unsigned int, n>;

    Edge edge_between(const unsigned int a, const unsigned int b)
    {
      return std::minmax(a, b);
    }

    /** Diagonals are equal if their lengths differ by less than this part. */
    constexpr double round_off = 1e-10;

    template <int dim> class SimplexRefinement
    {
    public:
      /** @param level of new vertices */
      SimplexRefinement(const dealii::Triangulation<dim> &mesh,
                        MeshDescription<dim> &description,
                        const unsigned int level)
          : mesh(mesh),
            description(description),
            level(level),
            vertices(description.vertices)
      {
        description.origins.resize(vertices.size());
      }

      void refine_red()
      {
        find_curved_edges(sides());
        curved_parents.swap(description.middles);
        refine(description.cells);
        refine(sides());
        if constexpr (dim == 3)
          list_boundary_edges();
      }

      /** One round of bisections.
       * @param wanted of each cell, how often it is to be bisected yet
       * @param origin becomes that of the parts
       * @return whether any is */
      bool bisect(std::vector<unsigned int> &wanted,
                  std::vector<unsigned int> &origin)
      {
        find_cuts(wanted);
        if (cuts.empty())
          return false;
        find_curved_edges(sides());
        std::vector<unsigned int> wanted_yet, origin_of_parts;
        cut(description.cells,
            [&](const std::size_t parent, const unsigned int n_parts)
            {
              wanted_yet.insert(wanted_yet.end(), n_parts,
                                wanted[parent]
                                    - (wanted[parent] > 0 && n_parts > 1));
              origin_of_parts.insert(origin_of_parts.end(), n_parts,
                                     origin[parent]);
            });
        wanted.swap(wanted_yet);
        origin.swap(origin_of_parts);
        cut(sides(), [](std::size_t, unsigned int) {});
        if constexpr (dim == 3)
          list_boundary_edges();
        return true;
      }

    private:
      using Side = dealii::CellData<dim - 1>;

      std::vector<Side> &sides()
      {
        if constexpr (dim == 2)
          return description.faces.boundary_lines;
        else
          return description.faces.boundary_quads;
      }

      void find_curved_edges(const std::vector<Side> &of_sides)
      {
        for (const Side &side : of_sides)
          if (side.manifold_id != dealii::numbers::flat_manifold_id)
            for (std::size_t i = 0; i < side.vertices.size(); ++i)
              for (std::size_t j = 0; j < i; ++j)
                curved.emplace(edge_between(side.vertices[i], side.vertices[j]),
                               side.manifold_id);
      }

      unsigned int middle(const unsigned int a, const unsigned int b)
      {
        const Edge edge = edge_between(a, b);
        const auto [found, is_new] =
            middles.emplace(edge, static_cast<unsigned int>(vertices.size()));
        if (!is_new)
          return found->second;
        const dealii::Point<dim> x = vertices[edge.first],
                                 y = vertices[edge.second];
        const auto parabola = curved_parents.find(edge);
        const auto on = curved.find(edge);
        vertices.push_back(parabola != curved_parents.end() ? parabola->second
                           : on == curved.end()
                               ? 0.5 * (x + dealii::Tensor<1, dim>(y))
                               : mesh.get_manifold(on->second)
                                     .get_intermediate_point(x, y, 0.5));
        description.origins.push_back({level, {{edge.first, edge.second}}});
        return found->second;
      }

      /** Replace the elements of a list by their children. */
      template <int structdim>
      void refine(std::vector<dealii::CellData<structdim>> &list)
      {
        std::vector<dealii::CellData<structdim>> children;
        children.reserve(list.size() << structdim);
        for (const dealii::CellData<structdim> &parent : list)
        {
          VertexNumbers<structdim + 1> corners{};
          std::copy(parent.vertices.begin(), parent.vertices.end(),
                    corners.begin());
          for (const auto &part : parts(corners))
          {
            dealii::CellData<structdim> child(parent);
            child.vertices.assign(part.begin(), part.end());
            if constexpr (structdim == dim)
            {
              orient(child.vertices);
              add_middles(corners, child.vertices);
            }
            children.push_back(child);
          }
        }
        list.swap(children);
      }

      std::array<VertexNumbers<2>, 2> parts(const VertexNumbers<2> &v)
      {
        const unsigned int m = middle(v[0], v[1]);
        return {{{{v[0], m}}, {{m, v[1]}}}};
      }

      std::array<VertexNumbers<3>, 4> parts(const VertexNumbers<3> &v)
      {
        const unsigned int a = middle(v[0], v[1]), b = middle(v[1], v[2]),
                           c = middle(v[2], v[0]);
        return {{{{v[0], a, c}}, {{a, v[1], b}}, {{c, b, v[2]}}, {{a, b, c}}}};
      }

      std::array<VertexNumbers<4>, 8> parts(const VertexNumbers<4> &v)
      {
        std::array<VertexNumbers<4>, 8> result;
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < 4; ++j)
            result[i][j] = i == j ? v[i] : middle(v[i], v[j]);
        const auto m = [&](const unsigned int i, const unsigned int j)
        { return result[i][j]; };
        // Two opposite middles, and the four around them.
        const VertexNumbers<6> choices[3] = {
            {{m(0, 1), m(2, 3), m(0, 2), m(0, 3), m(1, 3), m(1, 2)}},
            {{m(0, 2), m(1, 3), m(0, 1), m(0, 3), m(2, 3), m(1, 2)}},
            {{m(0, 3), m(1, 2), m(0, 1), m(0, 2), m(2, 3), m(1, 3)}}};
        const auto length = [&](const VertexNumbers<6> &choice)
        { return vertices[choice[0]].distance(vertices[choice[1]]); };
        const VertexNumbers<6> *shortest = &choices[0];
        for (const VertexNumbers<6> &choice : choices)
          if (length(choice) < (1. - round_off) * length(*shortest))
            shortest = &choice;
        const VertexNumbers<6> &c = *shortest;
        for (unsigned int i = 0; i < 4; ++i)
          result[4 + i] = {{c[0], c[1], c[2 + i], c[2 + (i + 1) % 4]}};
        return result;
      }

      /** Whether an edge is cut before another one. */
      bool is_before(const Edge &a, const Edge &b) const
      {
        const double of_a = length(a), of_b = length(b);
        return of_a != of_b ? of_a > of_b : a < b;
      }

      double length(const Edge &edge) const
      {
        return (vertices[edge.first] - vertices[edge.second]).norm_square();
      }

      /** Call @p action with each edge of a cell or face. */
      template <class Corners, class Action>
      static void for_each_edge(const Corners &corners, const Action &action)
      {
        for (std::size_t i = 0; i < corners.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            action(edge_between(corners[i], corners[j]));
      }

      template <class Corners> Edge longest(const Corners &corners) const
      {
        Edge result = edge_between(corners[0], corners[1]);
        for_each_edge(corners,
                      [&](const Edge &edge)
                      {
                        if (is_before(edge, result))
                          result = edge;
                      });
        return result;
      }

      /** Fill the list of edges to cut in this round. */
      void find_cuts(const std::vector<unsigned int> &wanted)
      {
        std::vector<Edge> first;
        std::map<Edge, std::vector<unsigned int>> around;
        std::vector<Edge> path;
        for (unsigned int c = 0; c < description.cells.size(); ++c)
        {
          const auto &corners = description.cells[c].vertices;
          for_each_edge(corners,
                        [&](const Edge &edge) { around[edge].push_back(c); });
          first.push_back(longest(corners));
          if (wanted[c] > 0)
            path.push_back(first.back());
        }
        std::set<Edge> seen;
        while (!path.empty())
        {
          const Edge edge = path.back();
          path.pop_back();
          if (!seen.insert(edge).second)
            continue;
          bool is_first = true;
          for (const unsigned int c : around.at(edge))
            if (first[c] != edge)
            {
              is_first = false;
              path.push_back(first[c]);
            }
          if (is_first)
            cuts.insert(edge);
        }
      }

      /** Replace the elements of a list by their parts. Calls @p note with the
       * number of each element and of its parts. */
      template <int structdim, class Note>
      void cut(std::vector<dealii::CellData<structdim>> &list, const Note &note)
      {
        std::vector<dealii::CellData<structdim>> result;
        for (std::size_t parent = 0; parent < list.size(); ++parent)
        {
          const Edge edge = longest(list[parent].vertices);
          const bool is_cut = cuts.count(edge) > 0;
          note(parent, is_cut ? 2 : 1);
          if (!is_cut)
          {
            result.push_back(list[parent]);
            continue;
          }
          const unsigned int between = middle(edge.first, edge.second);
          for (const unsigned int end : {edge.first, edge.second})
          {
            result.push_back(list[parent]);
            std::replace(result.back().vertices.begin(),
                         result.back().vertices.end(), end, between);
          }
        }
        list.swap(result);
      }

      /** Add the middles of the curved edges of a child: the map of degree 2 of
       * the parent at the middle between its ends. */
      template <class Corners>
      void add_middles(const VertexNumbers<dim + 1> &parent,
                       const Corners &child)
      {
        if (curved_parents.empty())
          return;
        for (std::size_t i = 0; i < child.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
          {
            const dealii::Point<dim> a = vertices[child[i]],
                                     b = vertices[child[j]];
            add_middle(child[i], a, child[j], b,
                       middle_in(parent, child[i], child[j]),
                       description.middles);
          }
      }

      /** The place in a parent between two of its corners and edges' middles.
       */
      dealii::Point<dim> middle_in(const VertexNumbers<dim + 1> &parent,
                                   const unsigned int v, const unsigned int w)
      {
        // Barycentric coordinates.
        std::array<double, dim + 1> at{};
        for (const unsigned int end : {v, w})
          for (std::size_t k = 0; k <= dim; ++k)
            for (std::size_t l = 0; l <= k; ++l)
              if ((k == l ? parent[k] : middle(parent[k], parent[l])) == end)
              {
                at[k] += 0.25;
                at[l] += 0.25;
              }
        dealii::Point<dim> result;
        for (std::size_t k = 0; k <= dim; ++k)
        {
          result += at[k] * (2. * at[k] - 1.)
                    * dealii::Tensor<1, dim>(vertices[parent[k]]);
          for (std::size_t l = 0; l < k; ++l)
            result += 4. * at[k] * at[l]
                      * dealii::Tensor<1, dim>(
                          vertices[middle(parent[k], parent[l])]);
        }
        return result;
      }

      /** Give a cell a positive volume. */
      template <class Corners> void orient(Corners &corners) const
      {
        dealii::Tensor<2, dim> edges;
        for (unsigned int d = 0; d < dim; ++d)
          edges[d] = vertices[corners[d + 1]] - vertices[corners[0]];
        if (determinant(edges) < 0.)
          std::swap(corners[dim - 1], corners[dim]);
      }

      /** Edges of the boundary have the id of a face that they are of. */
      void list_boundary_edges()
      {
        std::vector<dealii::CellData<1>> &lines =
            description.faces.boundary_lines;
        lines.clear();
        std::set<Edge> seen;
        for (const dealii::CellData<2> &face : description.faces.boundary_quads)
          for (unsigned int i = 0; i < 3; ++i)
          {
            const Edge edge =
                edge_between(face.vertices[i], face.vertices[(i + 1) % 3]);
            if (!seen.insert(edge).second)
              continue;
            dealii::CellData<1> line;
            line.vertices = {edge.first, edge.second};
            line.boundary_id = face.boundary_id;
            line.manifold_id = face.manifold_id;
            lines.push_back(line);
          }
      }

      const dealii::Triangulation<dim> &mesh;
      MeshDescription<dim> &description;
      const unsigned int level;
      std::vector<dealii::Point<dim>> &vertices;
      std::map<Edge, unsigned int> middles;
      std::set<Edge> cuts;
      std::map<Edge, dealii::types::manifold_id> curved;
      EdgeMiddles<dim> curved_parents;
    };

    template <int dim>
    unsigned int next_level(const MeshDescription<dim> &description)
    {
      unsigned int result = 1;
      for (const VertexOrigin &origin : description.origins)
        result = std::max(result, origin.level + 1);
      return result;
    }
  } // namespace

  template <int dim>
  void refine_red(const dealii::Triangulation<dim> &mesh,
                  MeshDescription<dim> &description)
  {
    SimplexRefinement<dim>(mesh, description, next_level(description))
        .refine_red();
  }

  template <int dim>
  std::vector<unsigned int> bisect(const dealii::Triangulation<dim> &mesh,
                                   const std::vector<bool> &marked,
                                   MeshDescription<dim> &description)
  {
    std::vector<unsigned int> origin(description.cells.size()), wanted;
    std::iota(origin.begin(), origin.end(), 0u);
    for (const bool is_marked : marked)
      wanted.push_back(is_marked ? dim : 0);
    const unsigned int level = next_level(description);
    while (
        SimplexRefinement<dim>(mesh, description, level).bisect(wanted, origin))
    {
    }
    return origin;
  }

  template std::vector<unsigned int> bisect(const dealii::Triangulation<2> &,
                                            const std::vector<bool> &,
                                            MeshDescription<2> &);
  template std::vector<unsigned int> bisect(const dealii::Triangulation<3> &,
                                            const std::vector<bool> &,
                                            MeshDescription<3> &);
  template void refine_red(const dealii::Triangulation<2> &,
                           MeshDescription<2> &);
  template void refine_red(const dealii::Triangulation<3> &,
                           MeshDescription<3> &);
} // namespace abut::app

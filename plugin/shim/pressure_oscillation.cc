// SPDX-License-Identifier: LGPL-2.1-or-later
// Tractions that change from node to node: displacements do not determine them,
// or bodies touch at single nodes of facets that do not match. d = p - mean of
// the neighbours is 0 for linear tractions and the same at neighbours where
// they are evenly curved. For p = c + a (-1)^i it is 2 a (-1)^i, and 4 a (-1)^i
// is its difference from its own mean over the neighbours. At an open node
// between closed ones, d alone is that of an alternating traction. Quadrature
// points differ from the interpolant of the nodes, besides.
#include "pair_examination.h"
#include "surface_fields.h"

#include <abut/strategy.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** A node of a secondary surface. */
    template <int dim> struct SurfaceNode
    {
      std::vector<NodeIndex> neighbours; ///< along edges of facets
      std::vector<NodeIndex> along;      ///< 3D: along the surface's border
      /** [neighbours] Weights of a mean that has the value of linear functions
       * at the node. */
      std::vector<double> weights;
      Direction<dim> traction, deviation;
      double area = 0.;
      bool is_inner = true;     ///< of the surface
      bool is_closed = false;   ///< most of its points, by weight
      bool is_open = true;      ///< all of its points
      bool is_in_zone = false;  ///< closed, or open among closed ones
      bool is_slit = false;     ///< open, directly between closed ones
      Direction<dim> drop;      ///< slit: traction less the mean of these
      bool is_measured = false; ///< whether it has a deviation
    };

    template <int dim>
    using SurfaceNodes = std::map<NodeIndex, SurfaceNode<dim>>;

    template <int dim>
    SurfaceNodes<dim> connect(const ContactSurface<dim> &surface,
                              const SurfacePair<dim> &pair)
    {
      SurfaceNodes<dim> nodes;
      // Facets of an edge, from end to end, by its sorted nodes.
      struct Border
      {
        std::vector<NodeIndex> edge;
        unsigned int n_facets = 0;
      };
      std::map<std::vector<NodeIndex>, Border> borders;
      const auto add_border = [&borders](const std::vector<NodeIndex> &edge)
      {
        auto key = edge;
        std::sort(key.begin(), key.end());
        Border &border = borders[key];
        border.edge = edge;
        ++border.n_facets;
      };
      const auto link = [&nodes](const NodeIndex a, const NodeIndex b)
      {
        nodes[a].neighbours.push_back(b);
        nodes[b].neighbours.push_back(a);
      };
      for (const std::int32_t f : pair.secondary.facet)
      {
        const auto &facet = surface.facets[f];
        const unsigned int n = abut_facet_n_corners(facet.kind),
                           n_edges = dim == 2 ? 1 : n,
                           n_nodes = pair.has_linear_multipliers()
                                         ? n
                                         : facet.n_nodes();
        for (unsigned int k = 0; k < n_edges; ++k)
        {
          const auto ends = corners_of_edge(facet.kind, k);
          const NodeIndex a = facet.node[ends.first],
                          b = facet.node[ends.second];
          std::vector<NodeIndex> edge = {a, b};
          if (n_nodes > n)
            edge.insert(edge.begin() + 1, facet.node[n + k]);
          for (std::size_t e = 1; e < edge.size(); ++e)
            link(edge[e - 1], edge[e]);
          if (n_nodes > 2 * n)
            link(edge[1], facet.node[2 * n]);
          if (dim == 3)
            add_border(edge);
          else
            for (const NodeIndex end : {a, b})
              add_border({end});
        }
      }
      for (const auto &[key, border] : borders)
        for (std::size_t e = 0; e < border.edge.size() && border.n_facets == 1;
             ++e)
        {
          SurfaceNode<dim> &node = nodes[border.edge[e]];
          node.is_inner = false;
          if (e > 0)
            node.along.push_back(border.edge[e - 1]);
          if (e + 1 < border.edge.size())
            node.along.push_back(border.edge[e + 1]);
        }
      for (auto &[number, node] : nodes)
      {
        auto &list = node.neighbours;
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
      }
      return nodes;
    }

    /** Mean tractions of the points of nodes, with those of other ranks.
     * Quadrature points count by the squares of shape functions, which
     * integrate to zero or less at corners of quadratic facets. Collective. */
    template <int dim>
    void add_tractions(const PairPoints<dim> &points, const std::size_t pair,
                       const double *row_pressure,
                       const std::uint8_t *row_state, SurfaceNodes<dim> &nodes)
    {
      const dealii::IndexSet &owned =
          points.host().dof_handler.locally_owned_dofs();
      const auto &surface = points.surface().nodes;
      la::Vector force(owned, points.host().communicator), area(force),
          closed(force);
      points.for_each_component(
          [&](const PointRow<dim> &row)
          {
            if (row.place.pair != pair)
              return;
            const bool is_first = static_cast<std::size_t>(
                                      points.view().component_start[row.point])
                                  == row.row;
            points.for_each_share(
                row,
                [&](const NodeIndex node, const double share)
                {
                  const double w =
                      share * share * points.view().weight[row.point];
                  for (unsigned int d = 0; d < dim; ++d)
                    force(surface[node].dof[d]) +=
                        w * row_pressure[row.row] * row.direction[d];
                  if (is_first)
                    area(surface[node].dof[0]) += w;
                  if (row_state[row.row] != ABUT_STATE_OPEN)
                    closed(surface[node].dof[0]) += is_first ? w : 0.;
                });
          });
      std::vector<dealii::types::global_dof_index> others;
      for (const auto &[number, node] : nodes)
        for (const auto dof : surface[number].dof)
          if (!owned.is_element(dof))
            others.push_back(dof);
      std::sort(others.begin(), others.end());
      dealii::IndexSet needed(owned.size());
      needed.add_indices(others.begin(), others.end());
      const auto everywhere = [&](la::Vector &value)
      {
        value.compress(dealii::VectorOperation::add);
        la::Vector result(owned, needed, points.host().communicator);
        result = value;
        return result;
      };
      const la::Vector forces = everywhere(force), areas = everywhere(area),
                       closed_areas = everywhere(closed);
      for (auto &[number, node] : nodes)
      {
        node.area = areas(surface[number].dof[0]);
        const double closed_area = closed_areas(surface[number].dof[0]);
        node.is_closed = closed_area > 0.5 * node.area;
        node.is_open = !(closed_area > 0.);
        for (unsigned int d = 0; d < dim && node.area > 0.; ++d)
          node.traction[d] = forces(surface[number].dof[d]) / node.area;
      }
    }

    /** Whether two neighbours have a node between them: the cosine of the angle
     * at the node is that of a line, but for a bend. */
    template <int dim>
    bool are_opposite(const ContactSurface<dim> &surface, const NodeIndex node,
                      const NodeIndex a, const NodeIndex b)
    {
      constexpr double bend = 0.15;
      const Direction<dim> to_a = surface.nodes[a].point
                                  - surface.nodes[node].point,
                           to_b = surface.nodes[b].point
                                  - surface.nodes[node].point;
      return to_a * to_b < (bend - 1.) * to_a.norm() * to_b.norm();
    }

    /** Find SurfaceNode::is_slit and drop, the largest. */
    template <int dim>
    void find_slits(const ContactSurface<dim> &surface,
                    SurfaceNodes<dim> &nodes)
    {
      for (auto &[number, node] : nodes)
        for (const NodeIndex a : node.neighbours)
          for (const NodeIndex b : node.neighbours)
          {
            const SurfaceNode<dim> &one = nodes.at(a), &other = nodes.at(b);
            if (node.is_closed || a >= b || !one.is_closed || !other.is_closed
                || !are_opposite(surface, number, a, b))
              continue;
            const Direction<dim> drop =
                node.traction - (one.traction + other.traction) / 2.;
            node.is_slit = true;
            if (drop.norm_square() > node.drop.norm_square())
              node.drop = drop;
          }
    }

    /** Find SurfaceNode::is_in_zone: gaps between closed nodes are filled by
     * adding rings of nodes and taking as many away, but for open nodes that
     * are connected to others outside and no slits; then the edge of the zone
     * is taken away, where tractions are steep. Collective. */
    template <int dim>
    void find_zone(const PairPoints<dim> &points, SurfaceNodes<dim> &nodes)
    {
      using Node = SurfaceNode<dim>;
      std::vector<std::uint8_t> marks(points.surface().nodes.size());
      // Nodes that enter or leave the zone, n times, as their owners find.
      const auto repeat = [&](const int n, const auto &changes)
      {
        for (int i = 0; i < n; ++i)
        {
          std::fill(marks.begin(), marks.end(), 0);
          for (const auto &[number, node] : nodes)
            marks[number] =
                points.set().is_owned(number) && changes(node) ? 1 : 0;
          points.exchange().merge_marks(points.surface(), marks);
          for (auto &[number, node] : nodes)
            node.is_in_zone = node.is_in_zone != (marks[number] != 0);
        }
      };
      const auto has_neighbour = [&](const Node &node, const auto &property)
      {
        return std::any_of(node.neighbours.begin(), node.neighbours.end(),
                           [&](const NodeIndex other)
                           { return property(nodes.at(other)); });
      };
      const auto is_inside = [](const Node &node) { return node.is_in_zone; };
      const auto enters = [&](const Node &node)
      { return !is_inside(node) && has_neighbour(node, is_inside); };
      const auto leaves = [&](const Node &node) {
        return is_inside(node) && has_neighbour(node, std::not_fn(is_inside));
      };
      const auto is_connected = [&](const Node &node)
      {
        const auto is_outside = [&](const Node &other)
        { return other.is_open && !(other.is_in_zone && node.is_inner); };
        return is_inside(node) && node.is_open && !node.is_slit
               && has_neighbour(node, is_outside);
      };
      constexpr int n_rings = 4;
      for (auto &[number, node] : nodes)
        node.is_in_zone = node.is_closed;
      repeat(n_rings, enters);
      repeat(n_rings, leaves);
      repeat(n_rings, is_connected);
      repeat(1, leaves);
    }

    /** Find SurfaceNode::weights: of the nearest linear function in the mean
     * square, with inverse squares of the distances. */
    template <int dim>
    void find_weights(const ContactSurface<dim> &surface,
                      const NodeIndex number, SurfaceNode<dim> &node)
    {
      std::vector<Direction<dim>> to;
      Direction<dim> mean, slope;
      dealii::SymmetricTensor<2, dim> spread;
      for (const NodeIndex other : node.neighbours)
      {
        const Direction<dim> r =
            surface.nodes[other].point - surface.nodes[number].point;
        to.push_back(r);
        node.weights.push_back(1. / r.norm_square());
        mean += node.weights.back() * r;
        spread += node.weights.back()
                  * dealii::symmetrize(dealii::outer_product(r, r));
      }
      // The last direction is the surface's normal. Neighbours in line have
      // one direction less.
      constexpr double in_line = 1e-6;
      const auto directions = dealii::eigenvectors(spread);
      for (unsigned int d = 0; d + 1 < dim; ++d)
        if (directions[d].first > in_line)
          slope += mean * directions[d].second / directions[d].first
                   * directions[d].second;
      double sum = 0.;
      for (std::size_t j = 0; j < to.size(); ++j)
        sum += node.weights[j] *= 1. - slope * to[j];
      for (double &weight : node.weights)
        weight /= sum;
    }
    /** Leave the lines along the border of the surface only. */
    template <int dim>
    void keep_borders(const ContactSurface<dim> &surface,
                      SurfaceNodes<dim> &nodes)
    {
      for (auto &[number, node] : nodes)
      {
        node.neighbours = node.along;
        node.weights.clear();
        node.is_measured = false;
        node.is_inner =
            node.along.size() == 2
            && are_opposite(surface, number, node.along[0], node.along[1]);
      }
    }

    /** Square of what differs from the interpolant of the nodes at quadrature
     * points between nodes that are measured, in the mean. Collective. */
    template <int dim>
    double square_at_points(const PairPoints<dim> &points,
                            const std::size_t pair, const double *row_pressure,
                            const SurfaceNodes<dim> &nodes)
    {
      double sums[2] = {0., 0.};
      std::vector<Direction<dim>> traction(points.view().n_points);
      std::vector<std::uint8_t> is_inside(traction.size(), 0);
      points.for_each_component(
          [&](const PointRow<dim> &row)
          {
            if (row.place.pair != pair || row.place.node >= 0)
              return;
            traction[row.point] += row_pressure[row.row] * row.direction;
            is_inside[row.point] = 1;
          });
      for (std::size_t i = 0; i < traction.size(); ++i)
      {
        if (is_inside[i] == 0)
          continue;
        points.for_each_secondary(
            i,
            [&](const NodeIndex number, const double share)
            {
              const auto node = nodes.find(number);
              if (node == nodes.end() || !node->second.is_measured)
                is_inside[i] = 0;
              else
                traction[i] -= share * node->second.traction;
            });
        if (is_inside[i] == 0)
          continue;
        sums[0] += points.view().weight[i] * traction[i].norm_square();
        sums[1] += points.view().weight[i];
      }
      MPI::sum(sums, points.host().communicator, sums);
      return sums[1] > 0. ? sums[0] / sums[1] : 0.;
    }

    /** Part of the tractions of a zone that alternates; negative if there are
     * too few nodes for a pattern. Collective. */
    template <int dim>
    double alternating_part(const PairPoints<dim> &points,
                            const std::size_t pair, const double *row_pressure,
                            SurfaceNodes<dim> &nodes)
    {
      const auto all = [&](const SurfaceNode<dim> &node, const auto property)
      {
        return node.*property
               && std::all_of(node.neighbours.begin(), node.neighbours.end(),
                              [&](const NodeIndex other)
                              { return nodes.at(other).*property; });
      };
      const auto mean = [&](const SurfaceNode<dim> &node, const auto value)
      {
        Direction<dim> sum;
        for (std::size_t j = 0; j < node.neighbours.size(); ++j)
          sum += node.weights[j] * (nodes.at(node.neighbours[j]).*value);
        return sum;
      };
      // Normals of neighbours that make a corner.
      constexpr double cosine_at_corner = 0.85;
      const auto is_corner = [&](const SurfaceNode<dim> &node)
      {
        return !points.pairs()[pair].data.tied
               && std::any_of(node.neighbours.begin(), node.neighbours.end(),
                              [&](const NodeIndex other)
                              {
                                const auto &t = nodes.at(other).traction;
                                return node.traction * t
                                       < cosine_at_corner * node.traction.norm()
                                             * t.norm();
                              });
      };
      // Edges and corners of surfaces and edges of contact zones are steep, and
      // so left out.
      for (auto &[number, node] : nodes)
        if (node.is_inner && all(node, &SurfaceNode<dim>::is_in_zone)
            && !is_corner(node))
        {
          node.is_measured = true;
          find_weights(points.surface(), number, node);
          node.deviation =
              node.traction - mean(node, &SurfaceNode<dim>::traction);
        }
      // Squares at the nodes that are measured and at all of the zone, and
      // the areas of both; number of the former, fewer of which are no pattern.
      constexpr double least_number = 3.;
      double sums[5] = {0., 0., 0., 0., 0.};
      for (const auto &[number, node] : nodes)
        if (node.is_in_zone && points.set().is_owned(number))
        {
          sums[2] += node.area * node.traction.norm_square();
          sums[3] += node.area;
          if (!all(node, &SurfaceNode<dim>::is_measured))
            continue;
          const Direction<dim> change =
              node.deviation - mean(node, &SurfaceNode<dim>::deviation);
          sums[0] += node.area
                     * std::max(change.norm_square() / 16.,
                                node.drop.norm_square() / 4.);
          sums[1] += node.area;
          sums[4] += 1.;
        }
      MPI::sum(sums, points.host().communicator, sums);
      if (sums[4] < least_number || !(sums[2] > 0.))
        return -1.;
      const double square =
          sums[0] / sums[1]
          + square_at_points(points, pair, row_pressure, nodes);
      return std::sqrt(square / (sums[2] / sums[3]));
    }
  } // namespace

  template <int dim>
  std::vector<double> oscillations(const PairPoints<dim> &points,
                                   const double *row_pressure,
                                   const std::uint8_t *row_state)
  {
    std::vector<double> result(points.pairs().size(), 0.);
    // A rank without rows has none of its own.
    if (!MPI::logical_or(row_state != nullptr, points.host().communicator))
      return result;
    for (std::size_t p = 0; p < result.size(); ++p)
    {
      SurfaceNodes<dim> nodes = connect(points.surface(), points.pairs()[p]);
      add_tractions(points, p, row_pressure, row_state, nodes);
      find_slits(points.surface(), nodes);
      find_zone(points, nodes);
      double part = alternating_part(points, p, row_pressure, nodes);
      // Strips have nodes along their borders only.
      if (dim == 3 && part < 0.)
      {
        keep_borders(points.surface(), nodes);
        part = alternating_part(points, p, row_pressure, nodes);
      }
      result[p] = std::max(part, 0.);
    }
    return result;
  }

  template std::vector<double>
  oscillations(const PairPoints<2> &, const double *, const std::uint8_t *);
  template std::vector<double>
  oscillations(const PairPoints<3> &, const double *, const std::uint8_t *);
} // namespace abut::shim

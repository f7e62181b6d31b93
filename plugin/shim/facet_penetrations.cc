// SPDX-License-Identifier: LGPL-2.1-or-later
// Obstacles between the nodes of facets.
#include "pair_examination.h"

#include "agree.h"
#include "facet_grid.h"

#include <abut/strategy.h>

#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** How far the facet of these nodes with these outward normals is at the
     * most before the curve through them, where that is hollow: all of
     * an obstacle that fits is in the facet that far. */
    template <int dim>
    double hollow_of(const std::vector<dealii::Point<dim>> &node,
                     const std::vector<dealii::Tensor<1, dim>> &normal)
    {
      // h^2 / (8 R), by the rotation of the normals; at the ends of a surface
      // they are those of one facet and rotate by half.
      constexpr double rough = 2.;
      double hollow = 0.;
      for (std::size_t a = 0; a < node.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
          hollow = std::max(hollow, -rough / 8. * (normal[a] - normal[b])
                                        * (node[a] - node[b]));
      return hollow;
    }

    /** The part of the @p depth of an obstacle at the points of a facet that
     * its nodes do not see: where they were, their gaps are larger than at the
     * point. */
    template <int dim>
    double peak_of(const RigidObstacle<dim> &obstacle, FacetGrid<dim> &grid,
                   const abut_facet_kind kind,
                   const std::vector<dealii::Point<dim>> &nodes,
                   const std::vector<dealii::Tensor<1, dim>> &normal,
                   const std::vector<double> &depth)
    {
      std::vector<double> gap, gap_of_nodes;
      obstacle.distance(nodes, gap_of_nodes);
      obstacle.distance(
          grid.points(kind, [&](const unsigned int a) { return nodes[a]; }),
          gap);
      const double known =
          *std::min_element(gap_of_nodes.begin(), gap_of_nodes.end())
          - hollow_of(nodes, normal);
      double peak = 0.;
      for (std::size_t q = 0; q < depth.size(); ++q)
        peak = std::max(peak, std::min(known - gap[q], depth[q]));
      return peak;
    }

    /** Note the deepest of points. */
    template <int dim>
    void take_deepest(const std::vector<dealii::Point<dim>> &points,
                      const std::vector<double> &depth, FacetPenetration &found)
    {
      for (std::size_t q = 0; q < points.size(); ++q)
        if (depth[q] > found.depth)
        {
          found.depth = depth[q];
          for (unsigned int d = 0; d < dim; ++d)
            found.place[d] = points[q][d];
        }
    }

    template <int dim>
    void sample_facets(const PairPoints<dim> &pair_points,
                       const std::size_t number,
                       const std::vector<Direction<dim>> &u,
                       const std::vector<std::uint8_t> &touching,
                       const std::vector<std::uint8_t> &touching_facets,
                       std::vector<FacetPenetration> &found)
    {
      const PairHost<dim> &host = pair_points.host();
      const ContactSurface<dim> &surface = pair_points.surface();
      const SurfacePair<dim> &pair = pair_points.pairs()[number];
      const RigidObstacle<dim> &obstacle = *pair.data.obstacle;
      // Away from all nodes by more than a facet: only a function whose value
      // is no distance can be in it.
      const bool is_distance = obstacle.view().kind != ABUT_OBSTACLE_FUNCTION;
      const auto me = MPI::this_mpi_process(host.communicator);
      FacetGrid<dim> grid(
          samples_per_direction(pair.secondary.everywhere.n_facets, dim - 1));

      std::vector<dealii::Point<dim>> points;
      std::vector<double> distance;
      for (const NodeIndex node : pair.secondary.node)
        points.push_back(surface.nodes[node].point + u[node]);
      obstacle.distance(points, distance);
      const double *normals = nullptr;
      check(host.context,
            abut_surface_normals(pair.secondary.surface.get(), &normals));
      std::vector<double> at_node(surface.nodes.size(), INFINITY);
      std::vector<Direction<dim>> normal_at(surface.nodes.size());
      for (std::size_t n = 0; n < points.size(); ++n)
      {
        at_node[pair.secondary.node[n]] = distance[n];
        for (unsigned int d = 0; d < dim; ++d)
          normal_at[pair.secondary.node[n]][d] = normals[n * dim + d];
      }

      for (const std::int32_t f : pair.secondary.facet)
      {
        const auto &facet = surface.facets[f];
        if (facet.owner != me)
          continue;
        double nearest = INFINITY, size = 0.;
        const auto place_of = [&](const unsigned int a)
        { return surface.nodes[facet.node[a]].point + u[facet.node[a]]; };
        for (unsigned int a = 0; a < facet.n_nodes(); ++a)
        {
          nearest = std::min(nearest, at_node[facet.node[a]]);
          size = std::max(size, place_of(a).distance(place_of(0)));
        }
        if (is_distance && nearest + pair.data.gap > size)
          continue;
        points = grid.points(facet.kind, place_of);
        obstacle.distance(points, distance);

        FacetPenetration here;
        here.pair = number;
        here.size = size;
        std::vector<double> depth;
        for (const double value : distance)
          depth.push_back(-value - pair.data.gap);
        take_deepest(points, depth, here);
        if (here.depth <= 0.)
          continue;
        std::vector<dealii::Point<dim>> nodes;
        std::vector<Direction<dim>> normal;
        for (unsigned int a = 0; a < facet.n_nodes(); ++a)
        {
          nodes.push_back(pair.has_committed_points()
                              ? pair_points.present()[facet.node[a]]
                              : surface.nodes[facet.node[a]].point);
          normal.push_back(normal_at[facet.node[a]]);
        }
        here.peak = peak_of(obstacle, grid, facet.kind, nodes, normal, depth);
        here.is_missed = touching_facets[f] == 0;
        for (unsigned int a = 0; a < facet.n_nodes(); ++a)
          if (touching[number * surface.nodes.size() + facet.node[a]] != 0)
            here.is_missed = false;
        const dealii::CellId id(facet.cell);
        here.cell = host.dof_handler.get_triangulation()
                        .create_cell_iterator(id)
                        ->active_cell_index();
        found.push_back(here);
      }
    }
  } // namespace

  template <int dim>
  std::vector<FacetPenetration>
  facet_penetrations(PairPoints<dim> &points, const la::Vector &displacement,
                     const std::uint8_t *row_state)
  {
    std::vector<FacetPenetration> found;
    const std::vector<Direction<dim>> u =
        points.displacements_in_reach(displacement);
    const std::vector<std::uint8_t> touching = points.touching_nodes(row_state);
    run_everywhere<ContactError>(
        points.host().communicator,
        [&]
        {
          for (std::size_t p = 0; p < points.pairs().size(); ++p)
          {
            if (!points.pairs()[p].data.obstacle
                || !points.pairs()[p].data.geometric_gap)
              continue;
            std::vector<std::uint8_t> facets(points.surface().facets.size(), 0);
            points.for_each_component(
                [&](const PointRow<dim> &row)
                {
                  if (row.place.pair == p && row.place.facet >= 0
                      && row_state != nullptr
                      && row_state[row.row] != ABUT_STATE_OPEN)
                    facets[row.place.facet] = 1;
                });
            sample_facets(points, p, u, touching, facets, found);
          }
        });
    return found;
  }

  template std::vector<FacetPenetration>
  facet_penetrations(PairPoints<2> &, const la::Vector &, const std::uint8_t *);
  template std::vector<FacetPenetration>
  facet_penetrations(PairPoints<3> &, const la::Vector &, const std::uint8_t *);
} // namespace abut::shim

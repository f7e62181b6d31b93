// SPDX-License-Identifier: LGPL-2.1-or-later
// Obstacles between the nodes of facets.
#include "pair_examination.h"

#include "agree.h"
#include "obstacle_width.h"
#include "sampling.h"

#include <abut/dealii/rigid_obstacle.h>
#include <abut/strategy.h>

#include <deal.II/grid/cell_id.h>

#include <algorithm>

namespace abut::shim
{
  namespace
  {
    template <int dim>
    void sample_facets(const PairPoints<dim> &points, const std::size_t number,
                       const std::vector<Direction<dim>> &u,
                       const std::vector<std::uint8_t> &touching,
                       const std::vector<std::uint8_t> &touching_facets,
                       std::vector<FacetPenetration> &found)
    {
      const ContactSurface<dim> &surface = points.surface();
      const SurfacePair<dim> &pair = points.pairs()[number];
      FacetSamples<dim> samples(points, pair, u);
      std::vector<double> made;
      if (pair.has_committed_points())
      {
        made = places_of(pair.secondary.node, points.present());
        samples.view.made = made.data();
      }
      samples.view.n = static_cast<std::int32_t>(
          samples_per_direction(pair.secondary.everywhere.n_facets, dim - 1));
      std::vector<abut_facet_depth> depths(pair.secondary.n_facets());
      std::int32_t n = 0;
      check(points.host().context, *pair.data.obstacle,
            abut_obstacle_in_facets(pair.data.obstacle->handle(),
                                    pair.secondary.surface.get(), &samples.view,
                                    depths.data(), &n));
      for (std::int32_t k = 0; k < n; ++k)
      {
        const abut_facet_depth &depth = depths[k];
        const std::int32_t f = pair.secondary.facet[depth.facet];
        const auto &facet = surface.facets[f];
        FacetPenetration here;
        here.pair = number;
        here.size = depth.size;
        here.depth = depth.depth;
        here.peak = depth.peak;
        std::copy_n(depth.place, dim, here.place.begin());
        here.is_missed = touching_facets[f] == 0;
        for (unsigned int a = 0; a < facet.n_nodes(); ++a)
          if (touching[number * surface.nodes.size() + facet.node[a]] != 0)
            here.is_missed = false;
        here.cell = points.host()
                        .dof_handler.get_triangulation()
                        .create_cell_iterator(dealii::CellId(facet.cell))
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

// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether surfaces touch where rows press.
#include "pair_examination.h"

#include "agree.h"
#include "pair_diagnosis.h"

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace
  {
    /** Take the signed distances of the nodes of a side from the other side, by
     * their numbers in the whole; others stay. */
    template <int dim>
    void find_distances(abut_context *context, const SurfaceSide<dim> &nodes,
                        const SurfaceSide<dim> &facets,
                        const abut_detection_options &options,
                        const double deepest, std::vector<double> &distance)
    {
      const auto detection = create_detection(context, nodes.surface.get(),
                                              facets.surface.get(), options);
      check(context, abut_detection_run(detection.get(), 0.));
      abut_detection_view view;
      check(context, abut_detection_get(detection.get(), &view));
      for (std::int32_t n = 0; n < view.n_nodes; ++n)
        // Deeper than a facet it is the other side of a body.
        if (view.contact[n].facet >= 0 && view.contact[n].gap > deepest)
          distance[nodes.node[n]] = view.contact[n].gap;
    }

    /** [nodes] Distance of the pair's other side from facets around a node of
     * the secondary, or from a node of the primary, as far as it is known. */
    template <int dim>
    std::vector<double>
    distances_of_nodes(const PairPoints<dim> &points, SurfacePair<dim> &pair,
                       const std::vector<dealii::Point<dim>> &reference,
                       const std::vector<dealii::Point<dim>> &present)
    {
      const DisplacedSides<dim> sides(points.host().context, pair.secondary,
                                      pair.primary, reference, present);
      abut_detection_options options = points.host().search.detection;
      options.search.reach =
          std::max(options.search.reach, pair.secondary.everywhere.largest);
      options.extension = 0.;
      std::vector<double> distance(points.surface().nodes.size(), INFINITY);
      find_distances(points.host().context, pair.secondary, pair.primary,
                     options, -pair.facet_size(), distance);
      find_distances(points.host().context, pair.primary, pair.secondary,
                     options, -pair.facet_size(), distance);
      // A row sees the facets around its node, and what is opposite.
      std::vector<double> around(distance);
      for (const std::int32_t f : pair.secondary.facet)
      {
        const auto &facet = points.surface().facets[f];
        double least = INFINITY;
        for (unsigned int a = 0; a < facet.n_nodes(); ++a)
          least = std::min(least, distance[facet.node[a]]);
        for (unsigned int a = 0; a < facet.n_nodes(); ++a)
          around[facet.node[a]] = std::min(around[facet.node[a]], least);
      }
      return around;
    }

    template <int dim>
    double clearance(const PairPoints<dim> &points, const PointRow<dim> &row,
                     const std::vector<double> &distance)
    {
      double least = INFINITY;
      const auto include_node = [&](const NodeIndex node, double)
      { least = std::min(least, distance[node]); };
      points.for_each_node(row.point, include_node);
      // Edges may cross between nodes.
      const SurfacePair<dim> &pair = points.pairs()[row.place.pair];
      if (row.place.least > -pair.facet_size())
        least = std::min(least, row.place.least);
      return least + pair.data.gap;
    }
  } // namespace

  template <int dim>
  std::vector<double> clearances(const PairPoints<dim> &points,
                                 const std::vector<Direction<dim>> &u,
                                 const bool only_moving)
  {
    std::vector<double> result(points.view().n_components, INFINITY);
    std::vector<dealii::Point<dim>> reference, present;
    for (std::size_t n = 0; n < points.surface().nodes.size(); ++n)
    {
      reference.push_back(points.surface().nodes[n].point);
      present.push_back(reference[n] + u[n]);
    }
    run_everywhere<ContactError>(
        points.host().communicator,
        [&]
        {
          for (std::size_t p = 0; p < points.pairs().size(); ++p)
          {
            SurfacePair<dim> &pair = points.pairs()[p];
            if (pair.data.obstacle || pair.data.tied || !pair.has_mean_gaps()
                || !pair.data.geometric_gap
                || (only_moving && !pair.has_current_points()))
              continue;
            run_named(pair.data.name,
                      [&]
                      {
                        const std::vector<double> distance = distances_of_nodes(
                            points, pair, reference, present);
                        points.for_each_component(
                            [&](const PointRow<dim> &row)
                            {
                              if (row.place.pair == p)
                                result[row.row] =
                                    clearance(points, row, distance);
                            });
                      });
          }
        });
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<double> clearances(                                     \
      const PairPoints<dim> &, const std::vector<Direction<dim>> &, bool);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

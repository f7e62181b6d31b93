// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether surfaces touch where rows press.
#include "surface_pair_rows.h"

#include "agree.h"
#include "pair_diagnosis.h"

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

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
  } // namespace

  template <int dim>
  std::vector<double>
  SurfacePairRows<dim>::clearances(const std::vector<Direction> &u,
                                   const bool only_moving)
  {
    std::vector<double> result(view_.n_components, INFINITY);
    std::vector<dealii::Point<dim>> reference, present;
    for (std::size_t n = 0; n < surface_.nodes.size(); ++n)
    {
      reference.push_back(surface_.nodes[n].point);
      present.push_back(reference[n] + u[n]);
    }
    run_everywhere<ContactError>(
        communicator_,
        [&]
        {
          for (std::size_t p = 0; p < pairs_.size(); ++p)
          {
            Pair &pair = pairs_[p];
            if (pair.data.obstacle || pair.data.tied || !has_mean_gaps(p)
                || !pair.data.geometric_gap
                || (only_moving && !pair.has_current_points()))
              continue;
            run_named(pair.data.name,
                      [&]
                      {
                        const std::vector<double> distance =
                            distances_of_nodes(pair, reference, present);
                        for_each_component(
                            [&](const Component &row)
                            {
                              if (row.place.pair == p)
                                result[row.row] = clearance(row, distance);
                            });
                      });
          }
        });
    return result;
  }

  template <int dim>
  double
  SurfacePairRows<dim>::clearance(const Component &row,
                                  const std::vector<double> &distance) const
  {
    double least = INFINITY;
    const auto include_node = [&](const Node node, double)
    { least = std::min(least, distance[node]); };
    for_each_secondary(row.point, include_node);
    for_each_primary(row.point, include_node);
    // Edges may cross between nodes.
    const Pair &pair = pairs_[row.place.pair];
    if (row.place.least > -facet_size(pair))
      least = std::min(least, row.place.least);
    return least + pair.data.gap;
  }

  template <int dim>
  std::vector<double>
  SurfacePairRows<dim>::clearances(const la::Vector &displacement)
  {
    return clearances(displacements_in_reach(displacement), true);
  }

  template <int dim>
  std::vector<SeparatedRows>
  SurfacePairRows<dim>::apart(const std::vector<double> &visible,
                              const double *row_pressure, const double *row_gap,
                              const std::uint8_t *row_state)
  {
    std::vector<SeparatedRows> result(pairs_.size());
    const std::vector<double> clearance = clearances(examined_, false);
    for_each_component(
        [&](const Component &row)
        {
          const double force =
              row_state == nullptr || row_state[row.row] == ABUT_STATE_OPEN
                  ? 0.
                  : view_.weight[row.point] * row_pressure[row.row];
          if (!(force > 0.))
            return;
          SeparatedRows &found = result[row.place.pair];
          found.all += force;
          // The gap that the law leaves is not an error of the row.
          const double gap =
              clearance[row.row] - std::max(0., row_gap[row.row]);
          if (!std::isfinite(gap) || gap <= visible[row.place.pair])
            return;
          found.force += force;
          found.gap = std::max(found.gap, gap);
        });
    for (SeparatedRows &found : result)
    {
      found.force = MPI::sum(found.force, communicator_);
      found.all = MPI::sum(found.all, communicator_);
      found.gap = MPI::max(found.gap, communicator_);
    }
    return result;
  }

  template <int dim>
  std::vector<double> SurfacePairRows<dim>::distances_of_nodes(
      Pair &pair, const std::vector<dealii::Point<dim>> &reference,
      const std::vector<dealii::Point<dim>> &present) const
  {
    const DisplacedSides<dim> sides(context_, pair.secondary, pair.primary,
                                    reference, present);
    abut_detection_options options = settings_.search.detection;
    options.search.reach =
        std::max(options.search.reach, pair.secondary.everywhere.largest);
    options.extension = 0.;
    std::vector<double> distance(surface_.nodes.size(), INFINITY);
    find_distances(context_, pair.secondary, pair.primary, options,
                   -facet_size(pair), distance);
    find_distances(context_, pair.primary, pair.secondary, options,
                   -facet_size(pair), distance);
    // A row sees the facets around its node, and what is opposite.
    std::vector<double> around(distance);
    for (const std::int32_t f : pair.secondary.facet)
    {
      const auto &facet = surface_.facets[f];
      double least = INFINITY;
      for (unsigned int a = 0; a < surface_.nodes_per_facet(); ++a)
        least = std::min(least, distance[facet.node[a]]);
      for (unsigned int a = 0; a < surface_.nodes_per_facet(); ++a)
        around[facet.node[a]] = std::min(around[facet.node[a]], least);
    }
    return around;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<SeparatedRows> SurfacePairRows<dim>::apart(             \
      const std::vector<double> &, const double *, const double *,             \
      const std::uint8_t *);                                                   \
  template std::vector<double> SurfacePairRows<dim>::distances_of_nodes(       \
      Pair &, const std::vector<dealii::Point<dim>> &,                         \
      const std::vector<dealii::Point<dim>> &) const;                          \
  template std::vector<double> SurfacePairRows<dim>::clearances(               \
      const std::vector<Direction> &, bool);                                   \
  template std::vector<double> SurfacePairRows<dim>::clearances(               \
      const la::Vector &);                                                     \
  template double SurfacePairRows<dim>::clearance(                             \
      const Component &, const std::vector<double> &) const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

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
                        std::vector<double> &distance)
    {
      const auto detection = create_detection(context, nodes.surface.get(),
                                              facets.surface.get(), options);
      check(context, abut_detection_run(detection.get(), 0.));
      abut_detection_view view;
      check(context, abut_detection_get(detection.get(), &view));
      for (std::int32_t n = 0; n < view.n_nodes; ++n)
        if (view.contact[n].facet >= 0)
          distance[nodes.node[n]] = view.contact[n].gap;
    }
  } // namespace

  template <int dim>
  std::vector<Apart>
  SurfacePairRows<dim>::apart(const std::vector<double> &visible,
                              const double *row_pressure, const double *row_gap,
                              const std::uint8_t *row_state)
  {
    std::vector<Apart> result(pairs_.size());
    std::vector<dealii::Point<dim>> reference, present;
    for (std::size_t n = 0; n < surface_.nodes.size(); ++n)
    {
      reference.push_back(surface_.nodes[n].point);
      present.push_back(reference[n] + examined_[n]);
    }
    run_everywhere<ContactError>(
        communicator_,
        [&]
        {
          for (std::size_t p = 0; p < pairs_.size() && row_state != nullptr;
               ++p)
          {
            Pair &pair = pairs_[p];
            if (pair.data.obstacle || pair.data.tied || !has_mean_gaps(p)
                || !pair.data.geometric_gap)
              continue;
            run_named(pair.data.name,
                      [&]
                      {
                        const std::vector<double> distance =
                            distances_of_nodes(pair, reference, present);
                        for_each_component(
                            [&](const Component &row)
                            {
                              if (row.place.pair == p
                                  && row_state[row.row] != ABUT_STATE_OPEN)
                                note_apart(row, distance, row_pressure[row.row],
                                           row_gap[row.row], visible[p],
                                           result[p]);
                            });
                      });
          }
        });
    for (Apart &found : result)
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
    find_distances(context_, pair.secondary, pair.primary, options, distance);
    find_distances(context_, pair.primary, pair.secondary, options, distance);
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

  template <int dim>
  void SurfacePairRows<dim>::note_apart(const Component &row,
                                        const std::vector<double> &distance,
                                        const double pressure, const double gap,
                                        const double visible,
                                        Apart &found) const
  {
    const double force = view_.weight[row.point] * pressure;
    if (!(force > 0.))
      return;
    found.all += force;
    double least = INFINITY;
    const auto take = [&](const Node node, double)
    { least = std::min(least, distance[node]); };
    for_each_secondary(row.point, take);
    for_each_primary(row.point, take);
    // What the law leaves open is no fault of the row.
    least += pairs_[row.place.pair].data.gap - std::max(0., gap);
    if (!std::isfinite(least) || least <= visible)
      return;
    found.force += force;
    found.gap = std::max(found.gap, least);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<Apart> SurfacePairRows<dim>::apart(                     \
      const std::vector<double> &, const double *, const double *,             \
      const std::uint8_t *);                                                   \
  template std::vector<double> SurfacePairRows<dim>::distances_of_nodes(       \
      Pair &, const std::vector<dealii::Point<dim>> &,                         \
      const std::vector<dealii::Point<dim>> &) const;                          \
  template void SurfacePairRows<dim>::note_apart(                              \
      const Component &, const std::vector<double> &, double, double, double,  \
      Apart &) const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

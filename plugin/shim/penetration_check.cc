// SPDX-License-Identifier: LGPL-2.1-or-later
// The search on the deformed surfaces that finds what no row holds.
#include "surface_pair_rows.h"

#include "agree.h"

#include <abut/dealii/rigid_obstacle.h>

#include <algorithm>

namespace abut::shim
{
  namespace
  {
    /** Nodes of @p nodes deeper than @p tolerance in @p facets. Only reads. */
    template <int dim>
    std::vector<std::pair<int, double>>
    penetrating_nodes(abut_context *context, const SurfaceSide<dim> &nodes,
                      const SurfaceSide<dim> &facets,
                      const SearchParameters &search, const double reach,
                      const double tolerance)
    {
      abut_detection_options options = search.detection;
      options.search.reach = std::max(options.search.reach, reach);
      options.extension = 0.;
      const auto detection = create_detection(context, nodes.surface.get(),
                                              facets.surface.get(), options);
      check(context, abut_detection_run(detection.get(), 0.));
      abut_detection_view view;
      check(context, abut_detection_get(detection.get(), &view));
      std::vector<std::pair<int, double>> found;
      for (std::int32_t n = 0; n < view.n_nodes; ++n)
        if (view.contact[n].facet >= 0 && view.contact[n].gap < -tolerance)
          found.emplace_back(n, -view.contact[n].gap);
      return found;
    }
  } // namespace

  template <int dim>
  std::vector<Penetration<dim>>
  SurfacePairRows<dim>::penetrations(const la::Vector &displacement,
                                     const double tolerance)
  {
    const std::vector<Direction> u = node_displacements(displacement);
    std::vector<dealii::Point<dim>> reference(surface_.nodes.size()),
        present(surface_.nodes.size());
    for (std::size_t n = 0; n < present.size(); ++n)
    {
      reference[n] = surface_.nodes[n].point;
      present[n] = reference[n] + u[n];
    }

    // Held are nodes that a row mentions.
    std::vector<std::uint8_t> held(surface_.nodes.size() * pairs_.size(), 0);
    for (const Row &row : rows_)
      for (std::size_t e = row.first; e < row.end; ++e)
        held[row.pair * surface_.nodes.size() + entries_[e].node] = 1;
    exchange_.merge_marks(held);

    std::vector<Penetration<dim>> result;
    std::string message;
    for (std::size_t p = 0; p < pairs_.size() && message.empty(); ++p)
      try
      {
        Pair &pair = pairs_[p];
        if (pair.data.tied || !pair.data.geometric_gap)
          continue;
        const auto is_held = [&](const Node node)
        {
          const auto *marks = &held[p * surface_.nodes.size()];
          bool parents = !surface_.parents[node].empty();
          for (const auto &parent : surface_.parents[node])
            parents = parents && marks[parent.index] != 0;
          return marks[node] != 0 || parents;
        };
        const auto note =
            [&](const Node node, const double depth, const bool on_primary)
        {
          if (!is_held(node))
            result.push_back(
                {pair.data.name, present[node], depth, on_primary});
        };
        if (pair.data.obstacle)
        {
          std::vector<dealii::Point<dim>> points;
          for (const Node node : pair.secondary.node)
            points.push_back(present[node]);
          std::vector<double> distance;
          pair.data.obstacle->distance(points, distance);
          for (std::size_t n = 0; n < points.size(); ++n)
            if (distance[n] + pair.data.gap < -tolerance)
              note(pair.secondary.node[n], -distance[n] - pair.data.gap, false);
          continue;
        }
        const double reach = std::max(pair.data.reach, 1.5 * motion(pair, u));
        const double depth = tolerance + pair.data.gap;
        move_side(context_, present, pair.secondary);
        move_side(context_, present, pair.primary);
        for (const auto &[n, d] :
             penetrating_nodes(context_, pair.secondary, pair.primary,
                               settings_.search, reach, depth))
          note(pair.secondary.node[n], d - pair.data.gap, false);
        for (const auto &[n, d] :
             penetrating_nodes(context_, pair.primary, pair.secondary,
                               settings_.search, reach, depth))
          note(pair.primary.node[n], d - pair.data.gap, true);
        move_side(context_, reference, pair.secondary);
        move_side(context_, reference, pair.primary);
      }
      catch (const std::exception &error)
      {
        message = "Pair '" + pairs_[p].data.name + "': " + error.what();
      }
    throw_everywhere<ContactError>(communicator_, message);
    return result;
  }

  template std::vector<Penetration<2>>
  SurfacePairRows<2>::penetrations(const la::Vector &, double);
  template std::vector<Penetration<3>>
  SurfacePairRows<3>::penetrations(const la::Vector &, double);
} // namespace abut::shim

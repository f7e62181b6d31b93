// SPDX-License-Identifier: LGPL-2.1-or-later
// Which pair a node belongs to that is in the secondary of several: step 3 of
// the detection (plugin/core/contact/detect.c) for pairs between bodies. Each
// of them is a group, and the nearest partner is taken whatever group it is of,
// so that nothing depends on the order of the pairs but ties by round-off.
#include "surface_pair_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  template <int dim> bool SurfacePairRows<dim>::have_common_nodes() const
  {
    std::vector<std::uint8_t> seen(surface_.nodes.size(), 0);
    bool common = false;
    for (const Pair &pair : pairs_)
      if (is_group(pair))
        for (const Node node : pair.secondary.node)
        {
          common = common || seen[node] != 0;
          seen[node] = 1;
        }
    return MPI::logical_or(common, communicator_);
  }

  template <int dim>
  double SurfacePairRows<dim>::distance_where_made(const std::size_t i) const
  {
    const Pair &pair = pairs_[places_[i].pair];
    const std::int32_t row = view_.component_start[i];
    double gap = view_.gap[row] - pair.data.gap;
    if (!pair.is_displaced())
      return gap;
    // Gaps are those of displacement 0.
    const auto add = [&](const Node node, const double c)
    {
      for (unsigned int d = 0; d < dim; ++d)
        gap += abut_point_sign(view_.kind[i], 0) * c * made_at(node)[d]
               * view_.frame[row * std::size_t(dim) + d];
    };
    for_each_secondary(i, add);
    for_each_primary(i, add);
    return gap;
  }

  template <int dim>
  std::vector<std::vector<std::uint8_t>>
  SurfacePairRows<dim>::nodes_of_nearer_pairs(const std::vector<double> &moved)
  {
    const std::size_t n_nodes = surface_.nodes.size();
    std::vector<std::vector<std::uint8_t>> nearer(
        pairs_.size(), std::vector<std::uint8_t>(n_nodes, 0));
    if (!have_common_nodes())
      return nearer;
    // The components of each pair if it were alone.
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (is_group(pairs_[p]))
      {
        std::vector<std::uint8_t> taken(n_nodes, 0);
        find_pair(p, moved[p], taken);
      }
    // Equal distances are those of the first pair, round-off or not.
    constexpr double nearly = 1. - 1e-8;
    std::vector<double> least(n_nodes, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> nearest(n_nodes, pairs_.size());
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      const Node node = places_[i].node;
      if (node < 0)
        continue;
      const double distance = std::abs(distance_where_made(i));
      if (distance < nearly * least[node])
      {
        least[node] = distance;
        nearest[node] = places_[i].pair;
      }
    }
    std::vector<std::uint8_t> marks(n_nodes * pairs_.size(), 0);
    for (std::size_t n = 0; n < n_nodes; ++n)
      if (nearest[n] < pairs_.size())
        marks[nearest[n] * n_nodes + n] = 1;
    exchange_->merge_marks(surface_, marks);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      for (std::size_t q = 0; q < pairs_.size(); ++q)
        for (std::size_t n = 0; n < n_nodes && q != p && is_group(pairs_[p]);
             ++n)
          if (marks[q * n_nodes + n] != 0)
            nearer[p][n] = 1;
    places_.clear();
    checks_.clear();
    check(context_, abut_points_clear(points_));
    return nearer;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template bool SurfacePairRows<dim>::have_common_nodes() const;               \
  template double SurfacePairRows<dim>::distance_where_made(std::size_t)       \
      const;                                                                   \
  template std::vector<std::vector<std::uint8_t>>                              \
  SurfacePairRows<dim>::nodes_of_nearer_pairs(const std::vector<double> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

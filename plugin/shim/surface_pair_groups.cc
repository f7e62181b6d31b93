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

  template <int dim>
  std::vector<unsigned int> SurfacePairRows<dim>::share_nodes() const
  {
    std::vector<std::size_t> first(surface_.nodes.size(), pairs_.size());
    std::vector<unsigned int> share(pairs_.size(), 0);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (is_group(pairs_[p]))
        for (const Node node : pairs_[p].secondary.node)
        {
          if (first[node] < pairs_.size())
            share[p] = share[first[node]] = 1;
          first[node] = p;
        }
    MPI::max(share, communicator_, share);
    return share;
  }

  template <int dim>
  std::vector<std::vector<std::uint8_t>>
  SurfacePairRows<dim>::nodes_of_nearer_pairs(const std::vector<double> &moved,
                                              std::vector<Displaced> &displaced)
  {
    const std::size_t n_nodes = surface_.nodes.size();
    std::vector<std::vector<std::uint8_t>> nearer(
        pairs_.size(), std::vector<std::uint8_t>(n_nodes, 0));
    const std::vector<unsigned int> share = share_nodes();
    if (std::find(share.begin(), share.end(), 1u) == share.end())
      return nearer;
    // The points that each of them would have if it were alone.
    const std::vector<std::uint8_t> taken(n_nodes, 0);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (share[p] != 0)
        make_points(p, moved[p], taken, displaced[p]);
    std::vector<double> made(present_displacement_), gap(view_.n_components);
    made.resize(dim * n_nodes, 0.);
    check(context_, abut_points_gap(points_, static_cast<std::int32_t>(n_nodes),
                                    made.data(), gap.data()));
    // Equal distances are those of the first pair, round-off or not.
    constexpr double nearly = 1. - 1e-8;
    std::vector<double> least(n_nodes, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> nearest(n_nodes, pairs_.size());
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      const Node node = places_[i].node;
      if (node < 0)
        continue;
      const Pair &pair = pairs_[places_[i].pair];
      const std::int32_t row = view_.component_start[i];
      // Gaps are those of displacement 0.
      const double distance = std::abs(
          (pair.is_displaced() ? gap[row] : view_.gap[row]) - pair.data.gap);
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
        for (std::size_t n = 0; n < n_nodes && q != p && share[p] != 0; ++n)
          if (marks[q * n_nodes + n] != 0)
            nearer[p][n] = 1;
    places_.clear();
    check(context_, abut_points_clear(points_));
    return nearer;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<unsigned int> SurfacePairRows<dim>::share_nodes()       \
      const;                                                                   \
  template std::vector<std::vector<std::uint8_t>>                              \
  SurfacePairRows<dim>::nodes_of_nearer_pairs(const std::vector<double> &,     \
                                              std::vector<Displaced> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

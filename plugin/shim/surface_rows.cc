// SPDX-License-Identifier: LGPL-2.1-or-later
#include "surface_rows.h"

#include "pair_detection.h"

#include <algorithm>

namespace abut::shim
{
  template <int dim>
  SurfaceRows<dim>::SurfaceRows(const PairHost<dim> &host,
                                const std::vector<ContactPair<dim>> &pairs,
                                std::shared_ptr<SurfaceExchange<dim>> exchange)
      : set_(host, pairs, std::move(exchange))
  {
  }

  template <int dim>
  std::vector<PointsOrigin>
  SurfaceRows<dim>::origins(const std::vector<Direction<dim>> &u) const
  {
    const abut_search_options &search = set_.host().search.detection.search;
    std::vector<PointsOrigin> result;
    for (const SurfacePair<dim> &pair : set_.pairs())
    {
      // Obstacles move and are functions that anything may have changed.
      if (pair.data.obstacle)
        return {};
      const double smallest = std::min(pair.secondary.everywhere.smallest,
                                       pair.primary.everywhere.smallest);
      const double reach =
          std::max({search.reach, pair.data.reach, 1.5 * set_.motion(pair, u)});
      result.push_back({reach <= search.relative_reach * smallest ? 0. : reach,
                        pair.data.gap});
    }
    return result;
  }

  template <int dim>
  std::vector<Direction<dim>> SurfaceRows<dim>::place_of_step() const
  {
    return set_.has_steps()
               ? set_.displacements_as_given(set_.last_commit())
               : std::vector<Direction<dim>>(set_.surface().nodes.size());
  }

  template <int dim>
  RowSource::Change SurfaceRows<dim>::find(const la::Vector &displacement,
                                           abut_points *const points)
  {
    return find_points(displacement, points, points_);
  }

  template <int dim>
  RowSource::Change
  SurfaceRows<dim>::find_points(const la::Vector &displacement,
                                abut_points *const core,
                                PairPoints<dim> &points)
  {
    if (const auto place = set_.renew_sides())
      gather_sides(&*place);
    const bool has_new_constants = set_.update_constants();
    const std::vector<Direction<dim>> u =
        points_.displacements_in_reach(displacement);
    ++n_finds_;
    set_.check_gaps();
    set_.obstacles().start_slips();
    const std::vector<Direction<dim>> place = place_of_step();
    const std::vector<Direction<dim>> way = difference(u, place);
    std::vector<PointsOrigin> wanted = origins(way);
    if (!wanted.empty() && wanted == points.origins && core == points.handle()
        && points.is_where_made(place) && (!moves() || points.is_made_at(u)))
    {
      ++n_kept_;
      return has_new_constants ? Change::constants : Change::none;
    }
    points.origins.clear();
    points.start(core, moves() ? u : place);
    points.made_place = moves() ? displacement : set_.last_commit();
    if (n_finds_ == 1)
      look_inside(set_, displacement);
    PairDetection<dim> detection(points, n_finds_ == 1);
    detection.find(set_.motions(way));
    detection.check_pairs_without_rows(displacement);
    points.origins = std::move(wanted);
    return Change::points;
  }

  template <int dim> void SurfaceRows<dim>::restore(PairPoints<dim> points)
  {
    points_ = std::move(points);
    points_.update_view();
    renew_points();
  }

  template <int dim>
  void SurfaceRows<dim>::gather_sides(const la::Vector *const place)
  {
    const bool is_displaced = std::any_of(
        set_.pairs().begin(), set_.pairs().end(),
        [](const auto &pair) { return pair.has_displaced_sides(); });
    points_.renew(is_displaced ? place : nullptr);
    ++set_.host().detection.gatherings;
  }

  template <int dim> void SurfaceRows<dim>::load_sides(std::istream &stream)
  {
    if (set_.load_sides(stream))
      gather_sides(nullptr);
  }

  template class SurfaceRows<2>;
  template class SurfaceRows<3>;
} // namespace abut::shim

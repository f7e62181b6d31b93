// SPDX-License-Identifier: LGPL-2.1-or-later
// Obstacles narrower than facets.
#include "obstacle_width.h"

#include <abut/dealii/rigid_obstacle.h>

#include <cmath>
#include <sstream>
#include <tuple>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  std::string ObstacleWidth::text() const
  {
    std::ostringstream text;
    text.precision(3);
    text << "the obstacle is only " << width << " wide where facets of size "
         << facet
         << " are near it: single nodes at most touch it, and the force is "
            "theirs. Refine the surface there until several facets are under "
            "it.";
    return text.str();
  }

  template <int dim>
  FacetSamples<dim>::FacetSamples(const PairPoints<dim> &points,
                                  const SurfacePair<dim> &pair,
                                  const std::vector<Direction<dim>> &u)
  {
    const auto me = MPI::this_mpi_process(points.host().communicator);
    for (const NodeIndex node : pair.secondary.node)
      for (unsigned int d = 0; d < dim; ++d)
        position_.push_back(points.surface().nodes[node].point[d] + u[node][d]);
    for (const std::int32_t f : pair.secondary.facet)
      wanted_.push_back(points.surface().facets[f].owner == me);
    view.position = position_.data();
    view.wanted = wanted_.data();
    view.gap = pair.data.gap;
  }

  template <int dim>
  ObstacleWidth narrowest_width(const PairPoints<dim> &points,
                                const SurfacePair<dim> &pair,
                                const std::vector<Direction<dim>> &u)
  {
    const FacetSamples<dim> samples(points, pair, u);
    abut_obstacle_beside beside;
    check(points.host().context, *pair.data.obstacle,
          abut_obstacle_narrowest(pair.data.obstacle->handle(),
                                  pair.secondary.surface.get(), &samples.view,
                                  &beside));
    ObstacleWidth narrowest;
    for (const auto &[width, size] :
         MPI::all_gather(points.host().communicator,
                         std::make_pair(beside.width, beside.size)))
      if (width / size < narrowest.width / narrowest.facet)
        narrowest = {width, size};
    return narrowest;
  }

  template <int dim>
  ObstacleWidth passed_between(const PairPoints<dim> &points,
                               const std::size_t number,
                               const dealii::Point<dim> &place)
  {
    const SurfacePair<dim> &pair = points.pairs()[number];
    const dealii::Point<dim> then =
        points.set().obstacles().place_before(number, place);
    const FacetSamples<dim> samples(points, pair, points.made());
    abut_obstacle_beside beside;
    check(points.host().context, *pair.data.obstacle,
          abut_obstacle_beside_facet(pair.data.obstacle->handle(),
                                     pair.secondary.surface.get(),
                                     &samples.view, &then[0], &beside));
    double distance = INFINITY;
    ObstacleWidth nearest;
    for (const auto &[there, is_over, width, size] :
         MPI::all_gather(points.host().communicator,
                         std::make_tuple(beside.distance, beside.is_over,
                                         beside.width, beside.size)))
      if (there < distance)
      {
        distance = there;
        nearest = is_over != 0 ? ObstacleWidth{width, size} : ObstacleWidth();
      }
    return nearest;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template class FacetSamples<dim>;                                            \
  template ObstacleWidth narrowest_width(const PairPoints<dim> &,              \
                                         const SurfacePair<dim> &,             \
                                         const std::vector<Direction<dim>> &); \
  template ObstacleWidth passed_between(const PairPoints<dim> &, std::size_t,  \
                                        const dealii::Point<dim> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

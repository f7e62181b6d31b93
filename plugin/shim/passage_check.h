// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PASSAGE_CHECK_H
#define ABUT_SHIM_PASSAGE_CHECK_H

#include "surface_side.h"

#include <abut/dealii/contact_pair.h>
#include <memory>

namespace abut
{
  template <int dim> class RigidObstacle;
  template <int dim> struct RigidPose;
} // namespace abut

namespace abut::shim
{
  /** A node that has come through a facet. */
  struct Passage
  {
    int node, facet; ///< of the two sides
    double depth;    ///< behind the plane of the facet at the end
  };

  /** Nodes of @p nodes that go through a facet of @p facets, from outside to
   * deeper than @p depth behind it, on the way of the bodies from @p start
   * [nodes of the whole] by @p way: what is thin may be on the far side at the
   * end, where no search for penetrations looks. Only facets count that the
   * surface at the node faces. Nodes go on straight lines past each facet as it
   * is at the start, by their way relative to the mean of its corners: exact
   * for facets that do not turn. Each node once, with the facet it is farthest
   * behind. O((n + m) log m) where ways are as short as facets. Not collective.
   */
  template <int dim>
  std::vector<Passage>
  passing_nodes(abut_context *context, const ContactSurface<dim> &whole,
                const SurfaceSide<dim> &nodes, const SurfaceSide<dim> &facets,
                const std::vector<dealii::Point<dim>> &start,
                const std::vector<dealii::Tensor<1, dim>> &way, double depth);

  /** Result for a straight path past an obstacle. */
  struct OnTheWay
  {
    double depth = 0.; ///< in the obstacle at the most, length >= 0
    /** Whether it enters the obstacle and leaves it on another side, more than
     * a right angle away. */
    bool through = false;
  };

  /** Results for straight paths of points past an obstacle in its current pose,
   * [points]. Ways are sampled as far apart as the distance from its surface
   * is, and by a quarter of its half thickness or 1/64 of the way at least,
   * whichever is less. @p end are distances at the ends; ways that are shorter
   * are not looked at. */
  template <int dim>
  std::vector<OnTheWay> on_the_way(const RigidObstacle<dim> &obstacle,
                                   const std::vector<dealii::Point<dim>> &from,
                                   const std::vector<dealii::Point<dim>> &to,
                                   const std::vector<double> &end);

  /** Why a step in which the obstacle of @p pair moves by @p way, seen from the
   * body, has no answer: what comes of it is the end of a sentence. */
  template <int dim>
  Message too_long_a_step(const ContactPair<dim> &pair, double way,
                          const std::string &so_that);

  /** How deep points are at the most, [points] length >= 0, between the ends of
   * their straight ways in an obstacle that changes with time: from @p begin,
   * where it was at @p then, to the present. It is looked at at 31 times; at
   * the end it is as it was. */
  template <int dim>
  std::vector<double>
  deepest_between(const std::shared_ptr<const RigidObstacle<dim>> &obstacle,
                  double begin, const RigidPose<dim> &then,
                  const std::vector<dealii::Point<dim>> &from,
                  const std::vector<dealii::Point<dim>> &to);
} // namespace abut::shim

#endif

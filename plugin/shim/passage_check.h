// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PASSAGE_CHECK_H
#define ABUT_SHIM_PASSAGE_CHECK_H

#include <abut/dealii/contact_pair.h>

#include <memory>
#include <string>
#include <vector>

namespace abut
{
  template <int dim> class RigidObstacle;
  template <int dim> struct RigidPose;
} // namespace abut

namespace abut::shim
{
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

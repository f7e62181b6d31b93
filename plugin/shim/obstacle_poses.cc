// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacle_poses.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::shim
{
  namespace
  {
    /** The angle of rotation of a rigid body, radian, modulo whole rotations.
     */
    template <int dim>
    double angle_between(const RigidPose<dim> &then, const RigidPose<dim> &now)
    {
      const double t = trace(transpose(then.rotation) * now.rotation);
      return std::acos(
          std::clamp(dim == 2 ? 0.5 * t : 0.5 * (t - 1.), -1., 1.));
    }

    /** From here on the chord, which slips are measured by, is 1 % shorter than
     * the way along the surface, sin(a) / a. */
    constexpr double largest_rotation = 15.01 * M_PI / 180.;
  } // namespace

  template <int dim>
  dealii::Tensor<1, dim>
  ObstaclePoses<dim>::displacement(const dealii::Point<dim> &place,
                                   const RigidPose<dim> &then,
                                   const RigidPose<dim> &now)
  {
    const dealii::Tensor<1, dim> x = place;
    const dealii::Tensor<1, dim> own =
        transpose(now.rotation) * (x - now.translation);
    return x - (then.rotation * own + then.translation);
  }

  template <int dim>
  typename ObstaclePoses<dim>::Poses ObstaclePoses<dim>::now() const
  {
    Poses result(pairs_.size());
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (pairs_[p].data.obstacle != nullptr)
        result[p] = pairs_[p].data.obstacle->pose();
    return result;
  }

  template <int dim>
  typename ObstaclePoses<dim>::Poses
  ObstaclePoses<dim>::before(const bool of_step) const
  {
    Poses result = now();
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if ((of_step || pairs_[p].has_committed_points())
          && p < committed_.size())
        result[p] = committed_[p];
      else if (pairs_[p].data.first_pose)
        result[p] = *pairs_[p].data.first_pose;
    return result;
  }

  template <int dim>
  dealii::Point<dim>
  ObstaclePoses<dim>::place_before(const std::size_t number,
                                   const dealii::Point<dim> &place) const
  {
    const RigidPose<dim> now = pairs_[number].data.obstacle->pose(),
                         then = before(true)[number];
    const dealii::Tensor<1, dim> own =
        transpose(now.rotation) * (place - now.translation);
    return dealii::Point<dim>(then.rotation * own + then.translation);
  }

  template <int dim> void ObstaclePoses<dim>::refuse_large_rotations() const
  {
    const Poses present = now(), then = before(true);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      const double angle = angle_between(then[p], present[p]);
      if (pairs_[p].data.friction == nullptr
          || pairs_[p].data.obstacle == nullptr || angle <= largest_rotation)
        continue;
      std::ostringstream text;
      text.precision(3);
      text << "its obstacle rotates by " << angle * 180. / M_PI
           << " degrees within a load step, of at most 15 degrees: friction "
              "uses the chord instead of the path along the surface. Use more "
              "steps (Time stepping/Number of steps).";
      throw ContactError(
          about_pair(pairs_[p].data.name, text.str(), PairField::obstacle));
    }
  }

  template class ObstaclePoses<2>;
  template class ObstaclePoses<3>;
} // namespace abut::shim

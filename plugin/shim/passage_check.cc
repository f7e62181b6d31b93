// SPDX-License-Identifier: LGPL-2.1-or-later
#include "passage_check.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/rigid_obstacle.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::shim
{
  template <int dim>
  Message too_long_a_step(const ContactPair<dim> &pair, const double way,
                          const std::string &so_that)
  {
    const double half = pair.obstacle->depth();
    std::ostringstream text;
    text.precision(3);
    text << pair.name << ": its obstacle";
    if (std::isfinite(half))
      text << ", " << 2. * half << " thick,";
    text << " moves by " << way << " relative to the body within this step and "
         << so_that
         << " Within a step the motion must be smaller than the thickness of "
            "the thinner one. Use a smaller Time stepping/Step size, or a "
            "slower obstacle (Motion, velocity, forces).";
    Message message = coded(ABUT_FAILURE_NO_PARTNER, text.str(),
                            {{"motion", way}, {"thickness", 2. * half}});
    message.field = PairField::obstacle;
    return message;
  }

  namespace
  {
    /** An obstacle at other times than the present one, until the end. */
    template <int dim> class Replay
    {
    public:
      Replay(const std::shared_ptr<const RigidObstacle<dim>> &obstacle,
             const double begin, const RigidPose<dim> &then)
          : obstacle(*std::const_pointer_cast<RigidObstacle<dim>>(obstacle)),
            begin(begin),
            end(this->obstacle.time()),
            now(this->obstacle.pose()),
            beside_then(then.translation - motion_at(begin).translation),
            beside_now(now.translation - motion_at(end).translation)
      {
      }

      ~Replay()
      {
        obstacle.set_time(end);
        obstacle.set_pose(now);
      }

      Replay(const Replay &) = delete;
      Replay &operator=(const Replay &) = delete;

      void go_to(const double part)
      {
        RigidPose<dim> pose = motion_at(begin + part * (end - begin));
        pose.translation += (1. - part) * beside_then + part * beside_now;
        obstacle.set_pose(pose);
      }

    private:
      RigidPose<dim> motion_at(const double time) const
      {
        // Without a motion it stays where it is put.
        obstacle.set_pose(now);
        obstacle.set_time(time);
        return obstacle.pose();
      }

      RigidObstacle<dim> &obstacle;
      const double begin, end;
      const RigidPose<dim> now;
      /** Part of the motion due to forces. */
      const dealii::Tensor<1, dim> beside_then, beside_now;
    };
  } // namespace

  template <int dim>
  std::vector<double>
  deepest_between(const std::shared_ptr<const RigidObstacle<dim>> &obstacle,
                  const double begin, const RigidPose<dim> &then,
                  const std::vector<dealii::Point<dim>> &from,
                  const std::vector<dealii::Point<dim>> &to)
  {
    constexpr int n_parts = 32;
    std::vector<double> result(from.size(), 0.), distance;
    std::vector<dealii::Point<dim>> points(from.size());
    Replay<dim> replay(obstacle, begin, then);
    for (int k = 1; k < n_parts; ++k)
    {
      const double part = double(k) / n_parts;
      replay.go_to(part);
      for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = from[i] + part * (to[i] - from[i]);
      obstacle->distance(points, distance);
      for (std::size_t i = 0; i < points.size(); ++i)
        result[i] = std::max(result[i], -distance[i]);
    }
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template Message too_long_a_step(const ContactPair<dim> &, double,           \
                                   const std::string &);                       \
  template std::vector<double> deepest_between(                                \
      const std::shared_ptr<const RigidObstacle<dim>> &, double,               \
      const RigidPose<dim> &, const std::vector<dealii::Point<dim>> &,         \
      const std::vector<dealii::Point<dim>> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

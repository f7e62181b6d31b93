// SPDX-License-Identifier: LGPL-2.1-or-later
#include "passage_check.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/rigid_obstacle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace abut::shim
{
  namespace
  {
    template <int dim> using Corners = std::array<dealii::Point<dim>, dim>;

    /** Outward, of any length. */
    dealii::Tensor<1, 2> outward(const Corners<2> &corner)
    {
      const dealii::Tensor<1, 2> t = corner[1] - corner[0];
      return dealii::Tensor<1, 2>({t[1], -t[0]});
    }

    dealii::Tensor<1, 3> outward(const Corners<3> &corner)
    {
      return dealii::cross_product_3d(corner[1] - corner[0],
                                      corner[2] - corner[0]);
    }

    /** Whether a point of the plane of a line or triangle is on it. */
    bool is_on(const dealii::Point<2> &x, const Corners<2> &corner)
    {
      return (x - corner[0]) * (x - corner[1]) <= 0.;
    }

    bool is_on(const dealii::Point<3> &x, const Corners<3> &corner)
    {
      const dealii::Tensor<1, 3> n = outward(corner);
      for (unsigned int a = 0; a < 3; ++a)
        if (n
                * dealii::cross_product_3d(corner[(a + 1) % 3] - corner[a],
                                           x - corner[a])
            < 0.)
          return false;
      return true;
    }

    /** The lines or triangles that stand for a facet of so many corners. */
    template <int dim>
    std::vector<std::array<unsigned int, dim>> parts(unsigned int n_corners);

    template <>
    std::vector<std::array<unsigned int, 2>> parts<2>(const unsigned int)
    {
      return {{{0, 1}}};
    }

    template <>
    std::vector<std::array<unsigned int, 3>>
    parts<3>(const unsigned int n_corners)
    {
      if (n_corners == 3)
        return {{{0, 1, 2}}};
      return {{{0, 1, 3}}, {{0, 3, 2}}};
    }

    /** A facet where it is at the start. */
    template <int dim> struct Target
    {
      std::vector<dealii::Point<dim>> corner;
      dealii::Tensor<1, dim> way; ///< of its middle
      double low = 0., high = 0.; ///< reach along the axis of the sort
      int number = 0;             ///< on its side
    };

    /** How deep the way from @p from to @p to ends behind a facet that it goes
     * through from outside against @p normal of the node, or 0. */
    template <int dim>
    double depth_behind(const Target<dim> &target,
                        const dealii::Point<dim> &from,
                        const dealii::Point<dim> &to,
                        const dealii::Tensor<1, dim> &normal)
    {
      double result = 0.;
      const auto n_corners = static_cast<unsigned int>(target.corner.size());
      for (const auto &part : parts<dim>(n_corners))
      {
        Corners<dim> corner;
        for (unsigned int a = 0; a < dim; ++a)
          corner[a] = target.corner[part[a]];
        dealii::Tensor<1, dim> n = outward(corner);
        if (n.norm() == 0.)
          continue;
        n /= n.norm();
        const double before = n * (from - corner[0]);
        const double after = n * (to - corner[0]);
        if (n * normal >= 0. || before < 0. || after >= 0.)
          continue;
        if (is_on(from + before / (before - after) * (to - from), corner))
          result = std::max(result, -after);
      }
      return result;
    }

    template <int dim>
    std::vector<Target<dim>>
    make_targets(const ContactSurface<dim> &whole,
                 const SurfaceSide<dim> &facets,
                 const std::vector<dealii::Point<dim>> &start,
                 const std::vector<dealii::Tensor<1, dim>> &way)
    {
      // Corners come first.
      const unsigned int n_corners = dim == 2 || whole.nodes_per_facet() == 3
                                             || whole.nodes_per_facet() == 6
                                         ? dim
                                         : 4;
      std::vector<Target<dim>> targets(facets.facet.size());
      for (std::size_t f = 0; f < targets.size(); ++f)
      {
        targets[f].number = static_cast<int>(f);
        for (unsigned int a = 0; a < n_corners; ++a)
        {
          const auto node = whole.facets[facets.facet[f]].node[a];
          targets[f].corner.push_back(start[node]);
          targets[f].way += way[node] / n_corners;
        }
      }
      return targets;
    }

    /** The axis along which points spread most. */
    template <int dim>
    unsigned int longest_axis(const std::vector<Target<dim>> &targets)
    {
      dealii::Tensor<1, dim> low, high;
      for (unsigned int d = 0; d < dim; ++d)
        low[d] = high[d] = targets.front().corner.front()[d];
      for (const Target<dim> &target : targets)
        for (const auto &x : target.corner)
          for (unsigned int d = 0; d < dim; ++d)
          {
            low[d] = std::min(low[d], x[d]);
            high[d] = std::max(high[d], x[d]);
          }
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (high[d] - low[d] > high[axis] - low[axis])
          axis = d;
      return axis;
    }

    /** Sort by where they begin along @p axis, seen by who goes @p away less
     * than they do; returns the longest. */
    template <int dim>
    double sort_along(const unsigned int axis,
                      const dealii::Tensor<1, dim> &mean,
                      std::vector<Target<dim>> &targets)
    {
      double longest = 0.;
      for (Target<dim> &target : targets)
      {
        const double moved = target.way[axis] - mean[axis];
        target.low = target.high = target.corner.front()[axis];
        for (const auto &x : target.corner)
        {
          target.low = std::min({target.low, x[axis], x[axis] + moved});
          target.high = std::max({target.high, x[axis], x[axis] + moved});
        }
        longest = std::max(longest, target.high - target.low);
      }
      std::sort(targets.begin(), targets.end(),
                [](const Target<dim> &a, const Target<dim> &b)
                { return a.low < b.low; });
      return longest;
    }
  } // namespace

  template <int dim>
  std::vector<Passage>
  passing_nodes(abut_context *context, const ContactSurface<dim> &whole,
                const SurfaceSide<dim> &nodes, const SurfaceSide<dim> &facets,
                const std::vector<dealii::Point<dim>> &start,
                const std::vector<dealii::Tensor<1, dim>> &way,
                const double depth)
  {
    std::vector<Passage> result;
    std::vector<Target<dim>> targets = make_targets(whole, facets, start, way);
    if (targets.empty() || nodes.n_nodes() == 0)
      return result;
    dealii::Tensor<1, dim> mean;
    for (const Target<dim> &target : targets)
      mean += target.way / double(targets.size());
    const unsigned int axis = longest_axis(targets);
    const double longest = sort_along(axis, mean, targets);
    const double *normals = nullptr;
    check(context, abut_surface_normals(nodes.surface.get(), &normals));
    for (int n = 0; n < nodes.n_nodes(); ++n)
    {
      const auto node = nodes.node[n];
      dealii::Tensor<1, dim> normal;
      for (unsigned int d = 0; d < dim; ++d)
        normal[d] = normals[n * dim + d];
      const double a = start[node][axis];
      const double b = a + way[node][axis] - mean[axis];
      Passage found{n, -1, depth};
      for (auto it = std::lower_bound(
               targets.begin(), targets.end(), std::min(a, b) - longest,
               [](const Target<dim> &target, const double value)
               { return target.low < value; });
           it != targets.end() && it->low <= std::max(a, b); ++it)
      {
        if (it->high < std::min(a, b))
          continue;
        const double behind = depth_behind(
            *it, start[node], start[node] + (way[node] - it->way), normal);
        if (behind > found.depth)
          found = {n, it->number, behind};
      }
      if (found.facet >= 0)
        result.push_back(found);
    }
    return result;
  }

  namespace
  {
    /** A point on its way past an obstacle. */
    template <int dim> class Traveller
    {
    public:
      Traveller(const dealii::Point<dim> &from, const dealii::Point<dim> &to,
                const double least)
          : from_(from), way_(to - from), least_(least)
      {
      }

      dealii::Point<dim> place() const
      {
        return from_ + part_ * way_;
      }

      /** Note what is met here and go on as far as nothing can be missed.
       * Returns false at the end of the way. */
      bool go_on(const double distance, const dealii::Tensor<1, dim> &outward,
                 const unsigned int step)
      {
        // The sides of a right angle are no more than one behind the other.
        constexpr double opposite = -0.1;
        // Ways along a surface are as long as many steps.
        constexpr unsigned int most_steps = 4096;
        seen.depth = std::max(seen.depth, -distance);
        const dealii::Tensor<1, dim> side =
            outward / std::max(outward.norm(), 1e-300);
        if (distance < 0. && !is_inside_)
          entry_ = has_side_ ? last_ : side;
        else if (distance >= 0. && is_inside_ && entry_ * side < opposite)
          seen.through = true;
        is_inside_ = distance < 0.;
        last_ = side;
        has_side_ = true;
        if (part_ == 1.)
          return false;
        const double length = way_.norm();
        const double shortest =
            step < most_steps ? least_ : std::max(least_, length / 64.);
        part_ = std::min(
            1., part_ + std::max(std::abs(distance), shortest) / length);
        return true;
      }

      OnTheWay seen;

    private:
      dealii::Point<dim> from_;
      dealii::Tensor<1, dim> way_, entry_, last_;
      double least_, part_ = 0.;
      bool is_inside_ = false, has_side_ = false;
    };
  } // namespace

  template <int dim>
  std::vector<OnTheWay> on_the_way(const RigidObstacle<dim> &obstacle,
                                   const std::vector<dealii::Point<dim>> &from,
                                   const std::vector<dealii::Point<dim>> &to,
                                   const std::vector<double> &end)
  {
    constexpr double part_of_way = 1. / 64., part_of_depth = 0.25;
    const double half = obstacle.depth();
    std::vector<OnTheWay> result(from.size());
    std::vector<std::size_t> under_way;
    std::vector<Traveller<dim>> travellers;
    for (std::size_t i = 0; i < from.size(); ++i)
    {
      const double length = (to[i] - from[i]).norm();
      travellers.emplace_back(
          from[i], to[i], std::min(part_of_way * length, part_of_depth * half));
      if (end[i] < length)
        under_way.push_back(i);
    }
    std::vector<double> distance;
    std::vector<dealii::Tensor<1, dim>> outward;
    for (unsigned int step = 0; !under_way.empty(); ++step)
    {
      std::vector<dealii::Point<dim>> points;
      for (const std::size_t i : under_way)
        points.push_back(travellers[i].place());
      obstacle.distance(points, distance, &outward);
      std::vector<std::size_t> left;
      for (std::size_t k = 0; k < under_way.size(); ++k)
      {
        const std::size_t i = under_way[k];
        if (travellers[i].go_on(distance[k], outward[k], step))
          left.push_back(i);
        else
          result[i] = travellers[i].seen;
      }
      under_way.swap(left);
    }
    return result;
  }

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
         << " It must not move by more than the thinner of the two is thick: "
            "make steps shorter (Time/Step), or let it move more slowly (its "
            "Motion, its velocity, the forces on it).";
    Message message = coded(ABUT_FAILURE_NO_PARTNER, text.str());
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
  template std::vector<OnTheWay> on_the_way(                                   \
      const RigidObstacle<dim> &, const std::vector<dealii::Point<dim>> &,     \
      const std::vector<dealii::Point<dim>> &, const std::vector<double> &);   \
  template Message too_long_a_step(const ContactPair<dim> &, double,           \
                                   const std::string &);                       \
  template std::vector<double> deepest_between(                                \
      const std::shared_ptr<const RigidObstacle<dim>> &, double,               \
      const RigidPose<dim> &, const std::vector<dealii::Point<dim>> &,         \
      const std::vector<dealii::Point<dim>> &);                                \
  template std::vector<Passage> passing_nodes(                                 \
      abut_context *, const ContactSurface<dim> &, const SurfaceSide<dim> &,   \
      const SurfaceSide<dim> &, const std::vector<dealii::Point<dim>> &,       \
      const std::vector<dealii::Tensor<1, dim>> &, double);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_pairs.h"

#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "app/mesh/make_rigid_obstacle.h"

#include <abut/dealii/coded.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  using dealii::types::boundary_id;

  namespace
  {
    template <int dim>
    bool moves(const RigidObstacleParameters &obstacle, const std::string &name,
               const unsigned int n_components)
    {
      const auto given = obstacle.values.find(name);
      if (given == obstacle.values.end() || given->second.empty())
        return false;
      const Expression<dim> formula(given->second, obstacle.parameter(name),
                                    n_components);
      bool is_zero = true;
      for (unsigned int d = 0; d < n_components; ++d)
        is_zero = is_zero && formula.is_zero(d);
      return name == "Expression" ? formula.depends_on_time() : !is_zero;
    }

    /** Gaps that leave out where an obstacle is leave out that it moves. */
    template <int dim>
    void refuse_unseen_motion(const PairParameters &pair,
                              const RigidObstacleParameters &obstacle)
    {
      if (pair.mesh_gap
          || (obstacle.free.empty() && !moves<dim>(obstacle, "Motion", dim)
              && !moves<dim>(obstacle, "Rotation angle", 1)
              && !moves<dim>(obstacle, "Expression", 1)))
        return;
      throw InputError(
          pair.parameter("Use mesh gap"),
          "false ignores the position of " + obstacle.section
              + ", also when it moves. Press with Initial gap = -0.01*t or by "
                "a prescribed displacement, or set Use mesh gap = true.");
    }
  } // namespace

  template <int dim>
  SolidPairs<dim>::SolidPairs(const SolidParameters &parameters,
                              const RunOptions &options)
      : parameters(parameters)
  {
    for (const RigidObstacleParameters &obstacle : parameters.obstacles)
      obstacles.push_back(
          make_rigid_obstacle<dim>(obstacle, options, half_extent));
    for (const PairParameters &pair : parameters.pairs)
    {
      gaps.push_back(std::make_unique<Expression<dim>>(
          pair.gap, pair.parameter("Initial gap")));
      ContactPair<dim> made;
      made.name = pair.section;
      made.geometric_gap = pair.mesh_gap;
      made.tied = pair.tied;
      made.reach = pair.reach;
      made.friction = make_friction(pair);
      if (pair.obstacle > 0)
      {
        refuse_unseen_motion<dim>(pair,
                                  parameters.obstacles[pair.obstacle - 1]);
        made.obstacle = obstacles[pair.obstacle - 1];
        obstacles[pair.obstacle - 1]->set_time(0.);
        made.first_pose = made.obstacle->pose();
      }
      all.push_back(made);
    }
  }

  template <int dim> bool is_frictional(const PairParameters &pair)
  {
    return !Expression<dim>(pair.friction, pair.parameter("Friction"))
                .is_zero();
  }

  template <int dim>
  std::shared_ptr<const Friction<dim>>
  SolidPairs<dim>::make_friction(const PairParameters &pair)
  {
    const auto formula = [&](const std::string &text, const std::string &name)
    {
      friction.emplace_back(all.size(), std::make_shared<Expression<dim>>(
                                            text, pair.parameter(name)));
      return
          [expression = friction.back().second](const dealii::Point<dim> &place)
      { return expression->evaluate({place})[0]; };
    };
    // Contact without friction pays nothing for it.
    if (!is_frictional<dim>(pair))
      return nullptr;
    auto made = std::make_shared<Friction<dim>>();
    made->coefficient = formula(pair.friction, "Friction");
    if (!pair.friction_cap.empty())
      made->cap = formula(pair.friction_cap, "Largest friction");
    return made;
  }

  template <int dim>
  std::vector<const Expression<dim> *>
  SolidPairs<dim>::varying_friction(const std::size_t pair) const
  {
    std::vector<const Expression<dim> *> result;
    for (const auto &[index, formula] : friction)
      if (index == pair && !formula->is_wholly_constant())
        result.push_back(formula.get());
    return result;
  }

  template <int dim>
  void SolidPairs<dim>::find_surfaces(const Bodies<dim> &bodies)
  {
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const PairParameters &given = parameters.pairs[i];
      all[i].secondary =
          bodies.surface(given.secondary, given.parameter("Secondary"));
      all[i].primary =
          bodies.surface(given.primary, given.parameter("Primary"));
      if (all[i].secondary == all[i].primary)
        continue; // a surface that touches itself
      for (const boundary_id id : all[i].secondary)
        if (all[i].primary.count(id) > 0)
          throw InputError(
              given.parameter("Primary"),
              coded(ABUT_FAILURE_BOTH_SIDES,
                    bodies.name(id)
                        + " is on both sides of the pair. For self contact "
                          "both sides must be the same."));
    }
  }

  template <int dim>
  void SolidPairs<dim>::require_free(
      const Bodies<dim> &bodies,
      const std::map<boundary_id, BoundaryCondition<dim>> &supports) const
  {
    const auto is_held = [&](const boundary_id id)
    {
      const auto support = supports.find(id);
      return support != supports.end()
             && support->second.components.n_selected_components(dim) == dim;
    };
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const auto &side = all[i].secondary;
      if (!std::all_of(side.begin(), side.end(), is_held))
        continue;
      const unsigned int body = bodies.body_of(*side.begin());
      throw InputError(
          parameters.pairs[i].parameter("Secondary"),
          "all nodes of the surface are prescribed by "
              + bodies[body].parameter("Prescribed displacement")
              + ", so that contact cannot move them. Exchange the two sides, "
                "or leave the surface free.");
    }
  }

  template <int dim>
  void SolidPairs<dim>::hold(const std::set<boundary_id> &surface,
                             const bool has_others)
  {
    for (ContactPair<dim> &pair : all)
      for (const auto *side : {&pair.secondary, &pair.primary})
        for (const boundary_id id : *side)
          // nobody holds itself
          if (surface.count(id) > 0
              && (has_others || pair.secondary != pair.primary))
            pair.holds_body = true;
  }

  template <int dim> void SolidPairs<dim>::let_fly()
  {
    for (ContactPair<dim> &pair : all)
      pair.may_be_apart = !pair.tied;
  }

  template <int dim>
  std::set<boundary_id>
  SolidPairs<dim>::touching(const Bodies<dim> &bodies) const
  {
    std::set<boundary_id> result;
    for (const ContactPair<dim> &pair : all)
    {
      if (pair.tied)
        continue;
      result.insert(pair.secondary.begin(), pair.secondary.end());
      // Either side may be the secondary one of a surface that touches itself:
      // two parts of one body with boundary ids of their own are alike.
      if (!pair.primary.empty()
          && bodies.body_of(*pair.primary.begin())
                 == bodies.body_of(*pair.secondary.begin()))
        result.insert(pair.primary.begin(), pair.primary.end());
    }
    return result;
  }

  template <int dim> void SolidPairs<dim>::let_come(const std::size_t obstacle)
  {
    for (ContactPair<dim> &pair : all)
      if (pair.obstacle == obstacles[obstacle])
        pair.may_be_apart = true;
  }

  template <int dim>
  void SolidPairs<dim>::place_obstacle(
      const std::size_t number,
      const dealii::Tensor<1, dim> &displacement) const
  {
    RigidObstacle<dim> &obstacle = *obstacles[number];
    obstacle.set_time(time);
    if (displacement == dealii::Tensor<1, dim>())
      return;
    RigidPose<dim> pose = obstacle.pose();
    pose.translation += displacement;
    obstacle.set_pose(pose);
  }

  template <int dim> void SolidPairs<dim>::set_time(const double present)
  {
    time = present;
    for (const auto &[pair, formula] : friction)
      formula->set_time(time);
    for (std::size_t o = 0; o < obstacles.size(); ++o)
      place_obstacle(o, driven.empty() ? dealii::Tensor<1, dim>() : driven[o]);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      gaps[i]->set_time(time);
      dealii::Point<dim> elsewhere;
      for (unsigned int d = 0; d < dim; ++d)
        elsewhere[d] = 0.7310585 + d;
      const auto values = gaps[i]->evaluate({dealii::Point<dim>(), elsewhere});
      if (values[0] != values[1])
        throw InputError(
            parameters.pairs[i].parameter("Initial gap"),
            "'" + gaps[i]->text()
                + "' depends on x, y or z; it may depend on t only.");
      all[i].gap = values[0];
    }
  }

  namespace
  {
    /** How far apart two poses are: lengths, and turns. */
    template <int dim>
    double difference(const RigidPose<dim> &a, const RigidPose<dim> &b)
    {
      return (a.translation - b.translation).norm()
             + (a.rotation - b.rotation).norm();
    }
  } // namespace

  template <int dim>
  void SolidPairs<dim>::refuse_jumps(const double begin, const double end) const
  {
    // What halving of the interval leaves of a change that is no jump.
    constexpr unsigned int n_halvings = 40, n_samples = 32;
    constexpr double part = 0.5, round_off = 1e-9;
    for (std::size_t o = 0; o < obstacles.size(); ++o)
    {
      RigidObstacle<dim> &obstacle = *obstacles[o];
      const auto pose_at = [&obstacle](const double at)
      {
        obstacle.set_time(at);
        return obstacle.pose();
      };
      // Rounded times see the other side of a bend.
      double range = 0.;
      for (unsigned int k = 0; k <= n_samples; ++k)
        range =
            std::max(range, difference(pose_at(0.), pose_at(parameters.time.end
                                                            * k / n_samples)));
      double low = begin, high = end;
      RigidPose<dim> first = pose_at(low), last = pose_at(high);
      const double whole = difference(first, last);
      if (!(whole > round_off * range))
      {
        place_obstacle(o,
                       driven.empty() ? dealii::Tensor<1, dim>() : driven[o]);
        continue;
      }
      for (unsigned int k = 0; k < n_halvings; ++k)
      {
        const double middle = 0.5 * (low + high);
        const RigidPose<dim> between = pose_at(middle);
        const bool is_before =
            difference(first, between) > difference(between, last);
        (is_before ? high : low) = middle;
        (is_before ? last : first) = between;
      }
      const double left = difference(first, last);
      place_obstacle(o, driven.empty() ? dealii::Tensor<1, dim>() : driven[o]);
      if (left < part * whole)
        continue;
      const bool turns = (first.rotation - last.rotation).norm() > part * left;
      throw InputError(
          parameters.obstacles[o].parameter(turns ? "Rotation angle"
                                                  : "Motion"),
          "the position of the obstacle jumps at t = " + short_number(high, 6)
              + (turns ? ""
                       : " by "
                             + short_number(
                                 (last.translation - first.translation).norm(),
                                 3))
              + ". Use a formula that is continuous in t.");
    }
  }

  template <int dim>
  std::vector<PlacedObstacle<dim>> SolidPairs<dim>::moved_obstacles() const
  {
    std::vector<PlacedObstacle<dim>> result;
    for (std::size_t o = 0; o < obstacles.size(); ++o)
    {
      const auto &obstacle = obstacles[o];
      obstacle->set_time(0.);
      const RigidPose<dim> start = obstacle->pose();
      place_obstacle(o, driven.empty() ? dealii::Tensor<1, dim>() : driven[o]);
      const RigidPose<dim> now = obstacle->pose();
      const auto centre = centre_of_rotation<dim>(parameters.obstacles[o]);
      const auto rotation = now.rotation * transpose(start.rotation);
      result.push_back(
          {obstacle, centre,
           rotation * (centre - start.translation) + now.translation - centre,
           rotation});
    }
    return result;
  }

  template <int dim> std::set<boundary_id> SolidPairs<dim>::secondary() const
  {
    std::set<boundary_id> result;
    for (const ContactPair<dim> &pair : all)
      result.insert(pair.secondary.begin(), pair.secondary.end());
    return result;
  }

  template <int dim> std::set<boundary_id> SolidPairs<dim>::surfaces() const
  {
    std::set<boundary_id> result = secondary();
    for (const ContactPair<dim> &pair : all)
      result.insert(pair.primary.begin(), pair.primary.end());
    return result;
  }

  template <int dim> std::vector<ContactSides> SolidPairs<dim>::sides() const
  {
    std::vector<ContactSides> result;
    for (const ContactPair<dim> &pair : all)
      if (!pair.primary.empty())
        result.push_back({pair.secondary, pair.primary});
    return result;
  }

  template <int dim>
  std::string SolidPairs<dim>::parameter_of(const Message &message) const
  {
    std::size_t found = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (message.pair == all[i].name)
        found = i;
    const PairParameters &pair = parameters.pairs[found];
    switch (message.field)
    {
    case PairField::obstacle:
      // Only formulas are found wrong after an obstacle has been made.
      return parameters.obstacles[pair.obstacle - 1].parameter("Expression");
    case PairField::largest_friction:
      return pair.parameter("Largest friction");
    case PairField::gap:
      return pair.parameter("Initial gap");
    case PairField::friction:
      return pair.parameter("Friction");
    case PairField::kinematics:
      return "Method/Contact geometry";
    default:
      return pair.parameter("Secondary");
    }
  }

  template bool is_frictional<2>(const PairParameters &);
  template bool is_frictional<3>(const PairParameters &);
  template class SolidPairs<2>;
  template class SolidPairs<3>;
} // namespace abut::app

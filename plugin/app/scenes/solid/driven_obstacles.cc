// SPDX-License-Identifier: LGPL-2.1-or-later
#include "driven_obstacles.h"

#include "app/input/input_error.h"
#include "app/input/number_text.h"
#include "app/input/short_number.h"

#include <abut/dealii/coded.h>
#include <abut/facet.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace abut::app
{
  namespace
  {
    /** A first guess of how deep a force presses, where nothing is known of
     * what resists; and part of it that differences are taken over. */
    constexpr double first_depth = 1., part_of_probe = 1e-3;

    /** Bodies of so many times their extent are out of the way. */
    constexpr double out_of_reach = 1e3;

    /** Steps towards a surface, each as long as the distance there. */
    constexpr unsigned int most_approaches = 200;

    /** Where obstacles can be, with something to spare. */
    constexpr double farthest = 1e-3 * ABUT_FACET_LIMIT;

    /** Larger ones lead out of the numbers in a step. */
    constexpr double largest_velocity = 1e30;

    /** What round-off leaves of numbers, with something to spare. */
    constexpr double round_off_part = 1e-13;

    /** Of places of bodies beside their extent; how many of them differences
     * are taken over at least; and below how many a depth is none. */
    constexpr double digits_of_bodies = 1e-15, least_probe = 1e3,
                     least_depth = 1e4;

    void check_time(const abut_status status)
    {
      if (status != ABUT_SUCCESS)
        throw std::runtime_error(
            "The motion of an obstacle is not finite any more.");
    }

    /** Formulas of t alone, with finite values. */
    template <int dim>
    dealii::Tensor<1, dim> values_in_time(Expression<dim> &formula,
                                          const double time)
    {
      dealii::Point<dim> elsewhere;
      for (unsigned int d = 0; d < dim; ++d)
        elsewhere[d] = 0.37 + 0.11 * d;
      formula.set_time(time);
      dealii::Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const auto values =
            formula.evaluate({dealii::Point<dim>(), elsewhere}, d);
        if (values[0] != values[1])
          throw InputError(formula.parameter(),
                           "'" + formula.text()
                               + "' depends on x, y or z; forces and motions "
                                 "of a rigid obstacle are formulas in t only.");
        result[d] = values[0];
      }
      return result;
    }
  } // namespace

  template <int dim>
  DrivenObstacles<dim>::DrivenObstacles(const SolidParameters &parameters)
      : parameters(parameters), in_time(parameters.time.is_on)
  {
    for (std::size_t o = 0; o < parameters.obstacles.size(); ++o)
      for (const unsigned int direction : parameters.obstacles[o].free)
        coordinates.push_back({o, direction, parameters.obstacles[o].mass});
    const std::size_t n = coordinates.size();
    for (Values *values :
         {&u, &v, &a, &load, &place, &force, &most_force, &predicted,
          &step_velocity, &contact, &contact_before, &next_u, &next_v, &next_a})
      values->assign(n, 0.);
    for (const Coordinate &coordinate : coordinates)
      massless.push_back(coordinate.mass == 0. ? 1 : 0);
  }

  template <int dim>
  std::string DrivenObstacles<dim>::name(const std::size_t coordinate) const
  {
    const Coordinate &c = coordinates[coordinate];
    return parameters.obstacles[c.obstacle].section + " along "
           + "xyz"[c.direction];
  }

  template <int dim>
  bool DrivenObstacles<dim>::is_driven(const std::size_t obstacle) const
  {
    return !parameters.obstacles[obstacle].free.empty();
  }

  template <int dim>
  bool DrivenObstacles<dim>::is_free(const std::size_t obstacle,
                                     const unsigned int direction) const
  {
    const auto &free = parameters.obstacles[obstacle].free;
    return std::find(free.begin(), free.end(), direction) != free.end();
  }

  template <int dim>
  void DrivenObstacles<dim>::refuse_motion(const std::size_t obstacle) const
  {
    const RigidObstacleParameters &given = parameters.obstacles[obstacle];
    const std::string &text = given.values.at("Motion");
    if (text.empty())
      return;
    const Expression<dim> motion(text, given.parameter("Motion"), dim);
    for (const unsigned int d : given.free)
      if (!motion.is_zero(d))
        throw InputError(given.parameter("Motion"),
                         std::string("the obstacle is driven by forces along ")
                             + "xyz"[d] + " ("
                             + given.parameter("Free directions")
                             + "): its motion there must be 0.");
  }

  template <int dim>
  void DrivenObstacles<dim>::check_velocity(const std::size_t obstacle) const
  {
    const RigidObstacleParameters &given = parameters.obstacles[obstacle];
    const std::vector<double> &velocity = given.initial_velocity;
    if (velocity.empty())
      return;
    const std::string name = given.parameter("Initial velocity");
    if (velocity.size() != dim)
      throw InputError(name, "needs " + std::to_string(dim) + " numbers, not "
                                 + std::to_string(velocity.size()) + "."
                                 + count_hint(velocity.size(), dim));
    for (unsigned int d = 0; d < dim; ++d)
    {
      if (!(std::abs(velocity[d]) <= largest_velocity))
        throw InputError(name, "'" + given.values.at("Initial velocity")
                                   + "' is no velocity.");
      if (velocity[d] != 0. && !is_free(obstacle, d))
        throw InputError(name, std::string("the obstacle does not move along ")
                                   + "xyz"[d] + ": "
                                   + given.parameter("Free directions")
                                   + " does not name it.");
    }
  }

  template <int dim> void DrivenObstacles<dim>::create_functions()
  {
    formulas.clear();
    bool has_mass = false;
    for (std::size_t o = 0; o < parameters.obstacles.size(); ++o)
    {
      const RigidObstacleParameters &given = parameters.obstacles[o];
      const std::string &text = given.values.at("Force");
      formulas.push_back(nullptr);
      if (given.free.empty())
        continue;
      for (const unsigned int d : given.free)
        if (d >= dim
            || (dim == 2 && d == 0
                && parameters.plane == PlaneModel::axisymmetric))
          throw InputError(given.parameter("Free directions"),
                           d >= dim ? "a scene in 2 dimensions has no z."
                                    : "an axisymmetric obstacle can only move "
                                      "along the axis: y.");
      if (!text.empty())
        formulas.back() = std::make_unique<Expression<dim>>(
            text, given.parameter("Force"), dim);
      refuse_motion(o);
      check_velocity(o);
      has_mass = has_mass || given.mass > 0.;
      if (in_time && given.mass == 0. && parameters.time.scheme.projects != 0)
        throw InputError(
            given.parameter("Mass"),
            std::string(parameters.time.scheme.name)
                + " needs mass to remove penetration: give the obstacle a "
                  "mass, or use Time stepping/Scheme = hht.");
    }
    gravity.reset();
    if (has_mass && !parameters.gravity.empty())
      gravity = std::make_unique<Expression<dim>>(parameters.gravity,
                                                  "Solid/Gravity", dim);
  }

  template <int dim>
  void DrivenObstacles<dim>::set_sizes(const double stiffness,
                                       const double half_extent)
  {
    size = half_extent;
    const bool has_depth =
        dim == 3 || parameters.plane == PlaneModel::axisymmetric;
    softness = 1. / (stiffness * (has_depth ? half_extent : 1.));
  }

  template <int dim> void DrivenObstacles<dim>::set_time(const double time)
  {
    present_time = time;
    Vector weight;
    if (gravity)
      weight = values_in_time(*gravity, time);
    std::vector<Vector> given(formulas.size());
    for (std::size_t o = 0; o < formulas.size(); ++o)
      if (formulas[o])
        given[o] = values_in_time(*formulas[o], time);
    for (std::size_t i = 0; i < coordinates.size(); ++i)
    {
      const Coordinate &c = coordinates[i];
      force[i] = given[c.obstacle][c.direction] + c.mass * weight[c.direction];
      most_force[i] = std::max(most_force[i], std::abs(force[i]));
    }
    is_new_step = true;
  }

  template <int dim> void DrivenObstacles<dim>::start()
  {
    for (std::size_t i = 0; i < coordinates.size(); ++i)
    {
      const Coordinate &c = coordinates[i];
      const auto &velocity = parameters.obstacles[c.obstacle].initial_velocity;
      u[i] = 0.;
      v[i] = velocity.empty() ? 0. : velocity[c.direction];
      a[i] = c.mass > 0. ? force[i] / c.mass : 0.;
      contact[i] = contact_before[i] = 0.;
    }
    load = force;
    place = next_u = u;
    next_v = v;
    next_a = a;
    work_of_step = 0.;
    balance.forget();
  }

  template <int dim> void DrivenObstacles<dim>::begin_start(const double step)
  {
    dt = step;
    stage = Stage::start;
    place = u;
  }

  template <int dim> void DrivenObstacles<dim>::end_start()
  {
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      if (coordinates[i].mass > 0.)
        a[i] = (force[i] + contact[i]) / coordinates[i].mass;
    place = u;
    stage = Stage::step;
  }

  template <int dim> void DrivenObstacles<dim>::resume()
  {
    load = force;
    place = next_u = u;
    next_v = v;
    next_a = a;
  }

  template <int dim>
  abut_time_state DrivenObstacles<dim>::state(Values &displacement,
                                              Values &velocity,
                                              Values &acceleration) const
  {
    return {sizeof(abut_time_state),
            &parameters.time.scheme,
            dt,
            static_cast<std::int64_t>(coordinates.size()),
            displacement.data(),
            velocity.data(),
            acceleration.data(),
            massless.data()};
  }

  template <int dim>
  abut_time_weights DrivenObstacles<dim>::weights(const Stage of) const
  {
    abut_time_weights result = {};
    check_time(abut_time_weigh(&parameters.time.scheme, dt,
                               of == Stage::projection ? ABUT_TIME_PROJECTION
                                                       : ABUT_TIME_STEP,
                               &result));
    return result;
  }

  template <int dim> void DrivenObstacles<dim>::begin_step(const double step)
  {
    dt = step;
    stage =
        parameters.time.scheme.projects != 0 ? Stage::projection : Stage::step;
    step_velocity = v;
    predicted = u;
    contact.assign(contact.size(), 0.);
    contact_before = contact;
    const abut_time_state from = state(u, step_velocity, a);
    check_time(abut_time_begin(&from, predicted.data()));
    place = predicted;
    // Where it goes if its acceleration stays.
    for (std::size_t i = 0; i < u.size() && stage == Stage::step; ++i)
      place[i] = u[i] + dt * (v[i] + 0.5 * dt * a[i]);
  }

  template <int dim> void DrivenObstacles<dim>::next_problem()
  {
    contact_before = contact;
    const abut_time_state from = state(u, step_velocity, a);
    check_time(abut_time_project(&from, predicted.data(), place.data()));
    stage = Stage::step;
  }

  template <int dim> void DrivenObstacles<dim>::end_step()
  {
    Values unknown = place;
    if (parameters.time.scheme.beta == 0.)
    {
      next_problem();
      contact.assign(contact.size(), 0.);
      unknown = given_forces();
      for (std::size_t i = 0; i < unknown.size(); ++i)
        unknown[i] /= coordinates[i].mass;
    }
    next_u = u;
    next_v = step_velocity;
    next_a = a;
    const abut_time_state to = state(next_u, next_v, next_a);
    check_time(abut_time_end(&to, unknown.data()));
    work_of_step = 0.;
    for (std::size_t i = 0; i < u.size(); ++i)
      work_of_step += 0.5 * (load[i] + force[i]) * (next_u[i] - u[i]);
  }

  template <int dim> double DrivenObstacles<dim>::kinetic_energy() const
  {
    double result = 0.;
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      result += 0.5 * coordinates[i].mass * next_v[i] * next_v[i];
    return result;
  }

  template <int dim> double DrivenObstacles<dim>::work() const
  {
    return work_of_step;
  }

  template <int dim> double DrivenObstacles<dim>::potential() const
  {
    double result = 0.;
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      result -= force[i] * place[i];
    return result;
  }

  template <int dim>
  typename DrivenObstacles<dim>::Values
  DrivenObstacles<dim>::inertia(const Values &at) const
  {
    Values result(at.size(), 0.);
    if (stage == Stage::statics)
      return result;
    if (stage == Stage::step)
    {
      Values before(u), velocity(step_velocity), acceleration(a);
      const abut_time_state from = state(before, velocity, acceleration);
      const abut_time_arguments arguments = {sizeof(abut_time_arguments),
                                             result.data(), nullptr, nullptr};
      check_time(abut_time_evaluate(&from, at.data(), &arguments));
      for (std::size_t i = 0; i < at.size(); ++i)
        result[i] *= coordinates[i].mass;
      return result;
    }
    const Values stiffness = stiffness_of_inertia();
    for (std::size_t i = 0; i < at.size(); ++i)
      result[i] =
          stiffness[i] * (at[i] - (stage == Stage::start ? u : predicted)[i]);
    return result;
  }

  template <int dim>
  typename DrivenObstacles<dim>::Values
  DrivenObstacles<dim>::stiffness_of_inertia() const
  {
    const double factor = stage == Stage::statics ? 0.
                          : stage == Stage::start ? 1. / (dt * dt)
                                                  : weights(stage).mass;
    Values result;
    for (const Coordinate &coordinate : coordinates)
      result.push_back(factor * coordinate.mass);
    return result;
  }

  template <int dim>
  typename DrivenObstacles<dim>::Values
  DrivenObstacles<dim>::given_forces() const
  {
    if (stage == Stage::projection)
      return Values(force.size(), 0.);
    if (stage != Stage::step)
      return force;
    const abut_time_weights of = weights(stage);
    Values result(force);
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = of.load * force[i] + of.load_before * load[i];
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  DrivenObstacles<dim>::vector_of(const std::size_t obstacle,
                                  const Values &values) const
  {
    Vector result;
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      if (coordinates[i].obstacle == obstacle)
        result[coordinates[i].direction] = values[i];
    return result;
  }

  template <int dim>
  typename DrivenObstacles<dim>::Values DrivenObstacles<dim>::way_to_contact(
      const Values &from, const Values &touching, const Clearance &clearance)
  {
    Values result(from.size(), 0.);
    const Values given = given_forces(), mass = stiffness_of_inertia();
    bool found = false;
    for (std::size_t o = 0; o < parameters.obstacles.size(); ++o)
    {
      const Vector driving = vector_of(o, given);
      if (!is_driven(o) || driving.norm() == 0.
          || vector_of(o, mass) != Vector()
          || vector_of(o, touching) != Vector())
        continue;
      const Vector direction = driving / driving.norm(),
                   start = vector_of(o, from);
      const double depth = first_depth * driving.norm() * softness;
      double way = 0.;
      for (unsigned int k = 0; k < most_approaches; ++k)
      {
        const double free = clearance(o, Vector(start + way * direction));
        way += std::max(0., free);
        if (!(way < out_of_reach * size) || free < 1e-3 * depth)
          break;
      }
      if (!(way < out_of_reach * size))
        continue;
      way += depth * std::exp2(n_ways);
      found = true;
      for (std::size_t i = 0; i < from.size(); ++i)
        if (coordinates[i].obstacle == o)
          result[i] = way * direction[coordinates[i].direction];
    }
    n_ways += found ? 1 : 0;
    return result;
  }

  template <int dim>
  void DrivenObstacles<dim>::begin_problem(const double tolerance,
                                           const Clearance &clearance)
  {
    n_ways = 0;
    if (stage == Stage::statics && is_new_step)
    {
      place = u;
      Values change(force);
      for (std::size_t i = 0; i < u.size(); ++i)
        change[i] -= load[i];
      const Values way = balance.way_under(change);
      for (std::size_t i = 0; i < u.size(); ++i)
        place[i] += way[i];
      if (!balance.knows_stiffness())
      {
        const Values there =
            way_to_contact(place, Values(u.size(), 0.), clearance);
        for (std::size_t i = 0; i < u.size(); ++i)
          place[i] += there[i];
      }
    }
    is_new_step = false;
    is_out = false;
    if (is_far(place))
      place = u;
    balance.begin(place, stiffness_of_inertia(), tolerance);
  }

  template <int dim>
  ForceBalance::Answer
  DrivenObstacles<dim>::take(const std::vector<Vector> &on_obstacles,
                             const Clearance &clearance)
  {
    const std::size_t n = coordinates.size();
    ForceBalance::Forces forces;
    const Values given = given_forces(), stopping = inertia(place),
                 stiffness = stiffness_of_inertia();
    for (std::size_t i = 0; i < n; ++i)
    {
      const Coordinate &c = coordinates[i];
      contact[i] = on_obstacles[c.obstacle][c.direction];
      forces.rest.push_back(given[i] + contact[i] - stopping[i]);
      forces.round_off.push_back(
          round_off_part
          * (stiffness[i] * (std::abs(place[i]) + std::abs(u[i]))
             + most_force[i]));
    }
    forces.contact = contact;
    forces.size.assign(n, 0.);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (coordinates[i].obstacle == coordinates[j].obstacle)
          forces.size[i] =
              std::max({forces.size[i], std::abs(given[j]),
                        std::abs(contact[j]), std::abs(stopping[j])});
    forces.way = way_to_contact(place, contact, clearance);
    forces.digits = digits_of_bodies * size;
    largest_force = *std::max_element(forces.size.begin(), forces.size.end());
    forces.probe = std::max(part_of_probe * softness * largest_force,
                            least_probe * forces.digits);
    ++n_tried;
    const ForceBalance::Answer answer = balance.take(forces);
    if (answer == ForceBalance::Answer::balanced)
      error_of_step =
          stage == Stage::step && parameters.time.scheme.projects != 0
              ? std::max(error_of_step, balance.error())
              : balance.error();
    return go_to(answer);
  }

  template <int dim> ForceBalance::Answer DrivenObstacles<dim>::refuse()
  {
    ++n_tried;
    return go_to(balance.refuse());
  }

  template <int dim> bool DrivenObstacles<dim>::is_far(const Values &at)
  {
    return std::any_of(at.begin(), at.end(),
                       [](const double x)
                       { return !(std::abs(x) < farthest); });
  }

  template <int dim>
  ForceBalance::Answer
  DrivenObstacles<dim>::go_to(const ForceBalance::Answer answer)
  {
    is_out = is_far(balance.place());
    place = is_out ? u : balance.place();
    return is_out ? ForceBalance::Answer::stuck : answer;
  }

  template <int dim>
  Message
  DrivenObstacles<dim>::explanation(const ForceBalance::Answer answer) const
  {
    const double depth = largest_force * softness;
    if (!is_out && depth < least_depth * digits_of_bodies * size)
      return "The forces on "
             + parameters.obstacles[coordinates.front().obstacle].section + ", "
             + short_number(largest_force, 3)
             + " at most, deform bodies by about " + short_number(depth, 2)
             + ", and positions as large as " + short_number(size, 2)
             + " make this smaller than round-off. Check the units of forces, "
               "lengths and stiffness.";
    if (answer == ForceBalance::Answer::loose)
    {
      const Coordinate &c = coordinates[balance.loose()];
      return coded(
          ABUT_FAILURE_FLOATING_BODY,
          "Nothing holds " + name(balance.loose())
              + ": neither mass nor contact resists its force there. Direct "
                "the force towards a body, move the obstacle nearer, or use "
              + std::string(1, "xyz"[c.direction]) + " out of "
              + parameters.obstacles[c.obstacle].parameter("Free directions")
              + ".");
    }
    if (is_out)
      return "Forces drive "
             + parameters.obstacles[coordinates.front().obstacle].section
             + " beyond all bounds: check for forces that are too large for "
               "the stiffness of the bodies or the mass of the obstacle.";
    return "No equilibrium was found for "
           + parameters.obstacles[coordinates.front().obstacle].section
           + ": after " + std::to_string(balance.n_places())
           + " positions its forces are out of balance by "
           + short_number(balance.error(), 3)
           + " of their size. Use smaller steps.";
  }

  template <int dim> void DrivenObstacles<dim>::commit()
  {
    if (in_time)
    {
      u = next_u;
      v = next_v;
      a = next_a;
    }
    else
      u = place;
    load = force;
    worst = std::max(worst, error_of_step);
    time_reached = present_time;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  DrivenObstacles<dim>::displacement(const std::size_t obstacle,
                                     const double time) const
  {
    if (stage == Stage::start && time > time_reached)
      return vector_of(obstacle, u) + dt * vector_of(obstacle, v);
    const bool is_committed = time == time_reached && stage != Stage::start;
    return vector_of(obstacle, is_committed ? u : place);
  }

  template <int dim>
  dealii::Tensor<1, dim>
  DrivenObstacles<dim>::velocity(const std::size_t obstacle) const
  {
    return vector_of(obstacle, next_v);
  }

  template <int dim>
  dealii::Tensor<1, dim>
  DrivenObstacles<dim>::contact_force(const std::size_t obstacle) const
  {
    Vector result = vector_of(obstacle, contact);
    return result + vector_of(obstacle, contact_before);
  }

  template <int dim>
  std::vector<std::string> DrivenObstacles<dim>::columns() const
  {
    std::vector<std::string> result;
    for (const Coordinate &c : coordinates)
    {
      const std::string key = "obstacle_" + std::to_string(c.obstacle + 1);
      const std::string end = std::string("_") + "xyz"[c.direction];
      result.push_back(key + "_displacement" + end);
      if (in_time)
        result.push_back(key + "_velocity" + end);
      result.push_back(key + "_force" + end);
    }
    return result;
  }

  template <int dim>
  void
  DrivenObstacles<dim>::add_to_row(std::map<std::string, double> &row) const
  {
    for (std::size_t i = 0; i < coordinates.size(); ++i)
    {
      const Coordinate &c = coordinates[i];
      const std::string key = "obstacle_" + std::to_string(c.obstacle + 1);
      const std::string end = std::string("_") + "xyz"[c.direction];
      row[key + "_displacement" + end] = (in_time ? next_u : place)[i];
      if (in_time)
        row[key + "_velocity" + end] = next_v[i];
      row[key + "_force" + end] = contact[i] + contact_before[i];
    }
  }

  template class DrivenObstacles<2>;
  template class DrivenObstacles<3>;
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
/* Steps of schemes whose contact acts by gaps; those with impulses are in
 * motion_impulses.cc. */
#include "motion.h"

#include "app/input/short_number.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace abut::app
{
  namespace
  {
    double largest_magnitude(const std::vector<double> &values)
    {
      double result = 0.;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }
  } // namespace

  Motion::Motion(const MassSystem &system_, const Plane &plane_,
                 const abut_time_scheme &scheme_)
      : system(system_),
        plane(plane_),
        scheme(scheme_),
        dimension(system.dimension),
        context(shim::create_context())
  {
    force.assign(system.size(), 0.);
    impulse.assign(dimension, 0.);
  }

  double Motion::gap_of(const std::vector<double> &at,
                        const std::size_t mass) const
  {
    return plane.gap + at[height(mass)];
  }

  std::vector<double> Motion::product(const std::vector<double> &matrix,
                                      const std::vector<double> &x) const
  {
    const std::size_t n = x.size();
    std::vector<double> result(n, 0.);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        result[i] += matrix[i * n + j] * x[j];
    return result;
  }

  double Motion::kinetic() const
  {
    const std::vector<double> mv = product(system.mass, v);
    return 0.5 * std::inner_product(v.begin(), v.end(), mv.begin(), 0.);
  }

  double Motion::strain() const
  {
    const std::vector<double> ku = product(system.stiffness, u);
    return 0.5 * std::inner_product(u.begin(), u.end(), ku.begin(), 0.);
  }

  double Motion::depth() const
  {
    double result = 0;
    if (plane.penalty > 0.)
      for (const std::size_t mass : system.candidates)
        result = std::max(result, -gap_of(u, mass));
    return result;
  }

  double Motion::contact() const
  {
    double sum = 0;
    for (const std::size_t mass : system.candidates)
    {
      const double depth = std::max(0., -gap_of(u, mass));
      sum += 0.5 * plane.penalty * depth * depth;
    }
    return sum;
  }

  double Motion::momentum(const unsigned int direction) const
  {
    const std::vector<double> mv = product(system.mass, v);
    double sum = 0;
    for (std::size_t i = direction; i < mv.size(); i += dimension)
      sum += mv[i];
    return sum;
  }

  double Motion::force_in(const unsigned int direction) const
  {
    double sum = 0;
    for (std::size_t i = direction; i < force.size(); i += dimension)
      sum += force[i];
    return sum;
  }

  double Motion::energy_of_forces(const double dt) const
  {
    double mass = 0., largest = 0.;
    for (const double value : system.mass)
      mass = std::max(mass, value);
    for (const double value : force)
      largest = std::max(largest, std::abs(value));
    return mass > 0. ? 0.5 * (largest * dt) * (largest * dt) / mass : 0.;
  }

  /* Inverse iteration: each step divides what is not of the slowest mode by the
   * squared ratio of frequencies. */
  double Motion::slowest_period()
  {
    constexpr int n_steps = 10;
    std::vector<double> x(system.size(), 1.), y, nothing;
    double square = 0.;
    for (int k = 0; k < n_steps; ++k)
    {
      const std::vector<double> mx = product(system.mass, x);
      nothing.clear();
      if (!solve(system.stiffness, mx, {}, y, nothing).empty())
        return std::numeric_limits<double>::infinity();
      const std::vector<double> my = product(system.mass, y);
      square = std::inner_product(y.begin(), y.end(), my.begin(), 0.)
               / std::inner_product(y.begin(), y.end(), mx.begin(), 0.);
      const double size = largest_magnitude(y);
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = y[i] / size;
    }
    return 2. * std::acos(-1.) * std::sqrt(square);
  }

  double Motion::stable_step() const
  {
    if (scheme.beta > 0)
      return std::numeric_limits<double>::infinity();
    std::vector<double> matrix = system.stiffness;
    const std::size_t n = system.size();
    for (const std::size_t mass : system.candidates)
      matrix[height(mass) * (n + 1)] += plane.penalty;
    // Masses are on the diagonal.
    std::vector<double> mass(n), x(n), y;
    for (std::size_t i = 0; i < n; ++i)
      mass[i] = system.mass[i * (n + 1)];
    const auto count = static_cast<std::int64_t>(n);
    abut_time_limit limit;
    require(abut_time_limit_begin(&limit, 0, count, x.data()));
    while (limit.goes_on != 0)
    {
      double sums[2];
      y = product(matrix, x);
      shim::check(
          context.get(),
          abut_time_limit_sums(count, mass.data(), x.data(), y.data(), sums));
      require(abut_time_limit_next(&limit, sums, count, mass.data(), y.data(),
                                   x.data()));
    }
    return limit.step;
  }

  abut_time_state Motion::state(const double dt)
  {
    return {sizeof(abut_time_state),
            &scheme,
            dt,
            static_cast<std::int64_t>(u.size()),
            u.data(),
            v.data(),
            a.data(),
            system.massless.data()};
  }

  void Motion::append_point(abut_points *points, const Row &row,
                            const bool has_friction) const
  {
    const auto node = static_cast<std::int32_t>(row.mass);
    const double one = 1.;
    if (dimension == 1)
    {
      require(abut_points_append_scalar(points, node, 1., row.gap,
                                        ABUT_POINT_CONTACT, 1, &node, &one));
      return;
    }
    // Outwards of the mass is down; tangents are the axes along the plane.
    std::vector<double> frame(std::size_t(dimension) * dimension, 0.);
    frame[dimension - 1] = -1.;
    for (unsigned int t = 0; t + 1 < dimension; ++t)
      frame[std::size_t(t + 1) * dimension + t] = 1.;
    const double gap[] = {row.gap, row.slip[0], row.slip[1]};
    abut_point point = abut_point_defaults();
    point.id = static_cast<std::int64_t>(row.mass * dimension);
    point.n_components =
        has_friction ? static_cast<std::int32_t>(dimension) : 1;
    point.frame = frame.data();
    point.gap = gap;
    point.n_nodes = point.n_secondary = 1;
    point.node = &node;
    point.coefficient = &one;
    require(abut_points_append(points, &point));
  }

  /** Options for exact answers, with scales from the problem itself. */
  abut_strategy_options
  Motion::contact_options(const std::vector<double> &matrix,
                          const std::vector<double> &residual,
                          const Rows &rows) const
  {
    abut_strategy_options options = abut_strategy_defaults();
    options.linear_tolerance = options.final_linear_tolerance = 1e-12;
    options.gap_tolerance = options.pressure_tolerance = 1e-11;
    const std::size_t n = residual.size();
    double length = 0, load = 0;
    for (std::size_t k = 0; k < n; ++k)
    {
      load = std::max(load, std::abs(residual[k]));
      length = std::max(length, std::abs(residual[k]) / matrix[k * (n + 1)]);
    }
    for (const Row &row : rows)
      for (const double each : {row.gap, row.slip[0], row.slip[1]})
      {
        length = std::max(length, std::abs(each));
        load =
            std::max(load, std::abs(each) * matrix[height(row.mass) * (n + 1)]);
      }
    options.length_scale = length > 0 ? length : 1.;
    options.pressure_scale = load > 0 ? load : 1.;
    return options;
  }

  /** matrix y = residual + contact, with what the rows demand. Forces on the
   * masses, [size], go to @p pressure, which the iteration begins with unless
   * it is empty. */
  Message Motion::solve(const std::vector<double> &matrix,
                        const std::vector<double> &residual, const Rows &rows,
                        std::vector<double> &y, std::vector<double> &pressure)
  {
    // Friction belongs to schemes that know velocities at contact.
    const bool has_friction = plane.friction > 0 && dimension > 1
                              && scheme.impulses != 0 && !rows.empty();
    const std::size_t per_mass = has_friction ? dimension : 1;
    auto points = shim::create_points(context.get(),
                                      static_cast<std::int32_t>(dimension));
    std::vector<std::int32_t> first;
    for (const Row &row : rows)
    {
      append_point(points.get(), row, has_friction);
      first.push_back(static_cast<std::int32_t>(first.size() * per_mass));
    }
    const std::vector<std::uint8_t> n_tangents(
        rows.size(), static_cast<std::uint8_t>(dimension - 1));
    const std::vector<double> coefficient(rows.size(), plane.friction);
    abut_strategy_friction friction = {};
    friction.struct_size = sizeof(friction);
    friction.n = static_cast<std::int32_t>(rows.size());
    friction.first = first.data();
    friction.n_tangents = n_tangents.data();
    friction.coefficient = coefficient.data();
    const abut_dense_model model = {
        sizeof(model), static_cast<std::int32_t>(residual.size()),
        matrix.data(), residual.data(),
        points.get(),  has_friction ? &friction : nullptr};
    y.assign(residual.size(), 0.);
    // Of each component of a row, the place of its force.
    std::vector<std::size_t> place;
    for (const Row &row : rows)
    {
      place.push_back(height(row.mass));
      for (std::size_t t = 1; t < per_mass; ++t)
        place.push_back(row.mass * dimension + t - 1);
    }
    std::vector<double> forces(place.size(), 0.);
    for (std::size_t k = 0; k < place.size() && !pressure.empty(); ++k)
      forces[k] = pressure[place[k]];
    const Message failure =
        solve_model(model, contact_options(matrix, residual, rows), y, forces);
    pressure.assign(residual.size(), 0.);
    for (std::size_t k = 0; k < place.size(); ++k)
      pressure[place[k]] = forces[k];
    return failure;
  }

  void Motion::require(const abut_status status) const
  {
    if (status != ABUT_SUCCESS)
      throw std::range_error(shim::core_message(context.get()));
  }

  Message Motion::why_unsolved(const abut_status status) const
  {
    const double mass = largest_magnitude(system.mass),
                 stiffness = largest_magnitude(system.stiffness);
    const std::string sizes = "masses of " + short_number(mass, 3)
                              + " and springs of " + short_number(stiffness, 3);
    // Squares of these leave the range of numbers, and none is an answer.
    constexpr double most = 1e100;
    if (status == ABUT_NOT_FINITE && std::max(mass, stiffness) < most)
      return coded(ABUT_FAILURE_BLOW_UP, "a value of the motion is infinite");
    if (status != ABUT_SINGULAR)
      return coded(ABUT_FAILURE_NOT_FINITE,
                   sizes + " exceed the range of numbers ("
                       + shim::core_message(context.get())
                       + "). Choose other units of lengths, masses and times.");
    return coded(ABUT_FAILURE_FLOATING_BODY,
                 "inertia is below round-off of the stiffness: " + sizes
                     + " differ too much, and rigid body modes are free. Use a "
                       "larger density or mass, a smaller Time stepping/Step "
                       "size, or less stiffness.");
  }

  Message Motion::solve_model(const abut_dense_model &model,
                              const abut_strategy_options &options,
                              std::vector<double> &y,
                              std::vector<double> &forces)
  {
    abut_progress progress = {};
    abut_reason reason = ABUT_REASON_NONE;
    const abut_status status = abut_dense_model_solve(
        context.get(), &model, &options, y.data(), forces.data(), nullptr,
        nullptr, nullptr, &progress, &reason);
    if (status != ABUT_SUCCESS)
      return why_unsolved(status);
    return reason == ABUT_REASON_CONVERGED
               ? ""
               : coded(abut_reason_failure(reason, options.law, &progress),
                       abut_reason_text(reason));
  }

  Motion::Rows Motion::rows_at(const std::vector<double> &at) const
  {
    Rows rows;
    for (const std::size_t mass : system.candidates)
      rows.push_back({mass, gap_of(at, mass), {0., 0.}});
    return rows;
  }

  std::vector<double> Motion::step_matrix(const double dt,
                                          const abut_time_stage stage) const
  {
    abut_time_weights weights;
    require(abut_time_weigh(&scheme, dt, stage, &weights));
    std::vector<double> matrix(system.mass.size());
    for (std::size_t k = 0; k < matrix.size(); ++k)
      matrix[k] = weights.mass * system.mass[k]
                  + weights.stiffness * system.stiffness[k];
    return matrix;
  }

  std::vector<double> Motion::residual_at(const double dt,
                                          const std::vector<double> &x,
                                          const std::vector<double> &before,
                                          const std::vector<double> &after)
  {
    abut_time_weights weights;
    require(abut_time_weigh(&scheme, dt, ABUT_TIME_STEP, &weights));
    std::vector<double> inertia(x.size()), elastic(x.size());
    const abut_time_arguments arguments = {sizeof(arguments), inertia.data(),
                                           nullptr, elastic.data()};
    const abut_time_state now = state(dt);
    require(abut_time_evaluate(&now, x.data(), &arguments));
    const std::vector<double> ma = product(system.mass, inertia),
                              ku = product(system.stiffness, elastic);
    std::vector<double> residual(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      residual[i] = weights.load * after[i] + weights.load_before * before[i]
                    - ma[i] - ku[i];
    return residual;
  }

  void Motion::add_force(const std::vector<double> &forces, const double part)
  {
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] += part * forces[i];
  }

  /** M a = f - K u + contact of what touches and does not leave. */
  Message Motion::begin_acceleration(const std::vector<double> &load)
  {
    const std::size_t n = system.size();
    std::vector<double> matrix = system.mass, forces,
                        residual = product(system.stiffness, u);
    for (std::size_t i = 0; i < n; ++i)
    {
      residual[i] = system.massless[i] ? 0. : load[i] - residual[i];
      if (system.massless[i])
        matrix[i * (n + 1)] = 1.;
    }
    Rows rows;
    for (const std::size_t mass : system.candidates)
      if (is_closed(mass) && plane.penalty == 0)
        rows.push_back({mass, 0., {0., 0.}});
    return solve(matrix, residual, rows, a, forces);
  }

  Message Motion::start(const std::vector<double> &displacement,
                        const std::vector<double> &velocity,
                        const std::vector<double> &load)
  {
    u = displacement;
    v = velocity;
    a.assign(u.size(), 0.);
    length_scale = std::abs(plane.gap);
    speed_scale = 0;
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      length_scale = std::max(length_scale, std::abs(u[i]));
      speed_scale = std::max(speed_scale, std::abs(v[i]));
    }
    try
    {
      return abut_time_needs_acceleration(&scheme) ? begin_acceleration(load)
                                                   : "";
    }
    catch (const std::range_error &)
    {
      return why_unsolved();
    }
  }

  /** What the plane makes of where the masses would go. */
  Message Motion::project(const double dt, std::vector<double> &predicted)
  {
    std::vector<double> y, forces;
    const std::vector<double> nothing(predicted.size(), 0.);
    const Message failure = solve(step_matrix(dt, ABUT_TIME_PROJECTION),
                                  nothing, rows_at(predicted), y, forces);
    if (!failure.empty())
      return failure;
    std::vector<double> projected = predicted;
    for (std::size_t i = 0; i < y.size(); ++i)
      projected[i] += y[i];
    const abut_time_state now = state(dt);
    require(abut_time_project(&now, predicted.data(), projected.data()));
    predicted = projected;
    add_force(forces, 1.);
    return "";
  }

  Message Motion::implicit_step(const double dt, std::vector<double> &x,
                                const std::vector<double> &before,
                                const std::vector<double> &after)
  {
    std::vector<double> y, forces;
    const Message failure =
        solve(step_matrix(dt, ABUT_TIME_STEP),
              residual_at(dt, x, before, after), rows_at(x), y, forces);
    if (!failure.empty())
      return failure;
    for (std::size_t i = 0; i < y.size(); ++i)
      x[i] += y[i];
    add_force(forces, 1.);
    const abut_time_state now = state(dt);
    require(abut_time_end(&now, x.data()));
    return "";
  }

  /* Newton's method: forces are monotone and convex in the gap at the end, so
   * that there is one answer, which a single mass always comes to. */
  Message Motion::step_on_springs(const double dt, std::vector<double> &x,
                                  const std::vector<double> &before,
                                  const std::vector<double> &after)
  {
    constexpr int most_steps = 100;
    constexpr double small = 1e-12;
    const std::size_t n = u.size();
    const std::vector<double> matrix = step_matrix(dt, ABUT_TIME_STEP);
    std::vector<double> y, springs(n), nothing;
    for (int k = 0; k < most_steps; ++k)
    {
      std::vector<double> tangent = matrix,
                          residual = residual_at(dt, x, before, after);
      double length = length_scale;
      for (const std::size_t mass : system.candidates)
      {
        const std::size_t i = height(mass);
        double slope = 0;
        require(abut_time_spring(plane.penalty, gap_of(u, mass),
                                 gap_of(x, mass), &springs[i], &slope));
        tangent[i * (n + 1)] -= slope;
        residual[i] += springs[i];
      }
      nothing.clear();
      const Message failure = solve(tangent, residual, {}, y, nothing);
      if (!failure.empty())
        return failure;
      double change = 0;
      for (std::size_t i = 0; i < n; ++i)
      {
        x[i] += y[i];
        change = std::max(change, std::abs(y[i]));
        length = std::max(length, std::abs(x[i]));
      }
      if (change > small * length)
        continue;
      add_force(springs, 1.);
      const abut_time_state now = state(dt);
      require(abut_time_end(&now, x.data()));
      return "";
    }
    return coded(ABUT_FAILURE_STEP_LIMIT,
                 "the springs of the plane are not in balance after 100 steps "
                 "of Newton's method");
  }

  Message Motion::explicit_step(const double dt,
                                const std::vector<double> &place,
                                const std::vector<double> &before,
                                const std::vector<double> &after)
  {
    const std::vector<double> nothing(place.size(), 0.);
    std::vector<double> residual = residual_at(dt, nothing, before, after),
                        springs(place.size(), 0.);
    for (const std::size_t mass : system.candidates)
      springs[height(mass)] =
          scheme.contact_in_step
              ? plane.penalty * std::max(0., -gap_of(place, mass))
              : 0.;
    // Masses are on the diagonal.
    for (std::size_t i = 0; i < place.size(); ++i)
      residual[i] =
          (residual[i] + springs[i]) / system.mass[i * (place.size() + 1)];
    add_force(springs, 1.);
    const abut_time_state now = state(dt);
    const abut_status status = abut_time_end(&now, residual.data());
    if (status == ABUT_NOT_FINITE)
      return coded(ABUT_FAILURE_BLOW_UP, "a value of the motion is infinite");
    require(status);
    return "";
  }

  bool Motion::begins_to_touch(const std::vector<double> &old,
                               const std::vector<double> &old_force) const
  {
    constexpr double round_off = 1e-12;
    const double least = round_off * largest_magnitude(force);
    return std::any_of(
        system.candidates.begin(), system.candidates.end(),
        [&](const std::size_t mass)
        {
          const std::size_t i = height(mass);
          return force[i] > least && old_force[i] <= least
                 && (time > 0. || gap_of(old, mass) > round_off * length_scale);
        });
  }

  void Motion::finish(const double dt, const std::vector<double> &old,
                      const std::vector<double> &old_force,
                      const std::vector<double> &before,
                      const std::vector<double> &after)
  {
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      external_work += 0.5 * (before[i] + after[i]) * (u[i] - old[i]);
      impulse[i % dimension] += dt * force[i];
    }
    if (scheme.impulses == 0 && begins_to_touch(old, old_force))
      touch_times.push_back(time + dt);
  }

  Message Motion::step(const double dt, const std::vector<double> &before,
                       const std::vector<double> &after)
  {
    const std::vector<double> old = u, old_force = force;
    std::fill(force.begin(), force.end(), 0.);
    Message failure;
    try
    {
      failure = solve_step(dt, before, after);
      finish(dt, old, old_force, before, after);
    }
    catch (const std::range_error &)
    {
      failure = why_unsolved();
    }
    return failure;
  }

  Message Motion::solve_step(const double dt, const std::vector<double> &before,
                             const std::vector<double> &after)
  {
    if (scheme.impulses)
    {
      std::vector<double> load(before.size());
      for (std::size_t i = 0; i < load.size(); ++i)
        load[i] = 0.5 * (before[i] + after[i]);
      return impulse_step(dt, load);
    }
    std::vector<double> x(u.size());
    const abut_time_state now = state(dt);
    require(abut_time_begin(&now, x.data()));
    const Message failure = scheme.projects ? project(dt, x) : "";
    return !failure.empty()       ? failure
           : scheme.keeps_springs ? step_on_springs(dt, x, before, after)
           : scheme.beta > 0      ? implicit_step(dt, x, before, after)
                                  : explicit_step(dt, x, before, after);
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
/* The velocity level. A step is cut where a mass touches the plane; there,
 * impulses change velocities at once (Moreau),
 *
 *     M (v+ - v-) = P,   0 <= P_n _|_ v+_n + e v-_n >= 0,
 *
 * and masses that stay on the plane have v_n >= 0 at the end of the next part,
 * with friction against their velocity there. */
#include "motion.h"

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    /** What counts as touching and as standing still, by the largest lengths
     * and speeds so far; and the speed below which nothing bounces any more: it
     * would rise no higher than what counts as touching. */
    constexpr double touching = 1e-12, still = 1e-12, last_bounce = 1e-6;
    constexpr int most_impacts = 10000; ///< in a step
  }                                     // namespace

  bool Motion::is_closed(const std::size_t mass) const
  {
    return gap_of(u, mass) <= touching * length_scale
           && v[height(mass)] <= still * speed_scale;
  }

  bool Motion::comes_in(const std::size_t mass) const
  {
    return gap_of(u, mass) <= touching * length_scale
           && v[height(mass)] < -still * speed_scale;
  }

  Message Motion::impact(const double dt)
  {
    Rows rows;
    for (const std::size_t mass : system.candidates)
    {
      if (!comes_in(mass) && !is_closed(mass))
        continue;
      const double in = v[height(mass)];
      const bool bounces = in < -last_bounce * speed_scale;
      Row row = {mass, in * (1. + (bounces ? plane.restitution : 0.)), {}};
      for (unsigned int t = 0; t + 1 < dimension; ++t)
        row.slip[t] = v[mass * dimension + t];
      rows.push_back(row);
    }
    std::vector<double> y, forces;
    const std::vector<double> nothing(u.size(), 0.);
    const Message failure = solve(system.mass, nothing, rows, y, forces);
    if (!failure.empty())
      return failure;
    const double before = kinetic();
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] += y[i];
    for (const Row &row : rows)
      // Round-off must not be taken for a last, endless row of bounces.
      if (std::abs(v[height(row.mass)]) <= still * speed_scale)
        v[height(row.mass)] = 0.;
    lost_in_impacts += before - kinetic();
    add_force(forces, 1. / dt);
    touch_times.push_back(time);
    return "";
  }

  Motion::Rows Motion::closed_rows(const double length) const
  {
    Rows rows;
    for (const std::size_t mass : system.candidates)
    {
      if (!is_closed(mass))
        continue;
      // At the increment y the velocity at the end is v + 2 y / length.
      Row row = {mass, 0.5 * length * v[height(mass)], {}};
      for (unsigned int t = 0; t + 1 < dimension; ++t)
        row.slip[t] = 0.5 * length * v[mass * dimension + t];
      rows.push_back(row);
    }
    return rows;
  }

  /** Where a part of the step leads, with what is on the plane staying there
   * or leaving. @p forces are those to begin with, and then those of the part.
   */
  Message Motion::glide(const double length, const std::vector<double> &load,
                        std::vector<double> &end, std::vector<double> &forces)
  {
    end.resize(u.size());
    const abut_time_state now = state(length);
    require(abut_time_begin(&now, end.data()));
    std::vector<double> y;
    const Message failure = solve(step_matrix(length, ABUT_TIME_STEP),
                                  residual_at(length, end, load, load),
                                  closed_rows(length), y, forces);
    for (std::size_t i = 0; i < y.size(); ++i)
      end[i] += y[i];
    return failure;
  }

  /** Least height of what was not on the plane; by length where it left the
   * plane just now, so that the start is no touch. */
  double Motion::least_gap(const double length,
                           const std::vector<double> &end) const
  {
    double least = length_scale > 0 ? length_scale : 1.;
    for (const std::size_t mass : system.candidates)
    {
      if (is_closed(mass))
        continue;
      const bool leaves = gap_of(u, mass) <= touching * length_scale;
      least = std::min(least,
                       leaves ? gap_of(end, mass) / length : gap_of(end, mass));
    }
    return least;
  }

  /** Shorten a part of the step so that it ends where the first mass touches:
   * the false position, halved where one side stays (Illinois). */
  Message Motion::glide_to_touch(double &length,
                                 const std::vector<double> &load,
                                 std::vector<double> &end,
                                 std::vector<double> &forces)
  {
    Message failure;
    const auto height_at = [&](const double where)
    {
      failure = glide(where, load, end, forces);
      return failure.empty() ? least_gap(where, end) : 0.;
    };
    double high = length, f_high = least_gap(high, end), low = 0.5 * high,
           f_low = height_at(low);
    while (f_low <= 0. && failure.empty() && low > 1e-14 * length)
    {
      high = low;
      f_high = f_low;
      low *= 0.5;
      f_low = height_at(low);
    }
    const double enough = 1e-15 * (std::abs(f_low) + std::abs(f_high));
    length = high;
    for (int k = 0; k < 100 && failure.empty() && f_low > 0.; ++k)
    {
      const double middle = (low * f_high - high * f_low) / (f_high - f_low);
      if (!(middle > low && middle < high))
        break;
      length = middle;
      const double value = height_at(middle);
      if (std::abs(value) <= enough)
        break;
      (value > 0. ? low : high) = middle;
      (value > 0. ? f_low : f_high) = value;
      (value > 0. ? f_high : f_low) *= 0.5;
    }
    return failure.empty() ? glide(length, load, end, forces) : failure;
  }

  /** Take over where a part of the step has led. */
  void Motion::end_part(const double length, const double dt,
                        const std::vector<double> &end,
                        const std::vector<double> &forces)
  {
    const std::vector<double> before = v;
    const abut_time_state now = state(length);
    std::vector<std::size_t> closed;
    for (const std::size_t mass : system.candidates)
      if (is_closed(mass))
        closed.push_back(mass);
    require(abut_time_end(&now, end.data()));
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      speed_scale = std::max(speed_scale, std::abs(v[i]));
      length_scale = std::max(length_scale, std::abs(u[i]));
      if ((i + 1) % dimension != 0)
        dissipated -= length * forces[i] * 0.5 * (before[i] + v[i]);
    }
    // What is on the plane is so to the last digit.
    for (const std::size_t mass : closed)
      if (std::abs(v[height(mass)]) <= still * speed_scale)
        v[height(mass)] = 0.;
    for (const std::size_t mass : system.candidates)
      if (gap_of(u, mass) < touching * length_scale)
        u[height(mass)] = -plane.gap;
    add_force(forces, length / dt);
    time += length;
  }

  Message Motion::impulse_step(const double dt, const std::vector<double> &load)
  {
    double left = dt;
    std::vector<double> end, forces;
    for (int k = 0; k < most_impacts; ++k)
    {
      Message failure;
      if (std::any_of(system.candidates.begin(), system.candidates.end(),
                      [&](const std::size_t mass) { return comes_in(mass); }))
        failure = impact(dt);
      double length = left;
      if (failure.empty())
        failure = glide(length, load, end, forces);
      const bool touches = failure.empty() && least_gap(length, end) < 0.;
      if (touches)
        failure = glide_to_touch(length, load, end, forces);
      if (!failure.empty())
        return failure;
      end_part(length, dt, end, forces);
      if (!touches)
        return "";
      left -= length;
    }
    return coded(ABUT_FAILURE_STEP_LIMIT,
                 "more than 10000 impacts in a time step");
  }
} // namespace abut::app

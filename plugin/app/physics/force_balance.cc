// SPDX-License-Identifier: LGPL-2.1-or-later
#include "force_balance.h"

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Places of one search: even halves come to the end of a double. */
    constexpr unsigned int most_places = 60;

    /** Halves of a step that does not lower the rest. */
    constexpr unsigned int most_halves = 8;

    /** Part of the rest that a step of several coordinates has to leave at
     * most. */
    constexpr double least_fall = 0.9;

    /** A step with one coordinate may be so many times the last one. */
    constexpr double largest_growth = 10.;

    /** Of a place beside gaps of its size. */
    constexpr double digits_of_place = 1e-15;

    /** A rest that the digits of places explain is this part of the forces at
     * most, or there is no answer. */
    constexpr double largest_excuse = 1e-3;

    /** Pivots below this part of the largest one are nothing. */
    constexpr double small_pivot = 1e-12;
  } // namespace

  void ForceBalance::begin(const std::vector<double> &place,
                           const std::vector<double> &inertia,
                           const double tolerance)
  {
    place_ = place;
    inertia_ = inertia;
    tolerance_ = tolerance;
    error_ = 0.;
    n_places_ = n_halved_ = 0;
    probes_ = is_fresh_ = has_base_ = has_below_ = has_above_ = false;
    if (stiffness_.size() != n() * n())
      forget();
  }

  void ForceBalance::forget()
  {
    stiffness_.clear();
  }

  double ForceBalance::error_of(const Forces &forces, const bool excuse) const
  {
    double result = 0.;
    for (std::size_t i = 0; i < n(); ++i)
    {
      double least = forces.round_off[i];
      if (excuse)
        least += std::max(digits_of_place * std::abs(place_[i]), forces.digits)
                 * std::max(0., stiffness(i, i));
      const double rest = std::max(0., std::abs(forces.rest[i]) - least);
      const double part = rest > 0. ? rest / forces.size[i] : 0.;
      // A rest beside nothing at all is no number to go by.
      result = std::max(result, std::isfinite(part) ? part : 1.);
    }
    return result;
  }

  ForceBalance::Visit ForceBalance::visit(const Forces &forces) const
  {
    Visit result = {place_, forces, 0.};
    for (const double rest : forces.rest)
      result.norm = std::max(result.norm, std::abs(rest));
    return result;
  }

  double ForceBalance::stiffness(const std::size_t i, const std::size_t j) const
  {
    return (i == j ? inertia_[i] : 0.)
           + (stiffness_.empty() ? 0. : stiffness_[i * n() + j]);
  }

  bool ForceBalance::touches(const Forces &forces) const
  {
    return std::any_of(forces.contact.begin(), forces.contact.end(),
                       [](const double force) { return force != 0.; });
  }

  ForceBalance::Answer ForceBalance::take(const Forces &forces)
  {
    ++n_places_;
    if (probes_)
      return take_probe(forces);
    error_ = error_of(forces, false);
    if (error_ <= tolerance_
        || (error_ <= largest_excuse && error_of(forces, true) <= tolerance_))
    {
      // What has left has no stiffness to be met with again.
      if (!touches(forces))
        forget();
      return Answer::balanced;
    }
    if (n_places_ >= most_places)
      return Answer::stuck;
    return go_on(forces);
  }

  ForceBalance::Answer ForceBalance::go_on(const Forces &forces)
  {
    if (n() == 1)
      return bracket(forces);
    const Visit now = visit(forces);
    if (has_base_)
    {
      const bool is_better = now.norm < least_fall * base_.norm;
      if (is_better || !is_fresh_)
        learn(base_.place, base_.forces, place_, forces);
      if (!is_better)
      {
        if (!is_fresh_ && touches(base_.forces))
          return begin_probes();
        return refuse();
      }
    }
    base_ = now;
    has_base_ = true;
    is_fresh_ = false;
    n_halved_ = 0;
    if (stiffness_.empty() && touches(forces))
      return begin_probes();
    return step_from_base();
  }

  /* One coordinate: r falls with x, as what is pressed in resists the more. */
  ForceBalance::Answer ForceBalance::bracket(const Forces &forces)
  {
    const double x = place_[0], r = forces.rest[0];
    const Visit now = visit(forces);
    const double width_before =
        has_below_ && has_above_ ? above_.place[0] - below_.place[0] : 0.;
    (r > 0. ? below_ : above_) = now;
    (r > 0. ? has_below_ : has_above_) = true;
    const bool is_enclosed = has_below_ && has_above_;
    double slope = 0., last_way = 0.;
    bool is_slow = false;
    if (has_base_ && base_.place[0] != x)
    {
      last_way = x - base_.place[0];
      slope = -(r - base_.forces.rest[0]) / last_way;
      is_slow = now.norm > 0.5 * base_.norm;
      if (slope > inertia_[0])
        stiffness_ = {slope - inertia_[0]};
    }
    else if (!has_base_)
      slope = stiffness(0, 0);
    if (!touches(forces))
      slope = inertia_[0];
    base_ = now;
    has_base_ = true;
    n_halved_ = 0;
    if (stiffness_.empty() && touches(forces))
      return begin_probes();
    double next = x;
    if (slope > 0.)
    {
      double way = r / slope;
      if (!is_enclosed && last_way != 0.)
        way = std::copysign(
            std::min(std::abs(way), largest_growth * std::abs(last_way)), way);
      next = x + way;
    }
    else if (!is_enclosed)
    {
      if (forces.way[0] == 0.)
      {
        loose_ = 0;
        return Answer::loose;
      }
      next = x + forces.way[0];
    }
    if (is_enclosed)
    {
      const double a = below_.place[0], b = above_.place[0];
      const double low = std::min(a, b), high = std::max(a, b);
      const bool shrinks =
          width_before == 0. || std::abs(b - a) < 0.5 * std::abs(width_before);
      if (!(next > low && next < high) || slope <= 0. || (is_slow && !shrinks))
      {
        // The chord between both ends, or the middle of where it fails.
        const double ra = below_.forces.rest[0], rb = above_.forces.rest[0];
        const double chord = a + (b - a) * ra / (ra - rb);
        next = is_slow && !shrinks ? 0.5 * (a + b) : chord;
      }
    }
    if (next == x)
      return Answer::stuck;
    place_[0] = next;
    return Answer::move;
  }

  ForceBalance::Answer ForceBalance::begin_probes()
  {
    probes_ = true;
    probed_ = 0;
    stiffness_.assign(n() * n(), 0.);
    place_ = base_.place;
    place_[0] += base_.forces.probe;
    return Answer::move;
  }

  ForceBalance::Answer ForceBalance::take_probe(const Forces &forces)
  {
    for (std::size_t i = 0; i < n(); ++i)
      stiffness_[i * n() + probed_] =
          (base_.forces.contact[i] - forces.contact[i]) / base_.forces.probe;
    place_ = base_.place;
    if (++probed_ < n())
    {
      place_[probed_] += base_.forces.probe;
      return Answer::move;
    }
    probes_ = false;
    is_fresh_ = true;
    return step_from_base();
  }

  void ForceBalance::learn(const std::vector<double> &from,
                           const Forces &before, const std::vector<double> &to,
                           const Forces &now)
  {
    double square = 0.;
    for (std::size_t i = 0; i < n(); ++i)
      square += (to[i] - from[i]) * (to[i] - from[i]);
    if (stiffness_.empty() || square == 0.)
      return;
    std::vector<double> error(n(), 0.);
    for (std::size_t i = 0; i < n(); ++i)
    {
      error[i] = before.contact[i] - now.contact[i];
      for (std::size_t j = 0; j < n(); ++j)
        error[i] -= stiffness_[i * n() + j] * (to[j] - from[j]);
    }
    for (std::size_t i = 0; i < n(); ++i)
      for (std::size_t j = 0; j < n(); ++j)
        stiffness_[i * n() + j] += error[i] * (to[j] - from[j]) / square;
  }

  ForceBalance::Answer ForceBalance::step_from_base()
  {
    const Forces &forces = base_.forces;
    std::vector<bool> held(n());
    std::vector<double> way(n(), 0.);
    for (std::size_t i = 0; i < n(); ++i)
    {
      held[i] = stiffness(i, i) > 0.;
      if (held[i]
          || std::abs(forces.rest[i])
                 <= forces.round_off[i] + tolerance_ * forces.size[i])
        continue;
      way[i] = forces.way[i];
      if (way[i] == 0.)
      {
        loose_ = i;
        return Answer::loose;
      }
    }
    if (!solve(held, forces.rest, way))
      return Answer::loose;
    place_ = base_.place;
    for (std::size_t i = 0; i < n(); ++i)
      place_[i] += way[i];
    return place_ == base_.place ? Answer::stuck : Answer::move;
  }

  ForceBalance::Answer ForceBalance::refuse()
  {
    probes_ = false;
    ++n_places_;
    if (!has_base_ || ++n_halved_ > most_halves || n_places_ >= most_places)
      return Answer::stuck;
    for (std::size_t i = 0; i < n(); ++i)
      place_[i] = 0.5 * (place_[i] + base_.place[i]);
    return Answer::move;
  }

  std::vector<double>
  ForceBalance::way_under(const std::vector<double> &change) const
  {
    std::vector<double> way(change.size(), 0.);
    if (stiffness_.size() != change.size() * change.size())
      return way;
    ForceBalance copy(*this);
    copy.place_ = way;
    copy.inertia_.assign(change.size(), 0.);
    std::vector<bool> held(change.size());
    for (std::size_t i = 0; i < held.size(); ++i)
      held[i] = copy.stiffness(i, i) > 0.;
    if (!copy.solve(held, change, way))
      way.assign(change.size(), 0.);
    return way;
  }

  bool ForceBalance::solve(std::vector<bool> wanted,
                           const std::vector<double> &rest,
                           std::vector<double> &way)
  {
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < n(); ++i)
      if (wanted[i])
        index.push_back(i);
    const std::size_t m = index.size();
    std::vector<double> a(m * m), b(m);
    double largest = 0.;
    for (std::size_t i = 0; i < m; ++i)
    {
      b[i] = rest[index[i]];
      for (std::size_t j = 0; j < m; ++j)
        a[i * m + j] = stiffness(index[i], index[j]);
      largest = std::max(largest, std::abs(a[i * m + i]));
    }
    for (std::size_t k = 0; k < m; ++k)
    {
      std::size_t p = k;
      for (std::size_t i = k + 1; i < m; ++i)
        if (std::abs(a[i * m + k]) > std::abs(a[p * m + k]))
          p = i;
      if (!(std::abs(a[p * m + k]) > small_pivot * largest))
      {
        loose_ = index[k];
        return false;
      }
      for (std::size_t j = 0; j < m; ++j)
        std::swap(a[k * m + j], a[p * m + j]);
      std::swap(b[k], b[p]);
      for (std::size_t i = k + 1; i < m; ++i)
      {
        const double factor = a[i * m + k] / a[k * m + k];
        for (std::size_t j = k; j < m; ++j)
          a[i * m + j] -= factor * a[k * m + j];
        b[i] -= factor * b[k];
      }
    }
    for (std::size_t k = m; k-- > 0;)
    {
      for (std::size_t j = k + 1; j < m; ++j)
        b[k] -= a[k * m + j] * way[index[j]];
      way[index[k]] = b[k] / a[k * m + k];
    }
    return true;
  }
} // namespace abut::app

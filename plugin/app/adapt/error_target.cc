// SPDX-License-Identifier: LGPL-2.1-or-later
#include "error_target.h"

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    // Errors may be up to five times smaller than the target before work is
    // wasted; this leaves room for what two meshes do not see.
    constexpr double margin = 1.3;
    constexpr double force_margin = 2.;

    // Parts of the target that contact law and linear solver may take.
    constexpr double law_share = 0.3;
    constexpr double solver_share = 0.1;

    // Residual estimates of all elements and equations in use are above the
    // error by less than this; what two meshes say beyond it is chance.
    constexpr double largest_effectivity = 20.;

    // Two meshes that hardly differ measure nothing but round-off.
    constexpr double smallest_fall = 0.05;

    double square(const double x)
    {
      return x * x;
    }
  } // namespace

  double ErrorParts::total() const
  {
    return std::hypot(discretisation, contact) + algebraic;
  }

  ErrorTarget::ErrorTarget(const double target, const TargetQuantity quantity)
      : target_(target), quantity_(quantity)
  {
  }

  double ErrorTarget::measured_calibration() const
  {
    const std::size_t n = meshes_.size();
    if (n < 2)
      return -1.;
    const MeshEvidence &now = meshes_[n - 1], &before = meshes_[n - 2];
    const double fall = square(before.residual) - square(now.residual);
    if (now.change < 0. || fall < smallest_fall * square(before.residual))
      return -1.;
    return now.change / std::sqrt(fall);
  }

  double ErrorTarget::force_error() const
  {
    const std::size_t n = meshes_.size();
    double error = 0.;
    // The change before counts as well, for forces can agree by chance.
    for (std::size_t i = n < 3 ? 1 : n - 2; i < n; ++i)
    {
      const MeshEvidence &now = meshes_[i], &before = meshes_[i - 1];
      const double fall = std::min(
          square(now.residual) / square(before.residual), 1. - smallest_fall);
      const double here = std::abs(now.contact_force - before.contact_force)
                          * fall / (1. - fall);
      const double since = square(meshes_.back().residual / now.residual);
      error = std::max(error, here * since);
    }
    const double force = std::abs(meshes_.back().contact_force);
    return n < 2 || force == 0. ? 1. : force_margin * error / force;
  }

  void ErrorTarget::add(const MeshEvidence &evidence, const bool same_mesh)
  {
    if (same_mesh && !meshes_.empty())
    {
      const double change = meshes_.back().change;
      meshes_.back() = evidence;
      meshes_.back().change = change;
      measured_.pop_back();
    }
    else
      meshes_.push_back(evidence);
    measured_.push_back(measured_calibration());

    double calibration = -1.;
    for (std::size_t i = measured_.size();
         i-- > 0 && i + 2 >= measured_.size();)
      calibration = std::max(calibration, measured_[i]);
    if (calibration >= 0.)
      calibration_ = std::min(
          1., std::max(1. / largest_effectivity, margin * calibration));

    const MeshEvidence &now = meshes_.back();
    errors_ = ErrorParts();
    if (now.norm == 0.)
      return;
    const double law = now.law / now.norm;
    errors_.algebraic = now.final_tolerance
                        + now.last_tolerance * now.last_increment / now.norm;
    if (quantity_ == TargetQuantity::energy_norm)
    {
      errors_.discretisation = calibration_ * now.residual / now.norm;
      errors_.contact = law;
    }
    else
    {
      errors_.discretisation = force_error();
      errors_.contact = square(law);
    }
  }

  bool ErrorTarget::is_sure() const
  {
    const std::size_t n = measured_.size();
    return calibration_ == 1.
           || (n >= 2 && measured_[n - 1] >= 0. && measured_[n - 2] >= 0.);
  }

  ErrorTarget::Step ErrorTarget::next() const
  {
    if (errors_.total() <= target_)
      return is_sure() ? Step::stop : Step::refine;
    if (errors_.algebraic > solver_share * target_
        && errors_.algebraic > 0.5 * errors_.discretisation)
      return Step::tighten_solver;
    if (errors_.contact > law_share * target_
        && errors_.contact > errors_.discretisation)
      return Step::tighten_law;
    if (errors_.discretisation > 0.5 * target_)
      return Step::refine;
    return errors_.contact > law_share * target_ ? Step::tighten_law
                                                 : Step::tighten_solver;
  }

  double ErrorTarget::refine_fraction(const double smallest,
                                      const double largest) const
  {
    double wanted = target_ / std::max(errors_.discretisation, target_);
    if (quantity_ == TargetQuantity::energy_norm)
      wanted = square(wanted);
    return std::min(std::max(4. / 3. * (1. - 0.8 * wanted), smallest), largest);
  }

  double ErrorTarget::law_factor() const
  {
    const double excess = errors_.contact / (0.5 * law_share * target_);
    return std::min(100., std::max(2., quantity_ == TargetQuantity::energy_norm
                                           ? excess
                                           : std::sqrt(excess)));
  }

  double ErrorTarget::solver_factor() const
  {
    const double wanted = 0.5 * solver_share * target_;
    return std::max(2., errors_.algebraic / wanted);
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "target_control.h"

#include "app/input/short_number.h"
#include "tighten_method.h"

#include <algorithm>

namespace abut::app
{
  namespace
  {
    // A mesh with less than this refined is not worth its set-up.
    constexpr double smallest_fraction = 0.15;
  } // namespace

  TargetControl::TargetControl(const RefinementParameters &parameters,
                               const MethodParameters &method)
      : parameters_(parameters), method_(method)
  {
    if (!parameters.has_target())
      return;
    method_ = parameters.for_target(method);
    target_ = std::make_unique<ErrorTarget>(parameters.target_error,
                                            parameters.target_quantity);
  }

  void TargetControl::begin_mesh(const la::Vector &start)
  {
    start_ = start;
    same_mesh_ = false;
  }

  void TargetControl::note_step(const double increment, const double tolerance)
  {
    steps_.last_increment = increment;
    steps_.last_tolerance = tolerance;
  }

  ErrorParts TargetControl::judge(MeshEvidence evidence)
  {
    evidence.last_increment = steps_.last_increment;
    evidence.last_tolerance = steps_.last_tolerance;
    evidence.final_tolerance = method_.options.final_linear_tolerance;
    target_->add(evidence, same_mesh_);
    n_meshes_ += !same_mesh_;
    return target_->errors();
  }

  ErrorTarget::Step TargetControl::next(const double present_penalty)
  {
    const ErrorTarget::Step step = target_->next();
    same_mesh_ = step == ErrorTarget::Step::tighten_law
                 || step == ErrorTarget::Step::tighten_solver;
    n_tightened_ += same_mesh_;
    if (step == ErrorTarget::Step::tighten_solver)
      tighten_solver(method_, target_->solver_factor());
    else if (step == ErrorTarget::Step::tighten_law
             && !tighten_law(method_, target_->law_factor(), present_penalty))
    {
      // Penalties are at their cap, but fall with the mesh.
      same_mesh_ = false;
      return ErrorTarget::Step::refine;
    }
    return step;
  }

  bool TargetControl::is_met() const
  {
    return target_->errors().total() <= parameters_.target_error;
  }

  double TargetControl::refine_fraction() const
  {
    return target_->refine_fraction(
        std::min(smallest_fraction, parameters_.refine_fraction),
        parameters_.refine_fraction);
  }

  std::string TargetControl::progress() const
  {
    if (!is_on())
      return "";
    return ", error about " + short_number(target_->errors().total(), 2)
           + " of " + short_number(parameters_.target_error, 2) + " asked for";
  }

  std::string TargetControl::failure() const
  {
    return "The target error " + short_number(parameters_.target_error, 3)
           + " is not met after " + std::to_string(n_meshes_)
           + " meshes: the estimate is "
           + short_number(target_->errors().total(), 3)
           + ". Allow more meshes (Refinement/Maximum meshes), or a larger "
             "Refinement/Target error.";
  }

  void TargetControl::report(Report &report,
                             const std::optional<double> exact_error) const
  {
    const ErrorParts &errors = target_->errors();
    report.set("target_error", parameters_.target_error);
    report.set("estimated_error", errors.total());
    report.set("estimated_discretisation_error", errors.discretisation);
    report.set("estimated_contact_error", errors.contact);
    report.set("estimated_algebraic_error", errors.algebraic);
    report.set("estimate_calibration", target_->calibration());
    report.set("meshes", n_meshes_);
    if (exact_error)
    {
      report.set("relative_error", *exact_error);
      report.set("target_effectivity", errors.total() / *exact_error);
    }
    report.model("target error", true,
                 short_number(parameters_.target_error, 3)
                     + " required; estimated: mesh "
                     + short_number(errors.discretisation, 2) + ", contact law "
                     + short_number(errors.contact, 2) + ", linear systems "
                     + short_number(errors.algebraic, 2) + "; "
                     + std::to_string(n_meshes_) + " meshes, "
                     + (n_tightened_ == 0
                            ? std::string("law and tolerances unchanged")
                            : std::to_string(n_tightened_)
                                  + " solves with tightened law or "
                                    "tolerances"));
  }
} // namespace abut::app

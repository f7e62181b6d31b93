// SPDX-License-Identifier: LGPL-2.1-or-later
#include "left_out.h"

#include "app/input/short_number.h"

namespace abut::app
{
  namespace
  {
    // A part of the error below this part of the target shows nowhere.
    constexpr double law_excess = 0.01;
    constexpr double solver_excess = 1e-4;
    // An error this far below the target is a mesh too many.
    constexpr double mesh_excess = 0.2;
    // Steps for each mesh that an active set from a coarser mesh needs, which
    // doc/methods.md has measured.
    constexpr double usual_steps = 4.;
    // Less than this part of the time is not worth a word.
    constexpr double small_share = 0.1;

    void explain_law(Report &report, const double target,
                     const double law_error, const MethodParameters &method)
    {
      const abut_strategy_options &o = method.options;
      const bool exact = abut_law_is_exact(o.law);
      if (exact || law_error > law_excess * target)
        return;
      const std::string name =
          abut_law_needs_open_start(o.law) ? "a larger Method/Barrier end"
          : abut_law_solves_once(o.law)    ? "a smaller Method/Penalty factor"
                                           : "a larger Method/Gap tolerance";
      report.leave_out("accuracy of the contact law: its error is about "
                       + short_number(law_error, 2) + " where "
                       + short_number(target, 2) + " is required; " + name
                       + " suffices.");
    }
  } // namespace

  void explain_accuracy(Report &report, const RefinementParameters &refinement,
                        const TargetControl &control)
  {
    if (!control.is_on())
    {
      report.leave_out("accuracy: without Refinement/Target error the "
                       "tolerances are tight. With it meshes, contact law and "
                       "tolerances are only as fine as needed.");
      return;
    }
    const double target = refinement.target_error;
    const ErrorParts &errors = control.errors();
    if (errors.total() < mesh_excess * target)
      report.leave_out(
          "the finest mesh: the error is about "
          + short_number(errors.total(), 2) + " where "
          + short_number(target, 2)
          + " is required; start with a smaller Refinement/Coarsest level.");
    explain_law(report, target, errors.contact, control.method());
    if (errors.algebraic < solver_excess * target)
      report.leave_out(
          "accuracy of the linear systems: their error is "
          + short_number(errors.algebraic, 2) + " where "
          + short_number(target, 2)
          + " is required; a larger Method/Final linear tolerance suffices.");
  }

  void explain_steps(Report &report, const RefinementParameters &refinement,
                     const MethodParameters &method, const unsigned int n_steps,
                     const unsigned int n_meshes)
  {
    const double usual = usual_steps * n_meshes;
    const bool simplest = abut_law_solves_once(method.options.law);
    if (n_steps <= 2. * usual)
      return;
    const std::string count = std::to_string(n_steps) + " linear systems on "
                              + std::to_string(n_meshes) + " meshes; ";
    if (!refinement.nested)
      report.leave_out(
          "steps from a far start: " + count
          + "Refinement/Nested iteration = true starts near the solution.");
    else if (!simplest)
      report.leave_out("outer steps: " + count + "Method/Enforcement = auto "
                       + "needs about "
                       + std::to_string(static_cast<int>(usual)) + ".");
  }

  void explain_output(Report &report)
  {
    const double wall = report.elapsed();
    const double output = report.times.seconds("output") / wall;
    const double results = report.times.seconds("results") / wall;
    if (output > small_share)
      report.leave_out("files: " + percent(output, 2)
                       + " of the time; Output/Fields = false and "
                         "Output/Pictures = false.");
    if (results > small_share)
      report.leave_out("error norms: " + percent(results, 2)
                       + " of the time goes into results; leave out the "
                         "section Exact solution.");
  }
} // namespace abut::app

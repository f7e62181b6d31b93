// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_TARGET_CONTROL_H
#define ABUT_APP_TARGET_CONTROL_H

#include "app/report/report.h"
#include "error_target.h"
#include "refinement_parameters.h"

#include <abut/dealii/linear_algebra.h>

#include <memory>
#include <optional>
#include <string>

namespace abut::app
{
  /** What a run to a target error keeps between its solves: the start that a
   * mesh was given, and the method as the target has changed it. Without a
   * target it only hands out the method. */
  class TargetControl
  {
  public:
    TargetControl(const RefinementParameters &parameters,
                  const MethodParameters &method);

    /** Whether there is a target. */
    bool is_on() const
    {
      return target_ != nullptr;
    }

    /** Replace the law, before the first mesh. */
    void set_law(const abut_law *law)
    {
      method_.options.law = law;
    }

    /** The method to solve with. */
    const MethodParameters &method() const
    {
      return method_;
    }

    /** A new mesh: @p start is the last mesh's solution on it. */
    void begin_mesh(const la::Vector &start);

    /** Solution that the mesh began with; empty on the first one. */
    const la::Vector &start() const
    {
      return start_;
    }

    /** A linear system was solved whose increment has this energy norm. */
    void note_step(double increment, double tolerance);

    /** Take the results of a solve; @p evidence without what is noted here. */
    ErrorParts judge(MeshEvidence evidence);

    /** What follows, with the method already tightened if that is it. */
    ErrorTarget::Step next(double present_penalty);

    /** What is estimated for the last mesh; with a target only. */
    const ErrorParts &errors() const
    {
      return target_->errors();
    }

    /** Whether the last mesh meets the target. */
    bool is_met() const;

    /** Part of the squared estimate to refine. */
    double refine_fraction() const;

    /** End of a line of progress; empty without a target. */
    std::string progress() const;

    /** Why a run ends that may not make another mesh. */
    std::string failure() const;

    /** Results into the summary, with the effectivity (estimate by error)
     * where @p exact_error, relative, is known. */
    void report(Report &report, std::optional<double> exact_error) const;

    /** What a checkpoint keeps, but for start(). */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      abut_strategy_options &o = method_.options;
      archive &o.gap_tolerance &o.pressure_tolerance &o.barrier_end;
      archive &o.penalty &o.final_linear_tolerance;
      archive &steps_ &same_mesh_ &n_meshes_ &n_tightened_;
      if (target_)
        archive &*target_;
    }

    /** Bring start() back. */
    void restore_start(const la::Vector &start)
    {
      start_ = start;
    }

  private:
    const RefinementParameters &parameters_;
    MethodParameters method_;
    std::unique_ptr<ErrorTarget> target_;
    la::Vector start_;
    MeshEvidence steps_; ///< increment and tolerance of the last system
    bool same_mesh_ = false;
    unsigned int n_meshes_ = 0, n_tightened_ = 0;
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_OBSTACLE_POSES_H
#define ABUT_SHIM_OBSTACLE_POSES_H

#include "surface_pair.h"

#include <abut/dealii/rigid_obstacle.h>

namespace abut::shim
{
  /** Positions of the obstacles of pairs: now, at the last commit(), and those
   * that slips are measured from; all by pair. */
  template <int dim> class ObstaclePoses
  {
  public:
    using Poses = std::vector<RigidPose<dim>>;

    /** @p pairs must outlive this object. */
    explicit ObstaclePoses(const std::vector<SurfacePair<dim>> &pairs)
        : pairs_(pairs)
    {
    }

    /** Positions of the obstacles at the last commit(), and their times; empty:
     * at the first step. */
    void set_committed(const Poses &poses, const std::vector<double> &times)
    {
      committed_ = poses;
      times_ = times;
    }

    /** Positions that obstacles slide to from the committed ones; empty: none
     * does. */
    void set_slide(const Poses &poses)
    {
      slide_ = poses;
    }

    const Poses &slide() const
    {
      return slide_;
    }

    const Poses &committed() const
    {
      return committed_;
    }

    const std::vector<double> &committed_times() const
    {
      return times_;
    }

    Poses now() const;

    /** Positions at the last commit(), of pairs whose points are made at each
     * step or if @p of_step is true; else before the first step. */
    Poses before(bool of_step) const;

    /** Measure PairResult::slip from there. */
    void start_slips()
    {
      slip_start_ = before(false);
    }

    const Poses &slip_start() const
    {
      return slip_start_;
    }

    /** Position before the present step of the point of an obstacle that is now
     * at @p place. */
    dealii::Point<dim> place_before(std::size_t pair,
                                    const dealii::Point<dim> &place) const;

    /** Displacement of the point of a rigid body that is at @p place now. */
    static dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &place,
                                               const RigidPose<dim> &then,
                                               const RigidPose<dim> &now);

    /** Throws for obstacles with friction that rotate in this step by so much
     * that the chord is too short. */
    void refuse_large_rotations() const;

  private:
    const std::vector<SurfacePair<dim>> &pairs_;
    Poses committed_;           ///< or empty
    std::vector<double> times_; ///< or empty
    Poses slip_start_;
    Poses slide_; ///< or empty
  };
} // namespace abut::shim

#endif

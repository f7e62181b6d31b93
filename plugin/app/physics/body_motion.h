// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BODY_MOTION_H
#define ABUT_APP_BODY_MOTION_H

/** @file
 * M a + C v + K u = f + contact of elastic bodies, step by step.
 */

#include "elasticity.h"
#include "mass.h"

#include <deal.II/base/tensor.h>

#include <abut/time.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace abut::app
{
  /** Axes that bodies can turn about. */
  template <int dim> constexpr unsigned int n_rotations = dim == 2 ? 1 : 3;

  /** What stands in the balance of a motion at a time. */
  template <int dim> struct MotionRecord
  {
    double time = 0.;
    abut_time_energy energy = {};
    double contact_force = 0.; ///< sum over all pairs
    dealii::Tensor<1, dim> momentum;
    /** About the origin, of the undeformed places, at which small strain has
     * its forces act; in 2D one component. */
    std::array<double, n_rotations<dim>> angular_momentum = {};

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &time &contact_force;
      archive &energy.kinetic &energy.strain &energy.contact;
      archive &energy.dissipated &energy.external_work;
      for (unsigned int d = 0; d < dim; ++d)
        archive &momentum[d];
      for (double &each : angular_momentum)
        archive &each;
    }
  };

  /** The motion of bodies of linear materials by a scheme of the core. Time is
   * where the last committed step has led to; a step in work leaves that alone,
   * so that it may be given up.
   *
   * A step is one contact problem, or first another one: the projection of
   * where the bodies would go. Explicit schemes have no more than that one.
   *
   * Vectors are over all unknowns; prescribed ones move as supports say, and
   * the scheme makes velocities and accelerations of that. */
  template <int dim> class BodyMotion
  {
  public:
    struct Settings
    {
      abut_time_scheme scheme = {};
      double mass_damping = 0., stiffness_damping = 0.; ///< of Rayleigh
    };

    /** @p elasticity must outlive it. */
    BodyMotion(Elasticity<dim> &elasticity, const Settings &settings);

    /** Mass and unknowns of the present mesh. Collective. */
    void setup(const MassData &data);

    /** Begin at rest or with this velocity, with supports and loads of that
     * time put into the elasticity. The acceleration is that of M a = f - C v -
     * K u at unknowns with mass; contact that presses then begins to act in
     * the first step. Collective. */
    void start(const la::Vector &displacement, const la::Vector &velocity);

    /** Go on from fields() and from this displacement; as start().
     * Collective. */
    void resume(const la::Vector &displacement, std::vector<la::Vector> fields);

    /** What a checkpoint keeps beside the displacement. */
    std::vector<la::Vector> fields() const
    {
      return {velocity_, acceleration_, reaction_};
    }
    static constexpr unsigned int n_fields = 3;

    /** Begin a step of length @p dt; supports and loads of its end have been
     * put into the elasticity. @p u becomes a start of the iteration, where the
     * velocity leads to. Returns whether the tangent is another one than
     * before. Collective. */
    bool begin_step(double dt, la::Vector &u);

    /** The tangent of the problem in work. */
    const la::Matrix &tangent() const
    {
      return stage_ == ABUT_TIME_STEP ? tangent_ : projection_;
    }

    /** Its residual at the displacement @p u of the end, contact left out, 0 at
     * constrained unknowns. Collective. */
    void residual(const la::Vector &u, la::Vector &result) const;

    /** The problem in work has led to @p u. Returns whether another one
     * follows, that of the step after its projection; @p u is its start.
     * Collective. */
    bool next_problem(const la::Vector &u);

    /** Step from which an explicit scheme may blow up; infinite for others.
     * Where contact acts by a projection it changes nothing of that.
     * Collective. */
    double stable_step() const;

    /** The step has led to @p u. @p on_supports: what contact does at
     * prescribed unknowns. Collective. */
    void end_step(const la::Vector &u, const la::Vector &on_supports);

    /** What contact and supports do in the step that has ended, at all
     * unknowns but hanging ones. */
    const la::Vector &unbalanced_forces() const
    {
      return unbalanced_;
    }

    /** The step that has ended is accepted. */
    void commit();

    /** Of the step that has ended or of the start, without contact and time.
     */
    const MotionRecord<dim> &record() const
    {
      return record_;
    }

    /** At the last commit, or at the start. */
    const la::Vector &displacement() const
    {
      return displacement_;
    }

    /** At the end of that step. */
    const la::Vector &velocity() const
    {
      return next_velocity_;
    }

    /** Forces that cancel in a step, as a norm over all unknowns: what would
     * stop the motion of the last commit in it, and stiffness times way of
     * each node by itself, of which a body in flight feels nothing. */
    double cancelling_forces() const;

    /** By component. */
    dealii::Tensor<1, dim> total_mass() const;

    /** What a checkpoint keeps beside fields. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &dissipated_ &work_;
    }

  private:
    abut_time_state state(la::Vector &u, la::Vector &v, la::Vector &a) const;
    /** Residuals at all unknowns but hanging ones: of the projection, of the
     * step (@p unknown: see abut_time_evaluate()), of the problem in work. */
    la::Vector projection_residual(const la::Vector &u) const;
    la::Vector step_residual(const la::Vector &unknown) const;
    la::Vector full_residual(const la::Vector &u) const;
    la::Vector without_prescribed(const la::Vector &values) const;
    bool is_explicit() const
    {
      return settings_.scheme.beta == 0.;
    }
    /** Make the tangents of steps of the present length. */
    void make_tangents();
    /** Residuals of the problem in work are measured from @p u. */
    void begin_problem(const la::Vector &u);
    /** The matrix of a stage, with K and M of unknowns that are free. */
    void make_tangent(abut_time_stage stage, la::Matrix &matrix) const;
    /** Acceleration that forces at the end of an explicit step make. */
    la::Vector explicit_acceleration() const;
    void set_forces_before();
    void find_acceleration();
    void mark_massless();
    void find_rigid_motions();
    MotionRecord<dim> measure(const la::Vector &u, const la::Vector &v) const;
    double damping_energy(const la::Vector &way) const;

    Elasticity<dim> &elasticity_;
    const Settings settings_;
    std::unique_ptr<const la::Matrix> mass_, free_mass_;
    la::Matrix tangent_, projection_;
    abut_time_stage stage_ = ABUT_TIME_STEP; ///< of the problem in work
    /** M times a unit motion along, and about, each axis. */
    std::vector<la::Vector> mass_of_component_, mass_of_rotation_;
    std::vector<std::uint8_t> massless_;
    double dt_ = 0.; ///< of the tangent; 0: none

    // At the last commit.
    la::Vector displacement_, velocity_, acceleration_, reaction_, load_;
    double dissipated_ = 0., work_ = 0.;

    // Of the step in work; its velocity is that of the commit until there is a
    // projection.
    la::Vector base_, base_residual_;
    la::Vector predicted_, step_velocity_, projection_force_;
    // At its end.
    la::Vector next_displacement_, next_velocity_, next_acceleration_;
    la::Vector next_reaction_, unbalanced_;
    MotionRecord<dim> record_;
  };
} // namespace abut::app

#endif

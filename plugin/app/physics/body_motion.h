// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BODY_MOTION_H
#define ABUT_APP_BODY_MOTION_H

/** @file
 * M a + C v + K u = f + contact of elastic bodies and membranes, step by step.
 */

#include "mass.h"

#include <abut/time.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace abut::app
{
  /** What stands in the balance of a motion at a time. */
  struct BodyMotionRecord
  {
    double time = 0.;
    abut_time_energy energy = {};
    double contact_force = 0.;    ///< sum over all pairs
    std::vector<double> momentum; ///< by component
    /** About the origin: of large strain of present places, else of the
     * undeformed ones, at which small strain has its forces act. In 2D one
     * component, of membranes none. */
    std::vector<double> angular_momentum;
    /** What an explicit scheme does not keep of these energies: central
     * differences keep 1/2 v.Mv - dt^2/8 a.Ma + the energy of all forces, the
     * kinetic energy of the steps' middles less that of half a step. 0 for
     * others. */
    double not_kept = 0.;

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &time &contact_force;
      archive &energy.kinetic &energy.strain &energy.contact;
      archive &energy.dissipated &energy.external_work;
      archive &momentum &angular_momentum &not_kept;
    }
  };

  /** Part of what moving supports, obstacles and friction do in a step that is
   * by the forces at its end; the rest is by those before. */
  double part_of_end(const abut_time_scheme &scheme);

  /** The motion of a problem by a scheme of the core: bodies, of whose
   * displacement it has all components, or a membrane. Forces that are not
   * linear are those of the displacement that the scheme weighs them at,
   * F(u(alpha_f)). Time is where the last
   * committed step has led to; a step in work leaves that alone, so that it may
   * be given up.
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

    /** @p problem must outlive it. */
    BodyMotion(DiscreteProblem<dim> &problem, const Settings &settings);

    /** Mass and unknowns of the present mesh. Collective. */
    void setup(const MassData<dim> &data);

    /** Put the values of @p from at prescribed unknowns into @p values. */
    void take_prescribed(const la::Vector &from, la::Vector &values) const;

    /** Begin at rest or with this velocity, with supports and loads of that
     * time put into the problem. The acceleration is that of M a = f - C v -
     * K u at unknowns with mass, without contact. Collective. */
    void start(const la::Vector &displacement, const la::Vector &velocity);

    /** BodyMotionRecord::not_kept of the start, with steps of length @p dt.
     * Collective. */
    double energy_not_kept(double dt) const
    {
      return energy_not_kept(dt, acceleration_);
    }

    /** Begin the problem of contact at the start, whose answer is u + dt^2 a
     * with the displacement @p u and the acceleration there: what touches and
     * is pressed has none into the other side. Where nothing that touches has
     * mass, it is that of a step without velocities: forces of contact act on
     * masses by the stiffness. Returns whether there is one: where the scheme
     * never looks at an acceleration, or has none of contact, or where nothing
     * that touches has mass or friction (@p has_friction), it is not needed.
     * Collective. */
    bool begin_start(double dt, bool has_friction, la::Vector &u);

    /** The answer @p u has these forces of contact, at prescribed unknowns @p
     * on_supports: the acceleration becomes that of M a = f - C v - K u +
     * contact. Collective. */
    void end_start(const la::Vector &u, const la::Vector &contact,
                   const la::Vector &on_supports);

    /** Go on from fields() and from this displacement; as start().
     * Collective. */
    void resume(const la::Vector &displacement, std::vector<la::Vector> fields);

    /** What a checkpoint keeps beside the displacement. */
    std::vector<la::Vector> fields() const
    {
      return {velocity_, acceleration_, held_};
    }
    static constexpr unsigned int n_fields = 3;

    /** Begin a step of length @p dt; supports and loads of its end have been
     * put into the problem. @p u becomes a start of the iteration, where the
     * velocity leads to, of problems that are not linear with the prescribed
     * values of before. Returns whether the tangent is another one than
     * before. Collective. */
    bool begin_step(double dt, la::Vector &u);

    /** The tangent of the problem in work at @p u, as it is until the next
     * call. Collective. */
    const la::Matrix &tangent(const la::Vector &u);

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
    const BodyMotionRecord &record() const
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

    /** What contact does at unknowns that are free in that step, and supports
     * do at the others, 0 at hanging ones; and in the one before. */
    const la::Vector &holding_forces() const
    {
      return next_held_;
    }
    const la::Vector &holding_forces_before() const
    {
      return held_;
    }

    /** Forces that cancel in a step, as a norm over all unknowns: what would
     * stop the motion of the last commit in it, and stiffness times way of
     * each node by itself, of which a body in flight feels nothing. */
    double cancelling_forces() const;

    /** By component. */
    std::vector<double> total_mass() const;

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
    /** From where the step would go to @p u; 0 where values are prescribed, if
     * the scheme has another problem that brings them about. */
    la::Vector way_of_projection(const la::Vector &u) const;
    la::Vector step_residual(const la::Vector &unknown) const;
    la::Vector full_residual(const la::Vector &u) const;
    /** Where internal forces of the step are those of. */
    la::Vector elastic_place(const la::Vector &u) const;
    la::Vector without_prescribed(const la::Vector &values) const;
    bool is_explicit() const
    {
      return settings_.scheme.beta == 0.;
    }
    /** Whether the tangent of the step is the same for all displacements. */
    bool has_constant_tangent() const
    {
      return problem_.is_linear();
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
    /** What resists at the start at the displacement @p u, without inertia and
     * contact. */
    la::Vector resistance(const la::Vector &u) const;
    void find_acceleration(const la::Vector &u, const la::Vector &contact);
    /** A multiple of M as a tangent. */
    void scale_mass(double factor, la::Matrix &matrix) const;
    void mark_massless();
    /** Whether the problem is that of bodies: a membrane moves across its
     * plane, and does not turn in it. */
    bool has_rotations() const
    {
      return problem_.n_components() == dim;
    }
    void find_rigid_motions();
    /** Unit rotations about each axis, of places that a displacement (with
     * ghosts; null: none) leads to. */
    std::vector<la::Vector> turns_at(const la::Vector *displacement) const;
    void measure_works();
    BodyMotionRecord measure(const la::Vector &u, const la::Vector &v) const;
    double damping_energy(const la::Vector &way) const;
    double energy_not_kept(double dt, const la::Vector &acceleration) const;

    DiscreteProblem<dim> &problem_;
    const Settings settings_;
    std::unique_ptr<const la::Matrix> mass_, free_mass_;
    la::Matrix tangent_, projection_;
    abut_time_stage stage_ = ABUT_TIME_STEP; ///< of the problem in work
    /** M times a unit motion along each axis, and of small strain about it. */
    std::vector<la::Vector> mass_of_component_, mass_of_rotation_;
    std::vector<std::uint8_t> massless_;
    bool touches_with_mass_ = false;
    double dt_ = 0.; ///< of the tangent; 0: none

    // At the last commit.
    la::Vector displacement_, velocity_, acceleration_, held_, load_;
    double dissipated_ = 0., work_ = 0.;

    // Of the step in work; its velocity is that of the commit until there is a
    // projection.
    la::Vector base_, base_residual_;
    la::Vector predicted_, step_velocity_, projection_force_;
    // At its end.
    la::Vector next_displacement_, next_velocity_, next_acceleration_;
    la::Vector next_held_, unbalanced_;
    BodyMotionRecord record_;
  };
} // namespace abut::app

#endif

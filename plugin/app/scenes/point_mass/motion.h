// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MOTION_H
#define ABUT_APP_MOTION_H

#include "mass_row.h"
#include "shim/handles.h"

#include <abut/dealii/coded.h>
#include <abut/dense_model.h>

#include <string>
#include <vector>

namespace abut::app
{
  /** The plane that masses meet. */
  struct Plane
  {
    double gap = 0;         /**< height of the masses over it at rest */
    double friction = 0;    /**< coefficient of Coulomb's law */
    double restitution = 0; /**< of schemes with impulses */
    double penalty = 0;     /**< force per length, of schemes with springs */
  };

  /** Masses on their way in time, by a scheme of the core. Contact in each step
   * is a dense problem that the core solves exactly. */
  class Motion
  {
  public:
    Motion(const MassSystem &system, const Plane &plane,
           const abut_time_scheme &scheme);

    /** Begin, with the loads there: velocities and displacements [size].
     * Returns why that cannot be; else empty. */
    Message start(const std::vector<double> &displacement,
                  const std::vector<double> &velocity,
                  const std::vector<double> &load);

    /** A step of length @p dt with the loads at its ends [size]. Returns why
     * there is none; empty if it was done. */
    Message step(double dt, const std::vector<double> &load_before,
                 const std::vector<double> &load);

    double kinetic() const;
    double strain() const;
    double contact() const; /**< in penalty springs */
    double depth() const;   /**< largest penetration of springs */
    double momentum(unsigned int direction) const;

    /** Sum of contact and friction on the masses in the last step. */
    double force_in(unsigned int direction) const;

    /** Kinetic energy that the largest mass would have from the forces of the
     * last step, of length @p dt, if nothing balanced them. */
    double energy_of_forces(double dt) const;

    /** Step from which an explicit scheme may blow up, 2 / omega of the
     * stiffness with closed contact; infinite for implicit ones. */
    double stable_step() const;

    /** Period of the slowest oscillation without contact; infinite where a
     * motion meets no stiffness. */
    double slowest_period();

    std::vector<double> u, v, a; /**< [size] */
    std::vector<double> force;   /**< [size] mean of contact and friction on the
                                      masses in the last step */
    std::vector<double> impulse; /**< [dimension] of them, all steps */
    double dissipated = 0;       /**< by friction between impacts */
    double lost_in_impacts = 0;  /**< energy, of schemes with impulses */
    double external_work = 0;
    /** Impacts; of schemes without impulses ends of steps in which a force
     * begins. */
    std::vector<double> touch_times;
    double time = 0;

  private:
    /** A mass that may touch, in a problem for increments y: height y_n + gap
     * >= 0, and slips y_t + slip[t]. */
    struct Row
    {
      std::size_t mass;
      double gap;
      double slip[2];
    };
    using Rows = std::vector<Row>;

    std::size_t height(const std::size_t mass) const
    {
      return mass * dimension + dimension - 1;
    }
    double gap_of(const std::vector<double> &at, std::size_t mass) const;
    std::vector<double> product(const std::vector<double> &matrix,
                                const std::vector<double> &x) const;
    abut_time_state state(double dt);
    Rows rows_at(const std::vector<double> &at) const;
    void append_point(abut_points *points, const Row &row,
                      bool has_friction) const;
    Message solve(const std::vector<double> &matrix,
                  const std::vector<double> &residual, const Rows &rows,
                  std::vector<double> &y, std::vector<double> &pressure);
    Message solve_step(double dt, const std::vector<double> &before,
                       const std::vector<double> &after);
    /** Throw std::range_error if the core could not do it: its arguments are
     * numbers of the data. */
    void require(abut_status status) const;
    /** Why masses and springs have no answer, after a call of the core failed.
     */
    Message why_unsolved(abut_status status = ABUT_INVALID_ARGUMENT) const;
    Message solve_model(const abut_dense_model &model,
                        const abut_strategy_options &options,
                        std::vector<double> &y, std::vector<double> &forces);
    abut_strategy_options contact_options(const std::vector<double> &matrix,
                                          const std::vector<double> &residual,
                                          const Rows &rows) const;
    std::vector<double> step_matrix(double dt, abut_time_stage stage) const;
    std::vector<double> residual_at(double dt, const std::vector<double> &x,
                                    const std::vector<double> &before,
                                    const std::vector<double> &after);
    void add_force(const std::vector<double> &forces, double part);
    Message begin_acceleration(const std::vector<double> &load);
    Message project(double dt, std::vector<double> &predicted);
    Message implicit_step(double dt, std::vector<double> &x,
                          const std::vector<double> &before,
                          const std::vector<double> &after);
    Message step_on_springs(double dt, std::vector<double> &x,
                            const std::vector<double> &before,
                            const std::vector<double> &after);
    Message explicit_step(double dt, const std::vector<double> &place,
                          const std::vector<double> &before,
                          const std::vector<double> &after);
    /** Whether a force on a mass begins in the step from displacements @p old
     * and forces @p old_force; what lies on the plane at the start touches
     * already. */
    bool begins_to_touch(const std::vector<double> &old,
                         const std::vector<double> &old_force) const;
    void finish(double dt, const std::vector<double> &old,
                const std::vector<double> &old_force,
                const std::vector<double> &before,
                const std::vector<double> &after);

    // Schemes with impulses, motion_impulses.cc.
    Message impulse_step(double dt, const std::vector<double> &load);
    Message impact(double dt);
    Message glide(double length, const std::vector<double> &load,
                  std::vector<double> &end, std::vector<double> &forces);
    Message glide_to_touch(double &length, const std::vector<double> &load,
                           std::vector<double> &end,
                           std::vector<double> &forces);
    void end_part(double length, double dt, const std::vector<double> &end,
                  const std::vector<double> &forces);
    double least_gap(double length, const std::vector<double> &end) const;
    bool is_closed(std::size_t mass) const;
    bool comes_in(std::size_t mass) const;
    Rows closed_rows(double length) const;

    const MassSystem system;
    const Plane plane;
    const abut_time_scheme scheme;
    const unsigned int dimension;
    shim::Handle<abut_context> context;
    double length_scale = 0, speed_scale = 0;
  };
} // namespace abut::app

#endif

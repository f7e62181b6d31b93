// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_DRIVEN_OBSTACLES_H
#define ABUT_APP_DRIVEN_OBSTACLES_H

#include "app/input/expression.h"
#include "app/physics/force_balance.h"
#include "solid_parameters.h"

#include <abut/dealii/contact_pair.h>
#include <abut/time.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace abut::app
{
  /** Rigid obstacles that forces move: in free directions they go where force,
   * weight, contact and inertia are in balance, at the end of each load step or
   * in each problem of a time step. That place is found outside of the contact
   * problem, which knows obstacles that are where they are: each place that is
   * tried is a whole contact problem, so that the answer is that of an obstacle
   * moved there, for every law and every kind of surface. Time is that of the
   * bodies' scheme: no force is that of another time. */
  template <int dim> class DrivenObstacles
  {
  public:
    using Vector = dealii::Tensor<1, dim>;

    /** @p parameters must outlive it. */
    explicit DrivenObstacles(const SolidParameters &parameters);

    /** Read the formulas; throws InputError. */
    void create_functions();

    bool empty() const
    {
      return coordinates.empty();
    }

    /** Whether forces move this obstacle, and in this direction. */
    bool is_driven(std::size_t obstacle) const;
    bool is_free(std::size_t obstacle, unsigned int direction) const;

    /** Sizes that a first guess is made of: a stiffness, force per area, and
     * half the extent of the bodies. */
    void set_sizes(double stiffness, double half_extent);

    /** The end of the step in work. Throws InputError for forces that are no
     * numbers. */
    void set_time(double time);

    /** @name A motion @{ */
    /** Begin with the initial velocity, under the forces of the present time.
     */
    void start();
    /** Begin the problem of contact at the start, see
     * BodyMotion::begin_start(). */
    void begin_start(double dt);
    void end_start();
    /** Go on from a checkpoint, at the time reached. */
    void resume();
    /** Begin a step of length @p dt from the last commit(). */
    void begin_step(double dt);
    /** A problem of the step has its answer, and another one follows. */
    void next_problem();
    /** The last one has. */
    void end_step();
    /** 1/2 M v^2 of all, after start() or at the end of the step, and work of
     * the forces in it. */
    double kinetic_energy() const;
    double work() const;
    /** @} */

    /** How far an obstacle displaced by a vector is from what it may touch,
     * length; infinite: from nothing. Collective if that is. */
    using Clearance = std::function<double(std::size_t, const Vector &)>;

    /** Begin to look for places in the contact problem that has begun; a rest
     * of @p tolerance of the forces is balanced. As @p clearance. */
    void begin_problem(double tolerance, const Clearance &clearance);

    /** Contact puts @p force on each obstacle; see ForceBalance. */
    ForceBalance::Answer take(const std::vector<Vector> &force,
                              const Clearance &clearance);
    ForceBalance::Answer refuse();

    /** Why there is no balance, after `loose` or `stuck`. */
    Message explanation(ForceBalance::Answer answer) const;

    /** The step in work is accepted. */
    void commit();

    /** How far an obstacle is from its place at the start, and how fast it is,
     * at @p time: the last commit()'s or that in work. */
    Vector displacement(std::size_t obstacle, double time) const;
    Vector velocity(std::size_t obstacle) const;

    /** Force and weight in free directions at the end of the step in work. */
    Vector driving_force(std::size_t obstacle) const
    {
      return vector_of(obstacle, force);
    }

    /** Force of contact in the step, of all its problems. */
    Vector contact_force(std::size_t obstacle) const;

    /** What is missing to the balance of forces, by the largest of them, at
     * most so far. */
    double imbalance() const
    {
      return worst;
    }

    /** Contact problems that places were tried by so far. */
    unsigned int n_places() const
    {
      return n_tried;
    }

    /** Potential energy of the forces at the present places. */
    double potential() const;

    /** Columns of the table and their values. */
    std::vector<std::string> columns() const;
    void add_to_row(std::map<std::string, double> &row) const;

    /** What a checkpoint keeps. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &balance &u &v &a &load &time_reached &worst &n_tried;
    }

  private:
    /** A free direction of an obstacle. */
    struct Coordinate
    {
      std::size_t obstacle;
      unsigned int direction;
      double mass;
    };

    enum class Stage
    {
      statics,
      start,
      projection,
      step
    };

    using Values = std::vector<double>;

    void refuse_motion(std::size_t obstacle) const;
    void check_velocity(std::size_t obstacle) const;
    abut_time_state state(Values &u, Values &v, Values &a) const;
    abut_time_weights weights(Stage stage) const;
    /** Forces of inertia against a place, and their derivative. */
    Values inertia(const Values &place) const;
    Values stiffness_of_inertia() const;
    /** Forces that act in the problem in work, without contact. */
    Values given_forces() const;
    /** How far forces drive what touches nothing and has no mass until it
     * does; 0 for all others. */
    Values way_to_contact(const Values &place, const Values &touching,
                          const Clearance &clearance);
    Vector vector_of(std::size_t obstacle, const Values &values) const;
    /** Whether a place is out of the range of numbers. */
    static bool is_far(const Values &at);
    /** Take over where the balance wants to be, if that can be. */
    ForceBalance::Answer go_to(ForceBalance::Answer answer);
    std::string name(std::size_t coordinate) const;

    const SolidParameters &parameters;
    const bool in_time;
    std::vector<Coordinate> coordinates;
    std::vector<std::unique_ptr<Expression<dim>>> formulas; ///< by obstacle
    std::unique_ptr<Expression<dim>> gravity;
    std::vector<std::uint8_t> massless;
    double size = 1., softness = 1.; ///< length, length per force
    double largest_force = 0.;       ///< at the last place
    ForceBalance balance;
    Stage stage = Stage::statics;
    double dt = 0., present_time = 0., time_reached = 0.;
    bool is_new_step = true, is_out = false;
    unsigned int n_ways = 0;

    // At the last commit, and forces there.
    Values u, v, a, load;
    // Of the step in work.
    Values place, force, predicted, step_velocity, contact, contact_before;
    Values most_force; ///< largest magnitudes so far; round-off is beside them
    Values next_u, next_v, next_a;
    double work_of_step = 0., error_of_step = 0., worst = 0.;
    unsigned int n_tried = 0;
  };
} // namespace abut::app

#endif

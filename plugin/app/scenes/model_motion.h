// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MODEL_MOTION_H
#define ABUT_APP_MODEL_MOTION_H

#include "app/physics/body_motion.h"
#include "contact_run_state.h"
#include "inertia_parameters.h"

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** What contact does in one of the problems of a step, on one of the sides
   * that it comes from: a pair, or an obstacle of a membrane. */
  struct ContactAction
  {
    std::vector<double> force; ///< on the body, by component
    /** How far a rigid obstacle has come since time 0; empty: it does not move
     * as one. */
    std::vector<double> place;
    double friction = 0.;    ///< sum of magnitudes
    double dissipation = 0.; ///< of the slip of the step under it
    /** Moment of the force about that place, and the obstacle's rotation since
     * time 0. */
    dealii::Tensor<1, 3> moment;
    dealii::Tensor<2, 3> rotation = dealii::unit_symmetric_tensor<3>();
  };

  /** How a model tells of its motion. */
  struct MotionWords
  {
    /** Ends of the names of components, as `_x`; empty of a scalar. */
    std::vector<std::string> components;
    /** Sides that contact comes from, as `pair_1`. */
    std::vector<std::string> sides;
    /** What touches has mass on any mesh, and loses its velocity: impacts cost
     * energy, however fine the mesh. */
    bool stops = false;
  };

  /** The motion of a model: its steps, and the balance of its energies. */
  template <int dim> class ModelMotion
  {
  public:
    /** All must outlive it. */
    ModelMotion(const InertiaParameters &time, MotionWords words,
                const ContactRunState<dim> &run, DiscreteProblem<dim> &problem);

    const BodyMotion<dim> &bodies() const
    {
      return motion;
    }

    /** Mass of the present mesh, of the kind that the parameters ask for.
     * @p touching: surfaces whose nodes have none if mass is modified.
     * Collective. */
    void setup(const typename MassData<dim>::Density &density,
               const std::set<dealii::types::boundary_id> &touching);

    /** Begin with this displacement and velocity, at prescribed unknowns with
     * @p velocity_of_supports; supports and loads are those of time 0. @p
     * rigid_energy: kinetic energy of rigid obstacles. Returns the
     * displacement. Collective. */
    la::Vector start(std::pair<la::Vector, la::Vector> initial,
                     const la::Vector &velocity_of_supports,
                     double rigid_energy = 0.);

    /** See ContactModel::begin_start(). Collective. */
    bool begin_start(bool has_friction, la::Vector &u);

    /** Its answer is @p u, and its contact does @p actions. Collective. */
    void end_start(const la::Vector &u,
                   const std::vector<ContactAction> &actions);

    /** Go on from the displacement of the run; supports and loads are those of
     * the time reached. Collective. */
    void resume(std::vector<la::Vector> fields)
    {
      motion.resume(run.u, std::move(fields));
    }

    /** See ContactModel::begin_solve(). */
    bool begin_step(la::Vector &u);

    /** See BodyMotion::tangent(). Collective. */
    const la::Matrix &tangent(const la::Vector &u)
    {
      return motion.tangent(u);
    }

    /** Whether the tangent has changed since this was asked. */
    bool has_new_tangent()
    {
      return std::exchange(is_new, false);
    }

    /** A solve has led to @p u, with @p actions of contact by side (empty:
     * nothing can touch): see ContactModel::next_solve(). Collective. */
    bool next_problem(const la::Vector &u,
                      const std::vector<ContactAction> &actions);

    /** The last one has led to the displacement of the run. Collective. */
    void end_step();

    /** Obstacles that do not move as rigid ones have worked so much in the step
     * that has ended. */
    void add_work(double work);

    /** Kinetic energy of rigid obstacles at the end of that step, and work of
     * forces on them in it. */
    void add_rigid(double energy, double work);

    /** Length of the step in work. */
    double step_length() const;

    /** Accept it, and judge the balance of energies: returns why the run must
     * end, or nothing. */
    Message commit();

    /** Whether the energy made so far leaves an answer. */
    bool keeps_energy() const;

    /** Kinetic, strain and contact energy after the last end_step(). */
    double energy() const;

    /** Columns of the table, and their values. */
    std::vector<std::string> columns() const;
    void add_to_row(std::map<std::string, double> &row) const;

    /** Results into the summary. Collective. */
    void report() const;

    /** Energies and forces of all steps, that of the start first, as
     * `motion.csv`. Collective. */
    void write_table() const;

    /** What a checkpoint keeps. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &motion &records &dissipated &work;
      archive &balance.n &balance.first &balance.last &balance.highest;
      archive &balance.scale &balance.gain &has_warned;
      archive &balance.loss &balance.fall &balance.fall_at &loses &lost;
      archive &gains;
    }

    /** The state at a time. */
    struct Record
    {
      BodyMotionRecord bodies;
      /** By side, as in ContactAction. */
      std::vector<std::vector<double>> force, place;
      std::vector<double> friction;
      std::vector<dealii::Tensor<1, 3>> moment;
      std::vector<dealii::Tensor<2, 3>> rotation;

      /** B of abut_time_balance. */
      double balance() const
      {
        const abut_time_energy &e = bodies.energy;
        return e.kinetic + e.strain + e.contact + e.dissipated
               - e.external_work;
      }

      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &bodies &force &place &friction &moment &rotation;
      }
    };

    /** All of them, that of the start first. */
    const std::vector<Record> &all_records() const
    {
      return records;
    }

  private:
    Record no_contact() const;
    void measure_contact(const std::vector<ContactAction> &actions);
    double friction_work(const ContactAction &action, double before) const;
    /** Largest displacement of a node or an obstacle within the present step,
     * length. Collective. */
    double way_of_step() const;
    /** Warn if the step since @p before has taken the motion. */
    void look_for_loss(const abut_time_balance &before, double way);
    double work_of_obstacles() const;
    /** Tell the limit of an explicit scheme, and warn above it. Collective. */
    void look_at_step();
    void judge(const BodyMotionRecord &record, abut_time_verdict &verdict);
    std::string text_of_gain() const;
    void warn_of_gain() const;
    void warn_of_loss() const;
    /** What to try where energy was made: nothing that the motion has. */
    std::string cure_of_gain() const;
    /** The pair that begins with an overlap, the deepest, if the first step has
     * made most of the energy; or null. */
    const PairCheck *overlap_of(const std::vector<PairCheck> &checks) const;
    /** The reason and the cure of energy that was made: @p failure, unless
     * bodies that overlap at the start are it. */
    Message explain_gain(abut_failure failure,
                         const std::string &judgement) const;

    const InertiaParameters &time;
    const MotionWords words;
    const ContactRunState<dim> &run;
    DiscreteProblem<dim> &problem;
    BodyMotion<dim> motion;
    bool is_new = false;
    double dissipated = 0., work = 0.; ///< by friction and of obstacles
    std::vector<Record> records;
    Record present;         ///< of the step that has ended
    la::Vector on_supports; ///< contact of that step at prescribed unknowns
    double friction_of_step = 0., work_of_step = 0.;
    abut_time_balance balance = {};
    bool has_warned = false, gains = false, loses = false, lost = false;
  };
} // namespace abut::app

#endif

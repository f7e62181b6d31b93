// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CONTACT_RUN_H
#define ABUT_APP_CONTACT_RUN_H

#include "app/report/step_table.h"
#include "app/restart/saved_mesh.h"
#include "contact_model.h"
#include "light_touches.h"

#include <abut/dealii/contact_solver.h>

#include "solve/masked_solver.h"

#include <memory>
#include <optional>
#include <string>

namespace abut::app
{
  /** One run of a scene with contact: the first load step by nested iteration
   * over uniform levels and adaptive cycles, or to a target error, the others
   * on the last mesh. What touches is the business of a model. */
  template <int dim> class ContactRun
  {
  public:
    /** Both must outlive it; the model reads the state. */
    ContactRun(ContactRunState<dim> &state, ContactModel<dim> &model);

    /** Everything up to the first solve: mesh, data, rows. */
    void check();

    /** Solve; results into the report and the output folder. */
    Outcome run();

    /** Where the run stands between two solves, without meshes, fields, and
     * the report: for checkpoints. */
    template <class Archive> void serialize(Archive &archive, unsigned int);

  private:
    /** What has mass floats in a step only if its inertia is lost in round-off.
     */
    static constexpr const char *inertia_vanishes =
        "Inertia (mass divided by the square of the time step) is below "
        "round-off "
        "of the stiffness, so rigid body modes are free. Check the units of "
        "Density; use a larger density, a smaller "
        "Time stepping/Step size, or supports.";

    void prepare();
    void setup_mesh();

    // One solve
    /** Of the method on the present mesh; forgets preconditioners. */
    void set_parameters();
    void begin_contact();
    /** Unknowns and memory that the run will take, for `abut check`. */
    void report_size();
    /** A rigid motion that nothing can hold, in words; or empty. */
    Message free_motion();
    NewtonParameters newton_parameters() const;
    HostProblem host_problem();
    SolverEvents solver_events();
    void note_step(const LinearReport &cost, const la::Vector &increment);
    void count_layers(std::int64_t n_active);
    Message refuse(unsigned int search);
    bool wants_balance() const;
    /** Forces out of balance as a part of those of contact. Collective. */
    double imbalance(const la::Vector &residual) const;
    bool is_balanced(Message &why);
    Message failure_of(const NewtonResult &result) const;
    /** A sentence about the present step in time; empty in statics. */
    std::string time_step() const;
    /** A sentence about limit points, for statics that are not linear. */
    std::string instability(abut_failure code) const;
    /** The method on the present mesh. */
    MethodParameters present_method() const;
    /** With obstacles where they are. */
    bool solve_at_place();
    bool solve_contact_problem();
    /** With obstacles that forces move where these are in balance. */
    bool solve_with_contact();
    bool solve_without_contact();
    /** One of the problems of a step. */
    bool solve_problem(bool has_new_tangent);
    /** What contact does at the start of a motion, if it needs that. */
    void solve_start();
    bool solve();
    /** Whether the last solve took so many linearisations that a shorter load
     * step is due. */
    bool is_hard() const;

    // Meshes and load steps
    bool solve_on_hierarchy();
    /** Whether the mesh without an answer was there for the start of the next
     * one alone, and a finer one may have an answer. */
    bool can_pass_over() const;
    /** Begin from the start of the problem, on the mesh that there is. */
    void begin_anew();
    /** Whether the last solve succeeded, which meets the target or gives it
     * up; no answer: another mesh is needed. */
    std::optional<bool> follow_target();
    void set_refine_flags();
    /** Whether the mesh to come has cells that p4est cannot make. Collective.
     */
    bool is_too_fine();
    void refine();
    /** Refine a mesh of triangles or tetrahedra as flagged; returns the fields
     * on it. */
    std::vector<la::Vector> bisect();
    /** Whether fields of the present step are written. */
    bool is_written() const;
    /** Whether solves are iterations, which a start near the answer shortens.
     */
    bool is_nonlinear() const;
    /** A load step that the next one is extrapolated from. */
    struct LastStep
    {
      la::Vector increment;
      double length = 0.; ///< in time
      unsigned int linearisations = 0;
    };
    /** Note the present one, which has begun at @p before, if there is a next
     * one that wants it. */
    void note_load_step(const la::Vector &before);
    /** Displacement where the last load step leads; none: there is no such
     * step, or supports have changed their direction. Collective. */
    std::optional<la::Vector> extrapolated() const;
    /** Solve the present load step. Steps but the first start where the last
     * one leads, and if that fails, where it has ended: at @p before. */
    bool solve_load_step(const la::Vector &before);
    /** Contact as at the end of the last load step. */
    void roll_back();
    bool take_load_step();
    void begin();
    bool take_load_steps();

    // Checkpoints, in contact_run_restart.cc
    /** The run has been asked to stop, and has written a checkpoint. */
    struct Stopped
    {
    };
    /** What a rank writes into a checkpoint. */
    struct Checkpoint
    {
      std::string run, report;
      bool has_pressure = false;  ///< beside the displacement
      bool has_start = false;     ///< of the target
      bool has_increment = false; ///< of the last load step
      double length = 0.;         ///< of the same
      unsigned int linearisations = 0;
      bool has_contact = false;   ///< a history of it
      std::string contact;        ///< the history, on rank 0
      std::string preconditioner; ///< of these ranks
      MeshPart mesh;

      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &run &report &has_pressure &has_start &has_increment;
        archive &length &linearisations &has_contact;
        archive &contact &preconditioner &mesh;
      }
    };
    /** Note where the run stands: from here it can go on later. */
    void mark();
    /** The same at the end of a mesh or load step, with a checkpoint if one is
     * due. */
    void pass();
    void write_checkpoint();
    /** Within a solve: go back to the mark if someone asks the run to stop. */
    void stop_if_asked();
    /** Go on from a checkpoint, instead of prepare(). */
    void restore();
    void load_contact();
    void load_preconditioner(const Checkpoint &from);

    // Results
    double counted_seconds() const;
    /** Add to the estimate what obstacles do between nodes. */
    void add_missed_contact();
    /** Rigid motions of bodies into the summary. */
    void report_motions();
    /** Look at the answer of the last mesh; whether it may be used. */
    bool examine();
    /** The same for works and energy, in linear statics without friction. */
    std::optional<ContactFinding> examine_works();
    /** The largest diameter on the present mesh. Collective. */
    double size_of_cells();
    void judge();
    /** Throws InputError if the target is a force that loads prescribe. */
    void refuse_prescribed_force() const;
    void finish_result();

    ContactRunState<dim> &state;
    ContactModel<dim> &model;
    Report &report;

    std::unique_ptr<solve::MaskedSolver> linear_solver; ///< without contact
    /** Section of the times that the solver is in. */
    std::optional<SectionTimes::Scope> section;
    bool contact_is_ready = false; ///< for the present mesh
    bool is_starting = false;      ///< the problem of a start is in work
    std::optional<double> largest_cell;
    /** Owned; start of the next solve, or null. */
    std::shared_ptr<const la::Vector> pressure;
    /** Of the present solve: rows in contact at the last linear system, and
     * systems in a row that have changed their number in the same direction. */
    std::int64_t last_active = -1, direction = 0;
    int n_layers = 0;
    Message failure;                ///< why the last solve has no answer
    std::string told;               ///< of these, the last one
    std::string missed_target;      ///< why, or empty
    double largest_load = 0.;       ///< at an unknown, of all load steps
    double largest_motion = 0.;     ///< the same of displacements
    ContactExamination examination; ///< of the last load step
    LightTouches light_touches;     ///< of all of them
    StepTable steps;
    double counted_before = 0.;
    std::optional<LastStep> last_step; ///< none: not wanted
    bool is_extrapolated = false;      ///< the start of the present solve

    MeshHistory<dim> mesh_history;
    Checkpoint marked; ///< without the mesh
    la::Vector marked_u;
    std::shared_ptr<const la::Vector> marked_pressure;
    /** What the first solve after a restart begins with. */
    std::optional<Checkpoint> resumed;
  };
} // namespace abut::app

#endif

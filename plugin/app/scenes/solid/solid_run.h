// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_RUN_H
#define ABUT_APP_SOLID_RUN_H

#include "app/adapt/target_control.h"
#include "app/physics/error_norms.h"
#include "app/physics/rigid_modes.h"
#include "app/pictures/body_pictures.h"
#include "app/pictures/field_output.h"
#include "app/report/step_table.h"
#include "app/scenes/scene.h"
#include "solid_functions.h"
#include "solid_pairs.h"

#include <abut/dealii/contact_assembler.h>

#include "solve/masked_solver.h"

#include <deal.II/distributed/tria.h>

#include <memory>
#include <optional>

namespace abut::app
{
  /** Results of one mesh, or of one load step on the last mesh. */
  struct SolidState
  {
    unsigned int load_step = 0;
    double time = 0.;
    unsigned int level = 0;
    unsigned int steps = 0;
    LinearReport linear;
    abut_reason reason = ABUT_REASON_CONVERGED;
    abut_progress progress = {};
    dealii::types::global_dof_index cells = 0, dofs = 0, rows = 0, active = 0;
    double energy = 0., force = 0., penetration = 0.;
    std::optional<ErrorNorms> errors;
    std::optional<double> estimate;
    std::optional<ErrorParts> error_parts; ///< with a target only
    std::optional<double> inf_sup;
    double seconds = 0.; ///< since the end of the state before, counted parts
  };

  /** Nodal fields of contact boundaries, ghosted; empty without pairs. */
  struct ContactFields
  {
    la::Vector traction; ///< force per area on either side
    la::Vector pressure; ///< p n on the secondary side
    la::Vector gap;      ///< in all components
    la::Vector status;   ///< in all components
  };

  /** One run of the scene `solid`: the first load step by nested iteration
   * over uniform levels and adaptive cycles, the others on the last mesh. */
  template <int dim> class SolidRun
  {
  public:
    SolidRun(const SolidParameters &parameters, const MethodParameters &method,
             const SolverParameters &solver, const SearchParameters &search,
             const RunOptions &options, Report &report);

    /** Everything up to the first solve: meshes, supports, loads. */
    void check();

    /** Solve; results into the report and the output folder. */
    Outcome run();

  private:
    void create_functions();
    void create_mesh();
    void set_data();
    void check_supports();
    void prepare();
    void set_time(double time);
    void setup_mesh();
    void assemble_load();
    bool solve_on_hierarchy();
    bool solve();
    bool solve_without_contact();
    bool is_last_mesh() const;
    /** Whether the last solve succeeded, which meets the target or gives it
     * up; no answer: another mesh is needed. */
    std::optional<bool> follow_target();

    // Contact, in solid_contact.cc
    void begin_contact();
    void detect();
    void warn_of_pairs();
    void iterate();
    bool is_held();
    bool is_balanced();
    bool is_complete();
    bool solve_with_contact();

    double counted_seconds() const;

    // Meshes, in solid_refinement.cc
    ContactFields contact_fields() const;
    void estimate();
    void judge();
    double solution_norm() const;
    void refine();
    void set_refine_flags();

    // Fields and pictures, in solid_fields.cc
    double output_time() const;
    void write_fields();
    void write_contact(const la::Vector &displacement);
    std::vector<PressureCurve>
    pressure_curves(const ContactFields &fields) const;
    void draw();

    // Results, in solid_results.cc
    void declare_tables();
    void finish_state();
    void report_points();
    void report_reactions();
    void report_checks();
    void report_transfer();
    void report_numerics();
    void report_contact();
    std::optional<double> relative_error() const;
    /** What single ranks have and had to say. */
    void report_shares();
    void report_result(bool converged);
    void report_model();
    void explain_pairs();

    const SolidParameters &parameters;
    const MethodParameters &method;
    const SolverParameters &solver;
    const RunOptions &options;
    Report &report;
    const MPI_Comm communicator;

    Bodies<dim> bodies;
    dealii::parallel::distributed::Triangulation<dim> triangulation;
    Elasticity<dim> elasticity;
    std::unique_ptr<solve::MaskedSolver> linear_solver;

    ContactAssembler<dim> contact;
    bool contact_is_ready = false; ///< for the present mesh
    bool has_warned = false;
    unsigned int n_detections = 0, n_rebuilds = 0;

    std::unique_ptr<SolidFunctions<dim>> functions;
    std::unique_ptr<SolidPairs<dim>> pairs;
    std::unique_ptr<ExactSolution<dim>> exact;
    ElasticData<dim> data;
    std::vector<RigidFreedom> freedom; ///< by body
    LoadSteps load_steps;

    TargetControl control;
    la::Vector u;        ///< displacement, owned
    la::Vector pressure; ///< p n, owned; start on a new mesh, or empty
    dealii::Vector<float> squared_estimate;
    unsigned int mesh_number = 0;
    SolidState present;
    std::string failure; ///< why the last solve has no answer
    bool target_is_missed = false;
    std::vector<SolidState> states;
    StepTable steps;
    FieldSeries series, contact_series;
    double counted_before = 0.;
  };
} // namespace abut::app

#endif

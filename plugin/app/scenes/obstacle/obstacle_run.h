// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_OBSTACLE_RUN_H
#define ABUT_APP_OBSTACLE_RUN_H

#include "app/adapt/target_control.h"
#include "app/input/boundary_expressions.h"
#include "app/physics/error_norms.h"
#include "app/physics/membrane.h"
#include "app/pictures/field_output.h"
#include "app/report/step_table.h"
#include "app/scenes/scene.h"
#include "obstacle_parameters.h"

#include <abut/dealii/contact_assembler.h>

#include <deal.II/distributed/tria.h>

#include <memory>
#include <optional>

namespace abut::app
{
  /** Results of one mesh of an obstacle problem. */
  struct ObstacleLevel
  {
    unsigned int level = 0;
    unsigned int steps = 0;
    LinearReport linear;
    abut_reason reason = ABUT_REASON_NONE;
    abut_progress progress = {};
    dealii::types::global_dof_index cells = 0, dofs = 0, rows = 0, active = 0;
    double energy = 0., force = 0.;
    std::optional<ErrorNorms> errors;
    std::optional<double> estimate;
    std::optional<ErrorParts> error_parts; ///< with a target only
    double seconds = 0.; ///< since the end of the level before, counted parts
  };

  /** One run of the scene `obstacle`: nested iteration over uniform levels,
   * then adaptive cycles, through ContactAssembler. */
  template <int dim> class ObstacleRun
  {
  public:
    ObstacleRun(const ObstacleParameters &parameters,
                const MethodParameters &method, const SolverParameters &solver,
                const RunOptions &options, Report &report);

    /** Everything up to the first solve: mesh, data, obstacles against
     * prescribed values. */
    void check();

    /** Solve; results into the report and the output folder. */
    Outcome run();

  private:
    void create_coarse_mesh();
    void create_functions();
    void set_obstacle();
    void declare_tables();
    void setup_level();
    void choose_law();
    void assemble();
    void refine(bool adaptive);
    void set_tolerance(bool last);
    void prepare_start(bool warm, la::Vector &residual);
    bool solve_level(bool warm);
    bool is_balanced();
    void judge();
    double solution_norm() const;
    bool solve_on_hierarchy();
    bool go_on(unsigned int &number, bool &warm);
    void iterate(la::Vector &residual);
    void record_step(const LinearReport &linear);
    void finish_level(unsigned int number);
    double energy() const;
    void estimate();
    void compare_with_linear_solves();
    void write_fields();
    void write_nodal_values();
    void draw();
    std::optional<double> relative_error(const ObstacleLevel &last) const;
    void report_result(const ObstacleLevel &last, bool converged);
    void report_model();
    double counted_seconds() const;

    const ObstacleParameters &parameters;
    MethodParameters method; ///< its law may be chosen by choose_law()
    const SolverParameters &solver;
    const RunOptions &options;
    Report &report;
    const MPI_Comm communicator;

    dealii::parallel::distributed::Triangulation<dim> triangulation;
    Membrane<dim> membrane;
    ContactAssembler<dim> contact;

    std::unique_ptr<Expression<dim>> conductivity, load;
    std::unique_ptr<BoundaryExpressions<dim>> dirichlet, neumann;
    std::unique_ptr<ExactSolution<dim>> exact;
    std::set<dealii::types::boundary_id> contact_ids;
    MembraneData<dim> data;

    TargetControl control;
    la::Vector u;        ///< displacement, owned
    la::Vector pressure; ///< nodal, owned; start of the next level
    dealii::Vector<float> squared_estimate;
    ObstacleLevel present;
    std::vector<ObstacleLevel> levels;
    StepTable steps;
    FieldSeries series;
    double counted_before = 0.;
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MEMBRANE_MODEL_H
#define ABUT_APP_MEMBRANE_MODEL_H

#include "app/input/boundary_expressions.h"
#include "app/physics/membrane.h"
#include "app/pictures/field_output.h"
#include "app/scenes/moving_model.h"
#include "obstacle_parameters.h"

#include <memory>
#include <set>

namespace abut::app
{
  /** A membrane over an obstacle, as a ContactRun sees it. What has been made
   * of it is public for MembraneReport. */
  template <int dim> class MembraneModel : public MovingModel<dim>
  {
  public:
    /** Both must outlive it. */
    MembraneModel(const ObstacleParameters &parameters,
                  ContactRunState<dim> &run);

    void create_functions() override;
    void create_mesh() override;
    void set_data() override;
    void setup_mesh() override;
    void choose_law(MethodParameters &method) override;
    void declare_tables() override;

    la::Vector start() override;
    void set_time(double time) override;
    void assemble() override;
    void end_solve() override;
    Message commit() override;
    DiscreteProblem<dim> &problem() override
    {
      return membrane;
    }
    const DiscreteProblem<dim> &problem() const override
    {
      return membrane;
    }
    std::string rows_section() const override
    {
      return "contact rows and start";
    }
    void set_contact(ContactAssembler<dim> &contact, double time) override;
    std::string parameter_of(const Message &message) const override
    {
      if (message.field == PairField::upper_obstacle)
        return "Contact/Upper obstacle";
      return parameters.obstacle.empty() && !parameters.height_map.file.empty()
                 ? "Contact/Height map"
                 : "Contact/Obstacle";
    }
    bool relaxes() const override
    {
      return true;
    }
    bool reports_failures() const override
    {
      return !motion; // steps that fail are halved
    }

    double estimate(dealii::Vector<float> &squared) const override;
    double stiffness_of(
        const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
        const override
    {
      return conductivity->value(cell->center());
    }
    double solution_norm() const override;
    std::optional<double> work_on_gaps(const la::Vector &forces,
                                       double work) const override;
    std::optional<ErrorNorms> errors() const override;
    bool has_exact_solution() const override
    {
      return exact != nullptr;
    }
    void add_to_row(ContactResult &result,
                    std::map<std::string, double> &row) const override;
    std::string line_of(const ContactResult &result) const override;

    void resume(std::vector<la::Vector> fields) override;
    void write_fields() override;
    void write_present();

    NarrowNumbers written_numbers() const override
    {
      return series.numbers();
    }
    std::string save_state() const override;
    void load_state(const std::string &bytes) override;
    void finish() override;
    void report_check() override;
    void report_result(bool converged) override;
    void report_model() override;

    /** Distances from the nearer obstacle, ghosted: those of the rows, and of
     * nodes without a row, as at supports, the same from the formulas. */
    la::Vector gaps() const;

    using MovingModel<dim>::run;
    using MovingModel<dim>::motion;

    const ObstacleParameters &parameters;
    Membrane<dim> membrane;
    std::unique_ptr<Expression<dim>> conductivity, load;
    /** Of what moves; or null. */
    std::unique_ptr<Expression<dim>> density, displacement, velocity;
    BoundaryNames names; ///< of the boundary ids
    std::unique_ptr<BoundaryExpressions<dim>> dirichlet, neumann;
    std::unique_ptr<ExactSolution<dim>> exact;
    std::set<dealii::types::boundary_id> contact_ids;
    MembraneData<dim> data;

  protected:
    std::pair<la::Vector, la::Vector> initial_motion() const override;
    std::vector<ContactAction> contact_actions() const override;
    const la::Matrix &reference_stiffness() const override
    {
      return membrane.stiffness;
    }

  private:
    /** Of the two obstacles at the owned unknowns, which may touch them; no
     * value where there is none. */
    struct Heights
    {
      std::vector<double> lower, upper;
    };

    /** 1 at nodes in contact and at hanging nodes between two of them. */
    la::Vector held_nodes() const;
    MotionWords motion_words() const;
    void create_functions_of_motion();
    typename MassData<dim>::Density checked_density() const;
    bool obstacles_move() const;
    /** At the present time. Collective. */
    Heights heights() const;
    /** Throw InputError for a displacement beyond an obstacle. Collective. */
    void require_outside(const la::Vector &start) const;
    /** Of obstacles that move, in the step that has ended. Collective. */
    double work_of_obstacles() const;

    Obstacle<dim> obstacle;
    std::shared_ptr<Expression<dim>> lower, upper; ///< formulas of it, or null
    bool is_told = false;   ///< the obstacle, to the assembler
    bool is_loaded = false; ///< the present mesh
    Heights before, present_heights;
    FieldSeries series;
  };
} // namespace abut::app

#endif

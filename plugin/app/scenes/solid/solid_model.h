// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_MODEL_H
#define ABUT_APP_SOLID_MODEL_H

#include "app/mesh/chords.h"
#include "app/physics/rigid_modes.h"
#include "app/scenes/moving_model.h"
#include "body_parts.h"
#include "driven_obstacles.h"
#include "prescribed_forces.h"
#include "solid_functions.h"
#include "solid_output.h"
#include "solid_pairs.h"
#include "solid_points.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::app
{
  /** Elastic bodies with their contact pairs, as a ContactRun sees them. What
   * has been made of them is public for SolidOutput and SolidReport. */
  template <int dim> class SolidModel : public MovingModel<dim>
  {
  public:
    /** @p parameters, @p run and @p search must outlive it. */
    SolidModel(const SolidParameters &parameters, ContactRunState<dim> &run,
               const SearchParameters &search, BodyMeshes<dim> coarse);

    void create_functions() override;
    void create_mesh() override;
    std::vector<unsigned int> bisect(const std::vector<bool> &marked) override;
    void set_data() override;
    void setup_mesh() override;
    void check_setup() override;
    void declare_tables() override;

    la::Vector start() override;
    bool begin_start(la::Vector &u) override;
    void end_start(la::Vector &u) override;
    void resume(std::vector<la::Vector> fields) override;

    void set_time(double time) override;
    void assemble() override;
    bool begin_solve(la::Vector &u) override;
    bool next_solve(const la::Vector &u) override;
    void end_solve() override;
    Message commit() override;
    bool places_obstacles() const override
    {
      return !driven.empty();
    }
    void begin_places(double tolerance) override;
    typename ContactModel<dim>::Placing place_obstacles(bool solved,
                                                        Message &why) override;
    double energy(const la::Vector &u) const override;
    NewtonParameters newton_parameters() const override;
    DiscreteProblem<dim> &problem() override
    {
      return elasticity;
    }
    const DiscreteProblem<dim> &problem() const override
    {
      return elasticity;
    }
    bool has_contact() const override
    {
      return !pairs->empty();
    }
    std::string rows_section() const override
    {
      return "contact rows";
    }
    void set_contact(ContactAssembler<dim> &contact, double time) override;
    void prepare_contact(ContactAssembler<dim> &contact) override;
    std::string parameter_of(const Message &message) const override
    {
      return pairs->parameter_of(message);
    }
    std::string support_of(const Message &message) const override;
    void look_at_rows(bool is_last) override;
    /** Names a body that nothing holds. */
    Message refuse() const override;
    Message sliding() const override;

    double estimate(dealii::Vector<float> &squared) const override;
    double stiffness_of(
        const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
        const override
    {
      return data.materials.at(cell->material_id())->stiffness();
    }
    bool allows_large_strain() const override
    {
      return parameters.large_strain;
    }
    bool has_large_strain() const override
    {
      return parameters.has_large_strain();
    }
    std::vector<ContactFinding> examine_materials() const override;
    double solution_norm() const override;
    /** With the initial gaps as the rows have them. */
    std::optional<double> work_on_gaps(const la::Vector &forces,
                                       double work) const override;
    std::string why_force_is_prescribed() const override;
    std::optional<ErrorNorms> errors() const override;
    bool has_exact_solution() const override
    {
      return exact != nullptr;
    }
    void add_to_row(ContactResult &result,
                    std::map<std::string, double> &row) const override;
    std::string description() const override;
    std::string line_of(const ContactResult &result) const override;
    void flag_more_cells() override;
    int further_levels(const dealii::types::material_id body) const override
    {
      return static_cast<int>(parameters.bodies[body].refinements);
    }

    void write_fields() override;

    NarrowNumbers written_numbers() const override
    {
      return output.written_numbers();
    }
    std::string save_state() const override;
    void load_state(const std::string &bytes) override;
    void finish() override
    {
      if (run.results.empty())
        return;
      if (parameters.nodal_values)
        output.write_nodal_values();
      if (motion)
        motion->write_table();
      output.finish();
    }
    void report_check() override;
    void report_result(bool converged) override;
    void report_model() override;

    /** Of the present solution. */
    ContactFields contact_fields() const;

    /** Rigid motions that the supports leave to each part of a body: a line
     * each. */
    std::vector<std::string> rigid_motions() const;

    /** Whether supports leave a part of a body a rotation. */
    bool may_rotate(unsigned int body) const;

    /** Names of the discretisations of all pairs. */
    std::string discretisations() const;

    /** Whether forces of pressures and of friction are known by themselves: of
     * laws whose forces are stresses no force is that of a pressure alone. */
    bool tells_friction_apart() const;

    /** Facets that meet at an angle, what that does, and what to do about it.
     */
    std::string text_of_bend(const Bend<dim> &bend,
                             const std::string &effect) const;

    /** Forces at all unknowns but hanging ones that supports and contact hold
     * in the present solution, inertia included. */
    la::Vector unbalanced_forces() const;

    using MovingModel<dim>::run;
    using MovingModel<dim>::motion;

    const SolidParameters &parameters;
    Bodies<dim> bodies;
    Elasticity<dim> elasticity;
    std::unique_ptr<SolidFunctions<dim>> functions;
    std::unique_ptr<SolidPairs<dim>> pairs;
    DrivenObstacles<dim> driven;
    std::unique_ptr<ExactSolution<dim>> exact;
    ElasticData<dim> data;
    std::vector<OutputPoint<dim>> points; ///< of `Output/Points`
    /** Sides that refinement keeps straight, if any have not been told of. */
    std::optional<Chords<dim>> chords;

  protected:
    std::pair<la::Vector, la::Vector> initial_motion() const override
    {
      return functions->initial_motion(elasticity);
    }
    std::vector<ContactAction> contact_actions() const override;
    bool has_friction() const override
    {
      return pairs->has_friction();
    }
    double initial_rigid_energy() const override
    {
      return driven.kinetic_energy();
    }
    const la::Matrix &reference_stiffness() const override
    {
      return elasticity.undeformed_stiffness();
    }

  private:
    /** Search parameters with the numbers of the triangulation in place of the
     * user's boundary ids. Throws InputError for ids that no body has. */
    SearchParameters numbered_search() const;
    MotionWords motion_words() const;
    /** Where obstacles that forces move are at a time. */
    std::vector<dealii::Tensor<1, dim>> driven_places(double time) const;
    /** How far an obstacle displaced by @p displacement is from the surfaces
     * that it may touch, at the displacement of the run. Collective. */
    double clearance(std::size_t obstacle,
                     const dealii::Tensor<1, dim> &displacement) const;
    /** Why the solve of this time step leaves the places that its points were
     * made at; empty: it does not. Collective. */
    Message leaves_points() const;
    /** Errors of Newton's method are parts of the displacement, and a body
     * that flies has come far beside what it is deformed by: the part of the
     * tolerance that is asked for then. Collective. */
    double part_of_flight() const;
    /** Whether refinement keeps the chords of a round side in contact. */
    void look_for_chords();
    /** What supports leave a translation: parts of bodies, and obstacles that
     * forces drive. */
    std::vector<FreeBody<dim>> free_bodies() const;
    bool is_held(const BodyPart<dim> &part,
                 const std::vector<PairResult<dim>> &results) const;

    const SearchParameters &search;
    BodyMeshes<dim> coarse; ///< until there is the mesh of all bodies
    std::vector<std::vector<bool>> bisections; ///< marks of all so far
    ContactAssembler<dim> &assembler;
    std::vector<BodyPart<dim>> parts;
    std::vector<RigidFreedom> freedom; ///< by part
    SolidOutput<dim> output;
    bool has_warned = false;
  };
} // namespace abut::app

#endif

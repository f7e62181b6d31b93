// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CONTACT_MODEL_H
#define ABUT_APP_CONTACT_MODEL_H

#include "app/physics/discrete_problem.h"
#include "app/pictures/narrow_numbers.h"
#include "contact_run_state.h"

#include <abut/dealii/contact_solver_types.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::app
{
  /** What is in contact, as a ContactRun sees it: a mesh with a discrete
   * problem on it, how it touches, and what there is to tell about it. The run
   * has the meshes, load steps, target and iterations; it calls these functions
   * in the order in which they stand here. All are collective unless they say
   * otherwise. */
  template <int dim> class ContactModel
  {
  public:
    /** @param simplices whether there are triangles or tetrahedra: all ranks
     * have all cells then; others are p4est's */
    explicit ContactModel(const MPI_Comm communicator,
                          const bool simplices = false)
        : mesh(make_mesh(communicator, simplices)), triangulation(*mesh)
    {
    }

    virtual ~ContactModel() = default;

    /** @name Set-up @{ */
    /** Read the formulas; throws InputError. Called inside collective(), not
     * collective itself. */
    virtual void create_functions() = 0;

    /** Make the coarse mesh; throws InputError, also if the mesh of the level
     * asked for would not fit into memory. */
    virtual void create_mesh() = 0;
    /** Bisect the marked cells of a mesh of triangles or tetrahedra, which then
     * has no unknowns; returns the old cell of each new one. Collective. */
    virtual std::vector<unsigned int> bisect(const std::vector<bool> &)
    {
      return {};
    }
    /** Triangles or tetrahedra, perhaps beside other cells. */
    bool has_simplices() const
    {
      return !triangulation.all_reference_cells_are_hyper_cube();
    }
    /** Refine the mesh that create_mesh() has made. One with triangles or
     * tetrahedra has its levels already. Collective. */
    void refine_mesh(const unsigned int levels)
    {
      if (!has_simplices())
        triangulation.refine_global(levels);
    }

    /** Find the places of all data on the mesh. Called as create_functions().
     */
    virtual void set_data() = 0;

    /** Unknowns, constraints and pattern of the present mesh. */
    virtual void setup_mesh() = 0;

    /** Look at the first mesh: whether bodies are held. Throws InputError. */
    virtual void check_setup()
    {
    }

    /** Choose the law where the file leaves it open. */
    virtual void choose_law(MethodParameters &)
    {
    }

    /** Declare the columns of `levels.csv`. */
    virtual void declare_tables() = 0;
    /** @} */

    /** Whether it moves by inertia: then nothing has to be held, and the first
     * solve is on the last mesh. */
    virtual bool has_inertia() const
    {
      return false;
    }

    /** With inertia, the displacement of the last step that was accepted, or
     * of the start. */
    virtual la::Vector last_place() const
    {
      return problem().vector();
    }

    /** Increment of the displacement in the first step by the velocity of the
     * start. */
    virtual la::Vector first_increment() const
    {
      return problem().vector();
    }

    /** The displacement that the run begins with, on a new mesh and at time 0.
     */
    virtual la::Vector start()
    {
      return problem().vector();
    }

    /** Begin the problem that a start with contact needs, from @p u. Returns
     * whether there is one: it is solved as those of a step are, with
     * residual() and tangent(). */
    virtual bool begin_start(la::Vector &)
    {
      return false;
    }

    /** It has an answer; @p u becomes what start() returned. */
    virtual void end_start(la::Vector &)
    {
    }
    /** @} */

    /** @name A load step on a mesh @{ */
    /** Time of all formulas, with what they prescribe. */
    virtual void set_time(double)
    {
    }

    /** Tangent and loads of the present mesh and time. */
    virtual void assemble() = 0;

    /** Begin a solve from @p u, which may be improved, to what was assembled.
     * Returns whether tangent() has another value than before. */
    virtual bool begin_solve(la::Vector &)
    {
      return false;
    }

    /** Forces of the present step without those of contact, 0 at constrained
     * unknowns. */
    virtual void residual(const la::Vector &u, la::Vector &result) const
    {
      problem().residual(u, result);
    }

    /** Forces that are small beside those of the present step, as a norm over
     * all unknowns: contact forces below say nothing of the balance. */
    virtual double small_force() const
    {
      return 1e-4 * problem().load.l2_norm();
    }

    /** Its derivative. */
    virtual const la::Matrix &tangent(const la::Vector &u)
    {
      return problem().tangent(u);
    }

    /** A solve has an answer @p u. Returns whether the step has another one
     * that goes on from there, with other residual() and tangent(). */
    virtual bool next_solve(const la::Vector &)
    {
      return false;
    }

    /** What obstacles do after a contact problem. */
    enum class Placing
    {
      settled, ///< they are where they belong
      again,   ///< they have moved: the problem has to be solved anew
      lost     ///< there is no place for them
    };

    /** Whether forces move obstacles. */
    virtual bool places_obstacles() const
    {
      return false;
    }

    /** A contact problem begins, in which @p tolerance of the forces on
     * obstacles may be left without balance. */
    virtual void begin_places(double /*tolerance*/)
    {
    }

    /** It has been solved with obstacles where they are now, or (@p solved is
     * false) has no answer there: where obstacles that forces move have to be
     * for these to be in balance. @p why: of what is lost, unless the problem
     * itself has told. */
    virtual Placing place_obstacles(bool solved, Message &why)
    {
      (void)why;
      return solved ? Placing::settled : Placing::lost;
    }

    /** All solves of the step have led to the displacement of the run's state,
     * which results are now asked of. */
    virtual void end_solve()
    {
    }

    /** Its load step is accepted. Returns why the run must end here, or
     * nothing. */
    virtual Message commit()
    {
      return "";
    }

    /** How accurately nonlinear problems are solved, and when they are given
     * up. */
    virtual NewtonParameters newton_parameters() const
    {
      return NewtonParameters();
    }

    virtual DiscreteProblem<dim> &problem() = 0;
    virtual const DiscreteProblem<dim> &problem() const = 0;

    /** Whether anything can touch. */
    virtual bool has_contact() const
    {
      return true;
    }

    /** Section of the times that rows belong to. */
    virtual std::string rows_section() const = 0;

    /** Tell the assembler what can touch at @p time. */
    virtual void set_contact(ContactAssembler<dim> &contact, double time) = 0;

    /** The assembler has a new mesh. */
    virtual void prepare_contact(ContactAssembler<dim> &)
    {
    }

    /** The parameter that a message about contact belongs to. */
    virtual std::string parameter_of(const Message &message) const = 0;

    /** The parameter that a message about a body without support
     * belongs to. */
    virtual std::string support_of(const Message &) const
    {
      return "";
    }

    /** There are new rows.
     * @param is_last they are those of the mesh that the run ends with, as far
     * as is known */
    virtual void look_at_rows(bool is_last)
    {
      (void)is_last;
    }

    /** Whether relax() makes a better start on a finer mesh. */
    virtual bool relaxes() const
    {
      return false;
    }

    /** Why a converged solution must not be used; empty: it may. */
    virtual Message refuse() const
    {
      return "";
    }

    /** The body that slides because friction does not carry its loads, in the
     * last iterate of a solve without an answer; empty: none. */
    virtual Message sliding() const
    {
      return "";
    }

    /** Whether the results of all load steps, taken together, are an answer. */
    virtual bool is_usable() const
    {
      return true;
    }

    /** Whether what a failed solve has reached is reported, too. */
    virtual bool reports_failures() const
    {
      return false;
    }
    /** @} */

    /** @name Its results @{ */
    /** Estimate the error in the energy norm; @p squared by cell. */
    virtual double estimate(dealii::Vector<float> &squared) const = 0;

    /** Stiffness k of a cell, such that a penetration by d into a facet of
     * size h costs k d^2 h^(dim - 2). Not collective. */
    virtual double stiffness_of(
        const typename dealii::Triangulation<dim>::active_cell_iterator &cell)
        const = 0;

    /** Whether strains may be large although they are computed as small. */
    virtual bool allows_large_strain() const
    {
      return false;
    }

    /** Whether strains are computed as what they are, so that they may be of
     * any size. */
    virtual bool has_large_strain() const
    {
      return false;
    }

    /** What materials say of the present solution, and figures of it into the
     * report. */
    virtual std::vector<ContactFinding> examine_materials() const
    {
      return {};
    }

    /** What is stored, and what external forces could still do. */
    virtual double energy(const la::Vector &u) const
    {
      return problem().energy(u);
    }

    /** Energy norm of the solution. */
    virtual double solution_norm() const = 0;

    /** Work of the contact forces on the gaps that are left, 0 for exact
     * multipliers; nothing if contact stores or dissipates by itself. Called
     * after a solve with contact.
     * @param forces of contact at the nodes, owned
     * @param work of these on the displacement */
    virtual std::optional<double> work_on_gaps(const la::Vector &forces,
                                               double work) const = 0;

    /** Why loads and equilibrium alone make the contact force of the present
     * solution, on every mesh; empty if they do not. */
    virtual std::string why_force_is_prescribed() const
    {
      return "";
    }

    /** Errors against the exact solution, if there is one. */
    virtual std::optional<ErrorNorms> errors() const = 0;
    virtual bool has_exact_solution() const = 0;

    /** Add what only this model has to a result and its row of `levels.csv`. */
    virtual void add_to_row(ContactResult &,
                            std::map<std::string, double> &) const
    {
    }

    /** The problem and its solution in words: bodies, contact, method. */
    virtual std::string description() const = 0;

    /** A line of progress about a result. */
    virtual std::string line_of(const ContactResult &result) const = 0;

    /** Levels by which a material is refined more than others. */
    virtual int further_levels(dealii::types::material_id) const
    {
      return 0;
    }

    /** Flag more cells, beside those with large errors. */
    virtual void flag_more_cells()
    {
    }
    /** @} */

    /** @name What it leaves behind @{ */
    virtual void write_fields() = 0;

    /** What numbers write_fields() has written. */
    virtual NarrowNumbers written_numbers() const = 0;

    /** What a checkpoint keeps of the model beside what is in the state of the
     * run, as bytes of the archive; not collective. */
    virtual std::string save_state() const = 0;

    /** Go on from what save_state() returned; not collective. */
    virtual void load_state(const std::string &bytes) = 0;

    /** Fields on the mesh that a checkpoint keeps beside the displacement: of
     * the last load step that was accepted. Always as many. */
    virtual std::vector<la::Vector> history() const
    {
      return {};
    }
    virtual unsigned int n_history() const
    {
      return 0;
    }

    /** Go on from them and from the displacement of the run's state, at the
     * time reached. */
    virtual void resume(std::vector<la::Vector>)
    {
    }

    /** Files and figures of the end that need the time's sections closed. */
    virtual void finish()
    {
    }

    /** What `abut check` tells; there are rows if there is contact. */
    virtual void report_check() = 0;

    /** Results into the summary. */
    virtual void report_result(bool converged) = 0;

    /** What was modelled, and what could have been left out. */
    virtual void report_model() = 0;
    /** @} */

    using AdaptiveMesh = dealii::parallel::distributed::Triangulation<dim>;

    /** The mesh, which is p4est's. */
    AdaptiveMesh &adaptive_mesh()
    {
      return dynamic_cast<AdaptiveMesh &>(*mesh);
    }

  private:
    static std::unique_ptr<dealii::parallel::TriangulationBase<dim>>
    make_mesh(const MPI_Comm communicator, const bool simplices)
    {
      using Shared = dealii::parallel::shared::Triangulation<dim>;
      if (simplices)
        return std::make_unique<Shared>(communicator, Shared::none, true);
      return std::make_unique<AdaptiveMesh>(communicator);
    }

    const std::unique_ptr<dealii::parallel::TriangulationBase<dim>> mesh;

  public:
    dealii::parallel::TriangulationBase<dim> &triangulation;
  };
} // namespace abut::app

#endif

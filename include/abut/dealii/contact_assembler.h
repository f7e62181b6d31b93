// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_ASSEMBLER_H
#define ABUT_DEALII_CONTACT_ASSEMBLER_H

/** @file
 * Contact for a deal.II application that keeps its own mesh, material and
 * Newton loop.
 *
 *     contact.reinit(mapping, dof_handler, constraints);
 *     contact.detect(u);
 *     do
 *     {
 *       // assemble K = dR/du and R = internal - external forces at u
 *       contact.solve(K, R, du);
 *       u += du;
 *     } while (contact.update(u));
 *
 * When the mesh is refined, coarsened or partitioned again, the host takes
 * displacement and pressures along like any other fields:
 *
 *     // u, p: with ghosts, p copied from a variable with results().pressure();
 *     // if the temporary itself were assigned, p would lose its ghosts
 *     transfer.prepare_for_coarsening_and_refinement({&u, &p});
 *     triangulation.execute_coarsening_and_refinement(); // or repartition()
 *     // distribute unknowns, make constraints, vectors u and p without ghosts
 *     transfer.interpolate({&u, &p});
 *     contact.reinit(mapping, dof_handler, constraints);
 *     contact.state().set_pressure(p);
 *     contact.detect(u);
 *
 * The active set follows from pressures and gaps. If the mesh is the same and
 * only ranks of cells have changed, rows start from exactly what they had, and
 * so do the multipliers of quadrature points, which p cannot hold, and the
 * penalty that an outer iteration had reached: reinit() keeps them.
 *
 * Signs: gap > 0 is open, pressure > 0 is compression. R holds no contact
 * force; rows of R and K that the constraints eliminate must be zero and
 * diagonal, as AffineConstraints::distribute_local_to_global() leaves them. All
 * functions are collective over the communicator unless stated otherwise, and
 * errors are thrown on all ranks. */

#include <abut/dealii/contact_checks.h>
#include <abut/dealii/contact_pair.h>
#include <abut/dealii/contact_results.h>
#include <abut/dealii/contact_state.h>
#include <abut/dealii/host_operator.h>
#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/method_parameters.h>
#include <abut/dealii/search_parameters.h>
#include <abut/dealii/solver_parameters.h>
#include <abut/dealii/surface_traction.h>
#include <abut/dealii/vertex_origin.h>
#include <abut/strategy.h>

#include <deal.II/base/function.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace abut
{
  /** A membrane's obstacles: lower <= u <= upper at the support points of the
   * whole domain, or of the given boundary ids only. */
  template <int dim> struct Obstacle
  {
    /** psi in u >= psi, or null. */
    std::shared_ptr<const dealii::Function<dim>> lower;
    /** psi2 in u <= psi2, or null. */
    std::shared_ptr<const dealii::Function<dim>> upper;
    /** Where contact is possible; empty: in the whole domain. */
    std::set<dealii::types::boundary_id> boundary_ids;
  };

  /** An obstacle that no displacement can respect, or that is not a number: the
   * message has the place. Thrown on all ranks. */
  class ObstacleError : public MessageError
  {
  public:
    using MessageError::MessageError;
  };

  namespace shim
  {
    template <int dim> struct ContactProblem;
  }

  /** State of the iteration. */
  struct IterationReport
  {
    abut_reason reason = ABUT_REASON_NONE; ///< why it stopped
    /** The known failure behind the reason, or CYCLE where the iteration
     * converged only by changing rows one by one. */
    abut_failure failure = ABUT_FAILURE_NONE;
    /** The reason in words: what to try, and what was seen; of an iteration
     * that converged, pairs without constraints that are not ContactPair::
     * may_be_apart. */
    std::string explanation;
    abut_progress progress = {}; ///< how far it has come
  };

  /** Assembles and solves contact for one DoFHandler.
   *
   * A program linked to Abut constructs it; one that loads Abut at run time
   * gets it from Registry::create(). All functions are virtual so that the
   * latter calls them without linking; it is not meant to be derived from. The
   * functions that everyone needs come first, then what an object of its own
   * has: results(), checks() and state(). */
  template <int dim> class ContactAssembler
  {
  public:
    /** @p communicator must be that of the triangulation. */
    explicit ContactAssembler(MPI_Comm communicator);
    virtual ~ContactAssembler();

    /** Declare the sections `Method`, `Solver` and `Search`. Not collective. */
    static void declare_parameters(dealii::ParameterHandler &prm);

    /** Read them. Not collective. */
    virtual void parse_parameters(dealii::ParameterHandler &prm);

    /** The same without a parameter file. Not collective. */
    virtual void set_parameters(const MethodParameters &method,
                                const SolverParameters &solver);

    /** The other kind of contact: pairs of surfaces of elastic bodies, or of a
     * surface and a rigid obstacle. The displacement is the first dim
     * components of the finite element, FESystem(FE_Q(degree), dim) or
     * FESystem(FE_SimplexP(degree), dim) of degree 1 or 2. Where surfaces of
     * pairs overlap, only one of them may press at a node. The geometry is that
     * of the reference configuration, so that gaps are linear in the
     * displacement. Takes effect at detect(); replaces an obstacle. In load
     * steps call it freely: pairs that differ from the present ones in their
     * gaps alone keep what was found for them. Obstacles that move need no call
     * at all. Not collective. */
    virtual void set_pairs(const std::vector<ContactPair<dim>> &pairs);

    /** Take a mesh with its unknowns and constraints (closed; hanging nodes
     * and prescribed values). All three must outlive the next reinit().
     * To be called after each change of the mesh, of the ranks of its cells, of
     * the numbers of unknowns, of the constraints or of the mapping.
     * Forgets pressures unless ContactState::set_pressure() follows. Throws
     * ContactError for cells and elements without contact: others than
     * quadrilaterals, hexahedra, triangles and tetrahedra, two elements for one
     * kind of cells, tetrahedra with hanging nodes. Collective for tetrahedra
     * only.
     */
    virtual void reinit(const dealii::Mapping<dim> &mapping,
                        const dealii::DoFHandler<dim> &dof_handler,
                        const dealii::AffineConstraints<double> &constraints);

    /** Find the constraint rows and begin a new solve at @p displacement (owned
     * entries). Throws ObstacleError if a prescribed value violates an
     * obstacle, if obstacles cross or have a value that is not a number, and
     * ContactError for pairs that cannot be solved; ContactChecks::pairs()
     * reports what is unusual but no error. Surfaces look for each other within
     * half a facet, one and a half times their relative motion in @p
     * displacement, or the reach given, whichever is most. Pressures of the
     * last solve, or those of ContactState::set_pressure(), are its start. */
    virtual void detect(const la::VectorView &displacement);

    /** One linearised step with contact: returns the increment of the
     * displacement, already damped where the method requires it. @p tangent is
     * the matrix, which is not changed, or a HostOperator. The latter is solved
     * by conjugate gradients with its own preconditioner, and throws for what
     * needs a matrix: Nitsche's method, saddle points, points that move, and
     * solvers that are not iterative. Throws when the linear solver fails; for
     * a matrix of other constraints than those of reinit(); and, in the second
     * call of an iteration, if the residual has changed by a multiple of K du
     * that is not positive, as one of wrong sign does. */
    virtual LinearReport solve(const Tangent &tangent,
                               const la::VectorView &residual,
                               const la::MutableVectorView &increment);

    /** Set the displacement after the step; advances active set, multipliers
     * and parameters. Returns whether another step is needed; if not,
     * iteration() reports the cause. */
    virtual bool update(const la::VectorView &displacement);

    /** Accept the step that has been solved: its pressures, states and the
     * penalty reached are what rollback() returns to and ContactState::save()
     * writes. To be called once per load or time step, at its @p displacement.
     */
    virtual void commit(const la::VectorView &displacement);

    /** Forces, pressures and other results of the present rows. It lives as
     * long as this. Not collective. */
    virtual const ContactResults<dim> &results() const;

    /** Checks of the problem and of its answer, likewise. */
    virtual const ContactChecks<dim> &checks() const;

    /** Start of a solve, on other meshes and in other runs, likewise. */
    virtual ContactState &state();

    /** State of the iteration, and why it stopped. Not collective. */
    virtual IterationReport iteration() const;

    /** Give up the step since commit(), as if it had never been tried: the next
     * detect(), which must follow, begins with what was committed, or with
     * pressure 0 if nothing was. On another mesh than that of commit(), values
     * given to ContactState::set_pressure() count as committed. Preconditioners
     * may be those of the step given up: with iterative solvers the same answer
     * within their tolerance. */
    virtual void rollback();

    /** The obstacle that the field may not penetrate. Takes effect at detect().
     * Not collective. */
    virtual void set_obstacle(const Obstacle<dim> &obstacle);

    /** Names of the bodies for messages, such as `the tyre`, in the order of
     * the connected parts of the mesh: by their first cells of level 0. Empty,
     * the default: `body 1`, `body 2`, ... Takes effect at the next reinit().
     * Not collective. */
    virtual void set_body_names(std::vector<std::string> names);

    /** How the surfaces of pairs are searched. Takes effect at detect(). Not
     * collective. */
    virtual void set_search_parameters(const SearchParameters &search);

    /** Whether the bodies of pairs are rotated about the axis x = 0 (2D):
     * weights are then areas of the whole turn, as integrals with 2 pi x are.
     * Default: false. Not collective. */
    virtual void set_axisymmetric(bool axisymmetric);

    /** The traction of the bodies at their surface, which `nitsche` needs.
     * Takes effect at detect(). Not collective. */
    virtual void
    set_surface_traction(std::shared_ptr<const SurfaceTraction<dim>> traction);

    /** Declare that the matrix given to solve() is the same until the next
     * reinit() or linearise(): preconditioners are then kept. Default: false.
     * Not collective. */
    virtual void assume_constant_matrix(bool constant);

    /** Set for geometric multigrid what meshes a mesh of one level, of
     * triangles or tetrahedra, was refined from: [vertices of the
     * triangulation], the same on all ranks, which all have the whole mesh.
     * Empty: the levels of the triangulation. Takes effect at the next
     * reinit(), for that mesh only. Not collective. */
    virtual void set_vertex_origins(std::vector<VertexOrigin> origins);

    /** Take the stiffness that penalties are multiples of from this tangent,
     * and not from the first one that solve() or add() is given after
     * reinit(), and measure the load by it: as the larger of the residual R
     * and K u at the start of an iteration, with K this tangent and not the
     * present one. For tangents with inertia, whose K u is no internal force,
     * or if the first tangent is not a typical one. It must be of the present
     * unknowns and stay as it is until the next reinit(), which forgets it. Not
     * collective. */
    virtual void set_reference_stiffness(const Tangent &tangent);

    /** Length > 0 that tolerances of gaps are a part of. 0, the default: see
     * length_scale(); where nothing has moved, a mean of the gaps. Not
     * collective. */
    virtual void set_length_scale(double length);

    /** The length that gaps and depths at @p displacement are measured by:
     * the one that was set or, without, the largest displacement, but of pairs
     * not more than a facet, the median of their secondary surfaces: a body
     * may travel far. With updated kinematics it is a facet where nothing has
     * moved.
     */
    virtual double length_scale(const la::VectorView &displacement) const;

    /** A mapping that does not live on. */
    void reinit(const dealii::Mapping<dim> &&, const dealii::DoFHandler<dim> &,
                const dealii::AffineConstraints<double> &) = delete;

    /** Begin a new iteration at @p displacement with the rows of the last
     * detect(), from the pressures and the set reached so far: for Newton's
     * method, where each linearisation is a contact problem of its own, see
     * ContactSolver. The next matrix may have other values even if it was
     * declared constant; a preconditioner is kept while it is good. Not for
     * `nitsche`, whose stress is linear.
     * @param linear_tolerance relative tolerance of the linear systems of this
     *   iteration; 0: that of the parameters */
    virtual void linearise(const la::VectorView &displacement,
                           double linear_tolerance = 0.);

    /** The contact problem of one linearisation, from the displacement of the
     * last detect() or linearise() to its end, for hosts with a Newton loop of
     * their own: solve() and update() in turn, by products with the one
     * @p tangent. @p residual is that of the displacement where it began; @p
     * step becomes the whole way from there, hanging nodes and all. iteration()
     * reports whether it has an answer. Assemble, call this, shorten the step
     * if you must, and linearise() where you have gone. */
    virtual LinearReport solve_linearised(const Tangent &tangent,
                                          const la::VectorView &residual,
                                          const la::MutableVectorView &step);

    /** Data of contact for a line search at @p displacement, without a step of
     * the iteration: writes the forces of the present pressures into
     * @p forces, as ContactResults::add_forces() adds them, and returns how far
     * pressures and the gaps there are from the law,
     * (sum w s r^2)^(1/2), root of an energy. In rows that are closed
     * r is the residual of the current linearisation of the law as a length,
     * else the penetration. 0 where the problem is solved. After the first
     * solve(); not for `nitsche`. */
    virtual double evaluate(const la::VectorView &displacement,
                            const la::MutableVectorView &forces) const;

    /** Take points that move to @p displacement, with their pressures and
     * states: results() then refer to that configuration.
     * To be called at the end of a Newton iteration; ContactSolver does. Does
     * nothing where points are fixed. */
    virtual void follow(const la::VectorView &displacement);

    /** Whether points move with the bodies (MethodParameters::sliding): then
     * linearise() makes them again at its displacement, solve() and add() take
     * into account that the directions of their pressures change, with the
     * pressures that they start from, and evaluate() looks at them where they
     * are. Not collective. */
    virtual bool points_move() const;

    /** Where points of mortar move: raise the gaps of rows that press although
     * surfaces are apart around them at @p displacement, so that they open.
     * Weighted gaps of dual functions are less than the least gap of a convex
     * surface. To be called at the end of a Newton iteration, after follow(),
     * until it returns false: true, and the same step is to be solved on from
     * there, with linearise(). ContactSolver does. The amounts that gaps are
     * raised by are constant in between, and detect() resets them; true at most
     * ten times from there on. Collective. */
    virtual bool raise_gaps(const la::VectorView &displacement);

    /** To be called where there is no solution after raise_gaps(): it may have
     * opened rows altogether, and a body may have been held by nothing else.
     * True: they are as before that, and so is the @p displacement, from which
     * the step is to be solved on. False: no row was opened. Collective. */
    virtual bool limit_raises(const la::MutableVectorView &displacement);

    /** Repeat the search with a larger reach, for bodies without supports whose
     * motion no row stops: ABUT-F12 and ABUT-F42 of an iteration. Pairs with a
     * reach of their own keep it. Does what detect() does with the states and
     * pressures of the last commit(), and returns true if there are more rows
     * then; false after three times, or if points are made in each step.
     * Collective. */
    virtual bool search_farther(const la::VectorView &displacement);

    /** Improve the start by @p n_sweeps symmetric projected Gauss-Seidel
     * sweeps, and take the set of active rows from them: nested iteration
     * needs a third of the steps then. Only between detect() and the first
     * solve(), for a symmetric positive definite matrix. Changes
     * @p displacement; its residual must be computed again. Does nothing for
     * pairs, except with the law `barrier`, whose gaps are opened, and needs no
     * matrix for either. */
    virtual void relax(const Tangent &tangent, const la::VectorView &residual,
                       unsigned int n_sweeps,
                       const la::MutableVectorView &displacement);

    /** Add the couplings that add() needs: those of all rows, in contact or
     * not. Rows on single unknowns, as those of a membrane's obstacle, need
     * none. The pattern must take rows of other ranks, and be distributed
     * afterwards. Not collective. */
    virtual void add_to_sparsity(dealii::DynamicSparsityPattern &pattern) const;

    /** For hosts with a linear solver of their own: add the condensed contact
     * terms to @p matrix and @p residual, so that matrix increment =
     * -residual is the step with contact; then call update(). With friction the
     * matrix is not symmetric any more: use a solver for nonsymmetric matrices.
     * Throws for laws with true constraints (lagrange), for interior point and
     * for nitsche, which need solve(). */
    virtual void add(const la::MatrixTarget &matrix,
                     const la::MutableVectorView &residual);

    /** The tangent with Abut's own copy of a matrix that is of another type, as
     * it is now and until the next call with a matrix; any other one as it is.
     * Collective. */
    virtual Tangent copy_of(const Tangent &tangent) const;

    /** A vector of Abut's type with the values of @p vector. Collective. */
    virtual la::Vector copy_of(const la::VectorView &vector) const;

  private:
    std::unique_ptr<shim::ContactProblem<dim>> implementation;

    friend struct StudyAccess; ///< tests/solve/inf_sup_study.cc
  };
} // namespace abut

#endif

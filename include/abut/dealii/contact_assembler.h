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
 *     // u, p: with ghosts, p copied from a variable that has pressure(): an
 *     // assignment of the temporary itself would move it, and lose the ghosts
 *     transfer.prepare_for_coarsening_and_refinement({&u, &p});
 *     triangulation.execute_coarsening_and_refinement(); // or repartition()
 *     // distribute unknowns, make constraints, vectors u and p without ghosts
 *     transfer.interpolate({&u, &p});
 *     contact.reinit(mapping, dof_handler, constraints);
 *     contact.set_pressure(p);
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

#include <abut/dealii/communication_report.h>
#include <abut/dealii/contact_examination.h>
#include <abut/dealii/contact_pair.h>
#include <abut/dealii/detection_report.h>
#include <abut/dealii/host_operator.h>
#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/method_parameters.h>
#include <abut/dealii/search_parameters.h>
#include <abut/dealii/solver_parameters.h>
#include <abut/dealii/surface_traction.h>
#include <abut/dealii/vertex_origin.h>
#include <abut/strategy.h>

#include <deal.II/base/function.h>
#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/vector.h>

#include <iosfwd>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

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

  /** A history of contact that cannot be read or written, or belongs to another
   * mesh: the message has the reason. Thrown on all ranks. */
  class HistoryError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** Assembles and solves contact for one DoFHandler.
   *
   * A program linked to Abut constructs it; one that loads Abut at run time
   * gets it from Registry::create(). All functions are virtual so that the
   * latter calls them without linking; it is not meant to be derived from. */
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

    /** How the surfaces of pairs are searched. Takes effect at detect(). Not
     * collective. */
    virtual void set_search_parameters(const SearchParameters &search);

    /** The obstacle that the field may not penetrate. Takes effect at detect().
     * Not collective. */
    virtual void set_obstacle(const Obstacle<dim> &obstacle);

    /** The other kind of contact: pairs of surfaces of elastic bodies, or of a
     * surface and a rigid obstacle. The displacement is the first dim
     * components of the finite element, FESystem(FE_Q(degree), dim) or
     * FESystem(FE_SimplexP(degree), dim) of degree 1 or 2. Where pairs overlap,
     * the first one has the node. The geometry is that of the reference
     * configuration, so that gaps are linear in the displacement. Takes effect
     * at detect(); replaces an obstacle. In load steps call it freely: pairs
     * that differ from the present ones in their gaps alone keep what was found
     * for them. Obstacles that move need no call at all. Not collective. */
    virtual void set_pairs(const std::vector<ContactPair<dim>> &pairs);

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

    /** Take a mesh with its unknowns and constraints (closed; hanging nodes
     * and prescribed values). All three must outlive the next reinit().
     * To be called after each change of the mesh or of the ranks of its cells.
     * Forgets pressures unless set_pressure() follows. Throws ContactError for
     * cells and elements without contact: others than quadrilaterals,
     * hexahedra, triangles and tetrahedra, collections of elements, tetrahedra
     * with hanging nodes. Collective for tetrahedra only. */
    virtual void reinit(const dealii::Mapping<dim> &mapping,
                        const dealii::DoFHandler<dim> &dof_handler,
                        const dealii::AffineConstraints<double> &constraints);

    /** Set for geometric multigrid what meshes a mesh of one level, of
     * triangles or tetrahedra, was refined from: [vertices of the
     * triangulation], the same on all ranks, which all have the whole mesh.
     * Empty: the levels of the triangulation. Takes effect at the next
     * reinit(), for that mesh only. Not collective. */
    virtual void set_vertex_origins(std::vector<VertexOrigin> origins);

    /** A mapping that does not live on. */
    void reinit(const dealii::Mapping<dim> &&, const dealii::DoFHandler<dim> &,
                const dealii::AffineConstraints<double> &) = delete;

    /** Find the constraint rows and begin a new solve at @p displacement (owned
     * entries). Throws ObstacleError if a prescribed value violates an
     * obstacle, if obstacles cross or have a value that is not a number, and
     * ContactError for pairs that cannot be solved; pair_checks() reports what
     * is unusual but no error. Surfaces look for each other within half a
     * facet, one and a half times their relative motion in @p displacement, or
     * the reach given, whichever is most. Pressures of the last solve, or those
     * of set_pressure(), are its start. */
    virtual void detect(const la::VectorView &displacement);

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

    /** Whether points move with the bodies (MethodParameters::sliding): then
     * linearise() makes them again at its displacement, solve() and add() take
     * into account that the directions of their pressures change, with the
     * pressures that they start from, and evaluate() looks at them where they
     * are. Not collective. */
    virtual bool points_move() const;

    /** Take points that move to @p displacement, with their pressures and
     * states: pair_results() and the fields then refer to that configuration.
     * To be called at the end of a Newton iteration; ContactSolver does. Does
     * nothing where points are fixed. */
    virtual void follow(const la::VectorView &displacement);

    /** Earlier name of linearise(). */
    [[deprecated("is called linearise()")]] void
    restart(const la::VectorView &displacement, double linear_tolerance = 0.)
    {
      linearise(displacement, linear_tolerance);
    }

    /** Pressure to start from, in the form of pressure(), for example
     * interpolated from a coarser mesh. Call between reinit() and detect(). If
     * it is what pressure() was before reinit(), on the same mesh with cells on
     * any ranks, rows start from the pressures that they had themselves. From
     * detect() on pressure(), status() and pair_results() report it, until
     * there is a solve. */
    virtual void set_pressure(const la::VectorView &pressure);

    /** Accept the step that has been solved: its pressures, states and the
     * penalty reached are what rollback() returns to and save() writes. To be
     * called once per load or time step, at its @p displacement. */
    virtual void commit(const la::VectorView &displacement);

    /** Give up the step since commit(), as if it had never been tried: the next
     * detect(), which must follow, begins with what was committed, or with
     * pressure 0 if nothing was. On another mesh than that of commit(), values
     * given to set_pressure() count as committed. Preconditioners may be those
     * of the step given up: with iterative solvers the same answer within their
     * tolerance. */
    virtual void rollback();

    /** Write what was committed to @p stream of rank 0, binary; streams of
     * other ranks are not touched. Preconditioners are built again after it, so
     * that this run goes on as one does that calls load(). Throws HistoryError.
     */
    virtual void save(std::ostream &stream);

    /** Begin with what save() wrote, read from @p stream of rank 0: it counts
     * as committed. Call after reinit() and before detect(), with the same mesh
     * and pairs; of pairs the number of ranks may be another, rows on single
     * unknowns of an obstacle need the same numbers of unknowns. With friction
     * call set_committed(), too: without it detect() throws. Throws
     * HistoryError, and nothing changes, for anything else. */
    virtual void load(std::istream &stream);

    /** Write into a stream of each rank, binary, what its preconditioner was
     * built for, so that a run that goes on from save() with the same matrix
     * and ranks does so bit by bit. Not collective. */
    virtual void save_preconditioner(std::ostream &stream) const;

    /** Build that preconditioner with the next solve(), unless that has other
     * rows. Call before detect() and, with load(), after it. Throws
     * HistoryError for streams of anything else. Collective. */
    virtual void load_preconditioner(std::istream &stream);

    /** Set the configuration that slips are measured from, and in which points
     * of updated kinematics are made, on a new mesh: the displacement of the
     * last commit(), with prescribed values as they were then, brought to this
     * mesh. Needed after reinit() for pairs with friction and for updated
     * kinematics only, and after load(). Collective. */
    virtual void set_committed(const la::VectorView &displacement);

    /** Add the couplings that add() needs: those of all rows, in contact or
     * not. Rows on single unknowns, as those of a membrane's obstacle, need
     * none. The pattern must take rows of other ranks, and be distributed
     * afterwards. Not collective. */
    virtual void add_to_sparsity(dealii::DynamicSparsityPattern &pattern) const;

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

    /** One linearised step with contact: returns the increment of the
     * displacement, already damped where the method requires it. @p tangent is
     * the matrix, which is not changed, or a HostOperator. The latter is solved
     * by conjugate gradients with its own preconditioner, and throws for what
     * needs a matrix: Nitsche's method, saddle points, points that move, and
     * solvers that are not iterative. Throws when the linear solver fails. */
    virtual LinearReport solve(const Tangent &tangent,
                               const la::VectorView &residual,
                               const la::MutableVectorView &increment);

    /** For hosts with a linear solver of their own: add the condensed contact
     * terms to @p matrix and @p residual, so that matrix increment =
     * -residual is the step with contact; then call update(). With friction the
     * matrix is not symmetric any more: use a solver for nonsymmetric matrices.
     * Throws for laws with true constraints (lagrange), for interior point and
     * for nitsche, which need solve(). */
    virtual void add(const la::MatrixTarget &matrix,
                     const la::MutableVectorView &residual);

    /** The contact problem of one linearisation, from the displacement of the
     * last detect() or linearise() to its end, for hosts with a Newton loop of
     * their own: solve() and update() in turn, by products with the one
     * @p tangent. @p residual is that of the displacement where it began; @p
     * step becomes the whole way from there, hanging nodes and all. reason()
     * reports whether it has an answer. Assemble, call this, shorten the step
     * if you must, and linearise() where you have gone. */
    virtual LinearReport solve_linearised(const Tangent &tangent,
                                          const la::VectorView &residual,
                                          const la::MutableVectorView &step);

    /** Set the displacement after the step; advances active set, multipliers
     * and parameters. Returns whether another step is needed; if not, reason()
     * reports the cause. */
    virtual bool update(const la::VectorView &displacement);

    /** Add the present contact forces sum w p B to @p forces: in equilibrium
     * they are the residual R at unknowns that are free. Throws for nitsche.
     */
    virtual void add_contact_forces(const la::MutableVectorView &forces) const;

    /** Data of contact for a line search at @p displacement, without a step of
     * the iteration: writes the forces of the present pressures into
     * @p forces, as add_contact_forces() adds them, and returns how far
     * pressures and the gaps there are from the law,
     * \f$ (\sum w s r^2)^{1/2} \f$, root of an energy. In rows that are closed
     * r is the residual of the current linearisation of the law as a length,
     * else the penetration. 0 where the problem is solved. After the first
     * solve(); not for `nitsche`. */
    virtual double evaluate(const la::VectorView &displacement,
                            const la::MutableVectorView &forces) const;

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

    /** The unknowns of this rank that may take part in contact: those of all
     * rows of the last detect(), in contact or not, on both sides; hanging
     * nodes by their parents. Whoever moves mass away from contact nodes must
     * do it there. */
    virtual dealii::IndexSet candidate_nodes() const;

    /** Why the iteration stopped. Not collective. */
    virtual abut_reason reason() const;

    /** The reason in words: what to try, and what was seen. Not collective.
     */
    virtual std::string explanation() const;

    /** The known failure behind reason(), or CYCLE where the iteration
     * converged only by changing rows one by one. Not collective. */
    virtual abut_failure failure() const;

    /** State of the iteration. Not collective. */
    virtual abut_progress progress() const;

    /** Number of rows on all ranks. */
    virtual dealii::types::global_dof_index n_rows() const;

    /** Number of rows on this rank: it owns their secondary nodes. Not
     * collective. */
    virtual unsigned int n_own_rows() const;

    /** Number of rows in contact on all ranks: in the present active set, or
     * for interior methods those with pressure / stiffness > gap. */
    virtual dealii::types::global_dof_index n_active() const;

    /** Membrane: the contact force on the lower obstacle minus that on the
     * upper. Pairs: the sum of the magnitudes of the normal forces of all rows
     * that are not ties; see pair_results() for vectors. */
    virtual double contact_force() const;

    /** sum w |p g| / sum w |p|: mean gap under pressure, length. */
    virtual double complementarity() const;

    /** Estimate, in the norm of the strain energy, of what the law leaves open:
     * (sum w s r^2)^(1/2) with the local stiffness s of a row (pressure per
     * length) and the natural residual r = min(g, p / s) of 0 <= p _|_ g >= 0
     * (ties: g, stick: the slip). Penetration of penalties, pressure across
     * gaps of barriers; 0 for exact multipliers. Valid after the first solve().
     */
    virtual double complementarity_error() const;

    /** With updated kinematics: how far closed rows go in the step to
     * @p displacement, by pair. A host halves steps in which surfaces slide by
     * more than half a facet, or rotate by more than 5 degrees: points are
     * those of its beginning. To be called after the solve and before commit().
     * Where partners stay: how far they have slid in all. Collective. */
    virtual std::vector<StepMotion>
    step_motion(const la::VectorView &displacement) const;

    /** Number of searches for points between surfaces on this mesh. */
    struct PointCount
    {
      unsigned int finds = 0; /**< by detect(), or by points that move */
      /** Number of these that kept the points of the previous one: nothing they
       * depend on had changed, or, with updated kinematics, surfaces had moved
       * against each other by less than a hundredth of a facet. */
      unsigned int kept = 0;
    };
    /** Counts on the mesh of the last reinit(). O(1). */
    virtual PointCount point_count() const;

    /** Effort of the search for surfaces that may touch, so far, and changes of
     * contact elements since the last commit(). Collective. */
    virtual DetectionReport detection_report() const;

    /** Changes of partners that evaluate() has found since the last
     * linearise(). Collective. */
    virtual PartnerChanges partner_changes() const;

    /** Largest penetration max(0, -g), length. */
    virtual double penetration() const;

    /** Membrane: nodal pressure, positive on the lower obstacle, negative on
     * the upper, 0 where there is no row (hanging nodes: distribute your
     * hanging-node constraints).
     *
     * Pairs: the vector p n at the nodes of the secondary surface, where -p n
     * is the force per area on it, so that it can be interpolated to another
     * mesh; for ties likewise with the shear. Hanging nodes have the value of
     * their parents. No ghosts. */
    virtual la::Vector pressure() const;

    /** Nodal gap to the nearer obstacle, 0 where there is no row. Pairs: in
     * each of the first dim components. */
    virtual la::Vector gap() const;

    /** Pairs with friction: how far what is in contact has come along the other
     * side since the last commit(), as a vector at the nodes of the secondary
     * surface, 0 elsewhere; hanging nodes as in pressure(). */
    virtual la::Vector slip() const;

    /** 1 on the lower, 2 on the upper obstacle, 0 open, -1 without a row.
     * Pairs: 1 in contact, in each of the first dim components. */
    virtual la::Vector status() const;

    /** Forces out of balance after a step, as a part of the contact forces: the
     * norm of @p residual (internal minus external forces) minus the contact
     * forces of the present pressures, by the norm of the latter or @p least,
     * whichever is more. Not small: a linear solver has failed its promise. Not
     * for nitsche with theta other than 0, which is no balance of forces. */
    virtual double imbalance(const la::VectorView &residual,
                             double least) const;

    /** The same as a part of the load of the last iteration, or of the contact
     * forces if these are more; 0 where there is no such balance. About 2 where
     * the residual has the wrong sign. */
    virtual double imbalance(const la::VectorView &residual) const;

    /** Size of the products of the entries of @p tangent with @p displacement
     * one by one, before they cancel: no solver lowers residuals beyond the
     * round-off of it. Where points move, with a thousandth of the coordinates,
     * for the round-off of positions. 0 without a matrix. Collective. */
    virtual ForceSize size_of_forces(const Tangent &tangent,
                                     const la::VectorView &displacement) const;

    /** Findings of detect() on each pair; empty without pairs. Not collective.
     */
    virtual std::vector<PairCheck> pair_checks() const;

    /** Forces, moments and extremes on each pair; empty without pairs. */
    virtual std::vector<PairResult<dim>> pair_results() const;

    /** By pair: which part of the force of a uniform pressure the rows hand to
     * wrong nodes of the primary surface, in [0, 1]. Round-off for mortar; for
     * node to segment and quadrature points an error of the contact pressure
     * that refinement does not lower. 0 against obstacles. To be called after
     * detect(), which it costs as much as. */
    virtual std::vector<double>
    transfer_errors(const la::VectorView &displacement) const;

    /** Search the bodies displaced by @p displacement, without regard to
     * rows, for points of secondary surfaces that are inside the other body (or
     * obstacle) by more than @p tolerance, length > 0, although they have no
     * row: nodes of the secondary, and facets of it without rows that hold a
     * node of the primary; with updated kinematics also what has come through
     * the other side since the last commit(), on straight ways, and is outside
     * of it again. To be called after convergence; if something is found, call
     * detect() with this displacement, whose reach follows the motion, and
     * solve on. Nodes of the primary between rows are no misses: no search
     * helps against them, see PairResult::between_rows. The same list on all
     * ranks; empty without pairs. As costly as detect(). */
    virtual std::vector<Penetration<dim>>
    check_penetration(const la::VectorView &displacement, double tolerance);

    /** Look at the answer at @p displacement for what the iteration cannot see:
     * strains that are not small (a warning from 5 %, an error from 50 %, or
     * from a third in the mean of a body, unless @p allow_large_strain),
     * surfaces that slide by more than a facet, obstacles that pass between
     * nodes, are narrower than facets or in the inside of bodies, penetrations
     * compared with the deformation of bodies, and, if
     * @p residual is given (of the host, at @p displacement), forces out of
     * balance, as after a residual of wrong sign. Whatever contradicts itself
     * by more than a tenth is an error. Measures go into pair_results(), too.
     * To be called after convergence and check_penetration(), once per load
     * step; distances of obstacles are evaluated at points of the facets near
     * them, of a membrane in all its cells. Throws ObstacleError for formulas
     * without a value there. Where nothing can touch it only looks at strains.
     * Collective. */
    virtual ContactExamination examine(const la::VectorView &displacement,
                                       const la::VectorView &residual = {},
                                       bool allow_large_strain = false);

    /** How deep obstacles are in what has no contact, by active cell of this
     * rank: the depth at facets without contact, or of a membrane in cells
     * without; and where there is contact, the depth of an obstacle that no
     * node sees, if that is more than a tenth of the deformation of bodies.
     * Error estimates that only look at nodes do not see it. 0 elsewhere.
     * Resizes @p depth; returns the largest on all ranks. See examine().
     * Collective. */
    virtual double missed_depth(const la::VectorView &displacement,
                                dealii::Vector<float> &depth);

    /** Look for rigid motions that neither @p tangent nor any row resists, be
     * it open or closed: then there is no answer, however small the load steps.
     * With the @p residual at displacement 0, internal minus external forces,
     * only those along which loads do work. Throws SolverFailure, which names
     * body and motion. Call after detect(); one pass over a matrix, or one
     * product of a host and one for each rigid motion. Does nothing for
     * membranes. Collective. */
    virtual void check_supports(const Tangent &tangent,
                                const la::VectorView &residual = {}) const;

    /** Repeat the search with a larger reach, for bodies without supports whose
     * motion no row stops: ABUT-F12 and ABUT-F42 of an iteration. Pairs with a
     * reach of their own keep it. Does what detect() does with the states and
     * pressures of the last commit(), and returns true if there are more rows
     * then; false after three times, or if points are made in each step.
     * Collective. */
    virtual bool search_farther(const la::VectorView &displacement);

    /** Data about the surfaces of pairs that this rank has sent since
     * construction, and that it has now. Not collective. */
    virtual CommunicationReport communication() const;

    /** Cost of all linear solves since the last reinit(). */
    virtual const LinearReport &linear_report() const;

    /** How deep the law itself lets the present pressures press the bodies into
     * each other, length >= 0: the largest p / eps of laws with a penalty, and
     * the penetration allowed. 0 for exact and interior laws, and for
     * multipliers that an outer iteration has brought to their end. */
    virtual double allowed_penetration() const;

    /** Add what contact does at unknowns that are prescribed, where
     * add_contact_forces() has nothing: the pressures' forces there, hanging
     * nodes by their parents. The rest of a support's reaction balances all
     * other loads on the body. Nothing for membranes, which have no contact
     * there; for nitsche that of its pressures. Collective. */
    virtual void
    add_forces_on_supports(const la::MutableVectorView &forces) const;

    /** Add the forces of pairs at all unknowns, be they prescribed or not, as
     * far as they are those of pressures: with friction, without the forces
     * along the surfaces. Hanging nodes by their parents. Nothing for
     * membranes; for nitsche that of its pressures. Collective. */
    virtual void add_pressure_forces(const la::MutableVectorView &forces) const;

    /** The tangent with Abut's own copy of a matrix that is of another type, as
     * it is now and until the next call with a matrix; any other one as it is.
     * Collective. */
    virtual Tangent copy_of(const Tangent &tangent) const;

    /** A vector of Abut's type with the values of @p vector. Collective. */
    virtual la::Vector copy_of(const la::VectorView &vector) const;

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

    /** examine() with the address of the residual, which may be null. */
    ContactExamination examine(const la::VectorView &displacement,
                               const la::Vector *residual,
                               const bool allow_large_strain = false)
    {
      return examine<la::Vector>(displacement, residual, allow_large_strain);
    }

    /** The same for a residual of another type. */
    template <typename V>
    ContactExamination examine(const la::VectorView &displacement,
                               const V *residual,
                               const bool allow_large_strain = false)
    {
      return residual == nullptr
                 ? examine(displacement, la::VectorView(), allow_large_strain)
                 : examine(displacement, la::VectorView(*residual),
                           allow_large_strain);
    }

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;

    friend struct StudyAccess; ///< tests/solve/inf_sup_study.cc
  };
} // namespace abut

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CONTACT_PROBLEM_H
#define ABUT_SHIM_CONTACT_PROBLEM_H

#include "committed_state.h"
#include "contact_history.h"
#include "contact_host.h"
#include "contact_scales.h"
#include "gap_raises.h"
#include "handles.h"
#include "moving_rows.h"
#include "nitsche_rows.h"
#include "residual_check.h"
#include "row_source.h"
#include "solve/local_elimination.h"
#include "solve/row_solver.h"
#include "start_values.h"
#include "surface_rows.h"

#include <abut/dealii/contact_assembler.h>

#include <map>
#include <optional>

namespace abut::shim
{
  template <int dim> struct ContactProblem;

  template <int dim>
  std::unique_ptr<ContactResults<dim>>
  make_results(const ContactProblem<dim> &problem);
  template <int dim>
  std::unique_ptr<ContactChecks<dim>> make_checks(ContactProblem<dim> &problem);
  template <int dim>
  std::unique_ptr<ContactState> make_state(ContactProblem<dim> &problem);

  /** See ContactChecks::examine(). */
  template <int dim>
  ContactExamination
  examine(ContactProblem<dim> &problem, const la::VectorView &displacement,
          const la::VectorView &residual, bool allow_large_strain);

  /** Input of a host. */
  template <int dim> struct ContactInput
  {
    Obstacle<dim> obstacle;
    std::vector<ContactPair<dim>> pairs;
    bool has_pairs = false; ///< they were given, and may be empty
    bool axisymmetric = false;
    std::vector<std::string> body_names;
    MethodParameters method;
    SearchParameters search;
    SolverParameters solver;
    bool constant_matrix = false;

    /** Whether the law needs the normal stress of the bodies. */
    bool is_nitsche() const
    {
      return abut_law_needs_stress(method.options.law);
    }

    /** Whether a commit() determines where the next points are made. */
    bool makes_points_at_commits() const
    {
      return kinematics_info(method.kinematics).points
             == ABUT_CONFIGURATION_COMMITTED;
    }
  };

  /** Surfaces of pairs, and what it took to find which may touch. */
  template <int dim> struct SurfaceSearch
  {
    /** The facets of pairs on this mesh, once they are found. */
    std::shared_ptr<SurfaceExchange<dim>> exchange;
    CommunicationReport sent_before; ///< on earlier meshes
    bool has_new_gaps = false;       ///< of pairs that are otherwise the same
    DetectionReport detection;
    ContactElements elements;
    /** How far rigid motions are foreseen to go, for searches. */
    double foreseen_motion = 0.;
  };

  /** Rows of the last detect(), or where points have moved to. */
  struct PresentRows
  {
    bool are_found = false; ///< since reinit(), by detect()
    Handle<abut_points> points;
    int dimension = 0;             ///< unknowns of the points' nodes
    std::uint64_t points_mesh = 0; ///< signature of the points' mesh
    std::uint64_t mesh = 0;        ///< signature of the rows' mesh; 0: no rows
    std::uint64_t signature = 0;   ///< of values, but for gaps
    solve::PointOperator coefficients; ///< B, by component of the points
    dealii::types::global_dof_index n_rows = 0; ///< on all ranks
    std::vector<PlacedRow> placed;
    std::vector<double> gap;   ///< [rows] at the current displacement
    bool has_friction = false; ///< some pair has, on all ranks
    RowSource::SlipReference slip_reference;
    /** Normals of points with friction that close later in the step than the
     * first of their pair. */
    std::vector<std::int32_t> late;
    /** [rows] place of a row's own derivatives in those of the request. */
    std::vector<std::int64_t> diagonal;

    /** [rows] */
    std::vector<std::int64_t> numbers() const
    {
      return {coefficients.ids(), coefficients.ids() + coefficients.n_rows()};
    }
  };

  /** Linear systems with rows. */
  struct RowSystem
  {
    /** Null until the first solve with the present rows. */
    std::unique_ptr<solve::RowSolver> solver;
    bool has_matrix = true;        ///< or it is of a host without one
    bool has_new_matrix = false;   ///< since the last solve
    double tolerance = 0.;         ///< of the iteration; 0: the method's
    bool was_added = false;        ///< by add(): the host solves
    solve::LocalElimination local; ///< of rows that are added to a matrix
    mutable std::optional<solve::NearNullSpace> bodies; ///< none: not made
    /** State that a preconditioner to be built again was built for, with the
     * signature of its rows; empty: none. */
    std::vector<solve::PreconditionerState> kept_preconditioner;
    std::uint64_t kept_rows = 0;
    /** Rigid motions that the last iteration has left undetermined. */
    std::vector<solve::FreeMotion> undetermined;
    /** Rigid motions of bodies where points were last taken to. */
    std::vector<BodyMotion> followed_motions;
    LinearReport report; ///< since reinit()
  };

  /** The inside of a ContactAssembler: rows, start and strategy of one solve.
   * Where rows come from is the business of a row source. */
  template <int dim> struct ContactProblem
  {
    explicit ContactProblem(const MPI_Comm communicator)
        : communicator(communicator), host(communicator)
    {
      // Options without a law are those of lagrange.
      input.method.options.law = abut_law_find("lagrange");
    }

    void check(const abut_status status) const;
    /** The same after a call that evaluates the law: a user's own law may
     * fail, and a smaller load step may help. */
    void check_law(const abut_status status) const;
    /** Names of pairs that nothing of can touch, though it should. */
    std::vector<std::string> pairs_without_rows() const;
    /** Warn if the displacement of the last commit() does not belong to the
     * pressures that were committed. Collective. */
    void check_committed();
    /** The source of the present rows; throws if there is none. */
    const RowSource &present_source() const;
    /** As ContactHost::check_mesh(), and throw unless there are rows. */
    void check_rows(const std::string &call) const;
    /** The same for an argument of that call, see ContactHost::vector(). */
    const la::Vector &given(const std::string &call, const std::string &what,
                            const la::VectorView &vector) const
    {
      check_rows(call);
      return host.vector(call, what, vector);
    }
    void create_source();
    /** Forget the mesh. */
    void clear_source();
    /** Find rows, with a larger reach where bodies without supports have no row
     * otherwise. */
    void find_rows_in_reach(const la::Vector &displacement);
    /** Let the source find points. Collective. */
    RowSource::Change find_points(const la::Vector &displacement);
    /** Make all that belongs to new points. Collective. */
    void set_up_rows();
    /** Take out the rows of points, just made, that need none, and make the
     * operator of the others. @p elsewhere: the points if they are not those of
     * the source. Collective. */
    solve::PointOperator make_operator(abut_points *made,
                                       PairPoints<dim> *elsewhere = nullptr);
    /** Make what has been reached the trial version of the history. */
    void record_present();
    /** The present rows, for start values. */
    StartRows start_rows() const;
    /** Take up the penalty that was reached on other ranks. */
    void go_on_with_penalty(abut_strategy_options &options);
    /** Forget an iteration without its result. */
    void abandon_iteration();
    /** The same, and begin again with the trial version. */
    void return_to_history();
    /** Gaps, and slips since the last commit(). */
    void compute_gap(const la::Vector &displacement);
    /** Find the reference of slips, with the present points. Collective. */
    void find_slip_reference();
    /** Find which pairs pressed at the last commit(), by the start values of
     * the first detect() since. Collective. */
    void find_pressed();
    /** Note what bodies move before pairs touch, which is no slip. Collective.
     */
    void add_approach(const std::vector<solve::RigidMotion> &motions,
                      const std::vector<std::uint8_t> &is_apart);
    /** Forget such motions where @p displacement has not gone that way.
     * Collective. */
    void check_approach(const la::Vector &displacement)
    {
      committed.check_approach(displacement, [this](const auto &motions)
                               { return displacement_of(motions); });
    }
    /** A motion on the present mesh. */
    la::Vector
    displacement_of(const std::vector<solve::RigidMotion> &motions) const;
    /** The gap as the law wants it. */
    const double *law_gap();
    /** Make what has been reached the start of the next iteration. */
    void start_from_present();
    void begin_at(const la::Vector &displacement);
    /** Whether rows are where the bodies are. */
    bool moves() const;
    /** Pressures and states by the numbers of the rows. */
    RowValues row_values() const;
    /** Make rows at this displacement, which start from what those of the same
     * number have had. Collective. */
    void move_rows(const la::Vector &displacement, const RowValues &before);
    /** Take the rows to this displacement, if they are the same there.
     * Collective. */
    void follow(const la::Vector &displacement);
    /** Find the change of the forces of the rows' pressures because rows move.
     * Collective. */
    void find_geometry();
    /** Gaps where the iteration has come to. Collective. */
    void update_gap(const la::Vector &displacement);
    /** See ContactAssembler::evaluate(), with rows of that displacement.
     * Collective. */
    double evaluate_moved(const la::Vector &displacement, la::Vector &forces);
    /** Find what an iteration that stopped leaves undetermined. Collective. */
    void record_end();
    /** Let the search reach farther, as far as bodies without supports may
     * have to move. Returns whether it does. Collective. */
    bool widen_search();
    void begin(const solve::Stiffness &matrix, const la::Vector &residual);
    /** Made once for each mesh. Collective. */
    const solve::NearNullSpace &near_null_space() const;
    void prepare_solver(const solve::Stiffness &matrix);
    void push_inside(la::Vector &displacement);
    void next();
    /** Pressures and states reached, or those to start from. */
    double row_pressure(int row) const;
    std::vector<double> row_pressures() const;
    /** Add the forces of the rows' pressures. */
    void add_forces(la::Vector &forces) const;
    /** The same, but throw for a law whose forces are not these alone. */
    void add_forces_of_law(la::Vector &forces) const;
    abut_progress progress() const;
    std::vector<std::uint8_t> row_states() const;
    /** How far a row's pressure and a gap are from the law, length. */
    double law_defect(int row, double gap_there) const;
    const MPI_Comm communicator;
    ContactInput<dim> input;
    /** Before all that is made with it, and so destroyed after it. */
    Handle<abut_context> context = create_context();
    ContactHost<dim> host;

    std::unique_ptr<RowSource> source;
    /** The same object if it makes rows of pairs, else null. */
    SurfaceRows<dim> *surfaces = nullptr;
    bool source_is_outdated = true;
    SurfaceSearch<dim> surface_search;
    PresentRows rows;
    NitscheRows<dim> nitsche{context.get()};
    MovingRows moving;
    GapRaises<dim> raises{*this};
    ContactScales<dim> scales{*this};
    RowSystem system;
    ResidualCheck<dim> residual_check{host};

    ContactHistory history{context.get(), communicator};
    ContactHistory::Penalty penalty; ///< of this iteration
    CommittedState<dim> committed;
    StartValues start;
    la::Vector start_displacement;
    la::Vector present_displacement; ///< of the last update()
    Handle<abut_strategy> strategy;
    bool is_started = false;
    abut_request request = {};

    const std::unique_ptr<ContactResults<dim>> results = make_results(*this);
    const std::unique_ptr<ContactChecks<dim>> checks = make_checks(*this);
    const std::unique_ptr<ContactState> state = make_state(*this);
  };
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CONTACT_IMPLEMENTATION_H
#define ABUT_SHIM_CONTACT_IMPLEMENTATION_H

#include "committed_state.h"
#include "contact_history.h"
#include "contact_host.h"
#include "gap_raise.h"
#include "handles.h"
#include "moving_rows.h"
#include "nitsche_rows.h"
#include "row_source.h"
#include "solve/local_elimination.h"
#include "solve/row_solver.h"
#include "start_values.h"
#include "surface_rows.h"

#include <abut/dealii/contact_assembler.h>

#include <map>
#include <optional>

namespace abut
{
  /** The inside of a ContactAssembler: rows, start and strategy of one solve.
   * Where rows come from is the business of a row source. */
  template <int dim> struct ContactAssembler<dim>::Implementation
  {
    explicit Implementation(const MPI_Comm communicator)
        : communicator(communicator), host(communicator)
    {
      // Options without a law are those of lagrange.
      method.options.law = abut_law_find("lagrange");
    }

    void check(const abut_status status) const;
    /** The same after a call that evaluates the law: a user's own law may
     * fail, and a smaller load step may help. */
    void check_law(const abut_status status) const;
    /** The source of the present rows; throws if there is none. */
    const shim::RowSource &present_source() const;
    /** As ContactHost::check_mesh(), and throw unless there are rows. */
    void check_rows(const std::string &call) const;
    void create_source();
    /** Keep the counts of an exchange that is about to go. */
    void count_messages();
    /** Forget the mesh. */
    void clear_source();
    void find_rows(const la::Vector &displacement);
    /** The same, with a larger reach where bodies without supports have no row
     * otherwise. */
    void find_rows_in_reach(const la::Vector &displacement);
    /** Let the source find points. Collective. */
    shim::RowSource::Change find_points(const la::Vector &displacement);
    /** Make all that belongs to new points. Collective. */
    void set_up_rows();
    /** Take out the rows of points, just made, that need none, and make the
     * operator of the others. @p elsewhere: the points if they are not those of
     * the source. Collective. */
    solve::PointOperator
    make_operator(abut_points *made,
                  shim::PairPoints<dim> *elsewhere = nullptr);
    /** Make what has been reached the trial version of the history. */
    void record_present();
    /** The present rows, for start values. */
    shim::StartRows start_rows() const;
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
    /** Note what bodies move before pairs touch, which is no slip. Collective.
     */
    void add_approach(const std::vector<solve::RigidMotion> &motions,
                      const std::vector<std::uint8_t> &is_apart);
    /** A motion on the present mesh. */
    la::Vector
    displacement_of(const std::vector<solve::RigidMotion> &motions) const;
    /** Give the strategy its data of friction. Collective. */
    void set_friction();
    /** Whether the law needs the normal stress of the bodies. */
    bool is_nitsche() const;
    /** The gap as the law wants it. */
    const double *law_gap();
    void set_scales(const solve::Stiffness &matrix, const la::Vector &residual);
    /** Length scale of the present iteration. Collective. */
    double length_scale() const;
    /** The same, or 0 where nothing has moved and all gaps are 0. Collective.
     */
    double measured_length() const;
    double unmeasured_length() const;
    /** See ContactAssembler::length_scale(). Collective. */
    double length_scale(const la::Vector &displacement) const;
    /** Find the local stiffness of the rows in a new matrix, which is that of
     * the law only if it is the first one: a law must not change from one
     * linearisation to the next. Collective. */
    void find_row_stiffness(const solve::Stiffness &matrix);
    /** Length by pressure: inverse mean of the rows' stiffness. */
    double softness() const;
    /** Make what has been reached the start of the next iteration. */
    void start_from_present();
    void begin_at(const la::Vector &displacement);
    /** Whether rows are where the bodies are. */
    bool moves() const;
    /** Whether a commit() determines where the next points are made. */
    bool makes_points_at_commits() const
    {
      return kinematics_info(method.kinematics).points
             == ABUT_CONFIGURATION_COMMITTED;
    }
    /** Pressures and states by the numbers of the rows. */
    shim::RowValues row_values() const;
    /** Make rows at this displacement, which start from what those of the same
     * number have had. Collective. */
    void move_rows(const la::Vector &displacement,
                   const shim::RowValues &before);
    /** Take the rows to this displacement, if they are the same there.
     * Collective. */
    void follow(const la::Vector &displacement);
    /** Another set of points, by the operator of its rows. */
    struct RowsElsewhere
    {
      shim::Handle<abut_points> points;
      solve::PointOperator rows;
      shim::RowSource::SlipReference slip_reference;
    };
    /** The rows at this displacement, while the present ones stay. Collective.
     */
    RowsElsewhere rows_at(const la::Vector &displacement);
    /** Find the change of the forces of the rows' pressures because rows move.
     * Collective. */
    void find_geometry();
    /** How gaps change because directions and partners do. Collective. */
    void find_substitution();
    /** Gaps where the iteration has come to. Collective. */
    void update_gap(const la::Vector &displacement);
    /** Add the part of the coordinates that stands for the round-off of gaps
     * and strains at points that move. Not collective. */
    void add_round_off_of_positions(la::Vector &displacement) const;
    /** See ContactAssembler::evaluate(), with rows of that displacement.
     * Collective. */
    double evaluate_moved(const la::Vector &displacement, la::Vector &forces);
    /** See ContactAssembler::raise_gaps(). Collective. */
    bool raise_gaps(const la::Vector &displacement);
    /** See ContactAssembler::limit_raises(). Collective. */
    bool limit_raises(const la::Vector &displacement);
    /** Whether that has stopped before all such rows were open. */
    bool raises_end_early() const;
    /** From how far on surfaces are apart for that, length. Collective. */
    double least_clearance(const la::Vector &displacement) const;
    /** Whether a row of a normal has a pressure. */
    bool presses(int row) const;
    /** Add to the gaps [rows] of some operator what they are raised by. */
    void add_raises(const solve::PointOperator &rows,
                    std::vector<double> &gaps) const;
    /** Data of the iteration that begins, for the solver. */
    solve::ContactIteration iteration();
    /** Find what an iteration that stopped leaves undetermined. Collective. */
    void record_end();
    /** Let the search reach farther, as far as bodies without supports may
     * have to move. Returns whether it does. Collective. */
    bool widen_search();
    void begin(const solve::Stiffness &matrix, const la::Vector &residual);
    /** Throws if a matrix is needed. */
    void check_host() const;
    /** Made once for each mesh. Collective. */
    const solve::NearNullSpace &near_null_space() const;
    void prepare_solver(const solve::Stiffness &matrix);
    /** Build the preconditioner that was loaded, if there is one. */
    void restore_preconditioner();
    void push_inside(la::Vector &displacement);
    void next();
    /** Pressures and states reached, or those to start from. */
    double row_pressure(int row) const;
    std::vector<double> row_pressures() const;
    std::vector<std::int64_t> row_numbers() const;
    /** Add the forces of the rows' pressures. */
    void add_forces(la::Vector &forces) const;
    std::vector<std::uint8_t> row_states() const;
    /** Where obstacles are between the nodes. Collective. */
    std::vector<shim::FacetPenetration>
    find_facet_penetrations(const la::Vector &displacement);
    void examine_membrane(const la::Vector &displacement, double penetration,
                          ContactExamination &result);
    /** Length that depths are compared with: how far bodies are deformed, or
     * the membrane is moved. Collective. */
    double deformation(const la::Vector &displacement) const;
    /** Penetration that the law is meant to have, length. */
    double soft_on_purpose() const;
    /** How far a row's pressure and a gap are from the law, length. */
    double law_defect(int row, double gap_there) const;
    const MPI_Comm communicator;
    Obstacle<dim> obstacle;
    std::vector<ContactPair<dim>> pairs;
    bool has_pairs = false; ///< they were given, and may be empty
    bool axisymmetric = false;
    MethodParameters method;
    SearchParameters search;
    SolverParameters solver_parameters;
    bool constant_matrix = false;
    double given_length = 0.; ///< 0: none

    /** Before all that is made with it, and so destroyed after it. */
    shim::Handle<abut_context> context = shim::create_context();

    shim::ContactHost<dim> host;
    std::unique_ptr<shim::RowSource> source;
    /** The same object if it makes rows of pairs, else null. */
    shim::SurfaceRows<dim> *surfaces = nullptr;
    /** The facets of pairs on this mesh, once they are found. */
    std::shared_ptr<shim::SurfaceExchange<dim>> exchange;
    CommunicationReport sent_before; ///< on earlier meshes
    DetectionReport detection;
    shim::ContactElements elements;
    bool source_is_outdated = true;
    bool has_new_gaps = false; ///< of pairs that are otherwise the same
    mutable std::optional<solve::NearNullSpace> bodies;
    std::uint64_t points_mesh = 0; ///< signature of the points' mesh
    bool has_rows = false;         ///< since reinit(), by detect()

    shim::Handle<abut_points> points; ///< of the last detect()
    int points_dimension = 0;         ///< unknowns of their nodes
    shim::Handle<abut_strategy> strategy;
    solve::PointOperator coefficients; ///< B, by component of the points
    dealii::types::global_dof_index n_rows = 0;

    shim::NitscheRows<dim> nitsche{context.get()};

    shim::ContactHistory history{context.get(), communicator};
    shim::StartValues start;
    std::uint64_t rows_mesh = 0; ///< signature of the rows' mesh; 0: no rows
    std::vector<shim::PlacedRow> placed_rows; ///< of the rows
    shim::ContactHistory::Penalty penalty;    ///< of this iteration
    la::Vector start_displacement;
    shim::MovingRows moving;
    std::vector<double> gap;   ///< [rows] at the current displacement
    bool has_friction = false; ///< some pair has, on all ranks
    shim::CommittedState<dim> committed;
    shim::RowSource::SlipReference slip_reference;
    shim::GapRaises raises;
    /** [rows] place of a row's own derivatives in those of the request. */
    std::vector<std::int64_t> diagonal;
    /** Compliance of each unknown of this rank, in the matrix that penalties
     * are multiples of; empty: none yet. */
    la::Vector law_compliance;
    /** [rows] pressure per length, > 0: of each row in the last matrix taken,
     * for solvers; and in that of law_compliance, as the law has it, by patches
     * of surface. */
    std::vector<double> row_stiffness, stiffness;
    double smallest_residual = 0.;
    /** Sums of magnitudes at nodes: of the present solve, and the largest of
     * those that ended in a committed state. */
    double present_load = 0., committed_load = 0.;
    /** Rigid motions that the last iteration has left undetermined. */
    std::vector<solve::FreeMotion> undetermined;
    /** Rigid motions of bodies where points were last taken to. */
    std::vector<BodyMotion> followed_motions;
    /** How far rigid motions are foreseen to go, for searches. */
    double foreseen_motion = 0.;
    double iteration_tolerance = 0.; ///< of linear systems; 0: the method's
    bool has_new_matrix = false;     ///< since the last solve

    solve::LocalElimination local; ///< of rows that are added to a matrix
    /** State that a preconditioner to be built again was built for, with the
     * signature of its rows; empty: none. */
    std::vector<solve::PreconditionerState> kept_preconditioner;
    std::uint64_t kept_rows = 0;

    /** Null until the first solve with the present rows. */
    std::unique_ptr<solve::RowSolver> solver;
    bool solver_has_matrix = true;    ///< or is one for hosts without
    std::uint64_t rows_signature = 0; ///< of the rows of the last detect()
    bool is_started = false;
    bool was_added = false; ///< by add(): the host solves
    abut_request request = {};
    LinearReport report;
  };
} // namespace abut

#endif

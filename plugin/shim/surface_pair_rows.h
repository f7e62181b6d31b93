// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SURFACE_PAIR_ROWS_H
#define ABUT_SHIM_SURFACE_PAIR_ROWS_H

#include "contact_elements.h"
#include "row_source.h"
#include "surface_exchange.h"
#include "surface_pair.h"

#include <abut/dealii/method_parameters.h>
#include <abut/dealii/surface_traction.h>
#include <abut/strategy.h>

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

namespace abut::shim
{
  /** Rows of a pair that press where its surfaces are apart. */
  struct SeparatedRows
  {
    double gap = 0.;             ///< largest distance, length
    double force = 0., all = 0.; ///< sums of these rows and of all that press
  };

  /** Points between surfaces of bodies, and of surfaces against rigid
   * obstacles, from the core's coupling. Values of rows, here and elsewhere,
   * are those of the points' components.
   *
   * The geometry is that of the reference configuration (displacement 0), so
   * that the gap is linear in the displacement, or, of pairs that move, that of
   * the displacement of find(), with weights of the reference; for corotational
   * pairs only directions and gaps are current. A point is on the rank that
   * owns its secondary node, or for quadrature points the facet's cell. Nodes
   * are those of the gathered surface. */
  template <int dim> class SurfacePairRows : public RowSource
  {
  public:
    /** Settings that do not depend on the pair. */
    struct Settings
    {
      MethodParameters method;
      SearchParameters search;
      bool axisymmetric = false;
    };

    /** All references must outlive this object. Throws ContactError for pairs
     * that make no sense. Each rank has the part of the surfaces that is near
     * its own part. @p exchange may be null. The effort of detection is added
     * to @p detection. Collective. */
    SurfacePairRows(const dealii::Mapping<dim> &mapping,
                    const dealii::DoFHandler<dim> &dof_handler,
                    const dealii::AffineConstraints<double> &constraints,
                    const std::vector<ContactPair<dim>> &pairs,
                    const Settings &settings, abut_context *context,
                    std::shared_ptr<SurfaceExchange<dim>> exchange,
                    DetectionReport &detection);

    /** The exchange of facets: to be given to the next object for the same
     * mesh, so that they need not be found again. */
    const std::shared_ptr<SurfaceExchange<dim>> &exchange() const
    {
      return exchange_;
    }

    int dimension() const override
    {
      return dim;
    }
    Change find(const la::Vector &displacement, abut_points *points) override;
    void drop_needless(std::vector<std::uint8_t> &keep) const override;

    void filter(const std::vector<std::uint8_t> &keep) override;
    bool moves() const override;
    std::vector<MatrixLine>
    geometric_lines(const double *row_pressure) const override;
    std::vector<solve::GapLine>
    gap_lines(const std::vector<std::uint8_t> &wanted) const override;

    /** Record the displacement of a commit(): bodies whose points move look for
     * each other as far as they have come since. */
    void record_commit(const la::Vector &displacement)
    {
      searched_from_ = moves() ? displacement : la::Vector();
      look_at_sides(displacement);
    }

    /** Sides of surfaces that touch themselves as a part of a checkpoint.
     * Collective. */
    void save_sides(std::ostream &stream) const
    {
      exchange_->self_contact().save(stream);
    }
    void load_sides(std::istream &stream);

    /** Give all components of a node of the surfaces their mean. */
    void make_isotropic(la::Vector &value) const;

    struct SavedPoints;
    /** Take the points of find() out, and put them back after another one. */
    SavedPoints save_points();
    void restore_points(SavedPoints kept);

    /** Take the gaps of @p pairs, which differ in nothing else from those given
     * before. */
    void set_gaps(const std::vector<ContactPair<dim>> &pairs);

    const solve::NodeMap &nodes() const override
    {
      return surface_.map;
    }

    /** Replace @p stress, of dimension 1, by what the stress of the bodies does
     * at the present points, which must be those of quadrature: the same rows
     * and weights, of the normal n.sigma n, of tangents -t.sigma n (minus the
     * pressure or traction that it would be), with the derivatives as
     * coefficients over the unknowns of the cells, each of which is a node of
     * the map returned. Throws on all ranks. Collective. */
    solve::NodeMap find_stress(const SurfaceTraction<dim> &traction,
                               abut_points *stress) const;

    std::uint64_t mesh_signature() const override;
    std::vector<PlacedRow> placed_rows() const override;
    FrictionalPoints friction() const override;
    SlipReference slip_reference(const la::Vector &committed) override;
    std::vector<double> row_pressure(const la::Vector &field) const override;
    la::Vector pressure(const double *row_pressure) const override;
    la::Vector gap(const double *row_gap) const override;
    la::Vector status(const std::uint8_t *row_state) const override;
    std::vector<std::uint8_t> relax(const Tangent &tangent,
                                    const la::Vector &residual,
                                    const std::vector<double> &gap,
                                    unsigned int n_sweeps,
                                    la::Vector &displacement) const override;
    std::vector<FacetPenetration>
    facet_penetrations(const la::Vector &displacement,
                       const std::uint8_t *row_state) override;
    void push_inside(const std::vector<double> &gap, std::vector<double> margin,
                     la::Vector &displacement) const override;

    /** Measure for results() slip and rotation at closed rows, errors of gaps,
     * and the result of facet_penetrations(). Collective. */
    void examine(const la::Vector &displacement, const double *row_pressure,
                 const double *row_gap, const std::uint8_t *row_state,
                 const std::vector<FacetPenetration> &facet_penetrations);

    /** Rows of pairs between bodies that press where these are apart, by the
     * last examine(). @p visible: [pairs] least distance, length. Collective.
     */
    std::vector<SeparatedRows> apart(const std::vector<double> &visible,
                                     const double *row_pressure,
                                     const double *row_gap,
                                     const std::uint8_t *row_state);

    /** [rows] How far apart surfaces are around the rows of mortar that moves:
     * the least gap, length, at nodes of both sides and at points of
     * integration, of the law; infinite for other rows. Collective. */
    std::vector<double> clearances(const la::Vector &displacement);

    using NarrowestWidth = ObstacleWidth;

    /** The obstacle of a pair where it is narrowest for the facets, by the last
     * examine(). */
    const NarrowestWidth &narrowest(std::size_t pair) const
    {
      return pairs_[pair].narrowest;
    }

    /** Width of the obstacle and size of the nearest facet, if the place of
     * the obstacle that is now at @p place came through that facet within the
     * present step, or was at it; infinite otherwise. Collective. */
    ObstacleWidth passed_between(std::size_t pair,
                                 const dealii::Point<dim> &place) const;

    /** Where PairResult::gap_error is, by the last examine(). */
    const dealii::Point<dim> &gap_error_place(const std::size_t pair) const
    {
      return pairs_[pair].gap_error_place;
    }

    /** Largest distance between a straight facet of a pair of bodies and its
     * curved manifold at a node of the other side in contact, as far as it is
     * more than @p least, length; else 0. Where meshes match it is 0 at all
     * nodes. Collective. */
    double chord_error(std::size_t pair, const std::uint8_t *row_state,
                       double least) const;

    /** Whether gaps of a pair are weighted means around its nodes. */
    bool has_mean_gaps(std::size_t pair) const
    {
      return discretisation_info(pairs_[pair].discretisation).is_weighted;
    }

    /** How deep nodes of the secondary that have rows are in the other side,
     * length >= 0, by the last penetrations(): rows of mortar hold them in the
     * mean of the facets around them alone. */
    double held_in_the_mean(std::size_t pair) const
    {
      return pairs_[pair].held_in_the_mean;
    }

    /** Why a pair would be refused but for
     * MethodParameters::solve_known_failures. */
    const std::vector<Message> &refused(std::size_t pair) const
    {
      return pairs_[pair].refused;
    }

    /** States to start from when a pair must hold a body: closed are the rows
     * with pressure, or those that touch. Empty if there is no such pair, or
     * rows have pressures. Collective.
     * @param pressure empty: 0
     * @param scale rows are closed where p - scale gap > 0
     * @param touching gap of rows that are closed in any case */
    std::vector<std::uint8_t> first_contact(const std::vector<double> &gap,
                                            const std::vector<double> &pressure,
                                            const std::vector<double> &scale,
                                            double touching) const;

    /** [rows] pair of each row. */
    std::vector<int> row_pairs() const;

    /** Whether points of a pair are made step by step (updated kinematics). */
    bool has_steps() const;

    /** Let facets be known that are near each other at @p displacement, so
     * that what is kept meanwhile by save_points() stays good. Collective. */
    void bring_in_reach(const la::Vector &displacement)
    {
      displacements_in_reach(displacement);
    }

    /** Search as though bodies had moved by @p length, >= 0, where pairs have
     * no reach of their own. Takes effect at find(). Not collective. */
    void foresee_motion(const double length)
    {
      foreseen_ = length;
      origins_.clear();
    }

    /** The elements of the present points, but for those whose numbers do not
     * last. Not collective. */
    ContactElements::Table contact_elements() const;

    /** Median of the secondary surfaces, that of the pair of the largest. */
    double facet_size() const
    {
      double size = 0.;
      for (const Pair &pair : pairs_)
        size = std::max(size, pair.secondary.everywhere.median);
      return size;
    }

    /** Where the obstacles of all pairs were at the last commit(), and their
     * times; empty: at the first step. */
    void set_committed_poses(const std::vector<RigidPose<dim>> &poses,
                             const std::vector<double> &times)
    {
      committed_poses_ = poses;
      committed_times_ = times;
    }

    /** Motion of bodies since then before pairs touched, which is no slip:
     * [pairs] displacements (owned; empty: none), or empty. */
    void set_approach(std::vector<la::Vector> approach)
    {
      approach_ = std::move(approach);
    }

    /** Where the bodies were at the last commit() (owned; empty: nothing has
     * moved), which must outlive its use here: find() makes the points of
     * updated kinematics there. */
    void set_place(const la::Vector &committed)
    {
      committed_ = &committed;
    }

    /** The next find() makes all points again. */
    void renew_points()
    {
      origins_.clear();
    }

    /** Calls of find() so far, and those of them that found the points of the
     * one before to be still good. */
    unsigned int n_finds() const
    {
      return n_finds_;
    }
    unsigned int n_kept() const
    {
      return n_kept_;
    }

    /** How far closed rows have gone from the places that they were made at.
     * Collective. */
    std::vector<StepMotion> step_motion(const la::Vector &displacement,
                                        const std::uint8_t *row_state);

    /** Findings of find(), by pair. */
    const std::vector<PairCheck> &checks() const
    {
      return checks_;
    }

    /** Results by pair for [rows] pressures, gaps and states (null: nothing
     * solved). Collective. */
    std::vector<PairResult<dim>> results(const double *row_pressure,
                                         const double *row_gap,
                                         const std::uint8_t *row_state) const;

    /** Add what friction did to results: tractions stand in the pressures of
     * the tangents' rows, slips since the last commit in their gaps.
     * Collective. */
    void add_friction(const double *row_pressure, const double *row_gap,
                      const std::uint8_t *row_state,
                      std::vector<PairResult<dim>> &results) const;

    /** PairResult::n_prescribed and prescribed_normal. Collective. */
    void find_prescribed_nodes(const std::uint8_t *row_state,
                               std::vector<PairResult<dim>> &results) const;

    /** Give the tangents of a point the value [rows] of its normal. */
    void copy_to_tangents(std::vector<double> &value) const;

    /** Forces of [rows] pressures at all unknowns, be they prescribed or not,
     * those of hanging nodes by their parents; @p forces is 0 before.
     * Collective. */
    void find_forces(const std::vector<double> &row_pressure,
                     la::Vector &forces) const;

    /** Whether some pair has rows at quadrature points. */
    bool has_points() const;

    /** Replace values at quadrature points [rows] by the nearest functions of
     * the secondary's shape functions, pair by pair, in the mean square over
     * the points; rows of nodes are left alone. Collective. */
    void project(double *value) const;

    /** Make a stiffness per area [rows] at quadrature points that of the nodes
     * around them: points with a small weight are not stiffer. Collective. */
    void spread_stiffness(std::vector<double> &value) const;

    /** Give all rows of a pair the same of a positive quantity [rows], the
     * geometric mean: springs of one stiffness leave a uniform pressure
     * uniform. Collective. */
    void make_uniform(std::vector<double> &value) const;

    /** By pair: the part of a uniform pressure's force that the rows hand to
     * wrong nodes of the primary surface, in [0, 1]; 0 against obstacles. It is
     * found by building a mortar coupling beside the pair's own. Collective. */
    std::vector<double> transfer_errors(const la::Vector &displacement);

    /** Points of the secondary that have penetrated by more than @p tolerance
     * (length) at @p displacement without a row: its own nodes, and nodes of
     * the primary in facets of the secondary without any row. How deep the
     * primary's nodes are between rows is noted for results(). Collective. */
    std::vector<Penetration<dim>> penetrations(const la::Vector &displacement,
                                               double tolerance);

  private:
    using Node = std::int32_t;

    using Direction = dealii::Tensor<1, dim>;

    using Pair = SurfacePair<dim>;

    using Origin = PointsOrigin;

    using Place = PointPlace<dim>;

  public:
    /** The points of a find(), to be put back after another one. */
    struct SavedPoints
    {
      abut_points *points = nullptr;
      std::vector<Place> places;
      std::vector<PairCheck> checks;
      std::vector<std::vector<std::uint8_t>> dropped;
      std::vector<dealii::Point<dim>> present;
      std::vector<double> displacement;
    };

  private:
    /** A component of a point, which is a row for everybody else. */
    struct Component
    {
      std::size_t point;
      std::size_t row;
      const Place &place;
      /** Along which the secondary closes the gap: normal, or axis of a tie. */
      Direction direction;
    };

    Component component(std::size_t point, std::int32_t row) const;

    bool is_tangent(const Component &row) const
    {
      return view_.kind[row.point] == ABUT_POINT_CONTACT
             && row.row
                    != static_cast<std::size_t>(
                        view_.component_start[row.point]);
    }

    /** Call function(component) in the order of the rows, those of tangents
     * left out. */
    template <typename Function>
    void for_each_component(const Function &function) const;

    /** The same with tangents, along whose direction the traction on the
     * secondary is negative, as the pressure along the normal is. */
    template <typename Function>
    void for_each_row(const Function &function) const;

    /** Call function(node, c) for the stencil of a point: D / W at nodes of
     * the secondary, or - M / W at those of the primary. */
    template <typename Function>
    void for_each_secondary(std::size_t point, const Function &function) const;
    template <typename Function>
    void for_each_primary(std::size_t point, const Function &function) const;

    /** [pairs][nodes of the whole surface] nonzero: a row of the pair holds
     * this node of its secondary, or none can. Collective. */
    std::vector<std::uint8_t> held_nodes();
    std::string turning_facets(const Pair &pair) const;
    /** [pairs] where the obstacles are. */
    std::vector<RigidPose<dim>> poses() const;
    /** [pairs] where they were at the last commit(), of pairs whose points are
     * made at each step or if @p of_step is true; else before the first step.
     */
    std::vector<RigidPose<dim>> poses_before(std::vector<RigidPose<dim>> now,
                                             bool of_step) const;
    /** How far the point of a rigid body that is at @p place now has come. */
    static Direction rigid_displacement(const dealii::Point<dim> &place,
                                        const RigidPose<dim> &then,
                                        const RigidPose<dim> &now);
    /** Throws for obstacles with friction that turn too far for the chord to be
     * their way. */
    void refuse_large_rotations(const std::vector<RigidPose<dim>> &then,
                                const std::vector<RigidPose<dim>> &now) const;
    using Partners = CommittedPartners;
    /** Find them if nodes were displaced by @p u then; nothing happens if they
     * are those. Collective. */
    void find_partners(const std::vector<Direction> &u);
    void record_partners();
    /** Partners of a row, or null. */
    const Partners *partners_of(const Component &row) const;
    /** The value of a tangent's row that is no slip since then, or since nodes
     * were displaced by @p u, but for obstacles. */
    double reference_of_slip(const Component &row,
                             const Partners &partners) const;
    double reference_of_slip(const Component &row,
                             const std::vector<Direction> &u) const;
    bool has_partners(const Pair &pair) const;
    /** Freedom that supports leave along a tangent of a point. */
    struct TangentSupport
    {
      abut_tangent kind = ABUT_TANGENT_FREE;
      /** Node of the primary that moves as what is opposite of the point, where
       * a support prescribes that, too; or -1. */
      Node opposite = -1;
    };
    TangentSupport support_of(const Component &tangent) const;
    /** Whether what supports leave free at a point moves it along a tangent of
     * @p kinds free only as it moves along the normal or the other tangent. */
    bool is_guided(std::size_t point,
                   const std::vector<abut_tangent> &kinds) const;
    /** Freedom that supports leave along the tangents of a point. */
    std::vector<abut_tangent> tangent_kinds(std::size_t point) const;
    /** How far supports take a point along a tangent since nodes were displaced
     * by @p u. */
    double prescribed_slip(const Component &row, Node opposite,
                           const std::vector<Direction> &u) const;
    /** Mark with 0 the rows of contacts that are behind another one. */
    void drop_covered(std::vector<std::uint8_t> &keep) const;
    class MissedCheck;

    /** [pairs][nodes of the whole surface] nonzero: the node has a closed row
     * of the pair, or none that could be. Collective. */
    std::vector<std::uint8_t>
    touching_nodes(const std::uint8_t *row_state) const;
    void sample_facets(std::size_t pair, const std::vector<Direction> &u,
                       const std::vector<std::uint8_t> &touching,
                       const std::vector<std::uint8_t> &touching_facets,
                       std::vector<FacetPenetration> &found) const;
    /** Where the place of the obstacle that is now at @p place was before the
     * present step. */
    dealii::Point<dim> place_before(std::size_t pair,
                                    const dealii::Point<dim> &place) const;
    void find_narrowest_width(Pair &pair,
                              const std::vector<Direction> &u) const;
    class PressedPoints;
    /** Measure the rotation of directions since rows were made. Collective. */
    void find_rotations(const std::vector<Direction> &u,
                        const double *row_pressure,
                        const std::uint8_t *row_state);
    /** [nodes] Distance of the pair's other side from facets around a node of
     * the secondary, or from a node of the primary, as far as it is known. */
    std::vector<double>
    distances_of_nodes(Pair &pair,
                       const std::vector<dealii::Point<dim>> &reference,
                       const std::vector<dealii::Point<dim>> &present) const;
    /** [rows] As the public function. */
    std::vector<double> clearances(const std::vector<Direction> &u,
                                   bool only_moving);
    double clearance(const Component &row,
                     const std::vector<double> &distance) const;
    std::string wrong_side(Pair &pair) const;
    void refuse_inside(Pair &pair, const la::Vector &displacement) const;
    /** Measure how deep bodies that may come near are in each other before
     * anything is displaced, unless the way to @p start is long enough to part
     * them. Collective. */
    void look_inside(const la::Vector &start);
    /** Throws if they are, where no rows hold them apart. */
    void refuse_overlap(std::size_t number);

    /** Throws ContactError with the text; if it is a known failure that is to
     * be measured, it is noted in place of that. */
    void refuse(Pair &pair, const Message &message) const;

    void create_pair(const ContactPair<dim> &data);
    /** First unknowns of the nodes that points refer to. */
    std::set<dealii::types::global_dof_index> used_nodes() const;
    /** @p place: displacement of bodies whose points are not those of the
     * reference configuration; null: that of the last time. */
    void gather(const la::Vector *place);
    void create_sides(Pair &pair);
    void find_thickness(Pair &pair);
    double find_thickness(const Pair &pair,
                          const std::set<dealii::types::boundary_id> &ids,
                          const SurfaceSide<dim> &side) const;
    Handle<abut_coupling>
    make_coupling(const Pair &pair, abut_discretisation discretisation) const;
    void check_sides(const Pair &pair) const;
    void check_displacements(const std::vector<Direction> &u) const;
    std::vector<Direction> displacements_in_reach(const la::Vector &u);
    /** Steps 2 to 19 of the detection of a pair between bodies. Throws on all
     * ranks. Collective. */
    void search(const Pair &pair, double motion);
    /** How far the sides of a pair have come against each other, length. */
    struct Motions
    {
      double searched = 0.; ///< since the last commit(), which reach follows
      /** Since facets near each other were gathered; at the last commit() or
       * now, whichever is more. */
      double gathered = 0.;
    };
    /** [pairs] Collective. */
    std::vector<Motions>
    motions_since_gathering(const std::vector<Direction> &u);
    /** Whether the facets that are known suffice. */
    bool is_in_reach(const Pair &pair, const Motions &motions) const;
    /** Choose from how far facets are to be gathered. */
    void set_distances(Pair &pair, const Motions &motions) const;
    /** Displacement of the last commit(); empty: 0, or not known. */
    const la::Vector &last_commit() const;
    void renew(const la::Vector *place);
    Message explain_no_rows(std::size_t pair);
    /** Whether supports prescribe the displacement along the normal of all
     * nodes of the secondary. Collective. */
    bool is_prescribed(const Pair &pair) const;
    /** Let the next find() look at the sides of surfaces that touch themselves
     * where bodies are displaced by this (owned). */
    void look_at_sides(const la::Vector &displacement);
    /** Split such surfaces again if their sides are not right any more.
     * Collective. */
    void renew_sides();
    /** Make sides of facets that have other ids now. Collective. */
    void assign_sides(const la::Vector *place);
    bool is_owned(Node node) const;
    double motion(const Pair &pair, const std::vector<Direction> &u) const;
    /** [pairs] how far they have come since the last search. */
    std::vector<double> motions(const std::vector<Direction> &u);
    double freedom(Node node, const Direction &direction) const;
    bool is_free(Node node, unsigned int component) const;
    double own_freedom(Node node, const Direction &direction) const;
    std::vector<std::uint8_t>
    dropped_nodes(const Pair &pair, const std::vector<std::uint8_t> &taken,
                  int component) const;
    void build(const Pair &pair, abut_coupling *coupling,
               const std::vector<std::uint8_t> &dropped, double motion,
               const abut_coupling_target &target) const;
    void record_place(const std::vector<Direction> &u);
    /** Displacements that the next find() makes points at, unless they move; 0
     * but for pairs that do so step by step. Collective. */
    std::vector<Direction> place_of_step();
    bool is_where_made(const std::vector<Direction> &place) const;
    /** Whether points that move were made at exactly these displacements.
     * Collective. */
    bool is_made_at(const std::vector<Direction> &u) const;
    /** How the nodes have moved from there; @p u where there is no such place.
     */
    static double facet_size(const Pair &pair)
    {
      return std::max(pair.secondary.everywhere.median,
                      pair.primary.everywhere.median);
    }
    static std::vector<Direction>
    difference(std::vector<Direction> u, const std::vector<Direction> &from);
    /** The way since the points were made. */
    std::vector<Direction>
    displacement_since(const std::vector<Direction> &u) const;
    void copy_hessians(const Pair &pair, const abut_coupling_view &view);
    /** From the place that is opposite a point of mortar to its own, if nodes
     * are displaced by @p u. */
    Direction apart(std::size_t point, const std::vector<Direction> &u) const;
    /** How far the two sides of a row have come against each other since they
     * were paired, or since the step began. */
    Direction relative_displacement(const Component &row,
                                    const std::vector<Direction> &u) const;
    /** [nodes of the side * dim] */
    static std::vector<double>
    places_of(const std::vector<Node> &nodes,
              const std::vector<dealii::Point<dim>> &place);
    using TieGroup = TiedAxes;
    std::vector<TieGroup>
    tie_groups(const Pair &pair, const std::vector<std::uint8_t> &taken) const;
    /** Numbers of points, that far behind the first of their node: by node of
     * the secondary, or by facet for the first quadrature point of each. */
    std::vector<std::int64_t> point_numbers(std::size_t pair, int shift) const;
    /** Append the points of a pair, with numbers that far behind the first of
     * their node or facet. */
    void append(std::size_t pair, const std::vector<std::uint8_t> &dropped,
                double motion, std::uint32_t tie_axes, int shift);
    bool has_lasting_numbers(const Pair &pair) const;
    /** The sides of a pair while they stand where points are made. */
    using Displaced = std::optional<DisplacedSides<dim>>;
    /** Search, and append the points of a pair at nodes that are not taken.
     * The sides stay displaced. Returns the number of nodes without a
     * multiplier on all ranks. Collective. */
    unsigned int make_points(std::size_t pair, double motion,
                             const std::vector<std::uint8_t> &taken,
                             Displaced &displaced);
    /** The same, with the report on the pair; marks the nodes as taken. */
    void find_pair(std::size_t pair, double motion,
                   std::vector<std::uint8_t> &taken, Displaced &displaced);
    /** The points of all pairs. Collective. */
    void find_pairs(const std::vector<double> &moved);
    /** Throw where the gap of a pair leaves nothing of an obstacle or a body.
     * Collective. */
    void check_gap(const Pair &pair) const;
    /** The same of all gaps that are others than at the last call. */
    void check_gaps();
    /** Whether the pair is one between bodies that a node may belong to or not:
     * obstacles and ties have all theirs. */
    static bool is_group(const Pair &pair)
    {
      return !pair.data.obstacle && !pair.data.tied;
    }
    /** [pairs] nonzero: a group with a node that is in the secondary of another
     * one, too. Collective. */
    std::vector<unsigned int> share_nodes() const;
    /** [pairs][nodes] nonzero: another group is nearer to the node. Takes the
     * points away that it makes to find out; sides stay displaced. Collective.
     */
    std::vector<std::vector<std::uint8_t>>
    nodes_of_nearer_pairs(const std::vector<double> &moved,
                          std::vector<Displaced> &displaced);
    std::vector<Origin> origins(const std::vector<Direction> &u) const;
    solve::NodeMap append_stress(const SurfaceTraction<dim> &traction,
                                 abut_points *stress) const;
    /** PairCheck::first_overlap, where the rows have that @p overlap.
     * Collective. */
    double first_overlap(std::size_t pair, double overlap);
    /** The message about it, or an empty one. Collective. */
    Message overlap_at_start(Pair &pair, const PairCheck &found);
    void make_check(std::size_t pair, unsigned int n_dropped);
    la::Vector field() const;
    /** Pairs with rows at quadrature points, and these rows. Collective. */
    template <typename Function>
    void for_each_point_pair(const Function &function) const;
    template <typename Points>
    void project_tractions(const Points &points,
                           const std::vector<std::size_t> &rows,
                           double *value) const;
    template <typename Function>
    void for_each_share(const Function &function) const;
    template <typename Function>
    void for_each_share_of(const Component &row,
                           const Function &function) const;

    const dealii::Mapping<dim> &mapping_;
    const dealii::DoFHandler<dim> &dof_handler_;
    const dealii::AffineConstraints<double> &constraints_;
    const MPI_Comm communicator_;
    const Settings settings_;
    abut_context *const context_;
    std::shared_ptr<SurfaceExchange<dim>> exchange_;
    DetectionReport &detection_;
    ContactSurface<dim> surface_;
    std::vector<Pair> pairs_;
    abut_points *points_ = nullptr; ///< of the last find()
    abut_points_view view_ = {};
    std::vector<RigidPose<dim>> committed_poses_; ///< [pairs], or empty
    std::vector<la::Vector> approach_;            ///< see set_approach()
    double foreseen_ = 0.;                        ///< see foresee_motion()
    std::vector<double> committed_times_;         ///< [pairs], or empty
    /** [pairs] that PairResult::slip is measured from. */
    std::vector<RigidPose<dim>> slip_poses_;
    /** By the number of the row, and the displacements that they were found at;
     * empty: none have been. */
    std::unordered_map<std::int64_t, Partners> partners_;
    std::optional<std::vector<Direction>> partners_place_;
    /** Where the next find() looks whether surfaces that touch themselves still
     * have the right sides (owned), and where it did before. */
    std::optional<la::Vector> sides_place_;
    la::Vector sides_seen_;
    la::Vector searched_from_;  ///< where points move: of the last commit()
    std::vector<Place> places_; ///< [points]
    const la::Vector *committed_ = nullptr;
    /** Where points were made, of pairs that are displaced; empty: 0. */
    la::Vector made_place_;
    unsigned int n_finds_ = 0, n_kept_ = 0;
    /** [nodes] displacements that facets were gathered at. */
    std::vector<Direction> gathered_;
    /** [nodes] displacements of the last examine(); of another number of nodes
     * than there are: none that is known of all. */
    std::vector<Direction> examined_;
    /** For pairs that are displaced: current and reference positions of the
     * nodes, and their displacements [nodes * dim], where the points were made.
     */
    std::vector<dealii::Point<dim>> present_, reference_;
    std::vector<double> present_displacement_;
    Direction made_at(const Node node) const
    {
      return present_[node] - reference_[node];
    }

    /** The same of all nodes, moving or not. */
    std::vector<Direction> made() const
    {
      std::vector<Direction> u(surface_.nodes.size());
      for (std::size_t n = 0; n < present_.size(); ++n)
        u[n] = made_at(static_cast<Node>(n));
      return u;
    }

    /** [pairs] of the present points; empty: they have to be made again. */
    std::vector<Origin> origins_;
    std::vector<PairCheck> checks_;
    std::vector<double> checked_gaps_; ///< [pairs] or empty, by check_gaps()
  };
} // namespace abut::shim

#include "surface_pair_loops.h"

#endif

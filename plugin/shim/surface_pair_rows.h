// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SURFACE_PAIR_ROWS_H
#define ABUT_SHIM_SURFACE_PAIR_ROWS_H

#include "row_source.h"
#include "surface_exchange.h"
#include "surface_side.h"

#include <abut/dealii/contact_pair.h>
#include <abut/dealii/method_parameters.h>
#include <abut/dealii/normal_stress.h>
#include <abut/rows.h>

namespace abut::shim
{
  /** Rows between surfaces of bodies, and of surfaces against rigid obstacles,
   * from the core's coupling.
   *
   * The geometry is that of the reference configuration (displacement 0), so
   * that the gap is linear in the displacement. A row is on the rank that owns
   * its secondary node, or for quadrature points the facet's cell. Its
   * coefficients are those of free unknowns: what constraints make of an
   * unknown is put in its place. */
  template <int dim> class SurfacePairRows : public RowSource
  {
  public:
    /** What does not depend on the pair. */
    struct Settings
    {
      MethodParameters method;
      SearchParameters search;
      bool axisymmetric = false;
    };

    /** All references must outlive this object. Throws ContactError for pairs
     * that make no sense. Of the surfaces, each rank holds what is near its own
     * part. @p exchange may be null. Collective. */
    SurfacePairRows(const dealii::Mapping<dim> &mapping,
                    const dealii::DoFHandler<dim> &dof_handler,
                    const dealii::AffineConstraints<double> &constraints,
                    const std::vector<ContactPair<dim>> &pairs,
                    const Settings &settings, abut_context *context,
                    std::shared_ptr<SurfaceExchange<dim>> exchange);

    /** What knows the facets: to be given to the next object for the same mesh,
     * so that they need not be found again. */
    const std::shared_ptr<SurfaceExchange<dim>> &exchange() const
    {
      return exchange_;
    }

    void find(const la::Vector &displacement, abut_rows *rows) override;

    /** Replace @p stress by the normal stress at the present rows, which must
     * be those of quadrature points: the same numbers and weights, sigma_n at
     * displacement 0 as the gap and d sigma_n/du as coefficients. Throws on
     * all ranks. Collective. */
    void find_stress(const NormalStress<dim> &normal_stress,
                     abut_rows *stress) const;

    std::uint64_t mesh_signature() const override;
    std::vector<PlacedRow> placed_rows() const override;
    std::vector<double> row_pressure(const la::Vector &field) const override;
    la::Vector pressure(const double *row_pressure) const override;
    la::Vector gap(const double *row_gap) const override;
    la::Vector status(const std::uint8_t *row_state) const override;
    std::vector<std::uint8_t> relax(const la::Matrix &matrix,
                                    const la::Vector &residual,
                                    const std::vector<double> &gap,
                                    unsigned int n_sweeps,
                                    la::Vector &displacement) const override;
    void push_inside(const std::vector<double> &gap, std::vector<double> margin,
                     la::Vector &displacement) const override;

    /** States to start from when a pair that must hold a body has no closed
     * row: closed are then the rows with pressure, or those of the smallest
     * gaps. Empty if there is no such pair. Collective.
     * @param pressure empty: 0
     * @param scale rows are closed where p - scale gap > 0 */
    std::vector<std::uint8_t>
    first_contact(const std::vector<double> &gap,
                  const std::vector<double> &pressure,
                  const std::vector<double> &scale) const;

    /** What find() met, by pair. */
    const std::vector<PairCheck> &checks() const
    {
      return checks_;
    }

    /** Results by pair for [rows] pressures, gaps and states (null: nothing
     * solved). Collective. */
    std::vector<PairResult<dim>> results(const double *row_pressure,
                                         const double *row_gap,
                                         const std::uint8_t *row_state) const;

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
    std::vector<double> transfer_errors(const la::Vector &displacement) const;

    /** Points of the secondary that have penetrated by more than @p tolerance
     * (length) at @p displacement without a row: its own nodes, and nodes of
     * the primary in facets of the secondary without any row. How deep the
     * primary's nodes are between rows is noted for results(). Collective. */
    std::vector<Penetration<dim>> penetrations(const la::Vector &displacement,
                                               double tolerance);

  private:
    using Node = std::int32_t;

    using Direction = dealii::Tensor<1, dim>;

    /** A pair with its two sides and their coupling. */
    struct Pair
    {
      ContactPair<dim> data;
      abut_discretisation discretisation = ABUT_DISCRETISATION_DUAL_MORTAR;
      SurfaceSide<dim> secondary, primary;
      Handle<abut_coupling> coupling;
      /** Distances that the facets known here suffice for. */
      double reach = 0., margin = 0.;
      /** [nodes of the secondary] without a multiplier in the present rows:
       * 1 because of another pair, 2 because of supports. */
      std::vector<std::uint8_t> dropped;
      double between_rows = 0., held_inside = 0.; ///< as in PairResult
    };

    /** A row before constraints are put in. Its entries are dg/du = direction
     * * coefficient of nodes of the whole surface, those of the secondary
     * first. */
    struct Row
    {
      std::int64_t id; ///< see PointNumber
      std::size_t pair;
      Node node; ///< -1: quadrature point
      double weight;
      double gap;         ///< at displacement 0
      std::int32_t facet; ///< of a quadrature point, in the whole surface
      dealii::Point<dim> position;           ///< where the row sits
      Direction direction;                   ///< normal, or axis of a tie
      std::size_t first, first_primary, end; ///< entries
    };

    struct Entry
    {
      Node node;
      double coefficient;
    };

    /** [pairs][nodes of the whole surface] nonzero: a row of the pair holds
     * this node of its secondary, or none can. Collective. */
    std::vector<std::uint8_t> held_nodes();
    std::string turning_facets(const Pair &pair) const;
    void check_obstacle(Pair &pair, const std::uint8_t *held,
                        const std::vector<dealii::Point<dim>> &present,
                        double tolerance,
                        std::vector<Penetration<dim>> &missed) const;
    void check_surfaces(Pair &pair, const std::uint8_t *held,
                        const std::vector<dealii::Point<dim>> &present,
                        double reach, double tolerance,
                        std::vector<Penetration<dim>> &missed);

    void create_pair(const ContactPair<dim> &data);
    void gather();
    void create_sides(Pair &pair);
    Handle<abut_coupling>
    make_coupling(const Pair &pair, abut_discretisation discretisation) const;
    void check_sides(const Pair &pair) const;
    void check_displacements(const std::vector<Direction> &u) const;
    std::vector<Direction> displacements_in_reach(const la::Vector &u);
    bool is_in_reach(const Pair &pair, double motion) const;
    void renew();
    std::string explain_no_rows(std::size_t pair);
    bool is_owned(Node node) const;
    double motion(const Pair &pair, const std::vector<Direction> &u) const;
    double freedom(Node node, const Direction &direction) const;
    bool is_free(Node node, unsigned int component) const;
    double own_freedom(Node node, const Direction &direction) const;
    std::vector<std::uint8_t>
    dropped_nodes(const Pair &pair, const std::vector<std::uint8_t> &taken,
                  int component) const;
    void build(const Pair &pair, abut_coupling *coupling,
               const std::vector<std::uint8_t> &dropped, double motion) const;
    void take_rows(std::size_t pair, int component);
    void number_again();
    bool has_lasting_numbers(const Pair &pair) const;
    void find_pair(std::size_t pair, double motion,
                   std::vector<std::uint8_t> &taken);
    void append_stress(const NormalStress<dim> &normal_stress,
                       abut_rows *stress) const;
    /** Put a row with free unknowns into @p rows; false if it has none. */
    bool append(const Row &row, abut_rows *rows, std::string &message) const;
    void make_check(std::size_t pair, unsigned int n_dropped);
    la::Vector field() const;
    /** Pairs with rows at quadrature points, and these rows. Collective. */
    template <typename Function>
    void for_each_point_pair(const Function &function) const;
    template <typename Function>
    void for_each_share(const Function &function) const;

    const dealii::Mapping<dim> &mapping_;
    const dealii::DoFHandler<dim> &dof_handler_;
    const dealii::AffineConstraints<double> &constraints_;
    const MPI_Comm communicator_;
    const Settings settings_;
    abut_context *const context_;
    std::shared_ptr<SurfaceExchange<dim>> exchange_;
    ContactSurface<dim> surface_;
    std::vector<Pair> pairs_;
    std::vector<Row> rows_;
    std::vector<Entry> entries_;
    std::vector<PairCheck> checks_;
  };
} // namespace abut::shim

#endif

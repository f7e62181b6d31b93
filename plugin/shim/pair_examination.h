// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_EXAMINATION_H
#define ABUT_SHIM_PAIR_EXAMINATION_H

#include "pair_points.h"

namespace abut::shim
{
  /** Rows of pairs that press where their surfaces are apart. */
  struct SeparatedRows
  {
    double gap = 0.;             ///< largest distance, length
    double force = 0., all = 0.; ///< sums of these rows and of all that press
  };

  /** Measures of an answer at the points of pairs. */
  template <int dim> class PairExamination
  {
  public:
    /** @p points must outlive this object. */
    explicit PairExamination(PairPoints<dim> &points)
        : points_(points),
          host_(points.host()),
          surface_(points.surface()),
          pairs_(points.pairs())
    {
    }

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
                                     const std::uint8_t *row_state) const;

    /** Results by pair for [rows] pressures, gaps and states (null: nothing
     * solved), with moments at @p displacement, null: that of the last
     * examine(). @p late_force: [pairs] of this rank. Collective. */
    std::vector<PairResult<dim>>
    results(const la::Vector *displacement, const double *row_pressure,
            const double *row_gap, const std::uint8_t *row_state,
            const std::vector<double> &late_force) const;

  private:
    /** Measure the rotation of directions since rows were made. Collective. */
    void find_rotations(const NodePositions<dim> &nodes,
                        const double *row_pressure,
                        const std::uint8_t *row_state);

    PairPoints<dim> &points_;
    const PairHost<dim> &host_;
    const ContactSurface<dim> &surface_;
    std::vector<SurfacePair<dim>> &pairs_;
    /** [nodes] displacements of the last examine(); of another number of nodes
     * than there are: none that is known of all. */
    std::vector<Direction<dim>> examined_;
  };

  /** [rows] Distance of the surfaces around the rows of weighted gaps: the
   * least gap, length, at nodes of both sides and at points of integration, of
   * the law; infinite for other rows, and for pairs that are not @p
   * wanted. Collective. */
  template <int dim>
  std::vector<double> clearances(const PairPoints<dim> &points,
                                 const std::vector<Direction<dim>> &u,
                                 const std::vector<int> &wanted);

  /** Facets in obstacles, see RowSource. Collective. */
  template <int dim>
  std::vector<FacetPenetration>
  facet_penetrations(PairPoints<dim> &points, const la::Vector &displacement,
                     const std::uint8_t *row_state);

  /** Largest distance between a straight facet of a pair of bodies and its
   * curved manifold at a node of the other side in contact, as far as it is
   * more than @p least, length; else 0. Where meshes match it is 0 at all
   * nodes. Collective. */
  template <int dim>
  double chord_error(const PairPoints<dim> &points, std::size_t pair,
                     const std::uint8_t *row_state, double least);

  /** By pair: how much tractions alternate from node to node of the secondary,
   * as the root mean square of the alternating part, at nodes that are closed
   * with their neighbours up to the second, divided by that of the tractions at
   * all closed nodes. Collective. */
  template <int dim>
  std::vector<double> oscillations(const PairPoints<dim> &points,
                                   const double *row_pressure,
                                   const std::uint8_t *row_state);

  /** Motion of closed rows since they were made. Collective. */
  template <int dim>
  std::vector<StepMotion> step_motion(PairPoints<dim> &points,
                                      const la::Vector &displacement,
                                      const std::uint8_t *row_state);

  /** By pair: the part of a uniform pressure's force that the rows hand to
   * wrong nodes of the primary surface, in [0, 1]; 0 against obstacles. It is
   * found by building a mortar coupling for comparison. Collective. */
  template <int dim>
  std::vector<double> transfer_errors(const PairPoints<dim> &points,
                                      const la::Vector &displacement);

  /** Points of the secondary that have penetrated by more than @p tolerance
   * (length) at @p displacement without a row: its own nodes, and nodes of
   * the primary in facets of the secondary without any row. Penetrations of
   * the primary's nodes between rows are recorded in the pairs. Collective. */
  template <int dim>
  std::vector<Penetration<dim>> penetrations(PairPoints<dim> &points,
                                             const la::Vector &displacement,
                                             double tolerance);
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SURFACE_ROWS_H
#define ABUT_SHIM_SURFACE_ROWS_H

#include "moving_lines.h"
#include "pair_detection.h"
#include "pair_examination.h"
#include "pair_friction.h"
#include "pair_multipliers.h"
#include "pair_slip.h"
#include "row_source.h"
#include "surface_fields.h"

namespace abut::shim
{
  /** Points between surfaces of bodies, and of surfaces against rigid
   * obstacles, from the core's coupling. Values of rows, here and elsewhere,
   * are those of the points' components.
   *
   * The geometry is that of the reference configuration (displacement 0), so
   * that the gap is linear in the displacement, or, of pairs that move, that of
   * the displacement of find(), with weights of the reference; for corotational
   * pairs only directions and gaps are current. A point is on the rank that
   * owns its secondary node, or for quadrature points the facet's cell. */
  template <int dim> class SurfaceRows : public RowSource
  {
  public:
    /** Throws ContactError for pairs that make no sense. @p exchange: of an
     * earlier object for the same mesh, or null. Collective. */
    SurfaceRows(const PairHost<dim> &host,
                const std::vector<ContactPair<dim>> &pairs,
                std::shared_ptr<SurfaceExchange<dim>> exchange);

    PairSet<dim> &set()
    {
      return set_;
    }

    const PairSet<dim> &set() const
    {
      return set_;
    }

    /** The points of the last find(). */
    PairPoints<dim> &points()
    {
      return points_;
    }

    const PairPoints<dim> &points() const
    {
      return points_;
    }

    PairExamination<dim> &examination()
    {
      return examination_;
    }

    const PairExamination<dim> &examination() const
    {
      return examination_;
    }

    SurfaceFields<dim> fields() const
    {
      return SurfaceFields<dim>(points_);
    }

    PairMultipliers<dim> multipliers() const
    {
      return PairMultipliers<dim>(points_);
    }

    PairSlip<dim> &slip()
    {
      return slip_;
    }

    int dimension() const override
    {
      return dim;
    }
    Change find(const la::Vector &displacement, abut_points *points) override;
    void drop_needless(std::vector<std::uint8_t> &keep) const override
    {
      shim::drop_needless(points_, keep);
    }
    void filter(const std::vector<std::uint8_t> &keep) override
    {
      points_.filter(keep);
    }
    bool moves() const override
    {
      return set_.moves();
    }
    std::vector<MatrixLine>
    geometric_lines(const double *row_pressure) const override
    {
      return shim::geometric_lines(points_, row_pressure);
    }
    std::vector<solve::GapLine>
    gap_lines(const std::vector<std::uint8_t> &wanted) const override
    {
      return shim::gap_lines(points_, wanted);
    }
    const solve::NodeMap &nodes() const override
    {
      return set_.surface().map;
    }
    std::uint64_t mesh_signature() const override
    {
      return set_.mesh_signature();
    }
    std::vector<PlacedRow> placed_rows() const override
    {
      return points_.placed_rows();
    }
    FrictionalPoints friction() const override
    {
      return friction_of(points_);
    }
    SlipReference slip_reference(const la::Vector &committed) override
    {
      return slip_.reference(points_, committed);
    }
    std::vector<double> row_pressure(const la::Vector &field) const override
    {
      return fields().row_pressure(field);
    }
    la::Vector pressure(const double *row_pressure) const override
    {
      return fields().pressure(row_pressure);
    }
    la::Vector slip(const double *row_slip) const override
    {
      return fields().slip(row_slip);
    }
    la::Vector gap(const double *row_gap) const override
    {
      return fields().gap(row_gap);
    }
    la::Vector status(const std::uint8_t *row_state) const override
    {
      return fields().status(row_state);
    }
    std::vector<FacetPenetration>
    facet_penetrations(const la::Vector &displacement,
                       const std::uint8_t *row_state) override
    {
      return shim::facet_penetrations(points_, displacement, row_state);
    }
    void push_inside(const std::vector<double> &gap, std::vector<double> margin,
                     la::Vector &displacement) const override
    {
      fields().push_inside(gap, margin, displacement);
    }

    /** find() into other points, while the present ones stay. @p displacement
     * must be in reach: see PairPoints::displacements_in_reach(). Collective.
     */
    void find_elsewhere(const la::Vector &displacement, abut_points *core,
                        PairPoints<dim> &points)
    {
      find_points(displacement, core, points);
    }

    /** The next find() makes all points again. */
    void renew_points()
    {
      points_.origins.clear();
    }

    /** Take points that were there before. */
    void restore(PairPoints<dim> points);

    /** Sides of surfaces that touch themselves from a checkpoint. Collective.
     */
    void load_sides(std::istream &stream);

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

  private:
    Change find_points(const la::Vector &displacement, abut_points *core,
                       PairPoints<dim> &points);
    std::vector<PointsOrigin>
    origins(const std::vector<Direction<dim>> &u) const;
    /** Displacements that find() makes points at, unless they move; 0 but for
     * pairs that do so step by step. Collective. */
    std::vector<Direction<dim>> place_of_step() const;
    /** Gather again where sides have got other facets. Collective. */
    void gather_sides(const la::Vector *place);

    PairSet<dim> set_;
    PairPoints<dim> points_{set_};
    PairSlip<dim> slip_{set_};
    PairExamination<dim> examination_{points_};
    unsigned int n_finds_ = 0, n_kept_ = 0;
  };
} // namespace abut::shim

#endif

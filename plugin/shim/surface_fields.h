// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SURFACE_FIELDS_H
#define ABUT_SHIM_SURFACE_FIELDS_H

#include "pair_points.h"

#include <utility>

namespace abut::shim
{
  /** Corners of an edge of a facet, whose middle is node k + corners. */
  inline std::pair<unsigned int, unsigned int>
  corners_of_edge(const abut_facet_kind kind, const unsigned int k)
  {
    const auto n = static_cast<unsigned int>(abut_facet_n_corners(kind));
    if (n < 4)
      return {k, (k + 1) % n};
    constexpr std::pair<unsigned int, unsigned int> of_quadrilateral[] = {
        {0, 2}, {1, 3}, {0, 1}, {2, 3}};
    return of_quadrilateral[k];
  }

  /** Values of the rows of points as fields on the unknowns, and back; see the
   * functions of RowSource. */
  template <int dim> class SurfaceFields
  {
  public:
    /** @p points must outlive this object. */
    explicit SurfaceFields(const PairPoints<dim> &points)
        : points_(points), host_(points.host()), surface_(points.surface())
    {
    }

    /** Zero in all unknowns. */
    la::Vector field() const;
    std::vector<double> row_pressure(const la::Vector &field) const;
    la::Vector pressure(const double *row_pressure) const;
    la::Vector slip(const double *row_slip) const;
    la::Vector gap(const double *row_gap) const;
    la::Vector status(const std::uint8_t *row_state) const;
    void push_inside(const std::vector<double> &gap,
                     const std::vector<double> &margin,
                     la::Vector &displacement) const;

    /** Forces of [rows] pressures at all unknowns, be they prescribed or not,
     * those of hanging nodes by their parents; @p forces is 0 before.
     * Collective. */
    void find_forces(const std::vector<double> &row_pressure,
                     la::Vector &forces) const;

    /** Give all components of a node of the surfaces their mean. */
    void make_isotropic(la::Vector &value) const;

  private:
    using Facet = typename ContactSurface<dim>::Facet;

    /** Values of nodes that follow from those of others: between corners, where
     * multipliers have degree 1 on facets of degree 2, and where nodes hang.
     * Collective. */
    void fill_between_nodes(la::Vector &field) const;
    void
    add_lines_between_corners(const Facet &facet,
                              dealii::AffineConstraints<double> &lines) const;
    /** Call function(row, node, share) for the nodes that have a value of the
     * row: its own, or those around a quadrature point. */
    template <typename Function>
    void for_each_share_of(const PointRow<dim> &row,
                           const Function &function) const;
    template <typename Function>
    void for_each_share(const Function &function) const;
    bool is_free(NodeIndex node, unsigned int component) const;
    double own_freedom(NodeIndex node, const Direction<dim> &direction) const;

    const PairPoints<dim> &points_;
    const PairHost<dim> &host_;
    const ContactSurface<dim> &surface_;
  };
} // namespace abut::shim

#endif

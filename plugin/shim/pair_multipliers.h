// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_MULTIPLIERS_H
#define ABUT_SHIM_PAIR_MULTIPLIERS_H

#include "pair_points.h"

namespace abut::shim
{
  /** The space of the multipliers of rows, and their scales. */
  template <int dim> class PairMultipliers
  {
  public:
    /** @p points must outlive this object. */
    explicit PairMultipliers(const PairPoints<dim> &points)
        : points_(points), host_(points.host()), pairs_(points.pairs())
    {
    }

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

    /** Give the tangents of a point the value [rows] of its normal. */
    void copy_to_tangents(std::vector<double> &value) const;

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

  private:
    /** Pairs with rows at quadrature points, and these rows. Collective. */
    template <typename Function>
    void for_each_point_pair(const Function &function) const;
    template <typename Points>
    void project_tractions(const Points &points,
                           const std::vector<std::size_t> &rows,
                           double *value) const;

    const PairPoints<dim> &points_;
    const PairHost<dim> &host_;
    const std::vector<SurfacePair<dim>> &pairs_;
  };
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_FRICTION_H
#define ABUT_SHIM_PAIR_FRICTION_H

#include "pair_points.h"

namespace abut::shim
{
  /** Freedom that supports leave along a tangent of a point. */
  struct TangentSupport
  {
    abut_tangent kind = ABUT_TANGENT_FREE;
    /** Node of the primary that moves as what is opposite of the point, where
     * a support prescribes that, too; or -1. */
    NodeIndex opposite = -1;
  };

  template <int dim>
  TangentSupport support_of(const PairPoints<dim> &points,
                            const PointRow<dim> &tangent);

  /** Friction of the points. Throws on all ranks. Collective. */
  template <int dim>
  RowSource::FrictionalPoints friction_of(const PairPoints<dim> &points);

  /** Mark with 0 the rows of contacts that are behind another one. */
  template <int dim>
  void drop_covered(const PairPoints<dim> &points,
                    std::vector<std::uint8_t> &keep);

  /** The warning where @p late of the normal force of a pair is at points that
   * slip and were open at the start of a load step, see
   * PairResult::late_force; or nothing. */
  Message late_contact(const std::string &pair, double late, double normal);

  /** Add the effect of friction to results by pair: tractions stand in the
   * pressures of the tangents' rows, slips since the last commit in their gaps.
   * Collective. */
  template <int dim>
  void add_friction(const PairPoints<dim> &points, const double *row_pressure,
                    const double *row_gap, const std::uint8_t *row_state,
                    std::vector<PairResult<dim>> &results);
} // namespace abut::shim

#endif

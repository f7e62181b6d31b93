// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_MOVING_LINES_H
#define ABUT_SHIM_MOVING_LINES_H

#include "pair_points.h"

namespace abut::shim
{
  /** See RowSource::geometric_lines() and gap_lines(). */
  template <int dim>
  std::vector<MatrixLine> geometric_lines(const PairPoints<dim> &points,
                                          const double *row_pressure);
  template <int dim>
  std::vector<solve::GapLine>
  gap_lines(const PairPoints<dim> &points,
            const std::vector<std::uint8_t> &wanted);
} // namespace abut::shim

#endif

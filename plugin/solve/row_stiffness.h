// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_ROW_STIFFNESS_H
#define ABUT_SOLVE_ROW_STIFFNESS_H

#include "point_operator.h"
#include "stiffness.h"

namespace abut::solve
{
  /** The local stiffness 1 / (w_i sum_j B_ij^2 / K_jj) of each row, pressure
   * per length: what penalties are multiples of. It is the pressure that opens
   * the gap by one if each unknown were held by its own stiffness alone: the
   * two sides of a pair act in series. Collective. */
  std::vector<double> row_stiffness(const Stiffness &stiffness,
                                    const PointOperator &rows);

  /** 1 / K_jj of each unknown of this rank. Collective. */
  la::Vector compliance(const Stiffness &stiffness);

  /** The same of such a vector, which may be kept for other rows. */
  std::vector<double> row_stiffness(const la::Vector &compliance,
                                    const PointOperator &rows);
} // namespace abut::solve

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_HOST_CHECKS_H
#define ABUT_SOLVE_HOST_CHECKS_H

/** @file
 * Checks of a host's functions in place of a matrix against the contract of
 * HostOperator. The checks throw std::invalid_argument on all ranks, and all
 * are collective. */

#include "common_array.h"
#include "point_operator.h"
#include "stiffness.h"

#include <cstdint>
#include <string>
#include <vector>

namespace abut::solve
{
  /** Its @p diagonal [owned] is positive. */
  void check_diagonal(const Stiffness &stiffness,
                      const std::vector<double> &diagonal);

  /** The diagonal is that of a product, at one unknown of a row. */
  void check_entry(const Stiffness &stiffness,
                   const std::vector<double> &diagonal,
                   const PointOperator &rows);

  /** Products leave prescribed unknowns apart; @p prescribed [owned]. Two
   * products. */
  void check_prescribed(const Stiffness &stiffness,
                        const std::vector<double> &diagonal,
                        const CommonArray<std::uint8_t> &prescribed);

  /** Errors of the preconditioner, and a K that is not symmetric, as far as
   * vectors without structure show them, as sentences that begin with a blank;
   * empty: nothing. Three cycles. */
  std::string faults(const Stiffness &stiffness, bool is_symmetric);
} // namespace abut::solve

#endif

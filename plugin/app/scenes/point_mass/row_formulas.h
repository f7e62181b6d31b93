// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ROW_FORMULAS_H
#define ABUT_APP_ROW_FORMULAS_H

#include "app/input/expression.h"

#include <memory>
#include <string>

namespace abut::app
{
  /** Formulas in the place x of a mass in a row and the time t. */
  using RowFormula = Expression<2>;

  /** A formula in x and t; what else a scene has for a place is none here. */
  std::unique_ptr<RowFormula> formula_in_x(const std::string &text,
                                           const std::string &parameter,
                                           unsigned int n = 1);

  /** One formula for each direction, 0 where there are less; @p where tells of
   * the directions, as in "along the plane". */
  std::unique_ptr<RowFormula> formula_by_direction(const std::string &text,
                                                   const std::string &parameter,
                                                   unsigned int n_directions,
                                                   const std::string &where);
} // namespace abut::app

#endif

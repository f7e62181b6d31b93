// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NODAL_INTERPOLATION_H
#define ABUT_APP_NODAL_INTERPOLATION_H

#include "app/input/expression.h"
#include "discrete_problem.h"

namespace abut::app
{
  /** The formula of cells with a material id; null: 0. */
  template <int dim>
  using FormulaOfCells =
      std::function<const Expression<dim> *(dealii::types::material_id)>;

  /** Values of formulas, with as many components as the problem, at its nodes
   * (owned); hanging nodes as the formulas say. Throws InputError for values
   * that are not finite or larger than 1e30, of which no motion is. Collective.
   */
  template <int dim>
  la::Vector values_at_nodes(const DiscreteProblem<dim> &problem,
                             const FormulaOfCells<dim> &formula_of);
} // namespace abut::app

#endif

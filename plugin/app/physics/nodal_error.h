// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NODAL_ERROR_H
#define ABUT_APP_NODAL_ERROR_H

#include "discrete_problem.h"

#include <deal.II/fe/component_mask.h>

#include <optional>
#include <set>
#include <vector>

namespace abut::app
{
  /** A function of the unknowns on boundaries, and its components that count.
   */
  template <int dim> struct OnBoundary
  {
    const dealii::Function<dim> *function;
    dealii::ComponentMask components;
    std::set<dealii::types::boundary_id> ids;
  };

  /** Difference between functions that act at nodes and themselves on the
   * facets of their boundaries, integrated, over the integral of their
   * magnitudes; by 2 to 64 points in each direction, many where there are few
   * facets. Nothing where there is none. Collective. */
  template <int dim>
  std::optional<double>
  nodal_error(const DiscreteProblem<dim> &problem,
              const std::vector<OnBoundary<dim>> &functions);
} // namespace abut::app

#endif

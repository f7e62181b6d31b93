// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SUPPORT_ERROR_H
#define ABUT_APP_SUPPORT_ERROR_H

#include "discrete_problem.h"

#include <deal.II/fe/component_mask.h>

#include <map>
#include <optional>

namespace abut::app
{
  /** A prescribed displacement and the components that have it. */
  template <int dim> struct Prescribed
  {
    const dealii::Function<dim> *function;
    dealii::ComponentMask components;
  };

  /** Difference between prescribed displacements and those that the nodes of
   * their facets make of them, integrated, over the integral of the former's
   * magnitude; by 2 to 64 points in each direction, many where there are few
   * facets. Nothing where there is none. Collective. */
  template <int dim>
  std::optional<double>
  support_error(const DiscreteProblem<dim> &problem,
                const std::map<dealii::types::boundary_id, Prescribed<dim>>
                    &displacements);
} // namespace abut::app

#endif

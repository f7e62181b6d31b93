// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LOAD_RESULTANTS_H
#define ABUT_APP_LOAD_RESULTANTS_H

#include "discrete_problem.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace abut::app
{
  /** Sum of nodal forces on a body. */
  template <int dim> struct Resultant
  {
    dealii::Tensor<1, dim> force;
    /** About @ref centre, of the forces at the reference positions; in 2D the
     * third component alone is not 0. */
    dealii::Tensor<1, 3> moment;
    dealii::Point<dim> centre; ///< of the box around the body
    double size = 0.;          ///< its diagonal
    double magnitude = 0.;     ///< sum of the magnitudes of the forces
  };

  /** Resultants of the loads DiscreteProblem::external by body, which are the
   * materials 0 to @p n_bodies - 1. Collective. */
  template <int dim>
  std::vector<Resultant<dim>>
  load_resultants(const DiscreteProblem<dim> &problem, unsigned int n_bodies);

  /** "force (0, -20), moment 3 about (1, 0.5)"; without a moment if
   * @p with_moment is false, "none" without forces. Components of round-off are
   * 0. */
  template <int dim>
  std::string in_words(const Resultant<dim> &resultant, bool with_moment);
} // namespace abut::app

#endif

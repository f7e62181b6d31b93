// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ESTIMATOR_H
#define ABUT_APP_ESTIMATOR_H

/** @file
 * Residual error estimator of -div(k grad u) = f + contact pressure.
 */

#include <abut/dealii/linear_algebra.h>
#include <deal.II/base/function.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/vector.h>

#include <map>
#include <set>

namespace abut::app
{
  /** What the estimator looks at. Vectors are ghosted; pointers may be null
   * where said. */
  template <int dim> struct EstimatorInput
  {
    const dealii::Mapping<dim> &mapping;
    const dealii::DoFHandler<dim> &dof_handler; /**< scalar Q1 or Q2 */
    const la::Vector &solution;
    const dealii::Function<dim> &load; /**< f */
    /** k > 0; null: 1. */
    const dealii::Function<dim> *coefficient = nullptr;
    /** Flux k du/dn by boundary id; ids that stand neither here nor in
     * @p dirichlet have flux 0. */
    std::map<dealii::types::boundary_id, const dealii::Function<dim> *>
        neumann = {};
    std::set<dealii::types::boundary_id> dirichlet = {};
    /** Nonzero where a degree of freedom is in contact in the volume; null:
     * nowhere. A cell is held when all its nodes are. Hanging nodes must be
     * given the status of their parents. */
    const la::Vector *active = nullptr;
    /** Ids on which contact acts on the boundary alone, and its nodal pressure
     * (force per area, positive pushes along +u); null: no such contact. */
    std::set<dealii::types::boundary_id> contact = {};
    const la::Vector *pressure = nullptr;
  };

  /** Estimate the error in the energy norm (sum of k |grad(u - u_h)|^2)^(1/2).
   *
   * Per cell K with side h
   * \f[ \eta_K^2 = [K \text{ not held}] \frac{h^2}{k}
   *     \| f + \mathrm{div}(k\nabla u_h) \|_K^2
   *   + \frac12 \sum_F \frac{h}{k} \| [k \partial_n u_h] \|_F^2
   *   + \sum_{F \subset \Gamma_N} \frac{h}{k}
   *     \| t_N + p_h - k \partial_n u_h \|_F^2 \f]
   * with p_h on contact boundaries only. On held cells the residual is the
   * contact pressure, not an error; the jumps stay there, since they see how
   * badly the mesh follows a curved obstacle, and without them refinement
   * converges to a wrong energy.
   *
   * See estimate_residual() for the result and its cost. Collective. */
  template <int dim>
  double estimate_error(const EstimatorInput<dim> &input,
                        dealii::Vector<float> &squared);
} // namespace abut::app

#endif

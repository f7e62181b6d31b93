// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ELASTIC_ESTIMATOR_H
#define ABUT_APP_ELASTIC_ESTIMATOR_H

/** @file
 * Residual error estimator of linear elastic bodies in contact.
 */

#include "app/physics/material.h"

#include <abut/dealii/linear_algebra.h>
#include <deal.II/base/function.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/component_mask.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/vector.h>

#include <map>
#include <set>

namespace abut::app
{
  /** What the estimator looks at. Vectors are ghosted and belong to
   * @p dof_handler; pointers may be null where said. */
  template <int dim> struct ElasticEstimatorInput
  {
    const dealii::Mapping<dim> &mapping;
    const dealii::DoFHandler<dim> &dof_handler; /**< FE_Q<dim>(1 or 2)^dim */
    const la::Vector &solution;
    const Materials<dim> &materials;
    /** Force per volume by material id, dim components; others have none. */
    std::map<dealii::types::material_id, const dealii::Function<dim> *>
        body_force = {};
    /** Force per area by boundary id, dim components; others have none. */
    std::map<dealii::types::boundary_id, const dealii::Function<dim> *>
        traction = {};
    /** Pressure (pushes inwards) by boundary id; others have none. */
    std::map<dealii::types::boundary_id, const dealii::Function<dim> *>
        pressure_load = {};
    /** Components of the displacement that are prescribed, by boundary id. */
    std::map<dealii::types::boundary_id, dealii::ComponentMask> supports = {};

    /** Boundary ids of all sides that may touch something, and the force per
     * area that contact exerts on them: -p n on the secondary side, +p n on
     * the primary (see contact_traction()). Null: no contact. */
    std::set<dealii::types::boundary_id> contact = {};
    const la::Vector *contact_traction = nullptr;
    /** Boundary ids of the secondary sides, with the nodal fields p n (n:
     * outward normal) of ContactResults::pressure() and g of mark_rows(); null:
     * without the two terms that they make. Facets with a node without a
     * constraint have no such terms: their gap is unknown, and an
     * interpolation of degree 2 would overshoot into a penetration. */
    std::set<dealii::types::boundary_id> secondary = {};
    const la::Vector *pressure = nullptr;
    const la::Vector *gap = nullptr;
  };

  /** Estimate the error in the energy norm (sum of sigma(e) : eps(e))^(1/2).
   *
   * Per cell K with side h
   * \f[ \eta_K^2 = \frac{h^2}{E} \| f + \mathrm{div}\, \sigma \|_K^2
   *   + \frac12 \sum_F \frac{h}{E} \| [\sigma n] \|_F^2
   *   + \sum_{F \subset \Gamma_N} \frac{h}{E} \| t_N + t_C - \sigma n
   *     \|_F^2 + \sum_{F \subset \Gamma_S} \left( \frac{E}{h} \| g_- \|_F^2
   *   + \int_F p\, g_+ \right) \f]
   * with the contact traction t_C on contact boundaries, which has no
   * tangential part without friction: both |sigma_n + p| and |sigma_t| are
   * seen. In directions that are supported the third term is left out. The
   * last two see penetration and pressure across a gap; both vanish for exact
   * multipliers up to the error within facets (Weiss and Wohlmuth 2009). In
   * axisymmetric bodies all integrals are over rings.
   *
   * See estimate_residual() for the result and its cost. Collective. */
  template <int dim>
  double estimate_elastic_error(const ElasticEstimatorInput<dim> &input,
                                dealii::Vector<float> &squared);
} // namespace abut::app

#endif

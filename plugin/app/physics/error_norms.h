// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ERROR_NORMS_H
#define ABUT_APP_ERROR_NORMS_H

/** @file
 * Errors against an exact solution, and the energy of a membrane.
 */

#include "app/input/expression.h"
#include "material.h"

#include <abut/dealii/linear_algebra.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace abut::app
{
  /** An exact solution given by formulas. */
  template <int dim> class ExactSolution : public dealii::Function<dim>
  {
  public:
    /** @param value formula of u, or of its components
     * @param gradient formulas of du/dx; du/dy (; du/dz), component after
     * component, or empty: symmetric differences of @p value
     * @param value_parameter, gradient_parameter names for messages */
    ExactSolution(const std::string &value, const std::string &value_parameter,
                  const std::string &gradient,
                  const std::string &gradient_parameter,
                  unsigned int n_components = 1);

    double value(const dealii::Point<dim> &point,
                 unsigned int component = 0) const override;
    dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &point,
                                    unsigned int component = 0) const override;
    void set_time(double time) override;
    /** As Expression::set_length(). */
    void set_length(double half_extent);

  private:
    Expression<dim> value_expression;
    std::unique_ptr<Expression<dim>> gradient_expression;
  };

  /** Errors of a finite element function. */
  struct ErrorNorms
  {
    double l2;           /**< |u - u_h| in L2 */
    double h1_seminorm;  /**< |grad(u - u_h)| in L2 */
    double largest_node; /**< largest error at a node, of any component */
    /** (sum of sigma(e) : eps(e))^(1/2), of elastic bodies only. */
    std::optional<double> energy = std::nullopt;
  };

  /** Integrate the error by Gauss' formula of degree+2 points per direction,
   * for functions of any number of components.
   * @param solution ghosted
   * @param materials of elastic bodies, for the energy and for integrals over
   * rings; null: not a displacement. Collective. */
  template <int dim>
  ErrorNorms error_norms(const dealii::Mapping<dim> &mapping,
                         const dealii::DoFHandler<dim> &dof_handler,
                         const la::Vector &solution,
                         const dealii::Function<dim> &exact,
                         const Materials<dim> *materials = nullptr);

  /** Energy 1/2 (k grad u, grad u) - (f, u) - <t_N, u> by Gauss' formula with
   * degree+1 points (exact for constant data on parallelograms).
   * @param coefficient k, null: 1. Collective. */
  template <int dim>
  double
  membrane_energy(const dealii::Mapping<dim> &mapping,
                  const dealii::DoFHandler<dim> &dof_handler,
                  const la::Vector &solution, const dealii::Function<dim> &load,
                  const dealii::Function<dim> *coefficient = nullptr,
                  const std::map<dealii::types::boundary_id,
                                 const dealii::Function<dim> *> &neumann = {});
} // namespace abut::app

#endif

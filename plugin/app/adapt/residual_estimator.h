// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RESIDUAL_ESTIMATOR_H
#define ABUT_APP_RESIDUAL_ESTIMATOR_H

/** @file
 * What residual error estimators have in common: the pass over cells and
 * faces, for any equation div(flux) + f = 0.
 */

#include <abut/dealii/linear_algebra.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace abut::app
{
  /** The equation whose residual is measured. Functions may be called from
   * several threads at once. */
  template <int dim, int n_components> class ResidualTerms
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
    /** Normal flux: k du/dn, or the traction sigma n. */
    using Flux = dealii::Tensor<1, n_components>;

    virtual ~ResidualTerms() = default;

    /** Whether the residual inside of a cell is no error. */
    virtual bool is_held(const Cell &cell) const = 0;

    /** Integral of |f + div(flux)|^2 / stiffness over a cell. @p points have
     * values, gradients, Hessians, places and weights. */
    virtual double interior(const dealii::FEValues<dim> &points) const = 0;

    /** Fluxes along the normals of @p points and the stiffness there, as seen
     * from the cell of @p points; vectors have the right size. */
    virtual void fluxes(const dealii::FEFaceValuesBase<dim> &points,
                        std::vector<Flux> &flux,
                        std::vector<double> &stiffness) const = 0;

    /** Turn fluxes at a boundary into the prescribed flux minus them, and into
     * 0 where the solution is prescribed instead. */
    virtual void boundary_residual(const dealii::FEFaceValues<dim> &points,
                                   dealii::types::boundary_id id,
                                   std::vector<Flux> &flux) const = 0;

    /** Further contribution of a boundary face to eta_K^2; @p h is the side
     * of the cell. */
    virtual double contact_term(const dealii::FEFaceValues<dim> &points,
                                dealii::types::boundary_id id, double h) const;

    /** What lengths and areas are multiplied by at a point. */
    virtual double measure(const dealii::FEFaceValuesBase<dim> &points,
                           unsigned int q) const;
  };

  /** Sum up
   * \f[ \eta_K^2 = [K \text{ not held}] \frac{h^2}{k} \| f + \mathrm{div}
   *     \sigma \|_K^2 + \frac12 \sum_F \frac{h}{k} \| [\sigma n] \|_F^2
   *   + \sum_{F \subset \Gamma} \frac{h}{k} \| t - \sigma n \|_F^2
   *   + \text{contact terms} \f]
   * with the side h of the cube that has the cell's diameter, and the larger
   * k of two neighbours. A face with hanging nodes is integrated over its
   * finer parts.
   *
   * @param squared eta_K^2 per active cell, zero on cells of other ranks; made
   * for GridRefinement's fixed fraction, whose sum is then the bulk criterion;
   * where terms are no numbers, as the stress of a cell that is turned inside
   * out, the largest of all cells
   * @return the global estimate, square root of the sum over all ranks.
   *
   * Collective. About as expensive as one assembly of the matrix. */
  template <int dim, int n_components>
  double estimate_residual(const dealii::Mapping<dim> &mapping,
                           const dealii::DoFHandler<dim> &dof_handler,
                           const ResidualTerms<dim, n_components> &terms,
                           dealii::Vector<float> &squared);
} // namespace abut::app

#endif

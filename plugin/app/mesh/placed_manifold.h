// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PLACED_MANIFOLD_H
#define ABUT_APP_PLACED_MANIFOLD_H

/** @file
 * Manifolds of a mesh that was scaled, rotated and moved after its making.
 */

#include <deal.II/base/tensor.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <memory>

namespace abut::app
{
  /** x -> A x + b with invertible A. */
  template <int dim> class Placement
  {
  public:
    Placement(const dealii::Tensor<2, dim> &matrix,
              const dealii::Tensor<1, dim> &shift);

    dealii::Point<dim> place(const dealii::Point<dim> &reference) const;
    dealii::Point<dim> unplace(const dealii::Point<dim> &placed) const;
    dealii::Tensor<1, dim>
    place_direction(const dealii::Tensor<1, dim> &direction) const;

  private:
    dealii::Tensor<2, dim> matrix;
    dealii::Tensor<2, dim> inverse;
    dealii::Tensor<1, dim> shift;
  };

  /** The image of a manifold under a placement: points are taken back to where
   * the mesh was made, combined there, and placed again. deal.II's functions
   * that move vertices leave manifolds where they are, so that a moved ball
   * would refine towards the old sphere.
   *
   * Keeps the mesh as it was made alive, because some manifolds refer to it. */
  template <int dim> class PlacedManifold : public dealii::Manifold<dim>
  {
  public:
    PlacedManifold(std::shared_ptr<const dealii::Triangulation<dim>> reference,
                   dealii::types::manifold_id id,
                   const Placement<dim> &placement);

    std::unique_ptr<dealii::Manifold<dim>> clone() const override;

    dealii::Point<dim> get_new_point(
        const dealii::ArrayView<const dealii::Point<dim>> &surrounding,
        const dealii::ArrayView<const double> &weights) const override;

    void get_new_points(
        const dealii::ArrayView<const dealii::Point<dim>> &surrounding,
        const dealii::Table<2, double> &weights,
        dealii::ArrayView<dealii::Point<dim>> new_points) const override;

    dealii::Tensor<1, dim>
    get_tangent_vector(const dealii::Point<dim> &x1,
                       const dealii::Point<dim> &x2) const override;

  private:
    std::vector<dealii::Point<dim>>
    unplace(const dealii::ArrayView<const dealii::Point<dim>> &points) const;

    std::shared_ptr<const dealii::Triangulation<dim>> reference;
    dealii::types::manifold_id id;
    Placement<dim> placement;
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later

#include "placed_manifold.h"

#include <vector>

namespace abut::app
{
  template <int dim>
  Placement<dim>::Placement(const dealii::Tensor<2, dim> &matrix,
                            const dealii::Tensor<1, dim> &shift)
      : matrix(matrix), inverse(dealii::invert(matrix)), shift(shift)
  {
  }

  template <int dim>
  dealii::Point<dim>
  Placement<dim>::place(const dealii::Point<dim> &reference) const
  {
    return dealii::Point<dim>(matrix * reference + shift);
  }

  template <int dim>
  dealii::Point<dim>
  Placement<dim>::unplace(const dealii::Point<dim> &placed) const
  {
    return dealii::Point<dim>(inverse * (placed - shift));
  }

  template <int dim>
  dealii::Tensor<1, dim>
  Placement<dim>::place_direction(const dealii::Tensor<1, dim> &direction) const
  {
    return matrix * direction;
  }

  template <int dim>
  PlacedManifold<dim>::PlacedManifold(
      std::shared_ptr<const dealii::Triangulation<dim>> reference,
      const dealii::types::manifold_id id, const Placement<dim> &placement)
      : reference(std::move(reference)), id(id), placement(placement)
  {
  }

  template <int dim>
  std::unique_ptr<dealii::Manifold<dim>> PlacedManifold<dim>::clone() const
  {
    return std::make_unique<PlacedManifold<dim>>(reference, id, placement);
  }

  template <int dim>
  std::vector<dealii::Point<dim>> PlacedManifold<dim>::unplace(
      const dealii::ArrayView<const dealii::Point<dim>> &points) const
  {
    std::vector<dealii::Point<dim>> result;
    result.reserve(points.size());
    for (const dealii::Point<dim> &point : points)
      result.push_back(placement.unplace(point));
    return result;
  }

  template <int dim>
  dealii::Point<dim> PlacedManifold<dim>::get_new_point(
      const dealii::ArrayView<const dealii::Point<dim>> &surrounding,
      const dealii::ArrayView<const double> &weights) const
  {
    const std::vector<dealii::Point<dim>> points = unplace(surrounding);
    return placement.place(reference->get_manifold(id).get_new_point(
        dealii::make_array_view(points), weights));
  }

  template <int dim>
  void PlacedManifold<dim>::get_new_points(
      const dealii::ArrayView<const dealii::Point<dim>> &surrounding,
      const dealii::Table<2, double> &weights,
      dealii::ArrayView<dealii::Point<dim>> new_points) const
  {
    const std::vector<dealii::Point<dim>> points = unplace(surrounding);
    reference->get_manifold(id).get_new_points(dealii::make_array_view(points),
                                               weights, new_points);
    for (dealii::Point<dim> &point : new_points)
      point = placement.place(point);
  }

  template <int dim>
  dealii::Tensor<1, dim>
  PlacedManifold<dim>::get_tangent_vector(const dealii::Point<dim> &x1,
                                          const dealii::Point<dim> &x2) const
  {
    return placement.place_direction(
        reference->get_manifold(id).get_tangent_vector(placement.unplace(x1),
                                                       placement.unplace(x2)));
  }

  template class Placement<2>;
  template class Placement<3>;
  template class PlacedManifold<2>;
  template class PlacedManifold<3>;
} // namespace abut::app

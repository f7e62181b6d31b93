// SPDX-License-Identifier: LGPL-2.1-or-later
#include "volume_force.h"

namespace abut::app
{
  template <int dim>
  VolumeForce<dim>::VolumeForce(const double density,
                                const Expression<dim> *gravity,
                                const std::string &own,
                                const std::string &parameter)
      : dealii::Function<dim>(dim),
        density(density),
        gravity(density > 0. ? gravity : nullptr)
  {
    if (!own.empty())
      this->own = std::make_unique<Expression<dim>>(own, parameter, dim);
  }

  template <int dim> bool VolumeForce<dim>::is_present() const
  {
    return gravity != nullptr || own != nullptr;
  }

  template <int dim> bool VolumeForce<dim>::is_constant() const
  {
    return (gravity == nullptr || gravity->is_wholly_constant())
           && (own == nullptr || own->is_wholly_constant());
  }

  template <int dim>
  double VolumeForce<dim>::value(const dealii::Point<dim> &point,
                                 const unsigned int component) const
  {
    return (gravity ? density * gravity->value(point, component) : 0.)
           + (own ? own->value(point, component) : 0.);
  }

  template <int dim> void VolumeForce<dim>::set_time(const double time)
  {
    dealii::Function<dim>::set_time(time);
    if (own)
      own->set_time(time);
  }

  template <int dim>
  std::vector<double>
  VolumeForce<dim>::evaluate(const std::vector<dealii::Point<dim>> &points,
                             const unsigned int component) const
  {
    std::vector<double> result(points.size(), 0.);
    if (own)
      result = own->evaluate(points, component);
    if (gravity)
    {
      const std::vector<double> g = gravity->evaluate(points, component);
      for (std::size_t q = 0; q < points.size(); ++q)
        result[q] += density * g[q];
    }
    return result;
  }

  template class VolumeForce<2>;
  template class VolumeForce<3>;
} // namespace abut::app

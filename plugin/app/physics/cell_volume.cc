// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cell_volume.h"
#include "shim/cell_quadrature.h"
#include "shim/values_by_element.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace abut::app
{
  template <int dim>
  double CellVolume<dim>::mean_change(const Material<dim> &material,
                                      const dealii::FEValuesBase<dim> &values,
                                      const CellState<dim> &state) const
  {
    double volume = 0., sum = 0.;
    for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
    {
      const dealii::Point<dim> &x = values.quadrature_point(q);
      const double weight = values.JxW(q) * material.measure(x);
      volume += weight;
      sum += weight * change(state.gradient[q], state.value[q], x);
    }
    return sum / volume;
  }

  template <int dim>
  CellMaterials<dim>::CellMaterials(const dealii::Mapping<dim> &mapping,
                                    const dealii::DoFHandler<dim> &dof_handler,
                                    const la::Vector &displacement,
                                    const Materials<dim> &materials)
      : materials_(materials)
  {
    if (std::all_of(materials.begin(), materials.end(),
                    [](const auto &entry)
                    { return entry.second->cell_volume() == nullptr; }))
      return;
    const auto points_of = shim::cell_values(
        mapping, dof_handler, shim::mass_rule<dim>,
        dealii::update_values | dealii::update_gradients
            | dealii::update_quadrature_points | dealii::update_JxW_values);
    const dealii::FEValuesExtractors::Vector field(0);
    CellState<dim> state;
    of_cell_.resize(dof_handler.get_triangulation().n_active_cells());
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      const Material<dim> &material = *materials.at(cell->material_id());
      const CellVolume<dim> *volume = material.cell_volume();
      if (cell->is_artificial() || volume == nullptr)
        continue;
      dealii::FEValues<dim> &points = points_of.of(cell);
      points.reinit(cell);
      state.value.resize(points.n_quadrature_points);
      state.gradient.resize(points.n_quadrature_points);
      points[field].get_function_values(displacement, state.value);
      points[field].get_function_gradients(displacement, state.gradient);
      of_cell_[cell->active_cell_index()] =
          volume->held_at(volume->mean_change(material, points, state));
    }
  }

  template class CellVolume<2>;
  template class CellVolume<3>;
  template class CellMaterials<2>;
  template class CellMaterials<3>;
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "volumetric_locking.h"
#include "shim/cell_quadrature.h"
#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

namespace abut::app
{
  namespace
  {
    /** Energies of one cell: all of it, and what varying volume costs. */
    template <int dim>
    void add_cell(const dealii::FEValues<dim> &points,
                  const la::Vector &displacement, const Material<dim> &material,
                  double (&energies)[2])
    {
      const dealii::FEValuesExtractors::Vector field(0);
      const unsigned int n = points.n_quadrature_points;
      CellState<dim> state;
      auto &[u, gradient] = state;
      u.resize(n);
      gradient.resize(n);
      points[field].get_function_values(displacement, u);
      points[field].get_function_gradients(displacement, gradient);
      const auto in_cell = material.in_cell(points, state);
      double volume = 0., first = 0., second = 0.;
      for (unsigned int q = 0; q < n; ++q)
      {
        const dealii::Point<dim> &x = points.quadrature_point(q);
        const double weight = points.JxW(q) * material.measure(x);
        const double dilation = material.dilation(gradient[q], u[q], x);
        volume += weight;
        first += weight * dilation;
        second += weight * dilation * dilation;
        energies[0] += weight * 2. * in_cell->energy(gradient[q], u[q], x);
      }
      if (material.cell_volume() == nullptr)
        energies[1] += material.dilation_stiffness()
                       * std::max(0., second - first * first / volume);
    }
  } // namespace

  template <int dim>
  double volumetric_locking(const dealii::Mapping<dim> &mapping,
                            const dealii::DoFHandler<dim> &dof_handler,
                            const la::Vector &displacement,
                            const Materials<dim> &materials)
  {
    const auto points_of = shim::cell_values(
        mapping, dof_handler, shim::mass_rule<dim>,
        dealii::update_values | dealii::update_gradients
            | dealii::update_quadrature_points | dealii::update_JxW_values);
    double energies[2] = {0., 0.};
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && !shim::is_simplex(cell->get_fe()))
      {
        dealii::FEValues<dim> &points = points_of.of(cell);
        points.reinit(cell);
        add_cell(points, displacement, *materials.at(cell->material_id()),
                 energies);
      }
    dealii::Utilities::MPI::sum(energies, versions::communicator(dof_handler),
                                energies);
    return energies[0] > 0. ? energies[1] / energies[0] : 0.;
  }

  template double volumetric_locking(const dealii::Mapping<2> &,
                                     const dealii::DoFHandler<2> &,
                                     const la::Vector &, const Materials<2> &);
  template double volumetric_locking(const dealii::Mapping<3> &,
                                     const dealii::DoFHandler<3> &,
                                     const la::Vector &, const Materials<3> &);
} // namespace abut::app

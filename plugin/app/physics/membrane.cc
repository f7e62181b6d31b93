// SPDX-License-Identifier: LGPL-2.1-or-later
#include "membrane.h"

#include "app/input/collective.h"
#include "app/input/expression.h"
#include "app/input/input_error.h"
#include "error_norms.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/vector_tools.h>

namespace abut::app
{
  template <int dim>
  Membrane<dim>::Membrane(
      dealii::parallel::distributed::Triangulation<dim> &triangulation,
      const unsigned int degree)
      : LinearProblem<dim>(triangulation,
                           std::make_unique<dealii::FE_Q<dim>>(degree))
  {
  }

  template <int dim> void Membrane<dim>::setup(const MembraneData<dim> &data)
  {
    this->distribute(
        [&](dealii::AffineConstraints<double> &values)
        {
          collective(this->communicator,
                     [&]
                     {
                       dealii::VectorTools::interpolate_boundary_values(
                           this->mapping, this->dof_handler, data.dirichlet,
                           values);
                     });
        });
  }

  template <int dim>
  void Membrane<dim>::for_each_cell(const MembraneData<dim> &data,
                                    const TakeCell &take) const
  {
    const dealii::QGauss<dim> quadrature(this->fe.degree + 1);
    dealii::UpdateFlags flags = dealii::update_values | dealii::update_gradients
                                | dealii::update_JxW_values;
    if (!data.constant_load || !data.constant_conductivity)
      flags |= dealii::update_quadrature_points;
    dealii::FEValues<dim> values(this->mapping, this->fe, quadrature, flags);

    const unsigned int n = this->fe.n_dofs_per_cell();
    dealii::FullMatrix<double> cell_matrix(n, n);
    dealii::Vector<double> cell_load(n);
    std::vector<dealii::types::global_dof_index> dofs(n);
    std::vector<double> k(quadrature.size(),
                          data.conductivity->value(dealii::Point<dim>()));
    std::vector<double> f(quadrature.size(),
                          data.load->value(dealii::Point<dim>()));

    for (const auto &cell : this->dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        values.reinit(cell);
        if (!data.constant_conductivity)
          checked_values(*data.conductivity, values.get_quadrature_points(),
                         "Membrane/Conductivity", k);
        if (!data.constant_load)
          checked_values(*data.load, values.get_quadrature_points(),
                         "Membrane/Load", f);
        cell_matrix = 0.;
        cell_load = 0.;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          if (!(k[q] > 0.))
            throw InputError("Membrane/Conductivity",
                             "The conductivity must be positive; it is "
                                 + std::to_string(k[q]) + " somewhere.");
          const double weight = values.JxW(q);
          for (unsigned int i = 0; i < n; ++i)
          {
            const auto gradient = (k[q] * weight) * values.shape_grad(i, q);
            for (unsigned int j = 0; j <= i; ++j)
              cell_matrix(i, j) += gradient * values.shape_grad(j, q);
            cell_load(i) += f[q] * weight * values.shape_value(i, q);
          }
        }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = i + 1; j < n; ++j)
            cell_matrix(i, j) = cell_matrix(j, i);
        cell->get_dof_indices(dofs);
        take(cell_matrix, cell_load, dofs);
      }
  }

  template <int dim>
  void Membrane<dim>::for_each_flux(const MembraneData<dim> &data,
                                    const TakeFace &take) const
  {
    if (data.neumann.empty())
      return;
    const dealii::QGauss<dim - 1> quadrature(this->fe.degree + 1);
    dealii::FEFaceValues<dim> values(this->mapping, this->fe, quadrature,
                                     dealii::update_values
                                         | dealii::update_JxW_values
                                         | dealii::update_quadrature_points);
    dealii::Vector<double> cell_load(this->fe.n_dofs_per_cell());
    std::vector<dealii::types::global_dof_index> dofs(
        this->fe.n_dofs_per_cell());
    std::vector<double> flux(quadrature.size());
    for (const auto &cell : this->dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
        {
          if (!face->at_boundary()
              || data.neumann.count(face->boundary_id()) == 0)
            continue;
          values.reinit(cell, face);
          checked_values(*data.neumann.at(face->boundary_id()),
                         values.get_quadrature_points(), "Membrane/Neumann",
                         flux);
          cell_load = 0.;
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            for (unsigned int i = 0; i < cell_load.size(); ++i)
              cell_load(i) +=
                  flux[q] * values.JxW(q) * values.shape_value(i, q);
          cell->get_dof_indices(dofs);
          take(cell_load, dofs);
        }
  }

  template <int dim> void Membrane<dim>::assemble(const MembraneData<dim> &data)
  {
    this->stiffness = 0.;
    la::Vector open = this->open_load();
    collective(this->communicator,
               [&]
               {
                 for_each_cell(data,
                               [&](const auto &matrix, const auto &force,
                                   const Dofs &dofs)
                               {
                                 this->constraints.distribute_local_to_global(
                                     matrix, force, dofs, this->stiffness,
                                     open);
                               });
                 for_each_flux(data,
                               [&](const auto &force, const Dofs &dofs) {
                                 this->constraints.distribute_local_to_global(
                                     force, dofs, open);
                               });
               });
    this->stiffness.compress(dealii::VectorOperation::add);
    la::Vector closed = this->close_load(open);
    this->load.swap(closed);
    assembled = data;
  }

  template <int dim>
  NodalForces Membrane<dim>::nodal_forces(const la::Vector &u) const
  {
    const la::Vector ghosted = this->ghosted(u);
    la::Vector internal = this->open_load();
    la::Vector external = this->open_load();
    dealii::Vector<double> values(this->fe.n_dofs_per_cell());
    dealii::Vector<double> product(values);
    for_each_cell(
        assembled,
        [&](const auto &matrix, const auto &force, const Dofs &dofs)
        {
          for (unsigned int i = 0; i < dofs.size(); ++i)
            values(i) = ghosted(dofs[i]);
          matrix.vmult(product, values);
          this->hanging.distribute_local_to_global(product, dofs, internal);
          this->hanging.distribute_local_to_global(force, dofs, external);
        });
    for_each_flux(
        assembled, [&](const auto &force, const Dofs &dofs)
        { this->hanging.distribute_local_to_global(force, dofs, external); });
    return {this->close_load(internal), this->close_load(external)};
  }

  template <int dim> double Membrane<dim>::energy(const la::Vector &u) const
  {
    if (this->constraints.has_inhomogeneities())
      return membrane_energy(this->mapping, this->dof_handler, this->ghosted(u),
                             *assembled.load, assembled.conductivity,
                             assembled.neumann);
    // Without prescribed values the assembled system has it.
    la::Vector free(u), internal(u);
    this->constraints.set_zero(free);
    this->stiffness.vmult(internal, free);
    internal.sadd(0.5, -1., this->load);
    return internal * free;
  }

  template class Membrane<2>;
  template class Membrane<3>;
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "membrane.h"

#include "collective.h"
#include "expression.h"
#include "input_error.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools.h>

namespace abut::app
{
  template <int dim>
  Membrane<dim>::Membrane(
      dealii::parallel::distributed::Triangulation<dim> &triangulation,
      const unsigned int degree)
      : fe(degree),
        mapping(degree),
        dof_handler(triangulation),
        communicator(triangulation.get_communicator())
  {
  }

  template <int dim> la::Vector Membrane<dim>::vector() const
  {
    return la::Vector(dof_handler.locally_owned_dofs(), communicator);
  }

  template <int dim> void Membrane<dim>::setup(const MembraneData<dim> &data)
  {
    dof_handler.distribute_dofs(fe);
    dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);

    hanging.reinit(relevant);
    dealii::DoFTools::make_hanging_node_constraints(dof_handler, hanging);
    constraints.reinit(relevant);
    constraints.merge(hanging);
    dealii::VectorTools::interpolate_boundary_values(
        mapping, dof_handler, data.dirichlet, constraints);
    constraints.close();
    hanging.close();

    stiffness.clear();
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    dealii::DynamicSparsityPattern pattern(relevant);
    dealii::DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints,
                                            false);
    dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned,
                                                       communicator, relevant);
    stiffness.reinit(owned, owned, pattern, communicator);
  }

  template <int dim>
  void Membrane<dim>::assemble_cells(const MembraneData<dim> &data)
  {
    const dealii::QGauss<dim> quadrature(fe.degree + 1);
    dealii::UpdateFlags flags = dealii::update_values | dealii::update_gradients
                                | dealii::update_JxW_values;
    if (!data.constant_load || !data.constant_conductivity)
      flags |= dealii::update_quadrature_points;
    dealii::FEValues<dim> values(mapping, fe, quadrature, flags);

    const unsigned int n = fe.n_dofs_per_cell();
    dealii::FullMatrix<double> cell_matrix(n, n);
    dealii::Vector<double> cell_load(n);
    std::vector<dealii::types::global_dof_index> dofs(n);
    std::vector<double> k(quadrature.size(),
                          data.conductivity->value(dealii::Point<dim>()));
    std::vector<double> f(quadrature.size(),
                          data.load->value(dealii::Point<dim>()));

    for (const auto &cell : dof_handler.active_cell_iterators())
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
        constraints.distribute_local_to_global(cell_matrix, cell_load, dofs,
                                               stiffness, load);
      }
  }

  template <int dim>
  void Membrane<dim>::assemble_neumann(const MembraneData<dim> &data)
  {
    const dealii::QGauss<dim - 1> quadrature(fe.degree + 1);
    dealii::FEFaceValues<dim> values(mapping, fe, quadrature,
                                     dealii::update_values
                                         | dealii::update_JxW_values
                                         | dealii::update_quadrature_points);
    dealii::Vector<double> cell_load(fe.n_dofs_per_cell());
    std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
    std::vector<double> flux(quadrature.size());
    for (const auto &cell : dof_handler.active_cell_iterators())
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
          constraints.distribute_local_to_global(cell_load, dofs, load);
        }
  }

  template <int dim> void Membrane<dim>::assemble(const MembraneData<dim> &data)
  {
    stiffness = 0.;
    load.reinit(dof_handler.locally_owned_dofs(), relevant, communicator, true);
    collective(communicator,
               [&]
               {
                 assemble_cells(data);
                 if (!data.neumann.empty())
                   assemble_neumann(data);
               });
    stiffness.compress(dealii::VectorOperation::add);
    load.compress(dealii::VectorOperation::add);
    la::Vector owned = vector();
    owned = load;
    load.swap(owned);
  }

  template <int dim>
  void Membrane<dim>::residual(const la::Vector &u, la::Vector &result) const
  {
    stiffness.vmult(result, u);
    result.add(-1., load);
    constraints.set_zero(result);
  }

  template <int dim>
  la::Vector
  Membrane<dim>::ghosted(const la::Vector &owned,
                         const dealii::AffineConstraints<double> &rules) const
  {
    la::Vector distributed(owned);
    rules.distribute(distributed);
    la::Vector result(dof_handler.locally_owned_dofs(), relevant, communicator);
    result = distributed;
    return result;
  }

  template <int dim>
  la::Vector Membrane<dim>::ghosted(const la::Vector &owned) const
  {
    return ghosted(owned, constraints);
  }

  template <int dim>
  la::Vector Membrane<dim>::ghosted_field(const la::Vector &owned) const
  {
    return ghosted(owned, hanging);
  }

  template class Membrane<2>;
  template class Membrane<3>;
} // namespace abut::app

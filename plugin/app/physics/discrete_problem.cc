// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete_problem.h"
#include "scalar_field.h"
#include "shim/by_element.h"
#include "shim/cell_quadrature.h"

#include <abut/dealii/distribute.h>
#include <abut/dealii/mapping_by_cell.h>
#include <abut/dealii/versions.h>

#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    template <int dim>
    std::unique_ptr<const dealii::Mapping<dim>>
    make_mapping(const dealii::FiniteElement<dim> &fe,
                 const std::shared_ptr<const EdgeMiddles<dim>> &middles)
    {
      if (!shim::is_simplex(fe))
        return std::make_unique<dealii::MappingQ<dim>>(fe.degree);
      if (middles)
        return std::make_unique<MiddleNodes<dim>>(middles);
      return std::make_unique<dealii::MappingFE<dim>>(
          dealii::FE_SimplexP<dim>(1));
    }

    template <int dim>
    std::unique_ptr<const dealii::Mapping<dim>>
    make_mapping(const dealii::hp::FECollection<dim> &elements,
                 const std::shared_ptr<const EdgeMiddles<dim>> &middles)
    {
      if (elements.size() == 1)
        return make_mapping(elements[0], middles);
      dealii::hp::MappingCollection<dim> mappings;
      for (unsigned int i = 0; i < elements.size(); ++i)
        mappings.push_back(*make_mapping(elements[i], middles));
      return std::make_unique<MappingByCell<dim>>(mappings);
    }
  } // namespace

  template <int dim>
  DiscreteProblem<dim>::DiscreteProblem(
      dealii::Triangulation<dim> &triangulation,
      const dealii::hp::FECollection<dim> &elements,
      std::shared_ptr<const EdgeMiddles<dim>> middles)
      : elements(elements),
        own_mapping(make_mapping(elements, middles)),
        mapping(*own_mapping),
        dof_handler(triangulation),
        communicator(versions::communicator(triangulation))
  {
  }

  template <int dim> la::Vector DiscreteProblem<dim>::vector() const
  {
    return la::Vector(dof_handler.locally_owned_dofs(), communicator);
  }

  template <int dim>
  void DiscreteProblem<dim>::set_constraints(const Prescribe &prescribe)
  {
    constraints.clear();
    versions::reinit(constraints, dof_handler.locally_owned_dofs(), relevant);
    constraints.merge(hanging);
    prescribe(constraints);
    constraints.close();
  }

  template <int dim>
  void DiscreteProblem<dim>::distribute(const Prescribe &prescribe)
  {
    if (elements.size() > 1)
      choose_elements(elements, dof_handler);
    dof_handler.distribute_dofs(elements);
    if (renumber)
      dealii::DoFRenumbering::Cuthill_McKee(dof_handler);
    relevant = dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
    hanging.clear();
    versions::reinit(hanging, dof_handler.locally_owned_dofs(), relevant);
    dealii::DoFTools::make_hanging_node_constraints(dof_handler, hanging);
    hanging.close();
    set_constraints(prescribe);
    known_support_cells.reset();

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
  double DiscreteProblem<dim>::energy_norm(const la::Vector &difference) const
  {
    la::Vector free(difference), force = vector();
    constraints.set_zero(free);
    stiffness.vmult(force, free);
    return std::sqrt(std::max(0., free * force));
  }

  template <int dim>
  double DiscreteProblem<dim>::stored_energy(const la::Vector &u) const
  {
    la::Vector free(u);
    hanging.set_zero(free);
    return 0.5 * (stiffness_times(u) * free);
  }

  template <int dim> la::Vector DiscreteProblem<dim>::open_load() const
  {
    la::Vector open;
    open.reinit(dof_handler.locally_owned_dofs(), relevant, communicator, true);
    return open;
  }

  template <int dim>
  la::Vector DiscreteProblem<dim>::close_load(la::Vector &open) const
  {
    open.compress(dealii::VectorOperation::add);
    la::Vector owned = vector();
    owned = open;
    return owned;
  }

  template <int dim>
  void DiscreteProblem<dim>::linear_residual(const la::Vector &u,
                                             la::Vector &result) const
  {
    stiffness.vmult(result, u);
    result.add(-1., load);
    constraints.set_zero(result);
  }

  template <int dim>
  la::Vector DiscreteProblem<dim>::at_supports(const la::Vector &values) const
  {
    la::Vector free(values), result(values);
    constraints.set_zero(free);
    result.add(-1., free);
    hanging.set_zero(result);
    return result;
  }

  template <int dim>
  std::vector<typename DiscreteProblem<dim>::Cell>
  DiscreteProblem<dim>::find_support_cells() const
  {
    const auto is_supported = [&](const dealii::types::global_dof_index dof)
    { return constraints.is_constrained(dof) && !hanging.is_constrained(dof); };
    const auto knows_support = [&](const dealii::types::global_dof_index dof)
    {
      if (is_supported(dof))
        return true;
      const auto *masters = hanging.get_constraint_entries(dof);
      return masters != nullptr
             && std::any_of(masters->begin(), masters->end(),
                            [&](const auto &entry)
                            { return is_supported(entry.first); });
    };
    std::vector<Cell> result;
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        shim::get_dofs(cell, dofs);
        if (std::any_of(dofs.begin(), dofs.end(), knows_support))
          result.push_back(cell);
      }
    return result;
  }

  template <int dim>
  const std::vector<typename DiscreteProblem<dim>::Cell> &
  DiscreteProblem<dim>::support_cells() const
  {
    if (!known_support_cells)
      known_support_cells = find_support_cells();
    return *known_support_cells;
  }

  template <int dim>
  la::Vector DiscreteProblem<dim>::support_forces(
      const la::Vector &u, const CellStiffness &cell_stiffness) const
  {
    dealii::Vector<double> values, force;
    std::vector<dealii::types::global_dof_index> dofs;
    // One after the other: this is where a run needs most memory.
    const auto forces_of = [&](const la::Vector &part)
    {
      const la::Vector of = ghosted_field(part);
      la::Vector by = open_load();
      for (const Cell &cell : support_cells())
      {
        shim::get_dofs(cell, dofs);
        values.reinit(dofs.size(), true);
        force.reinit(dofs.size(), true);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          values(i) = of(dofs[i]);
        cell_stiffness(cell, force, values);
        versions::distribute_local_to_global(hanging, force, dofs, by);
      }
      return close_load(by);
    };
    la::Vector part(u);
    constraints.set_zero(part);
    la::Vector result = at_supports(forces_of(part));
    part.sadd(-1., u);
    hanging.set_zero(part);
    // Supports at rest: nothing else would be added.
    if (part.linfty_norm() > 0.)
      result += forces_of(part);
    return result;
  }

  template <int dim>
  la::Vector DiscreteProblem<dim>::free_forces(const la::Vector &u) const
  {
    la::Vector free(u), result = vector();
    constraints.set_zero(free);
    stiffness.vmult(result, free);
    return result;
  }

  template <int dim>
  la::Vector DiscreteProblem<dim>::ghosted(
      const la::Vector &owned,
      const dealii::AffineConstraints<double> &rules) const
  {
    la::Vector distributed(owned);
    rules.distribute(distributed);
    la::Vector result(dof_handler.locally_owned_dofs(), relevant, communicator);
    result = distributed;
    return result;
  }

  template <int dim>
  la::Vector DiscreteProblem<dim>::ghosted(const la::Vector &owned) const
  {
    return ghosted(owned, constraints);
  }

  template <int dim>
  la::Vector DiscreteProblem<dim>::ghosted_field(const la::Vector &owned) const
  {
    return ghosted(owned, hanging);
  }

  template class DiscreteProblem<2>;
  template class DiscreteProblem<3>;
} // namespace abut::app

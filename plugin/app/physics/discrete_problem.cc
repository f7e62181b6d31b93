// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete_problem.h"

#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  template <int dim>
  DiscreteProblem<dim>::DiscreteProblem(
      dealii::parallel::distributed::Triangulation<dim> &triangulation,
      std::unique_ptr<dealii::FiniteElement<dim>> element)
      : element(std::move(element)),
        fe(*this->element),
        mapping(fe.degree),
        dof_handler(triangulation),
        communicator(triangulation.get_communicator())
  {
  }

  template <int dim> la::Vector DiscreteProblem<dim>::vector() const
  {
    return la::Vector(dof_handler.locally_owned_dofs(), communicator);
  }

  template <int dim>
  void DiscreteProblem<dim>::set_constraints(const Prescribe &prescribe)
  {
    hanging.clear();
    hanging.reinit(relevant);
    dealii::DoFTools::make_hanging_node_constraints(dof_handler, hanging);
    constraints.clear();
    constraints.reinit(relevant);
    constraints.merge(hanging);
    prescribe(constraints);
    constraints.close();
    hanging.close();
  }

  template <int dim>
  void DiscreteProblem<dim>::distribute(const Prescribe &prescribe)
  {
    dof_handler.distribute_dofs(fe);
    if (renumber)
      dealii::DoFRenumbering::Cuthill_McKee(dof_handler);
    dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    set_constraints(prescribe);

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

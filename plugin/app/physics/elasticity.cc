// SPDX-License-Identifier: LGPL-2.1-or-later
#include "elasticity.h"

#include "app/input/collective.h"
#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "cell_sum.h"
#include "load_error.h"
#include "nodal_error.h"
#include "nodal_places.h"
#include "shim/values_by_element.h"
#include "stiffness_cache.h"

#include <abut/dealii/distribute.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  using dealii::types::boundary_id;
  using dealii::types::global_dof_index;

  namespace
  {
    /** Values of all components of a formula, checked, by component. */
    template <int dim>
    std::vector<std::vector<double>>
    evaluate_all(const Expression<dim> &expression,
                 const std::vector<dealii::Point<dim>> &points)
    {
      std::vector<std::vector<double>> result;
      for (unsigned int c = 0; c < expression.n_components; ++c)
        result.push_back(expression.evaluate(points, c));
      return result;
    }

    /** Call @p action(cell, points, state, dofs) for the cells of this rank,
     * with the state of a displacement (ghosted) at the points and one
     * component's shape functions there. */
    template <int dim, typename Action>
    void for_each_state(const DiscreteProblem<dim> &problem,
                        const la::Vector &displacement, const Action &action)
    {
      const auto flags = dealii::update_values | dealii::update_gradients
                         | dealii::update_JxW_values
                         | dealii::update_quadrature_points;
      const auto all_points = shim::cell_values(
          problem.mapping, problem.dof_handler, shim::mass_rule<dim>, flags,
          shim::ValuesOf::component);
      const shim::ByElement places_of(problem.dof_handler, nodal_places<dim>);
      CellState<dim> state;
      std::vector<global_dof_index> dofs;
      std::vector<double> values;
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          dealii::FEValues<dim> &points = all_points.of(cell);
          const NodalPlaces<dim> &places = places_of.of(cell);
          points.reinit(
              static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
                  cell));
          shim::get_dofs(cell, dofs);
          values.resize(dofs.size());
          for (std::size_t k = 0; k < dofs.size(); ++k)
            values[k] = displacement(dofs[k]);
          state.value.assign(points.n_quadrature_points, {});
          state.gradient.assign(points.n_quadrature_points, {});
          for (unsigned int q = 0; q < points.n_quadrature_points; ++q)
            for (unsigned int i = 0; i < places.n_nodes(); ++i)
              for (unsigned int c = 0; c < dim; ++c)
              {
                const double u = values[places(c, i)];
                state.value[q][c] += u * points.shape_value(i, q);
                state.gradient[q][c] += u * points.shape_grad(i, q);
              }
          action(cell, points, state, dofs);
        }
    }

    /** Call @p action(cell, values, forces) for the loaded boundary faces of
     * this rank, with the part of the force at each point of a rule. */
    template <int dim, typename Rule, typename Action>
    void for_each_loaded_face(const DiscreteProblem<dim> &problem,
                              const ElasticData<dim> &data, const Rule &rule,
                              const Action &action)
    {
      const auto values_of =
          shim::face_values(problem.mapping, problem.dof_handler, rule,
                            dealii::update_values | dealii::update_JxW_values
                                | dealii::update_normal_vectors
                                | dealii::update_quadrature_points,
                            shim::ValuesOf::component);
      std::vector<dealii::Tensor<1, dim>> forces;
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            if (!face->at_boundary())
              continue;
            const auto traction = data.tractions.find(face->boundary_id());
            const auto pressure = data.pressures.find(face->boundary_id());
            if (traction == data.tractions.end()
                && pressure == data.pressures.end())
              continue;
            dealii::FEFaceValues<dim> &values = values_of.of(cell);
            values.reinit(
                static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
                    cell),
                f);
            const auto &points = values.get_quadrature_points();
            std::vector<std::vector<double>> t;
            std::vector<double> p;
            if (traction != data.tractions.end())
              t = evaluate_all(*traction->second.function, points);
            if (pressure != data.pressures.end())
              p = pressure->second.function->evaluate(points);
            const Material<dim> &material =
                *data.materials.at(cell->material_id());
            forces.resize(points.size());
            for (unsigned int q = 0; q < points.size(); ++q)
            {
              for (unsigned int c = 0; c < dim; ++c)
                forces[q][c] =
                    (t.empty() ? 0. : t[c][q])
                    - (p.empty() ? 0. : p[q] * values.normal_vector(q)[c]);
              forces[q] *= values.JxW(q) * material.measure(points[q]);
            }
            action(cell, values, forces);
          }
    }

    /** The same for the cells of this rank with a body force. */
    template <int dim, typename Rule, typename Action>
    void for_each_loaded_cell(const DiscreteProblem<dim> &problem,
                              const ElasticData<dim> &data, const Rule &rule,
                              const Action &action)
    {
      const auto values_of = shim::cell_values(
          problem.mapping, problem.dof_handler, rule,
          dealii::update_values | dealii::update_quadrature_points
              | dealii::update_JxW_values,
          shim::ValuesOf::component);
      std::vector<dealii::Tensor<1, dim>> forces;
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const auto given = data.body_force.find(cell->material_id());
        if (given == data.body_force.end())
          continue;
        dealii::FEValues<dim> &values = values_of.of(cell);
        values.reinit(
            static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
                cell));
        const auto &points = values.get_quadrature_points();
        const Material<dim> &material = *data.materials.at(cell->material_id());
        forces.resize(points.size());
        for (unsigned int c = 0; c < dim; ++c)
        {
          const std::vector<double> f = given->second->evaluate(points, c);
          for (unsigned int q = 0; q < points.size(); ++q)
            forces[q][c] = f[q] * (values.JxW(q) * material.measure(points[q]));
        }
        action(cell, values, forces);
      }
    }

    template <int dim>
    dealii::hp::FECollection<dim> make_elements(const CellDegrees &degrees)
    {
      using System = dealii::FESystem<dim>;
      dealii::hp::FECollection<dim> result;
      if (degrees.cubes > 0)
        result.push_back(System(dealii::FE_Q<dim>(degrees.cubes), dim));
      if (degrees.simplices > 0)
        result.push_back(
            System(dealii::FE_SimplexP<dim>(degrees.simplices), dim));
      return result;
    }
  } // namespace

  template <int dim>
  Elasticity<dim>::Elasticity(dealii::Triangulation<dim> &triangulation,
                              const CellDegrees &degrees,
                              std::shared_ptr<const EdgeMiddles<dim>> middles)
      : DiscreteProblem<dim>(triangulation, make_elements<dim>(degrees),
                             middles),
        materials(std::make_unique<Materials<dim>>())
  {
  }

  template <int dim> Elasticity<dim>::~Elasticity() = default;

  template <int dim>
  typename Elasticity<dim>::Values
  Elasticity<dim>::support_values(const ElasticData<dim> &data) const
  {
    Values all;
    std::map<global_dof_index, boundary_id> where;
    double largest = 0.;
    for (const auto &[id, condition] : data.supports)
    {
      Values values;
      const CheckedExpression<dim> function(*condition.function);
      dealii::VectorTools::interpolate_boundary_values(
          this->mapping, this->dof_handler,
          std::map<boundary_id, const dealii::Function<dim> *>{{id, &function}},
          values, condition.components);
      for (const auto &[dof, value] : values)
      {
        largest = std::max(largest, std::abs(value));
        const auto [entry, is_new] = all.emplace(dof, value);
        if (!is_new && std::abs(entry->second - value) > 1e-10 * largest)
          throw InputError(condition.function->parameter(),
                           data.name(where.at(dof)) + " and " + data.name(id)
                               + " share a node and prescribe different "
                                 "displacements there, "
                               + short_number(entry->second) + " and "
                               + short_number(value)
                               + ". Make them agree at the corner, or leave "
                                 "the component free on one of them.");
        where[dof] = id;
      }
    }
    return all;
  }

  template <int dim>
  void Elasticity<dim>::prescribe(
      const ElasticData<dim> &data,
      dealii::AffineConstraints<double> &constraints) const
  {
    Values values;
    collective(this->communicator, [&] { values = support_values(data); });
    for (const auto &[dof, value] : values)
      if (this->relevant.is_element(dof) && !constraints.is_constrained(dof))
      {
        constraints.add_line(dof);
        constraints.set_inhomogeneity(dof, value);
      }
  }

  template <int dim> void Elasticity<dim>::setup(const ElasticData<dim> &data)
  {
    *materials = data.materials;
    this->distribute([&](dealii::AffineConstraints<double> &constraints)
                     { prescribe(data, constraints); });
    cache = std::make_unique<StiffnessCaches<dim>>(
        this->dof_handler, [&](const dealii::FiniteElement<dim> &fe)
        { return StiffnessCache<dim>(this->mapping, fe, *materials); });
  }

  template <int dim>
  void Elasticity<dim>::set_supports(const ElasticData<dim> &data)
  {
    this->set_constraints([&](dealii::AffineConstraints<double> &constraints)
                          { prescribe(data, constraints); });
  }

  template <int dim> bool Elasticity<dim>::is_linear() const
  {
    return std::all_of(materials->begin(), materials->end(),
                       [](const auto &entry)
                       { return entry.second->is_linear(); });
  }

  template <int dim> void Elasticity<dim>::assemble_stiffness()
  {
    if (!is_linear())
    {
      assemble_tangent(this->vector());
      la::copy(this->stiffness, undeformed);
      return;
    }
    CellSum<dim> sum(*this, this->stiffness);
    std::vector<global_dof_index> dofs;
    for (const auto &cell : this->dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        shim::get_dofs(cell, dofs);
        sum.add(cache->of(cell).matrix(cell), dofs);
      }
    sum.close();
  }

  template <int dim> void Elasticity<dim>::assemble_tangent(const la::Vector &u)
  {
    CellSum<dim> sum(*this, this->stiffness);
    dealii::FullMatrix<double> tangent;
    for_each_state(*this, this->ghosted_field(u),
                   [&](const auto &cell, const auto &points, const auto &state,
                       const auto &dofs)
                   {
                     if (tangent.m() != dofs.size())
                       tangent.reinit(dofs.size(), dofs.size());
                     materials->at(cell->material_id())
                         ->cell_tangent(points, cell->get_fe(), state, tangent);
                     sum.add(tangent, dofs);
                   });
    sum.close();
  }

  template <int dim>
  const la::Matrix &Elasticity<dim>::tangent(const la::Vector &u)
  {
    if (!is_linear())
      assemble_tangent(u);
    return this->stiffness;
  }

  template <int dim>
  void Elasticity<dim>::residual(const la::Vector &u, la::Vector &result) const
  {
    if (is_linear())
    {
      this->linear_residual(u, result);
      return;
    }
    result = forces_by(u, this->constraints);
    result.add(-1., this->load);
    this->constraints.set_zero(result);
  }

  template <int dim>
  void Elasticity<dim>::add_forces(const ElasticData<dim> &data,
                                   la::Vector &load, la::Vector &all) const
  {
    const shim::ByElement places_of(this->dof_handler, nodal_places<dim>);
    dealii::Vector<double> force;
    std::vector<global_dof_index> dofs;
    const auto add = [&](const auto &cell, const auto &values,
                         const std::vector<dealii::Tensor<1, dim>> &forces)
    {
      const NodalPlaces<dim> &places = places_of.of(cell);
      shim::get_dofs(cell, dofs);
      force.reinit(dofs.size());
      for (unsigned int q = 0; q < forces.size(); ++q)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int i = 0; i < places.n_nodes(); ++i)
            force(places(c, i)) += forces[q][c] * values.shape_value(i, q);
      versions::distribute_local_to_global(this->constraints, force, dofs,
                                           load);
      versions::distribute_local_to_global(this->hanging, force, dofs, all);
    };
    for_each_loaded_cell(*this, data, shim::mass_rule<dim>, add);
    if (!data.tractions.empty() || !data.pressures.empty())
      for_each_loaded_face(*this, data, shim::face_mass_rule<dim>, add);
  }

  template <int dim>
  std::optional<double>
  Elasticity<dim>::load_error(const ElasticData<dim> &data) const
  {
    const auto varies = [](const auto &conditions)
    {
      return std::any_of(
          conditions.begin(), conditions.end(),
          [](const auto &condition)
          { return !condition.second.function->is_wholly_constant(); });
    };
    const bool on_faces = varies(data.tractions) || varies(data.pressures),
               in_cells =
                   std::any_of(data.body_force.begin(), data.body_force.end(),
                               [](const auto &force)
                               { return !force.second->is_constant(); });
    LoadError error(this->communicator);
    const auto with_forces = [](const auto &action)
    {
      return [&action](const auto &, const auto &, const auto &forces)
      { action(forces); };
    };
    if (on_faces)
      error.compare<dim - 1, dim>(
          [&](const auto &rule, const auto &action)
          { for_each_loaded_face(*this, data, rule, with_forces(action)); },
          shim::face_mass_rule<dim>);
    if (in_cells)
      error.compare<dim, dim>(
          [&](const auto &rule, const auto &action)
          { for_each_loaded_cell(*this, data, rule, with_forces(action)); },
          shim::mass_rule<dim>);
    return error.relative();
  }

  template <int dim>
  std::optional<double>
  Elasticity<dim>::support_error(const ElasticData<dim> &data) const
  {
    std::vector<OnBoundary<dim>> displacements;
    for (const auto &[id, condition] : data.supports)
      if (!condition.function->is_wholly_constant())
        displacements.push_back(
            {condition.function, condition.components, {id}});
    return nodal_error(*this, displacements);
  }

  template <int dim>
  void Elasticity<dim>::add_support_forces(la::Vector &load) const
  {
    std::vector<global_dof_index> dofs;
    dealii::Vector<double> moved, force;
    for (const auto &cell : this->support_cells())
    {
      shim::get_dofs(cell, dofs);
      moved.reinit(dofs.size(), true);
      force.reinit(dofs.size(), true);
      for (std::size_t i = 0; i < dofs.size(); ++i)
        moved(i) = this->constraints.get_inhomogeneity(dofs[i]);
      if (moved.all_zero())
        continue;
      cache->of(cell).vmult(cell, force, moved);
      force *= -1.;
      versions::distribute_local_to_global(this->constraints, force, dofs,
                                           load);
    }
  }

  template <int dim>
  void Elasticity<dim>::assemble_load(const ElasticData<dim> &data)
  {
    la::Vector open = this->open_load();
    la::Vector all = this->open_load();
    collective(this->communicator, [&] { add_forces(data, open, all); });
    const bool has_values = this->constraints.has_inhomogeneities();
    if (is_linear()
        && dealii::Utilities::MPI::logical_or(has_values, this->communicator))
      add_support_forces(open);
    la::Vector closed = this->close_load(open);
    this->load.swap(closed);
    la::Vector closed_all = this->close_load(all);
    this->external.swap(closed_all);
  }

  template <int dim>
  la::Vector Elasticity<dim>::forces_by(
      const la::Vector &u, const dealii::AffineConstraints<double> &rules) const
  {
    const la::Vector ghosted = this->ghosted_field(u);
    la::Vector open = this->open_load();
    dealii::Vector<double> force;
    for_each_state(*this, ghosted,
                   [&](const auto &cell, const auto &points, const auto &state,
                       const auto &dofs)
                   {
                     force.reinit(dofs.size(), true);
                     materials->at(cell->material_id())
                         ->cell_forces(points, cell->get_fe(), state, force);
                     versions::distribute_local_to_global(rules, force, dofs,
                                                          open);
                   });
    return this->close_load(open);
  }

  template <int dim>
  la::Vector Elasticity<dim>::stiffness_times(const la::Vector &u) const
  {
    la::Vector result = this->free_forces(u);
    result += this->support_forces(
        u, [this](const auto &cell, auto &force, const auto &values)
        { cache->of(cell).vmult(cell, force, values); });
    return result;
  }

  template <int dim>
  la::Vector Elasticity<dim>::internal_forces(const la::Vector &u) const
  {
    return is_linear() ? stiffness_times(u) : forces_by(u, this->hanging);
  }

  template <int dim>
  la::Vector Elasticity<dim>::all_internal_forces(const la::Vector &u) const
  {
    if (!is_linear())
      return forces_by(u, this->hanging);
    la::Vector all(u);
    this->constraints.distribute(all);
    return stiffness_times(all);
  }

  template <int dim>
  NodalForces Elasticity<dim>::nodal_forces(const la::Vector &u) const
  {
    return {all_internal_forces(u), this->external};
  }

  template <int dim>
  la::Vector Elasticity<dim>::unbalanced_forces(const la::Vector &u) const
  {
    la::Vector result = all_internal_forces(u);
    result.add(-1., this->external);
    return result;
  }

  template <int dim>
  double Elasticity<dim>::stored_energy(const la::Vector &u) const
  {
    if (is_linear())
      return DiscreteProblem<dim>::stored_energy(u);
    double energy = 0.;
    for_each_state(
        *this, this->ghosted_field(u),
        [&](const auto &cell, const auto &points, const auto &state,
            const auto &)
        {
          const auto material =
              materials->at(cell->material_id())->in_cell(points, state);
          for (unsigned int q = 0; q < state.value.size(); ++q)
          {
            const dealii::Point<dim> &x = points.quadrature_point(q);
            energy += material->energy(state.gradient[q], state.value[q], x)
                      * points.JxW(q) * material->measure(x);
          }
        });
    return dealii::Utilities::MPI::sum(energy, this->communicator);
  }

  template <int dim> double Elasticity<dim>::energy(const la::Vector &u) const
  {
    la::Vector all(u);
    this->constraints.distribute(all);
    if (!is_linear())
    {
      const double stored = stored_energy(all);
      this->hanging.set_zero(all);
      return stored - this->external * all;
    }
    la::Vector forces = stiffness_times(all);
    forces.sadd(0.5, -1., this->external);
    this->hanging.set_zero(all);
    return forces * all;
  }

  template class Elasticity<2>;
  template class Elasticity<3>;
} // namespace abut::app

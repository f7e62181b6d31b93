// SPDX-License-Identifier: LGPL-2.1-or-later
#include "membrane.h"

#include "app/input/collective.h"
#include "app/input/expression.h"
#include "app/input/input_error.h"
#include "cell_sum.h"
#include "error_norms.h"
#include "load_error.h"
#include "nodal_error.h"
#include "shim/cell_quadrature.h"
#include "shim/shifted_cells.h"
#include "shim/values_by_element.h"

#include <abut/dealii/distribute.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/vector_tools.h>

namespace abut::app
{
  namespace
  {
    /** Stiffness and load of one cell after the other. */
    template <int dim> class CellSystem
    {
    public:
      CellSystem(const DiscreteProblem<dim> &problem,
                 const MembraneData<dim> &data)
          : matrix(problem.elements[0].n_dofs_per_cell(),
                   problem.elements[0].n_dofs_per_cell()),
            load(problem.elements[0].n_dofs_per_cell()),
            data(data),
            quadrature(shim::gauss(problem.elements[0],
                                   problem.elements[0].degree + 1)),
            values(problem.mapping, problem.elements[0], quadrature,
                   flags(data)),
            shapes(problem.mapping),
            k(quadrature.size(),
              data.conductivity->value(dealii::Point<dim>())),
            f(quadrature.size(), data.load->value(dealii::Point<dim>()))
      {
      }

      /** Throws InputError for values of k and f that are not legal. */
      template <typename Cell> void compute(const Cell &cell)
      {
        if (!is_new(cell))
          return;
        fill_matrix();
        fill_load();
      }

      /** The load alone, on all cells that this object goes to. */
      template <typename Cell> void compute_load(const Cell &cell)
      {
        if (is_new(cell))
          fill_load();
      }

      dealii::FullMatrix<double> matrix;
      dealii::Vector<double> load;

    private:
      /** Go to a cell; false: it is shifted only, and has the same matrix and
       * load as the last. */
      template <typename Cell> bool is_new(const Cell &cell)
      {
        const bool same = data.constant_load && data.constant_conductivity;
        if (same && shapes.is_shifted(cell))
          return false;
        values.reinit(cell);
        return !same
               || values.get_cell_similarity()
                      != dealii::CellSimilarity::translation;
      }

      static dealii::UpdateFlags flags(const MembraneData<dim> &data)
      {
        const auto always = dealii::update_values | dealii::update_gradients
                            | dealii::update_JxW_values;
        return data.constant_load && data.constant_conductivity
                   ? always
                   : always | dealii::update_quadrature_points;
      }

      void fill_matrix()
      {
        if (!data.constant_conductivity)
          checked_values(*data.conductivity, values.get_quadrature_points(),
                         "Membrane/Conductivity", k);
        for (const double here : k)
          if (!(here > 0.))
            throw InputError("Membrane/Conductivity",
                             "The conductivity must be positive; it is "
                                 + std::to_string(here) + " somewhere.");
        matrix = 0.;
        const unsigned int n = matrix.m();
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          for (unsigned int i = 0; i < n; ++i)
          {
            const auto gradient =
                (k[q] * values.JxW(q)) * values.shape_grad(i, q);
            for (unsigned int j = 0; j <= i; ++j)
              matrix(i, j) += gradient * values.shape_grad(j, q);
          }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = i + 1; j < n; ++j)
            matrix(i, j) = matrix(j, i);
      }

      void fill_load()
      {
        if (!data.constant_load)
          checked_values(*data.load, values.get_quadrature_points(),
                         "Membrane/Body force", f);
        load = 0.;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          for (unsigned int i = 0; i < load.size(); ++i)
            load(i) += f[q] * values.JxW(q) * values.shape_value(i, q);
      }

      const MembraneData<dim> &data;
      const dealii::Quadrature<dim> quadrature;
      dealii::FEValues<dim> values;
      shim::ShiftedCells<dim> shapes;
      std::vector<double> k, f;
    };

    /** The load by fluxes through the faces of one cell after the other. */
    template <int dim> class CellFlux
    {
    public:
      CellFlux(const DiscreteProblem<dim> &problem,
               const MembraneData<dim> &data)
          : load(problem.elements[0].n_dofs_per_cell()),
            data(data),
            quadrature(shim::face_gauss(problem.elements[0],
                                        problem.elements[0].degree + 1)),
            values(problem.mapping, problem.elements[0], quadrature,
                   dealii::update_values | dealii::update_JxW_values
                       | dealii::update_quadrature_points),
            flux(quadrature.size())
      {
      }

      /** Whether there is any. */
      template <typename Cell> bool compute(const Cell &cell)
      {
        bool any = false;
        if (data.neumann.empty() || !cell->at_boundary())
          return any;
        load = 0.;
        for (const auto &face : cell->face_iterators())
        {
          if (!face->at_boundary()
              || data.neumann.count(face->boundary_id()) == 0)
            continue;
          any = true;
          values.reinit(cell, face);
          checked_values(*data.neumann.at(face->boundary_id()),
                         values.get_quadrature_points(), "Membrane/Traction",
                         flux);
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            for (unsigned int i = 0; i < load.size(); ++i)
              load(i) += flux[q] * values.JxW(q) * values.shape_value(i, q);
        }
        return any;
      }

      dealii::Vector<double> load;

    private:
      const MembraneData<dim> &data;
      const dealii::Quadrature<dim - 1> quadrature;
      dealii::FEFaceValues<dim> values;
      std::vector<double> flux;
    };

    /** Values of @p f at the points of @p values times their weights, checked,
     * as forces out of the plane. */
    template <int dim, typename Values>
    std::vector<dealii::Tensor<1, 1>> weighted(const dealii::Function<dim> &f,
                                               const Values &values,
                                               const char *parameter)
    {
      const auto &points = values.get_quadrature_points();
      std::vector<double> at_points(points.size());
      checked_values(f, points, parameter, at_points);
      std::vector<dealii::Tensor<1, 1>> forces(points.size());
      for (unsigned int q = 0; q < points.size(); ++q)
        forces[q][0] = at_points[q] * values.JxW(q);
      return forces;
    }
  } // namespace

  template <int dim>
  Membrane<dim>::Membrane(dealii::Triangulation<dim> &triangulation,
                          const unsigned int degree)
      : LinearProblem<dim>(triangulation, dealii::hp::FECollection<dim>(
                                              dealii::FE_Q<dim>(degree)))
  {
  }

  template <int dim>
  typename Membrane<dim>::Prescribe
  Membrane<dim>::dirichlet_values(const MembraneData<dim> &data) const
  {
    return [&](dealii::AffineConstraints<double> &values)
    {
      collective(this->communicator,
                 [&]
                 {
                   dealii::VectorTools::interpolate_boundary_values(
                       this->mapping, this->dof_handler, data.dirichlet,
                       values);
                 });
    };
  }

  template <int dim> void Membrane<dim>::setup(const MembraneData<dim> &data)
  {
    this->distribute(dirichlet_values(data));
  }

  template <int dim>
  void Membrane<dim>::prescribe(const MembraneData<dim> &data)
  {
    this->set_constraints(dirichlet_values(data));
  }

  template <int dim> void Membrane<dim>::assemble(const MembraneData<dim> &data)
  {
    CellSum<dim> sum(*this, this->stiffness);
    la::Vector open = this->open_load();
    std::vector<dealii::types::global_dof_index> dofs(
        this->elements[0].n_dofs_per_cell());
    const auto add = [&]
    {
      CellSystem<dim> system(*this, data);
      CellFlux<dim> flux(*this, data);
      for (const auto &cell : this->dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        cell->get_dof_indices(dofs);
        system.compute(cell);
        sum.add(system.matrix, system.load, dofs, open);
        if (flux.compute(cell))
          versions::distribute_local_to_global(this->constraints, flux.load,
                                               dofs, open);
      }
    };
    collective(this->communicator, add);
    sum.close();
    la::Vector closed = this->close_load(open);
    closed += sum.loads();
    this->load.swap(closed);
    assembled = data;
  }

  template <int dim>
  std::optional<double>
  Membrane<dim>::load_error(const MembraneData<dim> &data) const
  {
    const auto flags =
        dealii::update_quadrature_points | dealii::update_JxW_values;
    const dealii::FiniteElement<dim> &fe = this->elements[0];
    LoadError error(this->communicator);
    if (!data.constant_load)
      error.compare<dim, 1>(
          [&](const auto &rule, const auto &action)
          {
            dealii::FEValues<dim> values(this->mapping, fe, rule(fe), flags);
            for (const auto &cell : this->dof_handler.active_cell_iterators())
              if (cell->is_locally_owned())
              {
                values.reinit(cell);
                action(weighted(*data.load, values, "Membrane/Body force"));
              }
          },
          shim::mass_rule<dim>);
    if (!data.constant_neumann)
      error.compare<dim - 1, 1>(
          [&](const auto &rule, const auto &action)
          {
            dealii::FEFaceValues<dim> values(this->mapping, fe, rule(fe),
                                             flags);
            for (const auto &cell : this->dof_handler.active_cell_iterators())
              for (const unsigned int f : cell->face_indices())
              {
                const auto flux =
                    cell->is_locally_owned() && cell->face(f)->at_boundary()
                        ? data.neumann.find(cell->face(f)->boundary_id())
                        : data.neumann.end();
                if (flux == data.neumann.end())
                  continue;
                values.reinit(cell, f);
                action(weighted(*flux->second, values, "Membrane/Traction"));
              }
          },
          shim::face_mass_rule<dim>);
    return error.relative();
  }

  template <int dim>
  std::optional<double>
  Membrane<dim>::support_error(const MembraneData<dim> &data) const
  {
    std::vector<OnBoundary<dim>> displacements;
    if (!data.constant_dirichlet)
      for (const auto &[id, function] : data.dirichlet)
        displacements.push_back(
            {function, dealii::ComponentMask(1, true), {id}});
    return nodal_error(*this, displacements);
  }

  template <int dim> la::Vector Membrane<dim>::loads_at_supports() const
  {
    la::Vector open = this->open_load();
    CellSystem<dim> system(*this, assembled);
    CellFlux<dim> flux(*this, assembled);
    std::vector<dealii::types::global_dof_index> dofs(
        this->elements[0].n_dofs_per_cell());
    for (const auto &cell : this->support_cells())
    {
      cell->get_dof_indices(dofs);
      system.compute(cell);
      versions::distribute_local_to_global(this->hanging, system.load, dofs,
                                           open);
      if (flux.compute(cell))
        versions::distribute_local_to_global(this->hanging, flux.load, dofs,
                                             open);
    }
    return this->at_supports(this->close_load(open));
  }

  template <int dim>
  void Membrane<dim>::assemble_stiffness(const MembraneData<dim> &data)
  {
    CellSum<dim> sum(*this, this->stiffness);
    std::vector<dealii::types::global_dof_index> dofs(
        this->elements[0].n_dofs_per_cell());
    const auto add = [&]
    {
      CellSystem<dim> system(*this, data);
      for (const auto &cell : this->dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        cell->get_dof_indices(dofs);
        system.compute(cell);
        sum.add(system.matrix, dofs);
      }
    };
    collective(this->communicator, add);
    sum.close();
    assembled = data;
  }

  template <int dim>
  void Membrane<dim>::assemble_load(const MembraneData<dim> &data)
  {
    la::Vector open = this->open_load();
    std::vector<dealii::types::global_dof_index> dofs(
        this->elements[0].n_dofs_per_cell());
    const auto add = [&]
    {
      CellSystem<dim> system(*this, data);
      CellFlux<dim> flux(*this, data);
      for (const auto &cell : this->dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        cell->get_dof_indices(dofs);
        system.compute_load(cell);
        versions::distribute_local_to_global(this->hanging, system.load, dofs,
                                             open);
        if (flux.compute(cell))
          versions::distribute_local_to_global(this->hanging, flux.load, dofs,
                                               open);
      }
    };
    collective(this->communicator, add);
    la::Vector closed = this->close_load(open);
    this->external.swap(closed);
    assembled = data;
    // What is prescribed pulls at its neighbours.
    la::Vector prescribed = this->vector();
    this->constraints.distribute(prescribed);
    la::Vector load(this->external);
    load -= stiffness_times(prescribed);
    this->constraints.set_zero(load);
    this->load.swap(load);
  }

  template <int dim>
  la::Vector Membrane<dim>::stiffness_times(const la::Vector &u) const
  {
    la::Vector result = this->free_forces(u);
    result += forces_of_supports(u);
    return result;
  }

  template <int dim>
  la::Vector Membrane<dim>::forces_of_supports(const la::Vector &u) const
  {
    CellSystem<dim> system(*this, assembled);
    return this->support_forces(
        u,
        [&](const auto &cell, auto &force, const auto &values)
        {
          system.compute(cell);
          system.matrix.vmult(force, values);
        });
  }

  template <int dim>
  NodalForces Membrane<dim>::nodal_forces(const la::Vector &u) const
  {
    la::Vector all(u);
    this->constraints.distribute(all);
    const la::Vector of_supports = forces_of_supports(all);
    NodalForces result{this->free_forces(all), this->load};
    result.internal += of_supports;
    // The load has what prescribed values add already.
    la::Vector at_free(of_supports);
    this->constraints.set_zero(at_free);
    result.external += at_free;
    result.external += loads_at_supports();
    return result;
  }

  template <int dim> double Membrane<dim>::energy(const la::Vector &u) const
  {
    if (dealii::Utilities::MPI::logical_or(
            this->constraints.has_inhomogeneities(), this->communicator))
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mass.h"

#include "app/input/input_error.h"
#include "nodal_places.h"
#include "shim/cell_quadrature.h"
#include "shim/values_by_element.h"
#include "whole_matrix.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <sstream>

namespace abut::app
{
  using dealii::types::global_dof_index;

  namespace
  {
    /** Integrals of density and shape functions of one component. */
    template <int dim>
    dealii::FullMatrix<double> scalar_mass(const dealii::FEValues<dim> &values,
                                           const std::vector<double> &density)
    {
      const unsigned int n = values.get_fe().n_dofs_per_cell();
      dealii::FullMatrix<double> result(n);
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
      {
        const double dm = density[q] * values.JxW(q);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            result(i, j) +=
                dm * values.shape_value(i, q) * values.shape_value(j, q);
      }
      return result;
    }

    void lump(dealii::FullMatrix<double> &mass)
    {
      for (unsigned int i = 0; i < mass.m(); ++i)
      {
        double sum = 0.;
        for (unsigned int j = 0; j < mass.n(); ++j)
        {
          sum += mass(i, j);
          mass(i, j) = 0.;
        }
        mass(i, i) = sum;
      }
    }

    /** Take all mass from candidates, the other nodes have it in proportion to
     * their diagonals: positive, where entries of both signs, as those of
     * quadratic simplices, would leave an indefinite matrix. */
    void hand_to_others(const std::vector<std::uint8_t> &candidate,
                        dealii::FullMatrix<double> &mass)
    {
      double all = 0., others = 0.;
      for (unsigned int i = 0; i < mass.m(); ++i)
      {
        for (unsigned int j = 0; j < mass.n(); ++j)
          all += mass(i, j);
        others += candidate[i] == 0 ? mass(i, i) : 0.;
      }
      for (unsigned int i = 0; i < mass.m(); ++i)
        for (unsigned int j = 0; j < mass.n(); ++j)
          mass(i, j) *= i == j && candidate[i] == 0 ? all / others : 0.;
    }

    /** Make the mass of a cell that of its kind.
     * @param candidate of each node of the cell */
    template <int dim>
    void
    change_kind(const typename dealii::DoFHandler<dim>::cell_iterator &cell,
                const abut_time_mass kind,
                const std::vector<std::uint8_t> &candidate,
                dealii::FullMatrix<double> &mass)
    {
      if (kind == ABUT_TIME_MASS_LUMPED)
        lump(mass);
      if (kind != ABUT_TIME_MASS_MODIFIED
          || std::count(candidate.begin(), candidate.end(), 1) == 0)
        return;
      const bool has_others =
          std::count(candidate.begin(), candidate.end(), 0) > 0;
      if (has_others && shim::is_simplex(cell->get_fe())
          && cell->get_fe().degree > 1)
        return hand_to_others(candidate, mass);
      if (abut_mass_modify_element(static_cast<std::int32_t>(mass.m()),
                                   candidate.data(), &mass(0, 0))
          == ABUT_SUCCESS)
        return;
      std::ostringstream message;
      message
          << "all nodes of the cell at (" << cell->center()
          << ") are on the secondary surface of a pair: the body is one "
             "element thick there, and no neighbour can receive their mass. "
             "Refine it, or set Time stepping/Mass matrix = consistent.";
      throw InputError("Time stepping/Mass matrix", message.str());
    }
  } // namespace

  template <int dim>
  la::Matrix mass_matrix(const DiscreteProblem<dim> &problem,
                         const MassData<dim> &data)
  {
    const auto values_of = shim::cell_values(
        problem.mapping, problem.dof_handler, shim::mass_rule<dim>,
        dealii::update_values | dealii::update_JxW_values
            | dealii::update_quadrature_points,
        shim::ValuesOf::component);
    dealii::IndexSet touching(problem.dof_handler.n_dofs());
    if (!data.candidates.empty())
      touching = dealii::DoFTools::extract_boundary_dofs(
          problem.dof_handler, dealii::ComponentMask(), data.candidates);
    const shim::ByElement places_of(problem.dof_handler, nodal_places<dim>);
    std::vector<std::uint8_t> candidate;
    const auto compute = [&](const auto &cell,
                             const std::vector<global_dof_index> &dofs,
                             dealii::FullMatrix<double> &of_cell)
    {
      dealii::FEValues<dim> &values = values_of.of(cell);
      const NodalPlaces<dim> &places = places_of.of(cell);
      const unsigned int n = places.n_nodes();
      candidate.resize(n);
      values.reinit(
          static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
              cell));
      dealii::FullMatrix<double> scalar =
          scalar_mass(values, data.density(cell->material_id(),
                                           values.get_quadrature_points()));
      for (unsigned int i = 0; i < n; ++i)
        candidate[i] = touching.is_element(dofs[places(0, i)]);
      change_kind<dim>(cell, data.kind, candidate, scalar);
      of_cell = 0.;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int c = 0; c < problem.n_components(); ++c)
            of_cell(places(c, i), places(c, j)) = scalar(i, j);
    };
    return whole_matrix<dim>(problem, compute,
                             data.kind == ABUT_TIME_MASS_LUMPED);
  }

  template <int dim>
  la::Matrix free_part(const DiscreteProblem<dim> &problem,
                       const la::Matrix &mass)
  {
    const la::LocalRows rows = la::local_rows(mass);
    const dealii::IndexSet &owned = problem.dof_handler.locally_owned_dofs();
    const auto is_free = [&](const global_dof_index unknown)
    { return !problem.constraints.is_constrained(unknown); };
    return la::assemble(
        owned, problem.relevant, versions::communicator(problem.dof_handler),
        [&](const auto &add)
        {
          for (const global_dof_index row : owned)
            add(row, {row}, {0.});
          for (int i = 0; i < rows.n_rows; ++i)
          {
            const global_dof_index row = owned.nth_index_in_set(i);
            std::vector<global_dof_index> columns;
            std::vector<double> entries;
            for (int k = rows.start[i]; k < rows.start[i + 1]; ++k)
            {
              const global_dof_index column =
                  la::global_column(mass, rows.column[k]);
              if (!is_free(column))
                continue;
              columns.push_back(column);
              entries.push_back(rows.value[k]);
            }
            if (is_free(row) && !columns.empty())
              add(row, columns, entries);
          }
        });
  }

  template la::Matrix mass_matrix(const DiscreteProblem<2> &,
                                  const MassData<2> &);
  template la::Matrix mass_matrix(const DiscreteProblem<3> &,
                                  const MassData<3> &);
  template la::Matrix free_part(const DiscreteProblem<2> &, const la::Matrix &);
  template la::Matrix free_part(const DiscreteProblem<3> &, const la::Matrix &);
} // namespace abut::app

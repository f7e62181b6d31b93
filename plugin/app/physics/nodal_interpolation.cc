// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nodal_interpolation.h"

#include "app/input/collective.h"
#include "app/input/input_error.h"
#include "app/input/short_number.h"

#include <abut/dealii/versions.h>

#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Larger ones lead out of the numbers in a step, and who meets them then
     * is not who they came from. */
    constexpr double largest_value = 1e30;

    template <int dim>
    void check_size(const double value, const dealii::Point<dim> &place,
                    const Expression<dim> &formula)
    {
      if (std::abs(value) <= largest_value)
        return;
      std::string at = "(" + short_number(place[0]);
      for (unsigned int d = 1; d < dim; ++d)
        at += ", " + short_number(place[d]);
      throw InputError(formula.parameter(),
                       "'" + formula.text() + "' is " + short_number(value)
                           + " at " + at + "): more than "
                           + short_number(largest_value)
                           + ", which is not a state at the start.");
    }

    /** Put the values of a formula at the nodes of a cell into their places. */
    template <int dim, typename Cell>
    void put_values(const DiscreteProblem<dim> &problem, const Cell &cell,
                    const Expression<dim> &formula, la::Vector &values)
    {
      const dealii::FiniteElement<dim> &fe = cell->get_fe();
      const auto &owned = problem.dof_handler.locally_owned_dofs();
      std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      std::vector<dealii::Point<dim>> places;
      for (const auto &point : fe.base_element(0).get_unit_support_points())
        places.push_back(
            problem.mapping.transform_unit_to_real_cell(cell, point));
      for (unsigned int c = 0; c < fe.n_components(); ++c)
      {
        const std::vector<double> value = formula.evaluate(places, c);
        for (unsigned int i = 0; i < value.size(); ++i)
        {
          check_size(value[i], places[i], formula);
          const auto dof = dofs[fe.component_to_system_index(c, i)];
          if (owned.is_element(dof))
            la::data(values)[owned.index_within_set(dof)] = value[i];
        }
      }
    }
  } // namespace

  template <int dim>
  la::Vector values_at_nodes(const DiscreteProblem<dim> &problem,
                             const FormulaOfCells<dim> &formula_of)
  {
    la::Vector values = problem.vector();
    collective(
        versions::communicator(problem.dof_handler),
        [&]
        {
          for (const auto &cell : problem.dof_handler.active_cell_iterators())
          {
            if (!cell->is_locally_owned())
              continue;
            const Expression<dim> *formula = formula_of(cell->material_id());
            if (formula != nullptr)
              put_values(problem, cell, *formula, values);
          }
        });
    return values;
  }

  template la::Vector values_at_nodes(const DiscreteProblem<2> &,
                                      const FormulaOfCells<2> &);
  template la::Vector values_at_nodes(const DiscreteProblem<3> &,
                                      const FormulaOfCells<3> &);
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "whole_matrix.h"

#include "app/input/collective.h"
#include "shim/by_element.h"

#include <abut/dealii/versions.h>

namespace abut::app
{
  using dealii::types::global_dof_index;

  namespace
  {
    using Parents = std::vector<std::pair<global_dof_index, double>>;

    /** Unknowns that take part for those of a cell: themselves, or of hanging
     * ones their parents. */
    template <int dim>
    std::vector<Parents> parents_of(const DiscreteProblem<dim> &problem,
                                    const std::vector<global_dof_index> &dofs)
    {
      std::vector<Parents> result(dofs.size());
      for (std::size_t i = 0; i < dofs.size(); ++i)
        if (const Parents *hanging =
                problem.hanging.get_constraint_entries(dofs[i]))
          result[i] = *hanging;
        else
          result[i] = {{dofs[i], 1.}};
      return result;
    }

    /** Call @p add for the lines of a cell's matrix. */
    template <typename Add>
    void add_lines(const dealii::FullMatrix<double> &matrix,
                   const std::vector<Parents> &parents, const bool lumped,
                   const Add &add)
    {
      std::vector<global_dof_index> columns;
      std::vector<double> entries;
      for (unsigned int i = 0; i < matrix.m(); ++i)
        for (const auto &row : parents[i])
        {
          if (lumped)
          {
            add(row.first, {row.first}, {row.second * matrix(i, i)});
            continue;
          }
          columns.clear();
          entries.clear();
          for (unsigned int j = 0; j < matrix.n(); ++j)
            if (matrix(i, j) != 0.)
              for (const auto &column : parents[j])
              {
                columns.push_back(column.first);
                entries.push_back(row.second * column.second * matrix(i, j));
              }
          if (!columns.empty())
            add(row.first, columns, entries);
        }
    }
  } // namespace

  template <int dim>
  la::Matrix whole_matrix(const DiscreteProblem<dim> &problem,
                          const ComputeCellMatrix<dim> &compute,
                          const bool lumped)
  {
    const dealii::IndexSet &owned = problem.dof_handler.locally_owned_dofs();
    const MPI_Comm communicator = versions::communicator(problem.dof_handler);
    std::vector<global_dof_index> dofs;
    dealii::FullMatrix<double> matrix;
    return la::assemble(
        owned, problem.relevant, communicator,
        [&](const auto &add)
        {
          // All loops over rows rely on entries there.
          for (const global_dof_index row : owned)
            add(row, {row}, {0.});
          collective(communicator,
                     [&]
                     {
                       for (const auto &cell :
                            problem.dof_handler.active_cell_iterators())
                         if (cell->is_locally_owned())
                         {
                           shim::get_dofs(cell, dofs);
                           if (matrix.m() != dofs.size())
                             matrix.reinit(dofs.size(), dofs.size());
                           compute(cell, dofs, matrix);
                           add_lines(matrix, parents_of(problem, dofs), lumped,
                                     add);
                         }
                     });
        });
  }

  template la::Matrix whole_matrix(const DiscreteProblem<2> &,
                                   const ComputeCellMatrix<2> &, bool);
  template la::Matrix whole_matrix(const DiscreteProblem<3> &,
                                   const ComputeCellMatrix<3> &, bool);
} // namespace abut::app

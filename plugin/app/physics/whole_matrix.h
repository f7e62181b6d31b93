// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_WHOLE_MATRIX_H
#define ABUT_APP_WHOLE_MATRIX_H

/** @file
 * Matrices over all unknowns, whatever is prescribed.
 */

#include "discrete_problem.h"

#include <deal.II/lac/full_matrix.h>

namespace abut::app
{
  /** Fills in the matrix of a cell, whose unknowns are given, too. */
  template <int dim>
  using ComputeCellMatrix = std::function<void(
      const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
      const std::vector<dealii::types::global_dof_index> &dofs,
      dealii::FullMatrix<double> &matrix)>;

  /** The sum of the matrices of all cells over all unknowns, prescribed ones
   * included; hanging nodes by their parents, with empty rows of their own.
   * Zeros stand on the diagonal where there is nothing. @p compute may throw
   * InputError.
   * @param lumped matrices of cells are diagonal, and so is the sum: parents
   * have their parts of hanging nodes, and no couplings. Collective. */
  template <int dim>
  la::Matrix whole_matrix(const DiscreteProblem<dim> &problem,
                          const ComputeCellMatrix<dim> &compute, bool lumped);
} // namespace abut::app

#endif

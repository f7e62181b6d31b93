// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CELL_SUM_H
#define ABUT_APP_CELL_SUM_H

#include "discrete_problem.h"

#include <deal.II/lac/full_matrix.h>

#include <array>

namespace abut::app
{
  /** Sums up matrices and vectors of cells as
   * AffineConstraints::distribute_local_to_global() does, to which it leaves
   * the cells with unknowns that are constrained or belong to other ranks. All
   * others, which are most, go to the arrays of the matrix at once. */
  template <int dim> class CellSum
  {
  public:
    using Dofs = std::vector<dealii::types::global_dof_index>;

    /** Sums begin from 0 in @p matrix, which has the pattern of the problem.
     * Both must outlive this object. Collective. */
    CellSum(const DiscreteProblem<dim> &problem, la::Matrix &matrix);

    /** Add the matrix of a cell with unknowns @p dofs; not collective. */
    void add(const dealii::FullMatrix<double> &matrix, const Dofs &dofs);

    /** The same with a load, for others of which @p open is. */
    void add(const dealii::FullMatrix<double> &matrix,
             const dealii::Vector<double> &load, const Dofs &dofs,
             la::Vector &open);

    /** The matrix is complete. Collective. */
    void close();

    /** The loads of all that did not go to an open vector. Not collective. */
    const la::Vector &loads() const
    {
      return load_;
    }

  private:
    bool is_plain(const Dofs &dofs) const;
    void add_plain(const dealii::FullMatrix<double> &matrix, const Dofs &dofs);
    template <int n>
    bool add_to_short_row(const double *entries, int row,
                          const std::array<int, n> &columns);
    template <int n>
    void add_to_short_rows(const dealii::FullMatrix<double> &matrix,
                           const Dofs &dofs);
    int find(int row, int column, int guess) const;

    const dealii::AffineConstraints<double> &constraints_;
    la::Matrix &matrix_;
    la::LocalRows rows_;
    const dealii::types::global_dof_index first_;
    std::vector<std::uint8_t> is_free_; ///< [owned] not constrained
    la::Vector load_;
    std::vector<int> place_; ///< of a row's entries for the unknowns of a cell
  };
} // namespace abut::app

#endif

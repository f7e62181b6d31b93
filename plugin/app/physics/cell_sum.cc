// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cell_sum.h"

#include <algorithm>

namespace abut::app
{
  namespace
  {
    /** Rows with so few entries are counted through, without a branch. */
    constexpr int few = 32;

    /** The first of ascending numbers that is not less than @p wanted. */
    const int *place_in_order(const int *begin, const int *end,
                              const int wanted)
    {
      if (end - begin > few)
        return std::lower_bound(begin, end, wanted);
      int n_less = 0;
      for (const int *at = begin; at != end; ++at)
        n_less += *at < wanted;
      return begin + n_less;
    }
  } // namespace

  template <int dim>
  CellSum<dim>::CellSum(const DiscreteProblem<dim> &problem, la::Matrix &matrix)
      : constraints_(problem.constraints),
        matrix_(matrix),
        first_(la::row_range(matrix).first),
        load_(problem.vector()),
        place_(problem.elements.max_dofs_per_cell(), 0)
  {
    matrix_ = 0.;
    rows_ = la::local_rows(matrix_);
    is_free_.assign(rows_.n_rows, 1);
    for (const auto &line : constraints_.get_lines())
      if (line.index >= first_ && line.index - first_ < is_free_.size())
        is_free_[line.index - first_] = 0;
  }

  template <int dim> bool CellSum<dim>::is_plain(const Dofs &dofs) const
  {
    return std::all_of(dofs.begin(), dofs.end(),
                       [&](const auto dof)
                       {
                         return dof >= first_ && dof - first_ < is_free_.size()
                                && is_free_[dof - first_];
                       });
  }

  /** Place of an entry, which is at @p guess if columns stand side by side. */
  template <int dim>
  int CellSum<dim>::find(const int row, const int column, const int guess) const
  {
    const int begin = rows_.start[row], end = rows_.start[row + 1];
    if (guess >= begin && guess < end && rows_.column[guess] == column)
      return guess;
    const int *const sorted =
        place_in_order(rows_.column + begin, rows_.column + end, column);
    if (sorted != rows_.column + end && *sorted == column)
      return static_cast<int>(sorted - rows_.column);
    const int *const any =
        std::find(rows_.column + begin, rows_.column + end, column);
    AssertThrow(any != rows_.column + end,
                dealii::ExcMessage("The pattern of the matrix lacks entries "
                                   "of a cell."));
    return static_cast<int>(any - rows_.column);
  }

  template <int dim>
  void CellSum<dim>::add_plain(const dealii::FullMatrix<double> &matrix,
                               const Dofs &dofs)
  {
    const std::size_t n = dofs.size();
    constexpr int corners = 1 << dim;
    if (n == corners)
    {
      add_to_short_rows<corners>(matrix, dofs);
      return;
    }
    int offset = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      const int row = static_cast<int>(dofs[i] - first_);
      // Rows of one node have the same columns.
      const int shift = rows_.start[row] - offset;
      offset = rows_.start[row];
      for (std::size_t j = 0; j < n; ++j)
      {
        const int column = static_cast<int>(dofs[j] - first_);
        const int guess = place_[j] + shift;
        int place = guess;
        if (guess < rows_.start[row] || guess >= rows_.start[row + 1]
            || rows_.column[guess] != column)
          place = find(row, column, j > 0 ? place_[j - 1] + 1 : -1);
        place_[j] = place;
        rows_.value[place] += matrix(i, j);
      }
    }
  }

  /** The same for cells with n unknowns and short rows of ascending columns:
   * one look at a row finds the places of all of them. */
  template <int dim>
  template <int n>
  bool CellSum<dim>::add_to_short_row(const double *const entries,
                                      const int row,
                                      const std::array<int, n> &columns)
  {
    const int *const begin = rows_.column + rows_.start[row];
    const int length = rows_.start[row + 1] - rows_.start[row];
    std::array<int, n> n_less{};
    for (int k = 0; k < length; ++k)
      for (int j = 0; j < n; ++j)
        n_less[j] += begin[k] < columns[j] ? 1 : 0;
    bool found = true;
    for (int j = 0; j < n; ++j)
      found = found && n_less[j] < length && begin[n_less[j]] == columns[j];
    if (!found)
      return false;
    double *const values = rows_.value + rows_.start[row];
    for (int j = 0; j < n; ++j)
      values[n_less[j]] += entries[j];
    return true;
  }

  template <int dim>
  template <int n>
  void CellSum<dim>::add_to_short_rows(const dealii::FullMatrix<double> &matrix,
                                       const Dofs &dofs)
  {
    std::array<int, n> columns;
    for (int j = 0; j < n; ++j)
      columns[j] = static_cast<int>(dofs[j] - first_);
    for (int i = 0; i < n; ++i)
    {
      const int row = columns[i];
      if (rows_.start[row + 1] - rows_.start[row] <= few
          && add_to_short_row<n>(&matrix(i, 0), row, columns))
        continue;
      for (int j = 0; j < n; ++j)
        rows_.value[find(row, columns[j], -1)] += matrix(i, j);
    }
  }

  template <int dim>
  void CellSum<dim>::add(const dealii::FullMatrix<double> &matrix,
                         const Dofs &dofs)
  {
    if (is_plain(dofs))
      add_plain(matrix, dofs);
    else
      constraints_.distribute_local_to_global(matrix, dofs, matrix_);
  }

  template <int dim>
  void CellSum<dim>::add(const dealii::FullMatrix<double> &matrix,
                         const dealii::Vector<double> &load, const Dofs &dofs,
                         la::Vector &open)
  {
    if (!is_plain(dofs))
    {
      constraints_.distribute_local_to_global(matrix, load, dofs, matrix_,
                                              open);
      return;
    }
    add_plain(matrix, dofs);
    double *const values = la::data(load_);
    for (std::size_t i = 0; i < dofs.size(); ++i)
      values[dofs[i] - first_] += load(i);
  }

  template <int dim> void CellSum<dim>::close()
  {
    matrix_.compress(dealii::VectorOperation::add);
  }

  template class CellSum<2>;
  template class CellSum<3>;
} // namespace abut::app

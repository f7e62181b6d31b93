// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_MATRIX_LINES_H
#define ABUT_SOLVE_MATRIX_LINES_H

#include <deal.II/base/types.h>

#include <vector>

namespace abut::solve
{
  /** Terms of a matrix as lines in plain arrays: several lines may be parts of
   * one row, several entries of a line of one column. */
  struct MatrixLines
  {
    using Index = dealii::types::global_dof_index;

    std::vector<Index> row;            ///< [lines]
    std::vector<std::size_t> start{0}; ///< [lines + 1] first entry of each line
    std::vector<Index> column;         ///< [entries]
    std::vector<double> value;         ///< [entries]

    std::size_t size() const
    {
      return row.size();
    }

    void add(const Index of_row, const std::vector<Index> &columns,
             const std::vector<double> &values)
    {
      row.push_back(of_row);
      column.insert(column.end(), columns.begin(), columns.end());
      value.insert(value.end(), values.begin(), values.end());
      start.push_back(column.size());
    }

    /** Call visit(row, columns, values) for each line. */
    template <typename Visit> void for_each(const Visit &visit) const
    {
      std::vector<Index> columns;
      std::vector<double> values;
      for (std::size_t i = 0; i < size(); ++i)
      {
        columns.assign(column.begin() + start[i],
                       column.begin() + start[i + 1]);
        values.assign(value.begin() + start[i], value.begin() + start[i + 1]);
        visit(row[i], columns, values);
      }
    }
  };
} // namespace abut::solve

#endif

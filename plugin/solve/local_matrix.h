// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_LOCAL_MATRIX_H
#define ABUT_SOLVE_LOCAL_MATRIX_H

#include <deal.II/base/types.h>

#include <vector>

namespace abut::solve
{
  /** A rank's part of a sparse matrix, summed up from lines, as plain arrays.
   */
  class LocalMatrix
  {
  public:
    using Index = dealii::types::global_dof_index;

    /** Add to a row, whose number is that of the unknown. */
    void add(Index row, const std::vector<Index> &columns,
             const std::vector<double> &values);

    /** Unknowns of rows and columns, ascending, before it is closed. */
    std::vector<Index> unknowns() const;

    /** Sum up what was added, with unknowns by other numbers below @p n_rows.
     */
    template <typename Number>
    void close(const int n_rows, const Number &number)
    {
      for (Entry &entry : entries_)
      {
        entry.row = number(entry.row);
        entry.column = number(entry.column);
      }
      sum_up(n_rows);
    }

    std::vector<int> start; ///< [rows + 1] once it is closed
    std::vector<int> column;
    std::vector<double> value;

  private:
    struct Entry
    {
      Index row, column;
      double value;
    };

    void sum_up(int n_rows);

    std::vector<Entry> entries_;
  };
} // namespace abut::solve

#endif

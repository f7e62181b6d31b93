// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_LOCAL_MATRIX_H
#define ABUT_SOLVE_LOCAL_MATRIX_H

#include <deal.II/base/types.h>

#include <vector>

namespace abut::solve
{
  /** A sparse matrix of one rank, summed up from lines, as plain arrays. */
  class LocalMatrix
  {
  public:
    explicit LocalMatrix(const int n_rows) : start(n_rows + std::size_t(1), 0)
    {
    }

    /** Add to a row, whose number is that of the unknown. */
    void add(dealii::types::global_dof_index row,
             const std::vector<dealii::types::global_dof_index> &columns,
             const std::vector<double> &values);

    /** Sum up what was added. */
    void close();

    std::vector<int> start; ///< [rows + 1] once it is closed
    std::vector<int> column;
    std::vector<double> value;

  private:
    struct Entry
    {
      int row, column;
      double value;
    };

    std::vector<Entry> entries_;
  };
} // namespace abut::solve

#endif

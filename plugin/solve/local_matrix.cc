// SPDX-License-Identifier: LGPL-2.1-or-later
#include "local_matrix.h"

#include <algorithm>

namespace abut::solve
{
  void
  LocalMatrix::add(const dealii::types::global_dof_index row,
                   const std::vector<dealii::types::global_dof_index> &columns,
                   const std::vector<double> &values)
  {
    for (std::size_t k = 0; k < columns.size(); ++k)
      entries_.push_back(
          {static_cast<int>(row), static_cast<int>(columns[k]), values[k]});
  }

  void LocalMatrix::close()
  {
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry &a, const Entry &b) {
                       return a.row != b.row ? a.row < b.row
                                             : a.column < b.column;
                     });
    int last = -1;
    for (const Entry &entry : entries_)
    {
      if (entry.row == last && entry.column == column.back())
      {
        value.back() += entry.value;
        continue;
      }
      last = entry.row;
      column.push_back(entry.column);
      value.push_back(entry.value);
      ++start[entry.row + 1];
    }
    for (std::size_t i = 1; i < start.size(); ++i)
      start[i] += start[i - 1];
    entries_ = {};
  }
} // namespace abut::solve

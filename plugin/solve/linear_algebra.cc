/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include <abut/dealii/linear_algebra.h>

#include <algorithm>
#include <numeric>

namespace abut::la
{
  dealii::IndexSet number(const dealii::types::global_dof_index n,
                          const MPI_Comm communicator)
  {
    const auto counts = dealii::Utilities::MPI::all_gather(communicator, n);
    dealii::types::global_dof_index first = 0, total = 0;
    for (unsigned int r = 0; r < counts.size(); ++r)
    {
      if (r == dealii::Utilities::MPI::this_mpi_process(communicator))
        first = total;
      total += counts[r];
    }
    dealii::IndexSet result(total);
    result.add_range(first, first + n);
    return result;
  }

  std::vector<dealii::types::global_dof_index> row_ends(const Matrix &matrix)
  {
    auto result = dealii::Utilities::MPI::all_gather(
        matrix.get_mpi_communicator(), row_range(matrix).second);
    // A rank without rows has an end of 0.
    std::partial_sum(result.begin(), result.end(), result.begin(),
                     [](const auto a, const auto b) { return std::max(a, b); });
    return result;
  }

  std::vector<double> diagonal(const LocalRows &rows)
  {
    std::vector<double> result(rows.n_rows, 0.);
    int place = 0; // of the last row's diagonal entry, mostly this one's, too
    for (int i = 0; i < rows.n_rows; ++i)
    {
      const int guess = rows.start[i] + place;
      if (guess < rows.start[i + 1] && rows.column[guess] == i)
      {
        result[i] = rows.value[guess];
        continue;
      }
      const int *const begin = rows.column + rows.start[i];
      const int *const end = rows.column + rows.start[i + 1];
      // Rows are sorted, unless the host has prevented it.
      const int *at = std::lower_bound(begin, end, i);
      if (at == end || *at != i)
        at = std::find(begin, end, i);
      if (at == end)
        continue;
      result[i] = rows.value[at - rows.column];
      place = static_cast<int>(at - begin);
    }
    return result;
  }
} // namespace abut::la

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pivots.h"

#include <cmath>

namespace abut::solve
{
  namespace
  {
    /** A pivot smaller than this part of a row's largest entry would spoil
     * the condition of the condensed matrix. */
    constexpr double smallest_pivot = 0.05;
  } // namespace

  bool choose_pivots(const PointOperator &rows,
                     const std::vector<std::uint8_t> &wanted,
                     std::vector<std::int64_t> &pivot)
  {
    la::Vector count(rows.owned(), rows.communicator());
    rows.add_counts(wanted.data(), count);
    const double *const n_rows = la::data(count);

    pivot.assign(rows.n_rows(), Condensate::none);
    bool complete = true;
    for (int i = 0; i < rows.n_rows(); ++i)
    {
      if (!wanted[i])
        continue;
      double largest = 0., chosen = 0.;
      for (std::int64_t e = rows.begin(i); e < rows.end(i); ++e)
      {
        const double size = std::abs(rows.coefficient(e));
        largest = std::max(largest, size);
        const int j = rows.column(e);
        if (j < rows.n_owned() && n_rows[j] == 1. && size > chosen)
        {
          chosen = size;
          pivot[i] = e;
        }
      }
      complete = complete && chosen > smallest_pivot * largest;
    }
    return dealii::Utilities::MPI::min(complete ? 1 : 0, rows.communicator())
           == 1;
  }
} // namespace abut::solve

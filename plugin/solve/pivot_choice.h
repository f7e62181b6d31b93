// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_PIVOT_CHOICE_H
#define ABUT_SOLVE_PIVOT_CHOICE_H

#include <cstddef>
#include <functional>
#include <mpi.h>
#include <vector>

namespace abut::solve
{
  /** Items of this rank, in descending order of importance for all ranks,
   * whose vectors of @p dimension numbers span what the vectors of all items of
   * all ranks span: Gram-Schmidt with pivots.
   * @param vector of an item, [dimension]; empty: not to be chosen
   * Collective. */
  std::vector<std::size_t> choose_pivots_of_span(
      std::size_t n_items, unsigned int dimension,
      const std::function<std::vector<double>(std::size_t)> &vector,
      MPI_Comm communicator);
} // namespace abut::solve

#endif

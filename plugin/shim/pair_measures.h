// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_MEASURES_H
#define ABUT_SHIM_PAIR_MEASURES_H

#include <abut/dealii/pair_measures.h>

namespace abut::shim
{
  /** Put together what the ranks have measured, by the table. Two reductions
   * for all pairs. Collective. */
  template <int dim>
  void reduce(std::vector<PairResult<dim>> &results,
              const MPI_Comm communicator);
} // namespace abut::shim

#endif

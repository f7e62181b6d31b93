// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_HOSTS_EXPECT_H
#define ABUT_TESTS_HOSTS_EXPECT_H

#include <deal.II/base/mpi.h>

#include <iostream>
#include <string>

namespace abut::hosts
{
  /** Whether all that was expected has come. */
  inline bool good = true;

  inline bool is_first_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  inline void expect(const bool holds, const std::string &what)
  {
    if (!holds && is_first_rank())
      std::cout << "FAILED: " << what << std::endl;
    good = good && holds;
  }
} // namespace abut::hosts

#endif

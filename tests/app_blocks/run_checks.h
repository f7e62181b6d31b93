// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_RUN_CHECKS_H
#define ABUT_TESTS_RUN_CHECKS_H

/** @file
 * What the main functions of the tests share.
 */

#include "expect.h"

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <functional>

namespace abut::app
{
  /** Initialise MPI, run @p checks with the folder that the command line names
   * (made when needed; empty without one), and return the exit code: 1 if a
   * check failed on any rank. */
  inline int run_checks(
      int argc, char **argv,
      const std::function<void(const std::filesystem::path &folder)> &checks)
  {
    const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    std::filesystem::path folder;
    if (argc > 1)
    {
      folder = argv[1];
      std::filesystem::create_directories(folder);
    }
    checks(folder);
    return dealii::Utilities::MPI::max(Expect::failures(), MPI_COMM_WORLD) > 0;
  }
} // namespace abut::app

#endif

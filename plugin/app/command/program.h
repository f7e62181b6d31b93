// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PROGRAM_H
#define ABUT_APP_PROGRAM_H

#include "app/input/input_error.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace abut::app
{
  /** Message: a mesh does not fit into memory. */
  inline constexpr char no_memory[] =
      "there is not enough memory for this mesh. Take a coarser one, or more "
      "ranks on more machines.";

  /** Do what the words after the program's name ask for, on all ranks of
   * @p communicator. Throws InputError with the place of the mistake in its
   * text. Collective. */
  ExitCode run_program(MPI_Comm communicator,
                       const std::vector<std::string> &words);
} // namespace abut::app

#endif

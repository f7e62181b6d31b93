// SPDX-License-Identifier: LGPL-2.1-or-later
/* The program `abut`. An exception that reaches main() on some ranks only must
 * not leave the others waiting: a failed rank enters a barrier on a
 * communicator of its own, and if not all do so within seconds, it ends them
 * all. */
#include "program.h"
#include "serve.h"

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>
#include <new>
#include <string>
#include <thread>

namespace
{
  using abut::app::ExitCode;

  /** Whether all ranks arrive here within some seconds. */
  bool all_arrive(MPI_Comm communicator)
  {
    MPI_Request request;
    MPI_Ibarrier(communicator, &request);
    for (int i = 0; i < 500; ++i)
    {
      int done = 0;
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (done)
        return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  /** Print @p message once and return @p code, or end all ranks. */
  ExitCode fail(MPI_Comm communicator, const ExitCode code,
                const std::string &message)
  {
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    // Printed first: once all have arrived, a launcher may end this rank as
    // soon as another one has returned its exit code.
    if (rank == 0)
      std::cerr << "abut: " << message << std::endl;
    if (!all_arrive(communicator))
    {
      if (rank != 0)
        std::cerr << "abut: " << message << " (rank " << rank << ")"
                  << std::endl;
      MPI_Abort(communicator, static_cast<int>(code));
    }
    return code;
  }

  /** What main() does, here and in processes that are forked from this one. */
  int run(int argc, char *argv[])
  {
    // deal.II starts PETSc too, which would take our words for options of its
    // own and print those that it does not know.
    int n_names = 1;
    char *name[] = {argv[0], nullptr};
    char **names = name;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(n_names, names, 1);
    MPI_Comm end_of_run;
    MPI_Comm_dup(MPI_COMM_WORLD, &end_of_run);
    ExitCode code;
    try
    {
      code = abut::app::run_program(
          MPI_COMM_WORLD, std::vector<std::string>(argv + 1, argv + argc));
    }
    catch (const abut::app::InputError &error)
    {
      code = fail(end_of_run, ExitCode::bad_input,
                  std::string("error: ") + error.what());
    }
    catch (const std::bad_alloc &)
    {
      code = fail(end_of_run, ExitCode::bad_input,
                  std::string("error: ") + abut::app::no_memory);
    }
    catch (const std::exception &error)
    {
      code = fail(end_of_run, ExitCode::internal_error,
                  std::string("internal error: ") + error.what());
    }
    catch (...)
    {
      code = fail(end_of_run, ExitCode::internal_error,
                  "internal error: unknown exception");
    }
    MPI_Comm_free(&end_of_run);
    return static_cast<int>(code);
  }
} // namespace

int
main(int argc, char *argv[])
{
  if (argc == 2 && std::string(argv[1]) == "serve")
    return abut::app::serve(argv[0], run);
  return run(argc, argv);
}

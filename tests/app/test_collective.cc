// SPDX-License-Identifier: LGPL-2.1-or-later
/* An error on one rank becomes the same error on all of them, and the ranks
 * can go on together afterwards. To be run on several ranks. */
#include "app/input/collective.h"
#include "app/input/input_error.h"

#include <cstdio>
#include <stdexcept>
#include <string>

namespace
{
  int rank, size;

  /** What collective() throws when rank @p thrower throws. */
  template <typename Error>
  std::string outcome(const int thrower, const Error &error)
  {
    try
    {
      abut::app::collective(MPI_COMM_WORLD,
                            [&]
                            {
                              if (rank == thrower || thrower < 0)
                                throw error;
                            });
    }
    catch (const abut::app::InputError &caught)
    {
      return "input " + caught.parameter + ": " + caught.what();
    }
    catch (const std::exception &caught)
    {
      return std::string("other: ") + caught.what();
    }
    return "none";
  }

  int n_failures = 0;

  void expect(const std::string &result, const std::string &expected)
  {
    if (result == expected)
      return;
    ++n_failures;
    std::printf("rank %d: '%s' instead of '%s'\n", rank, result.c_str(),
                expected.c_str());
  }
} // namespace

int
main(int argc, char *argv[])
{
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const std::string who = std::to_string(rank);

  for (int thrower = 0; thrower < size; ++thrower)
  {
    const std::string name = std::to_string(thrower);
    expect(outcome(thrower, std::out_of_range("from " + who)),
           "other: from " + name);
    expect(outcome(thrower, abut::app::InputError("A/b", "by " + who)),
           "input A/b: by " + name);
  }
  // All of them: the lowest rank has the word.
  expect(outcome(-1, std::runtime_error("from " + who)), "other: from 0");
  expect(outcome(size, std::runtime_error("nobody")), "none");

  MPI_Allreduce(MPI_IN_PLACE, &n_failures, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  MPI_Finalize();
  return n_failures == 0 ? 0 : 1;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// The mesh is cut anew between two solves: displacement and pressures are taken
// along, and the second solve has nothing left to do.
#include "patch.h"

using namespace abut;

namespace
{
  namespace MPI = dealii::Utilities::MPI;

  template <int dim> bool check()
  {
    hosts::Case run;
    // A wedge: closed on one side only.
    run.tilt = 0.5;
    hosts::TwoBlocks<dim> blocks(run);
    blocks.prepare({blocks.pair()});
    la::Vector u = blocks.start();
    const hosts::Errors first = blocks.solve(u);
    const auto force = blocks.contact().pair_results().at(0).secondary_force;
    bool good = hosts::is_at_most(
        first.n_active > 0 && first.n_active < first.n_rows ? 0. : 1., 0.,
        "part in contact");
    unsigned int steps = first.steps;
    for (const unsigned int weight : {10000u, 100u})
    {
      const std::string name = std::to_string(dim) + "D, cells of weight "
                               + std::to_string(weight) + ": ";
      const unsigned int before = blocks.n_own_cells();
      u = blocks.repartition(u, weight);
      const bool moved =
          MPI::logical_or(before != blocks.n_own_cells(), MPI_COMM_WORLD);
      const hosts::Errors again = blocks.solve(u);
      const auto difference =
          blocks.contact().pair_results().at(0).secondary_force - force;
      const auto check = [&](const bool holds, const std::string &what)
      { good = hosts::is_at_most(holds ? 0. : 1., 0., name + what) && good; };
      check(moved || MPI::n_mpi_processes(MPI_COMM_WORLD) == 1,
            "cells that stay where they were");
      check(again.n_rows == first.n_rows && again.n_active == first.n_active,
            "other rows or active rows");
      check(again.steps == 1, "steps after the first");
      check(difference.norm() <= 1e-8 * force.norm(), "another force");
      check(again.imbalance <= 1e-11, "imbalance of the forces");
      steps += again.steps;
    }
    if (MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << dim << "D: " << first.n_active << " of " << first.n_rows
                << " rows in contact after " << first.steps
                << " steps; with two more partitions " << steps << std::endl;
    // Or there would be nothing to carry over.
    return hosts::is_at_most(3. - first.steps, 0., "lack of steps at first")
           && good;
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool good = check<2>();
  return check<3>() && good ? 0 : 1;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// The patch test on meshes that are not distributed: each rank has its own,
// and solves alone.
#include "patch.h"
#include "two_blocks_members.h"

using namespace abut;

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  bool good = true;
  for (const bool upper : {true, false})
  {
    hosts::Case run;
    run.upper_is_secondary = upper;
    run.name = upper ? "upper side" : "lower side";
    good = hosts::passes<2, dealii::Triangulation<2>>(run, 1e-11) && good;
    run.cells = {{2, 3}};
    run.name += ", 3D";
    good = hosts::passes<3, dealii::Triangulation<3>>(run, 1e-11) && good;
  }
  return good ? 0 : 1;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// The patch test in space, with hanging nodes on both sides of the interface.
#include "patch.h"

using namespace abut;

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  bool good = true;
  const auto run = [&](const hosts::Case &one, const std::string &name)
  { good = hosts::passes_either_way<3>(one, name, 1e-11) && good; };

  hosts::Case one;
  one.cells = {{2, 3}};
  run(one, "dual mortar");
  one.method = hosts::method("lagrange", ABUT_DISCRETISATION_MORTAR);
  one.method.system = System::saddle_point;
  run(one, "mortar");
  one = hosts::Case();
  one.cells = {{2, 3}};
  one.tied = true;
  one.materials = {{{3., 0.2}, {3., 0.2}}};
  run(one, "tied");
  one = hosts::Case();
  one.cells = {{1, 2}};
  one.degree = 2;
  run(one, "dual mortar, quadratic");
  return good ? 0 : 1;
}

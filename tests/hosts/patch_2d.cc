// SPDX-License-Identifier: LGPL-2.1-or-later
// The patch test in the plane, on meshes with hanging nodes that do not match.
#include "patch.h"

using namespace abut;

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  bool good = true;
  const auto run = [&](const hosts::Case &one, const std::string &name)
  { good = hosts::passes_either_way<2>(one, name, 1e-11) && good; };

  hosts::Case one;
  run(one, "dual mortar");
  one.method = hosts::method("lagrange", ABUT_DISCRETISATION_MORTAR);
  one.method.system = System::saddle_point;
  run(one, "mortar");
  one = hosts::Case();
  one.degree = 2;
  run(one, "dual mortar, quadratic");

  // Springs yield, but leave the stress uniform. Without lateral strain the
  // prescribed displacements fit any pressure.
  one = hosts::Case();
  one.yields = true;
  one.materials = {{{7., 0.}, {3., 0.}}};
  for (const auto discretisation :
       {ABUT_DISCRETISATION_DUAL_MORTAR, ABUT_DISCRETISATION_MORTAR})
  {
    one.method = hosts::method("penalty", discretisation);
    run(one, "penalty, " + discretisation_name(discretisation));
  }

  // Glued blocks have a linear solution if both contract alike.
  one = hosts::Case();
  one.tied = true;
  one.materials = {{{3., 0.2}, {3., 0.2}}};
  run(one, "tied");
  return good ? 0 : 1;
}

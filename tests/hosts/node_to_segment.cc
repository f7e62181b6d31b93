// SPDX-License-Identifier: LGPL-2.1-or-later
// What the patch test says of node to segment: it fails, and by how much. The
// largest errors of the normal stress at 2 x 2 Gauss points were computed by a
// separate program (dense matrices, multipliers at all secondary nodes); E = 1,
// nu = 0.3, plane strain. Mortar passes on the same meshes.
#include "patch.h"

using namespace abut;

namespace
{
  struct Expected
  {
    unsigned int lower, upper; ///< cells along each axis
    double upper_is_secondary, lower_is_secondary;
  };

  constexpr Expected table[] = {
      {3, 4, 7.54e-2, 1.61e-1}, {4, 5, 6.95e-2, 1.21e-1}, {4, 8, 0., 8.93e-1}};
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  bool good = true;
  for (const Expected &expected : table)
    for (const bool upper : {true, false})
    {
      hosts::Case run;
      run.pressed = true;
      run.materials = {{{1., 0.3}, {1., 0.3}}};
      run.cells = {{expected.lower, expected.upper}};
      run.upper_is_secondary = upper;
      const std::string name = std::to_string(expected.lower) + " under "
                               + std::to_string(expected.upper)
                               + " cells, secondary "
                               + (upper ? "upper" : "lower");
      const double exact = hosts::TwoBlocks<2>(run).solve().normal_stress;
      run.method =
          hosts::method("lagrange", ABUT_DISCRETISATION_NODE_TO_SEGMENT);
      const double stress = hosts::TwoBlocks<2>(run).solve().normal_stress;
      const double value =
          upper ? expected.upper_is_secondary : expected.lower_is_secondary;
      good = hosts::is_at_most(std::abs(stress - value),
                               std::max(1e-10, 0.05 * value),
                               name + ": difference to the table")
             && hosts::is_at_most(exact, 1e-11, name + ": error of mortar")
             && good;
    }
  return good ? 0 : 1;
}

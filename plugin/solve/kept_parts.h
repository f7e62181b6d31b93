// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_KEPT_PARTS_H
#define ABUT_SOLVE_KEPT_PARTS_H

#include "direct_solver.h"
#include "geometric_multigrid.h"

namespace abut::solve
{
  /** Parts of the last solver on a mesh that the next one can use, such as
   * orders and coarse matrices. Points that move have a new solver each time; a
   * solver that uses a part takes it out, and puts it back at its end. */
  struct KeptParts
  {
    std::unique_ptr<FactorisedMatrix> condensed;
    unsigned int step = 0; ///< factors of earlier ones are forgotten
    std::unique_ptr<GeometricMultigrid> geometric;
  };
} // namespace abut::solve

#endif

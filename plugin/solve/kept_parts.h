// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_KEPT_PARTS_H
#define ABUT_SOLVE_KEPT_PARTS_H

#include "direct_solver.h"
#include "free_bodies.h"
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
    std::shared_ptr<const void> geometric_of; ///< values of its matrix
    /** Iterations of `Linear solver = auto` with no solution, after which
     * systems on this mesh are factorised; 0: none. */
    unsigned int useless_iterations = 0;
    FreeBodies bodies;
    std::shared_ptr<const void> bodies_of; ///< values of the stiffness
  };
} // namespace abut::solve

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_PRECONDITIONER_STATE_H
#define ABUT_SOLVE_PRECONDITIONER_STATE_H

#include "preconditioner_keeper.h"

#include <cstdint>
#include <vector>

namespace abut::solve
{
  /** State that a preconditioner was built for, on this rank: a solver of the
   * same matrix and rows builds the same from it, bit by bit, and keeps it as
   * long. */
  struct PreconditionerState
  {
    PreconditionerKeeper keeper{1.};
    /** [rows] or [owned] added to K by springs. */
    std::vector<double> stiffness;
    /** [rows] entries whose unknowns were eliminated, see Condensate. */
    std::vector<std::int64_t> pivot;
    /** [owned] unknowns that were held when it was built, and that are cut off
     * now, see MaskedSolver. */
    std::vector<std::uint8_t> held, cut;

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &keeper &stiffness &pivot &held &cut;
    }
  };
} // namespace abut::solve

#endif

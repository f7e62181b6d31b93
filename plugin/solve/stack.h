// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_STACK_H
#define ABUT_SOLVE_STACK_H

#include <string>

namespace abut::solve
{
  /** Whether the Trilinos stack has MUMPS. */
  bool has_mumps();

  /** Why a run on so many ranks is refused with this stack, and what to do;
   * empty: it is not. */
  std::string refusal_of_ranks(unsigned int n_ranks);
} // namespace abut::solve

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LOADED_PROGRAM_H
#define ABUT_APP_LOADED_PROGRAM_H

/** @file
 * Many runs of this program, each in a process of its own. To load it, with
 * deal.II and all that this is linked to, takes longer than to solve a small
 * scene.
 */

#include "child_process.h"

#include <string>
#include <vector>

namespace abut::app
{
  /** Keep a process that has the program loaded, from which run_this_program()
   * forks. To be called before MPI begins, and before there are threads. */
  void keep_loaded(MainFunction program);

  /** Run this program with @p words and wait for its end, as run_child() does.
   * Where keep_loaded() was not called, or could not have a process, the
   * program is loaded for it. */
  ChildResult run_this_program(std::vector<std::string> words,
                               const ChildOptions &options);
} // namespace abut::app

#endif

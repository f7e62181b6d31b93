// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SERVE_H
#define ABUT_APP_SERVE_H

namespace abut::app
{
  /** `abut serve`: run the commands that come on standard input, each in a
   * process of its own, until its end. To load the program with all that it is
   * linked to takes longer than to solve a small scene; here it is loaded once.
   * To be called before MPI begins, and before there are threads.
   * @param run the command line of a process */
  int serve(const char *name, int (*run)(int argc, char *argv[]));
} // namespace abut::app

#endif

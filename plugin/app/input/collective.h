// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_COLLECTIVE_H
#define ABUT_APP_COLLECTIVE_H

/** @file
 * Errors agreed over ranks: what fails on one rank fails on all of them, with
 * the same message, so that no rank waits for one that has left.
 */

#include <mpi.h>

#include <exception>
#include <functional>

namespace abut::app
{
  /** Call @p action on each rank; if it threw on any, throw the exception of
   * the lowest such rank on all of them (an InputError as InputError,
   * everything else as std::runtime_error with the same text).
   *
   * Collective. The action itself must not communicate after a place at which
   * only some ranks may throw. */
  void collective(MPI_Comm communicator, const std::function<void()> &action);

  /** collective() of an action of rank 0 alone. */
  void on_root(MPI_Comm communicator, const std::function<void()> &action);

  /** Second half of collective(): agree on @p mine, the exception of this rank
   * or nullptr. Collective. */
  void throw_agreed(MPI_Comm communicator, std::exception_ptr mine);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_STOP_SIGNAL_H
#define ABUT_APP_STOP_SIGNAL_H

#include <mpi.h>

namespace abut::app
{
  /** While an object of this class lives, SIGTERM and SIGINT do not end the
   * process but are noted; a second SIGINT ends it at once. One object at a
   * time. */
  class StopSignal
  {
  public:
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal &) = delete;
    StopSignal &operator=(const StopSignal &) = delete;

    /** Whether any rank has been asked to stop. Collective. */
    bool has_come(MPI_Comm communicator) const;
  };
} // namespace abut::app

#endif

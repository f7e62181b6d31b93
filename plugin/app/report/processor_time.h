// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PROCESSOR_TIME_H
#define ABUT_APP_PROCESSOR_TIME_H

#include <ctime>

namespace abut::app
{
  /** Seconds that the processor has worked for this thread. For timing what
   * one thread does: unlike the clock on the wall it does not count other
   * programs that share the machine. */
  inline double processor_seconds()
  {
    std::timespec time = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }
} // namespace abut::app

#endif

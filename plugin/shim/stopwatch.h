// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_STOPWATCH_H
#define ABUT_SHIM_STOPWATCH_H

#include <ctime>

namespace abut::shim
{
  /** Adds the processor time of this thread from its beginning to its end, in
   * seconds. One within another must not add to the same sum. */
  class Stopwatch
  {
  public:
    explicit Stopwatch(double &sum) : sum_(sum), start_(now())
    {
    }

    Stopwatch(const Stopwatch &) = delete;
    Stopwatch &operator=(const Stopwatch &) = delete;

    ~Stopwatch()
    {
      sum_ += now() - start_;
    }

  private:
    static double now()
    {
      timespec time = {};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
      return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
    }

    double &sum_;
    const double start_;
  };
} // namespace abut::shim

#endif

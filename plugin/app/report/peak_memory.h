// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PEAK_MEMORY_H
#define ABUT_APP_PEAK_MEMORY_H

#include <deal.II/base/utilities.h>

namespace abut::app
{
  /** Largest resident memory of this process so far, in MiB. Reads a file of
   * the system: some 20 microseconds. */
  inline double peak_memory()
  {
    dealii::Utilities::System::MemoryStats stats;
    dealii::Utilities::System::get_memory_stats(stats);
    return static_cast<double>(stats.VmHWM) / 1024.;
  }
} // namespace abut::app

#endif

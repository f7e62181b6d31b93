// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_TIME_STATUS_H
#define ABUT_APP_TIME_STATUS_H

#include <abut/status.h>

#include <stdexcept>

namespace abut::app
{
  /** What a kernel of a time scheme said of vectors of this program, which can
   * only be that they are no numbers. Throws then. */
  inline void check_motion(const abut_status status)
  {
    if (status != ABUT_SUCCESS)
      throw std::runtime_error("The motion is not finite any more.");
  }
} // namespace abut::app

#endif

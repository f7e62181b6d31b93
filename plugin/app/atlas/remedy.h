// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ATLAS_REMEDY_H
#define ABUT_APP_ATLAS_REMEDY_H

#include <abut/failure.h>

#include <string>

namespace abut::app
{
  /** What helps against a failure, in words of a parameter file where it is a
   * parameter that helps, else in those of the library. */
  std::string remedy(const abut_failure_entry &failure);
} // namespace abut::app

#endif

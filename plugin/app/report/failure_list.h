// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_FAILURE_LIST_H
#define ABUT_APP_FAILURE_LIST_H

#include <abut/failure.h>

#include <string>

namespace abut::app
{
  /** What to do about a known failure: a parameter where one helps. */
  std::string remedy(const abut_failure_entry &failure);

  /** The known failures with their remedies, as a table in Markdown. */
  std::string failure_list();
} // namespace abut::app

#endif

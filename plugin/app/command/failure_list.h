// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_FAILURE_LIST_H
#define ABUT_APP_FAILURE_LIST_H

#include <string>

namespace abut::app
{
  /** The known failures with their remedies, a parameter where one helps, as a
   * table in Markdown. */
  std::string failure_list();
} // namespace abut::app

#endif

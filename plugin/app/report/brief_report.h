// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BRIEF_REPORT_H
#define ABUT_APP_BRIEF_REPORT_H

#include <iosfwd>

namespace abut::app
{
  class Report;

  /** Print the results that a reader looks for first, in the words of the
   * field: a table of contact pairs, the figures of the summary whose exact
   * values are known, others as far as a screen has room, and a verdict.
   * @param n_lines printed so far */
  void print_brief(std::ostream &out, const Report &report,
                   unsigned int n_lines);
} // namespace abut::app

#endif

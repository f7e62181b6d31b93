// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RUN_IDENTITY_H
#define ABUT_APP_RUN_IDENTITY_H

#include <map>
#include <string>

namespace abut::app
{
  /** What must be the same when a run goes on as when it began, by name:
   * versions, parameters, and the content of files that these name. */
  using RunIdentity = std::map<std::string, std::string>;

  /** The entries of a program of this build. */
  RunIdentity program_identity();

  /** @p before with today's names and words of its parameters; @p now is the
   * identity that it is compared with. */
  RunIdentity with_present_names(const RunIdentity &before,
                                 const RunIdentity &now);

  /** What differs between the run that wrote a checkpoint and the present one,
   * in words; empty: nothing. */
  std::string difference(const RunIdentity &before, const RunIdentity &now);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ATLAS_ATLAS_H
#define ABUT_APP_ATLAS_ATLAS_H

/** @file
 * `abut atlas`: scenes of known failures and their cures, run and compared with
 * what they are expected to show.
 *
 * atlas_entry reads a pair of scenes and what is expected of it, RunFigures
 * the numbers that a run left, atlas_report writes the page.
 */

#include "app/input/input_error.h"
#include "atlas_entry.h"

#include <iosfwd>

namespace abut::app
{
  /** What one run of an entry has shown. */
  struct AtlasRun
  {
    int exit_code = -1; /**< negative: minus the signal that ended it */
    RunFigures figures;
    std::vector<std::string> messages; /**< warnings and errors, a line each */
    bool says_code = false;            /**< of the entry, in a message */
  };

  /** Both runs of an entry, and what was expected but did not hold. */
  struct AtlasResult
  {
    AtlasEntry entry;
    AtlasRun failing, cure;
    std::vector<std::pair<RunFigures, RunFigures>> varied; /**< by value */
    std::vector<std::string> complaints; /**< empty: all as expected */
  };

  /** Run both files of an entry as processes of their own.
   * @param folder of their output */
  AtlasResult run_entry(const AtlasEntry &entry,
                        const std::filesystem::path &folder);

  /** Write the results as Markdown: what was done, what the program said, what
   * was measured and what cures it. */
  void write_atlas(const std::vector<AtlasResult> &results, std::ostream &out);

  struct AtlasOptions
  {
    std::filesystem::path path;   /**< folder of entries, or a file of one */
    std::filesystem::path output; /**< folder of the runs */
    std::filesystem::path report; /**< the page to write */
    bool quiet = false;           /**< print only what is not as expected */
  };

  /** Run entries, print whether they show what is expected, and write the page.
   * Throws InputError for what is wrong in the files. On one rank.
   * @return unusable_answer if something was not as expected */
  ExitCode run_atlas(const AtlasOptions &options);
} // namespace abut::app

#endif

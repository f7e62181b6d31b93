// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ATLAS_ATLAS_ENTRY_H
#define ABUT_APP_ATLAS_ATLAS_ENTRY_H

/** @file
 * Entries of the failure atlas. An entry NAME is two scene files, NAME.prm
 * that fails and NAME.cure.prm, which usually includes the first and changes
 * what cures it. What is expected of them stands in comments of fixed form:
 *
 *     # failure: ABUT-F06       code that the run must name; `none` where it
 *                               must not fail and must name none
 *     # avoids: ABUT-F04        with `failure: none`: the failure that the
 *                               program never meets; may be left out
 *     # title: penalty too small
 *     # done: what was done     may be repeated to go on, like `cure`
 *     # exit: 0                 exit code of the run; 0 if left out
 *     # symptom: max_penetration > 0.1
 *     # symptom: contact_force < 0.5 * cure
 *     # vary: Method/Penalty factor = 1; 1e5; 1e10
 *     # table: condition, linear_iterations
 *
 * and in the second file
 *
 *     # cure: what cures it
 *     # exit: 0
 *     # symptom: max_penetration < 1e-9
 *
 * A symptom is a name that RunFigures knows, one of < <= = >= >, and a number,
 * `true`, `false`, `cure` (the same name in the other run) or a number times
 * `cure`. With `vary` both files are also run with each value of a parameter,
 * and the report tables the numbers named.
 */

#include "app/report/run_figures.h"

#include <abut/failure.h>

#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  /** An expected relation between numbers. */
  struct Symptom
  {
    std::string text; /**< as written */
    std::string quantity;
    std::string relation;
    double factor = 1.;
    bool of_cure = false; /**< factor times the number of the cure */

    /** Read one; throws InputError with the text. */
    static Symptom parse(const std::string &text);

    /** Whether it holds; not for numbers that are missing. */
    bool holds(const RunFigures &run, const RunFigures &cure) const;
  };

  /** One of the two files of an entry. */
  struct AtlasScene
  {
    std::filesystem::path file;
    int exit_code = 0;
    std::string text; /**< what is done there */
    std::vector<Symptom> symptoms;
  };

  /** An entry of the atlas. */
  struct AtlasEntry
  {
    std::string name, title;
    const abut_failure_entry *failure = nullptr; /**< null: does not fail */
    const abut_failure_entry *avoided = nullptr; /**< what it does not meet */
    AtlasScene failing, cure;
    std::string varied; /**< path of the parameter that is varied, or empty */
    std::vector<std::string> values; /**< of it */
    std::vector<std::string> table;  /**< numbers tabled for each value */
  };

  /** The entry of a file NAME.prm, or all of a folder in order of code and
   * name. Throws InputError for what is missing or cannot be read. */
  std::vector<AtlasEntry> read_atlas(const std::filesystem::path &path);
} // namespace abut::app

#endif

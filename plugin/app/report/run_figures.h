// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RUN_FIGURES_H
#define ABUT_APP_RUN_FIGURES_H

#include "run_summary.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace abut::app
{
  /** The numbers that a run has left in its output folder. */
  class RunFigures
  {
  public:
    /** None at all. */
    RunFigures() = default;

    /** Read summary.json and levels.csv, as far as they exist. */
    explicit RunFigures(const std::filesystem::path &folder);

    /** A number by name, if there is one:
     *
     *     order(h1_error)         log2 of the last two rows of levels.csv
     *     growth(energy)          last row by the one before
     *     starts(contact_force)   how often the column leaves 0
     *     mean(contact_force)     of the rows that have a number there
     *     ripple(contact_force)   their standard deviation by the size of the
     *                             mean
     *     largest(contact_force)  the largest size of them
     *     contact_force           of summary.json, see RunSummary::number()
     *
     * In place of a column there may be the ratio of two, `a/b`. The last three
     * may have a range of times, `mean(contact_force, 1, 2)`: rows after the
     * first one, up to the second. */
    std::optional<double> value(const std::string &name) const;

    /** The same of summary.json without the sections that measure and write,
     * see RunSummary::cost(). */
    std::optional<double> cost(const std::string &key) const
    {
      return summary.cost(key);
    }

    /** What is wrong with a name that value() has nothing for, see
     * RunSummary::explain(). */
    std::string explain(const std::string &name) const;

  private:
    using Column = std::vector<double>;

    /** A column or a ratio of two; none where one is not there. */
    std::optional<Column> column(const std::string &text) const;

    /** Of it the numbers within a range of times, if there is one; none where
     * the range is not one, or nothing is in it. */
    std::optional<Column> column_within(const std::string &text) const;

    RunSummary summary;
    std::map<std::string, Column> columns;
  };
} // namespace abut::app

#endif

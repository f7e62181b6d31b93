// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ATLAS_RUN_FIGURES_H
#define ABUT_APP_ATLAS_RUN_FIGURES_H

#include "app/report/run_summary.h"

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
     *     contact_force           of summary.json, see RunSummary::number()
     */
    std::optional<double> value(const std::string &name) const;

  private:
    RunSummary summary;
    std::map<std::string, std::vector<double>> columns;
  };
} // namespace abut::app

#endif

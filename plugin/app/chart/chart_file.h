// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CHART_CHART_FILE_H
#define ABUT_APP_CHART_CHART_FILE_H

/** @file
 * What a chart file asks for.
 */

#include "app/input/parameters.h"

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** One curve: settings that it adds to the scene, and the parameters that
   * vary along it. */
  struct ChartCurve
  {
    std::string name;
    std::string section; /**< several curves may come from one */
    std::vector<Assignment> settings;
    std::vector<std::string> axis; /**< all take the same value */
    std::vector<std::string> values;
    std::string axis_origin; /**< where the values stand, for messages */
  };

  /** Section `Error`. */
  struct ChartError
  {
    std::string quantity; /**< key of summary.json; empty: no error */
    std::optional<double> reference;
    std::vector<Assignment> finer_run; /**< settings; empty: none */
    double scale = 0;                  /**< 0: size of the reference, or 1 */
    std::string label;                 /**< of pictures; empty: the quantity */

    /** Whether the quantity is an error by itself, against a solution that the
     * scene knows. */
    bool is_error() const
    {
      return !reference && finer_run.empty();
    }
  };

  struct ChartFile
  {
    /** The file without the sections of settings, for places of mistakes. */
    ParameterFile file;
    std::string name;
    std::string title;
    std::string scene_file;
    std::string axis_label;
    std::string axis_quantity;
    std::string time;
    unsigned int repeats = 3;
    double repeat_seconds = 0;
    double time_limit = 0;
    std::vector<double> targets;
    std::set<std::string> pictures;
    ChartError error;
    std::vector<ChartCurve> curves; /**< lists multiplied */

    /** Read @p path; throws InputError. */
    ChartFile(const std::string &path,
              const std::vector<std::string> &overrides);

    static void declare(dealii::ParameterHandler &prm);

  private:
    void read_entries();
    void read_error();
    void read_curves(const std::vector<Assignment> &free);
  };
} // namespace abut::app

#endif

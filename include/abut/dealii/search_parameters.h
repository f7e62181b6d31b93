// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_SEARCH_PARAMETERS_H
#define ABUT_DEALII_SEARCH_PARAMETERS_H

/** @file
 * How contact is looked for, as parameters of a deal.II ParameterHandler.
 */

#include <abut/detect.h>
#include <abut/surface.h>

#include <deal.II/base/parameter_handler.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace abut
{
  /** Thicknesses in the form that the detection takes. */
  struct GroupThicknesses
  {
    std::vector<std::int32_t> groups; /**< numbers of the groups */
    std::vector<double> values;       /**< of each group, length */
  };

  /** The section `Search` of a parameter file.
   *
   * Call declare_parameters() on a handler, parse the file, then
   * parse_parameters(). Neither is collective.
   */
  struct SearchParameters
  {
    /** All settings of search and detection except thicknesses. */
    abut_detection_options detection = abut_detection_defaults();

    /** As in abut_surface_data, radian. */
    double feature_angle = abut_surface_data_defaults().feature_angle;

    /** As in abut_surface_data. */
    bool check_orientation = abut_surface_data_defaults().check_orientation;

    /** Thickness of bodies by group. */
    std::map<std::int32_t, double> thickness;

    /** Thickness of all groups that are not in @ref thickness. */
    std::optional<double> other_thickness;

    /** Declare the section `Search` in the present section of @p prm. */
    static void declare_parameters(dealii::ParameterHandler &prm);

    /** Read the section `Search` in the present section of @p prm; throws
     * dealii::ExceptionBase for an invalid list of thicknesses. */
    void parse_parameters(dealii::ParameterHandler &prm);

    /** The thicknesses of these groups, for abut_detection_options: its
     * pointers must stay valid until the detection is created. */
    GroupThicknesses
    group_thicknesses(const std::set<std::int32_t> &groups) const;
  };
} // namespace abut

#endif

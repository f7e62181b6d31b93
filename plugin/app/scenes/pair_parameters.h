// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PAIR_PARAMETERS_H
#define ABUT_APP_PAIR_PARAMETERS_H

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace abut::app
{
  /** A section `Pair N` of a scene: what may touch what. */
  struct PairParameters
  {
    std::string section; ///< "Pair 1"
    std::string secondary, primary;
    unsigned int obstacle = 0; ///< number of the rigid obstacle; 0: none
    std::string gap;
    std::string friction, friction_cap; ///< formulas; cap empty: none
    /** Name and formulas of tractions known from theory, for pictures. */
    std::string closed_form, closed_pressure, closed_friction;
    bool mesh_gap = true;
    bool tied = false;
    double reach = 0.;

    /** Declare the section of this name. */
    static void declare(dealii::ParameterHandler &prm,
                        const std::string &section);

    /** Read it; throws InputError if it does not say what with what.
     * @param n_obstacles that the scene has */
    void parse(dealii::ParameterHandler &prm, const std::string &section,
               unsigned int n_obstacles);

    /** Full name of a parameter, for messages. */
    std::string parameter(const std::string &name) const
    {
      return section + "/" + name;
    }
  };
} // namespace abut::app

#endif

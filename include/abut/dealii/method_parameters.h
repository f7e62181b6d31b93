// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_METHOD_PARAMETERS_H
#define ABUT_DEALII_METHOD_PARAMETERS_H

/** @file
 * How contact is enforced, as parameters of a deal.II ParameterHandler.
 */

#include <abut/strategy.h>

#include <deal.II/base/parameter_handler.h>

namespace abut
{
  /** Linear system in which contact is enforced. */
  enum class System
  {
    automatic,   /**< chosen by law, discretisation and size */
    condensed,   /**< pressures eliminated row by row */
    saddle_point /**< pressures are unknowns of the linear system */
  };

  /** The section `Method` of a parameter file.
   *
   * Call declare_parameters() on a handler, parse the file, then
   * parse_parameters(). Neither is collective. All values are free of units;
   * abut_strategy_options tells what each is a multiple of. The scales of
   * length and pressure and the reduction over ranks in @ref options are left
   * at their defaults: they belong to the scene, not to the file.
   */
  struct MethodParameters
  {
    /** The law and all settings of the outer method. */
    abut_strategy_options options = abut_strategy_defaults();

    /** Which linear system is solved. */
    System system = System::automatic;

    /** Declare the section `Method` in the present section of @p prm. */
    static void declare_parameters(dealii::ParameterHandler &prm);

    /** Read the section `Method` in the present section of @p prm; throws
     * dealii::ExceptionBase when two values contradict each other. */
    void parse_parameters(dealii::ParameterHandler &prm);
  };
} // namespace abut

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_TIME_PARAMETERS_H
#define ABUT_APP_TIME_PARAMETERS_H

#include <abut/dealii/coded.h>
#include <abut/dealii/load_steps.h>
#include <abut/time.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace abut::app
{
  /** Energy that a scheme has made, by what there was, above which a motion is
   * no answer. */
  constexpr double useless_gain = 0.1;

  /** What touches in a motion. */
  enum class Touching
  {
    nodes, ///< of a mesh: the finer it is, the less mass they have
    areas, ///< have mass on any mesh, and lose their velocity
    masses ///< points, lumped: there is no modified mass
  };

  /** What to say of a balance that has lost energy, at the end of a motion.
   * @param begin,end the step in which it fell most */
  Message text_of_loss(const abut_time_scheme &scheme,
                       const abut_time_balance &balance, double begin,
                       double end, Touching what);

  /** Whether a step has taken most of the energy although contact, by this
   * largest @p force over this displacement @p way within the step, seems not
   * to be the cause. Never of schemes with impulses.
   * @param before,after the balance at the ends of the step */
  bool loses_motion(const abut_time_scheme &scheme,
                    const abut_time_balance &before,
                    const abut_time_balance &after, double force, double way);

  /** What to say of a step from time @p begin to @p end of which loses_motion()
   * is true: there is no motion left. Empty where a contact @p force acts in
   * it, unless the step is longer than the slowest oscillation, of this
   * @p period. */
  Message text_of_lost_motion(const abut_time_balance &before,
                              const abut_time_balance &after, double force,
                              double period, double begin, double end);

  /** Section `Time stepping`: motion by a scheme of the core. */
  struct TimeParameters
  {
    bool is_on = false; ///< whether there is a scheme
    abut_time_scheme scheme = {};
    double step = 0., end = 1.;
    double restitution = 0.; ///< of schemes with impulses

    /** @param schemes the words that the kind of scene knows, separated by |;
     * the first is the default, `none` means no motion
     * @param about_steps a sentence about their length */
    static void declare(dealii::ParameterHandler &prm,
                        const std::string &schemes,
                        const std::string &about_steps);

    /** Throws InputError for values that contradict each other.
     * @param finds_step the scene makes a step of its own where the file has
     * 0 */
    void parse(dealii::ParameterHandler &prm, bool finds_step = false);

    /** Throws InputError if the scheme does not go with where mass sits. */
    void check_mass(abut_time_mass mass) const;

    /** Throws InputError if the step does not fit the end. */
    void check_step() const;

    /** The way to the end in equal steps of at most @ref step, with what
     * @p given says of steps that fail. */
    LoadStepOptions steps(const LoadStepOptions &given) const;
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_LOOP_H
#define ABUT_DEALII_CONTACT_LOOP_H

/** @file
 * The contact iteration of one linearisation. ContactSolver and
 * ContactAssembler::solve_linearised() run it; hosts want one of these.
 */

#include <abut/dealii/contact_assembler.h>

#include <functional>

namespace abut
{
  /** Solve and update in turn, from @p u until the iteration stops;
   * ContactAssembler::iteration() reports whether with an answer. To be called
   * after detect(u) or linearise(u). If something throws, @p u is as far as it
   * went. Hanging nodes are left to the caller. Collective.
   * @param residual writes internal minus external forces at its first argument
   *   into the second, linear in the former: R + K (u - u_0)
   * @param stepped called after each update with the cost of the linear systems
   *   and the increment; may be empty */
  template <int dim>
  LinearReport iterate_contact(
      ContactAssembler<dim> &contact, const Tangent &tangent, la::Vector &u,
      const std::function<void(const la::Vector &, la::Vector &)> &residual,
      const std::function<void(const LinearReport &, const la::Vector &)>
          &stepped = {})
  {
    LinearReport total;
    la::Vector forces(u), increment(u);
    bool goes_on = true;
    while (goes_on)
    {
      residual(u, forces);
      const LinearReport cost = contact.solve(tangent, forces, increment);
      u += increment;
      goes_on = contact.update(u);
      total += cost;
      if (stepped)
        stepped(cost, increment);
    }
    return total;
  }
} // namespace abut

#endif

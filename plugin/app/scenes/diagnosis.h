// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_DIAGNOSIS_H
#define ABUT_APP_DIAGNOSIS_H

/** @file
 * What a run looks for in its own results. Each function puts what it has
 * measured into the summary, and warns where it names a known failure.
 */

#include "app/report/report.h"
#include "works.h"

#include <abut/dealii/contact_examination.h>
#include <abut/dealii/method_parameters.h>
#include <abut/strategy.h>

#include <optional>
#include <string>
#include <vector>

namespace abut::app
{
  /** Of the penalty that a method starts from: whether it is out of any
   * sensible range. */
  void diagnose_penalty(Report &report, const MethodParameters &method);

  /** Of the force of loads that their points miss or add, and of the prescribed
   * displacements that nodes do, as a part of them: whether formulas change
   * within cells. Nothing where there is no such part. */
  void diagnose_data(Report &report, std::optional<double> load_error,
                     std::optional<double> support_error);

  /** The same of a pair's coefficient of friction and its limit at nodes; @p
   * name of the measure, @p pair in messages. */
  void diagnose_friction_data(Report &report, const std::string &name,
                              const std::string &pair,
                              std::optional<double> error);

  /** The error estimate of a mesh into the summary; relative to the energy norm
   * of the solution where @p norm is not 0. */
  void report_estimate(Report &report, double estimate, double norm);

  /** What a linear solver has said when it failed; blames the penalty (0: none)
   * where that leaves too few digits for the rest of the matrix. */
  Message diagnose_solver_failure(const Message &message, double penalty);

  /** Of a converged contact iteration: whether sets of active rows came back,
   * and how many steps it needed on one mesh.
   * @param is_cold it started from nothing, and need not have
   * @param n_layers steps in a row that have changed the number of active rows
   * in the same direction */
  void diagnose_iteration(Report &report, const abut_progress &progress,
                          bool is_cold = false, int n_layers = 0);

  /** How an answer was found. */
  struct SolvedBy
  {
    bool newton = false;  ///< the problem is not its own linearisation
    bool factors = false; ///< linear systems were factorised
    /** Forces out of balance are round-off of those that the matrix makes. */
    bool to_round_off = false;
  };

  /** Forces out of balance, as a part of those of contact, that are worth a
   * word. */
  constexpr double visible_imbalance = 1e-6;

  /** Of the balance of forces, see ContactChecks::imbalance(): whether the
   * answer may be used; @p failure is then what to say.
   * @param penalty of the law, 0 if none */
  bool diagnose_balance(Report &report, double imbalance, double penalty,
                        const SolvedBy &by, Message &failure);

  /** Of what is stored and what the forces do, see find_works(), in linear
   * statics without friction: a finding if they contradict each other.
   * @param length of the largest cell
   * @param penalty of the law, 0 if none */
  std::optional<ContactFinding> diagnose_works(Report &report,
                                               const Works &works,
                                               double length, double penalty);

  /** Of the energies on meshes each twice as fine as the one before: at which
   * order of the mesh size they converge, and whether that is so slow that
   * the data or the edge of a punch must be singular. */
  void diagnose_order(Report &report, const std::vector<double> &energies);

  /** Of the condition number that linear solvers have met.
   * @param penalty of the law, 0 if none */
  void diagnose_condition(Report &report, double condition, double penalty);
} // namespace abut::app

#endif

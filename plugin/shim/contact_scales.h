// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CONTACT_SCALES_H
#define ABUT_SHIM_CONTACT_SCALES_H

#include "solve/stiffness.h"

#include <abut/dealii/linear_algebra.h>

#include <vector>

namespace abut::shim
{
  template <int dim> struct ContactProblem;

  /** Scales of pressures, gaps and residuals. */
  template <int dim> struct ContactScales
  {
    explicit ContactScales(ContactProblem<dim> &problem) : i(problem)
    {
    }

    /** Find those of an iteration that begins, some in the options of the
     * method. Collective. */
    void set(const solve::Stiffness &matrix, const la::Vector &residual);

    /** Find the local stiffness of the rows in a new matrix, which is that of
     * the law only if it is the first one: a law must not change from one
     * linearisation to the next. Collective. */
    void find_compliance(const solve::Stiffness &matrix);

    /** Length scale of the present iteration. Collective. */
    double length_scale() const;
    /** See ContactAssembler::length_scale(). Collective. */
    double length_scale(const la::Vector &displacement) const;
    /** Length that depths are compared with: how far bodies are deformed, or
     * the membrane is moved. Collective. */
    double deformation(const la::Vector &displacement) const;

    /** Norm of forces that are round-off where the iteration has come to.
     * Collective. */
    double round_off() const;

    double given_length = 0.; ///< 0: none
    /** Compliance of each unknown of this rank, in the matrix that penalties
     * are multiples of; empty: none yet. */
    la::Vector law_compliance;
    /** [rows] pressure per length, > 0: of each row in the last matrix taken,
     * for solvers; and in that of law_compliance, as the law has it, by patches
     * of surface. */
    std::vector<double> row_stiffness, stiffness;
    double smallest_residual = 0.;
    /** Sums of magnitudes at nodes: of the present solve, and the largest of
     * those that ended in a committed state. */
    double present_load = 0., committed_load = 0.;

  private:
    /** As length_scale(), or 0 where nothing has moved and all gaps are 0.
     * Collective. */
    double measured_length() const;
    double unmeasured_length() const;
    /** Length by pressure: inverse mean of the rows' stiffness. */
    double softness() const;

    ContactProblem<dim> &i;
  };
} // namespace abut::shim

#endif

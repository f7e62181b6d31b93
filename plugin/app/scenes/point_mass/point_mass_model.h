// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_POINT_MASS_MODEL_H
#define ABUT_APP_POINT_MASS_MODEL_H

#include <abut/dense_model.h>

#include <string>
#include <vector>

namespace abut::app
{
  /** minimise 1/2 u'Ku - f'u under g = g0 + B u >= 0, or = 0 in equality rows.
   */
  struct PointMassModel
  {
    std::vector<double> stiffness;         /**< [n*n] K by rows */
    std::vector<double> force;             /**< [n] */
    std::vector<double> start;             /**< [n] starting displacement */
    std::vector<std::vector<double>> rows; /**< B */
    std::vector<double> initial_gap;       /**< [rows] g0 */
    std::vector<bool> equality;            /**< [rows] */

    std::size_t n() const
    {
      return force.size();
    }

    /** 1/2 u'Ku - f'u. */
    double energy(const std::vector<double> &u) const;

    /** g0 + B u of a row. */
    double gap(std::size_t row, const std::vector<double> &u) const;

    /** Stiffness of the masses seen by a row, sum_j B_j^2 K_jj / |B|^4; what
     * penalties are multiples of (see abut_dense_model_solve()). */
    double row_stiffness(std::size_t row) const;

    /** A displacement to expect, from the data: the largest of |f| / K_jj and
     * of the initial gaps. 0 when nothing loads the masses. */
    double length_scale() const;

    /** A contact force to expect, likewise: the largest of |f| / |B| and of
     * initial gap times stiffness of the row. */
    double pressure_scale() const;
  };

  /** State after an outer step. */
  struct PointMassStep
  {
    abut_progress progress;
    std::vector<double> displacement;
    std::vector<double> pressure;
  };

  /** Solution with its history; the last step is the solution. */
  struct PointMassSolution
  {
    std::vector<double> displacement;
    std::vector<double> pressure;
    abut_progress progress;
    abut_reason reason;
    std::vector<PointMassStep> history;
  };

  /** Solve by the method of @p options, whose scales are set from the model.
   * Throws InputError with the core's text when it refuses the data, such as
   * a stiffness that leaves the masses free to fly away. */
  PointMassSolution solve(const PointMassModel &model,
                          abut_strategy_options options);
} // namespace abut::app

#endif

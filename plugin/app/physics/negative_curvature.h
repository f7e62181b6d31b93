// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NEGATIVE_CURVATURE_H
#define ABUT_APP_NEGATIVE_CURVATURE_H

#include <abut/dealii/linear_algebra.h>

#include <cstdint>
#include <vector>

namespace abut::app
{
  /** p K p / p D p of a direction p in which it is negative, D the magnitudes
   * of the diagonal of @p matrix K; 0 if none is found. Conjugate gradients
   * with a random right side, preconditioned by D, meet such a direction when K
   * is indefinite (Nocedal and Wright, Numerical Optimization, 2006, 7.1). At
   * the most 1000 products with K.
   * @param at_rest owned unknowns that @p p does not move
   * Collective. */
  double negative_curvature(const la::Matrix &matrix,
                            const std::vector<std::uint8_t> &at_rest);
} // namespace abut::app

#endif

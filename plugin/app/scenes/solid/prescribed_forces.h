// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PRESCRIBED_FORCES_H
#define ABUT_APP_PRESCRIBED_FORCES_H

#include <abut/dealii/contact_pair.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace abut::app
{
  /** A body or an obstacle that supports leave some translations. */
  template <int dim> struct FreeBody
  {
    std::string name;
    dealii::Tensor<1, dim> free; ///< 1 in free directions, 0 in others
    /** By pair: 1 or -1 if it is the secondary or the primary side, 0 if it is
     * in neither, NaN if it is a part of a side, or both. */
    std::vector<double> sides;
  };

  /** The free bodies whose equilibrium makes the resultants of all pairs with
   * a force, one after the other: a body whose other pairs have such
   * resultants, or none, and whose remaining ones push in one free direction.
   * Empty if a pair is left, or without forces.
   * @param force sum of the pressures of all pairs; resultants that are much
   * smaller, as of a pin in its hole, do not make it. */
  template <int dim>
  std::vector<const FreeBody<dim> *>
  bodies_in_balance(const std::vector<FreeBody<dim>> &bodies,
                    const std::vector<PairResult<dim>> &pairs, double force);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_COUPLING_H
#define ABUT_SHIM_PAIR_COUPLING_H

#include "pair_set.h"

namespace abut::shim
{
  /** The core's coupling of the sides of a pair. */
  template <int dim>
  Handle<abut_coupling> make_coupling(const PairHost<dim> &host,
                                      const SurfacePair<dim> &pair,
                                      abut_discretisation discretisation);

  /** Build the points of a coupling. @p dropped: [nodes of the secondary]
   * without a multiplier. Throws on all ranks. Collective. */
  template <int dim>
  void build_points(const PairSet<dim> &set, const SurfacePair<dim> &pair,
                    abut_coupling *coupling,
                    const std::vector<std::uint8_t> &dropped, double motion,
                    const abut_coupling_target &target);
} // namespace abut::shim

#endif

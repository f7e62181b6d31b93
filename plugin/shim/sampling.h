// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SAMPLING_H
#define ABUT_SHIM_SAMPLING_H

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  /** Points in each direction to look at between nodes of @p n_cells cells or
   * facets of dimension @p dim: many where there are few cells, as narrow
   * things are missed on coarse meshes, and at least the middle. */
  inline unsigned int samples_per_direction(const double n_cells, const int dim)
  {
    constexpr double most_in_all = 2e5, most = 400.;
    const double n = std::pow(most_in_all / std::max(1., n_cells), 1. / dim);
    return static_cast<unsigned int>(std::clamp(n, 1., most));
  }
} // namespace abut::shim

#endif

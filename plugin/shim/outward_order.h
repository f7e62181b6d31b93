// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_OUTWARD_ORDER_H
#define ABUT_SHIM_OUTWARD_ORDER_H

#include <abut/facet.h>

#include <numeric>
#include <vector>

namespace abut::shim
{
  /** Order of the face's nodes, as deal.II's reference cell has them, that
   * makes the normal point out of the cell. */
  template <int dim>
  std::vector<unsigned int> outward_order(const abut_facet_kind kind,
                                          const unsigned int face)
  {
    std::vector<unsigned int> order(abut_facet_n_nodes(kind));
    std::iota(order.begin(), order.end(), 0u);
    if (dim == 2 ? face == 1 || face == 2 : face % 2 == 1)
      return order;
    if (dim == 2)
      std::swap(order[0], order[1]);
    else
    {
      std::swap(order[1], order[2]);
      if (kind == ABUT_FACET_QUAD9)
      {
        std::swap(order[4], order[6]);
        std::swap(order[5], order[7]);
      }
    }
    return order;
  }
} // namespace abut::shim

#endif

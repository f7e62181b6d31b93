// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_POSTPROCESSED_H
#define ABUT_APP_POSTPROCESSED_H

#include <deal.II/lac/vector.h>

#include <vector>

namespace abut::app
{
  /** Make room for @p n values at each point: deal.II has none at points that
   * the cell before, of another kind, did not have. */
  inline void make_room(const unsigned int n,
                        std::vector<dealii::Vector<double>> &results)
  {
    for (dealii::Vector<double> &result : results)
      if (result.size() != n)
        result.reinit(n);
  }
} // namespace abut::app

#endif

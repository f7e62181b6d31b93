// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether surfaces touch where rows press.
#include "pair_examination.h"

#include "agree.h"
#include "pair_diagnosis.h"
#include "pair_interface.h"

#include <cmath>

namespace abut::shim
{
  template <int dim>
  std::vector<double> clearances(const PairPoints<dim> &points,
                                 const std::vector<Direction<dim>> &u,
                                 const std::vector<int> &wanted)
  {
    std::vector<double> result(points.view().n_components, INFINITY);
    std::vector<dealii::Point<dim>> present;
    for (std::size_t n = 0; n < points.surface().nodes.size(); ++n)
      present.push_back(points.surface().nodes[n].point + u[n]);
    const PairHost<dim> &host = points.host();
    run_everywhere<ContactError>(
        host.communicator,
        [&]
        {
          for (std::size_t p = 0; p < points.pairs().size(); ++p)
          {
            SurfacePair<dim> &pair = points.pairs()[p];
            if (wanted[p] != 0 && !pair.data.obstacle && !pair.data.tied
                && pair.has_mean_gaps() && pair.data.geometric_gap)
              run_named(pair.data.name,
                        [&]
                        {
                          const DisplacedSides<dim> sides(host, pair, present);
                          check(host.context,
                                abut_interface_clearances(
                                    pair.interface.get(), points.handle(),
                                    &host.search.detection,
                                    pair.secondary.everywhere.largest,
                                    pair.data.gap,
                                    static_cast<std::int32_t>(present.size()),
                                    result.data()));
                        });
          }
        });
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<double> clearances(const PairPoints<dim> &,             \
                                          const std::vector<Direction<dim>> &, \
                                          const std::vector<int> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "partner_changes.h"

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace abut::shim
{
  namespace
  {
    /** Normals that are farther apart are those of another side, cosine. */
    const double far_apart = std::cos(30. * dealii::numbers::PI / 180.);

    template <int dim>
    dealii::Tensor<1, dim> unit_normal(const abut_points_view &view,
                                       const std::int32_t point)
    {
      dealii::Tensor<1, dim> normal;
      for (unsigned int d = 0; d < dim; ++d)
        normal[d] = view.frame[view.component_start[point] * dim + d];
      return normal / normal.norm();
    }

    bool have_common_node(const std::vector<std::int32_t> &a,
                          const std::vector<std::int32_t> &b)
    {
      return std::find_first_of(a.begin(), a.end(), b.begin(), b.end())
             != a.end();
    }
  } // namespace

  template <int dim>
  PartnerChanges count_changes(const PairPoints<dim> &before,
                               const PairPoints<dim> &now,
                               const std::set<std::int64_t> &pressing)
  {
    const auto first_id = [](const abut_points_view &view, std::int32_t point)
    { return view.component_id[view.component_start[point]]; };
    std::map<std::int64_t, std::int32_t> found;
    for (std::int32_t i = 0; i < now.view().n_points; ++i)
      found[first_id(now.view(), i)] = i;
    PartnerChanges result;
    for (std::int32_t i = 0; i < before.view().n_points; ++i)
    {
      const std::vector<std::int32_t> &opposite = before.places()[i].opposite;
      const std::int64_t id = first_id(before.view(), i);
      if (opposite.empty() || pressing.count(id) == 0)
        continue;
      const auto other = found.find(id);
      if (other == found.end())
        ++result.lost;
      else
        result.jumped +=
            !have_common_node(opposite, now.places()[other->second].opposite)
            || unit_normal<dim>(before.view(), i)
                       * unit_normal<dim>(now.view(), other->second)
                   < far_apart;
    }
    return result;
  }

  template PartnerChanges count_changes(const PairPoints<2> &,
                                        const PairPoints<2> &,
                                        const std::set<std::int64_t> &);
  template PartnerChanges count_changes(const PairPoints<3> &,
                                        const PairPoints<3> &,
                                        const std::set<std::int64_t> &);
} // namespace abut::shim

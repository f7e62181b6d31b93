// SPDX-License-Identifier: LGPL-2.1-or-later
// Where contact begins for bodies that nothing else holds: surfaces that touch
// but for round-off are closed.
#include "surface_pair_rows.h"

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace abut::shim
{
  template <int dim>
  std::vector<std::uint8_t> SurfacePairRows<dim>::first_contact(
      const std::vector<double> &gap, const std::vector<double> &pressure,
      const std::vector<double> &scale, const double touching) const
  {
    if (std::none_of(pairs_.begin(), pairs_.end(),
                     [](const auto &pair) { return pair.data.holds_body; }))
      return {};
    // Pressures of an earlier solve are better, and states of slip with them.
    const bool is_pressed = std::any_of(pressure.begin(), pressure.end(),
                                        [](const double p) { return p > 0.; });
    if (dealii::Utilities::MPI::logical_or(is_pressed, communicator_))
      return {};
    std::vector<std::uint8_t> state(view_.n_components);
    for_each_component(
        [&](const Component &component)
        {
          const std::size_t i = component.row;
          const auto &pair = pairs_[component.place.pair].data;
          state[i] = pair.tied || scale[i] * gap[i] < 0.
                     || (pair.holds_body && gap[i] <= touching);
        });
    return state;
  }

  template <int dim> std::vector<int> SurfacePairRows<dim>::row_pairs() const
  {
    std::vector<int> result(view_.n_components);
    for_each_row(
        [&](const Component &component)
        { result[component.row] = static_cast<int>(component.place.pair); });
    return result;
  }

  template std::vector<std::uint8_t>
  SurfacePairRows<2>::first_contact(const std::vector<double> &,
                                    const std::vector<double> &,
                                    const std::vector<double> &, double) const;
  template std::vector<std::uint8_t>
  SurfacePairRows<3>::first_contact(const std::vector<double> &,
                                    const std::vector<double> &,
                                    const std::vector<double> &, double) const;
  template std::vector<int> SurfacePairRows<2>::row_pairs() const;
  template std::vector<int> SurfacePairRows<3>::row_pairs() const;
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
// Where contact begins for bodies that nothing else holds: without a closed
// row the first linear system would be singular.
#include "surface_pair_rows.h"

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** The @p n smallest of all ranks' values; the largest of them. */
    double nth_smallest(std::vector<double> values, const std::size_t n,
                        const MPI_Comm communicator)
    {
      std::sort(values.begin(), values.end());
      values.resize(std::min(n, values.size()));
      std::vector<double> all;
      for (const std::vector<double> &some :
           MPI::all_gather(communicator, values))
        all.insert(all.end(), some.begin(), some.end());
      std::sort(all.begin(), all.end());
      return all.empty() ? 0. : all[std::min(n, all.size()) - 1];
    }
  } // namespace

  template <int dim>
  std::vector<std::uint8_t>
  SurfacePairRows<dim>::first_contact(const std::vector<double> &gap,
                                      const std::vector<double> &pressure,
                                      const std::vector<double> &scale) const
  {
    // Rows that a body needs to be held, if it cannot turn as it likes.
    constexpr std::size_t n_needed = dim == 2 ? 2 : 4;

    std::vector<std::uint8_t> state(view_.n_components);
    std::vector<unsigned int> n_closed(pairs_.size(), 0),
        n_pressed(pairs_.size(), 0);
    const auto pressed = [&](const std::size_t i)
    { return !pressure.empty() && pressure[i] > 0.; };
    for_each_component(
        [&](const Component &component)
        {
          const std::size_t i = component.row, pair = component.place.pair;
          const double p = pressed(i) ? pressure[i] : 0.;
          state[i] = pairs_[pair].data.tied || p - scale[i] * gap[i] > 0.;
          n_closed[pair] += state[i];
          n_pressed[pair] += pressed(i);
        });
    MPI::sum(n_closed, communicator_, n_closed);
    MPI::sum(n_pressed, communicator_, n_pressed);

    bool any = false;
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair)
    {
      if (!pairs_[pair].data.holds_body || n_closed[pair] > 0)
        continue;
      any = true;
      std::vector<double> gaps;
      for_each_component(
          [&](const Component &component)
          {
            if (component.place.pair == pair)
              gaps.push_back(gap[component.row]);
          });
      const double limit = nth_smallest(gaps, n_needed, communicator_);
      for_each_component(
          [&](const Component &component)
          {
            const std::size_t i = component.row;
            if (component.place.pair == pair)
              state[i] = n_pressed[pair] > 0 ? pressed(i) : gap[i] <= limit;
          });
    }
    return any ? state : std::vector<std::uint8_t>();
  }

  template std::vector<std::uint8_t>
  SurfacePairRows<2>::first_contact(const std::vector<double> &,
                                    const std::vector<double> &,
                                    const std::vector<double> &) const;
  template std::vector<std::uint8_t>
  SurfacePairRows<3>::first_contact(const std::vector<double> &,
                                    const std::vector<double> &,
                                    const std::vector<double> &) const;
} // namespace abut::shim

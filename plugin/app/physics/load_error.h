// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LOAD_ERROR_H
#define ABUT_APP_LOAD_ERROR_H

#include "app/input/collective.h"
#include "shim/cell_quadrature.h"
#include "shim/sampling.h"

#include <deal.II/base/tensor.h>

#include <numeric>
#include <optional>
#include <vector>

namespace abut::app
{
  /** Points in cells or facets of dimension n_dim between those of a rule: 2 to
   * 64 in each direction, many where there are few, @p n on all ranks. */
  template <int n_dim> auto points_between(const double n)
  {
    const unsigned int n_points =
        shim::samples_per_direction(n, n_dim, 2., 64.);
    return [n_points](const auto &fe)
    { return shim::regular_points<n_dim>(n_points, shim::is_simplex(fe)); };
  }

  /** Force of loads that their quadrature points miss or add, found by
   * evaluating them at many points: a load that ends within a cell may be at
   * none, one or all of its points. */
  class LoadError
  {
  public:
    explicit LoadError(const MPI_Comm communicator) : communicator(communicator)
    {
    }

    /** Compare the points of @p rule with a grid of 2 to 64 points in each
     * direction. @p for_each(points, action) calls action(forces) with the
     * forces at the points of each loaded cell or facet of dimension @p n_dim,
     * always in the same order; points(fe) gives a quadrature. Collective. */
    template <int n_dim, int dim, typename ForEach, typename Rule>
    void compare(const ForEach &for_each, const Rule &rule)
    {
      using Forces = std::vector<dealii::Tensor<1, dim>>;
      Forces applied;
      collective(communicator,
                 [&]
                 {
                   for_each(rule, [&](const Forces &forces)
                            { applied.push_back(resultant(forces)); });
                 });
      const double n_loaded =
          dealii::Utilities::MPI::sum(double(applied.size()), communicator);
      std::size_t place = 0;
      const auto subtract = [&](const Forces &forces)
      {
        for (const dealii::Tensor<1, dim> &force : forces)
          whole += force.norm();
        wrong += (applied[place++] - resultant(forces)).norm();
      };
      collective(communicator,
                 [&] { for_each(points_between<n_dim>(n_loaded), subtract); });
      any = true;
    }

    /** As a part of the sum of the forces' magnitudes; nothing if nothing has
     * been compared. Collective. */
    std::optional<double> relative() const
    {
      if (!any)
        return {};
      const double all_wrong = dealii::Utilities::MPI::sum(wrong, communicator),
                   all = dealii::Utilities::MPI::sum(whole, communicator);
      return all > 0. ? all_wrong / all : all_wrong > 0. ? 1. : 0.;
    }

  private:
    template <int dim>
    static dealii::Tensor<1, dim>
    resultant(const std::vector<dealii::Tensor<1, dim>> &forces)
    {
      return std::accumulate(forces.begin(), forces.end(),
                             dealii::Tensor<1, dim>());
    }

    const MPI_Comm communicator;
    double wrong = 0., whole = 0.;
    bool any = false;
  };
} // namespace abut::app

#endif

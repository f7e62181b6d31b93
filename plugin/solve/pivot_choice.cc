// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pivot_choice.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Squares of what is left of vectors that are sums of chosen ones, as a
     * part of the largest. */
    constexpr double dependent = 1e-16;

    double squared_length(const std::vector<double> &x)
    {
      double sum = 0.;
      for (const double value : x)
        sum += value * value;
      return sum;
    }

    void subtract_part_along(const std::vector<double> &unit,
                             std::vector<double> &x)
    {
      double product = 0.;
      for (std::size_t k = 0; k < x.size(); ++k)
        product += unit[k] * x[k];
      for (std::size_t k = 0; k < x.size(); ++k)
        x[k] -= product * unit[k];
    }
  } // namespace

  std::vector<std::size_t> choose_pivots_of_span(
      const std::size_t n_items, const unsigned int dimension,
      const std::function<std::vector<double>(std::size_t)> &vector,
      const MPI_Comm communicator)
  {
    std::vector<std::vector<double>> rest(n_items);
    for (std::size_t i = 0; i < n_items; ++i)
      rest[i] = vector(i);
    std::vector<std::size_t> result;
    double first = 0.;
    for (unsigned int n = 0; n < dimension; ++n)
    {
      std::size_t best = 0;
      double largest = 0.;
      for (std::size_t i = 0; i < n_items; ++i)
        if (const double length = squared_length(rest[i]); length > largest)
        {
          largest = length;
          best = i;
        }
      const double winner = MPI::max(largest, communicator);
      first = std::max(first, winner);
      if (winner <= dependent * first)
        break;
      // The first of the ranks with the largest vector.
      std::vector<double> unit;
      const bool is_mine = largest == winner;
      const auto found = MPI::all_gather(
          communicator, is_mine ? rest[best] : std::vector<double>());
      unsigned int rank = 0;
      while (found[rank].empty())
        ++rank;
      unit = found[rank];
      if (is_mine && rank == MPI::this_mpi_process(communicator))
        result.push_back(best);
      for (double &value : unit)
        value /= std::sqrt(winner);
      for (std::vector<double> &x : rest)
        subtract_part_along(unit, x);
    }
    return result;
  }
} // namespace abut::solve

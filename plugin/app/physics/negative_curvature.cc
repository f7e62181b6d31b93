// SPDX-License-Identifier: LGPL-2.1-or-later
#include "negative_curvature.h"

#include <cmath>
#include <random>

namespace abut::app
{
  namespace
  {
    constexpr int most_products = 1000;

    /** Part of the residual at which all of the spectrum has been seen. */
    constexpr double least_part = 1e-8;

    /** Curvatures, divided by those of the diagonal, that round-off makes. */
    constexpr double least_curvature = 1e-12;
  } // namespace

  double negative_curvature(const la::Matrix &matrix,
                            const std::vector<std::uint8_t> &at_rest)
  {
    const la::LocalRows rows = la::local_rows(matrix);
    std::vector<double> diagonal = la::diagonal(rows);
    la::Vector residual(la::owned_rows(matrix), matrix.get_mpi_communicator());
    std::mt19937 random(la::row_range(matrix).first);
    std::uniform_real_distribution<double> number(-1., 1.);
    for (int i = 0; i < rows.n_rows; ++i)
    {
      diagonal[i] = std::abs(diagonal[i]);
      la::data(residual)[i] = number(random) * std::sqrt(diagonal[i]);
    }
    const auto hold = [&](la::Vector &v)
    {
      for (int i = 0; i < rows.n_rows; ++i)
        if (at_rest[i] || diagonal[i] == 0.)
          la::data(v)[i] = 0.;
    };
    const auto scaled = [&](const la::Vector &v, const int power)
    {
      la::Vector result(v);
      for (int i = 0; i < rows.n_rows; ++i)
        if (diagonal[i] > 0.)
          la::data(result)[i] *= power > 0 ? diagonal[i] : 1. / diagonal[i];
      return result;
    };
    hold(residual);
    la::Vector z = scaled(residual, -1), p(z), product(z);
    double size = residual * z;
    const double first = size;
    for (int k = 0; k < most_products && size > least_part * least_part * first;
         ++k)
    {
      matrix.vmult(product, p);
      hold(product);
      const double curvature = p * product;
      const double of_diagonal = p * scaled(p, 1);
      if (curvature < -least_curvature * of_diagonal)
        return curvature / of_diagonal;
      if (curvature <= least_curvature * of_diagonal)
        return 0.; // a free motion
      residual.add(-size / curvature, product);
      z = scaled(residual, -1);
      const double before = size;
      size = residual * z;
      p.sadd(size / before, 1., z);
    }
    return 0.;
  }
} // namespace abut::app

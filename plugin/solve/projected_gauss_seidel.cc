/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "projected_gauss_seidel.h"

#include <algorithm>

namespace abut::solve
{
  namespace
  {
    /** Minimise over unknown i alone, all others being fixed. */
    double relax(const la::LocalRows &rows, const double *residual,
                 const double *diagonal, const std::vector<double> &d,
                 const int i)
    {
      double force = -residual[i];
      for (int k = rows.start[i]; k < rows.start[i + 1]; ++k)
        force -= rows.value[k] * d[rows.column[k]];
      return d[i] + force / diagonal[i];
    }
  } // namespace

  void projected_gauss_seidel(const la::Matrix &stiffness,
                              const la::Vector &residual,
                              const std::vector<double> &lower,
                              const std::vector<double> &upper,
                              const unsigned int n_sweeps,
                              la::Vector &correction)
  {
    const la::LocalRows rows = la::local_rows(stiffness);
    const double *const r = la::data(residual);
    const std::vector<double> diagonal = la::diagonal(rows);
    for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
    {
      std::vector<double> d = la::gather(stiffness, correction);
      for (int i = 0; i < rows.n_rows; ++i)
        d[i] = std::clamp(relax(rows, r, diagonal.data(), d, i), lower[i],
                          upper[i]);
      for (int i = rows.n_rows; i-- > 0;)
        d[i] = std::clamp(relax(rows, r, diagonal.data(), d, i), lower[i],
                          upper[i]);
      std::copy(d.begin(), d.begin() + rows.n_rows, la::data(correction));
    }
  }
} // namespace abut::solve

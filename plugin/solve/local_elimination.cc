// SPDX-License-Identifier: LGPL-2.1-or-later
// Rows, or blocks of them, as the core's elimination wants them.
#include "local_elimination.h"

#include <abut/dealii/solver_parameters.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace abut::solve
{
  void LocalElimination::reinit(const abut_request &request, const int n,
                                const double *const weight,
                                const MPI_Comm communicator)
  {
    blocks_ = RowBlocks(request);
    held_.resize(n);
    for (std::vector<double> *values : {&value_, &force_, &spring_})
      values->resize(n);
    points_ = {};
    points_.struct_size = sizeof(points_);
    points_.n = n;
    points_.weight = weight;
    points_.pressure = request.pressure;
    points_.residual = request.residual;
    points_.d_pressure = request.d_pressure;
    points_.d_gap = request.d_gap;
    abut_condensed result = {};
    result.struct_size = sizeof(result);
    result.held = held_.data();
    result.value = value_.data();
    result.force = force_.data();
    result.spring = spring_.data();
    if (!blocks_.empty())
    {
      weight_.clear();
      for (int b = 0; b < blocks_.n_blocks(); ++b)
        weight_.push_back(weight[blocks_.first[b]]);
      for (std::vector<double> *values : {&spring_block_, &trial_, &test_})
        values->resize(blocks_.n_numbers());
      points_.n = request.n_blocks;
      points_.n_components = request.block_size;
      points_.weight = weight_.data();
      result.spring = spring_block_.data();
      result.trial = trial_.data();
      result.test = test_.data();
    }
    const int failure = abut_condense(&points_, &result);
    const int worst = dealii::Utilities::MPI::max(failure, communicator);
    if (worst != ABUT_SUCCESS)
      throw SolverFailure(
          worst == ABUT_UNSUPPORTED
              ? "A contact law determines neither pressure nor gap of a "
                "constraint: both derivatives are 0."
              : std::string("Contact laws cannot be eliminated: ")
                    + abut_status_text(static_cast<abut_status>(worst)) + ".");
    for (int b = 0; !blocks_.empty() && b < blocks_.n_blocks(); ++b)
      for (int r = 0, k = blocks_.size(b); r < k; ++r)
        spring_[blocks_.first[b] + r] =
            spring_block_[blocks_.at[b] + std::int64_t(r) * k + r];
  }

  std::vector<std::uint8_t> LocalElimination::resisting() const
  {
    std::vector<std::uint8_t> result(held_);
    for (std::size_t i = 0; i < result.size(); ++i)
      if (spring_[i] != 0.)
        result[i] = 1;
    return result;
  }

  void LocalElimination::project(std::vector<double> &gap_change) const
  {
    for (int b = 0; !blocks_.empty() && b < blocks_.n_blocks(); ++b)
    {
      const int k = blocks_.size(b);
      double *const value = &gap_change[blocks_.first[b]];
      double result[ABUT_CONDENSE_COMPONENTS] = {};
      for (int h = 0; h < k; ++h)
        for (int c = 0; c < k; ++c)
          result[h] += trial_[blocks_.at[b] + h * k + c] * value[c];
      std::copy_n(result, k, value);
    }
  }

  void LocalElimination::distribute(std::vector<double> &force) const
  {
    for (int b = 0; !blocks_.empty() && b < blocks_.n_blocks(); ++b)
    {
      const int k = blocks_.size(b);
      double *const value = &force[blocks_.first[b]];
      double result[ABUT_CONDENSE_COMPONENTS] = {};
      for (int h = 0; h < k; ++h)
        for (int c = 0; c < k; ++c)
          result[c] += test_[blocks_.at[b] + h * k + c] * value[h];
      std::copy_n(result, k, value);
    }
  }

  void LocalElimination::recover(const abut_request &request) const
  {
    const abut_status status = abut_condense_recover(
        &points_, request.gap_change, request.pressure_change);
    // Strategies notice numbers that are not finite, on all ranks.
    AssertThrow(status == ABUT_SUCCESS || status == ABUT_NOT_FINITE,
                dealii::ExcInternalError());
  }
} // namespace abut::solve

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_ALGEBRAIC_MULTIGRID_H
#define ABUT_SOLVE_ALGEBRAIC_MULTIGRID_H

#include "multigrid.h"

#include <memory>
#include <vector>

namespace abut::solve
{
  /** Options of smoothed aggregation of either Trilinos stack. */
  struct AggregationOptions
  {
    double threshold = 0.;         ///< weaker connections are dropped
    unsigned int smoother_sweeps;  ///< degree of Chebyshev's smoother
    bool keeps_aggregates = false; ///< restrict() will be called
    /** Values of the near-null space, mode by mode: [n_modes * owned]. No mode:
     * the constant. */
    std::vector<double> modes;
    unsigned int n_modes = 0; ///< their number, on all ranks the same
  };

  /** Smoothed aggregation by ML or MueLu. Collective. */
  class AlgebraicMultigrid : public Multigrid
  {
  public:
    /** Aggregate and restrict @p matrix, which must outlive this. */
    virtual void build(const la::Matrix &matrix,
                       const AggregationOptions &options) = 0;

    /** Restrict the matrix, whose values have changed, on the same aggregates.
     */
    virtual void restrict() = 0;
  };

  /** Algebraic multigrid of the stack of la::Matrix. */
  std::unique_ptr<AlgebraicMultigrid> make_algebraic_multigrid();
} // namespace abut::solve

#endif

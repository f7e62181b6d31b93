// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_CONTACT_FILTER_H
#define ABUT_SOLVE_CONTACT_FILTER_H

#include "direct_solver.h"
#include "multigrid.h"

#include <abut/dealii/linear_algebra.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace abut::solve
{
  /** Multigrid with a filter: a preconditioner M for matrices A with stiff
   * springs between some of their unknowns, out of a multigrid cycle B for the
   * matrix with soft ones instead and a direct solve on those unknowns,
   *
   *     I - M A = (I - F A) (I - B A) (I - F A),   F = Q (Q^T A Q)^-1 Q^T,
   *
   * where Q picks the unknowns. M is symmetric and positive definite if B is,
   * and the number of iterations does not grow with the stiffness. The idea is
   * that of Petrides, Hartland, Kolev, Lee, Puso, Solberg, Chin, Wang and
   * Petra, AMG with filtering, arXiv 2505.18576, who put the cycle, on the
   * stiff matrix, twice around one filter: that was measured to need more
   * iterations, and more time for each. The springs sit on surfaces, so that
   * Q^T A Q is small and its factors are sparse. */
  class ContactFilter
  {
  public:
    /** Take A and B, which must outlive this object, and @p picked [owned].
     * Factorises Q^T A Q. Collective. */
    ContactFilter(const la::Matrix &matrix, const Multigrid &multigrid,
                  const std::vector<std::uint8_t> &picked);

    /** dst = M src: one cycle, two products with A, two direct solves.
     * Collective. */
    void vmult(la::Vector &dst, const la::Vector &src) const;

  private:
    void add_correction(la::Vector &x) const;

    const la::Matrix &matrix_;
    const Multigrid &multigrid_;
    std::vector<int> unknowns_; ///< those picked
    std::unique_ptr<la::Matrix> small_;
    std::unique_ptr<DirectSolver> direct_;
    mutable la::Vector residual_, correction_, small_residual_,
        small_correction_;
  };
} // namespace abut::solve

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_FACTORS_H
#define ABUT_SOLVE_FACTORS_H

#include <abut/dealii/linear_algebra.h>

#include <memory>
#include <string>

namespace abut::solve
{
  /** Factors of a matrix by a package of either Trilinos stack, MUMPS or KLU.
   * Functions return the reason why the package failed,
   * empty: success, the same on all ranks. Collective. */
  class Factors
  {
  public:
    virtual ~Factors() = default;

    /** Factorise; @p room is for MUMPS, beyond its estimate, in percent. */
    virtual std::string factorise(int room) = 0;

    /** Factorise new values in the same pattern, in the order of the last
     * factorise(). */
    virtual std::string refactorise() = 0;

    /** Solve matrix x = b. */
    virtual std::string solve(la::Vector &x, const la::Vector &b) = 0;
  };

  /** Whether MUMPS is built in. */
  bool has_mumps();

  /** Whether @p matrix is factorised by MUMPS, if that is built in: KLU has
   * less to set up, which small matrices on one rank cost most of all. */
  bool takes_mumps(const la::Matrix &matrix);

  /** For @p matrix, which must exist as long as the result is used, with the
   * same values but for refactorise(). */
  std::unique_ptr<Factors> make_factors(const la::Matrix &matrix);
} // namespace abut::solve

#endif

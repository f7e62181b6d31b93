// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_FACTORS_H
#define ABUT_SOLVE_FACTORS_H

#include <abut/dealii/linear_algebra.h>

#include <memory>
#include <string>

namespace abut::solve
{
  /** Factors of a matrix by a package of either Trilinos stack: MUMPS where it
   * is built in, else KLU. Functions return the reason why the package failed,
   * empty: success, the same on all ranks. Collective. */
  class Factors
  {
  public:
    virtual ~Factors() = default;

    /** Factorise; @p room is for MUMPS, beyond its estimate, in percent. */
    virtual std::string factorise(int room) = 0;

    /** Solve matrix x = b. */
    virtual std::string solve(la::Vector &x, const la::Vector &b) = 0;
  };

  /** Whether MUMPS is built in. */
  bool has_mumps();

  /** For @p matrix, which must exist and keep its values as long as the result
   * is used. */
  std::unique_ptr<Factors> make_factors(const la::Matrix &matrix);
} // namespace abut::solve

#endif

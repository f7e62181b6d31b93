// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_DIRECT_SOLVER_H
#define ABUT_SOLVE_DIRECT_SOLVER_H

#include "factors.h"
#include "kept_matrix.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/solver_parameters.h>

#include <memory>
#include <string>

namespace abut::solve
{
  /** A sparse factorisation by Amesos or Amesos2: MUMPS where it is built in,
   * else and for small matrices KLU. deal.II's wrappers of the same cannot give
   * MUMPS the room that indefinite matrices need beyond its estimate. */
  class DirectSolver
  {
  public:
    /** Name of the solver of a matrix. */
    static std::string name(const la::Matrix &matrix);

    /** Factorise @p matrix, which must exist and keep its values as long as
     * solve() is called. Throws SolverFailure if it is singular. Collective. */
    explicit DirectSolver(const la::Matrix &matrix);

    /** The same after the values of the matrix have changed, and not its
     * pattern: its order is kept. Collective. */
    void renew();

    /** Solve matrix x = b. Collective. */
    void solve(la::Vector &x, const la::Vector &b) const;

  private:
    void factorise();

    std::unique_ptr<Factors> factors_;
    bool takes_mumps_;
  };

  /** A matrix that is made again and again, and its factors, whose order is
   * kept as long as the pattern. */
  class FactorisedMatrix
  {
  public:
    KeptMatrix matrix;

    /** Factorise its present values. Collective. */
    void factorise();

    bool has_factors() const
    {
      return factors_ != nullptr;
    }

    const DirectSolver &factors() const
    {
      return *factors_;
    }

  private:
    std::unique_ptr<DirectSolver> factors_;
    unsigned int pattern_ = 0; ///< that they are of
  };
} // namespace abut::solve

#endif

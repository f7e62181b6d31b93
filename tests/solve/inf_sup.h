// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_INF_SUP_H
#define ABUT_TESTS_INF_SUP_H

#include "solve/near_null_space.h"
#include "solve/point_operator.h"

#include <abut/dealii/solver_parameters.h>

namespace abut::solve
{
  /** An inf-sup constant and what it took. */
  struct InfSup
  {
    double constant = 0.;      ///< beta; 0 without rows
    unsigned int n_solves = 0; ///< with the matrix
  };

  /** Discrete inf-sup constant of the multipliers of constraint rows:
   *
   *     beta^2 = min_p  (B^T W p) . K^-1 (B^T W p) / sum_i w_i p_i^2 / s_i
   *
   * with the local stiffness s_i of row_stiffness(), which is about E/h: the
   * norm below is that of L2 weighted by h/E, the discrete stand-in of the
   * norm of H^-1/2. beta has no unit. For a family of meshes it stays above a
   * positive number if, and only if, pressures are determined by the
   * displacements whatever the mesh (Brezzi and Fortin, Mixed and hybrid
   * finite element methods, 1991; for mortars Wohlmuth, Acta Numerica 20
   * (2011) 569). All rows count, in contact or not.
   *
   * Rows without unknowns (all of them prescribed) do not count. A body that
   * @p stiffness leaves free must be held by the rows; else SolverFailure.
   *
   * The smallest eigenvalue of the scaled Schur complement T K^-1 T^T, T =
   * diag(w s)^1/2 B, by Lanczos' method with full orthogonalisation, on the
   * equivalent problem T (K + T^T T)^-1 T^T whose eigenvalues lie in (0, 1):
   * beta^2 = mu / (1 - mu), to 1e-3. One factorisation or preconditioner, then
   * a solve for each of some 20 to 100 vectors. Collective. */
  InfSup inf_sup_constant(const la::Matrix &stiffness,
                          const PointOperator &rows,
                          const SolverParameters &parameters,
                          const NearNullSpace &space);
} // namespace abut::solve

#endif

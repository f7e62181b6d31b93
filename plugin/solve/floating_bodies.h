// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_FLOATING_BODIES_H
#define ABUT_SOLVE_FLOATING_BODIES_H

#include "local_elimination.h"
#include "near_null_space.h"
#include "point_operator.h"
#include "stiffness.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <string>

namespace abut::solve
{
  /** Rigid motions of bodies that a stiffness does not resist, and whether
   * constraint rows do. A system with such a motion left has no solution, or
   * many; iterations and factorisations then fail in ways that do not tell
   * why, or not at all. */
  class FloatingBodies
  {
  public:
    /** Find the motions that K leaves free: translations, and rotations if the
     * positions of unknowns are known. Nothing is done for scalar fields. One
     * pass over a matrix, a product for each motion of a host's, unless
     * supports obviously hold all bodies. Collective. */
    void reinit(const Stiffness &stiffness, const PointOperator &rows,
                const NearNullSpace &space);

    /** Throw SolverFailure if rows with @p resists nonzero leave a motion
     * free: the message names the body and the motion. O(rows) for each motion
     * that K leaves free. Collective. */
    void check(const PointOperator &rows,
               const std::vector<std::uint8_t> &resists) const;

    /** The same with friction: where rows with @p sticks nonzero would hold
     * what the others do not, the message says that friction is too weak. */
    void check(const PointOperator &rows,
               const std::vector<std::uint8_t> &resists,
               const std::vector<std::uint8_t> &sticks) const;

    /** The same with what constraints and springs of a @p request resist, for
     * rows with @p row_stiffness; if it has friction, points that are not open
     * are what would stick. Collective. */
    void check(const PointOperator &rows, const LocalElimination &local,
               const abut_request &request,
               const std::vector<double> &row_stiffness) const;

    /** The same if all rows resisted: what is free then no set of rows holds.
     */
    void check_all(const PointOperator &rows) const;

  private:
    /** A motion of one body: coefficients of its translations and rotations
     * about its centre. */
    struct Motion
    {
      unsigned int body;
      std::vector<double> coefficient;
    };

    void check(const PointOperator &rows,
               const std::vector<std::uint8_t> &resists,
               const std::string &which, const std::string &or_else) const;
    /** Combinations of motions that no resisting row feels. Collective. */
    std::vector<std::vector<double>>
    free_motions(const PointOperator &rows,
                 const std::vector<std::uint8_t> &resists,
                 double &n_rows) const;
    std::string describe(const std::vector<double> &combination) const;

    NearNullSpace space_;
    unsigned int n_modes_ = 0;
    std::vector<Motion> motions_;
    /** [motions][rows] change of the gaps with each motion. */
    std::vector<std::vector<double>> gap_;
  };
} // namespace abut::solve

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_CONDENSED_MATRIX_H
#define ABUT_SOLVE_CONDENSED_MATRIX_H

#include "elimination.h"
#include "kept_matrix.h"
#include "pivots.h"
#include "stiffness.h"

namespace abut::solve
{
  /** P^T (K + B^T diag(e) B) P, where P u gives unknowns that rows determine
   * the value at which B u = 0:
   *
   *     (P u)_q = - sum_{j != q} B_ij u_j / B_iq,     q the pivot of row i.
   *
   * With friction, Q^T (K + B^T E B) P: P gives the unknowns of a point the
   * values at which its constraints hold, E has a block for each point, and Q
   * hands on the forces with those that friction adds to the pressure.
   *
   * As an operator it needs products with K and the rows alone; assemble(),
   * for preconditioners and factorisations, needs the matrix. Pivots are held
   * at 0. */
  class CondensedMatrix
  {
  public:
    /** Take K and rows; both must outlive this object. */
    void reinit(const Stiffness &stiffness, const PointOperator &rows);

    /** Take what is condensed. Collective. */
    void set(const Condensate &condensate);

    /** The terms that are condensed. */
    const Condensate &condensate() const
    {
      return condensate_;
    }

    /** Whether nothing is condensed, on all ranks: the matrix is K. */
    bool is_plain() const
    {
      return !has_springs_ && !has_pivots_;
    }

    /** Whether friction makes it unsymmetric, if K is not. */
    bool has_blocks() const
    {
      return !condensate_.blocks.empty();
    }

    /** u = P u; what @p u holds at pivots does not matter. Collective. */
    void expand(la::Vector &u) const;

    /** f = P^T f, which is 0 at pivots. Collective. */
    void restrict(la::Vector &f) const;

    /** dst = K src + B^T diag(e) B src. Collective. */
    void multiply_whole(la::Vector &dst, const la::Vector &src) const;

    /** dst = P^T (K + B^T diag(e) B) P src. Collective. */
    void vmult(la::Vector &dst, const la::Vector &src) const;

    /** [rows] springs times changes of the gaps, in place. */
    void apply_springs(std::vector<double> &row_values) const;

    /** Set a vector to 0 at pivots. */
    void zero_pivots(la::Vector &vector) const;

    /** Make @p result the matrix, with the diagonal of K at pivots: K and lines
     * near rows in contact. Collective. */
    void assemble(KeptMatrix &result) const;

    /** Entries of the matrix in addition to K line by line, see
     * for_each_elimination_term(). Rows and columns of pivots, which sum up to
     * 0, are among them. Collective. */
    void for_each_term(const VisitLine &visit) const;

  private:
    template <typename Visit> void for_each_spring(const Visit &visit) const;
    MatrixLines springs() const;
    void eliminate(KeptMatrix &whole) const;
    /** Call function(row, first row, rows, first number) for each pivot of a
     * point: the number is that of the pivot's row in the blocks. */
    template <typename Function>
    void for_each_pivot(const Function &function) const;
    template <typename Visit>
    void visit_spring(int row, int other, double stiffness,
                      const Visit &visit) const;

    Stiffness stiffness_;
    const PointOperator *rows_ = nullptr;
    Condensate condensate_;
    std::vector<int> pivot_rows_; ///< rows with a pivot
    bool has_springs_ = false, has_pivots_ = false;
    mutable std::vector<double> row_values_;
    mutable la::Vector expanded_;
  };
} // namespace abut::solve

#endif

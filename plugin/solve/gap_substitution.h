// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_GAP_SUBSTITUTION_H
#define ABUT_SOLVE_GAP_SUBSTITUTION_H

#include "gap_line.h"
#include "matrix_lines.h"
#include "point_operator.h"

#include <map>
#include <memory>

namespace abut::solve
{
  /** Gaps that change by more than their rows B, by C u = (B + R) u, as a
   * substitution: with a motion E of the nodes that the rows belong to,
   *
   *     u = v + Z v,   Z = - E (C E)^-1 R:   C u = B v .
   *
   * The problem in v has the matrix K + K Z and rows as ever, of which each can
   * still be eliminated at its own node. A node that moves along its own normal
   * hardly has a part in R: the inverse is made of that of the neighbours of
   * each row. */
  class GapSubstitution
  {
  public:
    /** Substitution for the rows of R on this rank, which may be 0: what
     * another row moves must not change their gaps, either. Collective. */
    GapSubstitution(const PointOperator &rows,
                    const std::vector<GapLine> &lines);

    /** K Z, the rows of this rank. Entries of 0 have no part. Collective. */
    MatrixLines product(const la::Matrix &matrix) const;

    /** Make u of v. Collective. */
    void apply(la::Vector &v) const;

  private:
    using Index = dealii::types::global_dof_index;
    using Line = std::vector<std::pair<Index, double>>;

    /** Lines of Z without their factors, and what an unknown's line is. */
    struct Lines
    {
      std::vector<Line> line;
      std::map<Index, std::pair<std::size_t, double>> of;
    };

    Lines lines_of(const la::Matrix &matrix) const;

    MPI_Comm communicator_;
    Lines lines_; ///< by the unknowns of this rank
    std::unique_ptr<la::Matrix> z_;
  };
} // namespace abut::solve

#endif

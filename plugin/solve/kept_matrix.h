// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_KEPT_MATRIX_H
#define ABUT_SOLVE_KEPT_MATRIX_H

#include "matrix_lines.h"

#include <abut/dealii/linear_algebra.h>

#include <memory>

namespace abut::solve
{
  /** A sum of a matrix and lines, made again and again, as in each system of an
   * iteration: values are renewed in place while their places are in the
   * pattern, which grows to that of all sums so far; entries that a sum has not
   * are 0. A pattern that has grown many times is given up, so that places of
   * long ago do not pile up. */
  class KeptMatrix
  {
  public:
    /** Make it @p matrix, which must have all diagonal entries. Collective. */
    void set(const la::Matrix &matrix);

    /** Have the pattern of the next matrix alone, as if it was the first. */
    void forget_pattern();

    /** Add @p lines, also to rows of other ranks. Call set() first. Collective.
     */
    void add(const MatrixLines &lines);

    /** The sum. */
    const la::Matrix &matrix() const
    {
      return *matrix_;
    }

    /** Number of its pattern: another one after each change. */
    unsigned int pattern() const
    {
      return pattern_;
    }

  private:
    /** Take a matrix with another pattern. */
    void replace(la::Matrix &&matrix);
    /** Numbers of columns of this rank. */
    int number(MatrixLines::Index column) const;

    std::unique_ptr<la::Matrix> matrix_;
    la::LocalRows rows_; ///< its arrays
    MatrixLines::Index first_ = 0;
    std::vector<std::pair<MatrixLines::Index, int>> ghosts_; ///< ascending
    std::vector<int> place_; ///< [columns] -1, but while a row is added to
    unsigned int pattern_ = 0, n_growths_ = 0;
  };

  /** Lines of a matrix with numbers of columns on this rank. */
  struct LocalLines
  {
    int n_lines = 0;
    const int *row = nullptr; ///< [lines]; null: line i is of row i
    const std::size_t *start = nullptr;
    const int *first = nullptr;  ///< in place of start where that is null
    const int *column = nullptr; ///< below 0: there is no such column
    const int *number = nullptr; ///< columns of @p to by @p column; null: equal
    const double *value = nullptr;
  };

  /** Whether the rows @p to have a place for each entry of @p lines. @p place:
   * [columns of to] -1, which it is afterwards. */
  bool has_places(const la::LocalRows &to, const LocalLines &lines,
                  std::vector<int> &place);

  /** Add lines that have places. */
  void add_lines(const la::LocalRows &to, const LocalLines &lines,
                 std::vector<int> &place);
} // namespace abut::solve

#endif

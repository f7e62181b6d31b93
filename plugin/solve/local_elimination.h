// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_LOCAL_ELIMINATION_H
#define ABUT_SOLVE_LOCAL_ELIMINATION_H

#include "row_blocks.h"

#include <abut/condense.h>
#include <abut/strategy.h>

#include <cstdint>
#include <mpi.h>
#include <vector>

namespace abut::solve
{
  /** The pressures of all rows eliminated, one by one or, with friction, point
   * by point: abut_condense() with the arrays of a request. Held rows (a = 0)
   * are constraints, all others springs. */
  class LocalElimination
  {
  public:
    /** Take the linearised law of @p n rows with @p weight [n]; the request's
     * arrays must live as long as this is used. Throws SolverFailure on all
     * ranks if the law determines neither pressure nor gap. Collective. */
    void reinit(const abut_request &request, int n, const double *weight,
                MPI_Comm communicator);

    /** Whether a row is a constraint. */
    bool is_held(const int row) const
    {
      return held_[row] != 0;
    }

    /** [rows] nonzero at constraints. */
    const std::vector<std::uint8_t> &held() const
    {
      return held_;
    }

    /** [rows] nonzero where the row resists a motion: constraints and springs.
     */
    std::vector<std::uint8_t> resisting() const;

    /** [rows] dg of constraints, else 0. */
    const std::vector<double> &value() const
    {
      return value_;
    }

    /** [rows] w (p - c/a) of springs, 0 at constraints. */
    const std::vector<double> &force() const
    {
      return force_;
    }

    /** [rows] w b/a of springs, 0 at constraints. */
    const std::vector<double> &spring() const
    {
      return spring_;
    }

    /** Rows by point; empty without friction, and then the next three are. */
    const RowBlocks &blocks() const
    {
      return blocks_;
    }

    /** [numbers] force per length that changes of the gaps make. */
    const std::vector<double> &spring_blocks() const
    {
      return spring_block_;
    }

    /** [numbers] directions of constraints, and of the forces that hold them.
     */
    const std::vector<double> &trial() const
    {
      return trial_;
    }
    const std::vector<double> &test() const
    {
      return test_;
    }

    /** [rows] changes of the gaps, in place: at constraints what they hold,
     * which with friction are combinations of the rows of a point. */
    void project(std::vector<double> &gap_change) const;

    /** [rows] forces of constraints, 0 elsewhere, in place: with friction,
     * which grows with the pressure, each acts on all rows of its point. */
    void distribute(std::vector<double> &force) const;

    /** Write the pressure changes of springs into the request, whose gap
     * changes are known; constraints keep theirs. */
    void recover(const abut_request &request) const;

  private:
    RowBlocks blocks_;
    std::vector<double> weight_, spring_block_, trial_, test_;
    abut_condense_points points_ = {};
    std::vector<std::uint8_t> held_;
    std::vector<double> value_, force_, spring_;
  };
} // namespace abut::solve

#endif

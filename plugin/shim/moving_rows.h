// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_MOVING_ROWS_H
#define ABUT_SHIM_MOVING_ROWS_H

#include "row_source.h"
#include "solve/gap_substitution.h"
#include "solve/kept_matrix.h"

#include <abut/dealii/detection_report.h>

#include <memory>

namespace abut::shim
{
  /** One linearisation of rows that move with the bodies: their stiffness, and
   * the substitution of unknowns that solvers see. */
  class MovingRows
  {
  public:
    /** Forget the last linearisation. */
    void clear();

    /** Take the stiffness with the pressures that an iteration starts from at
     * @p start, of lines of which some rank has one. Collective. */
    void set_geometry(const std::vector<MatrixLine> &lines,
                      const la::Vector &start);

    /** Take what gaps change by because directions and partners do; nothing if
     * no rank has any. Collective. */
    void set_substitution(const solve::PointOperator &rows,
                          const std::vector<solve::GapLine> &lines);

    /** At the end of a step: the next one has the same digits in a run that
     * begins there. */
    void forget_pattern()
    {
      sum_.forget_pattern();
    }

    bool has_geometry() const
    {
      return has_geometry_;
    }

    /** The host's matrix with that; lives until the next call. Collective. */
    const la::Matrix &with_geometry(const la::Matrix &matrix);

    /** The residual with that, as far as the iteration has come. Collective. */
    la::Vector with_geometry(const la::Vector &residual);

    /** The iteration has come to this displacement. */
    void move_to(const la::Vector &displacement)
    {
      if (has_geometry_)
        present_ = displacement;
      has_moved_ = has_geometry_;
    }

    /** Make the displacements from the result of a solver, and store that.
     * Collective. */
    void apply_substitution(la::Vector &increment);

    /** The v that gaps are linear in, where an iteration has come to
     * @p displacement by the last increment. */
    const la::Vector &linear_displacement(const la::Vector &displacement);

    /** The largest changes of partners of this rank. */
    void add_changes(const PartnerChanges &changes);

    const PartnerChanges &changes() const
    {
      return changes_;
    }

  private:
    bool has_geometry_ = false, has_moved_ = false;
    solve::MatrixLines geometry_; ///< of this and other ranks
    solve::KeptMatrix sum_;
    /** The matrix of them, once it is needed; else null. */
    std::unique_ptr<la::Matrix> moved_;
    /** Solvers see its v; null: the displacement. */
    std::unique_ptr<solve::GapSubstitution> substitution_;
    la::Vector start_, present_; ///< displacements, with geometry
    la::Vector substituted_;     ///< v that the iteration has come to
    la::Vector increment_;       ///< of v, in the last solve; empty: none
    PartnerChanges changes_;     ///< since clear()
  };
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_GAP_RAISES_H
#define ABUT_SHIM_GAP_RAISES_H

#include "solve/point_operator.h"
#include "start_values.h"

#include <abut/gap_raise.h>

#include <map>
#include <vector>

namespace abut::shim
{
  template <int dim> struct ContactProblem;

  /** Amounts that gaps of rows are raised by since detect(), where they press
   * although surfaces are apart (abut/gap_raise.h). False forces may keep rows
   * closed, since they deform bodies until these touch. Where that may be, rows
   * are opened altogether, and stay open if nothing touches then. */
  template <int dim> class GapRaises
  {
  public:
    explicit GapRaises(const ContactProblem<dim> &problem) : problem_(problem)
    {
    }

    /** Begin with none. */
    void clear();

    /** Renew the amounts; see ContactAssembler::raise_gaps(). Collective. */
    bool raise(const la::Vector &displacement);

    /** Take the amounts, the @p displacement and the @p values of rows from
     * before rows were opened altogether; false: they were not. */
    bool limit(la::Vector &displacement, RowValues &values);

    /** Whether raising has stopped before all rows without touch were open. */
    bool has_ended_early() const;

    /** From how far on surfaces are apart, length. Collective. */
    double least_clearance(const la::Vector &displacement) const;

    /** Add the amounts to the gaps [rows] of some operator. */
    void add_to(const solve::PointOperator &rows,
                std::vector<double> &gaps) const;

  private:
    using Amounts = std::map<std::int64_t, abut_gap_raise>;

    /** Whether a row of a normal has a pressure. */
    bool presses(int row) const;
    /** By what rows have pressed since; false: no row is to be changed.
     * Collective. */
    bool change(const la::Vector &displacement);
    /** Open the raised rows that still press, if that may be due to the forces
     * of raised rows only, once; false: it is not. Collective. */
    bool open(const la::Vector &displacement);
    /** Sum of pressures in pairs that touched nowhere at first. Collective. */
    double force_without_touch() const;

    const ContactProblem<dim> &problem_;
    Amounts of_;               ///< by number of the row
    unsigned int n_ = 0;       ///< how often they have been changed
    std::vector<int> touches_; ///< [pairs] whether they touched at the first
    double force_ = 0.; ///< of pairs that touched nowhere, before the first
    /** Before rows were opened altogether: the displacement (empty: they were
     * not), amounts, and values of rows. */
    la::Vector before_opening_;
    Amounts unopened_;
    RowValues values_;
    bool is_final_ = false;
  };
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_STATE_H
#define ABUT_DEALII_CONTACT_STATE_H

/** @file
 * The state that a solve begins with, on other meshes and in other runs.
 */

#include <abut/dealii/linear_algebra.h>

#include <iosfwd>
#include <stdexcept>

namespace abut
{
  /** A history of contact that cannot be read or written, or belongs to another
   * mesh: the message has the reason. Thrown on all ranks. */
  class HistoryError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** See ContactAssembler::state(). All functions are collective. */
  class ContactState
  {
  public:
    virtual ~ContactState() = default;

    /** Pressure to start from, in the form of ContactResults::pressure(), for
     * example interpolated from a coarser mesh. Call between reinit() and
     * detect(). If it is what pressure() was before reinit(), on the same mesh
     * with cells on any ranks, rows start from the pressures that they had
     * themselves. From detect() on results report it, until there is a solve.
     */
    virtual void set_pressure(const la::VectorView &pressure) = 0;

    /** Set the configuration that slips are measured from, and in which points
     * of updated kinematics are made, on a new mesh: the displacement of the
     * last commit(), with prescribed values as they were then, brought to this
     * mesh. Needed after reinit() for pairs with friction and for updated
     * kinematics only, and after load(). If points that pressed then have gaps
     * at @p displacement, ContactChecks::pairs() warns after detect(). */
    virtual void set_committed(const la::VectorView &displacement) = 0;

    /** At the start of a motion: slips from here on contain this increment of
     * the displacement, velocity times step, and the way of obstacles from
     * their committed poses to the present ones, which are those after the
     * step. Friction then acts against the velocity. Until the next commit() or
     * set_committed(); call after the latter and before detect(). */
    virtual void set_slide(const la::VectorView &increment) = 0;

    /** Write what was committed to @p stream of rank 0, binary; streams of
     * other ranks are not touched. Preconditioners are built again after it, so
     * that this run goes on as one does that calls load(). Throws HistoryError.
     */
    virtual void save(std::ostream &stream) = 0;

    /** Begin with what save() wrote, read from @p stream of rank 0: it counts
     * as committed. Call after reinit() and before detect(), with the same mesh
     * and pairs; of pairs the number of ranks may be another, rows on single
     * unknowns of an obstacle need the same numbers of unknowns. With friction
     * call set_committed(), too: without it detect() throws. Throws
     * HistoryError, and nothing changes, for anything else, such as pairs with
     * other boundary ids, or with friction where there was none; and for the
     * same mesh in a triangulation of another type (serial or distributed),
     * where cells have other numbers. */
    virtual void load(std::istream &stream) = 0;

    /** Write into a stream of each rank, binary, what its preconditioner was
     * built for, so that a run that goes on from save() with the same matrix
     * and ranks does so bit by bit. */
    virtual void save_preconditioner(std::ostream &stream) const = 0;

    /** Build that preconditioner with the next solve(), unless that has other
     * rows. Call before detect() and, with load(), after it. Throws
     * HistoryError for streams of anything else. */
    virtual void load_preconditioner(std::istream &stream) = 0;
  };
} // namespace abut

#endif

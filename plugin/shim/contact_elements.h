// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CONTACT_ELEMENTS_H
#define ABUT_SHIM_CONTACT_ELEMENTS_H

#include <abut/dealii/detection_report.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <iosfwd>
#include <unordered_map>

namespace abut::shim
{
  /** Which contact elements there were at the last commit(), and what has
   * changed since: steps 15 to 19 of the detection
   * (plugin/core/contact/detect.c), for points of any kind and on any number of
   * ranks. */
  class ContactElements
  {
  public:
    /** Elements by the number of their point: a number that the nodes of their
     * primary side have in common with no others. Each on one rank. */
    using Table = std::unordered_map<std::int64_t, std::uint64_t>;

    /** Elements of another mesh cannot be compared. */
    void forget()
    {
      *this = ContactElements();
    }

    /** Compare with @p now: the counts go into @p report. After forget() they
     * are 0. Collective. */
    void compare(const Table &now, DetectionReport &report,
                 MPI_Comm communicator) const;

    /** Keep @p now. Collective. */
    void commit(Table now, MPI_Comm communicator);

    /** Write what is kept to @p stream of rank 0, and read it from there by any
     * number of ranks. Throws HistoryError on all ranks, with nothing changed,
     * for a stream that ends or is damaged. Collective. */
    void save(std::ostream &stream, MPI_Comm communicator) const;
    void load(std::istream &stream, MPI_Comm communicator);

  private:
    bool is_known_ = false;
    /** On the rank that had them, or, loaded, on all ranks. */
    Table before_;
    std::uint64_t n_before_ = 0; ///< on all ranks
  };
} // namespace abut::shim

#endif

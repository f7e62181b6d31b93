// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_COMMUNICATION_REPORT_H
#define ABUT_DEALII_COMMUNICATION_REPORT_H

/** @file
 * Data that ranks have exchanged about contact surfaces. */

#include <cstdint>

namespace abut
{
  /** Communication about contact surfaces of one rank: which facets are near,
   * their nodes, and displacements of nodes. Not counted is what the linear
   * solvers send, and sums over all ranks. */
  struct CommunicationReport
  {
    /** Messages to single other ranks. */
    std::uint64_t messages = 0;
    /** Bytes of these messages. */
    std::uint64_t bytes = 0;
    /** Bytes of boxes that were received from all ranks: proportional to the
     * number of ranks, about half a kilobyte for each. */
    std::uint64_t gathered_bytes = 0;
    /** Facets of contact surfaces on cells of this rank. */
    std::uint64_t own_facets = 0;
    /** Facets of other ranks of which this rank has a copy. */
    std::uint64_t ghost_facets = 0;
  };
} // namespace abut

#endif

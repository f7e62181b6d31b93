// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_DETECTION_REPORT_H
#define ABUT_DEALII_DETECTION_REPORT_H

/** @file
 * What it took to find out which surfaces may touch, and what has changed.
 */

#include <cstdint>

namespace abut
{
  /** Detection between surfaces since an assembler was made: of all pairs
   * together, and of the rank with most. */
  struct DetectionReport
  {
    /** Searches at new positions of the bodies that made lists of candidates.
     */
    std::uint64_t searches = 0;
    /** Searches that lists with a skin served. */
    std::uint64_t reuses = 0;
    /** Times that facets were sorted into buckets. */
    std::uint64_t rebuilds = 0;
    /** Times that only the boxes of facets were refitted. */
    std::uint64_t refits = 0;
    /** Times that facets of other ranks were requested because bodies had come
     * too far. */
    std::uint64_t gatherings = 0;
    /** Processor time of all this and of the check for penetrations. */
    double seconds = 0.;
    /** Contact elements that there were not at the last commit(); 0 before the
     * first one on a mesh. An element is a node of the secondary, or a point of
     * quadrature, with what is opposite it within reach. */
    std::uint64_t gained = 0;
    /** Contact elements that were there and are gone. */
    std::uint64_t lost = 0;
    /** Contact elements that have other nodes of the primary. */
    std::uint64_t exchanged = 0;

    /** The same with what it has taken since @p before alone. */
    DetectionReport since(const DetectionReport &before) const
    {
      DetectionReport result(*this);
      result.searches -= before.searches;
      result.reuses -= before.reuses;
      result.rebuilds -= before.rebuilds;
      result.refits -= before.refits;
      result.gatherings -= before.gatherings;
      result.seconds -= before.seconds;
      return result;
    }

    /** Add what another solve has taken and changed. */
    DetectionReport &operator+=(const DetectionReport &other)
    {
      searches += other.searches;
      reuses += other.reuses;
      rebuilds += other.rebuilds;
      refits += other.refits;
      gatherings += other.gatherings;
      seconds += other.seconds;
      gained += other.gained;
      lost += other.lost;
      exchanged += other.exchanged;
      return *this;
    }
  };
  /** Changes by trials of a line search at points between bodies, nodes or
   * points of quadrature, that move with them and pressed when the problem was
   * linearised: the most changes of one trial. Mortar does not have such
   * points. */
  struct PartnerChanges
  {
    /** They have nothing opposite them, as past the end of a surface. */
    std::uint64_t lost = 0;
    /** They have another facet opposite them without a common node, or one
     * along whose normal they press by more than 30 degrees beside the one
     * before. */
    std::uint64_t jumped = 0;
  };
} // namespace abut

#endif

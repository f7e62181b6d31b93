// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_SLIP_H
#define ABUT_SHIM_PAIR_SLIP_H

#include "pair_points.h"

namespace abut::shim
{
  /** The reference of slips: displacements at the last commit(), and for mortar
   * that moves the points that were opposite each other then. */
  template <int dim> class PairSlip
  {
  public:
    /** @p set must outlive this object. */
    explicit PairSlip(PairSet<dim> &set) : set_(set)
    {
    }

    /** Motions that are no slip, as of bodies since the last commit() before
     * pairs touched: [pairs] displacements (owned; empty: none), or empty. */
    void set_approach(std::vector<la::Vector> approach)
    {
      approach_ = std::move(approach);
    }

    /** See RowSource::slip_reference(). The points have to be made again in the
     * next find() if others have been made. Collective. */
    RowSource::SlipReference reference(PairPoints<dim> &points,
                                       const la::Vector &committed);

  private:
    /** Find partners if nodes were displaced by @p u then; nothing happens if
     * they are those. Collective. */
    void find_partners(PairPoints<dim> &points,
                       const std::vector<Direction<dim>> &u);
    void record_partners(const PairPoints<dim> &then);
    /** Partners of a row, or null. */
    const CommittedPartners *partners_of(const PairPoints<dim> &points,
                                         const PointRow<dim> &row) const;

    PairSet<dim> &set_;
    std::vector<la::Vector> approach_; ///< see set_approach()
    /** By the number of the row; the displacements that they were found at,
     * empty: none have been; and PairSet::n_gatherings() then. */
    std::unordered_map<std::int64_t, CommittedPartners> partners_;
    std::optional<std::vector<Direction<dim>>> partners_place_;
    unsigned int partners_gathering_ = 0;
  };
} // namespace abut::shim

#endif

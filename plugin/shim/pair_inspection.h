// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_INSPECTION_H
#define ABUT_SHIM_PAIR_INSPECTION_H

#include "pair_points.h"

namespace abut::shim
{
  /** Looks at pairs when their points are made: the report on each, and errors
   * of pairs that cannot be right. */
  template <int dim> class PairInspection
  {
  public:
    /** @p is_first: nothing has been found before. */
    PairInspection(PairPoints<dim> &points, const bool is_first)
        : points_(points),
          host_(points.host()),
          surface_(points.surface()),
          pairs_(points.pairs()),
          is_first_(is_first)
    {
    }

    /** Add the report on a pair whose points have just been made. Collective.
     */
    void add_check(std::size_t pair, unsigned int n_dropped);

    /** Throw where bodies overlap, or are in obstacles, and have no rows at @p
     * displacement. Collective. */
    void check_pairs_without_rows(const la::Vector &displacement);

  private:
    std::string turning_facets(const SurfacePair<dim> &pair) const;
    /** PairCheck::first_overlap, where the rows have that @p overlap.
     * Collective. */
    double first_overlap(std::size_t pair, double overlap);
    /** The message about it, or an empty one. Collective. */
    Message overlap_at_start(SurfacePair<dim> &pair,
                             const PairCheck &found) const;
    /** Whether nothing has moved yet. */
    bool is_at_start(std::size_t number) const;
    /** Text about normals of surface and obstacle that point the same way, or
     * an empty one. Throws where the obstacle is behind most of the surface.
     * Collective. */
    std::string wrong_side(SurfacePair<dim> &pair) const;
    /** Whether supports prescribe the displacement along the normal of all
     * nodes of the secondary. Collective. */
    bool is_prescribed(std::size_t pair) const;
    Message explain_no_rows(std::size_t pair);
    void refuse_inside(std::size_t pair, const la::Vector &displacement) const;
    /** Throws if bodies overlap where no rows hold them apart. */
    void refuse_overlap(std::size_t pair);

    PairPoints<dim> &points_;
    const PairHost<dim> &host_;
    const ContactSurface<dim> &surface_;
    std::vector<SurfacePair<dim>> &pairs_;
    const bool is_first_;
  };

  /** Measure how deep bodies that may come near are in each other before
   * anything is displaced, unless the way to @p start is long enough to part
   * them. Collective. */
  template <int dim>
  void look_inside(PairSet<dim> &set, const la::Vector &start);
} // namespace abut::shim

#endif

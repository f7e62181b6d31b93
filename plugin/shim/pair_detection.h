// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_DETECTION_H
#define ABUT_SHIM_PAIR_DETECTION_H

#include "pair_inspection.h"
#include "pair_interface.h"

namespace abut::shim
{
  /** Finds the points of pairs, with a report on each pair. */
  template <int dim> class PairDetection
  {
  public:
    /** Into @p points, which have been started. @p is_first: nothing has been
     * found before. */
    PairDetection(PairPoints<dim> &points, const bool is_first)
        : points_(points),
          host_(points.host()),
          surface_(points.surface()),
          pairs_(points.pairs()),
          inspection_(points, is_first)
    {
    }

    /** The points of all pairs, whose sides have moved so far since the last
     * search. Collective. */
    void find(const std::vector<double> &moved);

    /** Throw where bodies overlap, or are in obstacles, and have no rows at @p
     * displacement. Collective. */
    void check_pairs_without_rows(const la::Vector &displacement)
    {
      inspection_.check_pairs_without_rows(displacement);
    }

  private:
    /** The sides of a pair while they stand where points are made. */
    using Displaced = std::optional<DisplacedSides<dim>>;

    /** Nodes without a multiplier, of one component (< 0: the normal). */
    std::vector<std::uint8_t>
    dropped_nodes(const SurfacePair<dim> &pair,
                  const std::vector<std::uint8_t> &taken, int component) const;
    std::vector<TiedAxes>
    tie_groups(const SurfacePair<dim> &pair,
               const std::vector<std::uint8_t> &taken) const;
    /** Numbers of points, that far behind the first of their node: by node of
     * the secondary, or by facet for the first quadrature point of each. */
    std::vector<std::int64_t> point_numbers(std::size_t pair, int shift) const;
    /** Steps 2 to 19 of the detection of a pair between bodies. Throws on all
     * ranks. Collective. */
    void search(const SurfacePair<dim> &pair, double motion) const;
    /** Append the points of a pair, with numbers that far behind the first of
     * their node or facet. */
    void append(std::size_t pair, const std::vector<std::uint8_t> &dropped,
                double motion, std::uint32_t tie_axes, int shift);
    /** Search, and append the points of a pair at nodes that are not taken.
     * The sides stay displaced. Returns the number of nodes without a
     * multiplier on all ranks. Collective. */
    unsigned int make_points(std::size_t pair, double motion,
                             const std::vector<std::uint8_t> &taken,
                             Displaced &displaced);
    /** The same, with the report on the pair; marks the nodes as taken. */
    void find_pair(std::size_t pair, double motion,
                   std::vector<std::uint8_t> &taken, Displaced &displaced);
    /** [pairs] nonzero: a pair between bodies that a node may belong to or not,
     * with a node that is in the secondary of another one, too. Collective. */
    std::vector<unsigned int> share_nodes() const;
    /** [pairs][nodes] nonzero: another such pair is nearer to the node. Takes
     * the points away that it makes to find out; sides stay displaced.
     * Collective. */
    std::vector<std::vector<std::uint8_t>>
    nodes_of_nearer_pairs(const std::vector<double> &moved,
                          std::vector<Displaced> &displaced);

    PairPoints<dim> &points_;
    const PairHost<dim> &host_;
    const ContactSurface<dim> &surface_;
    std::vector<SurfacePair<dim>> &pairs_;
    PairInspection<dim> inspection_;
  };

  /** Mark with 0 the rows that are no constraints, see
   * RowSource::drop_needless(). */
  template <int dim>
  void drop_needless(const PairPoints<dim> &points,
                     std::vector<std::uint8_t> &keep);
} // namespace abut::shim

#endif

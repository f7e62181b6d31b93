// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_SET_H
#define ABUT_SHIM_PAIR_SET_H

#include "obstacle_poses.h"
#include "pair_host.h"
#include "surface_exchange.h"

#include <optional>

namespace abut::shim
{
  /** The pairs of a problem: which of them make sense together, their sides
   * from the facets that this rank knows, and when these facets do not suffice
   * any more. Nodes are those of the gathered surface. */
  template <int dim> class PairSet
  {
  public:
    /** Throws ContactError for pairs that make no sense. @p exchange: of an
     * earlier set on the same mesh, so that facets need not be found again, or
     * null. Collective. */
    PairSet(const PairHost<dim> &host,
            const std::vector<ContactPair<dim>> &pairs,
            std::shared_ptr<SurfaceExchange<dim>> exchange);

    PairSet(const PairSet &) = delete;
    PairSet &operator=(const PairSet &) = delete;

    const PairHost<dim> &host() const
    {
      return host_;
    }

    const std::shared_ptr<SurfaceExchange<dim>> &exchange() const
    {
      return exchange_;
    }

    const ContactSurface<dim> &surface() const
    {
      return surface_;
    }

    std::vector<SurfacePair<dim>> &pairs()
    {
      return pairs_;
    }

    const std::vector<SurfacePair<dim>> &pairs() const
    {
      return pairs_;
    }

    ObstaclePoses<dim> &obstacles()
    {
      return obstacles_;
    }

    const ObstaclePoses<dim> &obstacles() const
    {
      return obstacles_;
    }

    /** Whether points of a pair move with the bodies; are made where bodies
     * were at the last commit(); are points of quadrature. */
    bool moves() const;
    bool has_steps() const;
    bool has_points() const;

    /** Median of the secondary surfaces, that of the pair of the largest. */
    double facet_size() const;

    bool is_owned(NodeIndex node) const;

    /** Freedom of a node along a direction that supports leave, in [0, 1]. */
    double freedom(NodeIndex node, const Direction<dim> &direction) const;

    /** Whether numbers of points of a pair stay those of the same points. */
    bool has_lasting_numbers(const SurfacePair<dim> &pair) const;

    /** A number of the mesh and the rules of its points. Never 0. Collective.
     */
    std::uint64_t mesh_signature() const;

    /** Throw ContactError with the message; if it is a known failure that is to
     * be solved, record it instead. */
    void refuse(SurfacePair<dim> &pair, const Message &message) const;

    /** Take the gaps of @p pairs, which differ in nothing else from those given
     * before. */
    void set_gaps(const std::vector<ContactPair<dim>> &pairs);

    /** Throw where a gap that is another than at the last call leaves nothing
     * of an obstacle or a body. Collective. */
    void check_gaps();

    /** Prescribed values of the host's constraints as they are now. Returns
     * whether one has changed. Collective. */
    bool update_constants()
    {
      return exchange_->update_constants(surface_);
    }

    /** Displacement of each node by the unknowns, and as it was given whatever
     * constraints prescribe (empty: 0). Collective. */
    std::vector<Direction<dim>> displacements(const la::Vector &u) const
    {
      return exchange_->displacements(surface_, u);
    }

    std::vector<Direction<dim>>
    displacements_as_given(const la::Vector &u) const
    {
      return exchange_->displacements_as_given(surface_, u);
    }

    /** Record the displacement of a commit(): bodies whose points move look for
     * each other as far as they have come since. */
    void record_commit(const la::Vector &displacement);

    /** Displacement at the last commit() (owned; empty: 0), which must outlive
     * its use here: points of updated kinematics are made there. */
    void set_place(const la::Vector &committed)
    {
      committed_ = &committed;
    }

    /** Displacement of the last commit(); empty: 0, or not known. */
    const la::Vector &last_commit() const;

    /** The same of pairs that move; empty: 0. */
    const la::Vector &searched_from() const
    {
      return searched_from_;
    }

    /** Search as though bodies had moved by @p length, >= 0, where pairs have
     * no reach of their own. */
    void foresee_motion(const double length)
    {
      foreseen_ = length;
    }

    /** Relative motion of the sides of a pair, length; and of all pairs since
     * the last search. Collective. */
    double motion(const SurfacePair<dim> &pair,
                  const std::vector<Direction<dim>> &u) const;
    std::vector<double> motions(const std::vector<Direction<dim>> &u) const;

    /** Throw unless displacements are finite. Collective. */
    void check_displacements(const std::vector<Direction<dim>> &u) const;

    /** Facets to be gathered. */
    enum class Gathering
    {
      none,      ///< those that are known suffice
      reference, ///< near each other in the reference configuration
      displaced  ///< where bodies are
    };

    /** Choose from how far facets are to be known for this displacement.
     * Collective. */
    Gathering extend_reach(const std::vector<Direction<dim>> &u);

    /** Gather facets and make sides of them; @p place: displacement of bodies
     * whose points are not those of the reference configuration, null: that of
     * the last time. Nodes have other numbers then, and those are kept that
     * have a first unknown in @p used. Collective. */
    void gather(const la::Vector *place,
                const std::set<dealii::types::global_dof_index> &used);

    /** Gatherings so far: numbers of nodes are those of the last one. */
    unsigned int n_gatherings() const
    {
      return n_gatherings_;
    }

    /** Let renew_sides() look at the sides of surfaces that touch themselves
     * where bodies are displaced by this (owned). */
    void look_at_sides(const la::Vector &displacement);

    /** Split such surfaces again if their sides are not right any more. Then
     * facets have to be gathered again: the displacement is returned that has
     * been looked at. Collective. */
    std::optional<la::Vector> renew_sides();

    /** Take the sides of a checkpoint. Returns whether facets have to be
     * gathered again. Collective. */
    bool load_sides(std::istream &stream);

  private:
    /** How far the sides of a pair have come against each other, length. */
    struct Motions
    {
      double searched = 0.; ///< since the last commit(), which reach follows
      /** Since facets near each other were gathered; at the last commit() or
       * now, whichever is more. */
      double gathered = 0.;
    };

    void create_pair(const ContactPair<dim> &data);
    void create_sides(SurfacePair<dim> &pair);
    void find_thickness(SurfacePair<dim> &pair);
    /** Throw where nodes of both sides hold their bodies together. Collective.
     */
    void check_hinges(SurfacePair<dim> &pair) const;
    /** [pairs] Collective. */
    std::vector<Motions>
    motions_since_gathering(const std::vector<Direction<dim>> &u) const;
    bool is_in_reach(const SurfacePair<dim> &pair,
                     const Motions &motions) const;
    void set_distances(SurfacePair<dim> &pair, const Motions &motions) const;
    /** Measure sides again that have got other facets. */
    void forget_sides();

    const PairHost<dim> host_;
    std::shared_ptr<SurfaceExchange<dim>> exchange_;
    ContactSurface<dim> surface_;
    std::vector<SurfacePair<dim>> pairs_;
    ObstaclePoses<dim> obstacles_{pairs_};
    double foreseen_ = 0.; ///< see foresee_motion()
    /** Where renew_sides() looks (owned), and where it did before. */
    std::optional<la::Vector> sides_place_;
    la::Vector sides_seen_;
    la::Vector searched_from_; ///< where points move: of the last commit()
    const la::Vector *committed_ = nullptr;
    /** [nodes] displacements that facets were gathered at. */
    std::vector<Direction<dim>> gathered_;
    unsigned int n_gatherings_ = 0;
    std::vector<double> checked_gaps_; ///< [pairs] or empty, by check_gaps()
  };

  /** @p u - @p from, by node. */
  template <int dim>
  std::vector<Direction<dim>>
  difference(std::vector<Direction<dim>> u,
             const std::vector<Direction<dim>> &from)
  {
    for (std::size_t n = 0; n < u.size(); ++n)
      u[n] -= from[n];
    return u;
  }
} // namespace abut::shim

#endif

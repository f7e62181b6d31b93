// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_POINTS_H
#define ABUT_SHIM_PAIR_POINTS_H

#include "contact_elements.h"
#include "coordinates.h"
#include "pair_set.h"
#include "row_source.h"

#include <abut/contact_measures.h>

namespace abut::shim
{
  /** A component of a point, which is a row for everybody else. */
  template <int dim> struct PointRow
  {
    std::size_t point;
    std::size_t row;
    PointPlace<dim> place;
    /** Along which the secondary closes the gap: normal, or axis of a tie. */
    Direction<dim> direction;
  };

  /** The points of the pairs of a set, and the displacements that they were
   * made at. Copies refer to the same core's points. */
  template <int dim> class PairPoints
  {
  public:
    /** @p set must outlive this object. */
    explicit PairPoints(PairSet<dim> &set)
        : set_(&set), dropped_(set.pairs().size())
    {
    }

    PairSet<dim> &set() const
    {
      return *set_;
    }

    const PairHost<dim> &host() const
    {
      return set_->host();
    }

    SurfaceExchange<dim> &exchange() const
    {
      return *set_->exchange();
    }

    const ContactSurface<dim> &surface() const
    {
      return set_->surface();
    }

    std::vector<SurfacePair<dim>> &pairs() const
    {
      return set_->pairs();
    }

    const abut_points_view &view() const
    {
      return view_;
    }

    /** Where they belong. */
    const abut_places_view &places() const
    {
      return places_;
    }

    PointPlace<dim> place(const std::size_t point) const
    {
      PointPlace<dim> result = {static_cast<std::size_t>(places_.pair[point]),
                                places_.node[point],
                                places_.facet[point],
                                {}};
      for (unsigned int d = 0; d < dim; ++d)
        result.position[d] = places_.position[point * dim + d];
      return result;
    }

    /** The core's points; null: none yet. */
    abut_points *handle() const
    {
      return points_;
    }

    /** Findings about the pairs when the points were made. */
    std::vector<PairCheck> &checks()
    {
      return checks_;
    }

    const std::vector<PairCheck> &checks() const
    {
      return checks_;
    }

    /** [nodes of the secondary] without a multiplier in the rows of a pair:
     * 1 because of another pair, of_supports because of supports. */
    std::vector<std::uint8_t> &dropped(const std::size_t pair)
    {
      return dropped_[pair];
    }

    const std::vector<std::uint8_t> &dropped(const std::size_t pair) const
    {
      return dropped_[pair];
    }

    PointRow<dim> component(const std::size_t point,
                            const std::int32_t row) const
    {
      const double sign = abut_point_sign(view_.kind[point],
                                          row - view_.component_start[point]);
      Direction<dim> direction;
      for (unsigned int d = 0; d < dim; ++d)
        direction[d] = -sign * view_.frame[row * std::size_t(dim) + d];
      return {point, static_cast<std::size_t>(row), place(point), direction};
    }

    bool is_tangent(const PointRow<dim> &row) const
    {
      return view_.kind[row.point] == ABUT_POINT_CONTACT
             && row.row
                    != static_cast<std::size_t>(
                        view_.component_start[row.point]);
    }

    /** Call function(row) in the order of the rows, along whose direction the
     * traction on the secondary is negative, as the pressure along the normal
     * is. */
    template <typename Function>
    void for_each_row(const Function &function) const
    {
      for (std::int32_t i = 0; i < view_.n_points; ++i)
        for (std::int32_t row = view_.component_start[i];
             row < view_.component_start[i + 1]; ++row)
          function(component(i, row));
    }

    /** The same without tangents. */
    template <typename Function>
    void for_each_component(const Function &function) const
    {
      for_each_row(
          [&](const PointRow<dim> &row)
          {
            if (!is_tangent(row))
              function(row);
          });
    }

    /** Call function(node, c) for the stencil of a point: D / W at nodes of
     * the secondary, or - M / W at those of the primary; or both. */
    template <typename Function>
    void for_each_secondary(const std::size_t point,
                            const Function &function) const
    {
      const std::int64_t first = view_.start[point];
      for (auto e = first; e < first + view_.n_secondary[point]; ++e)
        function(view_.node[e], view_.coefficient[e]);
    }

    template <typename Function>
    void for_each_primary(const std::size_t point,
                          const Function &function) const
    {
      for (auto e = view_.start[point] + view_.n_secondary[point];
           e < view_.start[point + 1]; ++e)
        function(view_.node[e], view_.coefficient[e]);
    }

    template <typename Function>
    void for_each_node(const std::size_t point, const Function &function) const
    {
      for_each_secondary(point, function);
      for_each_primary(point, function);
    }

    /** Call function(node, share) for the nodes of the secondary that have a
     * value of the row: its own, or those around a quadrature point. */
    template <typename Function>
    void for_each_share(const PointRow<dim> &row,
                        const Function &function) const
    {
      if (row.place.node >= 0)
        function(row.place.node, 1.);
      else
        for_each_secondary(row.point, function);
    }

    /** Current positions of the nodes, and their displacements [nodes * dim],
     * where points of displaced pairs were made; empty if there are none. */
    const std::vector<dealii::Point<dim>> &present() const
    {
      return present_;
    }

    const std::vector<double> &present_displacement() const
    {
      return present_displacement_;
    }

    Direction<dim> made_at(const NodeIndex node) const
    {
      return present_[node] - reference_[node];
    }

    /** The same of all nodes, moving or not. */
    std::vector<Direction<dim>> made() const;

    /** Displacements since the points were made. */
    std::vector<Direction<dim>>
    displacement_since(const std::vector<Direction<dim>> &u) const;

    /** Begin with no points in @p points, which must outlive their use here, of
     * bodies that are displaced so. */
    void start(abut_points *points, const std::vector<Direction<dim>> &u);

    /** Take the views of points that have been appended. */
    void update_view()
    {
      check(host().context, abut_points_get(points_, &view_));
      check(host().context, abut_points_get_places(points_, &places_));
    }

    /** Take all points out. */
    void clear();

    /** Take the areas of the nodes of a pair whose points have been made.
     * Collective. */
    void add_node_areas(const SurfacePair<dim> &pair);

    /** Area of the secondary surfaces that belongs to a node of this rank,
     * covered or not: what its force is divided by. */
    double node_area(NodeIndex node) const;

    /** Keep those rows only; see abut_points_filter(). */
    void filter(const std::vector<std::uint8_t> &keep);

    /** Input of these points, by pair; empty: they have to be made again. */
    std::vector<PointsOrigin> origins;

    /** Displacement (owned) that they were made at; empty: 0. */
    la::Vector made_place;

    /** Whether pairs whose points are made step by step have them at these
     * displacements; whether the displacements are exactly those. Collective.
     */
    bool is_where_made(const std::vector<Direction<dim>> &place) const;
    bool is_made_at(const std::vector<Direction<dim>> &u) const;

    /** Gather facets again, as PairSet::gather(); points stay as they are and
     * refer to the new numbers of nodes. Collective. */
    void renew(const la::Vector *place);

    /** Displacements of the nodes. If the facets that are known do not suffice
     * for them, others are gathered. Collective. */
    std::vector<Direction<dim>>
    displacements_in_reach(const la::Vector &displacement);

    /** The rows whose points have no number that lasts. */
    std::vector<PlacedRow> placed_rows() const;

    /** The elements of the points, but for those whose numbers do not last. */
    ContactElements::Table contact_elements() const;

    /** [rows] pair of each row. */
    std::vector<int> row_pairs() const;

    /** [pairs][nodes of the whole surface] nonzero: the node has a closed row
     * of the pair, or none that could be. Collective. */
    std::vector<std::uint8_t>
    touching_nodes(const std::uint8_t *row_state) const;

    /** [pairs][nodes of the whole surface] nonzero: a row of the pair holds
     * this node of its secondary, or none can. Collective. */
    std::vector<std::uint8_t> held_nodes() const;

  private:
    /** First unknowns of the nodes that points refer to. */
    std::set<dealii::types::global_dof_index> used_nodes() const;
    void record_place(const std::vector<Direction<dim>> &u);
    /** See abut_points_mark_nodes(). */
    void mark_nodes(const std::uint8_t *row_state,
                    std::vector<std::uint8_t> &marks) const;

    PairSet<dim> *set_;
    abut_points *points_ = nullptr;
    abut_points_view view_ = {};
    abut_places_view places_ = {};
    la::Vector node_area_; ///< at the first unknowns of nodes; empty: none
    std::vector<PairCheck> checks_;
    std::vector<std::vector<std::uint8_t>> dropped_; ///< [pairs]
    std::vector<dealii::Point<dim>> present_, reference_;
    std::vector<double> present_displacement_;
  };

  /** Positions of nodes as the core wants them. */
  template <int dim> class NodePositions
  {
  public:
    /** @p u: displacements now; empty: not known. */
    NodePositions(const PairPoints<dim> &points,
                  const std::vector<Direction<dim>> &u);

    abut_node_positions view = {};

  private:
    std::vector<double> reference_, made_, displacement_;
    std::vector<abut_kinematics> kinematics_;
  };

  /** [nodes of the side * dim] */
  template <int dim>
  std::vector<double> places_of(const std::vector<NodeIndex> &nodes,
                                const std::vector<dealii::Point<dim>> &place)
  {
    std::vector<double> result;
    for (const NodeIndex node : nodes)
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(place[node][d]);
    return result;
  }
} // namespace abut::shim

#endif

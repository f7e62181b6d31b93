// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact that rows in the reference configuration do not see: sliding of
// bodies, and obstacles between the nodes.
#include "surface_pair_rows.h"

#include "agree.h"
#include "facet_grid.h"
#include "obstacle_in_bodies.h"
#include "passage_check.h"
#include "sampling.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/rigid_obstacle.h>
#include <abut/strategy.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** How far the facet of these nodes with these outward normals is at the
     * most before the curve through them, where that is hollow: all of
     * an obstacle that fits is in the facet that far. */
    template <int dim>
    double hollow_of(const std::vector<dealii::Point<dim>> &node,
                     const std::vector<dealii::Tensor<1, dim>> &normal)
    {
      // h^2 / (8 R), by the rotation of the normals; at the ends of a surface
      // they are those of one facet and rotate by half.
      constexpr double rough = 2.;
      double hollow = 0.;
      for (std::size_t a = 0; a < node.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
          hollow = std::max(hollow, -rough / 8. * (normal[a] - normal[b])
                                        * (node[a] - node[b]));
      return hollow;
    }

    /** The part of the @p depth of an obstacle at the points of a facet that
     * its nodes do not see: where they were, their gaps are larger than at the
     * point. */
    template <int dim>
    double peak_of(const RigidObstacle<dim> &obstacle,
                   const FacetGrid<dim> &grid,
                   const std::vector<dealii::Point<dim>> &nodes,
                   const std::vector<dealii::Tensor<1, dim>> &normal,
                   const std::vector<double> &depth)
    {
      std::vector<double> gap, gap_of_nodes;
      obstacle.distance(nodes, gap_of_nodes);
      obstacle.distance(
          grid.points([&](const unsigned int a) { return nodes[a]; }), gap);
      const double known =
          *std::min_element(gap_of_nodes.begin(), gap_of_nodes.end())
          - hollow_of(nodes, normal);
      double peak = 0.;
      for (std::size_t q = 0; q < depth.size(); ++q)
        peak = std::max(peak, std::min(known - gap[q], depth[q]));
      return peak;
    }

    /** Note the deepest of points. */
    template <int dim>
    void take_deepest(const std::vector<dealii::Point<dim>> &points,
                      const std::vector<double> &depth, FacetPenetration &found)
    {
      for (std::size_t q = 0; q < points.size(); ++q)
        if (depth[q] > found.depth)
        {
          found.depth = depth[q];
          for (unsigned int d = 0; d < dim; ++d)
            found.place[d] = points[q][d];
        }
    }

    /** Unit normal of a facet by three of its nodes, of either sign. */
    dealii::Tensor<1, 2> normal_of(const dealii::Point<2> *node)
    {
      const dealii::Tensor<1, 2> normal =
          dealii::cross_product_2d(node[1] - node[0]);
      return normal / normal.norm();
    }

    dealii::Tensor<1, 3> normal_of(const dealii::Point<3> *node)
    {
      const dealii::Tensor<1, 3> normal =
          dealii::cross_product_3d(node[1] - node[0], node[2] - node[0]);
      return normal / normal.norm();
    }
  } // namespace

  template <int dim>
  std::vector<std::uint8_t>
  SurfacePairRows<dim>::touching_nodes(const std::uint8_t *row_state) const
  {
    const std::size_t n_nodes = surface_.nodes.size();
    std::vector<std::uint8_t> touching(n_nodes * pairs_.size(), 0);
    for_each_component(
        [&](const Component &row)
        {
          if (row_state != nullptr && row_state[row.row] != ABUT_STATE_OPEN)
            for_each_secondary(row.point,
                               [&](const Node node, double) {
                                 touching[row.place.pair * n_nodes + node] = 1;
                               });
        });
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      for (std::size_t n = 0; n < pairs_[p].dropped.size(); ++n)
        if (pairs_[p].dropped[n] != 0)
          touching[p * n_nodes + pairs_[p].secondary.node[n]] = 1;
    exchange_->merge_marks(surface_, touching);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      std::uint8_t *marks = touching.data() + p * n_nodes;
      for (const Node node : pairs_[p].secondary.node)
        for (const auto &parent : surface_.parents[node])
          marks[node] |= marks[parent.index];
    }
    return touching;
  }

  template <int dim>
  void SurfacePairRows<dim>::sample_facets(
      const std::size_t number, const std::vector<Direction> &u,
      const std::vector<std::uint8_t> &touching,
      const std::vector<std::uint8_t> &touching_facets,
      std::vector<FacetPenetration> &found) const
  {
    const Pair &pair = pairs_[number];
    const RigidObstacle<dim> &obstacle = *pair.data.obstacle;
    // Away from all nodes by more than a facet: only a function whose value is
    // no distance can be in it.
    const bool is_distance = obstacle.view().kind != ABUT_OBSTACLE_FUNCTION;
    const auto me = MPI::this_mpi_process(communicator_);
    const unsigned int n_nodes = surface_.nodes_per_facet();
    const FacetGrid<dim> grid(
        surface_.kind,
        samples_per_direction(pair.secondary.everywhere.n_facets, dim - 1));

    std::vector<dealii::Point<dim>> points;
    std::vector<double> distance;
    for (const Node node : pair.secondary.node)
      points.push_back(surface_.nodes[node].point + u[node]);
    obstacle.distance(points, distance);
    const double *normals = nullptr;
    check(context_,
          abut_surface_normals(pair.secondary.surface.get(), &normals));
    std::vector<double> at_node(surface_.nodes.size(), INFINITY);
    std::vector<Direction> normal_at(surface_.nodes.size());
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      at_node[pair.secondary.node[n]] = distance[n];
      for (unsigned int d = 0; d < dim; ++d)
        normal_at[pair.secondary.node[n]][d] = normals[n * dim + d];
    }

    for (const std::int32_t f : pair.secondary.facet)
    {
      const auto &facet = surface_.facets[f];
      if (facet.owner != me)
        continue;
      double nearest = INFINITY, size = 0.;
      const auto place_of = [&](const unsigned int a)
      { return surface_.nodes[facet.node[a]].point + u[facet.node[a]]; };
      for (unsigned int a = 0; a < n_nodes; ++a)
      {
        nearest = std::min(nearest, at_node[facet.node[a]]);
        size = std::max(size, place_of(a).distance(place_of(0)));
      }
      if (is_distance && nearest + pair.data.gap > size)
        continue;
      points = grid.points(place_of);
      obstacle.distance(points, distance);

      FacetPenetration here;
      here.pair = number;
      here.size = size;
      std::vector<double> depth;
      for (const double value : distance)
        depth.push_back(-value - pair.data.gap);
      take_deepest(points, depth, here);
      if (here.depth <= 0.)
        continue;
      std::vector<dealii::Point<dim>> nodes;
      std::vector<Direction> normal;
      for (unsigned int a = 0; a < n_nodes; ++a)
      {
        nodes.push_back(pair.has_committed_points()
                            ? present_[facet.node[a]]
                            : surface_.nodes[facet.node[a]].point);
        normal.push_back(normal_at[facet.node[a]]);
      }
      here.peak = peak_of(obstacle, grid, nodes, normal, depth);
      here.is_missed = touching_facets[f] == 0;
      for (unsigned int a = 0; a < n_nodes; ++a)
        if (touching[number * surface_.nodes.size() + facet.node[a]] != 0)
          here.is_missed = false;
      const dealii::CellId id(facet.cell);
      here.cell = dof_handler_.get_triangulation()
                      .create_cell_iterator(id)
                      ->active_cell_index();
      found.push_back(here);
    }
  }

  template <int dim>
  void SurfacePairRows<dim>::find_narrowest_width(
      Pair &pair, const std::vector<Direction> &u) const
  {
    const auto me = MPI::this_mpi_process(communicator_);
    NarrowestWidth narrowest;
    std::vector<dealii::Point<dim>> nodes;
    std::vector<double> distance;
    for (const std::int32_t f : pair.secondary.facet)
    {
      const auto &facet = surface_.facets[f];
      if (facet.owner != me)
        continue;
      nodes.clear();
      double size = 0.;
      for (unsigned int a = 0; a < surface_.nodes_per_facet(); ++a)
      {
        const Node node = facet.node[a];
        nodes.push_back(surface_.nodes[node].point + u[node]);
        size = std::max(size, nodes[a].distance(nodes[0]));
      }
      pair.data.obstacle->distance(nodes, distance);
      const double gap =
          *std::min_element(distance.begin(), distance.end()) + pair.data.gap;
      const double width = pair.data.obstacle->width(normal_of(nodes.data()));
      if (gap <= size && width / size < narrowest.width / narrowest.facet)
        narrowest = {width, size};
    }
    for (const auto &[width, size] : MPI::all_gather(
             communicator_, std::make_pair(narrowest.width, narrowest.facet)))
      if (width / size < narrowest.width / narrowest.facet)
        narrowest = {width, size};
    pair.narrowest = narrowest;
  }

  template <int dim>
  std::vector<FacetPenetration>
  SurfacePairRows<dim>::facet_penetrations(const la::Vector &displacement,
                                           const std::uint8_t *row_state)
  {
    std::vector<FacetPenetration> found;
    const std::vector<Direction> u = displacements_in_reach(displacement);
    const std::vector<std::uint8_t> touching = touching_nodes(row_state);
    run_everywhere<ContactError>(
        communicator_,
        [&]
        {
          for (std::size_t p = 0; p < pairs_.size(); ++p)
          {
            if (!pairs_[p].data.obstacle || !pairs_[p].data.geometric_gap)
              continue;
            std::vector<std::uint8_t> facets(surface_.facets.size(), 0);
            for_each_component(
                [&](const Component &row)
                {
                  if (row.place.pair == p && row.place.facet >= 0
                      && row_state != nullptr
                      && row_state[row.row] != ABUT_STATE_OPEN)
                    facets[row.place.facet] = 1;
                });
            sample_facets(p, u, touching, facets, found);
          }
        });
    return found;
  }

  template <int dim>
  void SurfacePairRows<dim>::examine(
      const la::Vector &displacement, const double *row_pressure,
      const double *row_gap, const std::uint8_t *row_state,
      const std::vector<FacetPenetration> &facet_penetrations)
  {
    const std::vector<Direction> u = displacements_in_reach(displacement);
    examined_ = u;
    const std::vector<RigidPose<dim>> now = poses();
    find_rotations(u, row_pressure, row_state);
    // Distances from an obstacle, or their changes on a path.
    struct Distances
    {
      std::vector<dealii::Point<dim>> from, to;
      std::vector<double> expected;
    };
    std::vector<Distances> distances(pairs_.size());
    for (Pair &pair : pairs_)
    {
      PairResult<dim> &measured = pair.measured;
      measured.slip = measured.gap_error = measured.missed_depth = 0.;
      if (!pair.data.obstacle)
        continue;
      measured.between_rows = 0.;
      find_narrowest_width(pair, u);
    }
    for_each_component(
        [&](const Component &row)
        {
          Pair &pair = pairs_[row.place.pair];
          if (pair.data.tied || row_state == nullptr
              || row_state[row.row] == ABUT_STATE_OPEN)
            return;
          const auto since_made = [&](const Node node) {
            return u[node]
                   - (pair.is_displaced() ? made_at(node) : Direction());
          };
          // Motion in this step, and since the point was made there.
          Direction motion = relative_displacement(row, u), since;
          const auto add = [&](const Node node, const double c)
          { since += c * since_made(node); };
          for_each_secondary(row.point, add);
          for_each_primary(row.point, add);
          const Direction way =
              pair.data.obstacle
                  ? rigid_displacement(row.place.position,
                                       slip_poses_[row.place.pair],
                                       now[row.place.pair])
                  : Direction();
          motion -= way;
          const Direction tangential =
              motion - (motion * row.direction) * row.direction;
          pair.measured.slip = std::max(pair.measured.slip, tangential.norm());
          if (!pair.data.obstacle)
            return;
          Distances &looked_at = distances[row.place.pair];
          if (pair.data.geometric_gap && !has_mean_gaps(row.place.pair))
          {
            looked_at.to.push_back(row.place.position + since);
            looked_at.expected.push_back(row_gap[row.row] - pair.data.gap);
            return;
          }
          // Gaps that are means, or no distances, are judged by their change,
          // at the node if there is one.
          const Direction moved =
              row.place.node < 0 ? since : since_made(row.place.node);
          looked_at.from.push_back(row.place.position + way);
          looked_at.to.push_back(row.place.position + moved);
          looked_at.expected.push_back(-(row.direction * (moved - way)));
        });
    run_everywhere<ContactError>(
        communicator_,
        [&]
        {
          std::vector<double> from, to;
          for (std::size_t p = 0; p < pairs_.size(); ++p)
          {
            if (distances[p].to.empty())
              continue;
            pairs_[p].data.obstacle->distance(distances[p].to, to);
            from.assign(to.size(), 0.);
            if (!distances[p].from.empty())
              pairs_[p].data.obstacle->distance(distances[p].from, from);
            for (std::size_t i = 0; i < to.size(); ++i)
            {
              const double error =
                  std::abs(to[i] - from[i] - distances[p].expected[i]);
              if (error <= pairs_[p].measured.gap_error)
                continue;
              pairs_[p].measured.gap_error = error;
              pairs_[p].gap_error_place = distances[p].to[i];
            }
          }
        });
    for (const FacetPenetration &found : facet_penetrations)
    {
      Pair &pair = pairs_[found.pair];
      pair.measured.between_rows =
          std::max(pair.measured.between_rows, found.depth);
      if (found.is_missed)
        pair.measured.missed_depth =
            std::max(pair.measured.missed_depth, found.depth);
    }
    for (Pair &pair : pairs_)
      for (const auto &[error, place] : MPI::all_gather(
               communicator_,
               std::make_pair(pair.measured.gap_error, pair.gap_error_place)))
        if (error > pair.measured.gap_error)
        {
          pair.measured.gap_error = error;
          pair.gap_error_place = place;
        }
  }

  template <int dim>
  std::string SurfacePairRows<dim>::wrong_side(Pair &pair) const
  {
    const SurfaceSide<dim> &side = pair.secondary;
    const double *normal = nullptr;
    check(context_, abut_surface_normals(side.surface.get(), &normal));
    std::vector<dealii::Point<dim>> points;
    std::vector<Direction> normals;
    for (int n = 0; n < side.n_nodes(); ++n)
      if (is_owned(side.node[n]))
      {
        normals.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          normals.back()[d] = normal[n * dim + d];
        points.push_back(surface_.nodes[side.node[n]].point);
      }
    // Nodes; those where both normals point the same way; of these, those with
    // the obstacle's material within a facet behind them, in their body.
    double count[3] = {double(points.size()), 0., 0.};
    run_everywhere<ContactError>(
        communicator_,
        [&]
        {
          std::vector<double> distance;
          std::vector<Direction> outward;
          pair.data.obstacle->distance(points, distance, &outward);
          std::vector<std::uint8_t> same_direction(points.size(), 0);
          for (std::size_t n = 0; n < points.size(); ++n)
            count[1] += same_direction[n] = outward[n] * normals[n] > 0.;
          // Along the inward normals; thin obstacles are not to be passed by.
          constexpr int n_steps = 32;
          std::vector<std::uint8_t> met(points.size(), 0);
          for (int k = 0; k < n_steps; ++k)
          {
            for (std::size_t n = 0; n < points.size(); ++n)
              points[n] -= side.everywhere.median / n_steps * normals[n];
            pair.data.obstacle->distance(points, distance);
            for (std::size_t n = 0; n < points.size(); ++n)
              met[n] |= same_direction[n] != 0 && distance[n] < 0.;
          }
          count[2] += double(std::count(met.begin(), met.end(), 1));
        });
    MPI::sum(count, communicator_, count);
    if (count[1] == 0.)
      return "";
    std::ostringstream text;
    text << "the outward normals of the surface and of the obstacle point the "
            "same way at "
         << count[1] << " of " << count[0] << " nodes";
    if (2. * count[2] <= count[0])
      return text.str() + ".";
    text << ", and within a facet behind " << count[2]
         << " of them, where the body is, there is the obstacle's material. "
            "Turn the obstacle (its Normal, the sign of a distance, Axis or "
            "Hollow), or take the side of the body that faces it; a thin "
            "obstacle may have passed through the surface.";
    refuse(pair, coded(ABUT_FAILURE_WRONG_SIDE, text.str()));
    return text.str();
  }

  template <int dim>
  ObstacleWidth
  SurfacePairRows<dim>::passed_between(const std::size_t number,
                                       const dealii::Point<dim> &place) const
  {
    const Pair &pair = pairs_[number];
    const dealii::Point<dim> then = place_before(number, place);
    const auto me = MPI::this_mpi_process(communicator_);
    const std::vector<Direction> u = made();
    const double *normals = nullptr;
    check(context_,
          abut_surface_normals(pair.secondary.surface.get(), &normals));
    // Distance of the nearest facet's middle; its size; whether that place was
    // before it or no farther behind than the obstacle is wide; that width.
    std::array<double, 4> nearest = {{INFINITY, 1., 0., INFINITY}};
    for (const std::int32_t f : pair.secondary.facet)
    {
      const auto &facet = surface_.facets[f];
      if (facet.owner != me)
        continue;
      dealii::Point<dim> middle;
      Direction normal;
      std::vector<dealii::Point<dim>> nodes;
      double size = 0.;
      for (unsigned int a = 0; a < surface_.nodes_per_facet(); ++a)
      {
        const Node node = facet.node[a];
        nodes.push_back(surface_.nodes[node].point + u[node]);
        size = std::max(size, nodes[a].distance(nodes[0]));
        const int n = pair.secondary.local_node(node);
        for (unsigned int d = 0; d < dim; ++d)
        {
          middle[d] += nodes[a][d] / surface_.nodes_per_facet();
          normal[d] += normals[n * dim + d];
        }
      }
      if (then.distance(middle) >= nearest[0])
        continue;
      normal /= normal.norm();
      const double height = normal * (then - middle);
      const bool is_over =
          (then - middle - height * normal).norm() <= 0.5 * size;
      const double width = pair.data.obstacle->width(normal_of(nodes.data()));
      nearest = {{then.distance(middle), size,
                  is_over && height > -width ? 1. : 0., width}};
    }
    for (const auto &other : MPI::all_gather(communicator_, nearest))
      if (other[0] < nearest[0])
        nearest = other;
    return nearest[2] > 0. ? ObstacleWidth{nearest[3], nearest[1]}
                           : ObstacleWidth();
  }

  std::string ObstacleWidth::text() const
  {
    std::ostringstream text;
    text.precision(3);
    text << "the obstacle is only " << width << " wide where facets of size "
         << facet
         << " are near it: single nodes know of it, or none, and its force is "
            "theirs. Refine the surface there, until several facets are "
            "under it.";
    return text.str();
  }

  template <int dim>
  dealii::Point<dim>
  SurfacePairRows<dim>::place_before(const std::size_t number,
                                     const dealii::Point<dim> &place) const
  {
    const RigidPose<dim> now = pairs_[number].data.obstacle->pose(),
                         then = poses_before(poses(), true)[number];
    const Direction own = transpose(now.rotation) * (place - now.translation);
    return dealii::Point<dim>(then.rotation * own + then.translation);
  }

  template <int dim>
  void SurfacePairRows<dim>::refuse_inside(Pair &pair,
                                           const la::Vector &displacement) const
  {
    if (!pair.data.geometric_gap)
      return;
    const double facet = pair.secondary.everywhere.median;
    const ObstacleInBodies<dim> found = find_obstacle_in_bodies(
        mapping_, dof_handler_, displacement, pair.data);
    if (!found.is_inside(facet) || found.is_met(facet))
      return;
    std::ostringstream depth;
    depth.precision(3);
    depth << found.elsewhere;
    // How far that place of the obstacle has come in this step.
    const auto number = static_cast<std::size_t>(&pair - pairs_.data());
    const double way = found.place.distance(place_before(number, found.place));
    const ObstacleWidth width = passed_between(number, found.place);
    if (pair.data.may_be_apart && way > 2. * pair.data.obstacle->depth())
      refuse(pair,
             too_long_a_step(pair.data, way,
                             "ends inside of it, past the surface of the pair, "
                             "by "
                                 + depth.str() + "."));
    else if (width.is_below_facets())
      refuse(pair, coded(ABUT_FAILURE_UNSEEN,
                         found.between_nodes(depth.str()) + width.text()));
    else
      refuse(pair, coded(ABUT_FAILURE_WRONG_SIDE, found.text(depth.str())));
  }

  template <int dim>
  void SurfacePairRows<dim>::look_inside(const la::Vector &start)
  {
    // A displacement to start with may have taken them apart.
    const double way = 2. * std::sqrt(double(dim)) * start.linfty_norm();
    for (Pair &pair : pairs_)
    {
      const ContactPair<dim> &data = pair.data;
      if (data.obstacle || !data.geometric_gap
          || !(pair.has_current_directions() || data.may_be_apart))
        continue;
      pair.first_inside =
          deepest_inside(mapping_, dof_handler_, data.secondary, data.primary);
      if (pair.first_inside.depth <= way)
        pair.first_inside.depth = 0.;
    }
  }

  template <int dim>
  void SurfacePairRows<dim>::refuse_overlap(const std::size_t number)
  {
    Pair &pair = pairs_[number];
    if (n_finds_ > 1 || pair.first_inside.depth == 0.)
      return;
    std::ostringstream place;
    place << pair.first_inside.place;
    const Message why = explain_no_rows(number);
    refuse(pair, why.failure == ABUT_FAILURE_OVERLAP
                     ? why
                     : coded(ABUT_FAILURE_OVERLAP,
                             "the bodies overlap: the node of a surface at ("
                                 + place.str()
                                 + ") lies inside of the other body, and no "
                                   "facet faces another one within reach. "
                                   "Move the bodies apart."));
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<std::uint8_t> SurfacePairRows<dim>::touching_nodes(     \
      const std::uint8_t *) const;                                             \
  template void SurfacePairRows<dim>::sample_facets(                           \
      std::size_t, const std::vector<Direction> &,                             \
      const std::vector<std::uint8_t> &, const std::vector<std::uint8_t> &,    \
      std::vector<FacetPenetration> &) const;                                  \
  template void SurfacePairRows<dim>::find_narrowest_width(                    \
      Pair &, const std::vector<Direction> &) const;                           \
  template std::vector<FacetPenetration>                                       \
  SurfacePairRows<dim>::facet_penetrations(const la::Vector &,                 \
                                           const std::uint8_t *);              \
  template void SurfacePairRows<dim>::examine(                                 \
      const la::Vector &, const double *, const double *,                      \
      const std::uint8_t *, const std::vector<FacetPenetration> &);            \
  template std::string SurfacePairRows<dim>::wrong_side(Pair &) const;         \
  template ObstacleWidth SurfacePairRows<dim>::passed_between(                 \
      std::size_t, const dealii::Point<dim> &) const;                          \
  template dealii::Point<dim> SurfacePairRows<dim>::place_before(              \
      std::size_t, const dealii::Point<dim> &) const;                          \
  template void SurfacePairRows<dim>::look_inside(const la::Vector &);         \
  template void SurfacePairRows<dim>::refuse_overlap(std::size_t);             \
  template void SurfacePairRows<dim>::refuse_inside(Pair &,                    \
                                                    const la::Vector &) const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

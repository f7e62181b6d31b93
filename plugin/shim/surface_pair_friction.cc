// SPDX-License-Identifier: LGPL-2.1-or-later
// Friction of pairs: coefficients, slips, and what a solve found.
#include "agree.h"
#include "surface_pair_rows.h"

#include <abut/friction_points.h>
#include <abut/strategy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    template <int dim>
    double value_of(const std::function<double(const dealii::Point<dim> &)> &f,
                    const dealii::Point<dim> &place, const char *const what,
                    const PairField field, Message &message)
    {
      const double value = f(place);
      if (value >= 0. && !std::isnan(value))
        return value;
      std::ostringstream text;
      text << "its " << what << " is " << value << " at " << place
           << ": it must not be negative.";
      message = text.str();
      message.field = field;
      return 0.;
    }

    /** Sum of factors by unknown. */
    using Motion = std::map<dealii::types::global_dof_index, double>;

    double product(const Motion &a, const Motion &b)
    {
      double sum = 0.;
      for (const auto &[unknown, factor] : a)
        if (const auto other = b.find(unknown); other != b.end())
          sum += factor * other->second;
      return sum;
    }

    /** The angle of rotation of a rigid body, radian, modulo whole rotations.
     */
    template <int dim>
    double angle_between(const RigidPose<dim> &then, const RigidPose<dim> &now)
    {
      const double t = trace(transpose(then.rotation) * now.rotation);
      return std::acos(
          std::clamp(dim == 2 ? 0.5 * t : 0.5 * (t - 1.), -1., 1.));
    }

    /** From here on the chord, which slips are measured by, is 1 % shorter than
     * the way along the surface, sin(a) / a. */
    constexpr double largest_rotation = 15.01 * M_PI / 180.;

    /** A node that can move along a tangent only this little (1: freely) takes
     * part in stick by springs, and below the second number not at all. */
    constexpr double least_freedom = 0.5, no_freedom = 1e-8;

    /** Where points belong, as the core wants it. */
    struct PointPlaces
    {
      template <int dim>
      PointPlaces(const std::vector<PointPlace<dim>> &places,
                  const std::size_t n_nodes, const std::size_t n_pairs)
      {
        for (const PointPlace<dim> &place : places)
        {
          node.push_back(place.node);
          pair.push_back(static_cast<std::int32_t>(place.pair));
        }
        view = {sizeof(view), static_cast<std::int32_t>(n_nodes),
                static_cast<std::int32_t>(n_pairs), node.data(), pair.data()};
      }

      std::vector<std::int32_t> node, pair;
      abut_point_places view = {};
    };
  } // namespace

  template <int dim>
  dealii::Tensor<1, dim>
  SurfacePairRows<dim>::rigid_displacement(const dealii::Point<dim> &place,
                                           const RigidPose<dim> &then,
                                           const RigidPose<dim> &now)
  {
    const dealii::Tensor<1, dim> x = place;
    const dealii::Tensor<1, dim> own =
        transpose(now.rotation) * (x - now.translation);
    return x - (then.rotation * own + then.translation);
  }

  template <int dim>
  std::vector<RigidPose<dim>> SurfacePairRows<dim>::poses() const
  {
    std::vector<RigidPose<dim>> result(pairs_.size());
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (pairs_[p].data.obstacle != nullptr)
        result[p] = pairs_[p].data.obstacle->pose();
    return result;
  }

  template <int dim>
  std::vector<RigidPose<dim>>
  SurfacePairRows<dim>::poses_before(std::vector<RigidPose<dim>> now,
                                     const bool of_step) const
  {
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if ((of_step || pairs_[p].has_committed_points())
          && p < committed_poses_.size())
        now[p] = committed_poses_[p];
      else if (pairs_[p].data.first_pose)
        now[p] = *pairs_[p].data.first_pose;
    return now;
  }

  template <int dim>
  typename SurfacePairRows<dim>::TangentSupport
  SurfacePairRows<dim>::support_of(const Component &row) const
  {
    const auto is_fixed = [&](const Node node)
    { return freedom(node, row.direction) < no_freedom; };
    const auto own = static_cast<Node>(row.place.node);
    if (own < 0)
    {
      bool moves = false;
      const auto look = [&](const Node node, double)
      { moves = moves || !is_fixed(node); };
      for_each_secondary(row.point, look);
      for_each_primary(row.point, look);
      return {moves ? ABUT_TANGENT_FREE : ABUT_TANGENT_PRESCRIBED, -1};
    }
    if (freedom(own, row.direction) >= least_freedom)
      return {};
    if (!is_fixed(own))
      return {ABUT_TANGENT_GUIDED, -1};
    if (pairs_[row.place.pair].data.obstacle != nullptr)
      return {ABUT_TANGENT_PRESCRIBED, -1};
    Node opposite = -1;
    double largest = 0.;
    for_each_primary(row.point,
                     [&](const Node node, const double c)
                     {
                       if (std::abs(c) <= largest || !is_fixed(node))
                         return;
                       largest = std::abs(c);
                       opposite = node;
                     });
    return {opposite < 0 ? ABUT_TANGENT_GUIDED : ABUT_TANGENT_PRESCRIBED,
            opposite};
  }

  template <int dim>
  std::vector<abut_tangent>
  SurfacePairRows<dim>::tangent_kinds(const std::size_t point) const
  {
    std::vector<abut_tangent> kinds;
    for (std::int32_t row = view_.component_start[point] + 1;
         row < view_.component_start[point + 1]; ++row)
      kinds.push_back(support_of(component(point, row)).kind);
    if (is_guided(point, kinds))
      std::replace(kinds.begin(), kinds.end(), ABUT_TANGENT_FREE,
                   ABUT_TANGENT_GUIDED);
    return kinds;
  }

  template <int dim>
  bool
  SurfacePairRows<dim>::is_guided(const std::size_t point,
                                  const std::vector<abut_tangent> &kinds) const
  {
    constexpr double small = 1e-8;
    const std::int32_t first = view_.component_start[point];
    std::vector<Motion> seen;
    for (std::int32_t row = first; row < view_.component_start[point + 1];
         ++row)
    {
      if (row > first && kinds[row - first - 1] != ABUT_TANGENT_FREE)
        continue;
      Motion motion;
      double whole = 0.;
      const auto add = [&](const Node node, const double c)
      {
        whole += c * c;
        for (unsigned int d = 0; d < dim; ++d)
          surface_.map.for_each_term(
              node, d,
              [&](const auto unknown, const double factor) {
                motion[unknown] +=
                    c * factor * view_.frame[row * std::size_t(dim) + d];
              });
      };
      for_each_secondary(point, add);
      for_each_primary(point, add);
      if (product(motion, motion) <= small * whole)
        continue;
      for (const Motion &other : seen)
      {
        const double part = product(motion, other) / product(other, other);
        for (const auto &[unknown, factor] : other)
          motion[unknown] -= part * factor;
      }
      if (product(motion, motion) <= small * whole)
        return true;
      seen.push_back(std::move(motion));
    }
    return false;
  }

  template <int dim>
  RowSource::FrictionalPoints SurfacePairRows<dim>::friction() const
  {
    FrictionalPoints result;
    for (const Pair &pair : pairs_)
      result.any = result.any || pair.data.friction != nullptr;
    Message message;
    for (std::size_t i = 0; i < places_.size() && result.any; ++i)
    {
      const std::int32_t first = view_.component_start[i];
      const std::int32_t n = view_.component_start[i + 1] - first;
      const Pair &pair = pairs_[places_[i].pair];
      if (view_.kind[i] == ABUT_POINT_TIE || n == 1)
        continue;
      const Friction<dim> &friction = *pair.data.friction;
      Message wrong;
      dealii::Point<dim> place = places_[i].position;
      if (pair.has_current_points()) // back in the reference configuration
        for_each_secondary(i, [&](const Node node, const double c)
                           { place -= c * made_at(node); });
      result.first.push_back(first);
      result.n_tangents.push_back(static_cast<std::uint8_t>(n - 1));
      const double coefficient =
          value_of<dim>(friction.coefficient, place, "coefficient of friction",
                        PairField::friction, wrong);
      result.coefficient.push_back(coefficient);
      for (const abut_tangent kind : tangent_kinds(i))
        result.tangent.push_back(static_cast<std::uint8_t>(kind));
      result.cap.push_back(
          friction.cap ? value_of<dim>(friction.cap, place, "largest traction",
                                       PairField::largest_friction, wrong)
                       : std::numeric_limits<double>::infinity());
      if (!wrong.empty())
        message = about_pair(pair.data.name, wrong);
    }
    throw_everywhere<ContactError>(communicator_, message);
    if (!result.any)
      return result;
    const PointPlaces places(places_, surface_.nodes.size(), pairs_.size());
    const auto n = static_cast<std::int32_t>(result.first.size());
    std::int32_t n_rivals = 0;
    check(context_,
          abut_points_rivals(points_, &places.view, n, result.first.data(),
                             &n_rivals, nullptr, nullptr));
    result.rival_point.resize(n_rivals);
    result.rival_row.resize(n_rivals);
    check(context_,
          abut_points_rivals(points_, &places.view, n, result.first.data(),
                             &n_rivals, result.rival_point.data(),
                             result.rival_row.data()));
    return result;
  }

  template <int dim>
  void SurfacePairRows<dim>::drop_covered(std::vector<std::uint8_t> &keep) const
  {
    // Springs share the load.
    if (abut_law_has_penalty(settings_.method.options.law))
      return;
    std::vector<std::uint8_t> marks;
    for (const Pair &pair : pairs_)
      marks.push_back(
          (pair.data.obstacle != nullptr && !pair.has_current_points()
               ? ABUT_PAIR_FIXED_POINTS
               : 0)
          | (pair.data.friction != nullptr ? ABUT_PAIR_FRICTION : 0));
    const PointPlaces places(places_, surface_.nodes.size(), pairs_.size());
    check(context_,
          abut_points_cover(points_, &places.view, marks.data(), keep.data()));
  }

  template <int dim>
  void SurfacePairRows<dim>::refuse_large_rotations(
      const std::vector<RigidPose<dim>> &then,
      const std::vector<RigidPose<dim>> &now) const
  {
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      const double angle = angle_between(then[p], now[p]);
      if (pairs_[p].data.friction == nullptr
          || pairs_[p].data.obstacle == nullptr || angle <= largest_rotation)
        continue;
      std::ostringstream text;
      text.precision(3);
      text << "its obstacle turns by " << angle * 180. / M_PI
           << " degrees within a load step, and friction takes the chord for "
              "the way along the surface: use load steps of at most 15 degrees "
              "(Load steps/Steps).";
      throw ContactError(
          about_pair(pairs_[p].data.name, text.str(), PairField::obstacle));
    }
  }

  template <int dim>
  double
  SurfacePairRows<dim>::reference_of_slip(const Component &row,
                                          const std::vector<Direction> &u) const
  {
    // Slips of points that stand elsewhere are 0 there.
    const bool elsewhere = pairs_[row.place.pair].is_displaced();
    double sum = 0.;
    const auto add = [&](const Node node, const double c)
    {
      const Direction from = elsewhere ? made_at(node) : Direction();
      sum -= c * ((u[node] - from) * row.direction);
    };
    for_each_secondary(row.point, add);
    for_each_primary(row.point, add);
    return sum;
  }

  template <int dim>
  double
  SurfacePairRows<dim>::prescribed_slip(const Component &row,
                                        const Node opposite,
                                        const std::vector<Direction> &u) const
  {
    const auto way = [&](const Node node)
    {
      Direction now;
      for (unsigned int d = 0; d < dim; ++d)
        now[d] = surface_.map.constant(node, d);
      return (now - u[node]) * row.direction;
    };
    return (opposite < 0 ? 0. : way(opposite))
           - way(static_cast<Node>(row.place.node));
  }

  template <int dim>
  RowSource::SlipReference
  SurfacePairRows<dim>::slip_reference(const la::Vector &committed)
  {
    std::vector<Direction> u(surface_.nodes.size());
    if (committed.size() > 0)
      u = exchange_->displacements_as_given(surface_, committed);
    const std::vector<RigidPose<dim>> now = poses(),
                                      then = poses_before(now, true);
    refuse_large_rotations(then, now);
    find_partners(u);
    SlipReference result = {std::vector<double>(view_.n_components, 0.),
                            std::vector<std::uint8_t>(view_.n_components, 0)};
    std::vector<std::vector<Direction>> approach(pairs_.size());
    for (std::size_t p = 0; p < approach_.size(); ++p)
      if (approach_[p].size() > 0)
        approach[p] = exchange_->displacements_as_given(surface_, approach_[p]);
    for_each_row(
        [&](const Component &row)
        {
          if (!is_tangent(row))
            return;
          const std::size_t p = row.place.pair;
          const Partners *const partners = partners_of(row);
          const TangentSupport support = support_of(row);
          const bool is_prescribed =
              row.place.node >= 0 && support.kind == ABUT_TANGENT_PRESCRIBED;
          result.is_prescribed[row.row] = is_prescribed;
          result.value[row.row] =
              is_prescribed         ? -prescribed_slip(row, support.opposite, u)
              : partners != nullptr ? reference_of_slip(row, *partners)
                                    : reference_of_slip(row, u);
          const auto add = [&](const Node node, const double c)
          { result.value[row.row] -= c * (approach[p][node] * row.direction); };
          if (!approach[p].empty() && !is_prescribed)
          {
            for_each_secondary(row.point, add);
            for_each_primary(row.point, add);
          }
          if (pairs_[p].data.obstacle != nullptr)
            result.value[row.row] -=
                rigid_displacement(row.place.position, then[p], now[p])
                * row.direction;
        });
    return result;
  }

  template <int dim>
  void SurfacePairRows<dim>::copy_to_tangents(std::vector<double> &value) const
  {
    for (std::int32_t i = 0; i < view_.n_points; ++i)
      for (std::int32_t row = view_.component_start[i] + 1;
           row < view_.component_start[i + 1]
           && view_.kind[i] == ABUT_POINT_CONTACT;
           ++row)
        value[row] = value[view_.component_start[i]];
  }

  template <int dim>
  void SurfacePairRows<dim>::find_prescribed_nodes(
      const std::uint8_t *const row_state,
      std::vector<PairResult<dim>> &results) const
  {
    const std::size_t n_nodes = surface_.nodes.size();
    std::vector<std::uint8_t> prescribed(n_nodes * pairs_.size(), 0),
        closed(prescribed), found(prescribed);
    bool any = false;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      for (std::size_t n = 0; n < pairs_[p].dropped.size(); ++n)
        if (pairs_[p].dropped[n] == of_supports
            && pairs_[p].data.friction != nullptr)
        {
          prescribed[p * n_nodes + pairs_[p].secondary.node[n]] = 1;
          any = true;
        }
    if (!MPI::logical_or(any, communicator_))
      return;
    for_each_component(
        [&](const Component &row)
        {
          if (row.place.node >= 0 && row_state != nullptr
              && row_state[row.row] != ABUT_STATE_OPEN)
            closed[row.place.pair * n_nodes + row.place.node] = 1;
        });
    exchange_->merge_marks(surface_, closed);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      for (const std::int32_t f : pairs_[p].secondary.facet)
      {
        const auto &node = surface_.facets[f].node;
        const std::size_t first = p * n_nodes;
        bool touches = false;
        for (unsigned int a = 0; a < surface_.nodes_per_facet(); ++a)
          touches = touches || closed[first + node[a]] != 0;
        for (unsigned int a = 0; a < surface_.nodes_per_facet() && touches; ++a)
          if (prescribed[first + node[a]] != 0 && is_owned(node[a]))
            found[first + node[a]] = 1;
      }
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      const std::size_t first = p * n_nodes;
      results[p].n_prescribed =
          std::count(found.begin() + first, found.begin() + first + n_nodes, 1);
      if (results[p].n_prescribed == 0)
        continue;
      const auto &side = pairs_[p].secondary;
      const double *normal = nullptr;
      check(context_, abut_surface_normals(side.surface.get(), &normal));
      for (std::size_t n = 0; n < side.node.size(); ++n)
        if (found[first + side.node[n]] != 0)
          for (unsigned int d = 0; d < dim; ++d)
            results[p].prescribed_normal.emplace_back(
                surface_.nodes[side.node[n]].dof[d], normal[n * dim + d]);
    }
  }

  template <int dim>
  void SurfacePairRows<dim>::add_friction(
      const double *row_pressure, const double *row_gap,
      const std::uint8_t *row_state,
      std::vector<PairResult<dim>> &results) const
  {
    const PointPlaces places(places_, surface_.nodes.size(), pairs_.size());
    std::vector<abut_friction_sums> sums(pairs_.size());
    check(context_, abut_points_friction(points_, &places.view, row_pressure,
                                         row_gap, row_state, sums.data()));
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      PairResult<dim> &result = results[p];
      result.normal_force = sums[p].normal_force;
      result.friction_force = sums[p].friction_force;
      result.traction = sums[p].traction;
      result.dissipation = sums[p].dissipation;
      result.shared_stick_force = sums[p].shared_stick_force;
      result.n_slipping = sums[p].n_slipping;
      for (unsigned int d = 0; d < dim; ++d)
        result.secondary_friction[d] = sums[p].force[d];
    }
    find_prescribed_nodes(row_state, results);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template RowSource::FrictionalPoints SurfacePairRows<dim>::friction() const; \
  template double SurfacePairRows<dim>::reference_of_slip(                     \
      const Component &, const std::vector<Direction> &) const;                \
  template RowSource::SlipReference SurfacePairRows<dim>::slip_reference(      \
      const la::Vector &);                                                     \
  template dealii::Tensor<1, dim> SurfacePairRows<dim>::rigid_displacement(    \
      const dealii::Point<dim> &, const RigidPose<dim> &,                      \
      const RigidPose<dim> &);                                                 \
  template std::vector<RigidPose<dim>> SurfacePairRows<dim>::poses() const;    \
  template std::vector<RigidPose<dim>> SurfacePairRows<dim>::poses_before(     \
      std::vector<RigidPose<dim>>, bool) const;                                \
  template void SurfacePairRows<dim>::drop_covered(                            \
      std::vector<std::uint8_t> &) const;                                      \
  template void SurfacePairRows<dim>::refuse_large_rotations(                  \
      const std::vector<RigidPose<dim>> &,                                     \
      const std::vector<RigidPose<dim>> &) const;                              \
  template void SurfacePairRows<dim>::copy_to_tangents(std::vector<double> &)  \
      const;                                                                   \
  template void SurfacePairRows<dim>::find_prescribed_nodes(                   \
      const std::uint8_t *, std::vector<PairResult<dim>> &) const;             \
  template void SurfacePairRows<dim>::add_friction(                            \
      const double *, const double *, const std::uint8_t *,                    \
      std::vector<PairResult<dim>> &) const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

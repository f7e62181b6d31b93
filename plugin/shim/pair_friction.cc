// SPDX-License-Identifier: LGPL-2.1-or-later
// Friction of pairs: coefficients, and what a solve found.
#include "pair_friction.h"

#include "agree.h"
#include "examination_limits.h"
#include "short_text.h"

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

    /** A node that can move along a tangent only this little (1: freely) takes
     * part in stick by springs, and below the second number not at all. */
    constexpr double least_tangent_freedom = 0.5, no_freedom = 1e-8;

    /** Whether what supports leave free at a point moves it along a tangent of
     * @p kinds free only as it moves along the normal or the other tangent. */
    template <int dim>
    bool is_guided(const PairPoints<dim> &points, const std::size_t point,
                   const std::vector<abut_tangent> &kinds)
    {
      constexpr double small = 1e-8;
      const std::int32_t first = points.view().component_start[point];
      std::vector<Motion> seen;
      for (std::int32_t row = first;
           row < points.view().component_start[point + 1]; ++row)
      {
        if (row > first && kinds[row - first - 1] != ABUT_TANGENT_FREE)
          continue;
        Motion motion;
        double whole = 0.;
        const auto add = [&](const NodeIndex node, const double c)
        {
          whole += c * c;
          for (unsigned int d = 0; d < dim; ++d)
            points.surface().map.for_each_term(
                node, d,
                [&](const auto unknown, const double factor)
                {
                  motion[unknown] +=
                      c * factor
                      * points.view().frame[row * std::size_t(dim) + d];
                });
        };
        points.for_each_node(point, add);
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

    /** Freedom that supports leave along the tangents of a point. */
    template <int dim>
    std::vector<abut_tangent> tangent_kinds(const PairPoints<dim> &points,
                                            const std::size_t point)
    {
      std::vector<abut_tangent> kinds;
      for (std::int32_t row = points.view().component_start[point] + 1;
           row < points.view().component_start[point + 1]; ++row)
        kinds.push_back(support_of(points, points.component(point, row)).kind);
      if (is_guided(points, point, kinds))
        std::replace(kinds.begin(), kinds.end(), ABUT_TANGENT_FREE,
                     ABUT_TANGENT_GUIDED);
      return kinds;
    }

    /** PairResult::n_prescribed and prescribed_normal. Collective. */
    template <int dim>
    void find_prescribed_nodes(const PairPoints<dim> &points,
                               const std::uint8_t *const row_state,
                               std::vector<PairResult<dim>> &results)
    {
      const std::size_t n_nodes = points.surface().nodes.size();
      std::vector<std::uint8_t> prescribed(n_nodes * points.pairs().size(), 0),
          closed(prescribed), found(prescribed);
      bool any = false;
      for (std::size_t p = 0; p < points.pairs().size(); ++p)
        for (std::size_t n = 0; n < points.dropped(p).size(); ++n)
          if (points.dropped(p)[n] == of_supports
              && points.pairs()[p].data.friction != nullptr)
          {
            prescribed[p * n_nodes + points.pairs()[p].secondary.node[n]] = 1;
            any = true;
          }
      if (!MPI::logical_or(any, points.host().communicator))
        return;
      points.for_each_component(
          [&](const PointRow<dim> &row)
          {
            if (row.place.node >= 0 && row_state != nullptr
                && row_state[row.row] != ABUT_STATE_OPEN)
              closed[row.place.pair * n_nodes + row.place.node] = 1;
          });
      points.exchange().merge_marks(points.surface(), closed);
      for (std::size_t p = 0; p < points.pairs().size(); ++p)
        for (const std::int32_t f : points.pairs()[p].secondary.facet)
        {
          const auto &facet = points.surface().facets[f];
          const auto &node = facet.node;
          const std::size_t first = p * n_nodes;
          bool touches = false;
          for (unsigned int a = 0; a < facet.n_nodes(); ++a)
            touches = touches || closed[first + node[a]] != 0;
          for (unsigned int a = 0; a < facet.n_nodes() && touches; ++a)
            if (prescribed[first + node[a]] != 0
                && points.set().is_owned(node[a]))
              found[first + node[a]] = 1;
        }
      for (std::size_t p = 0; p < points.pairs().size(); ++p)
      {
        const std::size_t first = p * n_nodes;
        results[p].n_prescribed = std::count(
            found.begin() + first, found.begin() + first + n_nodes, 1);
        if (results[p].n_prescribed == 0)
          continue;
        const auto &side = points.pairs()[p].secondary;
        const double *normal = nullptr;
        check(points.host().context,
              abut_surface_normals(side.surface.get(), &normal));
        for (std::size_t n = 0; n < side.node.size(); ++n)
          if (found[first + side.node[n]] != 0)
            for (unsigned int d = 0; d < dim; ++d)
              results[p].prescribed_normal.emplace_back(
                  points.surface().nodes[side.node[n]].dof[d],
                  normal[n * dim + d]);
      }
    }
  } // namespace

  template <int dim>
  TangentSupport support_of(const PairPoints<dim> &points,
                            const PointRow<dim> &row)
  {
    const auto is_fixed = [&](const NodeIndex node)
    { return points.set().freedom(node, row.direction) < no_freedom; };
    const auto own = static_cast<NodeIndex>(row.place.node);
    if (own < 0)
    {
      bool moves = false;
      const auto look = [&](const NodeIndex node, double)
      { moves = moves || !is_fixed(node); };
      points.for_each_node(row.point, look);
      return {moves ? ABUT_TANGENT_FREE : ABUT_TANGENT_PRESCRIBED, -1};
    }
    if (points.set().freedom(own, row.direction) >= least_tangent_freedom)
      return {};
    if (!is_fixed(own))
      return {ABUT_TANGENT_GUIDED, -1};
    if (points.pairs()[row.place.pair].data.obstacle != nullptr)
      return {ABUT_TANGENT_PRESCRIBED, -1};
    NodeIndex opposite = -1;
    double largest = 0.;
    points.for_each_primary(row.point,
                            [&](const NodeIndex node, const double c)
                            {
                              if (std::abs(c) <= largest || !is_fixed(node))
                                return;
                              largest = std::abs(c);
                              opposite = node;
                            });
    return {opposite < 0 ? ABUT_TANGENT_GUIDED : ABUT_TANGENT_PRESCRIBED,
            opposite};
  }

  namespace
  {
    /** Add the points with friction of this rank; throws ContactError for
     * values that cannot be, and what functions of the host throw. */
    template <int dim>
    void add_frictional_points(const PairPoints<dim> &points,
                               RowSource::FrictionalPoints &result)
    {
      Message message;
      for (std::int32_t i = 0; i < points.view().n_points; ++i)
      {
        const std::int32_t first = points.view().component_start[i];
        const std::int32_t n = points.view().component_start[i + 1] - first;
        const SurfacePair<dim> &pair = points.pairs()[points.places().pair[i]];
        if (points.view().kind[i] == ABUT_POINT_TIE || n == 1)
          continue;
        const Friction<dim> &friction = *pair.data.friction;
        Message wrong;
        dealii::Point<dim> place = points.place(i).position;
        if (pair.has_current_points()) // back in the reference configuration
          points.for_each_secondary(i, [&](const NodeIndex node, const double c)
                                    { place -= c * points.made_at(node); });
        result.first.push_back(first);
        result.n_tangents.push_back(static_cast<std::uint8_t>(n - 1));
        const double coefficient = value_of<dim>(friction.coefficient, place,
                                                 "coefficient of friction",
                                                 PairField::friction, wrong);
        result.coefficient.push_back(coefficient);
        for (const abut_tangent kind : tangent_kinds(points, i))
          result.tangent.push_back(static_cast<std::uint8_t>(kind));
        result.cap.push_back(
            friction.cap
                ? value_of<dim>(friction.cap, place, "largest traction",
                                PairField::largest_friction, wrong)
                : std::numeric_limits<double>::infinity());
        if (!wrong.empty())
          message = about_pair(pair.data.name, wrong);
      }
      if (!message.empty())
        throw ContactError(message);
    }
  } // namespace

  template <int dim>
  RowSource::FrictionalPoints friction_of(const PairPoints<dim> &points)
  {
    RowSource::FrictionalPoints result;
    for (const SurfacePair<dim> &pair : points.pairs())
      result.any = result.any || pair.data.friction != nullptr;
    if (!result.any)
      return result;
    run_everywhere<ContactError>(points.host().communicator, [&]
                                 { add_frictional_points(points, result); });
    const auto n = static_cast<std::int32_t>(result.first.size());
    std::int32_t n_rivals = 0;
    for (int pass = 0; pass < 2; ++pass)
    {
      check(points.host().context,
            abut_points_rivals(points.handle(), n, result.first.data(),
                               &n_rivals,
                               pass == 0 ? nullptr : result.rival_point.data(),
                               pass == 0 ? nullptr : result.rival_row.data()));
      result.rival_point.resize(n_rivals);
      result.rival_row.resize(n_rivals);
    }
    return result;
  }

  template <int dim>
  void drop_covered(const PairPoints<dim> &points,
                    std::vector<std::uint8_t> &keep)
  {
    // Springs share the load.
    if (abut_law_has_penalty(points.host().method.options.law))
      return;
    std::vector<std::uint8_t> marks;
    for (const SurfacePair<dim> &pair : points.pairs())
      marks.push_back(
          (pair.data.obstacle != nullptr && !pair.has_current_points()
               ? ABUT_PAIR_FIXED_POINTS
               : 0)
          | (pair.data.friction != nullptr ? ABUT_PAIR_FRICTION : 0));
    check(points.host().context,
          abut_points_cover(points.handle(),
                            static_cast<std::int32_t>(marks.size()),
                            marks.data(), keep.data()));
  }

  Message late_contact(const std::string &pair, const double late,
                       const double normal)
  {
    if (!(late > visible_late_share * normal))
      return {};
    const double share = late / normal;
    return coded(
        ABUT_FAILURE_LATE_CONTACT,
        pair + ": " + percent(share) + " of the normal force (limit "
            + percent(visible_late_share)
            + ") is at points that slip and have closed within a load step. "
              "They have the slip of the whole step, also from before they "
              "closed, so that the zone of stick and the tractions depend on "
              "the number of steps. Use more load steps while the contact "
              "grows (Time stepping/Number of steps).",
        {{"late share", share}, {"limit", visible_late_share}});
  }

  template <int dim>
  void add_friction(const PairPoints<dim> &points, const double *row_pressure,
                    const double *row_gap, const std::uint8_t *row_state,
                    std::vector<PairResult<dim>> &results)
  {
    std::vector<abut_friction_sums> sums(points.pairs().size());
    check(points.host().context,
          abut_points_friction(points.handle(),
                               static_cast<std::int32_t>(sums.size()),
                               row_pressure, row_gap, row_state, sums.data()));
    for (std::size_t p = 0; p < points.pairs().size(); ++p)
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
    find_prescribed_nodes(points, row_state, results);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template TangentSupport support_of(const PairPoints<dim> &,                  \
                                     const PointRow<dim> &);                   \
  template RowSource::FrictionalPoints friction_of(const PairPoints<dim> &);   \
  template void drop_covered(const PairPoints<dim> &,                          \
                             std::vector<std::uint8_t> &);                     \
  template void add_friction(const PairPoints<dim> &, const double *,          \
                             const double *, const std::uint8_t *,             \
                             std::vector<PairResult<dim>> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

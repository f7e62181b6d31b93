// SPDX-License-Identifier: LGPL-2.1-or-later
// Points that are made where the bodies were at the last commit(), and how far
// they go from there until the next one.
#include "agree.h"
#include "surface_pair_rows.h"

#include <abut/dealii/rigid_obstacle.h>
#include <abut/strategy.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Surfaces that have moved against each other by no more than this part of
     * their smallest facet keep their points: gaps of flat surfaces are right
     * all the same, the error for curved ones is the square of it. */
    constexpr double skin = 1e-2;

    /** The angle between two directions of any length, radian. */
    template <int dim>
    double angle(const dealii::Tensor<1, dim> &a,
                 const dealii::Tensor<1, dim> &b)
    {
      const double size = a.norm() * b.norm();
      return size > 0. ? std::acos(std::clamp(a * b / size, -1., 1.)) : 0.;
    }
  } // namespace

  template <int dim> bool SurfacePairRows<dim>::has_steps() const
  {
    return std::any_of(pairs_.begin(), pairs_.end(),
                       [](const Pair &pair)
                       { return pair.has_committed_points(); });
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> SurfacePairRows<dim>::place_of_step()
  {
    return has_steps()
               ? exchange_->displacements_as_given(surface_, last_commit())
               : std::vector<Direction>(surface_.nodes.size());
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  SurfacePairRows<dim>::difference(std::vector<Direction> u,
                                   const std::vector<Direction> &from)
  {
    for (std::size_t n = 0; n < u.size(); ++n)
      u[n] -= from[n];
    return u;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> SurfacePairRows<dim>::displacement_since(
      const std::vector<Direction> &u) const
  {
    std::vector<Direction> result(u);
    for (std::size_t n = 0; n < u.size() && !present_.empty(); ++n)
      result[n] -= made_at(static_cast<Node>(n));
    return result;
  }

  template <int dim>
  bool
  SurfacePairRows<dim>::is_where_made(const std::vector<Direction> &place) const
  {
    if (!has_steps())
      return true;
    const std::vector<Direction> way = displacement_since(place);
    return std::all_of(pairs_.begin(), pairs_.end(),
                       [&](const Pair &pair)
                       {
                         const double facet =
                             std::min(pair.secondary.everywhere.smallest,
                                      pair.primary.everywhere.smallest);
                         return !pair.has_committed_points()
                                || motion(pair, way) <= skin * facet;
                       });
  }

  template <int dim>
  dealii::Tensor<1, dim> SurfacePairRows<dim>::relative_displacement(
      const Component &row, const std::vector<Direction> &u) const
  {
    const Pair &pair = pairs_[row.place.pair];
    // A turn of both sides is no slip: by places, which have been opposite each
    // other.
    if (pair.keeps_partners())
      return apart(row.point, u);
    Direction way;
    const auto add = [&](const Node node, const double c)
    {
      way += c
             * (u[node]
                - (pair.has_committed_points() ? made_at(node) : Direction()));
    };
    for_each_secondary(row.point, add);
    for_each_primary(row.point, add);
    return way;
  }

  template <int dim>
  std::vector<StepMotion>
  SurfacePairRows<dim>::step_motion(const la::Vector &displacement,
                                    const std::uint8_t *row_state)
  {
    std::vector<StepMotion> result(pairs_.size());
    const auto stays = [](const Pair &pair)
    {
      return !pair.has_current_points() && !pair.has_committed_points()
             && !pair.data.tied && !pair.data.obstacle;
    };
    if (!has_steps() && std::none_of(pairs_.begin(), pairs_.end(), stays))
      return result;
    const std::vector<Direction> u = displacements_in_reach(displacement);
    std::vector<dealii::Point<dim>> now;
    for (std::size_t n = 0; n < present_.size(); ++n)
      now.push_back(present_[n] + (u[n] - made_at(static_cast<Node>(n))));
    std::vector<std::vector<std::uint8_t>> marked(
        pairs_.size(), std::vector<std::uint8_t>(surface_.nodes.size(), 0));
    std::vector<std::vector<dealii::Point<dim>>> places(pairs_.size());
    for_each_component(
        [&](const Component &row)
        {
          const std::size_t p = row.place.pair;
          if ((!pairs_[p].has_committed_points() && !stays(pairs_[p]))
              || row_state[row.row] == ABUT_STATE_OPEN)
            return;
          const Direction motion = relative_displacement(row, u);
          const Direction n = row.direction / row.direction.norm();
          result[p].slip =
              std::max(result[p].slip, (motion - (motion * n) * n).norm());
          if (!pairs_[p].has_committed_points())
            return;
          const auto mark = [&](const Node node, double)
          { marked[p][node] = 1; };
          for_each_secondary(row.point, mark);
          for_each_primary(row.point, mark);
          places[p].push_back(row.place.position);
          places[p].push_back(row.place.position + motion);
        });
    run_everywhere<ContactError>(
        communicator_,
        [&]
        {
          for (std::size_t p = 0; p < pairs_.size(); ++p)
          {
            const Pair &pair = pairs_[p];
            StepMotion &motion = result[p];
            motion.stays = stays(pair);
            if (!pair.data.obstacle)
            {
              motion.facet = std::min(pair.secondary.everywhere.median,
                                      pair.primary.everywhere.median);
              for (const auto *side : {&pair.secondary, &pair.primary})
              {
                std::vector<std::uint8_t> marks;
                for (const Node node : side->node)
                  marks.push_back(marked[p][node]);
                double rotation = 0.;
                if (pair.has_committed_points())
                  check(context_,
                        abut_surface_rotation(
                            side->surface.get(), marks.data(),
                            places_of(side->node, present_).data(),
                            places_of(side->node, now).data(), &rotation));
                motion.rotation = std::max(motion.rotation, rotation);
              }
              continue;
            }
            if (places[p].empty())
              continue;
            std::vector<double> distance;
            std::vector<Direction> normal;
            pair.data.obstacle->distance(places[p], distance, &normal);
            for (std::size_t i = 0; i < normal.size(); i += 2)
              motion.rotation = std::max(motion.rotation,
                                         angle<dim>(normal[i], normal[i + 1]));
          }
        });
    for (StepMotion &motion : result)
      for (double *value : {&motion.slip, &motion.rotation})
        *value = MPI::max(*value, communicator_);
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template bool SurfacePairRows<dim>::has_steps() const;                       \
  template std::vector<dealii::Tensor<1, dim>>                                 \
  SurfacePairRows<dim>::place_of_step();                                       \
  template std::vector<dealii::Tensor<1, dim>>                                 \
  SurfacePairRows<dim>::difference(std::vector<Direction>,                     \
                                   const std::vector<Direction> &);            \
  template std::vector<dealii::Tensor<1, dim>>                                 \
  SurfacePairRows<dim>::displacement_since(const std::vector<Direction> &)     \
      const;                                                                   \
  template bool SurfacePairRows<dim>::is_where_made(                           \
      const std::vector<Direction> &) const;                                   \
  template dealii::Tensor<1, dim> SurfacePairRows<dim>::relative_displacement( \
      const Component &, const std::vector<Direction> &) const;                \
  template std::vector<StepMotion> SurfacePairRows<dim>::step_motion(          \
      const la::Vector &, const std::uint8_t *);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
// How far points that are made where the bodies were at the last commit() go
// from there until the next one.
#include "pair_examination.h"

#include "agree.h"

#include <abut/strategy.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** The angle between two directions of any length, radian. */
    template <int dim>
    double angle(const dealii::Tensor<1, dim> &a,
                 const dealii::Tensor<1, dim> &b)
    {
      const double size = a.norm() * b.norm();
      return size > 0. ? std::acos(std::clamp(a * b / size, -1., 1.)) : 0.;
    }
  } // namespace

  template <int dim>
  std::vector<StepMotion> step_motion(PairPoints<dim> &points,
                                      const la::Vector &displacement,
                                      const std::uint8_t *row_state)
  {
    std::vector<StepMotion> result(points.pairs().size());
    const auto stays = [](const SurfacePair<dim> &pair)
    {
      return !pair.has_current_points() && !pair.has_committed_points()
             && !pair.data.tied && !pair.data.obstacle;
    };
    if (!points.set().has_steps()
        && std::none_of(points.pairs().begin(), points.pairs().end(), stays))
      return result;
    const std::vector<Direction<dim>> u =
        points.displacements_in_reach(displacement);
    std::vector<dealii::Point<dim>> now;
    for (std::size_t n = 0; n < points.present().size(); ++n)
      now.push_back(points.present()[n]
                    + (u[n] - points.made_at(static_cast<NodeIndex>(n))));
    std::vector<std::vector<std::uint8_t>> marked(
        points.pairs().size(),
        std::vector<std::uint8_t>(points.surface().nodes.size(), 0));
    std::vector<std::vector<dealii::Point<dim>>> places(points.pairs().size());
    const NodePositions<dim> nodes(points, u);
    std::vector<Direction<dim>> motions(points.view().n_points);
    check(points.host().context,
          abut_points_motion(points.handle(), &nodes.view, data_of(motions),
                             nullptr));
    points.for_each_component(
        [&](const PointRow<dim> &row)
        {
          const std::size_t p = row.place.pair;
          if ((!points.pairs()[p].has_committed_points()
               && !stays(points.pairs()[p]))
              || row_state[row.row] == ABUT_STATE_OPEN)
            return;
          const Direction<dim> &motion = motions[row.point];
          const Direction<dim> n = row.direction / row.direction.norm();
          result[p].slip =
              std::max(result[p].slip, (motion - (motion * n) * n).norm());
          if (!points.pairs()[p].has_committed_points())
            return;
          const auto mark = [&](const NodeIndex node, double)
          { marked[p][node] = 1; };
          points.for_each_node(row.point, mark);
          places[p].push_back(row.place.position);
          places[p].push_back(row.place.position + motion);
        });
    run_everywhere<ContactError>(
        points.host().communicator,
        [&]
        {
          for (std::size_t p = 0; p < points.pairs().size(); ++p)
          {
            const SurfacePair<dim> &pair = points.pairs()[p];
            StepMotion &motion = result[p];
            motion.stays = stays(pair);
            if (!pair.data.obstacle)
            {
              motion.facet = std::min(pair.secondary.everywhere.median,
                                      pair.primary.everywhere.median);
              for (const auto *side : {&pair.secondary, &pair.primary})
              {
                std::vector<std::uint8_t> marks;
                for (const NodeIndex node : side->node)
                  marks.push_back(marked[p][node]);
                double rotation = 0.;
                if (pair.has_committed_points())
                  check(points.host().context,
                        abut_surface_rotation(
                            side->surface.get(), marks.data(),
                            places_of(side->node, points.present()).data(),
                            places_of(side->node, now).data(), &rotation));
                motion.rotation = std::max(motion.rotation, rotation);
              }
              continue;
            }
            if (places[p].empty())
              continue;
            std::vector<double> distance;
            std::vector<Direction<dim>> normal;
            pair.data.obstacle->distance(places[p], distance, &normal);
            for (std::size_t i = 0; i < normal.size(); i += 2)
              motion.rotation = std::max(motion.rotation,
                                         angle<dim>(normal[i], normal[i + 1]));
          }
        });
    for (StepMotion &motion : result)
      for (double *value : {&motion.slip, &motion.rotation})
        *value = MPI::max(*value, points.host().communicator);
    return result;
  }

  template std::vector<StepMotion>
  step_motion(PairPoints<2> &, const la::Vector &, const std::uint8_t *);
  template std::vector<StepMotion>
  step_motion(PairPoints<3> &, const la::Vector &, const std::uint8_t *);
} // namespace abut::shim

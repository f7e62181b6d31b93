// SPDX-License-Identifier: LGPL-2.1-or-later
// How well rows hand a uniform pressure to the primary surface: the error that
// the contact patch test measures, without solving anything.
#include "pair_examination.h"
#include "pair_interface.h"
#include "surface_fields.h"

#include <cmath>

namespace abut::shim
{
  template <int dim>
  std::vector<double> transfer_errors(const PairPoints<dim> &points,
                                      const la::Vector &displacement)
  {
    const std::vector<Direction<dim>> u =
        points.set().displacements(displacement);
    std::vector<double> errors(points.pairs().size(), 0.);
    for (std::size_t p = 0; p < points.pairs().size(); ++p)
    {
      SurfacePair<dim> &pair = points.pairs()[p];
      if (pair.data.obstacle)
        continue;
      // The first unknown of a node stands for it.
      const auto unknown = [&](const NodeIndex node)
      { return points.surface().nodes[node].dof[0]; };
      la::Vector exact = SurfaceFields<dim>(points).field();
      // As the rows are weighed, and where there are any.
      const Handle<abut_interface> mortar =
          make_interface(points.host(), pair, p, ABUT_DISCRETISATION_MORTAR,
                         !pair.has_current_points() ? ABUT_KINEMATICS_REFERENCE
                         : pair.has_mean_gaps()     ? pair.kinematics
                                                    : ABUT_KINEMATICS_UPDATED);
      std::optional<DisplacedSides<dim>> displaced;
      if (pair.has_current_points())
        displaced.emplace(points.host(), pair, points.present());
      const Handle<abut_points> mortar_points =
          create_points(points.host().context, dim);
      abut_interface_target target =
          abut_interface_target_defaults(mortar_points.get());
      target.motion = points.set().motion(pair, u);
      build_points(points.set(), pair, mortar.get(),
                   std::vector<std::uint8_t>(pair.secondary.n_nodes(), 0),
                   target);
      abut_points_view view;
      check(points.host().context, abut_points_get(mortar_points.get(), &view));
      for (std::int32_t i = 0; i < view.n_points; ++i)
        for (auto e = view.start[i] + view.n_secondary[i];
             e < view.start[i + 1]; ++e)
          exact(unknown(view.node[e])) -= view.weight[i] * view.coefficient[e];
      exact.compress(dealii::VectorOperation::add);

      la::Vector wrong(exact);
      points.for_each_component(
          [&](const PointRow<dim> &row)
          {
            // A tie has a row for each direction.
            if (row.place.pair == p
                && (!pair.data.tied || row.direction[0] == 1.))
              points.for_each_primary(
                  row.point,
                  [&](const NodeIndex node, const double c) {
                    wrong(unknown(node)) += points.view().weight[row.point] * c;
                  });
          });
      wrong.compress(dealii::VectorOperation::add);
      const double total = exact.l1_norm();
      errors[p] = total > 0. ? 0.5 * wrong.l1_norm() / total : 0.;
    }
    return errors;
  }

  template std::vector<double> transfer_errors(const PairPoints<2> &,
                                               const la::Vector &);
  template std::vector<double> transfer_errors(const PairPoints<3> &,
                                               const la::Vector &);
} // namespace abut::shim

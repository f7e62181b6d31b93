// SPDX-License-Identifier: LGPL-2.1-or-later
// How well rows hand a uniform pressure to the primary surface: the error that
// the contact patch test measures, without solving anything.
#include "surface_pair_rows.h"

#include <cmath>
#include <optional>

namespace abut::shim
{
  template <int dim>
  std::vector<double>
  SurfacePairRows<dim>::transfer_errors(const la::Vector &displacement)
  {
    const std::vector<Direction> u =
        exchange_->displacements(surface_, displacement);
    std::vector<double> errors(pairs_.size(), 0.);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
    {
      Pair &pair = pairs_[p];
      if (pair.data.obstacle)
        continue;
      std::optional<DisplacedSides<dim>> displaced;
      if (pair.has_current_points())
        displaced.emplace(context_, pair.secondary, pair.primary, reference_,
                          present_);
      // The first unknown of a node stands for it.
      const auto unknown = [&](const Node node)
      { return surface_.nodes[node].dof[0]; };
      la::Vector exact = field();
      const Handle<abut_coupling> mortar =
          make_coupling(pair, ABUT_DISCRETISATION_MORTAR);
      const Handle<abut_points> points = create_points(context_, dim);
      abut_coupling_target target = abut_coupling_target_defaults(points.get());
      std::vector<double> reference;
      // As the rows are weighed, and where there are any.
      if (pair.has_current_points())
      {
        reference = places_of(pair.secondary.node, reference_);
        target.reference = reference.data();
        target.kinematics = discretisation_info(pair.discretisation).is_weighted
                                ? pair.kinematics
                                : ABUT_KINEMATICS_UPDATED;
      }
      target.secondary_node = pair.secondary.node.data();
      target.primary_node = pair.primary.node.data();
      build(pair, mortar.get(),
            std::vector<std::uint8_t>(pair.secondary.n_nodes(), 0),
            motion(pair, u), target);
      abut_points_view view;
      check(context_, abut_points_get(points.get(), &view));
      for (std::int32_t i = 0; i < view.n_points; ++i)
        for (auto e = view.start[i] + view.n_secondary[i];
             e < view.start[i + 1]; ++e)
          exact(unknown(view.node[e])) -= view.weight[i] * view.coefficient[e];
      exact.compress(dealii::VectorOperation::add);

      la::Vector wrong(exact);
      for_each_component(
          [&](const Component &row)
          {
            // A tie has a row for each direction.
            if (row.place.pair == p
                && (!pair.data.tied || row.direction[0] == 1.))
              for_each_primary(
                  row.point, [&](const Node node, const double c)
                  { wrong(unknown(node)) += view_.weight[row.point] * c; });
          });
      wrong.compress(dealii::VectorOperation::add);
      const double total = exact.l1_norm();
      errors[p] = total > 0. ? 0.5 * wrong.l1_norm() / total : 0.;
    }
    return errors;
  }

  template std::vector<double>
  SurfacePairRows<2>::transfer_errors(const la::Vector &);
  template std::vector<double>
  SurfacePairRows<3>::transfer_errors(const la::Vector &);
} // namespace abut::shim

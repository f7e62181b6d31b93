// SPDX-License-Identifier: LGPL-2.1-or-later
// Values of rows between surfaces as fields on the unknowns, and back.
#include "surface_fields.h"

#include <abut/dealii/versions.h>
#include <abut/strategy.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  using dealii::types::global_dof_index;

  template <int dim> la::Vector SurfaceFields<dim>::field() const
  {
    return la::Vector(host_.dof_handler.locally_owned_dofs(),
                      host_.communicator);
  }

  template <int dim>
  template <typename Function>
  void SurfaceFields<dim>::for_each_share_of(const PointRow<dim> &row,
                                             const Function &function) const
  {
    points_.for_each_share(row, [&](const NodeIndex node, const double share)
                           { function(row, node, share); });
  }

  template <int dim>
  template <typename Function>
  void SurfaceFields<dim>::for_each_share(const Function &function) const
  {
    points_.for_each_component([&](const PointRow<dim> &row)
                               { for_each_share_of(row, function); });
  }

  template <int dim>
  std::vector<double>
  SurfaceFields<dim>::row_pressure(const la::Vector &field) const
  {
    const dealii::IndexSet &owned = host_.dof_handler.locally_owned_dofs();
    std::vector<global_dof_index> others;
    const auto for_each = [&](const auto &function)
    {
      points_.for_each_row([&](const PointRow<dim> &row)
                           { for_each_share_of(row, function); });
    };
    for_each(
        [&](const PointRow<dim> &, const NodeIndex node, double)
        {
          for (const auto dof : surface_.nodes[node].dof)
            if (!owned.is_element(dof))
              others.push_back(dof);
        });
    std::sort(others.begin(), others.end());
    dealii::IndexSet needed(owned.size());
    needed.add_indices(others.begin(), others.end());
    la::Vector ghosted(owned, needed, host_.communicator);
    ghosted = field;

    std::vector<double> result(points_.view().n_components, 0.);
    for_each(
        [&](const PointRow<dim> &i, const NodeIndex node, const double share)
        {
          for (unsigned int d = 0; d < dim; ++d)
            result[i.row] +=
                share * i.direction[d] * ghosted(surface_.nodes[node].dof[d]);
        });
    return result;
  }

  template <int dim>
  void SurfaceFields<dim>::fill_between_nodes(la::Vector &field) const
  {
    dealii::AffineConstraints<double> linear;
    versions::reinit(
        linear, host_.dof_handler.locally_owned_dofs(),
        dealii::DoFTools::extract_locally_relevant_dofs(host_.dof_handler));
    bool any = false;
    for (const SurfacePair<dim> &pair : points_.pairs())
      if (pair.has_linear_multipliers())
      {
        any = true;
        for (const std::int32_t number : pair.secondary.facet)
          add_lines_between_corners(surface_.facets[number], linear);
      }
    if (any)
    {
      linear.close();
      linear.distribute(field);
    }
    points_.exchange().hanging().distribute(field);
  }

  template <int dim>
  void SurfaceFields<dim>::add_lines_between_corners(
      const Facet &facet, dealii::AffineConstraints<double> &lines) const
  {
    const unsigned int n = abut_facet_n_corners(facet.kind);
    for (unsigned int k = n; k < facet.n_nodes(); ++k)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const auto dof = surface_.nodes[facet.node[k]].dof[d];
        if (!host_.dof_handler.locally_owned_dofs().is_element(dof)
            || lines.is_constrained(dof))
          continue;
        // An edge has two corners, the middle of a facet all.
        std::vector<unsigned int> corners = {0, 1, 2, 3};
        if (k < 2 * n)
        {
          const auto ends = corners_of_edge(facet.kind, k - n);
          corners = {ends.first, ends.second};
        }
        lines.add_line(dof);
        for (const unsigned int corner : corners)
          lines.add_entry(dof, surface_.nodes[facet.node[corner]].dof[d],
                          1. / corners.size());
      }
  }

  template <int dim>
  la::Vector SurfaceFields<dim>::pressure(const double *row_pressure) const
  {
    // Forces of nodes by their areas, so that the integral is the force where
    // the other side covers a part of these.
    la::Vector result = field(), weight = field();
    const auto add =
        [&](const PointRow<dim> &i, const NodeIndex node, const double share)
    {
      const double w = share * points_.view().weight[i.point];
      for (unsigned int d = 0; d < dim; ++d)
        result(surface_.nodes[node].dof[d]) +=
            w * row_pressure[i.row] * i.direction[d];
      if (static_cast<std::size_t>(points_.view().component_start[i.point])
          == i.row)
        weight(surface_.nodes[node].dof[0]) += w;
    };
    points_.for_each_row([&](const PointRow<dim> &row)
                         { for_each_share_of(row, add); });
    result.compress(dealii::VectorOperation::add);
    weight.compress(dealii::VectorOperation::add);
    for (std::size_t n = 0; n < surface_.nodes.size(); ++n)
    {
      if (!points_.set().is_owned(static_cast<NodeIndex>(n)))
        continue;
      // Dual functions of facets on an axis have more than the nodes' areas.
      const double area =
          std::max(points_.node_area(static_cast<NodeIndex>(n)),
                   static_cast<double>(weight(surface_.nodes[n].dof[0])));
      for (unsigned int d = 0; d < dim && area > 0.; ++d)
        result(surface_.nodes[n].dof[d]) =
            result(surface_.nodes[n].dof[d]) / area;
    }
    result.compress(dealii::VectorOperation::insert);
    fill_between_nodes(result);
    return result;
  }

  template <int dim>
  la::Vector SurfaceFields<dim>::slip(const double *row_slip) const
  {
    // At nodes as it is; from quadrature points by weighted means.
    la::Vector result = field(), weight = field();
    const auto add =
        [&](const PointRow<dim> &i, const NodeIndex node, const double share)
    {
      const double w =
          i.place.node >= 0 ? 1. : share * points_.view().weight[i.point];
      const bool is_first =
          static_cast<std::size_t>(points_.view().component_start[i.point])
          == i.row;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const auto dof = surface_.nodes[node].dof[d];
        result(dof) += w * row_slip[i.row] * i.direction[d];
        if (i.place.node < 0 && is_first)
          weight(dof) += w;
      }
    };
    points_.for_each_row([&](const PointRow<dim> &row)
                         { for_each_share_of(row, add); });
    result.compress(dealii::VectorOperation::add);
    weight.compress(dealii::VectorOperation::add);
    double *p = la::data(result);
    const double *w = la::data(weight);
    for (int i = 0; i < la::n_owned(result); ++i)
      if (w[i] > 0.)
        p[i] /= w[i];
    fill_between_nodes(result);
    return result;
  }

  template <int dim>
  la::Vector SurfaceFields<dim>::gap(const double *row_gap) const
  {
    // The weighted mean of the rows of a node.
    la::Vector result = field(), weight = field();
    for_each_share(
        [&](const PointRow<dim> &i, const NodeIndex node, const double share)
        {
          const double w = share * points_.view().weight[i.point];
          for (const auto dof : surface_.nodes[node].dof)
          {
            result(dof) += w * row_gap[i.row];
            weight(dof) += w;
          }
        });
    result.compress(dealii::VectorOperation::add);
    weight.compress(dealii::VectorOperation::add);
    double *g = la::data(result);
    const double *w = la::data(weight);
    for (int i = 0; i < la::n_owned(result); ++i)
      if (w[i] > 0.)
        g[i] /= w[i];
    fill_between_nodes(result);
    return result;
  }

  template <int dim>
  la::Vector SurfaceFields<dim>::status(const std::uint8_t *row_state) const
  {
    // Rows and closed rows are counted, since counts add up over ranks.
    la::Vector present = field(), closed = field(), slipping = field();
    for_each_share(
        [&](const PointRow<dim> &i, const NodeIndex node, double)
        {
          const bool is_closed =
              row_state != nullptr && row_state[i.row] != ABUT_STATE_OPEN;
          for (const auto dof : surface_.nodes[node].dof)
          {
            present(dof) += 1.;
            closed(dof) += is_closed ? 1. : 0.;
            slipping(dof) += is_closed && row_state[i.row] == ABUT_STATE_SLIP;
          }
        });
    present.compress(dealii::VectorOperation::add);
    closed.compress(dealii::VectorOperation::add);
    slipping.compress(dealii::VectorOperation::add);
    la::Vector result = field();
    double *s = la::data(result);
    for (int i = 0; i < la::n_owned(result); ++i)
      s[i] = la::data(slipping)[i] > 0.  ? 2.
             : la::data(closed)[i] > 0.  ? 1.
             : la::data(present)[i] > 0. ? 0.
                                         : -1.;
    result.compress(dealii::VectorOperation::insert);
    return result;
  }

  template <int dim>
  bool SurfaceFields<dim>::is_free(const NodeIndex node,
                                   const unsigned int component) const
  {
    return surface_.map.is_itself(node, component,
                                  surface_.nodes[node].dof[component]);
  }

  template <int dim>
  double SurfaceFields<dim>::own_freedom(const NodeIndex node,
                                         const Direction<dim> &direction) const
  {
    double sum = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      if (is_free(node, d))
        sum += direction[d] * direction[d];
    return sum;
  }

  template <int dim>
  void SurfaceFields<dim>::push_inside(const std::vector<double> &gap,
                                       const std::vector<double> &margin,
                                       la::Vector &displacement) const
  {
    // Each row's own node steps back along the normal. Nodes around quadrature
    // points step back together, as far as the worst point needs.
    la::Vector step = field();
    double worst = 0.;
    points_.for_each_component(
        [&](const PointRow<dim> &i)
        {
          if (i.place.node < 0)
            worst = std::max(worst, margin[i.row] - gap[i.row]);
        });
    worst = dealii::Utilities::MPI::max(worst, host_.communicator);
    la::Vector share_of_points = field();
    for_each_share(
        [&](const PointRow<dim> &i, const NodeIndex node, double)
        {
          double amount = margin[i.row] - gap[i.row], own = 1.;
          if (amount <= 0.)
            return;
          if (i.place.node >= 0)
          {
            own = 0.;
            points_.for_each_secondary(
                i.point, [&](const NodeIndex other, const double c)
                { own += other == node ? c : 0.; });
          }
          const double free = own * own_freedom(node, i.direction);
          if (free <= 0.)
            return;
          amount = (i.place.node >= 0 ? amount : worst) / free;
          for (unsigned int d = 0; d < dim; ++d)
          {
            const auto dof = surface_.nodes[node].dof[d];
            step(dof) -= amount * i.direction[d];
            share_of_points(dof) += i.place.node >= 0 ? 0. : 1.;
          }
        });
    step.compress(dealii::VectorOperation::add);
    share_of_points.compress(dealii::VectorOperation::add);
    const dealii::IndexSet &owned = host_.dof_handler.locally_owned_dofs();
    for (std::size_t n = 0; n < surface_.nodes.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        if (owned.is_element(surface_.nodes[n].dof[d]) && is_free(n, d))
        {
          const auto k = owned.index_within_set(surface_.nodes[n].dof[d]);
          la::data(displacement)[k] +=
              la::data(step)[k] / std::max(1., la::data(share_of_points)[k]);
        }
    displacement.compress(dealii::VectorOperation::insert);
  }

  template <int dim>
  void SurfaceFields<dim>::find_forces(const std::vector<double> &row_pressure,
                                       la::Vector &forces) const
  {
    std::vector<Direction<dim>> force(surface_.nodes.size());
    points_.for_each_row(
        [&](const PointRow<dim> &row)
        {
          const double p =
              points_.view().weight[row.point] * row_pressure[row.row];
          const auto add = [&](const NodeIndex node, const double c)
          { force[node] -= p * c * row.direction; };
          points_.for_each_secondary(row.point, add);
          points_.for_each_primary(row.point, add);
        });
    for (std::size_t n = 0; n < force.size(); ++n)
      for (const auto &parent : surface_.parents[n])
        force[parent.index] += parent.factor * force[n];
    for (std::size_t n = 0; n < force.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        if (surface_.parents[n].empty() && force[n][d] != 0.)
          forces(surface_.nodes[n].dof[d]) += force[n][d];
    forces.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  void SurfaceFields<dim>::make_isotropic(la::Vector &value) const
  {
    const dealii::IndexSet &owned = host_.dof_handler.locally_owned_dofs();
    double *const mine = la::data(value);
    for (std::size_t n = 0; n < surface_.nodes.size(); ++n)
    {
      if (!points_.set().is_owned(static_cast<NodeIndex>(n)))
        continue;
      double sum = 0.;
      for (const auto dof : surface_.nodes[n].dof)
        sum += mine[owned.index_within_set(dof)];
      for (const auto dof : surface_.nodes[n].dof)
        mine[owned.index_within_set(dof)] = sum / dim;
    }
  }

  template class SurfaceFields<2>;
  template class SurfaceFields<3>;
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
// Values of rows between surfaces as fields on the unknowns, and back.
#include "surface_pair_rows.h"

#include <abut/strategy.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::shim
{
  using dealii::types::global_dof_index;

  template <int dim> la::Vector SurfacePairRows<dim>::field() const
  {
    return la::Vector(dof_handler_.locally_owned_dofs(), communicator_);
  }

  template <int dim>
  template <typename Function>
  void SurfacePairRows<dim>::for_each_share_of(const Component &row,
                                               const Function &function) const
  {
    if (row.place.node >= 0)
      function(row, row.place.node, 1.);
    else
      for_each_secondary(row.point, [&](const Node node, const double share)
                         { function(row, node, share); });
  }

  template <int dim>
  template <typename Function>
  void SurfacePairRows<dim>::for_each_share(const Function &function) const
  {
    for_each_component([&](const Component &row)
                       { for_each_share_of(row, function); });
  }

  template <int dim>
  std::vector<double>
  SurfacePairRows<dim>::row_pressure(const la::Vector &field) const
  {
    const dealii::IndexSet &owned = dof_handler_.locally_owned_dofs();
    std::vector<global_dof_index> others;
    const auto for_each = [&](const auto &function)
    {
      for_each_row([&](const Component &row)
                   { for_each_share_of(row, function); });
    };
    for_each(
        [&](const Component &, const Node node, double)
        {
          for (const auto dof : surface_.nodes[node].dof)
            if (!owned.is_element(dof))
              others.push_back(dof);
        });
    std::sort(others.begin(), others.end());
    dealii::IndexSet needed(owned.size());
    needed.add_indices(others.begin(), others.end());
    la::Vector ghosted(owned, needed, communicator_);
    ghosted = field;

    std::vector<double> result(view_.n_components, 0.);
    for_each(
        [&](const Component &i, const Node node, const double share)
        {
          for (unsigned int d = 0; d < dim; ++d)
            result[i.row] +=
                share * i.direction[d] * ghosted(surface_.nodes[node].dof[d]);
        });
    return result;
  }

  template <int dim>
  la::Vector SurfacePairRows<dim>::pressure(const double *row_pressure) const
  {
    // At nodes as it is; from quadrature points by weighted means.
    la::Vector result = field(), weight = field();
    const auto add =
        [&](const Component &i, const Node node, const double share)
    {
      const double w = i.place.node >= 0 ? 1. : share * view_.weight[i.point];
      const bool is_first =
          static_cast<std::size_t>(view_.component_start[i.point]) == i.row;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const auto dof = surface_.nodes[node].dof[d];
        result(dof) += w * row_pressure[i.row] * i.direction[d];
        if (i.place.node < 0 && is_first)
          weight(dof) += w;
      }
    };
    for_each_row([&](const Component &row) { for_each_share_of(row, add); });
    result.compress(dealii::VectorOperation::add);
    weight.compress(dealii::VectorOperation::add);
    double *p = la::data(result);
    const double *w = la::data(weight);
    for (int i = 0; i < la::n_owned(result); ++i)
      if (w[i] > 0.)
        p[i] /= w[i];
    exchange_->hanging().distribute(result);
    return result;
  }

  template <int dim>
  la::Vector SurfacePairRows<dim>::gap(const double *row_gap) const
  {
    // The weighted mean of the rows of a node.
    la::Vector result = field(), weight = field();
    for_each_share(
        [&](const Component &i, const Node node, const double share)
        {
          const double w = share * view_.weight[i.point];
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
    exchange_->hanging().distribute(result);
    return result;
  }

  template <int dim>
  la::Vector SurfacePairRows<dim>::status(const std::uint8_t *row_state) const
  {
    // Rows and closed rows are counted, since counts add up over ranks.
    la::Vector present = field(), closed = field(), slipping = field();
    for_each_share(
        [&](const Component &i, const Node node, double)
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
  std::vector<std::uint8_t>
  SurfacePairRows<dim>::relax(const Tangent &, const la::Vector &,
                              const std::vector<double> &, unsigned int,
                              la::Vector &) const
  {
    // Rows over several unknowns are not relaxed one by one.
    return {};
  }

  template <int dim>
  bool SurfacePairRows<dim>::is_free(const Node node,
                                     const unsigned int component) const
  {
    return surface_.map.is_itself(node, component,
                                  surface_.nodes[node].dof[component]);
  }

  template <int dim>
  double SurfacePairRows<dim>::own_freedom(const Node node,
                                           const Direction &direction) const
  {
    double sum = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      if (is_free(node, d))
        sum += direction[d] * direction[d];
    return sum;
  }

  template <int dim>
  void SurfacePairRows<dim>::push_inside(const std::vector<double> &gap,
                                         std::vector<double> margin,
                                         la::Vector &displacement) const
  {
    // Each row's own node steps back along the normal. Nodes around quadrature
    // points step back together, as far as the worst point needs.
    la::Vector step = field();
    double worst = 0.;
    for_each_component(
        [&](const Component &i)
        {
          if (i.place.node < 0)
            worst = std::max(worst, margin[i.row] - gap[i.row]);
        });
    worst = dealii::Utilities::MPI::max(worst, communicator_);
    la::Vector share_of_points = field();
    for_each_share(
        [&](const Component &i, const Node node, double)
        {
          double amount = margin[i.row] - gap[i.row], own = 1.;
          if (amount <= 0.)
            return;
          if (i.place.node >= 0)
          {
            own = 0.;
            for_each_secondary(i.point, [&](const Node other, const double c)
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
    const dealii::IndexSet &owned = dof_handler_.locally_owned_dofs();
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

#define ABUT_INSTANTIATE(dim)                                                  \
  template la::Vector SurfacePairRows<dim>::field() const;                     \
  template std::vector<double> SurfacePairRows<dim>::row_pressure(             \
      const la::Vector &) const;                                               \
  template la::Vector SurfacePairRows<dim>::pressure(const double *) const;    \
  template la::Vector SurfacePairRows<dim>::gap(const double *) const;         \
  template la::Vector SurfacePairRows<dim>::status(const std::uint8_t *)       \
      const;                                                                   \
  template std::vector<std::uint8_t> SurfacePairRows<dim>::relax(              \
      const Tangent &, const la::Vector &, const std::vector<double> &,        \
      unsigned int, la::Vector &) const;                                       \
  template bool SurfacePairRows<dim>::is_free(Node, unsigned int) const;       \
  template double SurfacePairRows<dim>::own_freedom(Node, const Direction &)   \
      const;                                                                   \
  template void SurfacePairRows<dim>::push_inside(                             \
      const std::vector<double> &, std::vector<double>, la::Vector &) const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
// Penetration of an obstacle of a membrane between the nodes.
#include "nodal_obstacle_rows.h"

#include "agree.h"
#include "reference_faces.h"
#include "sampling.h"
#include "values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace abut::shim
{
  namespace
  {
    template <int dim>
    la::Vector with_ghosts(const dealii::DoFHandler<dim> &dof_handler,
                           const dealii::IndexSet &relevant,
                           const la::Vector &owned)
    {
      la::Vector result(dof_handler.locally_owned_dofs(), relevant,
                        versions::communicator(dof_handler));
      result = owned;
      return result;
    }
  } // namespace

  template <int dim>
  void NodalObstacleRows<dim>::find_depth(
      const std::vector<dealii::Point<dim>> &points,
      const std::vector<double> &values, std::vector<double> &height,
      FacetPenetration &found) const
  {
    const auto compare =
        [&](const dealii::Function<dim> *obstacle, const double sign)
    {
      if (obstacle == nullptr)
        return;
      height.resize(points.size());
      obstacle->value_list(points, height);
      for (std::size_t q = 0; q < points.size(); ++q)
        if (const double depth = sign * (height[q] - values[q]);
            depth > found.depth && std::isfinite(depth))
        {
          found.depth = depth;
          for (unsigned int d = 0; d < dim; ++d)
            found.place[d] = points[q][d];
        }
    };
    compare(obstacle_.lower.get(), 1.);
    compare(obstacle_.upper.get(), -1.);
  }

  template <int dim>
  void NodalObstacleRows<dim>::find_peak(
      const std::vector<dealii::Point<dim>> &points,
      const std::vector<double> &values,
      const std::vector<dealii::Point<dim>> &nodes,
      FacetPenetration &found) const
  {
    std::vector<double> height(points.size()), known(nodes.size());
    const auto compare =
        [&](const dealii::Function<dim> *obstacle, const double sign)
    {
      if (obstacle == nullptr)
        return;
      obstacle->value_list(points, height);
      obstacle->value_list(nodes, known);
      double highest = -INFINITY;
      for (const double value : known)
        highest = std::max(highest, sign * value);
      for (std::size_t q = 0; q < points.size(); ++q)
      {
        const double level = sign * height[q];
        const double peak = std::min(level - highest, level - sign * values[q]);
        if (std::isfinite(peak))
          found.peak = std::max(found.peak, peak);
      }
    };
    compare(obstacle_.lower.get(), 1.);
    compare(obstacle_.upper.get(), -1.);
  }

  template <int dim>
  std::vector<FacetPenetration>
  NodalObstacleRows<dim>::facet_penetrations(const la::Vector &displacement,
                                             const std::uint8_t *row_state)
  {
    const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler_);
    const la::Vector u = with_ghosts(dof_handler_, relevant, displacement);
    const la::Vector state =
        with_ghosts(dof_handler_, relevant, status(row_state));
    const auto touches = [&](const dealii::types::global_dof_index dof)
    {
      if (state(dof) > 0.)
        return true;
      const auto *parents = constraints_.get_constraint_entries(dof);
      return parents != nullptr
             && std::any_of(parents->begin(), parents->end(),
                            [&](const auto &parent) {
                              return relevant.is_element(parent.first)
                                     && state(parent.first) > 0.;
                            });
    };

    const bool on_faces = !obstacle_.boundary_ids.empty();
    const unsigned int n = samples_per_direction(
        dof_handler_.get_triangulation().n_global_active_cells(),
        on_faces ? dim - 1 : dim);
    const auto flags = dealii::update_values | dealii::update_quadrature_points;
    // Which of them is used: to make one takes longer than a step of few cells.
    using Element = dealii::FiniteElement<dim>;
    std::optional<ByElement<dealii::FEValues<dim>>> in_cells;
    std::optional<ByElement<dealii::FEFaceValues<dim>>> on_all_faces;
    if (on_faces)
      on_all_faces.emplace(face_values(
          mapping_, dof_handler_,
          [&](const Element &fe)
          { return regular_points<dim - 1>(n, is_simplex(fe)); },
          flags));
    else
      in_cells.emplace(cell_values(
          mapping_, dof_handler_,
          [&](const Element &fe)
          { return regular_points<dim>(n, is_simplex(fe)); },
          flags));
    const auto at_all_nodes =
        cell_values(mapping_, dof_handler_, shim::nodes<dim>,
                    dealii::update_quadrature_points);
    std::vector<dealii::types::global_dof_index> dofs;
    std::vector<double> of_nodes, values, height;
    std::vector<dealii::Point<dim>> nodes;
    std::vector<FacetPenetration> result;
    const auto look = [&](const auto &cell,
                          const dealii::FEValuesBase<dim> &points,
                          const auto &is_there)
    {
      FacetPenetration found;
      found.cell = cell->active_cell_index();
      get_dofs(cell, dofs);
      of_nodes.resize(dofs.size());
      for (unsigned int i = 0; i < dofs.size(); ++i)
        of_nodes[i] = u(dofs[i]);
      values.assign(points.n_quadrature_points, 0.);
      for (unsigned int q = 0; q < values.size(); ++q)
        for (unsigned int i = 0; i < dofs.size(); ++i)
          values[q] += points.shape_value(i, q) * of_nodes[i];
      find_depth(points.get_quadrature_points(), values, height, found);
      if (found.depth <= 0.)
        return;
      dealii::FEValues<dim> &at_nodes = at_all_nodes.of(cell);
      at_nodes.reinit(cell);
      nodes.clear();
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (is_there(i))
        {
          nodes.push_back(at_nodes.quadrature_point(i));
          if (touches(dofs[i]))
            found.is_missed = false;
        }
      find_peak(points.get_quadrature_points(), values, nodes, found);
      result.push_back(found);
    };
    run_everywhere<ObstacleError>(
        communicator_,
        [&]
        {
          for (const auto &cell : dof_handler_.active_cell_iterators())
          {
            if (!cell->is_locally_owned())
              continue;
            if (!on_faces)
            {
              dealii::FEValues<dim> &in_cell = in_cells->of(cell);
              in_cell.reinit(cell);
              look(cell, in_cell, [](unsigned int) { return true; });
              continue;
            }
            for (const unsigned int f : cell->face_indices())
              if (cell->face(f)->at_boundary()
                  && obstacle_.boundary_ids.count(cell->face(f)->boundary_id())
                         > 0)
              {
                dealii::FEFaceValues<dim> &on_face = on_all_faces->of(cell);
                on_face.reinit(cell, f);
                look(cell, on_face,
                     [&](const unsigned int i)
                     { return has_node_on_face(cell->get_fe(), i, f); });
              }
          }
        });
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void NodalObstacleRows<dim>::find_depth(                            \
      const std::vector<dealii::Point<dim>> &, const std::vector<double> &,    \
      std::vector<double> &, FacetPenetration &) const;                        \
  template void NodalObstacleRows<dim>::find_peak(                             \
      const std::vector<dealii::Point<dim>> &, const std::vector<double> &,    \
      const std::vector<dealii::Point<dim>> &, FacetPenetration &) const;      \
  template std::vector<FacetPenetration>                                       \
  NodalObstacleRows<dim>::facet_penetrations(const la::Vector &,               \
                                             const std::uint8_t *);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nearest_node.h"

#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>

#include <array>
#include <limits>

namespace abut::app
{
  template <int dim>
  NodalValue<dim> nearest_node(const dealii::Mapping<dim> &mapping,
                               const dealii::DoFHandler<dim> &dof_handler,
                               const la::Vector &field, const unsigned int body,
                               const dealii::Point<dim> &point)
  {
    // Distance, position, value, diameter: compared in this order.
    using Candidate = std::array<double, 2 + 2 * dim>;
    Candidate best;
    best.fill(0.);
    best[0] = std::numeric_limits<double>::infinity();
    const auto nodes_of = shim::cell_values(
        mapping, dof_handler, shim::nodes<dim>,
        dealii::update_quadrature_points, shim::ValuesOf::component);
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned() || cell->material_id() != body)
        continue;
      const dealii::FiniteElement<dim> &fe = cell->get_fe();
      dealii::FEValues<dim> &nodes = nodes_of.of(cell);
      nodes.reinit(
          static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
              cell));
      shim::get_dofs(cell, dofs);
      for (unsigned int i = 0; i < nodes.n_quadrature_points; ++i)
      {
        const dealii::Point<dim> &x = nodes.quadrature_point(i);
        Candidate candidate;
        candidate[0] = x.distance(point);
        if (candidate[0] > best[0])
          continue;
        for (unsigned int d = 0; d < dim; ++d)
        {
          candidate[1 + d] = x[d];
          candidate[1 + dim + d] =
              field(dofs[fe.component_to_system_index(d, i)]);
        }
        candidate[1 + 2 * dim] = cell->diameter();
        best = std::min(best, candidate);
      }
    }
    const auto all = dealii::Utilities::MPI::all_gather(
        versions::communicator(dof_handler), best);
    best = *std::min_element(all.begin(), all.end());
    NodalValue<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
    {
      result.position[d] = best[1 + d];
      result.value[d] = best[1 + dim + d];
    }
    result.cell_diameter = best[1 + 2 * dim];
    return result;
  }

  template NodalValue<2> nearest_node<2>(const dealii::Mapping<2> &,
                                         const dealii::DoFHandler<2> &,
                                         const la::Vector &, unsigned int,
                                         const dealii::Point<2> &);
  template NodalValue<3> nearest_node<3>(const dealii::Mapping<3> &,
                                         const dealii::DoFHandler<3> &,
                                         const la::Vector &, unsigned int,
                                         const dealii::Point<3> &);
} // namespace abut::app

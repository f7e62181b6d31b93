// SPDX-License-Identifier: LGPL-2.1-or-later
// The bodies' own normal stress at quadrature points, for Nitsche's method.
#include "agree.h"
#include "surface_pair_rows.h"

#include <deal.II/grid/cell_id.h>

#include <map>

namespace abut::shim
{
  using dealii::types::global_dof_index;

  namespace
  {
    /** Put what constraints make of the unknowns of a cell in their place. */
    void resolve(const dealii::AffineConstraints<double> &constraints,
                 const global_dof_index dof, const double factor,
                 std::map<std::int64_t, double> &terms, double &constant)
    {
      if (!constraints.is_constrained(dof))
      {
        terms[static_cast<std::int64_t>(dof)] += factor;
        return;
      }
      constant += factor * constraints.get_inhomogeneity(dof);
      for (const auto &entry : *constraints.get_constraint_entries(dof))
        terms[static_cast<std::int64_t>(entry.first)] += factor * entry.second;
    }
  } // namespace

  template <int dim>
  void SurfacePairRows<dim>::find_stress(const NormalStress<dim> &normal_stress,
                                         abut_rows *stress) const
  {
    abut_rows_clear(stress);
    run_everywhere<ContactError>(communicator_,
                                 [&] { append_stress(normal_stress, stress); });
  }

  template <int dim>
  void
  SurfacePairRows<dim>::append_stress(const NormalStress<dim> &normal_stress,
                                      abut_rows *stress) const
  {
    const unsigned int n_dofs = dof_handler_.get_fe().n_dofs_per_cell();
    std::vector<global_dof_index> dofs(n_dofs);
    for (std::size_t first = 0, end; first < rows_.size(); first = end)
    {
      // Rows of a facet follow each other.
      for (end = first + 1; end < rows_.size()
                            && rows_[end].facet == rows_[first].facet
                            && rows_[end].pair == rows_[first].pair;)
        ++end;
      const auto &facet = surface_.facets[rows_[first].facet];
      const auto place = dof_handler_.get_triangulation().create_cell_iterator(
          dealii::CellId(facet.cell));
      const typename dealii::DoFHandler<dim>::active_cell_iterator cell(
          &dof_handler_.get_triangulation(), place->level(), place->index(),
          &dof_handler_);
      std::vector<dealii::Point<dim>> points;
      std::vector<Direction> normals;
      for (std::size_t i = first; i < end; ++i)
      {
        points.push_back(dealii::GeometryInfo<dim>::project_to_unit_cell(
            mapping_.transform_real_to_unit_cell(cell, rows_[i].position)));
        normals.push_back(rows_[i].direction);
      }
      dealii::FullMatrix<double> derivative(end - first, n_dofs);
      normal_stress.evaluate(cell, points, normals, derivative);
      cell->get_dof_indices(dofs);
      for (std::size_t i = first; i < end; ++i)
      {
        std::map<std::int64_t, double> terms;
        double constant = 0.;
        for (unsigned int k = 0; k < n_dofs; ++k)
          if (derivative(i - first, k) != 0.)
            resolve(constraints_, dofs[k], derivative(i - first, k), terms,
                    constant);
        std::vector<std::int64_t> column;
        std::vector<double> coefficient;
        for (const auto &term : terms)
        {
          column.push_back(term.first);
          coefficient.push_back(term.second);
        }
        const abut_status status =
            abut_rows_append(stress, rows_[i].id, rows_[i].weight, constant, 0,
                             static_cast<std::int32_t>(column.size()),
                             column.data(), coefficient.data());
        if (status != ABUT_SUCCESS)
          throw ContactError("Pair '" + pairs_[rows_[i].pair].data.name
                             + "': the normal stress of a body: "
                             + message_of(context_, status));
      }
    }
  }

  template void SurfacePairRows<2>::find_stress(const NormalStress<2> &,
                                                abut_rows *) const;
  template void SurfacePairRows<3>::find_stress(const NormalStress<3> &,
                                                abut_rows *) const;
} // namespace abut::shim

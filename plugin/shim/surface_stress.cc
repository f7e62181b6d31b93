// SPDX-License-Identifier: LGPL-2.1-or-later
#include "surface_stress.h"

#include "agree.h"
#include "by_element.h"
#include "reference_faces.h"

#include <deal.II/grid/cell_id.h>

#include <unordered_map>

namespace abut::shim
{
  using dealii::types::global_dof_index;

  namespace
  {
    /** Unknowns of cells as nodes, numbered as they come. */
    class CellNodes
    {
    public:
      explicit CellNodes(const dealii::AffineConstraints<double> &constraints)
          : constraints_(constraints)
      {
      }

      std::int32_t operator()(const global_dof_index dof)
      {
        const auto [it, is_new] = number_.emplace(dof, number_.size());
        if (is_new)
          append(dof);
        return it->second;
      }

      const solve::NodeMap &map() const
      {
        return map_;
      }

    private:
      /** Terms of an unknown by constraints. */
      void append(const global_dof_index dof)
      {
        std::vector<solve::NodeMap::Term> terms;
        if (!constraints_.is_constrained(dof))
          terms.push_back({dof, 1.});
        else
          for (const auto &entry : *constraints_.get_constraint_entries(dof))
            terms.push_back({entry.first, entry.second});
        map_.append(terms, constraints_.get_inhomogeneity(dof));
      }

      const dealii::AffineConstraints<double> &constraints_;
      std::unordered_map<global_dof_index, std::int32_t> number_;
      solve::NodeMap map_;
    };

    /** Derivatives of tractions along a direction, [dofs_per_cell]; @p row is
     * that of their first component. */
    template <int dim>
    std::vector<double> along(const dealii::FullMatrix<double> &derivative,
                              const unsigned int row,
                              const dealii::Tensor<1, dim> &direction)
    {
      std::vector<double> result(derivative.n(), 0.);
      for (unsigned int k = 0; k < derivative.n(); ++k)
        for (unsigned int d = 0; d < dim; ++d)
          result[k] += direction[d] * derivative(row + d, k);
      return result;
    }

    /** Coefficients that are not 0, over nodes. */
    struct Stencil
    {
      std::vector<std::int32_t> node;
      std::vector<double> coefficient;

      Stencil(const std::vector<double> &values,
              const std::vector<global_dof_index> &dofs, CellNodes &nodes)
      {
        for (std::size_t k = 0; k < values.size(); ++k)
          if (values[k] != 0.)
          {
            node.push_back(nodes(dofs[k]));
            coefficient.push_back(values[k]);
          }
      }
    };

    template <int dim>
    solve::NodeMap append_stress(const PairPoints<dim> &points,
                                 const SurfaceTraction<dim> &traction,
                                 abut_points *stress)
    {
      const PairHost<dim> &host = points.host();
      const abut_points_view &view = points.view();
      const abut_places_view &places = points.places();
      const ByElement faces_of(host.dof_handler,
                               [](const dealii::FiniteElement<dim> &fe) {
                                 return ReferenceFaces<dim>(fe.base_element(0));
                               });
      std::vector<global_dof_index> dofs;
      CellNodes nodes(host.constraints);
      const auto n_points = static_cast<std::size_t>(view.n_points);
      for (std::size_t first = 0, end; first < n_points; first = end)
      {
        // Points of a facet follow each other.
        for (end = first + 1; end < n_points
                              && places.facet[end] == places.facet[first]
                              && places.pair[end] == places.pair[first];)
          ++end;
        const auto &facet = points.surface().facets[places.facet[first]];
        const auto place =
            host.dof_handler.get_triangulation().create_cell_iterator(
                dealii::CellId(facet.cell));
        const typename dealii::DoFHandler<dim>::active_cell_iterator cell(
            &host.dof_handler.get_triangulation(), place->level(),
            place->index(), &host.dof_handler);
        std::vector<dealii::Point<dim>> samples;
        std::vector<Direction<dim>> normals(end - first);
        for (std::size_t i = first; i < end; ++i)
        {
          samples.push_back(
              faces_of.of(cell).inside(host.mapping.transform_real_to_unit_cell(
                  cell, points.place(i).position)));
          for (unsigned int d = 0; d < dim; ++d)
            normals[i - first][d] =
                view.frame[view.component_start[i] * std::size_t(dim) + d];
        }
        get_dofs(cell, dofs);
        dealii::FullMatrix<double> derivative((end - first) * dim, dofs.size());
        traction.evaluate(cell, samples, normals, derivative);
        for (std::size_t i = first; i < end; ++i)
          for (std::int32_t row = view.component_start[i];
               row < view.component_start[i + 1]; ++row)
          {
            Direction<dim> direction;
            for (unsigned int d = 0; d < dim; ++d)
              direction[d] = view.frame[row * std::size_t(dim) + d];
            // Tractions act on the secondary, pressures against it.
            direction *=
                -abut_point_sign(view.kind[i], row - view.component_start[i]);
            const Stencil stencil(
                along(derivative, (i - first) * dim, direction), dofs, nodes);
            const abut_status status = abut_points_append_scalar(
                stress, view.component_id[row], view.weight[i], 0.,
                ABUT_POINT_CONTACT,
                static_cast<std::int32_t>(stencil.node.size()),
                stencil.node.data(), stencil.coefficient.data());
            if (status != ABUT_SUCCESS)
              throw ContactError(about_pair(
                  points.pairs()[places.pair[i]].data.name,
                  "the stress of a body: " + message_of(host.context, status)));
          }
      }
      return nodes.map();
    }
  } // namespace

  template <int dim>
  solve::NodeMap find_stress(const PairPoints<dim> &points,
                             const SurfaceTraction<dim> &traction,
                             abut_points *stress)
  {
    abut_points_clear(stress);
    solve::NodeMap map;
    run_everywhere<ContactError>(
        points.host().communicator,
        [&] { map = append_stress(points, traction, stress); });
    return map;
  }

  template solve::NodeMap
  find_stress(const PairPoints<2> &, const SurfaceTraction<2> &, abut_points *);
  template solve::NodeMap
  find_stress(const PairPoints<3> &, const SurfaceTraction<3> &, abut_points *);
} // namespace abut::shim

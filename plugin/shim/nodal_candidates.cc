/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "nodal_candidates.h"

#include "cell_quadrature.h"
#include "shifted_cells.h"
#include "values_by_element.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/versions.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

#include <limits>

namespace abut::shim
{
  namespace
  {
    using dealii::Point;
    using dealii::types::global_dof_index;

    /** Support points and weights by relevant unknown, before constraints. */
    template <int dim> struct Collection
    {
      explicit Collection(const dealii::IndexSet &unknowns)
          : relevant(unknowns),
            points(relevant.n_elements()),
            weights(relevant.n_elements(),
                    std::numeric_limits<double>::quiet_NaN()),
            is_interval_(relevant.is_contiguous()),
            first_(points.empty() ? 0 : relevant.nth_index_in_set(0))
      {
      }

      const dealii::IndexSet relevant;
      std::vector<Point<dim>> points;
      std::vector<double> weights; ///< NaN: not a candidate

      global_dof_index unknown(const std::size_t i) const
      {
        return is_interval_ ? first_ + i : relevant.nth_index_in_set(i);
      }

      void add(const global_dof_index dof, const Point<dim> &point,
               const double weight)
      {
        // Index sets take long to find one of a number.
        const auto i =
            is_interval_ ? dof - first_ : relevant.index_within_set(dof);
        points[i] = point;
        weights[i] = std::isnan(weights[i]) ? weight : weights[i] + weight;
      }

    private:
      const bool is_interval_;
      const global_dof_index first_;
    };

    /** Nodes of a cell with the integrals of their shape functions: the
     * quadrature rule that has the support points as points. */
    template <int dim>
    dealii::Quadrature<dim>
    support_quadrature(const dealii::FiniteElement<dim> &fe)
    {
      const dealii::Quadrature<dim> exact = gauss(fe, fe.degree + 1);
      std::vector<double> weights(fe.n_dofs_per_cell(), 0.);
      for (unsigned int i = 0; i < weights.size(); ++i)
        for (unsigned int q = 0; q < exact.size(); ++q)
          weights[i] += fe.shape_value(i, exact.point(q)) * exact.weight(q);
      return dealii::Quadrature<dim>(fe.get_unit_support_points(), weights);
    }

    /** Whether node i of a cell is its vertex i. */
    template <int dim>
    bool has_nodes_in_vertices(const dealii::FiniteElement<dim> &fe)
    {
      constexpr unsigned int n = dealii::GeometryInfo<dim>::vertices_per_cell;
      bool result = fe.n_dofs_per_cell() == n;
      for (unsigned int i = 0; i < n && result; ++i)
        result = fe.unit_support_point(i)
                 == dealii::GeometryInfo<dim>::unit_cell_vertex(i);
      return result;
    }

    template <int dim>
    void collect_in_domain(const dealii::Mapping<dim> &mapping,
                           const dealii::DoFHandler<dim> &dof_handler,
                           Collection<dim> &collection)
    {
      const auto values_of = cell_values(
          mapping, dof_handler, support_quadrature<dim>,
          dealii::update_JxW_values | dealii::update_quadrature_points);
      std::vector<global_dof_index> dofs;
      ShiftedCells<dim> shapes(mapping);
      const bool nodes_are_vertices =
          has_nodes_in_vertices(dof_handler.get_fe());
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          dealii::FEValues<dim> &values = values_of.of(cell);
          get_dofs(cell, dofs);
          if (nodes_are_vertices && shapes.is_shifted(cell))
          {
            for (unsigned int i = 0; i < dofs.size(); ++i)
              collection.add(dofs[i], cell->vertex(i), values.JxW(i));
            continue;
          }
          values.reinit(cell);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            collection.add(dofs[i], values.quadrature_point(i), values.JxW(i));
        }
    }

    /** A rule whose points are the support points on a face. It integrates
     * shape functions exactly on parallelograms and linear triangles. */
    template <int dim>
    dealii::Quadrature<dim - 1> node_rule(const dealii::FiniteElement<dim> &fe)
    {
      if (dim == 2 || !is_simplex(fe))
        return dealii::QGaussLobatto<dim - 1>(fe.degree + 1);
      std::vector<dealii::Point<dim - 1>> corners(dim);
      for (unsigned int d = 0; d + 1 < dim; ++d)
        corners[d + 1][d] = 1.;
      return {corners, std::vector<double>(dim, 1. / 6.)};
    }

    template <int dim>
    void collect_on_boundary(const dealii::Mapping<dim> &mapping,
                             const dealii::DoFHandler<dim> &dof_handler,
                             const std::set<dealii::types::boundary_id> &ids,
                             Collection<dim> &collection)
    {
      const auto values_of =
          face_values(mapping, dof_handler, node_rule<dim>,
                      dealii::update_values | dealii::update_JxW_values
                          | dealii::update_quadrature_points);
      std::vector<global_dof_index> dofs;
      // A node of this rank may lie on boundary faces of ghost cells only: its
      // place is taken from there, its weight from the owner of the cell.
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && ids.count(face->boundary_id()) != 0)
            {
              dealii::FEFaceValues<dim> &values = values_of.of(cell);
              values.reinit(cell, face);
              get_dofs(cell, dofs);
              for (const unsigned int q : values.quadrature_point_indices())
                for (unsigned int i = 0; i < dofs.size(); ++i)
                  if (values.shape_value(i, q) > 0.5)
                    collection.add(dofs[i], values.quadrature_point(q),
                                   cell->is_locally_owned() ? values.JxW(q)
                                                            : 0.);
            }
    }

    /** Sum weights over ranks and hand those of hanging nodes on. */
    template <int dim>
    la::Vector
    condense_weights(const dealii::DoFHandler<dim> &dof_handler,
                     const dealii::AffineConstraints<double> &constraints,
                     const Collection<dim> &collection)
    {
      la::Vector result(dof_handler.locally_owned_dofs(),
                        versions::communicator(dof_handler));
      const auto range = result.local_range();
      double *const own = la::data(result);
      for (std::size_t i = 0; i < collection.weights.size(); ++i)
      {
        if (std::isnan(collection.weights[i]))
          continue;
        const global_dof_index dof = collection.unknown(i);
        const double weight = collection.weights[i];
        const auto *parents = constraints.get_constraint_entries(dof);
        const bool is_own = parents == nullptr || parents->empty();
        if (is_own && dof >= range.first && dof < range.second)
          own[dof - range.first] += weight;
        else if (is_own)
          result(dof) += weight;
        else
          for (const auto &parent : *parents)
            result(parent.first) += weight * parent.second;
      }
      result.compress(dealii::VectorOperation::add);
      return result;
    }
  } // namespace

  template <int dim>
  NodalCandidates<dim> collect_nodal_candidates(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler,
      const dealii::AffineConstraints<double> &constraints,
      const std::set<dealii::types::boundary_id> &boundary_ids)
  {
    const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
    Collection<dim> collection(relevant);
    if (boundary_ids.empty())
      collect_in_domain(mapping, dof_handler, collection);
    else
      collect_on_boundary(mapping, dof_handler, boundary_ids, collection);
    const la::Vector weights =
        condense_weights(dof_handler, constraints, collection);

    NodalCandidates<dim> candidates;
    const auto range = weights.local_range();
    const double *const own = la::data(weights);
    for (std::size_t i = 0; i < collection.weights.size(); ++i)
    {
      const global_dof_index dof = collection.unknown(i);
      if (std::isnan(collection.weights[i]) || dof < range.first
          || dof >= range.second)
        continue;
      if (!constraints.is_constrained(dof))
        candidates.free.push_back(
            {dof, collection.points[i], own[dof - range.first]});
      else if (constraints.get_constraint_entries(dof)->empty())
        candidates.prescribed.push_back(
            {dof, collection.points[i], collection.weights[i]});
    }
    return candidates;
  }

  template NodalCandidates<2>
  collect_nodal_candidates(const dealii::Mapping<2> &,
                           const dealii::DoFHandler<2> &,
                           const dealii::AffineConstraints<double> &,
                           const std::set<dealii::types::boundary_id> &);
  template NodalCandidates<3>
  collect_nodal_candidates(const dealii::Mapping<3> &,
                           const dealii::DoFHandler<3> &,
                           const dealii::AffineConstraints<double> &,
                           const std::set<dealii::types::boundary_id> &);
} // namespace abut::shim

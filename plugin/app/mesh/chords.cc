// SPDX-License-Identifier: LGPL-2.1-or-later
#include "chords.h"
#include "shim/by_element.h"
#include "shim/cell_quadrature.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/fe/fe.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    using dealii::types::boundary_id;

    /** Degrees from which on an angle is a corner. */
    constexpr double least_corner = 50.;

    template <int dim>
    dealii::Tensor<1, dim> outward_normal(
        const typename dealii::Triangulation<dim>::cell_iterator &cell,
        const unsigned int f)
    {
      const auto face = cell->face(f);
      dealii::Tensor<1, dim> normal;
      if constexpr (dim == 2)
        normal = dealii::cross_product_2d(face->vertex(1) - face->vertex(0));
      else
        normal = dealii::cross_product_3d(face->vertex(face->n_vertices() - 1)
                                              - face->vertex(0),
                                          face->vertex(2) - face->vertex(1));
      if (normal * (face->center() - cell->center()) < 0.)
        normal *= -1.;
      return normal / normal.norm();
    }

    /** Between unit vectors, exact for small ones, too. */
    template <int dim>
    double degrees_between(const dealii::Tensor<1, dim> &a,
                           const dealii::Tensor<1, dim> &b)
    {
      return 2. * std::atan2((a - b).norm(), (a + b).norm()) * 180.
             / dealii::numbers::PI;
    }
  } // namespace

  template <int dim>
  Chords<dim>::Chords(const dealii::Triangulation<dim> &triangulation,
                      const std::set<dealii::types::material_id> &bodies,
                      const std::set<boundary_id> &ids)
  {
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      if (bodies.count(cell->material_id()) > 0)
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary()
              && cell->face(f)->manifold_id()
                     == dealii::numbers::flat_manifold_id
              && ids.count(cell->face(f)->boundary_id()) > 0)
            add(cell, f);
  }

  template <int dim>
  void Chords<dim>::add(
      const typename dealii::Triangulation<dim>::cell_iterator &cell,
      const unsigned int f)
  {
    const auto face = cell->face(f);
    const auto side = [&](const dealii::Point<dim> &place)
    {
      return Side{outward_normal<dim>(cell, f), place, face->boundary_id(),
                  CoarseFacet(cell->index(), f)};
    };
    if constexpr (dim == 2)
      for (unsigned int v = 0; v < 2; ++v)
        edges_[face->vertex_index(v)].push_back(side(face->vertex(v)));
    else
      for (unsigned int l = 0; l < face->n_lines(); ++l)
        edges_[face->line(l)->index()].push_back(
            side(face->line(l)->vertex(0)));
  }

  template <int dim>
  Bend<dim> Chords<dim>::largest(const std::set<CoarseFacet> *among) const
  {
    Bend<dim> result;
    for (const auto &edge : edges_)
    {
      std::vector<const Side *> sides;
      for (const Side &side : edge.second)
        if (among == nullptr || among->count(side.facet) > 0)
          sides.push_back(&side);
      if (sides.size() != 2)
        continue;
      const double degrees =
          degrees_between(sides[0]->normal, sides[1]->normal);
      if (degrees > result.degrees && degrees < least_corner)
        result = {sides[0]->place, degrees, sides[0]->id};
    }
    return result;
  }

  template <int dim>
  std::set<CoarseFacet>
  coarse_facets_above(const dealii::DoFHandler<dim> &dof_handler,
                      const std::set<boundary_id> &ids, const la::Vector &field,
                      const double least)
  {
    std::vector<dealii::types::global_dof_index> dofs;
    std::vector<double> squares;
    const auto reaches = [&](const auto &cell, const unsigned int f)
    {
      const auto &fe = cell->get_fe();
      shim::get_dofs(cell, dofs);
      squares.assign(fe.base_element(0).n_dofs_per_cell(), 0.);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (shim::has_node_on_face(fe, i, f))
        {
          const double value = field(dofs[i]);
          squares[fe.system_to_component_index(i).second] += value * value;
        }
      return *std::max_element(squares.begin(), squares.end()) > least * least;
    };
    std::vector<CoarseFacet> own;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned() || !cell->at_boundary())
        continue;
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary()
            || ids.count(cell->face(f)->boundary_id()) == 0
            || !reaches(cell, f))
          continue;
        typename dealii::Triangulation<dim>::cell_iterator coarse = cell;
        // A child has the number of the face that it lies on.
        while (coarse->level() > 0)
          coarse = coarse->parent();
        own.emplace_back(coarse->index(), f);
      }
    }
    std::set<CoarseFacet> result;
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(
             versions::communicator(dof_handler), own))
      result.insert(of_rank.begin(), of_rank.end());
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template class Chords<dim>;                                                  \
  template std::set<CoarseFacet> coarse_facets_above<dim>(                     \
      const dealii::DoFHandler<dim> &,                                         \
      const std::set<dealii::types::boundary_id> &, const la::Vector &,        \
      double);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bodies.h"

#include "by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace abut::shim
{
  template <int dim>
  BodyNumbers<dim>::BodyNumbers(const dealii::Triangulation<dim> &triangulation)
  {
    // Union-find over vertices: cells with a common vertex are one body.
    std::vector<unsigned int> root(triangulation.n_vertices());
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](unsigned int v)
    {
      while (root[v] != v)
        v = root[v] = root[root[v]];
      return v;
    };
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      for (const unsigned int v : cell->vertex_indices())
        root[find(cell->vertex_index(v))] = find(cell->vertex_index(0));

    std::map<unsigned int, unsigned int> number;
    body_.resize(triangulation.n_cells(0));
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      body_[cell->index()] =
          number
              .emplace(find(cell->vertex_index(0)),
                       static_cast<unsigned int>(number.size()))
              .first->second;
    n_bodies_ = static_cast<unsigned int>(number.size());
    if (dynamic_cast<
            const dealii::parallel::fullydistributed::Triangulation<dim> *>(
            &triangulation)
        != nullptr)
      unite_ranks(triangulation);
  }

  template <int dim>
  void
  BodyNumbers<dim>::unite_ranks(const dealii::Triangulation<dim> &triangulation)
  {
    // A body is named by the least of its coarse cells, which ranks exchange
    // over ghost cells until no name changes.
    using Name = dealii::types::coarse_cell_id;
    const MPI_Comm communicator = versions::communicator(triangulation);
    std::vector<Name> name(n_bodies_, dealii::numbers::invalid_coarse_cell_id);
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      name[of(cell)] =
          std::min(name[of(cell)], cell->id().get_coarse_cell_id());
    bool has_changed = true;
    while (has_changed)
    {
      has_changed = false;
      dealii::GridTools::exchange_cell_data_to_ghosts<
          Name, dealii::Triangulation<dim>>(
          triangulation, [&](const auto &cell) { return name[of(cell)]; },
          [&](const auto &cell, const Name &other)
          {
            has_changed = has_changed || other < name[of(cell)];
            name[of(cell)] = std::min(name[of(cell)], other);
          });
      has_changed =
          dealii::Utilities::MPI::logical_or(has_changed, communicator);
    }
    // Parts of artificial cells alone may have names of no owned cell.
    std::set<Name> own, all;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        own.insert(name[of(cell)]);
    for (const auto &some : dealii::Utilities::MPI::all_gather(
             communicator, std::vector<Name>(own.begin(), own.end())))
      all.insert(some.begin(), some.end());
    const std::vector<Name> names(all.begin(), all.end());
    for (unsigned int &body : body_)
    {
      const auto it = std::lower_bound(names.begin(), names.end(), name[body]);
      body = it == names.end() ? 0 : it - names.begin();
    }
    n_bodies_ = static_cast<unsigned int>(names.size());
  }

  template <int dim> unsigned int BodyNumbers<dim>::of(Cell cell) const
  {
    while (cell->level() > 0)
      cell = cell->parent();
    return body_[cell->index()];
  }

  namespace
  {
    /** Places of the nodes of the first field in one cell after the other;
     * others may have no support points. */
    template <int dim> class PlacesInCell
    {
    public:
      PlacesInCell(const dealii::Mapping<dim> &mapping,
                   const dealii::FiniteElement<dim> &fe)
          : mapping_(mapping),
            is_linear_(
                fe.degree == 1 && fe.n_base_elements() == 1
                && dynamic_cast<const dealii::FE_Q<dim> *>(&fe.base_element(0))
                       != nullptr),
            values_(mapping, fe.base_element(0),
                    dealii::Quadrature<dim>(
                        fe.base_element(0).get_unit_support_points()),
                    dealii::update_quadrature_points)
      {
      }

      template <class Cell> void reinit(const Cell &cell)
      {
        // For linear elements the mapped vertices suffice.
        if (is_linear_)
          vertices_ = mapping_.get_vertices(cell);
        else
          values_.reinit(
              static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
                  cell));
      }

      const dealii::Point<dim> &operator[](const unsigned int node) const
      {
        return is_linear_ ? vertices_[node] : values_.quadrature_point(node);
      }

    private:
      const dealii::Mapping<dim> &mapping_;
      const bool is_linear_;
      decltype(std::declval<const dealii::Mapping<dim> &>().get_vertices(
          {})) vertices_;
      dealii::FEValues<dim> values_;
    };
  } // namespace

  template <int dim>
  solve::NearNullSpace
  make_near_null_space(const dealii::Mapping<dim> &mapping,
                       const dealii::DoFHandler<dim> &dof_handler)
  {
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    solve::NearNullSpace space;
    space.n_components = dim;
    const BodyNumbers<dim> bodies(dof_handler.get_triangulation());
    space.n_bodies = bodies.n_bodies();
    space.resize(owned.n_elements());

    const ByElement places_of(dof_handler,
                              [&](const dealii::FiniteElement<dim> &fe)
                              { return PlacesInCell<dim>(mapping, fe); });
    std::vector<dealii::types::global_dof_index> dofs;
    // An unknown of this rank may lie on ghost cells only.
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (cell->is_artificial())
        continue;
      const dealii::FiniteElement<dim> &fe = cell->get_fe();
      PlacesInCell<dim> &places = places_of.of(cell);
      places.reinit(cell);
      get_dofs(cell, dofs);
      const unsigned int body = bodies.of(cell);
      const double share =
          cell->measure() / fe.base_element(0).n_dofs_per_cell();
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        if (!owned.is_element(dofs[i]))
          continue;
        const bool is_displacement =
            fe.is_primitive(i) && fe.system_to_component_index(i).first < dim;
        const unsigned int node =
            is_displacement ? fe.system_to_base_index(i).second : 0;
        space.set(owned.index_within_set(dofs[i]),
                  is_displacement ? fe.system_to_component_index(i).first : dim,
                  static_cast<int>(body), places[node]);
        space.share.change()[owned.index_within_set(dofs[i])] += share;
      }
    }
    return space;
  }

  template <int dim>
  std::vector<int> bodies_with(const dealii::DoFHandler<dim> &dof_handler,
                               const BodyNumbers<dim> &bodies,
                               const std::set<dealii::types::boundary_id> &ids)
  {
    std::vector<int> mine(bodies.n_bodies(), 0);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary()
              && ids.count(cell->face(f)->boundary_id()) > 0)
            mine[bodies.of(cell)] = 1;
    dealii::Utilities::MPI::max(mine, versions::communicator(dof_handler),
                                mine);
    return mine;
  }

  template <int dim>
  double least_extent(const dealii::Mapping<dim> &mapping,
                      const dealii::DoFHandler<dim> &dof_handler,
                      const std::set<dealii::types::boundary_id> &ids)
  {
    namespace MPI = dealii::Utilities::MPI;
    const BodyNumbers<dim> bodies(dof_handler.get_triangulation());
    const std::vector<int> is_meant = bodies_with(dof_handler, bodies, ids);
    // [bodies * dim] of the least coordinates and of the largest, negative.
    std::vector<double> low(dim * bodies.n_bodies(), INFINITY), high(low);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && is_meant[bodies.of(cell)] != 0)
        for (const dealii::Point<dim> &vertex : mapping.get_vertices(cell))
          for (unsigned int d = 0; d < dim; ++d)
          {
            const std::size_t i = dim * bodies.of(cell) + d;
            low[i] = std::min(low[i], vertex[d]);
            high[i] = std::min(high[i], -vertex[d]);
          }
    MPI::min(low, versions::communicator(dof_handler), low);
    MPI::min(high, versions::communicator(dof_handler), high);
    double least = INFINITY;
    for (std::size_t i = 0; i < low.size(); ++i)
      if (is_meant[i / dim] != 0)
        least = std::min(least, -high[i] - low[i]);
    return least;
  }

  template double least_extent(const dealii::Mapping<2> &,
                               const dealii::DoFHandler<2> &,
                               const std::set<dealii::types::boundary_id> &);
  template double least_extent(const dealii::Mapping<3> &,
                               const dealii::DoFHandler<3> &,
                               const std::set<dealii::types::boundary_id> &);
  template std::vector<int>
  bodies_with(const dealii::DoFHandler<2> &, const BodyNumbers<2> &,
              const std::set<dealii::types::boundary_id> &);
  template std::vector<int>
  bodies_with(const dealii::DoFHandler<3> &, const BodyNumbers<3> &,
              const std::set<dealii::types::boundary_id> &);
  template class BodyNumbers<2>;
  template class BodyNumbers<3>;
  template solve::NearNullSpace
  make_near_null_space(const dealii::Mapping<2> &,
                       const dealii::DoFHandler<2> &);
  template solve::NearNullSpace
  make_near_null_space(const dealii::Mapping<3> &,
                       const dealii::DoFHandler<3> &);
} // namespace abut::shim

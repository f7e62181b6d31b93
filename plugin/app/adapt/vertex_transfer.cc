// SPDX-License-Identifier: LGPL-2.1-or-later
#include "vertex_transfer.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>

namespace abut::app
{
  using dealii::types::global_dof_index;

  namespace
  {
    /** Call @p visit(dof, place) for the unknowns of all active cells, where
     * the place is vertex * components + component. */
    template <int dim, typename Visit>
    void for_each_unknown(const dealii::DoFHandler<dim> &dof_handler,
                          const Visit &visit)
    {
      const dealii::FiniteElement<dim> &fe = dof_handler.get_fe();
      const unsigned int n_components = fe.n_components();
      std::vector<global_dof_index> dofs(fe.n_dofs_per_cell());
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto of = fe.system_to_component_index(i);
          visit(dofs[i],
                cell->vertex_index(of.second) * n_components + of.first);
        }
      }
    }
  } // namespace

  template <int dim>
  bool
  VertexTransfer<dim>::is_possible(const dealii::DoFHandler<dim> &dof_handler)
  {
    const dealii::FiniteElement<dim> &fe = dof_handler.get_fe();
    if (dealii::Utilities::MPI::n_mpi_processes(
            versions::communicator(dof_handler))
            > 1
        || fe.degree != 1 || fe.n_base_elements() != 1
        || dynamic_cast<const dealii::FE_Q<dim> *>(&fe.base_element(0))
               == nullptr)
      return false;
    for (const auto &cell :
         dof_handler.get_triangulation().active_cell_iterators())
      if (cell->coarsen_flag_set())
        return false;
    return true;
  }

  template <int dim>
  VertexTransfer<dim>::VertexTransfer(
      const dealii::DoFHandler<dim> &dof_handler,
      const std::vector<la::Vector> &fields)
      : dof_handler_(dof_handler),
        n_components_(dof_handler.get_fe().n_components()),
        values_(fields.size()),
        is_known_(dof_handler.get_triangulation().n_vertices(), false)
  {
    for (std::size_t f = 0; f < fields.size(); ++f)
      keep(fields[f], values_[f]);
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        is_known_[cell->vertex_index(v)] = true;
  }

  template <int dim>
  void VertexTransfer<dim>::keep(const la::Vector &field,
                                 std::vector<double> &values) const
  {
    la::Vector owned(dof_handler_.locally_owned_dofs(),
                     versions::communicator(dof_handler_));
    owned = field;
    const double *const in = la::data(owned);
    values.resize(is_known_.size() * n_components_);
    for_each_unknown(dof_handler_,
                     [&](const global_dof_index dof, const unsigned int place)
                     { values[place] = in[dof]; });
  }

  /** A child's vertex is at one of 3^dim places in its parent, which are 0, 1
   * or 2 in each direction: at a vertex, or between those that it is 1 of. */
  template <int dim> void VertexTransfer<dim>::fill_new_vertices()
  {
    const auto &mesh = dof_handler_.get_triangulation();
    is_known_.resize(mesh.n_vertices(), false);
    for (std::vector<double> &values : values_)
      values.resize(mesh.n_vertices() * n_components_);
    constexpr unsigned int n = dealii::GeometryInfo<dim>::vertices_per_cell;
    for (const auto &cell : mesh.cell_iterators())
    {
      if (!cell->has_children())
        continue;
      for (unsigned int child = 0; child < n; ++child)
        for (unsigned int v = 0; v < n; ++v)
        {
          const unsigned int vertex = cell->child(child)->vertex_index(v);
          if (is_known_[vertex])
            continue;
          is_known_[vertex] = true;
          // Directions in which it is in the middle, and its place in others.
          const unsigned int middle = child ^ v, fixed = child & v;
          unsigned int n_parents = 0, parents[n];
          for (unsigned int w = 0; w < n; ++w)
            if ((w & ~middle) == fixed)
              parents[n_parents++] = cell->vertex_index(w);
          for (std::vector<double> &values : values_)
            for (unsigned int c = 0; c < n_components_; ++c)
            {
              double sum = 0.;
              for (unsigned int p = 0; p < n_parents; ++p)
                sum += values[parents[p] * n_components_ + c];
              values[vertex * n_components_ + c] = sum / n_parents;
            }
        }
    }
  }

  template <int dim> std::vector<la::Vector> VertexTransfer<dim>::interpolate()
  {
    fill_new_vertices();
    std::vector<la::Vector> result(
        values_.size(), la::Vector(dof_handler_.locally_owned_dofs(),
                                   versions::communicator(dof_handler_)));
    std::vector<double *> out;
    for (la::Vector &field : result)
      out.push_back(la::data(field));
    for_each_unknown(dof_handler_,
                     [&](const global_dof_index dof, const unsigned int place)
                     {
                       for (std::size_t f = 0; f < out.size(); ++f)
                         out[f][dof] = values_[f][place];
                     });
    return result;
  }

  template class VertexTransfer<2>;
  template class VertexTransfer<3>;
} // namespace abut::app

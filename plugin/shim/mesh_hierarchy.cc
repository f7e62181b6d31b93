// SPDX-License-Identifier: LGPL-2.1-or-later
// Linear elements have their nodes in the vertices of the mesh, and these stay
// when cells are refined. Mesh l of the hierarchy has the cells of level l and
// those of lower levels that are not refined. What a vertex of it is on mesh
// l - 1 follows from the tree of cells: itself, or the middle of an edge, face
// or cell there.
#include "mesh_hierarchy.h"

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>

#include <algorithm>

namespace abut::shim
{
  namespace
  {
    using solve::MeshHierarchy;

    /** A mesh with at most so many unknowns is coarse enough. */
    constexpr std::size_t coarse_enough = 600;
    /** What can be factorised in each cycle. */
    constexpr std::size_t most_on_coarsest = 4000;

    /** Vertices that a vertex is in the middle of; none: it is no middle. */
    struct Parents
    {
      unsigned int n = 0;
      unsigned int vertex[8] = {};
    };

    template <int dim> class HierarchyMaker
    {
    public:
      using Cell = typename dealii::Triangulation<dim>::cell_iterator;

      HierarchyMaker(const dealii::DoFHandler<dim> &dof_handler,
                     const dealii::AffineConstraints<double> &constraints)
          : dof_handler_(dof_handler),
            triangulation_(dof_handler.get_triangulation()),
            constraints_(constraints),
            n_components_(dof_handler.get_fe().n_components()),
            unknown_(triangulation_.n_vertices() * n_components_,
                     dealii::numbers::invalid_dof_index),
            is_constrained_(unknown_.size()),
            middle_(triangulation_.n_vertices())
      {
      }

      MeshHierarchy make();

    private:
      /** A mesh while it is made. */
      struct Draft
      {
        std::vector<std::int32_t> node; ///< [vertices] -1: not on it
        std::vector<unsigned int> vertex;
        std::vector<std::uint8_t> hangs; ///< [vertices]
      };

      std::string why_not() const;
      void find_unknowns();
      void find_constrained();
      void find_middles();
      std::vector<unsigned int> vertices() const;
      Draft draft(int level, const std::vector<unsigned int> &finer) const;
      void mark_hanging(int level, Draft &mesh) const;
      bool has_other_constraints(const Draft &finest) const;
      std::vector<std::uint8_t> fixed(const Draft &mesh) const;
      bool is_wholly_fixed(const Draft &mesh, unsigned int vertex) const;
      void add_parents(const Draft &coarse, unsigned int vertex, double weight,
                       MeshHierarchy::Mesh &mesh) const;
      void add_weights(const Draft &fine, const Draft &coarse,
                       MeshHierarchy::Mesh &mesh) const;

      const dealii::DoFHandler<dim> &dof_handler_;
      const dealii::Triangulation<dim> &triangulation_;
      const dealii::AffineConstraints<double> &constraints_;
      const unsigned int n_components_;
      /** [vertices * components] */
      std::vector<dealii::types::global_dof_index> unknown_;
      std::vector<std::uint8_t> is_constrained_; ///< the same
      std::vector<Parents> middle_;              ///< [vertices]
    };

    template <int dim> std::string HierarchyMaker<dim>::why_not() const
    {
      const dealii::FiniteElement<dim> &fe = dof_handler_.get_fe();
      if (dealii::Utilities::MPI::n_mpi_processes(
              dof_handler_.get_communicator())
          > 1)
        return "it works on one rank";
      if (fe.n_base_elements() != 1
          || dynamic_cast<const dealii::FE_Q<dim> *>(&fe.base_element(0))
                 == nullptr
          || fe.degree != 1 || n_components_ > 3)
        return "it works with linear elements (FE_Q of degree 1)";
      for (const auto &cell : triangulation_.cell_iterators())
        if (cell->has_children()
            && cell->refinement_case()
                   != dealii::RefinementCase<dim>::isotropic_refinement)
          return "cells are cut in some directions only";
      return "";
    }

    template <int dim> void HierarchyMaker<dim>::find_unknowns()
    {
      const dealii::FiniteElement<dim> &fe = dof_handler_.get_fe();
      std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
      for (const auto &cell : dof_handler_.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto place = fe.system_to_component_index(i);
          unknown_[cell->vertex_index(place.second) * n_components_
                   + place.first] = dofs[i];
        }
      }
      find_constrained();
    }

    /** Constraints are asked once: they take long to find one of a number. */
    template <int dim> void HierarchyMaker<dim>::find_constrained()
    {
      std::vector<std::uint8_t> by_unknown(dof_handler_.n_dofs());
      for (const auto &line : constraints_.get_lines())
        by_unknown[line.index] = 1;
      for (std::size_t i = 0; i < unknown_.size(); ++i)
        is_constrained_[i] = unknown_[i] != dealii::numbers::invalid_dof_index
                             && by_unknown[unknown_[i]] != 0;
    }

    /** The vertex in the middle of an edge, face or cell that is refined. */
    template <typename Object>
    void note_middle(const Object &object, std::vector<Parents> &middle)
    {
      const unsigned int n = object->n_vertices();
      Parents &parents = middle[object->child(0)->vertex_index(n - 1)];
      if (parents.n > 0)
        return;
      parents.n = n;
      for (unsigned int v = 0; v < n; ++v)
        parents.vertex[v] = object->vertex_index(v);
    }

    template <int dim> void HierarchyMaker<dim>::find_middles()
    {
      // What is refined belongs to a cell that is.
      for (const auto &cell : triangulation_.cell_iterators())
      {
        if (!cell->has_children())
          continue;
        for (const unsigned int line : cell->line_indices())
          note_middle(cell->line(line), middle_);
        if constexpr (dim == 3)
          for (const unsigned int face : cell->face_indices())
            note_middle(cell->face(face), middle_);
        note_middle(cell, middle_);
      }
    }

    template <int dim>
    void HierarchyMaker<dim>::mark_hanging(const int level, Draft &mesh) const
    {
      const auto mark = [&](const auto &object)
      {
        if (object->has_children())
          mesh.hangs[object->child(0)->vertex_index(object->n_vertices() - 1)] =
              1;
      };
      for (int l = 0; l < level; ++l)
        for (const auto &cell : triangulation_.cell_iterators_on_level(l))
        {
          if (!cell->is_active())
            continue;
          for (const unsigned int line : cell->line_indices())
            mark(cell->line(line));
          if constexpr (dim == 3)
            for (const unsigned int face : cell->face_indices())
              mark(cell->face(face));
        }
    }

    /** Those with unknowns, in the order of the matrix for the sake of caches.
     */
    template <int dim>
    std::vector<unsigned int> HierarchyMaker<dim>::vertices() const
    {
      constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
      std::vector<unsigned int> by_unknown(dof_handler_.n_dofs(), none), result;
      for (unsigned int v = 0; v < triangulation_.n_vertices(); ++v)
        if (unknown_[v * n_components_] != dealii::numbers::invalid_dof_index)
          by_unknown[unknown_[v * n_components_]] = v;
      for (const unsigned int v : by_unknown)
        if (v != none)
          result.push_back(v);
      return result;
    }

    template <int dim>
    typename HierarchyMaker<dim>::Draft
    HierarchyMaker<dim>::draft(const int level,
                               const std::vector<unsigned int> &finer) const
    {
      Draft mesh;
      mesh.node.assign(triangulation_.n_vertices(), -1);
      mesh.hangs.assign(triangulation_.n_vertices(), 0);
      for (int l = 0; l <= level; ++l)
        for (const auto &cell : triangulation_.cell_iterators_on_level(l))
          if (l == level || cell->is_active())
            for (const unsigned int v : cell->vertex_indices())
              mesh.node[cell->vertex_index(v)] = 0;
      for (const unsigned int v : finer)
        if (mesh.node[v] == 0)
        {
          mesh.node[v] = static_cast<std::int32_t>(mesh.vertex.size());
          mesh.vertex.push_back(v);
        }
      mark_hanging(level, mesh);
      return mesh;
    }

    template <int dim>
    bool HierarchyMaker<dim>::has_other_constraints(const Draft &finest) const
    {
      for (const unsigned int v : finest.vertex)
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          const auto *const entries = constraints_.get_constraint_entries(
              unknown_[v * n_components_ + c]);
          if (entries != nullptr && !entries->empty() && !finest.hangs[v])
            return true;
        }
      return false;
    }

    template <int dim>
    std::vector<std::uint8_t>
    HierarchyMaker<dim>::fixed(const Draft &mesh) const
    {
      std::vector<std::uint8_t> result(mesh.vertex.size() * n_components_);
      for (std::size_t i = 0; i < result.size(); ++i)
      {
        const unsigned int v = mesh.vertex[i / n_components_];
        result[i] =
            mesh.hangs[v]
            || is_constrained_[v * n_components_ + i % n_components_] != 0;
      }
      return result;
    }

    template <int dim>
    bool HierarchyMaker<dim>::is_wholly_fixed(const Draft &mesh,
                                              const unsigned int vertex) const
    {
      bool result = true;
      for (unsigned int c = 0; c < n_components_ && result; ++c)
        result = mesh.hangs[vertex]
                 || is_constrained_[vertex * n_components_ + c] != 0;
      return result;
    }

    template <int dim>
    void HierarchyMaker<dim>::add_parents(const Draft &coarse,
                                          const unsigned int vertex,
                                          const double weight,
                                          MeshHierarchy::Mesh &mesh) const
    {
      if (coarse.node[vertex] >= 0 && !coarse.hangs[vertex])
      {
        if (is_wholly_fixed(coarse, vertex))
          return;
        const auto first = mesh.parent.begin() + mesh.start.back();
        const auto same =
            std::find(first, mesh.parent.end(), coarse.node[vertex]);
        if (same != mesh.parent.end())
        {
          mesh.weight[same - mesh.parent.begin()] += weight;
          return;
        }
        mesh.parent.push_back(coarse.node[vertex]);
        mesh.weight.push_back(weight);
        return;
      }
      const Parents &parents = middle_[vertex];
      for (unsigned int k = 0; k < parents.n; ++k)
        add_parents(coarse, parents.vertex[k], weight / parents.n, mesh);
    }

    template <int dim>
    void HierarchyMaker<dim>::add_weights(const Draft &fine,
                                          const Draft &coarse,
                                          MeshHierarchy::Mesh &mesh) const
    {
      // Hanging nodes of the coarse mesh alone may have more.
      std::size_t n = 0;
      for (const unsigned int v : fine.vertex)
        n += coarse.node[v] >= 0 ? 1 : middle_[v].n;
      mesh.parent.reserve(n);
      mesh.weight.reserve(n);
      mesh.start.reserve(fine.vertex.size() + 1);
      mesh.start = {0};
      for (const unsigned int v : fine.vertex)
      {
        if (!is_wholly_fixed(fine, v))
          add_parents(coarse, v, 1., mesh);
        mesh.start.push_back(static_cast<std::int64_t>(mesh.parent.size()));
      }
    }

    template <int dim> MeshHierarchy HierarchyMaker<dim>::make()
    {
      MeshHierarchy result;
      result.n_components = n_components_;
      result.missing = why_not();
      if (!result.missing.empty())
        return result;
      find_unknowns();
      find_middles();
      int level = static_cast<int>(triangulation_.n_levels()) - 1;
      Draft fine = draft(level, vertices());
      if (has_other_constraints(fine))
        result.missing = "unknowns are tied to others";
      for (const unsigned int v : fine.vertex)
        for (unsigned int c = 0; c < n_components_; ++c)
          result.unknown.push_back(
              static_cast<std::int32_t>(unknown_[v * n_components_ + c]));
      for (;; --level)
      {
        MeshHierarchy::Mesh mesh;
        const std::size_t n = fine.vertex.size();
        mesh.n_nodes = static_cast<std::int32_t>(n);
        mesh.fixed = fixed(fine);
        const bool is_last = level == 0 || n * n_components_ <= coarse_enough;
        Draft coarse = is_last ? Draft() : draft(level - 1, fine.vertex);
        if (!is_last)
          add_weights(fine, coarse, mesh);
        result.meshes.push_back(std::move(mesh));
        if (is_last)
          break;
        fine = std::move(coarse);
      }
      const std::size_t n = fine.vertex.size() * n_components_;
      if (n > most_on_coarsest)
        result.missing = "the coarsest mesh has " + std::to_string(n)
                         + " unknowns, more than "
                         + std::to_string(most_on_coarsest);
      return result;
    }
  } // namespace

  template <int dim>
  solve::MeshHierarchy
  make_mesh_hierarchy(const dealii::DoFHandler<dim> &dof_handler,
                      const dealii::AffineConstraints<double> &constraints)
  {
    return HierarchyMaker<dim>(dof_handler, constraints).make();
  }

  template solve::MeshHierarchy
  make_mesh_hierarchy(const dealii::DoFHandler<2> &,
                      const dealii::AffineConstraints<double> &);
  template solve::MeshHierarchy
  make_mesh_hierarchy(const dealii::DoFHandler<3> &,
                      const dealii::AffineConstraints<double> &);
} // namespace abut::shim

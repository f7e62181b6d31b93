// SPDX-License-Identifier: LGPL-2.1-or-later
// Linear elements have their nodes in the vertices of the mesh, and these stay
// when cells are refined. Mesh l of the hierarchy has the cells of level l and
// those of lower levels that are not refined. The place of a vertex on mesh l -
// 1 follows from the tree of cells: itself, or the middle of an edge, face or
// cell there. With triangles and tetrahedra that were refined without a tree,
// each vertex has the ends of the edge that it is the middle of.
//
// Quadratic elements have one mesh more: their own nodes follow from the
// vertices of the same cells, of which linear functions are quadratic ones,
// too.
//
// On several ranks each has the vertices whose unknowns it owns. All that they
// follow from are corners of cells that its own cells were refined from: these
// are in its tree, but all other data of such a corner only its owner has. See
// shared_vertices.h for how they find each other.
#include "mesh_hierarchy.h"

#include "agree.h"
#include "cell_quadrature.h"
#include "quadratic_nodes.h"
#include "shared_vertices.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace
  {
    using solve::MeshHierarchy;
    using Parents = VertexParents;

    /** A mesh with at most so many unknowns is coarse enough. */
    constexpr std::size_t coarse_enough = 600;
    /** With which part of the vertices a mesh is worth a level. */
    constexpr double fewer = 0.7;
    /** Unknowns that can be factorised in each cycle. */
    constexpr std::size_t most_on_coarsest = 4000;

    const char *const tied_unknowns = "unknowns are tied to others";

    template <int dim> class HierarchyMaker
    {
    public:
      HierarchyMaker(const dealii::DoFHandler<dim> &dof_handler,
                     const dealii::AffineConstraints<double> &constraints,
                     const std::vector<VertexOrigin> &origins)
          : dof_handler_(dof_handler),
            triangulation_(dof_handler.get_triangulation()),
            constraints_(constraints),
            origins_(origins),
            communicator_(versions::communicator(dof_handler)),
            n_components_(dof_handler.get_fe().n_components()),
            is_simplex_(is_simplex(dof_handler.get_fe())),
            first_own_(dof_handler.n_locally_owned_dofs() == 0
                           ? 0
                           : *dof_handler.locally_owned_dofs().begin()),
            end_own_(first_own_ + dof_handler.n_locally_owned_dofs()),
            unknown_(triangulation_.n_vertices() * n_components_,
                     dealii::numbers::invalid_dof_index),
            is_constrained_(dof_handler.n_dofs()),
            middle_(triangulation_.n_vertices()),
            level_(triangulation_.n_vertices(), no_level),
            hangs_(triangulation_.n_vertices(), 0),
            is_wholly_fixed_(triangulation_.n_vertices(), 0)
      {
      }

      MeshHierarchy make();

    private:
      static constexpr std::uint8_t no_level = 255;

      /** A mesh while it is made. */
      struct Draft
      {
        std::vector<std::int32_t> node;   ///< [vertices] number; -1: none, or
                                          ///< another rank's of no interest
        std::vector<unsigned int> vertex; ///< of the own nodes
        std::int32_t first = 0, n_all = 0;
        unsigned int level = 0;
      };

      std::string why_not() const;
      void find_unknowns();
      void find_constrained();
      template <typename Object>
      void record_middle(const Object &object, unsigned int level);
      void take_origins();
      bool find_middles();
      void record_coarsest_cells();
      bool is_uniform() const;
      void mark_hanging();
      void mark_fixed();
      bool is_own(unsigned int vertex) const;
      std::vector<unsigned int> own_vertices() const;
      Draft draft(unsigned int level,
                  const std::vector<unsigned int> &finer) const;
      std::vector<Draft> drafts() const;
      void learn_of_others(std::vector<Draft> &meshes, std::size_t first);
      bool is_tied(dealii::types::global_dof_index unknown) const;
      void take_vertices(const Draft &finest, MeshHierarchy &result) const;
      void take_quadratic_nodes(const Draft &vertices, MeshHierarchy &result);
      std::vector<std::uint8_t> fixed(const Draft &mesh) const;
      void add_parents(const Draft &coarse, unsigned int vertex, double weight,
                       MeshHierarchy::Mesh &mesh);
      bool add_plain_parents(const Draft &coarse, unsigned int vertex,
                             MeshHierarchy::Mesh &mesh) const;
      void add_weights(const Draft &fine, const Draft &coarse,
                       MeshHierarchy::Mesh &mesh);

      const dealii::DoFHandler<dim> &dof_handler_;
      const dealii::Triangulation<dim> &triangulation_;
      const dealii::AffineConstraints<double> &constraints_;
      const std::vector<VertexOrigin> &origins_;
      const MPI_Comm communicator_;
      const unsigned int n_components_;
      const bool is_simplex_; ///< cells are triangles or tetrahedra
      const dealii::types::global_dof_index first_own_, end_own_;
      /** [vertices * components] */
      std::vector<dealii::types::global_dof_index> unknown_;
      std::vector<std::uint8_t> is_constrained_; ///< [unknowns of all ranks]
      std::vector<Parents> middle_;              ///< [vertices]
      /** [vertices] of the coarsest mesh that it is a corner in. */
      std::vector<std::uint8_t> level_;
      /** [vertices] the same on all meshes that it is on; for vertices of other
       * ranks their answer. */
      std::vector<std::uint8_t> hangs_, is_wholly_fixed_;
      bool is_lost_ = false; ///< a vertex that must be known is not
    };

    /** Whether coarse cells and their vertices have the same numbers on all
     * ranks. */
    template <int dim>
    bool knows_coarse_mesh(const dealii::Triangulation<dim> &triangulation)
    {
      using namespace dealii::parallel;
      return dynamic_cast<const distributed::Triangulation<dim> *>(
                 &triangulation)
                 != nullptr
             || dynamic_cast<const shared::Triangulation<dim> *>(&triangulation)
                    != nullptr;
    }

    /** Whether nodes are vertices, and of quadratic elements middles. */
    template <int dim>
    bool has_known_nodes(const dealii::FiniteElement<dim> &element)
    {
      bool are_middles = element.degree <= 2;
      for (const dealii::Point<dim> &point : element.get_unit_support_points())
        for (unsigned int d = 0; d < dim; ++d)
          are_middles =
              are_middles
              && std::abs(2. * point[d] - std::round(2. * point[d])) < 1e-12;
      return are_middles;
    }

    template <int dim> std::string HierarchyMaker<dim>::why_not() const
    {
      const dealii::FiniteElement<dim> &fe = dof_handler_.get_fe();
      if (dealii::Utilities::MPI::n_mpi_processes(communicator_) > 1
          && !knows_coarse_mesh(triangulation_))
        return "the coarsest mesh is not on all ranks";
      const auto is_known = [](const dealii::FiniteElement<dim> &base)
      {
        return (dynamic_cast<const dealii::FE_Q<dim> *>(&base) != nullptr
                || dynamic_cast<const dealii::FE_SimplexP<dim> *>(&base)
                       != nullptr)
               && has_known_nodes(base);
      };
      if (dof_handler_.get_fe_collection().size() > 1)
        return "there are cells of two kinds";
      if (fe.n_base_elements() != 1 || n_components_ > 3
          || !is_known(fe.base_element(0)))
        return "it works with FE_Q and FE_SimplexP of degree 1 and 2";
      for (const VertexOrigin &origin : origins_)
        if (origin.level >= no_level)
          return "the mesh was refined too often";
      return "";
    }

    template <int dim> void HierarchyMaker<dim>::find_unknowns()
    {
      const dealii::FiniteElement<dim> &fe = dof_handler_.get_fe();
      std::vector<dealii::types::global_dof_index> dofs(fe.n_dofs_per_cell());
      for (const auto &cell : dof_handler_.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const auto place = fe.system_to_component_index(i);
          if (place.second < cell->n_vertices())
            unknown_[cell->vertex_index(place.second) * n_components_
                     + place.first] = dofs[i];
        }
      }
      find_constrained();
    }

    /** Constraints are read once: a search for the one of a number is slow. */
    template <int dim> void HierarchyMaker<dim>::find_constrained()
    {
      for (const auto &line : constraints_.get_lines())
        is_constrained_[line.index] = 1;
    }

    template <int dim>
    bool HierarchyMaker<dim>::is_own(const unsigned int v) const
    {
      const auto unknown = unknown_[v * n_components_];
      return unknown >= first_own_ && unknown < end_own_;
    }

    /** The vertex in the middle of an edge, face or cell of a level that is
     * refined: there it was made, and all cells that it is a corner in are of
     * the next level or finer. */
    template <int dim>
    template <typename Object>
    void HierarchyMaker<dim>::record_middle(const Object &object,
                                            const unsigned int level)
    {
      const unsigned int n = object->n_vertices();
      const unsigned int vertex = object->child(0)->vertex_index(n - 1);
      Parents &parents = middle_[vertex];
      if (parents.n > 0)
        return;
      level_[vertex] = static_cast<std::uint8_t>(level + 1);
      parents.n = n;
      for (unsigned int v = 0; v < n; ++v)
        parents.vertex[v] = object->vertex_index(v);
    }

    template <int dim> void HierarchyMaker<dim>::take_origins()
    {
      for (unsigned int v = 0; v < origins_.size(); ++v)
      {
        level_[v] = static_cast<std::uint8_t>(origins_[v].level);
        if (origins_[v].level == 0)
          continue;
        middle_[v].n = 2;
        std::copy(origins_[v].ends.begin(), origins_[v].ends.end(),
                  middle_[v].vertex);
      }
    }

    /** Returns whether all cells are cut in all directions. */
    template <int dim> bool HierarchyMaker<dim>::find_middles()
    {
      if (!origins_.empty())
      {
        take_origins();
        return true;
      }
      const auto isotropic = dealii::RefinementCase<dim>::isotropic_refinement;
      for (const auto &cell : triangulation_.cell_iterators_on_level(0))
        for (const unsigned int v : cell->vertex_indices())
          level_[cell->vertex_index(v)] = 0;
      // Refined parts belong to a refined cell.
      for (unsigned int l = 0; l + 1 < triangulation_.n_levels(); ++l)
        for (const auto &cell : triangulation_.cell_iterators_on_level(l))
        {
          if (!cell->has_children())
            continue;
          if (!is_simplex_ && cell->refinement_case() != isotropic)
            return false;
          for (const unsigned int line : cell->line_indices())
            record_middle(cell->line(line), l);
          if (is_simplex_)
            continue;
          if constexpr (dim == 3)
            for (const unsigned int face : cell->face_indices())
              record_middle(cell->face(face), l);
          record_middle(cell, l);
        }
      return true;
    }

    /** Record the vertices in the middles of cells for other ranks. */
    template <int dim> void HierarchyMaker<dim>::record_coarsest_cells()
    {
      for (const auto &cell : triangulation_.cell_iterators())
      {
        if (is_simplex_ || !cell->has_children())
          continue;
        typename dealii::Triangulation<dim>::cell_iterator coarsest = cell;
        while (coarsest->level() > 0)
          coarsest = coarsest->parent();
        middle_[cell->child(0)->vertex_index(cell->n_vertices() - 1)].cell =
            coarsest->index() + 1;
      }
    }

    /** Whether all active cells are of one level, so that nothing hangs. */
    template <int dim> bool HierarchyMaker<dim>::is_uniform() const
    {
      return triangulation_.n_active_cells()
             == triangulation_.n_cells(triangulation_.n_levels() - 1);
    }

    template <int dim> void HierarchyMaker<dim>::mark_hanging()
    {
      const auto mark = [&](const auto &object)
      {
        if (object->has_children())
          hangs_[object->child(0)->vertex_index(object->n_vertices() - 1)] = 1;
      };
      if (is_uniform())
        return;
      // That of artificial cells may be refined elsewhere.
      for (const auto &cell : triangulation_.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        for (const unsigned int line : cell->line_indices())
          mark(cell->line(line));
        if constexpr (dim == 3)
          if (!is_simplex_)
            for (const unsigned int face : cell->face_indices())
              mark(cell->face(face));
      }
    }

    template <int dim> void HierarchyMaker<dim>::mark_fixed()
    {
      for (unsigned int v = 0; v < hangs_.size(); ++v)
      {
        if (unknown_[v * n_components_] == dealii::numbers::invalid_dof_index)
          continue;
        bool all = true;
        for (unsigned int c = 0; c < n_components_ && all; ++c)
          all = hangs_[v] || is_constrained_[unknown_[v * n_components_ + c]];
        is_wholly_fixed_[v] = all;
      }
    }

    /** The number of the first own node over all ranks, and how many there
     * are. */
    void number_over_ranks(const MPI_Comm communicator, const std::int32_t n,
                           std::int32_t &first, std::int32_t &n_all)
    {
      namespace MPI = dealii::Utilities::MPI;
      const unsigned int me = MPI::this_mpi_process(communicator);
      const std::vector<std::int32_t> all = MPI::all_gather(communicator, n);
      first = n_all = 0;
      for (unsigned int rank = 0; rank < all.size(); ++rank)
      {
        first += rank < me ? all[rank] : 0;
        n_all += all[rank];
      }
    }

    /** In the order of the matrix for the sake of caches. */
    template <int dim>
    std::vector<unsigned int> HierarchyMaker<dim>::own_vertices() const
    {
      constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
      std::vector<unsigned int> by_unknown(end_own_ - first_own_, none), result;
      result.reserve(by_unknown.size() / n_components_);
      for (unsigned int v = 0; v < triangulation_.n_vertices(); ++v)
        if (is_own(v))
          by_unknown[unknown_[v * n_components_] - first_own_] = v;
      for (const unsigned int v : by_unknown)
        if (v != none)
          result.push_back(v);
      return result;
    }

    template <int dim>
    typename HierarchyMaker<dim>::Draft
    HierarchyMaker<dim>::draft(const unsigned int level,
                               const std::vector<unsigned int> &finer) const
    {
      Draft mesh;
      mesh.level = level;
      for (const unsigned int v : finer)
        if (level_[v] <= level)
          mesh.vertex.push_back(v);
      const auto n = static_cast<std::int32_t>(mesh.vertex.size());
      number_over_ranks(communicator_, n, mesh.first, mesh.n_all);
      mesh.node.assign(triangulation_.n_vertices(), -1);
      for (std::int32_t i = 0; i < n; ++i)
        mesh.node[mesh.vertex[i]] = mesh.first + i;
      return mesh;
    }

    /** From the finest to the first that is coarse enough. */
    template <int dim>
    std::vector<typename HierarchyMaker<dim>::Draft>
    HierarchyMaker<dim>::drafts() const
    {
      std::vector<Draft> result;
      unsigned int level = triangulation_.n_global_levels() - 1;
      for (const VertexOrigin &origin : origins_)
        level = std::max(level, origin.level);
      result.push_back(draft(level, own_vertices()));
      while (level > 0
             && static_cast<std::size_t>(result.back().n_all) * n_components_
                    > coarse_enough)
      {
        Draft coarser = draft(--level, result.back().vertex);
        // Refinements of a part of the cells may add little each.
        if (origins_.empty() || level == 0
            || coarser.n_all < fewer * result.back().n_all)
          result.push_back(std::move(coarser));
      }
      return result;
    }

    /** Corners of the cells that own cells were refined from. */
    template <int dim>
    std::vector<bool>
    corners_above(const dealii::Triangulation<dim> &triangulation)
    {
      std::vector<bool> result(triangulation.n_vertices(), false);
      std::vector<std::vector<bool>> seen(triangulation.n_levels());
      for (unsigned int l = 0; l < seen.size(); ++l)
        seen[l].resize(triangulation.n_raw_cells(l), false);
      for (const auto &active : triangulation.active_cell_iterators())
      {
        if (!active->is_locally_owned())
          continue;
        typename dealii::Triangulation<dim>::cell_iterator cell = active;
        while (!seen[cell->level()][cell->index()])
        {
          seen[cell->level()][cell->index()] = true;
          for (const unsigned int v : cell->vertex_indices())
            result[cell->vertex_index(v)] = true;
          if (cell->level() > 0)
            cell = cell->parent();
        }
      }
      return result;
    }

    /** Vertices of own cells, and those that they were made between. */
    template <int dim>
    std::vector<bool>
    ends_above(const dealii::Triangulation<dim> &triangulation,
               const std::vector<VertexOrigin> &origins)
    {
      std::vector<bool> result(triangulation.n_vertices(), false);
      std::vector<unsigned int> next;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            next.push_back(cell->vertex_index(v));
      while (!next.empty())
      {
        const unsigned int v = next.back();
        next.pop_back();
        if (result[v])
          continue;
        result[v] = true;
        if (origins[v].level > 0)
          next.insert(next.end(), origins[v].ends.begin(),
                      origins[v].ends.end());
      }
      return result;
    }

    /** Learn the numbers of vertices of others on mesh @p first, which is the
     * finest with nodes that others follow from, and on coarser ones. */
    template <int dim>
    void HierarchyMaker<dim>::learn_of_others(std::vector<Draft> &meshes,
                                              const std::size_t first)
    {
      const std::vector<VertexKey> keys = vertex_keys(middle_);
      const unsigned int n_words = meshes.size() - first + 1;
      std::vector<VertexKey> known, wanted;
      std::vector<unsigned int> vertices;
      solve::Words words;
      for (const unsigned int v : meshes[first].vertex)
      {
        known.push_back(keys[v]);
        words.push_back(2 * hangs_[v] + is_wholly_fixed_[v]);
        for (std::size_t l = first; l < meshes.size(); ++l)
          words.push_back(meshes[l].node[v] + 1);
      }
      const std::vector<bool> corners =
          origins_.empty() ? corners_above(triangulation_)
                           : ends_above(triangulation_, origins_);
      for (unsigned int v = 0; v < corners.size(); ++v)
        if (corners[v] && level_[v] <= meshes[first].level && !is_own(v))
        {
          vertices.push_back(v);
          wanted.push_back(keys[v]);
        }
      const solve::Words answer =
          find_vertices(communicator_, known, words, n_words, wanted);
      auto word = answer.begin();
      for (const unsigned int v : vertices)
      {
        is_lost_ = is_lost_ || *word == unknown_vertex;
        hangs_[v] = (*word & 2) != 0;
        is_wholly_fixed_[v] = *word & 1;
        ++word;
        for (std::size_t l = first; l < meshes.size(); ++l)
          meshes[l].node[v] = static_cast<std::int32_t>(*word++) - 1;
      }
    }

    /** Whether an unknown follows from others. */
    template <int dim>
    bool HierarchyMaker<dim>::is_tied(
        const dealii::types::global_dof_index unknown) const
    {
      if (is_constrained_[unknown] == 0)
        return false;
      const auto *const entries = constraints_.get_constraint_entries(unknown);
      return entries != nullptr && !entries->empty();
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
            hangs_[v] != 0
            || is_constrained_[unknown_[v * n_components_ + i % n_components_]]
                   != 0;
      }
      return result;
    }

    template <int dim>
    void HierarchyMaker<dim>::add_parents(const Draft &coarse,
                                          const unsigned int vertex,
                                          const double weight,
                                          MeshHierarchy::Mesh &mesh)
    {
      if (level_[vertex] <= coarse.level && !hangs_[vertex])
      {
        const std::int32_t node = coarse.node[vertex];
        is_lost_ = is_lost_ || node < 0;
        if (is_wholly_fixed_[vertex])
          return;
        const auto first = mesh.parent.begin() + mesh.start.back();
        const auto same = std::find(first, mesh.parent.end(), node);
        if (same != mesh.parent.end())
        {
          mesh.weight[same - mesh.parent.begin()] += weight;
          return;
        }
        mesh.parent.push_back(node);
        mesh.weight.push_back(weight);
        return;
      }
      const Parents &parents = middle_[vertex];
      for (unsigned int k = 0; k < parents.n; ++k)
        add_parents(coarse, parents.vertex[k], weight / parents.n, mesh);
    }

    /** The same for a vertex whose parents are all nodes of the coarse mesh;
     * false: they are not, and nothing was added. */
    template <int dim>
    bool HierarchyMaker<dim>::add_plain_parents(const Draft &coarse,
                                                const unsigned int vertex,
                                                MeshHierarchy::Mesh &mesh) const
    {
      const auto is_node = [&](const unsigned int v) {
        return coarse.node[v] >= 0 && !hangs_[v] && level_[v] <= coarse.level;
      };
      if (is_node(vertex))
      {
        mesh.parent.push_back(coarse.node[vertex]);
        mesh.weight.push_back(1.);
        return true;
      }
      const Parents &parents = middle_[vertex];
      bool are_nodes = level_[vertex] > coarse.level && parents.n > 0;
      for (unsigned int k = 0; k < parents.n; ++k)
        are_nodes = are_nodes && is_node(parents.vertex[k]);
      if (!are_nodes)
        return false;
      for (unsigned int k = 0; k < parents.n; ++k)
        if (!is_wholly_fixed_[parents.vertex[k]])
        {
          mesh.parent.push_back(coarse.node[parents.vertex[k]]);
          mesh.weight.push_back(1. / parents.n);
        }
      return true;
    }

    template <int dim>
    void HierarchyMaker<dim>::add_weights(const Draft &fine,
                                          const Draft &coarse,
                                          MeshHierarchy::Mesh &mesh)
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
        if (!is_wholly_fixed_[v] && !add_plain_parents(coarse, v, mesh))
          add_parents(coarse, v, 1., mesh);
        mesh.start.push_back(static_cast<std::int64_t>(mesh.parent.size()));
      }
    }

    /** The unknowns of linear elements. */
    template <int dim>
    void HierarchyMaker<dim>::take_vertices(const Draft &finest,
                                            MeshHierarchy &result) const
    {
      for (const unsigned int v : finest.vertex)
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          const auto unknown = unknown_[v * n_components_ + c];
          result.unknown.push_back(static_cast<std::int32_t>(unknown));
          if (!hangs_[v] && is_tied(unknown))
            result.missing = tied_unknowns;
        }
    }

    /** The finest mesh of quadratic elements, above that of their vertices. */
    template <int dim>
    void HierarchyMaker<dim>::take_quadratic_nodes(const Draft &vertices,
                                                   MeshHierarchy &result)
    {
      const std::vector<QuadraticNode> nodes =
          own_quadratic_nodes(dof_handler_, hangs_);
      MeshHierarchy::Mesh mesh;
      mesh.n_nodes = static_cast<std::int32_t>(nodes.size());
      number_over_ranks(communicator_, mesh.n_nodes, mesh.first, mesh.n_all);
      mesh.start = {0};
      for (const QuadraticNode &node : nodes)
      {
        bool is_wholly_fixed = true;
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          const bool is_fixed =
              node.hangs || is_constrained_[node.unknown[c]] != 0;
          mesh.fixed.push_back(is_fixed);
          is_wholly_fixed = is_wholly_fixed && is_fixed;
          result.unknown.push_back(static_cast<std::int32_t>(node.unknown[c]));
          if (!node.hangs && is_tied(node.unknown[c]))
            result.missing = tied_unknowns;
        }
        for (unsigned int k = 0; k < node.n_vertices && !is_wholly_fixed; ++k)
          add_parents(vertices, node.vertex[k], 1. / node.n_vertices, mesh);
        mesh.start.push_back(static_cast<std::int64_t>(mesh.parent.size()));
      }
      result.meshes.push_back(std::move(mesh));
    }

    template <int dim> MeshHierarchy HierarchyMaker<dim>::make()
    {
      MeshHierarchy result;
      result.n_components = n_components_;
      std::string missing = why_not();
      if (missing.empty() && !find_middles())
        missing = "cells are cut in some directions only";
      result.missing = first_message(communicator_, missing);
      if (!result.missing.empty())
        return result;
      find_unknowns();
      mark_hanging();
      mark_fixed();
      std::vector<Draft> meshes = drafts();
      const bool is_quadratic = dof_handler_.get_fe().degree == 2;
      const std::size_t first = is_quadratic ? 0 : 1;
      if (dealii::Utilities::MPI::n_mpi_processes(communicator_) > 1
          && meshes.size() > first)
      {
        record_coarsest_cells();
        learn_of_others(meshes, first);
      }
      if (is_quadratic)
        take_quadratic_nodes(meshes[0], result);
      else
        take_vertices(meshes[0], result);
      for (std::size_t l = 0; l < meshes.size(); ++l)
      {
        MeshHierarchy::Mesh mesh;
        mesh.n_nodes = static_cast<std::int32_t>(meshes[l].vertex.size());
        mesh.first = meshes[l].first;
        mesh.n_all = meshes[l].n_all;
        mesh.fixed = fixed(meshes[l]);
        if (l + 1 < meshes.size())
          add_weights(meshes[l], meshes[l + 1], mesh);
        result.meshes.push_back(std::move(mesh));
        meshes[l] = {};
      }
      if (is_lost_)
        result.missing = "the ranks do not agree on the coarser meshes";
      const std::size_t n =
          std::size_t(result.meshes.back().n_all) * n_components_;
      if (n > most_on_coarsest)
        result.missing = "the coarsest mesh has " + std::to_string(n)
                         + " unknowns, more than "
                         + std::to_string(most_on_coarsest);
      result.missing = first_message(communicator_, result.missing);
      return result;
    }
  } // namespace

  template <int dim>
  solve::MeshHierarchy
  make_mesh_hierarchy(const dealii::DoFHandler<dim> &dof_handler,
                      const dealii::AffineConstraints<double> &constraints,
                      const std::vector<VertexOrigin> &origins)
  {
    return HierarchyMaker<dim>(dof_handler, constraints, origins).make();
  }

  template solve::MeshHierarchy
  make_mesh_hierarchy(const dealii::DoFHandler<2> &,
                      const dealii::AffineConstraints<double> &,
                      const std::vector<VertexOrigin> &);
  template solve::MeshHierarchy
  make_mesh_hierarchy(const dealii::DoFHandler<3> &,
                      const dealii::AffineConstraints<double> &,
                      const std::vector<VertexOrigin> &);
} // namespace abut::shim

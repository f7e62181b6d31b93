// SPDX-License-Identifier: LGPL-2.1-or-later
#include "surface_exchange.h"

#include "agree.h"

#include <abut/dealii/contact_pair.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace abut::shim
{
  namespace
  {
    /** Order of the face's nodes, as deal.II's reference cell has them, that
     * makes the normal point out of the cell. */
    template <int dim>
    std::vector<unsigned int> outward_order(const abut_facet_kind kind,
                                            const unsigned int face)
    {
      std::vector<unsigned int> order(abut_facet_n_nodes(kind));
      std::iota(order.begin(), order.end(), 0u);
      if (dim == 2 ? face == 1 || face == 2 : face % 2 == 1)
        return order;
      if (dim == 2)
        std::swap(order[0], order[1]);
      else
      {
        std::swap(order[1], order[2]);
        if (kind == ABUT_FACET_QUAD9)
        {
          std::swap(order[4], order[6]);
          std::swap(order[5], order[7]);
        }
      }
      return order;
    }

    /** All ranks' parts one after the other. Collective. */
    template <typename Number>
    std::vector<Number> concatenate(const std::vector<Number> &mine,
                                    const MPI_Comm communicator)
    {
      namespace MPI = dealii::Utilities::MPI;
      const int n_ranks = static_cast<int>(MPI::n_mpi_processes(communicator));
      const int bytes = static_cast<int>(mine.size() * sizeof(Number));
      std::vector<int> counts(n_ranks), starts(n_ranks + 1, 0);
      MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT,
                    communicator);
      std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
      std::vector<Number> all(starts[n_ranks] / sizeof(Number));
      MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(),
                     starts.data(), MPI_BYTE, communicator);
      return all;
    }
  } // namespace

  template <int dim>
  SurfaceExchange<dim>::SurfaceExchange(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler,
      const dealii::AffineConstraints<double> &constraints,
      const dealii::AffineConstraints<double> &hanging)
      : mapping_(mapping),
        dof_handler_(dof_handler),
        constraints_(constraints),
        hanging_(hanging),
        communicator_(dof_handler.get_communicator())
  {
    tabulate();
  }

  template <int dim> void SurfaceExchange<dim>::tabulate()
  {
    const auto &fe = dof_handler_.get_fe();
    const unsigned int degree = fe.base_element(0).degree;
    const bool is_usable =
        fe.n_components() >= dim && fe.has_support_points()
        && fe.base_element(0).n_components() == 1
        && fe.element_multiplicity(0) >= dim && (degree == 1 || degree == 2)
        && fe.base_element(0).n_dofs_per_vertex() == 1
        && fe.reference_cell() == dealii::ReferenceCells::get_hypercube<dim>();
    if (!is_usable)
      throw ContactError(
          "Contact between bodies needs a displacement in the first "
          + std::to_string(dim)
          + " components of the finite element, made of FE_Q of degree 1 or 2 "
            "(FESystem(FE_Q(degree), "
          + std::to_string(dim) + ")), not " + fe.get_name() + ".");
    kind_ = dim == 2 ? (degree == 1 ? ABUT_FACET_LINE2 : ABUT_FACET_LINE3)
                     : (degree == 1 ? ABUT_FACET_QUAD4 : ABUT_FACET_QUAD9);

    const unsigned int n_nodes = abut_facet_n_nodes(kind_);
    cell_dof_.assign(dealii::GeometryInfo<dim>::faces_per_cell,
                     std::vector<std::array<unsigned int, dim>>(n_nodes));
    for (unsigned int face = 0; face < cell_dof_.size(); ++face)
    {
      const auto order = outward_order<dim>(kind_, face);
      std::vector<unsigned int> place(n_nodes);
      for (unsigned int a = 0; a < n_nodes; ++a)
        place[order[a]] = a;
      for (unsigned int i = 0; i < fe.n_dofs_per_face(face); ++i)
      {
        const auto part = fe.face_system_to_component_index(i, face);
        if (part.first < dim)
          cell_dof_[face][place[part.second]][part.first] =
              fe.face_to_cell_index(i, face);
      }
    }
  }

  template <int dim>
  void SurfaceExchange<dim>::add_node(Message &message,
                                      const dealii::Point<dim> &point,
                                      const std::array<Index, dim> &dof) const
  {
    for (const Index i : dof)
      message.nodes.push_back(i);
    for (unsigned int d = 0; d < dim; ++d)
      message.values.push_back(point[d]);
    const auto add_terms = [&](const auto *terms)
    {
      message.nodes.push_back(terms == nullptr ? 0 : terms->size());
      if (terms != nullptr)
        for (const auto &term : *terms)
        {
          message.nodes.push_back(term.first);
          message.values.push_back(term.second);
        }
    };
    for (const Index i : dof)
    {
      // A free unknown is a line with itself as its only term.
      const bool is_free = !constraints_.is_constrained(i);
      const std::vector<std::pair<Index, double>> itself = {{i, 1.}};
      message.values.push_back(is_free ? 0.
                                       : constraints_.get_inhomogeneity(i));
      add_terms(is_free ? &itself : constraints_.get_constraint_entries(i));
    }
    add_terms(hanging_.get_constraint_entries(dof[0]));
  }

  template <int dim>
  typename SurfaceExchange<dim>::Message SurfaceExchange<dim>::collect(
      const std::set<dealii::types::boundary_id> &boundary_ids) const
  {
    Message message;
    const auto &fe = dof_handler_.get_fe();
    const auto me = dealii::Utilities::MPI::this_mpi_process(communicator_);
    std::vector<Index> dofs(fe.n_dofs_per_cell());
    std::set<Index> known;
    for (const auto &cell : dof_handler_.active_cell_iterators())
    {
      if (!cell->is_locally_owned() || !cell->at_boundary())
        continue;
      cell->get_dof_indices(dofs);
      for (const unsigned int face : cell->face_indices())
      {
        if (!cell->at_boundary(face)
            || boundary_ids.count(cell->face(face)->boundary_id()) == 0)
          continue;
        for (const auto word : cell->id().template to_binary<dim>())
          message.facets.push_back(word);
        message.facets.push_back(face);
        message.facets.push_back(cell->face(face)->boundary_id());
        message.facets.push_back(me);
        for (const auto &local : cell_dof_[face])
        {
          std::array<Index, dim> dof;
          for (unsigned int d = 0; d < dim; ++d)
            dof[d] = dofs[local[d]];
          message.facets.push_back(dof[0]);
          if (known.insert(dof[0]).second)
            add_node(message,
                     mapping_.transform_unit_to_real_cell(
                         cell, fe.unit_support_point(local[0])),
                     dof);
        }
      }
    }
    add_parents(message, known);
    return message;
  }

  template <int dim>
  void SurfaceExchange<dim>::add_parents(Message &message,
                                         std::set<Index> &known) const
  {
    // Parents lie on faces of coarser neighbours, which may have another
    // boundary id or another owner.
    std::set<Index> missing;
    for (const Index dof : known)
      if (const auto *parents = hanging_.get_constraint_entries(dof))
        for (const auto &parent : *parents)
          if (known.count(parent.first) == 0)
            missing.insert(parent.first);
    if (missing.empty())
      return;
    const auto &fe = dof_handler_.get_fe();
    std::vector<Index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler_.active_cell_iterators())
    {
      if (cell->is_artificial())
        continue;
      cell->get_dof_indices(dofs);
      for (const auto &nodes : cell_dof_)
        for (const auto &local : nodes)
          if (missing.erase(dofs[local[0]]) > 0)
          {
            std::array<Index, dim> dof;
            for (unsigned int d = 0; d < dim; ++d)
              dof[d] = dofs[local[d]];
            known.insert(dof[0]);
            add_node(message,
                     mapping_.transform_unit_to_real_cell(
                         cell, fe.unit_support_point(local[0])),
                     dof);
          }
      if (missing.empty())
        return;
    }
  }

  namespace
  {
    /** Nodes in the order in which they came, each once. */
    template <int dim> struct Arrival
    {
      using Surface = ContactSurface<dim>;

      std::vector<typename Surface::Node> nodes;
      std::vector<typename Surface::Line> lines; ///< [nodes * dim]
      std::vector<std::vector<typename Surface::Term>> parents;
      /** Place of a node by its first unknown. */
      std::unordered_map<typename Surface::Index, std::int32_t> place;
    };

    template <int dim>
    Arrival<dim> read_nodes(const std::vector<std::int64_t> &words,
                            const std::vector<double> &values)
    {
      using Surface = ContactSurface<dim>;
      Arrival<dim> arrival;
      std::size_t i = 0, v = 0;
      const auto read_terms = [&]
      {
        std::vector<typename Surface::Term> terms(words[i++]);
        for (auto &term : terms)
          term = {static_cast<typename Surface::Index>(words[i++]),
                  values[v++]};
        return terms;
      };
      while (i < words.size())
      {
        typename Surface::Node node;
        for (auto &dof : node.dof)
          dof = words[i++];
        for (unsigned int d = 0; d < dim; ++d)
          node.point[d] = values[v++];
        std::array<typename Surface::Line, dim> line;
        for (auto &l : line)
        {
          l.constant = values[v++];
          l.terms = read_terms();
        }
        auto parents = read_terms();
        if (!arrival.place.emplace(node.dof[0], arrival.nodes.size()).second)
          continue;
        arrival.nodes.push_back(node);
        arrival.lines.insert(arrival.lines.end(), line.begin(), line.end());
        arrival.parents.push_back(std::move(parents));
      }
      return arrival;
    }

    /** Facets by cell and face, with places of nodes in the arrival. */
    template <int dim>
    std::vector<typename ContactSurface<dim>::Facet>
    read_facets(const std::vector<std::int64_t> &words,
                const Arrival<dim> &arrival, const unsigned int n_nodes)
    {
      const std::size_t stride = 7 + n_nodes;
      std::vector<typename ContactSurface<dim>::Facet> facets(words.size()
                                                              / stride);
      for (std::size_t f = 0; f < facets.size(); ++f)
      {
        auto &facet = facets[f];
        const std::int64_t *word = &words[f * stride];
        for (unsigned int k = 0; k < 4; ++k)
          facet.cell[k] = static_cast<std::uint32_t>(word[k]);
        facet.face = static_cast<std::uint32_t>(word[4]);
        facet.boundary_id = static_cast<dealii::types::boundary_id>(word[5]);
        facet.owner = static_cast<std::uint32_t>(word[6]);
        for (unsigned int a = 0; a < n_nodes; ++a)
          facet.node[a] = arrival.place.at(word[7 + a]);
      }
      std::sort(facets.begin(), facets.end(),
                [](const auto &a, const auto &b) {
                  return std::tie(a.cell, a.face) < std::tie(b.cell, b.face);
                });
      return facets;
    }

    /** Number nodes as facets, then hanging nodes, meet them. */
    template <int dim>
    void number_nodes(Arrival<dim> &arrival, ContactSurface<dim> &surface)
    {
      std::vector<std::int32_t> number(arrival.nodes.size(), -1);
      const auto take = [&](const std::int32_t place)
      {
        if (number[place] < 0)
        {
          number[place] = static_cast<std::int32_t>(surface.nodes.size());
          surface.nodes.push_back(arrival.nodes[place]);
          for (unsigned int d = 0; d < dim; ++d)
            surface.lines.push_back(std::move(arrival.lines[place * dim + d]));
          surface.parents.push_back(std::move(arrival.parents[place]));
        }
        return number[place];
      };
      for (auto &facet : surface.facets)
        for (unsigned int a = 0; a < surface.nodes_per_facet(); ++a)
          facet.node[a] = take(facet.node[a]);
      // Taking a parent makes the list longer.
      for (std::size_t n = 0; n < surface.parents.size(); ++n)
        for (std::size_t k = 0; k < surface.parents[n].size(); ++k)
        {
          const auto dof = surface.parents[n][k].index;
          surface.parents[n][k].index = take(arrival.place.at(dof));
        }
    }
  } // namespace

  template <int dim>
  ContactSurface<dim> SurfaceExchange<dim>::arrange(const Message &all) const
  {
    ContactSurface<dim> surface;
    surface.kind = kind_;
    Arrival<dim> arrival = read_nodes<dim>(all.nodes, all.values);
    surface.facets =
        read_facets(all.facets, arrival, surface.nodes_per_facet());
    number_nodes(arrival, surface);
    return surface;
  }

  template <int dim>
  ContactSurface<dim> SurfaceExchange<dim>::gather(
      const std::set<dealii::types::boundary_id> &boundary_ids) const
  {
    const Message mine = collect(boundary_ids);
    const Message all = {concatenate(mine.facets, communicator_),
                         concatenate(mine.nodes, communicator_),
                         concatenate(mine.values, communicator_)};
    return arrange(all);
  }

  template <int dim>
  void SurfaceExchange<dim>::merge_marks(std::vector<std::uint8_t> &marks) const
  {
    MPI_Allreduce(MPI_IN_PLACE, marks.data(), static_cast<int>(marks.size()),
                  MPI_UINT8_T, MPI_MAX, communicator_);
  }

  template class SurfaceExchange<2>;
  template class SurfaceExchange<3>;
} // namespace abut::shim

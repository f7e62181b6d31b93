// SPDX-License-Identifier: LGPL-2.1-or-later
// Facets of the own cells, and the rings of facets around the own nodes.
#include "surface_exchange.h"

#include "reference_faces.h"

#include <abut/dealii/versions.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/cell_id.h>

#include <algorithm>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    template <int dim>
    dealii::AffineConstraints<double>
    hanging_nodes(const dealii::DoFHandler<dim> &dof_handler)
    {
      const dealii::IndexSet relevant =
          dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
      dealii::AffineConstraints<double> hanging;
      versions::reinit(hanging, dof_handler.locally_owned_dofs(), relevant);
      dealii::DoFTools::make_hanging_node_constraints(dof_handler, hanging);
      hanging.close();
      return hanging;
    }

    template <int dim>
    abut_facet_kind facet_kind(const dealii::FiniteElement<dim> &fe,
                               const unsigned int degree)
    {
      if (dim == 2)
        return degree == 1 ? ABUT_FACET_LINE2 : ABUT_FACET_LINE3;
      if (is_simplex(fe))
        return degree == 1 ? ABUT_FACET_TRI3 : ABUT_FACET_TRI6;
      return degree == 1 ? ABUT_FACET_QUAD4 : ABUT_FACET_QUAD9;
    }

    template <typename Number> void sort_once(std::vector<Number> &list)
    {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  } // namespace

  template <int dim>
  SurfaceExchange<dim>::SurfaceExchange(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler,
      const dealii::AffineConstraints<double> &constraints,
      const std::set<dealii::types::boundary_id> &boundary_ids,
      SelfContact<dim> self_contact)
      : mapping_(mapping),
        dof_handler_(dof_handler),
        constraints_(constraints),
        boundary_ids_(boundary_ids),
        self_contact_(std::move(self_contact)),
        hanging_(hanging_nodes(dof_handler)),
        post_(versions::communicator(dof_handler)),
        owners_(dof_handler.locally_owned_dofs(),
                versions::communicator(dof_handler)),
        cell_facets_(dof_handler, facets_of)
  {
    collect();
    number_own();
    announce();
    add_ring(1, 2);
    add_ring(2, 3);
  }

  template <int dim> void SurfaceExchange<dim>::refresh()
  {
    described_.clear();
    nodes_.clear();
  }

  template <int dim>
  bool SurfaceExchange<dim>::renew_sides(const la::Vector &displacement,
                                         const double near,
                                         abut_context *context)
  {
    if (!self_contact_.renew(displacement, near, context))
      return false;
    assign_sides();
    return true;
  }

  template <int dim> bool SurfaceExchange<dim>::load_sides(std::istream &stream)
  {
    if (!self_contact_.load(stream))
      return false;
    assign_sides();
    return true;
  }

  template <int dim> void SurfaceExchange<dim>::assign_sides()
  {
    const auto assign_id = [&](Facet &facet)
    {
      facet.boundary_id = self_contact_.id(
          facet.cell, facet.face, self_contact_.of_mesh(facet.boundary_id));
    };
    for (FacetRecord &record : own_)
      assign_id(record.facet);
    for (auto *list : {&announced_, &facets_})
      for (auto &[number, record] : *list)
        assign_id(record.facet);
    links_.clear();
  }

  template <int dim>
  std::set<abut_facet_kind> SurfaceExchange<dim>::kinds() const
  {
    std::set<abut_facet_kind> result;
    for (const auto &facets : cell_facets_.all())
      result.insert(facets->kind);
    return result;
  }

  template <int dim>
  bool SurfaceExchange<dim>::has_quadratic_triangles(
      const std::set<dealii::types::boundary_id> &ids) const
  {
    if (kinds().count(ABUT_FACET_TRI6) == 0)
      return false;
    const bool mine =
        std::any_of(own_.begin(), own_.end(),
                    [&](const FacetRecord &record)
                    {
                      return record.facet.kind == ABUT_FACET_TRI6
                             && ids.count(record.facet.boundary_id) > 0;
                    });
    return MPI::logical_or(mine, post_.communicator());
  }

  template <int dim>
  typename SurfaceExchange<dim>::CellFacets
  SurfaceExchange<dim>::facets_of(const dealii::FiniteElement<dim> &fe)
  {
    const ReferenceFaces<dim> faces(fe.base_element(0));
    CellFacets result;
    result.kind = facet_kind(fe, fe.base_element(0).degree);
    const unsigned int n_nodes = abut_facet_n_nodes(result.kind);
    result.dof.assign(fe.reference_cell().n_faces(),
                      std::vector<std::array<unsigned int, dim>>(n_nodes));
    for (unsigned int face = 0; face < result.dof.size(); ++face)
    {
      const auto order = faces.outward_order(result.kind, face);
      std::vector<unsigned int> place(n_nodes);
      for (unsigned int a = 0; a < n_nodes; ++a)
        place[order[a]] = a;
      for (unsigned int i = 0; i < fe.n_dofs_per_face(face); ++i)
      {
        const auto part = fe.face_system_to_component_index(i, face);
        if (part.first < dim)
          result.dof[face][place[part.second]][part.first] =
              fe.face_to_cell_index(i, face);
      }
    }
    return result;
  }

  template <int dim> void SurfaceExchange<dim>::collect()
  {
    std::vector<Index> dofs;
    for (const auto &cell : dof_handler_.active_cell_iterators())
    {
      if (!cell->is_locally_owned() || !cell->at_boundary())
        continue;
      get_dofs(cell, dofs);
      const CellFacets &facets = cell_facets_.of(cell);
      for (const unsigned int face : cell->face_indices())
      {
        if (!cell->at_boundary(face)
            || boundary_ids_.count(cell->face(face)->boundary_id()) == 0)
          continue;
        FacetRecord record;
        record.facet.cell = cell->id().template to_binary<dim>();
        record.facet.face = face;
        record.facet.kind = facets.kind;
        record.facet.boundary_id = self_contact_.id(
            record.facet.cell, face, cell->face(face)->boundary_id());
        record.facet.owner = MPI::this_mpi_process(post_.communicator());
        for (const auto &local : facets.dof[face])
        {
          const Index dof = dofs[local[0]];
          record.nodes.push_back(dof);
          if (const auto *parents = hanging_.get_constraint_entries(dof))
            for (const auto &parent : *parents)
              record.parents.push_back(parent.first);
        }
        sort_once(record.parents);
        own_.push_back(std::move(record));
      }
    }
  }

  template <int dim> void SurfaceExchange<dim>::number_own()
  {
    using Key = std::pair<dealii::CellId, std::uint32_t>;
    const auto key = [](const FacetRecord &record)
    { return Key(record.facet.cell, record.facet.face); };
    std::sort(own_.begin(), own_.end(),
              [&](const FacetRecord &a, const FacetRecord &b)
              { return key(a) < key(b); });
    const std::int64_t n_own = own_.size();
    n_facets_everywhere_ = MPI::sum(n_own, post_.communicator());
    std::int64_t number = 0;
    if (dynamic_cast<const dealii::parallel::distributed::Triangulation<dim> *>(
            &dof_handler_.get_triangulation())
        != nullptr)
    {
      // Ranks have consecutive parts of the curve, so that numbers along it do
      // not depend on where it is cut. CellIds are in the order of the curve:
      // that of a coarse cell is its place there, not its index.
      MPI_Exscan(&n_own, &number, 1, MPI_INT64_T, MPI_SUM,
                 post_.communicator());
      if (MPI::this_mpi_process(post_.communicator()) == 0)
        number = 0;
      for (FacetRecord &record : own_)
        record.facet.number = number++;
      return;
    }
    // Ranks of other meshes have any cells: only all CellIds have an order.
    std::vector<typename dealii::CellId::binary_type::value_type> words;
    for (const FacetRecord &record : own_)
    {
      words.insert(words.end(), record.facet.cell.begin(),
                   record.facet.cell.end());
      words.push_back(record.facet.face);
    }
    std::vector<Key> keys;
    for (const auto &some : MPI::all_gather(post_.communicator(), words))
      for (auto word = some.begin(); word != some.end(); ++word)
      {
        dealii::CellId::binary_type cell;
        std::copy_n(word, cell.size(), cell.begin());
        word += cell.size();
        keys.emplace_back(cell, *word);
      }
    std::sort(keys.begin(), keys.end());
    for (FacetRecord &record : own_)
    {
      while (keys[number] != key(record))
        ++number;
      record.facet.number = number;
    }
  }

  template <int dim>
  void SurfaceExchange<dim>::add_facet(const FacetRecord &record,
                                       const int ring)
  {
    FacetRecord &known =
        facets_.emplace(record.facet.number, record).first->second;
    known.ring = std::min(known.ring, ring);
  }

  template <int dim> void SurfaceExchange<dim>::announce()
  {
    Mail mail;
    for (const FacetRecord &record : own_)
    {
      std::set<unsigned int> ranks;
      for (const auto *list : {&record.nodes, &record.parents})
        for (const Index node : *list)
          ranks.insert(owners_.of(node));
      for (const unsigned int rank : ranks)
        write(record, mail[rank]);
      add_facet(record, 1);
    }
    const dealii::IndexSet &owned = dof_handler_.locally_owned_dofs();
    const std::int64_t stride = ContactSurface<dim>::max_nodes;
    for (auto &[rank, parcel] : post_.exchange(mail))
      while (!parcel.at_end())
      {
        const FacetRecord record = read_facet(parcel);
        const std::int64_t number = record.facet.number;
        for (const auto *list : {&record.nodes, &record.parents})
          for (std::size_t a = 0; a < list->size(); ++a)
          {
            if (!owned.is_element((*list)[a]))
              continue;
            Place &place = places_[(*list)[a]];
            place.facets.push_back(number);
            const std::int64_t name = number * stride + std::int64_t(a);
            if (list == &record.nodes
                && (place.number < 0 || name < place.number))
              place.number = name;
          }
        announced_.emplace(number, record);
        add_facet(record, 1);
      }
    for (auto &[dof, place] : places_)
    {
      sort_once(place.facets);
      if (place.number < 0)
        place.number = n_facets_everywhere_ * stride + std::int64_t(dof);
    }
  }

  template <int dim>
  typename SurfaceExchange<dim>::NodeRecord
  SurfaceExchange<dim>::describe_node(const dealii::Point<dim> &point,
                                      const std::array<Index, dim> &dof) const
  {
    NodeRecord record;
    record.node = {point, dof, places_.at(dof[0]).number};
    for (unsigned int d = 0; d < dim; ++d)
    {
      // A free unknown is a line with itself as its only term.
      Line &line = record.lines[d];
      if (!constraints_.is_constrained(dof[d]))
      {
        line.terms = {{dof[d], 1.}};
        continue;
      }
      line.constant = constraints_.get_inhomogeneity(dof[d]);
      for (const auto &term : *constraints_.get_constraint_entries(dof[d]))
        line.terms.push_back({term.first, term.second});
    }
    if (const auto *parents = hanging_.get_constraint_entries(dof[0]))
      for (const auto &parent : *parents)
        record.parents.push_back({parent.first, parent.second});
    return record;
  }

  template <int dim> void SurfaceExchange<dim>::describe()
  {
    std::vector<Index> dofs;
    // Nodes that others hang on need not be on the boundary.
    for (const bool at_boundary : {true, false})
      for (const auto &cell : dof_handler_.active_cell_iterators())
      {
        if (described_.size() == places_.size())
          return;
        if (cell->is_artificial() || cell->at_boundary() != at_boundary)
          continue;
        get_dofs(cell, dofs);
        const auto &fe = cell->get_fe();
        // Other fields than the displacement may have no support points.
        const auto &nodes_of_cell =
            fe.base_element(0).get_unit_support_points();
        for (const auto &nodes : cell_facets_.of(cell).dof)
          for (const auto &local : nodes)
          {
            const Index first = dofs[local[0]];
            if (places_.count(first) == 0 || described_.count(first) != 0)
              continue;
            std::array<Index, dim> dof;
            for (unsigned int d = 0; d < dim; ++d)
              dof[d] = dofs[local[d]];
            described_.emplace(
                first,
                describe_node(
                    mapping_.transform_unit_to_real_cell(
                        cell, nodes_of_cell[fe.system_to_base_index(local[0])
                                                .second]),
                    dof));
          }
      }
  }

  template <int dim>
  void SurfaceExchange<dim>::add_ring(const int from, const int to)
  {
    std::vector<Index> nodes;
    for (const auto &[number, record] : facets_)
      if (record.ring == from)
        for (const auto *list : {&record.nodes, &record.parents})
          nodes.insert(nodes.end(), list->begin(), list->end());
    sort_once(nodes);
    Mail questions, answers;
    for (const Index node : nodes)
      questions[owners_.of(node)].write(node);
    for (auto &[rank, question] : post_.exchange(questions))
    {
      std::vector<std::int64_t> numbers;
      while (!question.at_end())
      {
        const Place &place = places_.at(question.read());
        numbers.insert(numbers.end(), place.facets.begin(), place.facets.end());
      }
      sort_once(numbers);
      for (const std::int64_t number : numbers)
        write(announced_.at(number), answers[rank]);
    }
    for (auto &[rank, answer] : post_.exchange(answers))
      while (!answer.at_end())
        add_facet(read_facet(answer), to);
  }

  template <int dim> void SurfaceExchange<dim>::fetch_nodes()
  {
    describe();
    std::vector<Index> nodes;
    for (const auto &[number, record] : facets_)
      for (const auto *list : {&record.nodes, &record.parents})
        for (const Index node : *list)
          if (nodes_.count(node) == 0)
            nodes.push_back(node);
    sort_once(nodes);
    Mail questions, answers;
    for (const Index node : nodes)
      questions[owners_.of(node)].write(node);
    for (auto &[rank, question] : post_.exchange(questions))
      while (!question.at_end())
        write(described_.at(question.read()), answers[rank]);
    for (auto &[rank, answer] : post_.exchange(answers))
      while (!answer.at_end())
      {
        NodeRecord record = read_node(answer);
        nodes_.emplace(record.node.dof[0], std::move(record));
      }
  }

  template <int dim>
  void SurfaceExchange<dim>::write(const FacetRecord &record,
                                   Parcel &parcel) const
  {
    const Facet &facet = record.facet;
    parcel.write(facet.number);
    for (const auto word : facet.cell)
      parcel.write(static_cast<std::int64_t>(word));
    parcel.write(std::int64_t(facet.owner) << 32 | facet.boundary_id);
    parcel.write(std::int64_t(record.parents.size()) << 16 | facet.kind << 8
                 | facet.face);
    for (const auto *list : {&record.nodes, &record.parents})
      for (const Index node : *list)
        parcel.write(node);
  }

  template <int dim>
  typename SurfaceExchange<dim>::FacetRecord
  SurfaceExchange<dim>::read_facet(Parcel &parcel) const
  {
    FacetRecord record;
    Facet &facet = record.facet;
    facet.number = parcel.read();
    for (auto &word : facet.cell)
      word = static_cast<std::decay_t<decltype(word)>>(parcel.read());
    const std::uint64_t place = parcel.read(), face = parcel.read();
    facet.owner = static_cast<std::uint32_t>(place >> 32);
    facet.boundary_id = static_cast<dealii::types::boundary_id>(
        static_cast<std::uint32_t>(place));
    facet.face = face & 255;
    facet.kind = static_cast<abut_facet_kind>(face >> 8 & 255);
    record.nodes.resize(abut_facet_n_nodes(facet.kind));
    record.parents.resize(face >> 16);
    for (auto *list : {&record.nodes, &record.parents})
      for (Index &node : *list)
        node = parcel.read();
    return record;
  }

  template <int dim>
  void SurfaceExchange<dim>::write(const NodeRecord &record,
                                   Parcel &parcel) const
  {
    // Free unknowns, which are most, are a bit.
    std::int64_t kinds = std::int64_t(record.parents.size()) << 8;
    for (unsigned int d = 0; d < dim; ++d)
      if (record.lines[d].terms.size() == 1
          && record.lines[d].terms[0].unknown == record.node.dof[d])
        kinds |= 1 << d;
    parcel.write(kinds);
    parcel.write(record.node.number);
    for (unsigned int d = 0; d < dim; ++d)
    {
      const Line &line = record.lines[d];
      parcel.write(record.node.dof[d]);
      parcel.write_value(record.node.point[d]);
      if ((kinds >> d & 1) != 0)
        continue;
      parcel.write(line.terms.size());
      parcel.write_value(line.constant);
      for (const Term &term : line.terms)
      {
        parcel.write(term.unknown);
        parcel.write_value(term.factor);
      }
    }
    for (const Parent &parent : record.parents)
    {
      parcel.write(parent.index);
      parcel.write_value(parent.factor);
    }
  }

  template <int dim>
  typename SurfaceExchange<dim>::NodeRecord
  SurfaceExchange<dim>::read_node(Parcel &parcel) const
  {
    NodeRecord record;
    const std::int64_t kinds = parcel.read();
    record.node.number = parcel.read();
    for (unsigned int d = 0; d < dim; ++d)
    {
      Line &line = record.lines[d];
      record.node.dof[d] = parcel.read();
      record.node.point[d] = parcel.read_value();
      line.terms = {{record.node.dof[d], 1.}};
      if ((kinds >> d & 1) != 0)
        continue;
      const std::size_t n = parcel.read();
      line.constant = parcel.read_value();
      line.terms.resize(n);
      for (Term &term : line.terms)
      {
        term.unknown = parcel.read();
        term.factor = parcel.read_value();
      }
    }
    record.parents.resize(kinds >> 8);
    for (Parent &parent : record.parents)
    {
      parent.index = parcel.read();
      parent.factor = parcel.read_value();
    }
    return record;
  }

  template class SurfaceExchange<2>;
  template class SurfaceExchange<3>;
} // namespace abut::shim

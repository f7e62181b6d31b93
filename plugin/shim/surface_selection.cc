// SPDX-License-Identifier: LGPL-2.1-or-later
// Facets of the other side that are near, and the surface that results.
#include "agree.h"
#include "pair_diagnosis.h"
#include "surface_exchange.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Boxes of a rank's part of a side. More of them fit better around parts
     * that a space-filling curve has cut out, but all ranks get all boxes. */
    constexpr std::int32_t boxes_per_part = 8;

    /** Facets up to this ring have a share in the rows of own nodes. */
    constexpr int last_ring_with_shares = 2;

    using Ids = std::set<dealii::types::boundary_id>;

    bool overlap(const abut_box &a, const abut_box &b)
    {
      bool result = true;
      for (unsigned int d = 0; d < 3; ++d)
        result = result && a.lower[d] <= b.upper[d] && b.lower[d] <= a.upper[d];
      return result;
    }
  } // namespace

  template <int dim>
  template <typename Predicate>
  typename SurfaceExchange<dim>::Part
  SurfaceExchange<dim>::make_part(abut_context *context, const Ids &ids,
                                  const bool displaced,
                                  const Predicate &belongs) const
  {
    Part part;
    for (const auto &[number, record] : facets_)
      if (ids.count(record.facet.boundary_id) != 0 && belongs(record))
        part.number.push_back(number);
    std::sort(part.number.begin(), part.number.end());

    std::unordered_map<Index, std::int32_t> place;
    std::vector<std::int32_t> connectivity;
    std::vector<std::uint8_t> kinds;
    std::vector<double> position, present;
    for (const std::int64_t number : part.number)
    {
      const FacetRecord &record = facets_.at(number);
      kinds.push_back(static_cast<std::uint8_t>(record.facet.kind));
      for (const Index node : record.nodes)
      {
        const auto entry = place.emplace(node, place.size());
        connectivity.push_back(entry.first->second);
        if (!entry.second)
          continue;
        const dealii::Point<dim> point = nodes_.at(node).node.point;
        dealii::Point<dim> moved(point);
        if (const auto way = displaced_.find(node); way != displaced_.end())
          moved += way->second;
        for (unsigned int d = 0; d < dim; ++d)
        {
          position.push_back(point[d]);
          present.push_back(moved[d]);
        }
      }
    }
    abut_surface_data data = abut_surface_data_defaults();
    data.dimension = dim;
    data.kinds = kinds.data();
    data.n_nodes = static_cast<std::int32_t>(place.size());
    data.n_facets = static_cast<std::int32_t>(part.number.size());
    data.connectivity = connectivity.data();
    data.position = position.data();
    data.facet_id = part.number.data();
    data.check_orientation = false;
    if (part.number.empty())
      return part;
    // Facets are checked as the mesh has them: iterates may fold some.
    part.surface = create_surface(context, data);
    if (displaced)
      check(context, abut_surface_update(part.surface.get(), present.data()));
    return part;
  }

  template <int dim>
  std::vector<double>
  SurfaceExchange<dim>::own_boxes(abut_context *context,
                                  const std::vector<Link> &links) const
  {
    // [links][two sides]: number of boxes, and these.
    std::vector<double> result;
    const auto append = [&](const Link &link, const Ids &ids)
    {
      std::int32_t n = 0;
      std::vector<abut_box> box(boxes_per_part);
      const Part part = make_part(context, ids, link.displaced,
                                  [](const FacetRecord &record) {
                                    return record.ring <= last_ring_with_shares;
                                  });
      if (part.surface != nullptr && !link.primary.empty())
        check(context, abut_surface_bounds(part.surface.get(), link.margin,
                                           boxes_per_part, box.data(), &n));
      result.push_back(n);
      for (std::int32_t k = 0; k < n; ++k)
      {
        result.insert(result.end(), box[k].lower, box[k].lower + 3);
        result.insert(result.end(), box[k].upper, box[k].upper + 3);
      }
    };
    for (const Link &link : links)
      run_named(link.name,
                [&]
                {
                  append(link, link.secondary);
                  append(link, link.primary);
                });
    return result;
  }

  template <int dim>
  void SurfaceExchange<dim>::gather_boxes(abut_context *context,
                                          const std::vector<Link> &links)
  {
    std::vector<double> mine;
    run_everywhere<ContactError>(post_.communicator(),
                                 [&] { mine = own_boxes(context, links); });
    std::vector<std::size_t> start;
    const std::vector<double> all = post_.concatenate(mine, start);
    const std::size_t n_ranks = start.size() - 1;
    boxes_.assign(2 * links.size(),
                  std::vector<std::vector<abut_box>>(n_ranks));
    for (std::size_t rank = 0; rank < n_ranks; ++rank)
    {
      const double *place = all.data() + start[rank];
      for (auto &side : boxes_)
      {
        side[rank].resize(static_cast<std::size_t>(*place++));
        for (abut_box &box : side[rank])
        {
          std::copy_n(place, 3, box.lower);
          std::copy_n(place + 3, 3, box.upper);
          place += 6;
        }
      }
    }
  }

  template <int dim>
  double SurfaceExchange<dim>::distance_bound(const std::size_t link) const
  {
    const unsigned int me = MPI::this_mpi_process(post_.communicator());
    double result = std::numeric_limits<double>::infinity();
    for (const abut_box &a : boxes_[2 * link][me])
      for (const auto &side : boxes_[2 * link + 1])
        for (const abut_box &b : side)
        {
          double square = 0.;
          for (unsigned int d = 0; d < 3; ++d)
          {
            const double most =
                std::max(a.upper[d] - b.lower[d], b.upper[d] - a.lower[d]);
            square += most * most;
          }
          result = std::min(result, std::sqrt(square));
        }
    return MPI::min(result, post_.communicator());
  }

  template <int dim>
  std::map<unsigned int, std::set<std::int64_t>>
  SurfaceExchange<dim>::select(abut_context *context, const std::size_t side,
                               const Link &link,
                               const abut_search_options &search) const
  {
    const unsigned int me = MPI::this_mpi_process(post_.communicator());
    std::map<unsigned int, std::set<std::int64_t>> result;
    const Part part = make_part(
        context, side % 2 == 0 ? link.secondary : link.primary, link.displaced,
        [&](const FacetRecord &record) { return record.facet.owner == me; });
    if (part.surface == nullptr)
      return result;
    abut_search_options options = search;
    options.reach = std::max(options.reach, link.reach);
    options.relative_reach += relative_margin;
    const auto finder = create_search(context, part.surface.get(), options);
    abut_surface_sizes sizes;
    check(context, abut_surface_measure(part.surface.get(), &sizes));
    // A first look; curved facets may leave the box of their nodes.
    std::int32_t n = 0;
    abut_box all;
    check(context,
          abut_surface_bounds(
              part.surface.get(),
              std::max(options.reach, options.relative_reach * sizes.largest)
                  + sizes.largest,
              1, &all, &n));
    // Near are the facets of the other side.
    const auto &others = boxes_[side ^ 1];
    std::vector<std::int32_t> found(part.number.size() + 1);
    for (unsigned int rank = 0; rank < others.size(); ++rank)
    {
      std::vector<abut_box> boxes;
      for (const abut_box &box : others[rank])
        if (rank != me && overlap(box, all))
          boxes.push_back(box);
      if (boxes.empty())
        continue;
      check(context, abut_search_select(finder.get(),
                                        static_cast<std::int32_t>(boxes.size()),
                                        boxes.data(), found.data(), &n));
      for (std::int32_t k = 0; k < n; ++k)
        result[rank].insert(part.number[found[k]]);
    }
    return result;
  }

  template <int dim>
  bool SurfaceExchange<dim>::is_known(std::vector<Link> &links,
                                      const abut_search_options &search) const
  {
    bool result = links.size() == links_.size() && search.reach == search_.reach
                  && search.relative_reach == search_.relative_reach;
    for (std::size_t i = 0; i < links.size() && result; ++i)
      result = links[i].secondary == links_[i].secondary
               && links[i].primary == links_[i].primary
               && links[i].displaced == links_[i].displaced
               && links[i].reach <= links_[i].reach
               && links[i].margin <= links_[i].margin;
    if (result)
      links = links_;
    return result;
  }

  template <int dim>
  void SurfaceExchange<dim>::find_near(abut_context *context,
                                       const std::vector<Link> &links,
                                       const abut_search_options &search)
  {
    gather_boxes(context, links);
    std::map<unsigned int, std::set<std::int64_t>> near_ones;
    const auto select_all = [&]
    {
      for (std::size_t side = 0; side < 2 * links.size(); ++side)
        run_named(links[side / 2].name,
                  [&]
                  {
                    for (auto &[rank, numbers] :
                         select(context, side, links[side / 2], search))
                      near_ones[rank].merge(numbers);
                  });
    };
    run_everywhere<ContactError>(post_.communicator(), select_all);
    Mail mail;
    for (const auto &[rank, numbers] : near_ones)
      for (const std::int64_t number : numbers)
        write(facets_.at(number), mail[rank]);
    for (auto &[rank, parcel] : post_.exchange(mail))
      while (!parcel.at_end())
        add_facet(read_facet(parcel), near);
    add_ring(near, beyond);
    links_ = links;
    search_ = search;
  }

  template <int dim> void SurfaceExchange<dim>::displace()
  {
    displaced_.clear();
    if (place_.size() == 0)
      return;
    std::vector<Index> unknowns;
    for (const auto &[first, record] : nodes_)
      for (unsigned int d = 0; d < dim; ++d)
        unknowns.push_back(record.node.dof[d]);
    SharedValues values(dof_handler_.locally_owned_dofs(), std::move(unknowns),
                        post_);
    values.fetch(la::data(place_), post_);
    for (const auto &[first, record] : nodes_)
      for (unsigned int d = 0; d < dim; ++d)
        displaced_[first][d] = values(record.node.dof[d]);
  }

  template <int dim>
  void SurfaceExchange<dim>::forget_nodes(const std::set<Index> &kept)
  {
    std::set<Index> used(kept);
    for (const auto &[number, record] : facets_)
      for (const auto *list : {&record.nodes, &record.parents})
        used.insert(list->begin(), list->end());
    for (const Index node : kept)
      for (const Parent &parent : nodes_.at(node).parents)
        used.insert(parent.index);
    for (auto it = nodes_.begin(); it != nodes_.end();)
      it = used.count(it->first) == 0 ? nodes_.erase(it) : std::next(it);
  }

  template <int dim>
  ContactSurface<dim> SurfaceExchange<dim>::gather_at(
      const la::Vector &place, const std::set<Index> &kept,
      abut_context *context, std::vector<Link> &links,
      const abut_search_options &search)
  {
    fetch_nodes();
    place_ = place;
    displace();
    for (auto it = facets_.begin(); it != facets_.end();)
      it = it->second.ring >= near ? facets_.erase(it) : std::next(it);
    find_near(context, links, search);
    forget_nodes(kept);
    fetch_nodes();
    ContactSurface<dim> surface = arrange();
    share_values(surface);
    return surface;
  }

  template <int dim>
  ContactSurface<dim>
  SurfaceExchange<dim>::gather(abut_context *context, std::vector<Link> &links,
                               const abut_search_options &search)
  {
    fetch_nodes();
    if (!is_known(links, search))
    {
      displace();
      find_near(context, links, search);
      fetch_nodes();
    }
    ContactSurface<dim> surface = arrange();
    share_values(surface);
    return surface;
  }

  template <int dim> ContactSurface<dim> SurfaceExchange<dim>::arrange() const
  {
    ContactSurface<dim> surface;
    surface.n_facets_everywhere = n_facets_everywhere_;
    surface.node_number_end =
        n_facets_everywhere_ * ContactSurface<dim>::max_nodes
        + static_cast<std::int64_t>(dof_handler_.n_dofs());
    std::vector<const NodeRecord *> nodes;
    for (const auto &entry : nodes_)
      nodes.push_back(&entry.second);
    std::sort(nodes.begin(), nodes.end(),
              [](const NodeRecord *a, const NodeRecord *b)
              { return a->node.number < b->node.number; });
    std::unordered_map<Index, std::int32_t> place;
    for (const NodeRecord *record : nodes)
    {
      place.emplace(record->node.dof[0], place.size());
      surface.nodes.push_back(record->node);
      for (const Line &line : record->lines)
        surface.map.append(line.terms, line.constant);
      surface.parents.push_back(record->parents);
    }
    // Parents of a node of a facet are known; a parent does not hang.
    for (auto &parents : surface.parents)
      for (Parent &parent : parents)
        parent.index = place.at(parent.index);

    for (const auto &[number, record] : facets_)
    {
      surface.facets.push_back(record.facet);
      for (std::size_t a = 0; a < record.nodes.size(); ++a)
        surface.facets.back().node[a] = place.at(record.nodes[a]);
    }
    std::sort(surface.facets.begin(), surface.facets.end(),
              [](const Facet &a, const Facet &b)
              { return a.number < b.number; });
    return surface;
  }

  template <int dim>
  void SurfaceExchange<dim>::share_values(const ContactSurface<dim> &surface)
  {
    std::vector<Index> unknowns, nodes;
    for (std::size_t n = 0; n < surface.nodes.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
      {
        unknowns.push_back(surface.nodes[n].dof[d]);
        surface.map.for_each_term(n, d,
                                  [&](const Index unknown, double)
                                  { unknowns.push_back(unknown); });
      }
    for (const Node &node : surface.nodes)
      nodes.push_back(node.dof[0]);
    const dealii::IndexSet &owned = dof_handler_.locally_owned_dofs();
    unknowns_ = SharedValues(owned, std::move(unknowns), post_);
    marks_ = SharedValues(owned, std::move(nodes), post_);
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  SurfaceExchange<dim>::displacements(const ContactSurface<dim> &surface,
                                      const la::Vector &u)
  {
    unknowns_.fetch(la::data(u), post_);
    std::vector<dealii::Tensor<1, dim>> result(surface.nodes.size());
    for (std::size_t n = 0; n < result.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
      {
        result[n][d] = surface.map.constant(n, d);
        surface.map.for_each_term(
            n, d,
            [&](const Index unknown, const double factor)
            { result[n][d] += factor * unknowns_(unknown); });
      }
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  SurfaceExchange<dim>::displacements_as_given(
      const ContactSurface<dim> &surface, const la::Vector &u)
  {
    std::vector<dealii::Tensor<1, dim>> result(surface.nodes.size());
    if (u.size() == 0)
      return result;
    unknowns_.fetch(la::data(u), post_);
    for (std::size_t n = 0; n < result.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        result[n][d] = unknowns_(surface.nodes[n].dof[d]);
    return result;
  }

  template <int dim>
  bool SurfaceExchange<dim>::update_constants(ContactSurface<dim> &surface)
  {
    bool has_new = false;
    for (auto &[dof, record] : described_)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double value =
            constraints_.is_constrained(record.node.dof[d])
                ? constraints_.get_inhomogeneity(record.node.dof[d])
                : 0.;
        has_new = has_new || value != record.lines[d].constant;
        record.lines[d].constant = value;
      }
    if (!MPI::logical_or(has_new, post_.communicator()))
      return false;
    const dealii::IndexSet &owned = dof_handler_.locally_owned_dofs();
    std::vector<double> values(owned.n_elements(), 0.);
    for (const auto &line : constraints_.get_lines())
      if (owned.is_element(line.index))
        values[owned.index_within_set(line.index)] = line.inhomogeneity;
    unknowns_.fetch(values.data(), post_);
    for (std::size_t n = 0; n < surface.nodes.size(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double value = unknowns_(surface.nodes[n].dof[d]);
        surface.map.set_constant(n, d, value);
        nodes_.at(surface.nodes[n].dof[0]).lines[d].constant = value;
      }
    return true;
  }

  template <int dim>
  void SurfaceExchange<dim>::merge_marks(const ContactSurface<dim> &surface,
                                         std::vector<std::uint8_t> &marks)
  {
    const std::size_t n_nodes = surface.nodes.size();
    const unsigned int n_blocks = MPI::max(
        n_nodes > 0 ? static_cast<unsigned int>(marks.size() / n_nodes) : 0u,
        post_.communicator());
    for (unsigned int block = 0; block < n_blocks; ++block)
    {
      marks_.clear();
      std::uint8_t *mark = marks.data() + block * n_nodes;
      for (std::size_t n = 0; n < n_nodes; ++n)
        if (mark[n] != 0)
          marks_(surface.nodes[n].dof[0]) = 1.;
      marks_.add_to_owners(post_);
      marks_.fetch(marks_.owned().data(), post_);
      for (std::size_t n = 0; n < n_nodes; ++n)
        mark[n] = marks_(surface.nodes[n].dof[0]) > 0.;
    }
  }

  template <int dim>
  CommunicationReport SurfaceExchange<dim>::communication() const
  {
    CommunicationReport report = post_.sent();
    report.own_facets = own_.size();
    report.ghost_facets = facets_.size() - own_.size();
    return report;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template ContactSurface<dim> SurfaceExchange<dim>::gather(                   \
      abut_context *, std::vector<Link> &, const abut_search_options &);       \
  template ContactSurface<dim> SurfaceExchange<dim>::gather_at(                \
      const la::Vector &, const std::set<Index> &, abut_context *,             \
      std::vector<Link> &, const abut_search_options &);                       \
  template bool SurfaceExchange<dim>::update_constants(ContactSurface<dim> &); \
  template std::vector<dealii::Tensor<1, dim>>                                 \
  SurfaceExchange<dim>::displacements(const ContactSurface<dim> &,             \
                                      const la::Vector &);                     \
  template std::vector<dealii::Tensor<1, dim>>                                 \
  SurfaceExchange<dim>::displacements_as_given(const ContactSurface<dim> &,    \
                                               const la::Vector &);            \
  template void SurfaceExchange<dim>::merge_marks(                             \
      const ContactSurface<dim> &, std::vector<std::uint8_t> &);               \
  template CommunicationReport SurfaceExchange<dim>::communication() const;    \
  template double SurfaceExchange<dim>::distance_bound(std::size_t) const;

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "self_contact.h"

#include "agree.h"
#include "outward_order.h"
#include "surface_side.h"

#include <abut/dealii/versions.h>
#include <abut/self_contact.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::types::global_dof_index;

  namespace
  {
    /** What tells the id of a primary side from that of the mesh. */
    constexpr dealii::types::boundary_id primary_side = 1u << 31;

    template <int dim> bool touches_itself(const ContactPair<dim> &pair)
    {
      return !pair.obstacle && !pair.primary.empty()
             && pair.secondary == pair.primary;
    }
  } // namespace

  template <int dim>
  std::vector<ContactPair<dim>>
  SelfContact<dim>::with_sides(const std::vector<ContactPair<dim>> &pairs)
  {
    std::set<BoundaryId> own;
    for (const auto &pair : pairs)
      if (touches_itself(pair))
        for (const BoundaryId id : pair.secondary)
          if (id >= primary_side || !own.insert(id).second)
            throw ContactError(
                "Pair '" + pair.name + "': boundary id " + std::to_string(id)
                + (id >= primary_side ? " is too large for a surface that "
                                        "touches itself; take one below 2^31."
                                      : " touches itself in another pair, too; "
                                        "make one pair of the two."));
    std::vector<ContactPair<dim>> result = pairs;
    for (auto &pair : result)
    {
      if (touches_itself(pair))
      {
        if (pair.tied)
          throw ContactError("Pair '" + pair.name
                             + "': a surface cannot be tied to itself; give "
                               "its two sides boundary ids of their own.");
        pair.primary.clear();
        for (const BoundaryId id : pair.secondary)
          pair.primary.insert(id | primary_side);
        continue;
      }
      for (auto *side : {&pair.secondary, &pair.primary})
        for (const BoundaryId id : std::set<BoundaryId>(*side))
          if (own.count(id) > 0)
            side->insert(id | primary_side);
    }
    return result;
  }

  /** Facets of all ranks by their corners. */
  template <int dim> struct SelfContact<dim>::Facets
  {
    static constexpr unsigned int n_corners = 1u << (dim - 1);

    struct Facet
    {
      Cell cell;
      unsigned int face;
      BoundaryId id;
      std::array<std::int64_t, n_corners> node;
      std::array<double, n_corners * dim> point;
    };

    std::vector<Facet> all; ///< in the order of their cells

    Facets(const dealii::Mapping<dim> &mapping,
           const dealii::DoFHandler<dim> &dof_handler,
           const std::set<BoundaryId> &ids)
    {
      std::vector<std::uint32_t> words;
      std::vector<std::int64_t> nodes;
      std::vector<double> points;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const unsigned int face : cell->face_indices())
            if (cell->at_boundary(face)
                && ids.count(cell->face(face)->boundary_id()) > 0)
            {
              for (const auto word : cell->id().template to_binary<dim>())
                words.push_back(word);
              words.push_back(face);
              words.push_back(cell->face(face)->boundary_id());
              for (const unsigned int corner : outward_order<dim>(
                       dim == 2 ? ABUT_FACET_LINE2 : ABUT_FACET_QUAD4, face))
              {
                const unsigned int vertex =
                    dealii::GeometryInfo<dim>::face_to_cell_vertices(face,
                                                                     corner);
                nodes.push_back(cell->vertex_dof_index(vertex, 0));
                const auto point = mapping.transform_unit_to_real_cell(
                    cell, dealii::GeometryInfo<dim>::unit_cell_vertex(vertex));
                for (unsigned int d = 0; d < dim; ++d)
                  points.push_back(point[d]);
              }
            }
      const MPI_Comm communicator = versions::communicator(dof_handler);
      const auto all_words = MPI::all_gather(communicator, words);
      const auto all_nodes = MPI::all_gather(communicator, nodes);
      const auto all_points = MPI::all_gather(communicator, points);
      for (std::size_t rank = 0; rank < all_words.size(); ++rank)
        read(all_words[rank], all_nodes[rank], all_points[rank]);
      std::sort(all.begin(), all.end(),
                [](const Facet &a, const Facet &b) {
                  return std::tie(a.cell, a.face) < std::tie(b.cell, b.face);
                });
    }

    void read(const std::vector<std::uint32_t> &words,
              const std::vector<std::int64_t> &nodes,
              const std::vector<double> &points)
    {
      constexpr std::size_t stride = std::tuple_size_v<Cell> + 2;
      for (std::size_t f = 0; f < words.size() / stride; ++f)
      {
        Facet facet;
        const std::uint32_t *word = &words[f * stride];
        std::copy_n(word, stride - 2, facet.cell.begin());
        facet.face = word[stride - 2];
        facet.id = word[stride - 1];
        std::copy_n(&nodes[f * n_corners], n_corners, facet.node.begin());
        std::copy_n(&points[f * n_corners * dim], n_corners * dim,
                    facet.point.begin());
        all.push_back(facet);
      }
    }
  };

  template <int dim>
  SelfContact<dim>::SelfContact(const dealii::Mapping<dim> &mapping,
                                const dealii::DoFHandler<dim> &dof_handler,
                                const std::vector<ContactPair<dim>> &pairs,
                                const SearchParameters &search,
                                abut_context *context)
  {
    std::set<BoundaryId> ids;
    for (const auto &pair : pairs)
      if (touches_itself(pair))
        ids.insert(pair.secondary.begin(), pair.secondary.end());
    if (ids.empty())
      return;
    const Facets facets(mapping, dof_handler, ids);
    std::string message;
    try
    {
      for (const auto &pair : pairs)
        if (touches_itself(pair))
          split(pair, facets, search, context);
    }
    catch (const std::exception &error)
    {
      message = error.what();
    }
    throw_everywhere<ContactError>(versions::communicator(dof_handler),
                                   message);
  }

  template <int dim>
  void
  SelfContact<dim>::split(const ContactPair<dim> &pair, const Facets &facets,
                          const SearchParameters &search, abut_context *context)
  {
    std::vector<const typename Facets::Facet *> own;
    std::vector<std::int64_t> node_id;
    std::vector<double> position;
    std::vector<std::int32_t> connectivity;
    std::map<std::int64_t, std::int32_t> place;
    for (const auto &facet : facets.all)
      if (pair.secondary.count(facet.id) > 0)
      {
        own.push_back(&facet);
        for (unsigned int a = 0; a < Facets::n_corners; ++a)
        {
          const auto [it, is_new] =
              place.emplace(facet.node[a], static_cast<int>(place.size()));
          connectivity.push_back(it->second);
          if (!is_new)
            continue;
          node_id.push_back(facet.node[a]);
          for (unsigned int d = 0; d < dim; ++d)
            position.push_back(facet.point[a * dim + d]);
        }
      }
    const std::string name = "Pair '" + pair.name + "': ";
    if (own.empty())
      throw ContactError(name
                         + "no facet of the mesh has a boundary id of the "
                           "surface.");
    abut_surface_data data = abut_surface_data_defaults();
    data.dimension = dim;
    data.kind = dim == 2 ? ABUT_FACET_LINE2 : ABUT_FACET_QUAD4;
    data.n_nodes = static_cast<std::int32_t>(node_id.size());
    data.n_facets = static_cast<std::int32_t>(own.size());
    data.connectivity = connectivity.data();
    data.position = position.data();
    data.node_id = node_id.data();
    data.check_orientation = search.check_orientation;
    data.feature_angle = search.feature_angle;
    abut_split_options options = abut_split_defaults();
    options.reach = std::max(search.detection.search.reach, pair.reach);
    options.relative_reach = search.detection.search.relative_reach;
    options.normal_cosine = search.detection.normal_cosine;
    options.thickness = given_thickness(search, pair.secondary);
    std::vector<std::uint8_t> side(own.size());
    abut_split_report report;
    try
    {
      const auto surface = create_surface(context, data);
      check(context, abut_surface_split(context, surface.get(), &options,
                                        side.data(), &report));
    }
    catch (const dealii::ExceptionBase &error)
    {
      const char *text = error.what();
      throw ContactError(name + text);
    }
    if (report.n_pairs == 0)
      throw ContactError(name
                         + "no two facets of the surface face each other "
                           "within reach. Give the pair a reach that is larger "
                           "than the distance of the parts that may touch.");
    for (std::size_t f = 0; f < own.size(); ++f)
      if (side[f] != 0)
        primary_.emplace(own[f]->cell, own[f]->face);
    for (const BoundaryId id : pair.secondary)
      thickness_[id] = report.thickness;
  }

  template <int dim>
  dealii::types::boundary_id
  SelfContact<dim>::id(const Cell &cell, const unsigned int face,
                       const BoundaryId of_mesh) const
  {
    return primary_.count({cell, face}) > 0 ? of_mesh | primary_side : of_mesh;
  }

  template <int dim>
  bool SelfContact<dim>::is_split(const ContactPair<dim> &pair)
  {
    return !pair.primary.empty() && *pair.primary.rbegin() >= primary_side;
  }

  template <int dim>
  double SelfContact<dim>::thickness(const ContactPair<dim> &pair) const
  {
    const auto it = pair.secondary.empty()
                        ? thickness_.end()
                        : thickness_.find(*pair.secondary.begin());
    return it != thickness_.end() && pair.primary.count(it->first) == 0
                   && pair.primary.count(it->first | primary_side) > 0
               ? it->second
               : 0.;
  }

  template class SelfContact<2>;
  template class SelfContact<3>;
} // namespace abut::shim

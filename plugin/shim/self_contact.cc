// SPDX-License-Identifier: LGPL-2.1-or-later
#include "self_contact.h"

#include "agree.h"
#include "by_element.h"
#include "point_to_point.h"
#include "reference_faces.h"
#include "saved_words.h"
#include "surface_side.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::types::global_dof_index;

  namespace
  {
    /** Bit that distinguishes the id of a primary side from that of the mesh.
     */
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
            throw ContactError(about_pair(
                pair.name, "boundary id " + std::to_string(id)
                               + (id >= primary_side
                                      ? " is too large for a surface that "
                                        "touches itself; use an id below 2^31."
                                      : " touches itself in another pair as "
                                        "well; join the two pairs.")));
    std::vector<ContactPair<dim>> result = pairs;
    for (auto &pair : result)
    {
      if (touches_itself(pair))
      {
        if (pair.tied)
          throw ContactError(
              about_pair(pair.name, "a surface cannot be tied to itself; give "
                                    "its two sides different boundary ids."));
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
    using Word = typename Cell::value_type;
    static constexpr unsigned int max_corners = 1u << (dim - 1);

    struct Facet
    {
      Cell cell;
      unsigned int face;
      abut_facet_kind kind; ///< of its corners
      BoundaryId id;
      std::array<std::int64_t, max_corners> node;
      std::array<double, max_corners * dim> point;
    };

    std::vector<Facet> all; ///< in the order of their cells

    /** Corners displaced by @p displacement (owned; null: 0). */
    Facets(const dealii::Mapping<dim> &mapping,
           const dealii::DoFHandler<dim> &dof_handler,
           const std::set<BoundaryId> &ids, const la::Vector *displacement)
    {
      const ByElement faces_of(dof_handler,
                               [](const dealii::FiniteElement<dim> &fe) {
                                 return ReferenceFaces<dim>(fe.base_element(0));
                               });
      std::vector<Word> words;
      std::vector<std::int64_t> nodes;
      std::vector<double> points;
      std::vector<global_dof_index> unknowns; // of points
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const unsigned int face : cell->face_indices())
            if (cell->at_boundary(face)
                && ids.count(cell->face(face)->boundary_id()) > 0)
            {
              for (const auto word : cell->id().template to_binary<dim>())
                words.push_back(word);
              const ReferenceFaces<dim> &faces = faces_of.of(cell);
              const abut_facet_kind kind = kind_of(cell->get_fe());
              words.push_back(face);
              words.push_back(kind);
              words.push_back(cell->face(face)->boundary_id());
              for (const unsigned int corner : faces.outward_order(kind, face))
              {
                const unsigned int vertex = faces.vertices(face)[corner];
                nodes.push_back(cell->vertex_dof_index(vertex, 0));
                const auto point = mapping.transform_unit_to_real_cell(
                    cell, faces.vertex(vertex));
                for (unsigned int d = 0; d < dim; ++d)
                {
                  points.push_back(point[d]);
                  unknowns.push_back(cell->vertex_dof_index(vertex, d));
                }
              }
            }
      const MPI_Comm communicator = versions::communicator(dof_handler);
      if (displacement != nullptr)
      {
        PointToPoint post(communicator);
        SharedValues values(dof_handler.locally_owned_dofs(), unknowns, post);
        values.fetch(la::data(*displacement), post);
        for (std::size_t i = 0; i < points.size(); ++i)
          points[i] += values(unknowns[i]);
      }
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

    static abut_facet_kind kind_of(const dealii::FiniteElement<dim> &fe)
    {
      return dim == 2         ? ABUT_FACET_LINE2
             : is_simplex(fe) ? ABUT_FACET_TRI3
                              : ABUT_FACET_QUAD4;
    }

    void read(const std::vector<Word> &words,
              const std::vector<std::int64_t> &nodes,
              const std::vector<double> &points)
    {
      constexpr std::size_t stride = std::tuple_size_v<Cell> + 3;
      std::size_t first = 0; // corner
      for (std::size_t f = 0; f < words.size() / stride; ++f)
      {
        Facet facet;
        const Word *word = &words[f * stride];
        std::copy_n(word, stride - 3, facet.cell.begin());
        facet.face = static_cast<unsigned int>(word[stride - 3]);
        facet.kind = static_cast<abut_facet_kind>(word[stride - 2]);
        facet.id = static_cast<BoundaryId>(word[stride - 1]);
        const unsigned int n = abut_facet_n_nodes(facet.kind);
        std::copy_n(&nodes[first], n, facet.node.begin());
        std::copy_n(&points[first * dim], n * dim, facet.point.begin());
        first += n;
        all.push_back(facet);
      }
    }
  };

  /** The facets of a pair as a surface of the core. */
  template <int dim> struct SelfContact<dim>::Part
  {
    std::vector<const typename Facets::Facet *> facet;
    std::vector<std::int64_t> node_id;
    std::vector<double> position;
    std::vector<std::int32_t> connectivity;
    std::vector<std::uint8_t> kinds;
    Handle<abut_surface> surface;
    abut_surface_sizes sizes;

    Part(const ContactPair<dim> &pair, const Facets &facets,
         const SearchParameters &search, abut_context *context)
    {
      std::map<std::int64_t, std::int32_t> place;
      for (const auto &each : facets.all)
      {
        if (pair.secondary.count(each.id) == 0)
          continue;
        facet.push_back(&each);
        kinds.push_back(static_cast<std::uint8_t>(each.kind));
        for (int a = 0; a < abut_facet_n_nodes(each.kind); ++a)
        {
          const auto [it, is_new] =
              place.emplace(each.node[a], static_cast<int>(place.size()));
          connectivity.push_back(it->second);
          if (!is_new)
            continue;
          node_id.push_back(each.node[a]);
          for (unsigned int d = 0; d < dim; ++d)
            position.push_back(each.point[a * dim + d]);
        }
      }
      if (facet.size() < 2)
        throw ContactError("fewer than two facets of the mesh have a boundary "
                           "id of the surface.");
      abut_surface_data data = abut_surface_data_defaults();
      data.dimension = dim;
      data.kinds = kinds.data();
      data.n_nodes = static_cast<std::int32_t>(node_id.size());
      data.n_facets = static_cast<std::int32_t>(facet.size());
      data.connectivity = connectivity.data();
      data.position = position.data();
      data.node_id = node_id.data();
      data.check_orientation = search.check_orientation;
      data.feature_angle = search.feature_angle;
      surface = create_surface(context, data);
      check(context, abut_surface_measure(surface.get(), &sizes));
    }

    /** A distance for facets to be found across openings of any width, but
     * that a facet has some thousand others within, at most. */
    double wide_reach() const
    {
      constexpr double facets = dim == 2 ? 500. : 16.;
      double square = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        square += (sizes.upper[d] - sizes.lower[d])
                  * (sizes.upper[d] - sizes.lower[d]);
      return std::min(std::sqrt(square), facets * sizes.median);
    }
  };

  template <int dim>
  template <typename Function>
  void SelfContact<dim>::for_each(const Function &function) const
  {
    Message message;
    for (const auto &pair : pairs_)
      try
      {
        function(pair);
      }
      catch (const dealii::ExceptionBase &error)
      {
        message = about_pair(pair.name, error.what());
        break;
      }
    throw_everywhere<ContactError>(versions::communicator(*dof_handler_),
                                   message);
  }

  template <int dim>
  SelfContact<dim>::SelfContact(const dealii::Mapping<dim> &mapping,
                                const dealii::DoFHandler<dim> &dof_handler,
                                const std::vector<ContactPair<dim>> &pairs,
                                const SearchParameters &search,
                                abut_context *context)
      : mapping_(&mapping), dof_handler_(&dof_handler), search_(search)
  {
    std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(pairs_),
                 touches_itself<dim>);
    if (pairs_.empty())
      return;
    const Facets facets(mapping, dof_handler, all_ids(), nullptr);
    for_each([&](const ContactPair<dim> &pair)
             { split(pair, facets, context); });
  }

  template <int dim>
  std::set<dealii::types::boundary_id> SelfContact<dim>::all_ids() const
  {
    std::set<BoundaryId> ids;
    for (const auto &pair : pairs_)
      ids.insert(pair.secondary.begin(), pair.secondary.end());
    return ids;
  }

  template <int dim>
  abut_split_options
  SelfContact<dim>::options(const ContactPair<dim> &pair) const
  {
    abut_split_options result = abut_split_defaults();
    result.reach = std::max(search_.detection.search.reach, pair.reach);
    result.relative_reach = search_.detection.search.relative_reach;
    result.normal_cosine = search_.detection.normal_cosine;
    result.thickness = given_thickness(search_, pair.secondary);
    return result;
  }

  template <int dim>
  void SelfContact<dim>::split(const ContactPair<dim> &pair,
                               const Facets &facets, abut_context *context)
  {
    const Part part(pair, facets, search_, context);
    std::vector<std::uint8_t> side(part.facet.size());
    abut_split_options how = options(pair);
    abut_split_report report;
    const auto run = [&]
    {
      check(context, abut_surface_split(context, part.surface.get(), &how,
                                        side.data(), &report));
    };
    run();
    for (const BoundaryId id : pair.secondary)
      thickness_[id] = report.thickness;
    // Facets that face each other from afar may come near; facets that face
    // nothing may bend until they do.
    how.reach = std::max(how.reach, part.wide_reach());
    if (report.n_pairs == 0)
      run();
    if (report.n_pairs == 0)
      std::fill(side.begin() + side.size() / 2, side.end(), 1);
    set_primary(part, side);
  }

  template <int dim>
  void SelfContact<dim>::split_again(const ContactPair<dim> &pair,
                                     const Facets &facets, const double near,
                                     abut_context *context)
  {
    const Part part(pair, facets, search_, context);
    std::vector<std::uint8_t> before, side(part.facet.size());
    for (const auto *facet : part.facet)
      before.push_back(primary_.count({facet->cell, facet->face}));
    abut_split_options how = options(pair);
    how.reach = std::max(how.reach, part.wide_reach());
    how.thickness = thinnest_.at(*pair.secondary.begin());
    how.previous = before.data();
    how.near = std::max(near, how.relative_reach * part.sizes.largest);
    check(context, abut_surface_split(context, part.surface.get(), &how,
                                      side.data(), nullptr));
    has_changed_ = set_primary(part, side) || has_changed_;
  }

  template <int dim>
  bool SelfContact<dim>::renew(const la::Vector &displacement,
                               const double near, abut_context *context)
  {
    has_changed_ = false;
    if (pairs_.empty())
      return false;
    const std::set<BoundaryId> ids = all_ids();
    if (thinnest_.empty())
    {
      const Facets facets(*mapping_, *dof_handler_, ids, nullptr);
      for_each([&](const ContactPair<dim> &pair)
               { find_thinnest(pair, facets, context); });
    }
    const Facets facets(*mapping_, *dof_handler_, ids, &displacement);
    for_each([&](const ContactPair<dim> &pair)
             { split_again(pair, facets, near, context); });
    return has_changed_;
  }

  template <int dim>
  void SelfContact<dim>::find_thinnest(const ContactPair<dim> &pair,
                                       const Facets &facets,
                                       abut_context *context)
  {
    const Part part(pair, facets, search_, context);
    std::vector<std::uint8_t> side(part.facet.size());
    abut_split_options how = options(pair);
    how.reach = std::max(how.reach, part.wide_reach());
    abut_split_report report;
    check(context, abut_surface_split(context, part.surface.get(), &how,
                                      side.data(), &report));
    // Without any, what overlaps by more than all facets is no overlap.
    thinnest_[*pair.secondary.begin()] =
        report.thickness > 0. ? report.thickness : 2. * how.reach;
  }

  template <int dim>
  bool SelfContact<dim>::set_primary(const Part &part,
                                     const std::vector<std::uint8_t> &side)
  {
    bool differs = false;
    for (std::size_t f = 0; f < side.size(); ++f)
    {
      const std::pair<Cell, unsigned int> key(part.facet[f]->cell,
                                              part.facet[f]->face);
      differs = differs || (side[f] != 0) != (primary_.count(key) > 0);
      if (side[f] != 0)
        primary_.insert(key);
      else
        primary_.erase(key);
    }
    return differs;
  }

  template <int dim> void SelfContact<dim>::save(std::ostream &stream) const
  {
    if (pairs_.empty())
      return;
    std::vector<std::uint64_t> words;
    for (const auto &[cell, face] : primary_)
    {
      words.insert(words.end(), cell.begin(), cell.end());
      words.push_back(face);
    }
    save_words(stream, versions::communicator(*dof_handler_), words);
  }

  template <int dim> bool SelfContact<dim>::load(std::istream &stream)
  {
    if (pairs_.empty())
      return false;
    const auto words =
        load_words(stream, versions::communicator(*dof_handler_),
                   "The sides of surfaces that touch themselves");
    constexpr std::size_t n = std::tuple_size_v<Cell>;
    std::set<std::pair<Cell, unsigned int>> primary;
    for (std::size_t i = 0; i + n < words.size(); i += n + 1)
    {
      Cell cell;
      for (std::size_t k = 0; k < n; ++k)
        cell[k] = static_cast<typename Cell::value_type>(words[i + k]);
      primary.emplace(cell, static_cast<unsigned int>(words[i + n]));
    }
    std::swap(primary, primary_);
    return primary != primary_;
  }

  template <int dim>
  dealii::types::boundary_id
  SelfContact<dim>::id(const Cell &cell, const unsigned int face,
                       const BoundaryId of_mesh) const
  {
    return primary_.count({cell, face}) > 0 ? of_mesh | primary_side : of_mesh;
  }

  template <int dim>
  dealii::types::boundary_id SelfContact<dim>::of_mesh(const BoundaryId id)
  {
    return id & ~primary_side;
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "surface_side.h"

#include <algorithm>

namespace abut::shim
{
  template <int dim>
  int SurfaceSide<dim>::local_node(const std::int32_t number) const
  {
    const auto it = std::lower_bound(node.begin(), node.end(), number);
    return it == node.end() || *it != number
               ? -1
               : static_cast<int>(it - node.begin());
  }

  template <int dim> double SurfaceSide<dim>::extent() const
  {
    double largest = 0.;
    for (unsigned int d = 0; d < dim; ++d)
    {
      double lower = INFINITY, upper = -INFINITY;
      for (int n = 0; n < n_nodes(); ++n)
      {
        lower = std::min(lower, position[n * dim + d]);
        upper = std::max(upper, position[n * dim + d]);
      }
      largest = std::max(largest, upper - lower);
    }
    return largest;
  }

  namespace
  {
    /** Nodes of the facets and the parents of those that hang, ascending. */
    template <int dim>
    std::vector<std::int32_t> nodes_of(const ContactSurface<dim> &whole,
                                       const std::vector<std::int32_t> &facets)
    {
      std::vector<std::int32_t> nodes;
      for (const std::int32_t f : facets)
        for (unsigned int a = 0; a < whole.nodes_per_facet(); ++a)
        {
          const std::int32_t n = whole.facets[f].node[a];
          nodes.push_back(n);
          for (const auto &parent : whole.parents[n])
            nodes.push_back(static_cast<std::int32_t>(parent.index));
        }
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      return nodes;
    }

    template <int dim>
    void add_hanging(const ContactSurface<dim> &whole, SurfaceSide<dim> &side)
    {
      side.hanging_start.push_back(0);
      for (int n = 0; n < side.n_nodes(); ++n)
      {
        const auto &parents = whole.parents[side.node[n]];
        if (parents.empty())
          continue;
        side.hanging_node.push_back(n);
        for (const auto &parent : parents)
        {
          side.hanging_parent.push_back(
              side.local_node(static_cast<std::int32_t>(parent.index)));
          side.hanging_weight.push_back(parent.factor);
        }
        side.hanging_start.push_back(
            static_cast<std::int32_t>(side.hanging_parent.size()));
      }
    }
  } // namespace

  template <int dim>
  SurfaceSide<dim> make_side(abut_context *context,
                             const ContactSurface<dim> &whole,
                             const std::set<dealii::types::boundary_id> &ids,
                             const SearchParameters &search)
  {
    SurfaceSide<dim> side;
    for (std::size_t f = 0; f < whole.facets.size(); ++f)
      if (ids.count(whole.facets[f].boundary_id) != 0)
        side.facet.push_back(static_cast<std::int32_t>(f));
    side.node = nodes_of(whole, side.facet);
    add_hanging(whole, side);
    for (const std::int32_t n : side.node)
      for (unsigned int d = 0; d < dim; ++d)
        side.position.push_back(whole.nodes[n].point[d]);

    std::vector<std::int32_t> connectivity;
    for (const std::int32_t f : side.facet)
      for (unsigned int a = 0; a < whole.nodes_per_facet(); ++a)
        connectivity.push_back(side.local_node(whole.facets[f].node[a]));
    const std::vector<std::int64_t> node_id(side.node.begin(), side.node.end());
    const std::vector<std::int64_t> facet_id(side.facet.begin(),
                                             side.facet.end());
    abut_surface_data data = abut_surface_data_defaults();
    data.dimension = dim;
    data.kind = whole.kind;
    data.n_nodes = side.n_nodes();
    data.n_facets = side.n_facets();
    data.connectivity = connectivity.data();
    data.position = side.position.data();
    data.node_id = node_id.data();
    data.facet_id = facet_id.data();
    data.check_orientation = search.check_orientation;
    data.feature_angle = search.feature_angle;
    side.surface = create_surface(context, data);
    return side;
  }

  template <int dim>
  void move_side(const abut_context *context,
                 const std::vector<dealii::Point<dim>> &positions,
                 SurfaceSide<dim> &side)
  {
    for (int n = 0; n < side.n_nodes(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        side.position[n * dim + d] = positions[side.node[n]][d];
    check(context,
          abut_surface_update(side.surface.get(), side.position.data()));
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template struct SurfaceSide<dim>;                                            \
  template SurfaceSide<dim> make_side(                                         \
      abut_context *, const ContactSurface<dim> &,                             \
      const std::set<dealii::types::boundary_id> &, const SearchParameters &); \
  template void move_side(const abut_context *,                                \
                          const std::vector<dealii::Point<dim>> &,             \
                          SurfaceSide<dim> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

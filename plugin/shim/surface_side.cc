// SPDX-License-Identifier: LGPL-2.1-or-later
#include "surface_side.h"

#include <abut/self_contact.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

  namespace
  {
    /** Nodes of the facets and the parents of those that hang, ascending. */
    template <int dim>
    std::vector<std::int32_t> nodes_of(const ContactSurface<dim> &whole,
                                       const std::vector<std::int32_t> &facets)
    {
      std::vector<std::int32_t> nodes;
      for (const std::int32_t f : facets)
        for (unsigned int a = 0; a < whole.facets[f].n_nodes(); ++a)
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
    std::vector<std::uint8_t> kinds;
    for (const std::int32_t f : side.facet)
      for (unsigned int a = 0; a < whole.facets[f].n_nodes(); ++a)
        connectivity.push_back(side.local_node(whole.facets[f].node[a]));
    std::vector<std::int64_t> node_id, facet_id;
    for (const std::int32_t n : side.node)
      node_id.push_back(whole.nodes[n].number);
    for (const std::int32_t f : side.facet)
    {
      facet_id.push_back(whole.facets[f].number);
      kinds.push_back(static_cast<std::uint8_t>(whole.facets[f].kind));
    }
    abut_surface_data data = abut_surface_data_defaults();
    data.dimension = dim;
    data.kinds = kinds.data();
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
  double found_thickness(abut_context *context, const SurfaceSide<dim> &side,
                         const SearchParameters &search, const double reach)
  {
    // Length of the mean normal of a surface that has no other side.
    constexpr double one_sided = 0.7;
    if (side.n_nodes() == 0)
      return INFINITY;
    const double *normal = nullptr;
    check(context, abut_surface_normals(side.surface.get(), &normal));
    dealii::Tensor<1, dim> mean;
    for (int n = 0; n < side.n_nodes(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        mean[d] += normal[n * dim + d] / side.n_nodes();
    if (mean.norm() > one_sided)
      return INFINITY;
    abut_split_options options = abut_split_defaults();
    options.reach = std::max(search.detection.search.reach, reach);
    options.relative_reach = search.detection.search.relative_reach;
    options.normal_cosine = search.detection.normal_cosine;
    std::vector<std::uint8_t> sides(side.n_facets());
    abut_split_report report;
    check(context, abut_surface_split(context, side.surface.get(), &options,
                                      sides.data(), &report));
    return report.thickness > 0. ? report.thickness : INFINITY;
  }

  namespace
  {
    /** The middle one of all ranks' values, of which there are @p n: the value
     * that more than half of them do not exceed. By cutting [lower, upper],
     * which holds all of them, in 63 parts at a time. Collective. */
    double median_everywhere(const std::vector<double> &values,
                             const std::int64_t n, double lower, double upper,
                             const MPI_Comm communicator)
    {
      constexpr unsigned int n_cuts = 63;
      while (true)
      {
        std::vector<double> cut(n_cuts);
        for (unsigned int k = 0; k < n_cuts; ++k)
          cut[k] = lower + (upper - lower) * k / n_cuts;
        std::vector<std::int64_t> count(n_cuts, 0);
        for (const double value : values)
          for (unsigned int k = 0; k < n_cuts; ++k)
            count[k] += value <= cut[k];
        MPI_Allreduce(MPI_IN_PLACE, count.data(), n_cuts, MPI_INT64_T, MPI_SUM,
                      communicator);
        unsigned int k = 0;
        while (k < n_cuts && count[k] <= n / 2)
          ++k;
        const double below = k > 0 ? cut[k - 1] : lower;
        const double above = k < n_cuts ? cut[k] : upper;
        if (k == 0 || !(upper - lower > 1e-13 * upper)
            || (below == lower && above == upper))
          return above;
        lower = below;
        upper = above;
      }
    }
  } // namespace

  double given_thickness(const SearchParameters &search,
                         const std::set<dealii::types::boundary_id> &ids)
  {
    const std::vector<double> values =
        search.group_thicknesses({ids.begin(), ids.end()}).values;
    return values.empty() ? 0.
                          : *std::min_element(values.begin(), values.end());
  }

  template <int dim>
  SideMeasures measure_everywhere(const SurfaceSide<dim> &side,
                                  const ContactSurface<dim> &whole,
                                  const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    const unsigned int me = MPI::this_mpi_process(communicator);
    abut_surface_view view;
    abut_surface_get(side.surface.get(), &view);
    SideMeasures result;
    std::vector<double> sizes;
    std::vector<double> lower(dim, INFINITY), upper(dim, -INFINITY);
    for (int f = 0; f < side.n_facets(); ++f)
    {
      const auto &facet = whole.facets[side.facet[f]];
      if (facet.owner != me)
        continue;
      std::vector<double> nodes;
      for (int e = view.facet_start[f]; e < view.facet_start[f + 1]; ++e)
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double x = side.position[view.connectivity[e] * dim + d];
          nodes.push_back(x);
          lower[d] = std::min(lower[d], x);
          upper[d] = std::max(upper[d], x);
        }
      abut_facet_measures measures;
      if (abut_facet_measure(facet.kind, nodes.data(), &measures)
          == ABUT_SUCCESS)
        result.area += measures.area;
      sizes.push_back(abut_facet_size(facet.kind, nodes.data()));
    }
    result.n_facets = MPI::sum(std::int64_t(sizes.size()), communicator);
    result.area = MPI::sum(result.area, communicator);
    const double inf = std::numeric_limits<double>::infinity();
    const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
    result.smallest = MPI::min(sizes.empty() ? inf : *least, communicator);
    result.largest = MPI::max(sizes.empty() ? 0. : *most, communicator);
    MPI::min(lower, communicator, lower);
    MPI::max(upper, communicator, upper);
    if (result.n_facets == 0)
      return SideMeasures();
    for (unsigned int d = 0; d < dim; ++d)
      result.extent = std::max(result.extent, upper[d] - lower[d]);
    result.median = median_everywhere(sizes, result.n_facets, result.smallest,
                                      result.largest, communicator);
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template struct SurfaceSide<dim>;                                            \
  template SurfaceSide<dim> make_side(                                         \
      abut_context *, const ContactSurface<dim> &,                             \
      const std::set<dealii::types::boundary_id> &, const SearchParameters &); \
  template double found_thickness(abut_context *, const SurfaceSide<dim> &,    \
                                  const SearchParameters &, double);           \
  template SideMeasures measure_everywhere(                                    \
      const SurfaceSide<dim> &, const ContactSurface<dim> &, MPI_Comm);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

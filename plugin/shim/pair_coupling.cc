// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pair_coupling.h"

#include "agree.h"

#include <algorithm>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Lists of candidates where bodies are are too long by this part of a
     * facet, unless the parameters have a length: the longer they are, the
     * longer they serve. */
    constexpr double skin_of_displaced = 1.;
  } // namespace

  template <int dim>
  Handle<abut_coupling> make_coupling(const PairHost<dim> &host,
                                      const SurfacePair<dim> &pair,
                                      const abut_discretisation discretisation)
  {
    abut_coupling_options options = abut_coupling_defaults();
    options.discretisation = discretisation;
    if (discretisation_info(discretisation).has_degree)
      options.multiplier_degree =
          static_cast<std::int32_t>(pair.multiplier_degree);
    options.quadrature_degree =
        static_cast<std::int32_t>(host.method.quadrature_degree);
    options.segments = host.method.segments;
    options.axisymmetric = host.axisymmetric;
    options.interpolated_gaps =
        !pair.has_committed_points() || pair.data.obstacle != nullptr;
    options.normal_cosine = host.search.detection.normal_cosine;
    options.search = host.search.detection.search;
    options.search.reach = std::max(options.search.reach, pair.data.reach);
    if (options.search.skin == 0. && pair.has_displaced_sides()
        && !pair.data.obstacle)
      options.search.skin = skin_of_displaced * pair.facet_size();
    options.thickness = pair.thickness;
    abut_coupling *made = nullptr;
    check(host.context, pair.data.obstacle
                            ? abut_coupling_create_obstacle(
                                host.context, pair.secondary.surface.get(),
                                pair.data.obstacle->handle(), &options, &made)
                            : abut_coupling_create(
                                host.context, pair.secondary.surface.get(),
                                pair.primary.surface.get(), &options, &made));
    return Handle<abut_coupling>(made);
  }

  template <int dim>
  void build_points(const PairSet<dim> &set, const SurfacePair<dim> &pair,
                    abut_coupling *coupling,
                    const std::vector<std::uint8_t> &dropped,
                    const double motion, const abut_coupling_target &target)
  {
    const SurfaceSide<dim> &side = pair.secondary;
    const auto me = MPI::this_mpi_process(set.host().communicator);
    std::vector<std::uint8_t> wanted(side.n_nodes()), facets(side.n_facets());
    for (int n = 0; n < side.n_nodes(); ++n)
      wanted[n] = set.is_owned(side.node[n]);
    for (int f = 0; f < side.n_facets(); ++f)
      facets[f] = set.surface().facets[side.facet[f]].owner == me;

    abut_coupling_nodes nodes = abut_coupling_nodes_defaults();
    nodes.wanted = wanted.data();
    nodes.wanted_facet = facets.data();
    nodes.dropped = dropped.data();
    nodes.n_hanging = static_cast<std::int32_t>(side.hanging_node.size());
    nodes.hanging_node = side.hanging_node.data();
    nodes.hanging_start = side.hanging_start.data();
    nodes.hanging_parent = side.hanging_parent.data();
    nodes.hanging_weight = side.hanging_weight.data();
    const abut_status status =
        abut_coupling_build(coupling, &nodes, motion, &target);
    Message message;
    if (status != ABUT_SUCCESS)
    {
      const bool of_obstacle =
          pair.data.obstacle
          && (status == ABUT_CALLBACK_FAILED || status == ABUT_NOT_FINITE);
      message = about_pair(
          pair.data.name,
          of_obstacle ? "its obstacle: " + pair.data.obstacle->failure()
                      : message_of(set.host().context, status),
          of_obstacle ? PairField::obstacle : PairField::surfaces);
    }
    throw_everywhere<ContactError>(set.host().communicator, message);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template Handle<abut_coupling> make_coupling(                                \
      const PairHost<dim> &, const SurfacePair<dim> &, abut_discretisation);   \
  template void build_points(const PairSet<dim> &, const SurfacePair<dim> &,   \
                             abut_coupling *,                                  \
                             const std::vector<std::uint8_t> &, double,        \
                             const abut_coupling_target &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

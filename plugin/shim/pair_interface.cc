// SPDX-License-Identifier: LGPL-2.1-or-later
#include "pair_interface.h"

#include "agree.h"

#include <algorithm>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  template <int dim>
  Handle<abut_interface>
  make_interface(const PairHost<dim> &host, const SurfacePair<dim> &pair,
                 const std::size_t number,
                 const abut_discretisation discretisation,
                 const abut_kinematics kinematics)
  {
    abut_interface_options options = abut_interface_defaults();
    abut_coupling_options &coupling = options.coupling;
    coupling.discretisation = discretisation;
    if (discretisation_info(discretisation).has_degree)
      coupling.multiplier_degree =
          static_cast<std::int32_t>(pair.multiplier_degree);
    coupling.quadrature_degree =
        static_cast<std::int32_t>(host.method.quadrature_degree);
    coupling.segments = host.method.segments;
    coupling.axisymmetric = host.axisymmetric;
    coupling.normal_cosine = host.search.detection.normal_cosine;
    coupling.search = host.search.detection.search;
    coupling.search.reach = std::max(coupling.search.reach, pair.data.reach);
    coupling.thickness = pair.thickness;
    options.kinematics = kinematics;
    options.number = static_cast<std::int32_t>(number);
    options.tangents = pair.data.friction != nullptr;
    options.flush = !pair.data.geometric_gap;
    options.facet_size = pair.facet_size();
    options.secondary_node = pair.secondary.node.data();
    options.secondary_facet = pair.secondary.facet.data();
    options.primary_node = pair.primary.node.data();
    const bool is_obstacle = pair.data.obstacle != nullptr;
    abut_interface *made = nullptr;
    check(host.context,
          abut_interface_create(
              host.context, pair.secondary.surface.get(),
              is_obstacle ? nullptr : pair.primary.surface.get(),
              is_obstacle ? pair.data.obstacle->handle() : nullptr, &options,
              &made));
    return Handle<abut_interface>(made);
  }

  template <int dim>
  void build_points(const PairSet<dim> &set, const SurfacePair<dim> &pair,
                    abut_interface *interface,
                    const std::vector<std::uint8_t> &dropped,
                    abut_interface_target target)
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
    target.nodes = &nodes;
    const abut_status status = abut_interface_build(interface, &target);
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
  template Handle<abut_interface> make_interface(                              \
      const PairHost<dim> &, const SurfacePair<dim> &, std::size_t,            \
      abut_discretisation, abut_kinematics);                                   \
  template void build_points(                                                  \
      const PairSet<dim> &, const SurfacePair<dim> &, abut_interface *,        \
      const std::vector<std::uint8_t> &, abut_interface_target);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes of curved surfaces are on the curve, the middles of straight facets are
// not: gaps of nodes that lie opposite a middle are wrong by as much.
#include "surface_pair_rows.h"

#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace
  {
    /** A straight facet and how far its middle is from the manifold. */
    template <int dim> struct Chord
    {
      dealii::Point<dim> middle;
      dealii::Tensor<1, dim> to_curve; ///< from the middle
      double size = 0.;

      /** Distance from the curve at the place of the facet nearest to @p x;
       * 0 beyond its ends. */
      double error_at(const dealii::Point<dim> &x) const
      {
        const double depth = to_curve.norm();
        const dealii::Tensor<1, dim> normal = to_curve / depth;
        const dealii::Tensor<1, dim> way = x - middle;
        const double height = normal * way;
        const double along = 2. * (way - height * normal).norm() / size;
        return std::abs(height) < size && along < 1.
                   ? depth * (1. - along * along)
                   : 0.;
      }
    };
  } // namespace

  template <int dim>
  double SurfacePairRows<dim>::chord_error(const std::size_t number,
                                           const std::uint8_t *row_state,
                                           const double least) const
  {
    const Pair &pair = pairs_[number];
    const bool is_straight =
        surface_.kind == ABUT_FACET_LINE2 || surface_.kind == ABUT_FACET_QUAD4;
    const std::size_t n_nodes = surface_.nodes.size();
    const std::vector<std::uint8_t> touching = touching_nodes(row_state);
    const std::uint8_t *marks = touching.data() + number * n_nodes;
    const auto me = dealii::Utilities::MPI::this_mpi_process(communicator_);
    const auto worst = [&](const SurfaceSide<dim> &side,
                           const SurfaceSide<dim> &other,
                           const bool is_secondary)
    {
      double error = 0.;
      for (const std::int32_t f : side.facet)
      {
        const auto &facet = surface_.facets[f];
        if (facet.owner != me)
          continue;
        const auto face = dof_handler_.get_triangulation()
                              .create_cell_iterator(dealii::CellId(facet.cell))
                              ->face(facet.face);
        Chord<dim> chord;
        chord.middle = face->center();
        chord.to_curve = face->center(true) - chord.middle;
        chord.size = face->diameter();
        bool touches = !is_secondary;
        for (unsigned int a = 0; a < surface_.nodes_per_facet(); ++a)
          touches = touches || marks[facet.node[a]] != 0;
        if (!touches || chord.to_curve.norm() <= least)
          continue;
        for (const Node node : other.node)
          if (is_secondary || marks[node] != 0)
            error = std::max(error, chord.error_at(surface_.nodes[node].point));
      }
      return error;
    };
    double error = 0.;
    if (is_straight && !pair.data.obstacle && pair.data.geometric_gap)
      error = std::max(worst(pair.secondary, pair.primary, true),
                       worst(pair.primary, pair.secondary, false));
    return dealii::Utilities::MPI::max(error > least ? error : 0.,
                                       communicator_);
  }

  template double SurfacePairRows<2>::chord_error(std::size_t,
                                                  const std::uint8_t *,
                                                  double) const;
  template double SurfacePairRows<3>::chord_error(std::size_t,
                                                  const std::uint8_t *,
                                                  double) const;
} // namespace abut::shim

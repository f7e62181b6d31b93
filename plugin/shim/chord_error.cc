// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes of curved surfaces are on the curve, the middles of straight facets are
// not: gaps of nodes that lie opposite a middle are wrong by as much.
#include "pair_examination.h"

#include <abut/strategy.h>

#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace
  {
    /** The place on its manifold of the middle of a face. */
    template <int dim, typename Face>
    dealii::Point<dim> middle_on_manifold(const Face &face)
    {
      // Face->center(true) takes more corners than triangles have.
      if (dim == 2 || face->n_vertices() != 3)
        return face->center(true);
      std::vector<dealii::Point<dim>> corners;
      for (const unsigned int v : face->vertex_indices())
        corners.push_back(face->vertex(v));
      const std::vector<double> weights(corners.size(), 1. / 3.);
      return face->get_manifold().get_new_point(
          dealii::make_array_view(corners), dealii::make_array_view(weights));
    }

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

    bool is_straight(const abut_facet_kind kind)
    {
      return kind == ABUT_FACET_LINE2 || kind == ABUT_FACET_QUAD4
             || kind == ABUT_FACET_TRI3;
    }
  } // namespace

  template <int dim>
  double chord_error(const PairPoints<dim> &points, const std::size_t number,
                     const std::uint8_t *row_state, const double least)
  {
    const SurfacePair<dim> &pair = points.pairs()[number];
    const std::size_t n_nodes = points.surface().nodes.size();
    const auto kinds = points.exchange().kinds();
    if (std::none_of(kinds.begin(), kinds.end(), is_straight)
        || pair.data.obstacle || !pair.data.geometric_gap)
      return 0.;
    std::vector<std::uint8_t> touching = points.touching_nodes(row_state);
    points.for_each_component(
        [&](const PointRow<dim> &row)
        {
          if (row_state != nullptr && row_state[row.row] != ABUT_STATE_OPEN)
            points.for_each_primary(
                row.point, [&](const NodeIndex node, double)
                { touching[row.place.pair * n_nodes + node] = 1; });
        });
    points.exchange().merge_marks(points.surface(), touching);
    const std::uint8_t *marks = touching.data() + number * n_nodes;
    const auto me =
        dealii::Utilities::MPI::this_mpi_process(points.host().communicator);
    const auto worst =
        [&](const SurfaceSide<dim> &side, const SurfaceSide<dim> &other)
    {
      double error = 0.;
      std::vector<dealii::Point<dim>> opposite;
      for (const NodeIndex node : other.node)
        if (marks[node] != 0)
          opposite.push_back(points.surface().nodes[node].point);
      for (const std::int32_t f : side.facet)
      {
        const auto &facet = points.surface().facets[f];
        if (facet.owner != me || !is_straight(facet.kind))
          continue;
        const auto face = points.host()
                              .dof_handler.get_triangulation()
                              .create_cell_iterator(dealii::CellId(facet.cell))
                              ->face(facet.face);
        Chord<dim> chord;
        chord.middle = face->center();
        chord.to_curve = middle_on_manifold<dim>(face) - chord.middle;
        chord.size = face->diameter();
        bool touches = false;
        for (unsigned int a = 0; a < facet.n_nodes(); ++a)
          touches = touches || marks[facet.node[a]] != 0;
        if (!touches || chord.to_curve.norm() <= least)
          continue;
        for (const dealii::Point<dim> &x : opposite)
          error = std::max(error, chord.error_at(x));
      }
      return error;
    };
    const double error = std::max(worst(pair.secondary, pair.primary),
                                  worst(pair.primary, pair.secondary));
    return dealii::Utilities::MPI::max(error > least ? error : 0.,
                                       points.host().communicator);
  }

  template double chord_error(const PairPoints<2> &, std::size_t,
                              const std::uint8_t *, double);
  template double chord_error(const PairPoints<3> &, std::size_t,
                              const std::uint8_t *, double);
} // namespace abut::shim

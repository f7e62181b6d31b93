// SPDX-License-Identifier: LGPL-2.1-or-later
// Obstacles narrower than facets.
#include "obstacle_width.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Unit normal of a facet by three of its nodes, of either sign. */
    dealii::Tensor<1, 2> normal_of(const dealii::Point<2> *node)
    {
      const dealii::Tensor<1, 2> normal =
          dealii::cross_product_2d(node[1] - node[0]);
      return normal / normal.norm();
    }

    dealii::Tensor<1, 3> normal_of(const dealii::Point<3> *node)
    {
      const dealii::Tensor<1, 3> normal =
          dealii::cross_product_3d(node[1] - node[0], node[2] - node[0]);
      return normal / normal.norm();
    }
  } // namespace

  std::string ObstacleWidth::text() const
  {
    std::ostringstream text;
    text.precision(3);
    text << "the obstacle is only " << width << " wide where facets of size "
         << facet
         << " are near it: single nodes at most touch it, and the force is "
            "theirs. Refine the surface there until several facets are under "
            "it.";
    return text.str();
  }

  template <int dim>
  ObstacleWidth narrowest_width(const PairPoints<dim> &points,
                                const SurfacePair<dim> &pair,
                                const std::vector<Direction<dim>> &u)
  {
    const auto me = MPI::this_mpi_process(points.host().communicator);
    ObstacleWidth narrowest;
    std::vector<dealii::Point<dim>> nodes;
    std::vector<double> distance;
    for (const std::int32_t f : pair.secondary.facet)
    {
      const auto &facet = points.surface().facets[f];
      if (facet.owner != me)
        continue;
      nodes.clear();
      double size = 0.;
      for (unsigned int a = 0; a < facet.n_nodes(); ++a)
      {
        const NodeIndex node = facet.node[a];
        nodes.push_back(points.surface().nodes[node].point + u[node]);
        size = std::max(size, nodes[a].distance(nodes[0]));
      }
      pair.data.obstacle->distance(nodes, distance);
      const double gap =
          *std::min_element(distance.begin(), distance.end()) + pair.data.gap;
      const double width = pair.data.obstacle->width(normal_of(nodes.data()));
      if (gap <= size && width / size < narrowest.width / narrowest.facet)
        narrowest = {width, size};
    }
    for (const auto &[width, size] :
         MPI::all_gather(points.host().communicator,
                         std::make_pair(narrowest.width, narrowest.facet)))
      if (width / size < narrowest.width / narrowest.facet)
        narrowest = {width, size};
    return narrowest;
  }

  template <int dim>
  ObstacleWidth passed_between(const PairPoints<dim> &points,
                               const std::size_t number,
                               const dealii::Point<dim> &place)
  {
    const SurfacePair<dim> &pair = points.pairs()[number];
    const dealii::Point<dim> then =
        points.set().obstacles().place_before(number, place);
    const auto me = MPI::this_mpi_process(points.host().communicator);
    const std::vector<Direction<dim>> u = points.made();
    const double *normals = nullptr;
    check(points.host().context,
          abut_surface_normals(pair.secondary.surface.get(), &normals));
    // Distance of the nearest facet's middle; its size; whether that place was
    // before it or no farther behind than the obstacle is wide; that width.
    std::array<double, 4> nearest = {{INFINITY, 1., 0., INFINITY}};
    for (const std::int32_t f : pair.secondary.facet)
    {
      const auto &facet = points.surface().facets[f];
      if (facet.owner != me)
        continue;
      dealii::Point<dim> middle;
      Direction<dim> normal;
      std::vector<dealii::Point<dim>> nodes;
      double size = 0.;
      for (unsigned int a = 0; a < facet.n_nodes(); ++a)
      {
        const NodeIndex node = facet.node[a];
        nodes.push_back(points.surface().nodes[node].point + u[node]);
        size = std::max(size, nodes[a].distance(nodes[0]));
        const int n = pair.secondary.local_node(node);
        for (unsigned int d = 0; d < dim; ++d)
        {
          middle[d] += nodes[a][d] / facet.n_nodes();
          normal[d] += normals[n * dim + d];
        }
      }
      if (then.distance(middle) >= nearest[0])
        continue;
      normal /= normal.norm();
      const double height = normal * (then - middle);
      const bool is_over =
          (then - middle - height * normal).norm() <= 0.5 * size;
      const double width = pair.data.obstacle->width(normal_of(nodes.data()));
      nearest = {{then.distance(middle), size,
                  is_over && height > -width ? 1. : 0., width}};
    }
    for (const auto &other :
         MPI::all_gather(points.host().communicator, nearest))
      if (other[0] < nearest[0])
        nearest = other;
    return nearest[2] > 0. ? ObstacleWidth{nearest[3], nearest[1]}
                           : ObstacleWidth();
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template ObstacleWidth narrowest_width(const PairPoints<dim> &,              \
                                         const SurfacePair<dim> &,             \
                                         const std::vector<Direction<dim>> &); \
  template ObstacleWidth passed_between(const PairPoints<dim> &, std::size_t,  \
                                        const dealii::Point<dim> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

// SPDX-License-Identifier: LGPL-2.1-or-later
// A grid of points in each cell near the obstacle, the deepest of which is
// followed to the deepest of the cell: the distance of a convex obstacle is
// convex, so that thin ones are found between the points as well.
#include "obstacle_in_bodies.h"

#include "agree.h"
#include "bodies.h"
#include "by_element.h"
#include "reference_faces.h"
#include "sampling.h"

#include <abut/dealii/rigid_obstacle.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::shim
{
  namespace
  {
    /** Points of a grid with @p n spaces in each direction of a box, its ends
     * in it, as far as they are in the unit cube. */
    template <int dim>
    std::vector<dealii::Point<dim>> grid_about(const dealii::Point<dim> &centre,
                                               const double half_width,
                                               const unsigned int n)
    {
      std::vector<dealii::Point<dim>> points;
      unsigned int n_points = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n_points *= n + 1;
      for (unsigned int i = 0; i < n_points; ++i)
      {
        dealii::Point<dim> point;
        for (unsigned int d = 0, k = i; d < dim; ++d, k /= n + 1)
          point[d] = std::clamp(
              centre[d] + half_width * (2. * (k % (n + 1)) / n - 1.), 0., 1.);
        points.push_back(point);
      }
      return points;
    }

    /** The deepest point of a cell in the obstacle. */
    template <int dim> struct DeepestPoint
    {
      double depth = -INFINITY;
      dealii::Point<dim> unit, place;
    };

    /** Looks at the deformed cells of some bodies. */
    template <int dim> class CellProbe
    {
    public:
      using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

      /** @param u the displacement with ghosts
       * @param n_cells of all ranks
       * @param is_surface_vertex [vertices] of the pair's surface */
      CellProbe(const dealii::Mapping<dim> &mapping,
                const dealii::FiniteElement<dim> &fe, const la::Vector &u,
                const double n_cells, const ContactPair<dim> &pair,
                const std::vector<bool> &is_surface_vertex)
          : mapping_(mapping),
            fe_(fe),
            faces_(fe_.base_element(0)),
            pair_(pair),
            corners_(mapping, fe_, of(grid_about(middle(), 0.5, 1)), flags()),
            // No closer than this pays: the deepest point is followed from
            // there.
            n_(samples_per_direction(n_cells, dim, 1., 16.)),
            grid_(mapping, fe_, of(grid_about(middle(), 0.5, n_)), flags()),
            u_(u),
            is_surface_vertex_(is_surface_vertex)
      {
      }

      void look(const Cell &cell, ObstacleInBodies<dim> &found)
      {
        corners_.reinit(cell);
        sample(corners_);
        if (nearest() > extent())
          return;
        grid_.reinit(cell);
        DeepestPoint<dim> deepest = examine_points(cell, grid_, found);
        // A part thinner than the grid may be just behind the surface.
        const double size = extent();
        if (touches_surface(cell, deepest.unit)
            && pair_.obstacle->depth() > size / n_)
          return;
        for (double width = 1. / n_; width > least_width; width /= 2.)
        {
          // Points that can still be reached are outside and not near then.
          if (deepest.depth < -4. * dim * size * width)
            return;
          dealii::FEValues<dim> closer(
              mapping_, fe_, of(grid_about(deepest.unit, width, 4)), flags());
          closer.reinit(cell);
          const DeepestPoint<dim> better = examine_points(cell, closer, found);
          if (better.depth > deepest.depth)
            deepest = better;
        }
      }

    private:
      /** Part of a cell that the deepest point is followed to. */
      static constexpr double least_width = 1e-3;

      static dealii::UpdateFlags flags()
      {
        return dealii::update_values | dealii::update_quadrature_points;
      }

      static dealii::Point<dim> middle()
      {
        dealii::Point<dim> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = 0.5;
        return point;
      }

      /** Points of the unit cube, those that are not in the cell on a face. */
      dealii::Quadrature<dim> of(std::vector<dealii::Point<dim>> points) const
      {
        for (dealii::Point<dim> &point : points)
          point = faces_.inside(point);
        return dealii::Quadrature<dim>(points);
      }

      /** Places and distances of the points of a cell. */
      void sample(const dealii::FEValues<dim> &points)
      {
        motion_.resize(points.n_quadrature_points);
        points[dealii::FEValuesExtractors::Vector(0)].get_function_values(
            u_, motion_);
        places_ = points.get_quadrature_points();
        for (std::size_t q = 0; q < places_.size(); ++q)
          places_[q] += motion_[q];
        pair_.obstacle->distance(places_, distance_);
      }

      double nearest() const
      {
        return *std::min_element(distance_.begin(), distance_.end())
               + pair_.gap;
      }

      /** Longest of the distances from the first point. */
      double extent() const
      {
        double longest = 0.;
        for (const auto &place : places_)
          longest = std::max(longest, place.distance(places_[0]));
        return longest;
      }

      bool is_on_surface(const Cell &cell, const dealii::Point<dim> &unit) const
      {
        constexpr double on_it = 1e-10;
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary()
              && std::abs(faces_.height(f, unit)) < on_it
              && pair_.secondary.count(cell->face(f)->boundary_id()) > 0)
            return true;
        return false;
      }

      /** Whether a point is in a vertex, edge or face between vertices of the
       * surface. */
      bool touches_surface(const Cell &cell,
                           const dealii::Point<dim> &unit) const
      {
        constexpr double in_it = 1e-10;
        const dealii::ReferenceCell reference = cell->reference_cell();
        for (const unsigned int v : cell->vertex_indices())
          if (reference.d_linear_shape_function(unit, v) > in_it
              && !is_surface_vertex_[cell->vertex_index(v)])
            return false;
        return true;
      }

      /** Note what the points of a cell show. Returns the deepest. */
      DeepestPoint<dim> examine_points(const Cell &cell,
                                       const dealii::FEValues<dim> &points,
                                       ObstacleInBodies<dim> &found)
      {
        sample(points);
        DeepestPoint<dim> deepest;
        for (std::size_t q = 0; q < places_.size(); ++q)
        {
          const double depth = -distance_[q] - pair_.gap;
          const dealii::Point<dim> &unit = points.get_quadrature().point(q);
          if (depth > deepest.depth)
            deepest = {depth, unit, places_[q]};
          if (is_on_surface(cell, unit))
            found.at_surface = std::max(found.at_surface, depth);
          else if (depth > found.elsewhere)
          {
            found.elsewhere = depth;
            found.place = places_[q];
          }
        }
        return deepest;
      }

      const dealii::Mapping<dim> &mapping_;
      const dealii::FiniteElement<dim> &fe_;
      const ReferenceFaces<dim> faces_;
      const ContactPair<dim> &pair_;
      dealii::FEValues<dim> corners_;
      const unsigned int n_;
      dealii::FEValues<dim> grid_;
      const la::Vector &u_;
      const std::vector<bool> &is_surface_vertex_;
      std::vector<dealii::Tensor<1, dim>> motion_;
      std::vector<dealii::Point<dim>> places_;
      std::vector<double> distance_;
    };

    /** [vertices] those of boundary faces with given ids. */
    template <int dim>
    std::vector<bool>
    surface_vertices(const dealii::Triangulation<dim> &triangulation,
                     const std::set<dealii::types::boundary_id> &ids)
    {
      std::vector<bool> result(triangulation.n_vertices(), false);
      for (const auto &face : triangulation.active_face_iterators())
        if (face->at_boundary() && ids.count(face->boundary_id()) > 0)
          for (const unsigned int v : face->vertex_indices())
            result[face->vertex_index(v)] = true;
      return result;
    }

    /** The deepest of all ranks. Collective. */
    template <int dim>
    ObstacleInBodies<dim> of_all_ranks(const ObstacleInBodies<dim> &mine,
                                       const MPI_Comm communicator)
    {
      using Item = std::tuple<double, double, dealii::Point<dim>>;
      ObstacleInBodies<dim> all = mine;
      for (const auto &[at_surface, elsewhere, place] :
           dealii::Utilities::MPI::all_gather(
               communicator, Item(mine.at_surface, mine.elsewhere, mine.place)))
      {
        all.at_surface = std::max(all.at_surface, at_surface);
        if (elsewhere > all.elsewhere)
        {
          all.elsewhere = elsewhere;
          all.place = place;
        }
      }
      return all;
    }
  } // namespace

  template <int dim>
  bool ObstacleInBodies<dim>::is_inside(const double facet) const
  {
    constexpr double more = 1.5, round_off = 1e-6;
    return elsewhere > round_off * facet && elsewhere > more * at_surface;
  }

  template <int dim>
  bool ObstacleInBodies<dim>::is_met(const double facet) const
  {
    constexpr double near = 1e-3;
    return at_surface > -near * facet;
  }

  template <int dim>
  std::string ObstacleInBodies<dim>::text(const std::string &depth) const
  {
    std::ostringstream text;
    text.precision(3);
    text << "the body is in the obstacle by " << depth << ", at (" << place
         << "), outside of the pair's surface, where nothing prevents it. Move "
            "the obstacle, or add all sides that it may touch to the surface.";
    return text.str();
  }

  template <int dim>
  std::string
  ObstacleInBodies<dim>::between_nodes(const std::string &depth) const
  {
    std::ostringstream text;
    text.precision(3);
    text << "the obstacle has passed between the nodes of the surface and "
            "penetrates the body by "
         << depth << ", at (" << place << "): ";
    return text.str();
  }

  template <int dim>
  ObstacleInBodies<dim>
  find_obstacle_in_bodies(const dealii::Mapping<dim> &mapping,
                          const dealii::DoFHandler<dim> &dof_handler,
                          const la::Vector &displacement,
                          const ContactPair<dim> &pair)
  {
    ObstacleInBodies<dim> found;
    found.at_surface = found.elsewhere = -INFINITY;
    const abut_obstacle_view view = pair.obstacle->view();
    const bool is_bounded = std::isfinite(pair.obstacle->depth());
    const bool may_be_thinner = pair.geometric_gap && pair.gap > 0.
                                && !is_bounded
                                && view.kind != ABUT_OBSTACLE_PLANE;
    if (!(is_bounded || may_be_thinner) || view.hollow)
      return found;
    ContactPair<dim> looked_at(pair);
    if (may_be_thinner)
      looked_at.gap = 0.;
    const BodyNumbers<dim> bodies(dof_handler.get_triangulation());
    const std::vector<int> is_meant =
        bodies_with(dof_handler, bodies, pair.secondary);
    const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
    la::Vector u(dof_handler.locally_owned_dofs(), relevant,
                 versions::communicator(dof_handler));
    u = displacement;
    const std::vector<bool> is_surface_vertex =
        surface_vertices(dof_handler.get_triangulation(), pair.secondary);
    const ByElement probes(
        dof_handler,
        [&](const dealii::FiniteElement<dim> &fe)
        {
          return CellProbe<dim>(
              mapping, fe, u,
              dof_handler.get_triangulation().n_global_active_cells(),
              looked_at, is_surface_vertex);
        });
    run_everywhere<ContactError>(
        versions::communicator(dof_handler),
        [&]
        {
          for (const auto &cell : dof_handler.active_cell_iterators())
            if (cell->is_locally_owned() && is_meant[bodies.of(cell)] != 0)
              probes.of(cell).look(cell, found);
        });
    return of_all_ranks(found, versions::communicator(dof_handler));
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template struct ObstacleInBodies<dim>;                                       \
  template ObstacleInBodies<dim> find_obstacle_in_bodies(                      \
      const dealii::Mapping<dim> &, const dealii::DoFHandler<dim> &,           \
      const la::Vector &, const ContactPair<dim> &);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut::shim

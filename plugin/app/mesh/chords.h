// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MESH_CHORDS_H
#define ABUT_APP_MESH_CHORDS_H

/** @file
 * Facets of coarse meshes that refinement keeps straight, and where they meet
 * at an angle: what was a curve before the mesh was made is a polygon on all
 * finer ones.
 */

#include <abut/dealii/linear_algebra.h>

#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace abut::app
{
  /** Number of a cell of the coarsest mesh, and of its face. */
  using CoarseFacet = std::pair<int, unsigned int>;

  /** Where facets of a coarse mesh meet at an angle. */
  template <int dim> struct Bend
  {
    dealii::Point<dim> place;          ///< a corner of the edge
    double degrees = 0.;               ///< between the normals; 0: nowhere
    dealii::types::boundary_id id = 0; ///< of one of the two facets
  };

  /** The edges, in 2D corners, between coarse facets of some bodies and
   * boundary ids that are straight on all meshes. The same on all ranks. */
  template <int dim> class Chords
  {
  public:
    Chords(const dealii::Triangulation<dim> &triangulation,
           const std::set<dealii::types::material_id> &bodies,
           const std::set<dealii::types::boundary_id> &ids);

    /** The largest angle of those that approximate a curve rather than make a
     * corner; @p among, unless it is null: between two of these facets. */
    Bend<dim> largest(const std::set<CoarseFacet> *among = nullptr) const;

  private:
    /** A facet beside an edge. */
    struct Side
    {
      dealii::Tensor<1, dim> normal;
      dealii::Point<dim> place; ///< of the edge
      dealii::types::boundary_id id;
      CoarseFacet facet;
    };

    void add(const typename dealii::Triangulation<dim>::cell_iterator &cell,
             unsigned int f);

    std::map<unsigned int, std::vector<Side>> edges_;
  };

  /** Coarse facets with one of the boundary @p ids on which some node has a
   * vector, of @p field (ghosted), longer than @p least. Collective. */
  template <int dim>
  std::set<CoarseFacet>
  coarse_facets_above(const dealii::DoFHandler<dim> &dof_handler,
                      const std::set<dealii::types::boundary_id> &ids,
                      const la::Vector &field, double least);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MIDDLE_NODES_H
#define ABUT_APP_MIDDLE_NODES_H

/** @file
 * Triangles and tetrahedra with curved edges.
 */

#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace abut::app
{
  /** Middles of curved edges by the vertices at the ends, the smaller one
   * first. */
  template <int dim>
  using EdgeMiddles =
      std::map<std::pair<unsigned int, unsigned int>, dealii::Point<dim>>;

  /** Add the middle @p x of the edge between vertex @p v at @p a and vertex
   * @p w at @p b, unless the edge is straight up to round-off or known. */
  template <int dim>
  void add_middle(unsigned int v, const dealii::Point<dim> &a, unsigned int w,
                  const dealii::Point<dim> &b, const dealii::Point<dim> &x,
                  EdgeMiddles<dim> &middles);

  /** The map of triangles and tetrahedra of degree 2 through their vertices and
   * the middles of edges; those of which no middle is known are straight. */
  template <int dim> class MiddleNodes : public dealii::MappingFE<dim>
  {
  public:
    using Cell = typename dealii::Triangulation<dim>::cell_iterator;

    /** The middles may be filled in later. */
    explicit MiddleNodes(std::shared_ptr<const EdgeMiddles<dim>> middles);

    std::unique_ptr<dealii::Mapping<dim>> clone() const override;

    /** A box around the control points of the edges. */
    dealii::BoundingBox<dim> get_bounding_box(const Cell &cell) const override;

    /** Whether an edge of a cell, or of a face, is curved. */
    template <class CellOrFace> bool is_curved(const CellOrFace &object) const
    {
      for (unsigned int l = 0; l < object->n_lines(); ++l)
        if (middle_of(object->line(l)->vertex_index(0),
                      object->line(l)->vertex_index(1))
            != nullptr)
          return true;
      return false;
    }

  protected:
#if DEAL_II_VERSION_GTE(9, 8, 0)
    using SupportPoints =
        boost::container::small_vector<dealii::Point<dim>, 200>;
#else
    using SupportPoints = std::vector<dealii::Point<dim>>;
#endif
    SupportPoints
    compute_mapping_support_points(const Cell &cell) const override;

  private:
    /** Null: the edge is straight. */
    const dealii::Point<dim> *middle_of(unsigned int v, unsigned int w) const;

    const std::shared_ptr<const EdgeMiddles<dim>> middles;
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_REFERENCE_FACES_H
#define ABUT_SHIM_REFERENCE_FACES_H

/** @file
 * Properties of reference cells that are cubes or simplices. They follow from
 * elements with a node in each vertex, so that no number of deal.II's, such as
 * that of an orientation, stands here: these differ between its versions. */

#include "cell_quadrature.h"

#include <abut/facet.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace abut::shim
{
  /** The faces of the reference cell of a scalar element of degree 1 or 2,
   * whose first nodes are the vertices of the cell. */
  template <int dim> class ReferenceFaces
  {
  public:
    using Point = dealii::Point<dim>;

    explicit ReferenceFaces(const dealii::FiniteElement<dim> &element)
        : is_simplex_(is_simplex(element))
    {
      const auto cell = element.reference_cell();
      for (unsigned int v = 0; v < cell.n_vertices(); ++v)
        vertex_.push_back(element.unit_support_point(v));
      const unsigned int n = is_simplex_ ? dim : 1u << (dim - 1);
      for (const unsigned int f : cell.face_indices())
      {
        vertices_.emplace_back();
        for (unsigned int k = 0; k < n; ++k)
          vertices_[f].push_back(element.face_to_cell_index(k, f));
        height_.push_back(height_above(f));
      }
    }

    /** Vertices of the cell on face @p f, in the order of the face. */
    const std::vector<unsigned int> &vertices(const unsigned int f) const
    {
      return vertices_[f];
    }

    /** Vertex @p v of the cell. */
    const Point &vertex(const unsigned int v) const
    {
      return vertex_[v];
    }

    /** 0 on face @p f, 1 at the vertices that are not on it. */
    double height(const unsigned int f, const Point &unit) const
    {
      return height_[f].constant + height_[f].slope * unit;
    }

    bool is_inside(const Point &unit) const
    {
      for (unsigned int f = 0; f < height_.size(); ++f)
        if (!(height(f, unit) >= 0.))
          return false;
      return true;
    }

    /** The point, or if it is not in the cell one on a face near it. */
    Point inside(Point unit) const
    {
      double sum = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        sum += unit[d] = std::clamp(unit[d], 0., 1.);
      return is_simplex_ && sum > 1. ? Point(unit / sum) : unit;
    }

    /** Order of the nodes of face @p f, as the cell has them, that makes the
     * normal of a facet point out of the cell. */
    std::vector<unsigned int> outward_order(const abut_facet_kind kind,
                                            const unsigned int f) const
    {
      std::vector<unsigned int> order(abut_facet_n_nodes(kind));
      std::iota(order.begin(), order.end(), 0u);
      if (is_outward(f))
        return order;
      if (dim == 2)
        std::swap(order[0], order[1]);
      else
        std::swap(order[1], order[2]);
      if (kind == ABUT_FACET_TRI6)
        std::swap(order[3], order[5]);
      if (kind == ABUT_FACET_QUAD9)
      {
        std::swap(order[4], order[6]);
        std::swap(order[5], order[7]);
      }
      return order;
    }

  private:
    /** A linear function. */
    struct Height
    {
      double constant = 0.;
      dealii::Tensor<1, dim> slope;
    };

    /** Faces lie where a coordinate is 0, where it is 1 (cubes), or where the
     * sum of all is 1 (simplices). */
    Height height_above(const unsigned int f) const
    {
      Height result;
      for (unsigned int d = 0; d < dim; ++d)
        for (const double place : {0., 1.})
          if (std::all_of(vertices_[f].begin(), vertices_[f].end(),
                          [&](const unsigned int v)
                          { return vertex_[v][d] == place; }))
          {
            result.constant = place;
            result.slope[d] = 1. - 2. * place;
            return result;
          }
      result.constant = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        result.slope[d] = -1.;
      return result;
    }

    bool is_outward(const unsigned int f) const
    {
      const auto edge = [&](const unsigned int k)
      { return vertex_[vertices_[f][k]] - vertex_[vertices_[f][0]]; };
      if constexpr (dim == 2)
        return dealii::cross_product_2d(edge(1)) * height_[f].slope < 0.;
      else
        return dealii::cross_product_3d(edge(1), edge(2)) * height_[f].slope
               < 0.;
    }

    bool is_simplex_;
    std::vector<Point> vertex_;
    std::vector<std::vector<unsigned int>> vertices_; ///< [faces]
    std::vector<Height> height_;                      ///< [faces]
  };
} // namespace abut::shim

#endif

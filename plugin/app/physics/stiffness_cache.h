// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_STIFFNESS_CACHE_H
#define ABUT_APP_STIFFNESS_CACHE_H

/** @file
 * Stiffness matrices of cells, computed once for cells of the same shape.
 */

#include "material.h"
#include "middle_nodes.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/full_matrix.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>

namespace abut::app
{
  /** Computes the stiffness matrix of a cell of a linear material.
   *
   * Cells whose edges are straight and equal up to 1e-11 of their size, a
   * shift and a common factor share one matrix, scaled by size^(dim-2): most
   * of the cells of meshes made of bricks. Where hardly any two are alike,
   * nothing is kept. */
  template <int dim> class StiffnessCache
  {
  public:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /** @p fe is a system of dim equal components; all arguments must outlive
     * this object. */
    StiffnessCache(const dealii::Mapping<dim> &mapping,
                   const dealii::FiniteElement<dim> &fe,
                   const Materials<dim> &materials);

    /** Matrix of @p cell, valid until the next call. */
    const dealii::FullMatrix<double> &matrix(const Cell &cell);

    /** The product of the matrix of @p cell with @p values; for the same cells
     * again and again. */
    void vmult(const Cell &cell, dealii::Vector<double> &product,
               const dealii::Vector<double> &values);

  private:
    /** Material, then the vertices relative to the first one. */
    using Key =
        std::array<std::int64_t,
                   1 + dim *(dealii::GeometryInfo<dim>::vertices_per_cell - 1)>;

    /** A matrix that is that of @p cell by a factor. */
    using Scaled = std::pair<const dealii::FullMatrix<double> *, double>;
    Scaled find(const Cell &cell);
    bool has_shape(const Cell &cell) const;
    Key key(const Cell &cell, double size) const;
    void compute(const Cell &cell, dealii::FullMatrix<double> &result);

    const Materials<dim> &materials;
    const dealii::FiniteElement<dim> &fe;
    const MiddleNodes<dim> *const bent; ///< null: straight, or by manifolds
    dealii::FEValues<dim> values;       ///< of one component
    std::map<Key, std::pair<double, dealii::FullMatrix<double>>> known;
    /** The same by the numbers of cells that products were asked for. */
    std::unordered_map<unsigned int, Scaled> of_cell;
    dealii::FullMatrix<double> result;
    std::size_t n_asked = 0;
  };
} // namespace abut::app

#endif

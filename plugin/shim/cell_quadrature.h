// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CELL_QUADRATURE_H
#define ABUT_SHIM_CELL_QUADRATURE_H

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/reference_cell.h>

#include <vector>

namespace abut::shim
{
  /** Whether the cells of an element are triangles or tetrahedra. */
  template <int dim> bool is_simplex(const dealii::FiniteElement<dim> &fe)
  {
    return fe.reference_cell() == dealii::ReferenceCells::get_simplex<dim>();
  }

  /** Gauss' rule for the cells of an element, exact for polynomials of degree
   * 2 n - 1 (of each coordinate, on cubes); n <= 4 on simplices. */
  template <int dim>
  dealii::Quadrature<dim> gauss(const dealii::FiniteElement<dim> &fe,
                                const unsigned int n)
  {
    if (is_simplex(fe))
      return dealii::QGaussSimplex<dim>(n);
    return dealii::QGauss<dim>(n);
  }

  /** The same for their faces. */
  template <int dim>
  dealii::Quadrature<dim - 1> face_gauss(const dealii::FiniteElement<dim> &fe,
                                         const unsigned int n)
  {
    if (dim == 3 && is_simplex(fe))
      return dealii::QGaussSimplex<dim - 1>(n);
    return dealii::QGauss<dim - 1>(n);
  }

  /** Whether a shape function has its node on a face of the cell. (On simplices
   * the function of deal.II is true for all nodes.) */
  template <int dim>
  bool has_node_on_face(const dealii::FiniteElement<dim> &fe,
                        const unsigned int function, const unsigned int face)
  {
    if (!is_simplex(fe))
      return fe.has_support_on_face(function, face);
    const dealii::FiniteElement<dim> &scalar = fe.base_element(0);
    const unsigned int node = fe.system_to_component_index(function).second;
    for (unsigned int k = 0; k < scalar.n_dofs_per_face(face); ++k)
      if (scalar.face_to_cell_index(k, face) == node)
        return true;
    return false;
  }

  /** The vertices of the cells of an element, all with the same weight. */
  template <int dim>
  dealii::Quadrature<dim> vertex_rule(const dealii::FiniteElement<dim> &fe)
  {
    if (!is_simplex(fe))
      return dealii::QTrapezoid<dim>();
    std::vector<dealii::Point<dim>> vertices;
    for (unsigned int v = 0; v < dim + 1; ++v)
      vertices.push_back(fe.base_element(0).unit_support_point(v));
    return dealii::Quadrature<dim>(vertices);
  }
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_VALUES_BY_ELEMENT_H
#define ABUT_SHIM_VALUES_BY_ELEMENT_H

#include "by_element.h"
#include "cell_quadrature.h"

#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>

namespace abut::shim
{
  /** Gauss' rules for products of two shape functions of an element. */
  template <int dim>
  dealii::Quadrature<dim> mass_rule(const dealii::FiniteElement<dim> &fe)
  {
    return gauss(fe, fe.degree + 1);
  }
  template <int dim>
  dealii::Quadrature<dim - 1>
  face_mass_rule(const dealii::FiniteElement<dim> &fe)
  {
    return face_gauss(fe, fe.degree + 1);
  }

  /** Nodes of one component of an element. */
  template <int dim>
  dealii::Quadrature<dim> nodes(const dealii::FiniteElement<dim> &fe)
  {
    return dealii::Quadrature<dim>(
        fe.base_element(0).get_unit_support_points());
  }
  template <int dim>
  dealii::Quadrature<dim - 1> face_nodes(const dealii::FiniteElement<dim> &fe)
  {
    return dealii::Quadrature<dim - 1>(
        fe.base_element(0).get_unit_face_support_points());
  }

  /** Which element values are of: that of a field, or of its components. */
  enum class ValuesOf
  {
    field,
    component
  };

  template <int dim>
  const dealii::FiniteElement<dim> &
  chosen_element(const dealii::FiniteElement<dim> &fe, const ValuesOf of)
  {
    return of == ValuesOf::field ? fe : fe.base_element(0);
  }

  /** Values in cells for each element of a field, at the points of its
   * @p rule. */
  template <int dim, class Rule>
  ByElement<dealii::FEValues<dim>>
  cell_values(const dealii::Mapping<dim> &mapping,
              const dealii::DoFHandler<dim> &dof_handler, const Rule &rule,
              const dealii::UpdateFlags flags,
              const ValuesOf of = ValuesOf::field)
  {
    return {dof_handler, [&](const dealii::FiniteElement<dim> &fe)
            {
              return dealii::FEValues<dim>(mapping, chosen_element(fe, of),
                                           rule(fe), flags);
            }};
  }

  /** The same on faces of cells. */
  template <int dim, class Rule>
  ByElement<dealii::FEFaceValues<dim>>
  face_values(const dealii::Mapping<dim> &mapping,
              const dealii::DoFHandler<dim> &dof_handler, const Rule &rule,
              const dealii::UpdateFlags flags,
              const ValuesOf of = ValuesOf::field)
  {
    return {dof_handler, [&](const dealii::FiniteElement<dim> &fe)
            {
              return dealii::FEFaceValues<dim>(mapping, chosen_element(fe, of),
                                               rule(fe), flags);
            }};
  }
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scalar_field.h"

#include "shim/by_element.h"
#include "shim/cell_quadrature.h"

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

namespace abut::app
{
  template <int dim>
  void choose_elements(const dealii::hp::FECollection<dim> &elements,
                       dealii::DoFHandler<dim> &dof_handler)
  {
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (unsigned int i = 0; i < elements.size() && cell->is_locally_owned();
           ++i)
        if (elements[i].reference_cell() == cell->reference_cell())
          cell->set_active_fe_index(i);
  }

  template <int dim>
  void distribute_linear(const dealii::DoFHandler<dim> &field,
                         dealii::DoFHandler<dim> &scalar)
  {
    dealii::hp::FECollection<dim> elements;
    for (const dealii::FiniteElement<dim> *fe : shim::elements(field))
      if (shim::is_simplex(*fe))
        elements.push_back(dealii::FE_SimplexP<dim>(1));
      else
        elements.push_back(dealii::FE_Q<dim>(1));
    if (elements.size() > 1)
      choose_elements(elements, scalar);
    scalar.distribute_dofs(elements);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template void choose_elements(const dealii::hp::FECollection<dim> &,         \
                                dealii::DoFHandler<dim> &);                    \
  template void distribute_linear(const dealii::DoFHandler<dim> &,             \
                                  dealii::DoFHandler<dim> &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NEAREST_NODE_H
#define ABUT_APP_NEAREST_NODE_H

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

namespace abut::app
{
  /** A node and what a field is there. */
  template <int dim> struct NodalValue
  {
    dealii::Point<dim> position;
    dealii::Tensor<1, dim> value;
    double cell_diameter; ///< of a cell that the node belongs to
  };

  /** The node of the body @p body (by material id) that is nearest to
   * @p point; of several the first by coordinates. @p field is ghosted, of dim
   * components. Collective; one pass over the body's cells. */
  template <int dim>
  NodalValue<dim> nearest_node(const dealii::Mapping<dim> &mapping,
                               const dealii::DoFHandler<dim> &dof_handler,
                               const la::Vector &field, unsigned int body,
                               const dealii::Point<dim> &point);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NODAL_MEANS_H
#define ABUT_APP_NODAL_MEANS_H

#include "shim/by_element.h"

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace abut::app
{
  /** Means at the nodes of a scalar field of what the cells around have there,
   * weighted by volume. */
  template <int dim> class NodalMeans
  {
  public:
    using Dofs = std::vector<dealii::types::global_dof_index>;

    /** @p scalar must outlive it. Collective. */
    NodalMeans(const dealii::DoFHandler<dim> &scalar,
               unsigned int n_components);

    /** The nodes of the cell that @p cell is in the mesh. */
    template <class Cell> const Dofs &nodes(const Cell &cell)
    {
      shim::get_dofs(typename dealii::DoFHandler<dim>::active_cell_iterator(
                         &scalar.get_triangulation(), cell->level(),
                         cell->index(), &scalar),
                     dofs);
      return dofs;
    }

    /** Add a value of each component at a node of a cell of this rank. */
    void add(dealii::types::global_dof_index node, double volume,
             const std::vector<double> &values);

    /** The means by component, without ghosts. Once. Collective. */
    std::vector<la::Vector> means();

    /** A field with the values of ghosts. Collective. */
    la::Vector ghosted(const la::Vector &field) const;

  private:
    const dealii::DoFHandler<dim> &scalar;
    const dealii::IndexSet relevant;
    std::vector<la::Vector> sums; ///< the last one of volumes
    Dofs dofs;
  };
} // namespace abut::app

#endif

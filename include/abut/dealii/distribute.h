// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_DISTRIBUTE_H
#define ABUT_DEALII_DISTRIBUTE_H

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace abut::versions
{
  /** Add the vector of a cell to one of all unknowns. With Tpetra vectors the
   * function of deal.II 9.8 that takes a whole cell without its matrix leaves
   * out unknowns of other ranks, and writes in front of the vector's memory
   * (its issue 18792: internal::ElementAccess::add()); the one that takes a
   * single unknown does not. */
  template <typename GlobalVector>
  void distribute_local_to_global(
      const dealii::AffineConstraints<double> &constraints,
      const dealii::Vector<double> &local,
      const std::vector<dealii::types::global_dof_index> &dofs,
      GlobalVector &all)
  {
    for (unsigned int i = 0; i < dofs.size(); ++i)
      constraints.distribute_local_to_global(dofs[i], local(i), all);
  }
} // namespace abut::versions

#endif

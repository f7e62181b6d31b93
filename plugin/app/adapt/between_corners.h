// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BETWEEN_CORNERS_H
#define ABUT_APP_BETWEEN_CORNERS_H

#include <abut/dealii/linear_algebra.h>

#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>

#include <set>

namespace abut::app
{
  /** Linear between the corners of facets what constraints of multipliers of
   * degree 1 have there alone, on surfaces of quadratic elements.
   *
   * @param surface boundary ids
   * @param is_linear whether multipliers have degree 1 on facets of all cells;
   * on those of tetrahedra they always do
   * @param status ContactResults::status() with ghosts: < 0 without a row
   * @param ghosted a field of the rows, with ghosts
   * @param field the same, owned; other nodes than corners are changed where
   * they have no row and a corner beside them has one */
  template <int dim>
  void fill_between_corners(const dealii::DoFHandler<dim> &dof_handler,
                            const std::set<dealii::types::boundary_id> &surface,
                            bool is_linear, const la::Vector &status,
                            const la::Vector &ghosted, la::Vector &field);
} // namespace abut::app

#endif

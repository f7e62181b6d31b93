// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_FLAG_FRACTION_H
#define ABUT_APP_FLAG_FRACTION_H

/** @file
 * Marks on meshes of which all ranks have all cells.
 */

#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace abut::app
{
  /** Flag the cells of this rank among those with the largest values, as many
   * as make up the part @p fraction of the sum of all. @p values has those of
   * own cells. Collective. */
  template <int dim>
  void flag_fraction(const dealii::Vector<float> &values, double fraction,
                     dealii::Triangulation<dim> &mesh);

  /** The refine flags of all cells. Collective. */
  template <int dim>
  std::vector<bool> gather_flags(const dealii::Triangulation<dim> &mesh);
} // namespace abut::app

#endif

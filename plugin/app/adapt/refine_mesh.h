// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_REFINE_MESH_H
#define ABUT_APP_REFINE_MESH_H

#include "app/report/section_times.h"

#include <abut/dealii/linear_algebra.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>

#include <functional>
#include <vector>

namespace abut::app
{
  /** Refine and coarsen a mesh as flagged and interpolate nodal fields.
   *
   * @param fields ghosted, of @p dof_handler
   * @param setup numbers the unknowns of the new mesh
   * @param times gets the sections `mesh` and `transfer`
   * @return the fields on the new mesh, owned entries, constraints not applied.
   * Collective. */
  template <int dim>
  std::vector<la::Vector>
  refine_mesh(dealii::Triangulation<dim> &mesh,
              const dealii::DoFHandler<dim> &dof_handler,
              const std::vector<la::Vector> &fields,
              const std::function<void()> &setup, SectionTimes &times);
} // namespace abut::app

#endif

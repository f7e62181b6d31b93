// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SOLVER_SPACE_H
#define ABUT_SHIM_SOLVER_SPACE_H

#include "solve/near_null_space.h"

#include <abut/dealii/solver_parameters.h>
#include <abut/dealii/vertex_origin.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

namespace abut::shim
{
  /** Data of the unknowns of a field for solvers with @p parameters: rigid
   * motions of the bodies if it is a displacement, and the coarser meshes if
   * multigrid may want them, see make_mesh_hierarchy(). Collective. */
  template <int dim>
  solve::NearNullSpace
  make_solver_space(const dealii::Mapping<dim> &mapping,
                    const dealii::DoFHandler<dim> &dof_handler,
                    const dealii::AffineConstraints<double> &constraints,
                    bool is_displacement, const SolverParameters &parameters,
                    const std::vector<VertexOrigin> &origins);
} // namespace abut::shim

#endif

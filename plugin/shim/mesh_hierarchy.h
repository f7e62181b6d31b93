// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_MESH_HIERARCHY_H
#define ABUT_SHIM_MESH_HIERARCHY_H

#include "solve/mesh_hierarchy.h"

#include <abut/dealii/vertex_origin.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

namespace abut::shim
{
  /** The meshes that the mesh of a field was refined from, for elements of
   * degree 1 and 2, whose own nodes are then a mesh above that of their
   * vertices;
   * @p constraints are hanging nodes and prescribed values. Hanging nodes are
   * welcome on all meshes. @p origins [vertices] give the meshes that a mesh of
   * one level was refined from; empty: its own levels do. Collective. */
  template <int dim>
  solve::MeshHierarchy
  make_mesh_hierarchy(const dealii::DoFHandler<dim> &dof_handler,
                      const dealii::AffineConstraints<double> &constraints,
                      const std::vector<VertexOrigin> &origins);
} // namespace abut::shim

#endif

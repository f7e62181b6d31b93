// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solver_space.h"

#include "bodies.h"
#include "mesh_hierarchy.h"
#include "solve/geometric_multigrid.h"

namespace abut::shim
{
  template <int dim>
  solve::NearNullSpace
  make_solver_space(const dealii::Mapping<dim> &mapping,
                    const dealii::DoFHandler<dim> &dof_handler,
                    const dealii::AffineConstraints<double> &constraints,
                    const bool is_displacement,
                    const SolverParameters &parameters,
                    const std::vector<VertexOrigin> &origins)
  {
    solve::NearNullSpace space;
    if (is_displacement)
      space = make_near_null_space(mapping, dof_handler);
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    std::vector<std::uint8_t> &prescribed = space.prescribed.change();
    prescribed.assign(owned.n_elements(), 0);
    for (const auto &line : constraints.get_lines())
      if (line.entries.empty() && owned.is_element(line.index))
        prescribed[owned.index_within_set(line.index)] = 1;
    if (solve::wants_meshes(parameters, dof_handler.n_dofs(),
                            space.n_components))
      space.meshes = std::make_shared<const solve::MeshHierarchy>(
          make_mesh_hierarchy(dof_handler, constraints, origins));
    return space;
  }

  template solve::NearNullSpace
  make_solver_space(const dealii::Mapping<2> &, const dealii::DoFHandler<2> &,
                    const dealii::AffineConstraints<double> &, bool,
                    const SolverParameters &,
                    const std::vector<VertexOrigin> &);
  template solve::NearNullSpace
  make_solver_space(const dealii::Mapping<3> &, const dealii::DoFHandler<3> &,
                    const dealii::AffineConstraints<double> &, bool,
                    const SolverParameters &,
                    const std::vector<VertexOrigin> &);
} // namespace abut::shim

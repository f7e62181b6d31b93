// SPDX-License-Identifier: LGPL-2.1-or-later
#include "refine_mesh.h"

#include "vertex_transfer.h"

#include <abut/dealii/versions.h>

#include <memory>

namespace abut::app
{
  template <int dim>
  std::vector<la::Vector>
  refine_mesh(dealii::Triangulation<dim> &mesh,
              const dealii::DoFHandler<dim> &dof_handler,
              const std::vector<la::Vector> &fields,
              const std::function<void()> &setup, SectionTimes &times)
  {
    versions::SolutionTransfer<dim, la::Vector> transfer(dof_handler);
    std::unique_ptr<VertexTransfer<dim>> by_vertices;
    {
      SectionTimes::Scope scope(times, "mesh");
      mesh.prepare_coarsening_and_refinement();
      if (VertexTransfer<dim>::is_possible(dof_handler))
        by_vertices =
            std::make_unique<VertexTransfer<dim>>(dof_handler, fields);
      else
      {
        std::vector<const la::Vector *> old;
        for (const la::Vector &field : fields)
          old.push_back(&field);
        transfer.prepare_for_coarsening_and_refinement(old);
      }
      mesh.execute_coarsening_and_refinement();
    }
    setup();
    SectionTimes::Scope scope(times, "transfer");
    if (by_vertices)
      return by_vertices->interpolate();
    std::vector<la::Vector> result(fields.size());
    std::vector<la::Vector *> destination;
    for (la::Vector &field : result)
    {
      field.reinit(dof_handler.locally_owned_dofs(),
                   versions::communicator(dof_handler));
      destination.push_back(&field);
    }
    transfer.interpolate(destination);
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<la::Vector> refine_mesh<dim>(                           \
      dealii::Triangulation<dim> &, const dealii::DoFHandler<dim> &,           \
      const std::vector<la::Vector> &, const std::function<void()> &,          \
      SectionTimes &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

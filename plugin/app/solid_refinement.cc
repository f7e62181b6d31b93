// SPDX-License-Identifier: LGPL-2.1-or-later
// The meshes of the scene `solid`: error estimate, refinement, transfer.
#include "contact_refinement.h"
#include "elastic_estimator.h"
#include "solid_run.h"

#include <deal.II/distributed/grid_refinement.h>

namespace abut::app
{
  template <int dim> void SolidRun<dim>::estimate()
  {
    SectionTimes::Scope scope(report.times, "error estimate");
    const la::Vector displacement = elasticity.ghosted(u);
    ElasticEstimatorInput<dim> input{elasticity.mapping, elasticity.dof_handler,
                                     displacement, data.materials};
    for (const auto &[body, force] : data.body_force)
      input.body_force[body] = force;
    for (const auto &[id, traction] : data.tractions)
      input.traction[id] = traction.function;
    for (const auto &[id, pressure] : data.pressures)
      input.pressure_load[id] = pressure.function;
    for (const auto &[id, support] : data.supports)
      input.supports[id] = support.components;
    present.estimate = estimate_elastic_error(input, squared_estimate);
  }

  template <int dim> void SolidRun<dim>::set_refine_flags()
  {
    SectionTimes::Scope scope(report.times, "mesh");
    const RefinementParameters &levels = parameters.refinement;
    if (mesh_number >= levels.level)
      dealii::parallel::distributed::GridRefinement::
          refine_and_coarsen_fixed_fraction(triangulation, squared_estimate,
                                            levels.refine_fraction,
                                            levels.coarsen_fraction);
    else
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          cell->set_refine_flag();
  }

  template <int dim> void SolidRun<dim>::refine()
  {
    set_refine_flags();
    std::vector<la::Vector> fields = {elasticity.ghosted(u)};
    if (!pairs->empty())
      fields.push_back(elasticity.ghosted_field(contact.pressure()));
    fields = refine_mesh<dim>(
        triangulation, elasticity.dof_handler, fields, [this] { setup_mesh(); },
        report.times);
    u = fields[0];
    if (!pairs->empty())
      pressure = fields[1];
    ++mesh_number;
  }

  template void SolidRun<2>::estimate();
  template void SolidRun<2>::set_refine_flags();
  template void SolidRun<2>::refine();
  template void SolidRun<3>::estimate();
  template void SolidRun<3>::set_refine_flags();
  template void SolidRun<3>::refine();
} // namespace abut::app

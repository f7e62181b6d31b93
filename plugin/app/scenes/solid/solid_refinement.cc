// SPDX-License-Identifier: LGPL-2.1-or-later
// The meshes of the scene `solid`: error estimate, refinement, transfer.
#include "app/adapt/contact_refinement.h"
#include "app/adapt/elastic_estimator.h"
#include "app/mesh/memory_check.h"
#include "app/physics/contact_traction.h"
#include "solid_run.h"

#include <deal.II/distributed/grid_refinement.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  template <int dim> ContactFields SolidRun<dim>::contact_fields() const
  {
    if (pairs->empty())
      return {};
    return {contact_traction(elasticity.mapping, elasticity.dof_handler,
                             elasticity.constraints, elasticity.hanging,
                             data.materials, pairs->surfaces(),
                             elasticity.unbalanced_forces(u)),
            elasticity.ghosted_field(contact.pressure()),
            elasticity.ghosted_field(contact.gap()),
            elasticity.ghosted_field(contact.status())};
  }

  template <int dim> void SolidRun<dim>::estimate()
  {
    SectionTimes::Scope scope(report.times, "error estimate");
    const la::Vector displacement = elasticity.ghosted(u);
    const ContactFields fields = contact_fields();
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
    if (!pairs->empty())
    {
      input.contact = pairs->surfaces();
      input.contact_traction = &fields.traction;
      input.secondary = pairs->secondary();
      input.pressure = &fields.pressure;
      // With a target, what the law leaves open is an error of its own.
      const bool exact_law = abut_law_is_exact(method.options.law)
                             || abut_law_needs_stress(method.options.law);
      input.gap = control.is_on() && !exact_law ? nullptr : &fields.gap;
    }
    present.estimate = estimate_elastic_error(input, squared_estimate);
  }

  template <int dim> double SolidRun<dim>::solution_norm() const
  {
    // The energy is 1/2 |u|^2 - f u.
    const double twice = 2. * (elasticity.energy(u) + elasticity.external * u);
    return std::sqrt(std::max(0., twice));
  }

  template <int dim> void SolidRun<dim>::judge()
  {
    SectionTimes::Scope scope(report.times, "error estimate");
    MeshEvidence evidence;
    evidence.residual = *present.estimate;
    if (control.start().size() > 0)
    {
      la::Vector change(u);
      change -= control.start();
      evidence.change = elasticity.energy_norm(change);
    }
    evidence.norm = solution_norm();
    if (!pairs->empty())
    {
      // Nitsche's method is consistent: its gaps are the mesh's error.
      if (!abut_law_needs_stress(method.options.law))
        evidence.law = contact.complementarity_error();
      evidence.contact_force = contact.contact_force();
    }
    present.error_parts = control.judge(evidence);
  }

  template <int dim> void SolidRun<dim>::set_refine_flags()
  {
    SectionTimes::Scope scope(report.times, "mesh");
    const RefinementParameters &levels = parameters.refinement;
    if (!levels.is_adaptive(mesh_number))
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          cell->set_refine_flag();
      return;
    }
    dealii::parallel::distributed::GridRefinement::
        refine_and_coarsen_fixed_fraction(triangulation, squared_estimate,
                                          control.is_on()
                                              ? control.refine_fraction()
                                              : levels.refine_fraction,
                                          levels.coarsen_fraction);
    if (pairs->empty())
      return;
    flag_contact_border(elasticity.dof_handler,
                        elasticity.ghosted_field(contact.status()),
                        pairs->secondary());
    limit_size_ratio(triangulation, pairs->sides());
  }

  template <int dim> void SolidRun<dim>::refine()
  {
    set_refine_flags();
    if (control.is_on())
      check_memory_of_flags(triangulation, parameters.degree,
                            "Refinement/Target error", dim);
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
    la::Vector start(u);
    elasticity.constraints.distribute(start);
    control.begin_mesh(start);
  }

  template ContactFields SolidRun<2>::contact_fields() const;
  template ContactFields SolidRun<3>::contact_fields() const;
  template double SolidRun<2>::solution_norm() const;
  template void SolidRun<2>::judge();
  template double SolidRun<3>::solution_norm() const;
  template void SolidRun<3>::judge();
  template void SolidRun<2>::estimate();
  template void SolidRun<2>::set_refine_flags();
  template void SolidRun<2>::refine();
  template void SolidRun<3>::estimate();
  template void SolidRun<3>::set_refine_flags();
  template void SolidRun<3>::refine();
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
// What a run measures of each answer, and whether it may be used.
#include "contact_run.h"

#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "diagnosis.h"
#include "name_parameter.h"
#include "shim/examination_limits.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace abut::app
{
  template <int dim> double ContactRun<dim>::counted_seconds() const
  {
    return report.times.seconds("assembly") + report.times.seconds("transfer")
           + report.times.seconds(model.rows_section())
           + report.times.seconds("solve");
  }

  template <int dim> void ContactRun<dim>::judge()
  {
    SectionTimes::Scope scope(report.times, "error estimate");
    MeshEvidence evidence;
    evidence.residual = *state.present.estimate;
    if (state.control.start().size() > 0)
    {
      la::Vector change(state.u);
      change -= state.control.start();
      evidence.change = model.problem().energy_norm(change);
    }
    evidence.norm = model.solution_norm();
    if (model.has_contact())
    {
      const ContactMeasures measures = state.contact.results().measures();
      // Nitsche's method is consistent: its gaps are the mesh's error.
      // A user's own law is what it is.
      if (!abut_law_needs_stress(state.method.options.law)
          && state.method.user_law == nullptr)
        evidence.law = measures.complementarity_error;
      evidence.contact_force = measures.force;
      refuse_prescribed_force();
    }
    state.present.error_parts = state.control.judge(evidence);
  }

  /* No mesh changes such a force, and the first one would meet any target. */
  template <int dim> void ContactRun<dim>::refuse_prescribed_force() const
  {
    if (state.settings.refinement.target_quantity
        != TargetQuantity::contact_force)
      return;
    const std::string why = model.why_force_is_prescribed();
    if (!why.empty())
      throw InputError("Refinement/Target quantity",
                       "The loads prescribe the contact force: " + why
                           + ", so it is the same on every mesh and does not "
                             "show the error of the mesh. Set it to energy "
                             "norm.");
  }

  template <int dim> void ContactRun<dim>::add_missed_contact()
  {
    dealii::Vector<float> depth;
    double largest = 0.;
    name_parameter(
        model,
        [&] { largest = state.contact.checks().missed_depth(state.u, depth); });
    if (largest == 0.)
      return;
    double sum = 0.;
    for (const auto &cell : model.triangulation.active_cell_iterators())
      if (const double d = depth(cell->active_cell_index()); d > 0.)
      {
        const double h = cell->diameter() / std::sqrt(double(dim));
        const double term =
            model.stiffness_of(cell) * d * d * std::pow(h, dim - 2);
        state.squared_estimate(cell->active_cell_index()) += term;
        sum += term;
      }
    const double before = *state.present.estimate;
    state.present.estimate = std::sqrt(
        before * before + dealii::Utilities::MPI::sum(sum, state.communicator));
  }

  template <int dim>
  std::optional<ContactFinding> ContactRun<dim>::examine_works()
  {
    const MethodParameters &method = state.method;
    const DiscreteProblem<dim> &problem = model.problem();
    // What a law stores on purpose is no contradiction, and Nitsche's method
    // has no nodal forces of its own. Energies of motions have a balance of
    // their own. Forces at points that move turn on the way, so that their work
    // is no product.
    const bool stores = method.user_law != nullptr
                        || method.options.allowed_penetration > 0.
                        || abut_law_needs_stress(method.options.law);
    if (!problem.is_linear() || model.has_inertia()
        || (model.has_contact() && (stores || state.contact.points_move())))
      return {};
    la::Vector forces;
    Works works = find_works(problem, state, model.has_contact(), forces);
    if (model.has_contact())
    {
      const std::optional<double> open =
          model.work_on_gaps(forces, works.contact);
      if (!open)
        return {};
      works.open_gaps = *open;
    }
    return diagnose_works(report, works, size_of_cells(),
                          state.contact.iteration().progress.penalty);
  }

  template <int dim> double ContactRun<dim>::size_of_cells()
  {
    if (!largest_cell)
    {
      double size = 0.;
      for (const auto &cell : model.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          size = std::max(size, cell->diameter());
      largest_cell = dealii::Utilities::MPI::max(size, state.communicator);
    }
    return *largest_cell;
  }

  template <int dim> void ContactRun<dim>::report_motions()
  {
    for (BodyMotion &motion : examination.motions)
    {
      const std::string body = "body_" + std::to_string(motion.body + 1);
      const double *const along = &motion.translation[0];
      report.set(body + "_moved", std::vector<double>(along, along + dim));
      const double *const turned = &motion.rotation[0];
      if (dim == 2)
        report.set(body + "_rotated", turned[2]);
      else
        report.set(body + "_rotated", std::vector<double>(turned, turned + 3));
    }
  }

  template <int dim> bool ContactRun<dim>::examine()
  {
    SectionTimes::Scope scope(report.times, "results");
    if (!model.has_contact())
    {
      const DiscreteProblem<dim> &problem = model.problem();
      state.contact.reinit(problem.mapping, problem.dof_handler,
                           problem.constraints);
      contact_is_ready = false; // what it was told is gone
    }
    name_parameter(model,
                   [&]
                   {
                     examination = state.contact.checks().examine(
                         state.u, {}, model.allows_large_strain());
                   });
    std::vector<ContactFinding> &findings = examination.findings;
    for (ContactFinding &finding : findings)
    {
      if (finding.failure == ABUT_FAILURE_LARGE_STRAIN && finding.is_error)
        finding.text += " If such strains are meant, set Solid/Accept strains "
                        "beyond linear theory.";
      if (model.has_inertia() && finding.failure == ABUT_FAILURE_FLOATING_BODY)
      {
        finding.text = coded(ABUT_FAILURE_FLOATING_BODY, inertia_vanishes).text;
        finding.is_error = true;
      }
    }
    // Points that close late are a matter of all load steps.
    findings.erase(
        std::remove_if(findings.begin(), findings.end(),
                       [&](const ContactFinding &finding)
                       {
                         return finding.failure == ABUT_FAILURE_LATE_CONTACT
                                || (finding.failure == ABUT_FAILURE_LARGE_STRAIN
                                    && model.has_large_strain());
                       }),
        findings.end());
    for (const ContactFinding &found : model.examine_materials())
      findings.push_back(found);
    light_touches.sort(examination, state.load_steps.is_finished(),
                       !model.has_inertia());
    report_motions();
    if (!model.has_large_strain())
    {
      const bool allows = model.allows_large_strain();
      report.examined(
          "largest_strain", examination.strain, shim::visible_strain,
          allows ? no_limit : shim::useless_strain, ABUT_FAILURE_LARGE_STRAIN);
      report.examined("mean_strain", examination.mean_strain, no_limit,
                      allows ? no_limit : shim::useless_mean_strain,
                      ABUT_FAILURE_LARGE_STRAIN);
      using shim::rotation_with;
      report.examined("largest_rotation", examination.rotation,
                      rotation_with(shim::visible_strain),
                      allows ? no_limit : rotation_with(shim::useless_strain),
                      ABUT_FAILURE_LARGE_STRAIN);
      report.examined("mean_rotation", examination.mean_rotation, no_limit,
                      allows ? no_limit
                             : rotation_with(shim::useless_mean_strain),
                      ABUT_FAILURE_LARGE_STRAIN);
    }
    report.set("largest_strain", examination.strain);
    report.set("largest_rotation", examination.rotation);
    report.set("deformation", examination.deformation);
    report.set("missed_depth", examination.missed_depth);
    if (const std::optional<ContactFinding> found = examine_works())
      findings.push_back(*found);
    return examination.is_usable();
  }

  template <int dim> void ContactRun<dim>::finish_result()
  {
    ContactResult &present = state.present;
    model.end_solve();
    const ContactAssembler<dim> &contact = state.contact;
    if (state.settings.refinement.is_adaptive(state.mesh_number))
    {
      SectionTimes::Scope scope(report.times, "error estimate");
      present.estimate = model.estimate(state.squared_estimate);
      if (model.has_contact())
        add_missed_contact();
    }
    if (state.control.is_on() && state.load_steps.n_accepted() == 0)
      judge();
    const double counted = counted_seconds();
    present.seconds = counted - counted_before;
    counted_before = counted;
    SectionTimes::Scope scope(report.times, "results");
    present.cells = model.triangulation.n_global_active_cells();
    present.dofs = model.problem().dof_handler.n_dofs();
    present.energy = model.energy(state.u);
    if (model.has_contact())
    {
      present.progress = contact.iteration().progress;
      const ContactMeasures measures = contact.results().measures();
      present.rows = measures.n_rows;
      present.active = measures.n_active;
      present.force = measures.force;
      present.penetration = measures.penetration;
      const DetectionReport detection = contact.results().effort().detection;
      present.detection = detection.since(state.detection);
      state.detection = detection;
    }
    present.errors = model.errors();
    std::map<std::string, double> row = result_row(present);
    model.add_to_row(present, row);
    report.add_row(row);
    state.results.push_back(present);
    report.add("nonlinear_iterations", present.steps);
    if (model.has_contact() && !abut_law_solves_once(state.method.options.law))
      report.add("outer_iterations", present.progress.outer);
    if (!model.problem().is_linear())
      report.add("linearisations", present.linearisations);
    report.add("linear_iterations", present.linear.n_iterations);
    report.add("matvecs", present.linear.n_matvecs);
    const double end = state.settings.load_steps.end_time;
    const bool has_steps = state.settings.load_steps.steps > 1;
    report.progress(model.line_of(present) + state.control.progress(),
                    has_steps ? present.time / end : std::optional<double>());
  }

  template double ContactRun<2>::counted_seconds() const;
  template void ContactRun<2>::judge();
  template void ContactRun<2>::add_missed_contact();
  template std::optional<ContactFinding> ContactRun<2>::examine_works();
  template double ContactRun<2>::size_of_cells();
  template void ContactRun<2>::report_motions();
  template bool ContactRun<2>::examine();
  template void ContactRun<2>::finish_result();
  template double ContactRun<3>::counted_seconds() const;
  template void ContactRun<3>::judge();
  template void ContactRun<3>::add_missed_contact();
  template std::optional<ContactFinding> ContactRun<3>::examine_works();
  template double ContactRun<3>::size_of_cells();
  template void ContactRun<3>::report_motions();
  template bool ContactRun<3>::examine();
  template void ContactRun<3>::finish_result();
} // namespace abut::app

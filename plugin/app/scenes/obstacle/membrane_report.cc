// SPDX-License-Identifier: LGPL-2.1-or-later
// What a run of the scene `obstacle` leaves behind.
#include "membrane_report.h"
#include "app/pictures/nodal_table.h"
#include "app/scenes/diagnosis.h"
#include "app/scenes/left_out.h"
#include "app/scenes/modelled.h"
#include "app/scenes/nodal_forces.h"
#include "solve/masked_solver.h"

#include <deal.II/base/timer.h>

namespace abut::app
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    double median(std::vector<double> values)
    {
      std::sort(values.begin(), values.end());
      const std::size_t n = values.size();
      return 0.5 * (values[n / 2] + values[(n - 1) / 2]);
    }
  } // namespace

  template <int dim>
  MembraneReport<dim>::MembraneReport(const MembraneModel<dim> &model)
      : model(model),
        run(model.run),
        parameters(model.parameters),
        membrane(model.membrane),
        contact(run.contact),
        levels(run.results),
        u(run.u),
        communicator(run.communicator),
        report(run.report)
  {
  }

  template <int dim> void MembraneReport<dim>::write_nodal_values() const
  {
    SectionTimes::Scope scope(report.times, "output");
    la::Vector displacement(u);
    membrane.constraints.distribute(displacement);
    std::vector<NodalColumn> columns = {{"displacement", displacement}};
    columns.push_back(
        {"pressure", membrane.ghosted_field(contact.results().pressure())});
    columns.push_back({"gap", model.gaps()});
    columns.push_back(
        {"status", membrane.ghosted_field(contact.results().status())});
    for (NodalColumn &column : force_columns(
             membrane, run, membrane.nodal_forces(u), true,
             model.motion ? &model.motion->bodies().unbalanced_forces()
                          : nullptr))
      columns.push_back(std::move(column));
    write_nodal_table(run.options.output_folder / "nodal.csv", membrane.mapping,
                      membrane.dof_handler, columns);
  }

  template <int dim> double MembraneReport<dim>::counted_seconds() const
  {
    return report.times.seconds("assembly") + report.times.seconds("transfer")
           + report.times.seconds(model.rows_section())
           + report.times.seconds("solve");
  }

  template <int dim>
  void
  MembraneReport<dim>::compare_with_linear_solves(Membrane<dim> &problem) const
  {
    std::vector<double> seconds, processor_seconds;
    unsigned int iterations = 0;
    for (unsigned int i = 0; i < parameters.linear_solves; ++i)
    {
      dealii::Timer timer(communicator, true);
      problem.assemble(model.data);
      SolverParameters settings;
      settings.linear = SolverParameters::Linear::iterative;
      solve::MaskedSolver solver(settings);
      solver.reinit(problem.stiffness);
      solve::Mask nothing;
      nothing.held.assign(la::n_owned(u), 0);
      la::Vector x = problem.vector();
      la::Vector force(problem.load);
      problem.constraints.set_zero(force);
      iterations =
          solver.solve(nothing, force, 1e-10 * force.l2_norm(), x, true)
              .n_iterations;
      timer.stop();
      seconds.push_back(timer.wall_time());
      processor_seconds.push_back(timer.cpu_time());
    }
    const double reference = median(seconds);
    const double mine = MPI::max(counted_seconds(), communicator);
    report.set("linear_solve_seconds", reference);
    report.set("linear_solve_processor_seconds", median(processor_seconds));
    report.set("linear_solve_iterations", iterations);
    report.set("contact_solve_seconds", mine);
    report.set("contact_to_linear_ratio", mine / reference);
    report.detail("contact solve " + std::to_string(mine)
                  + " s on all levels, one linear solve "
                  + std::to_string(reference) + " s, ratio "
                  + std::to_string(mine / reference));
  }

  template <int dim>
  std::optional<double> MembraneReport<dim>::relative_error() const
  {
    const ContactResult &last = levels.back();
    if (parameters.refinement.target_quantity == TargetQuantity::contact_force)
    {
      if (std::isnan(parameters.exact_force))
        return {};
      return std::abs(last.force / parameters.exact_force - 1.);
    }
    if (!last.errors || !model.conductivity->is_constant())
      return {};
    return std::sqrt(model.conductivity->value(dealii::Point<dim>()))
           * last.errors->h1_seminorm / model.solution_norm();
  }

  template <int dim>
  void MembraneReport<dim>::report_errors(const ContactResult &last) const
  {
    if (last.errors)
    {
      report.set("l2_error", last.errors->l2);
      report.set("h1_error", last.errors->h1_seminorm);
      report.set("nodal_error", last.errors->largest_node);
    }
    const auto compare =
        [&](const std::string &key, const double value, const double exact)
    {
      if (std::isnan(exact))
        return;
      report.set(key + "_error", std::abs(value - exact));
      report.expect(key, exact);
    };
    compare("energy", last.energy, parameters.exact_energy);
    compare("contact_force", last.force, parameters.exact_force);
    if (last.estimate)
      report_estimate(report, *last.estimate,
                      run.control.is_on() ? 0. : model.solution_norm());
  }

  template <int dim> void MembraneReport<dim>::report_shares() const
  {
    const la::LocalRows rows = la::local_rows(membrane.stiffness);
    const double here[2] = {
        double(model.triangulation.n_locally_owned_active_cells()),
        double(rows.start[rows.n_rows])};
    const auto cells = MPI::min_max_avg(here[0], communicator);
    const auto entries = MPI::min_max_avg(here[1], communicator);
    report.set("largest_share_of_cells", cells.max / cells.sum);
    report.set("largest_share_of_matrix", entries.max / entries.sum);
  }

  template <int dim> void MembraneReport<dim>::report_motion() const
  {
    report.set("load_steps", run.load_steps.n_accepted());
    report.set("load_steps_cut_back", run.load_steps.n_rejected());
    report.set("time", levels.back().time);
    model.motion->report();
  }

  template <int dim>
  void MembraneReport<dim>::result(const bool converged) const
  {
    report.set("converged", converged);
    report.set("method", run.method.options.law->name);
    if (levels.empty())
      return;
    const ContactResult &last = levels.back();
    report.set("discretisation", "nodal");
    report.set("dofs", last.dofs);
    report.set("constraints", last.rows);
    report.set("active", last.active);
    report.set("contact_force", last.force);
    const ContactMeasures measures = contact.results().measures();
    report.set("max_penetration", measures.penetration);
    report.set("allowed_penetration", measures.allowed_penetration);
    report.set("max_complementarity", last.progress.complementarity);
    report.set("energy", last.energy);
    report.set("search_rebuilds", 0);
    report.set("pairs", 0);
    report_errors(last);
    diagnose_data(report, membrane.load_error(model.data),
                  membrane.support_error(model.data));
    report.set("cells", last.cells);
    report.set("steps_on_last_level", last.steps);
    report.set("linear_iterations_on_last_level", last.linear.n_iterations);
    report_shares();
    if (model.motion)
      report_motion();
    std::vector<double> energies;
    double condition = 0.;
    for (const ContactResult &level : levels)
    {
      condition = std::max(condition, level.linear.condition);
      if (level.level <= parameters.refinement.level && !model.motion)
        energies.push_back(level.energy);
    }
    if (converged && !parameters.refinement.has_target())
      diagnose_order(report, energies);
    diagnose_condition(report, condition, last.progress.penalty);
    if (run.control.is_on())
      run.control.report(report, relative_error());
  }

  template <int dim> void MembraneReport<dim>::model_lines() const
  {
    report.model("contact rows", true,
                 model.contact_ids.empty()
                     ? "one for each free node of the domain"
                     : "one for each free node of the contact "
                       "boundary",
                 {"contact rows and start"});
    const std::size_t n_meshes = model.motion ? 1 : levels.size();
    report.model("meshes", true,
                 std::to_string(n_meshes)
                     + ", with unknowns and pattern of each",
                 {"mesh", "unknowns and pattern", "transfer"});
    report.model("stiffness", true, "assembled once on each mesh",
                 {"assembly"});
    report.model("search", false,
                 "the obstacle is a function: its gap needs no search");
    report.model("friction", false, "a scalar field has no tangent to slide");
    report.model("inertia", model.has_inertia(),
                 model.has_inertia()
                     ? std::string("scheme ") + parameters.time.scheme.name
                     : "the membrane is in equilibrium");
    const RefinementParameters &refinement = parameters.refinement;
    model_meshes(report, refinement);
    const ContactResult last = levels.empty() ? ContactResult() : levels.back();
    const LinearReport &linear = last.linear;
    report.model("preconditioner set-ups on the last level",
                 linear.n_setups > 0,
                 std::to_string(linear.n_setups) + " for "
                     + std::to_string(last.steps) + " steps");
    unsigned int n_steps = 0;
    for (const ContactResult &level : levels)
      n_steps += level.steps;
    model_linear_systems(report, std::to_string(n_steps) + " on all meshes",
                         linear);
    model_files(report, parameters.fields || run.options.pictures);
    explain_accuracy(report, refinement, run.control);
    explain_steps(report, refinement, run.method, n_steps,
                  static_cast<unsigned int>(levels.size()));
    explain_output(report);
  }

  template class MembraneReport<2>;
  template class MembraneReport<3>;
} // namespace abut::app

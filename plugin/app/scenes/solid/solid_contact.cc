// SPDX-License-Identifier: LGPL-2.1-or-later
// The contact iteration of the scene `solid`.
#include "app/input/input_error.h"
#include "app/physics/elastic_normal_stress.h"
#include "app/scenes/diagnosis.h"
#include "solid_run.h"

namespace abut::app
{
  namespace
  {
    /** Penetrations without a row count when they are larger than this part of
     * the largest displacement. */
    constexpr double missed_part = 1e-3;

    /** Searches on the deformed bodies after which a step is given up. */
    constexpr unsigned int most_rounds = 5;
  } // namespace

  template <int dim> void SolidRun<dim>::begin_contact()
  {
    SectionTimes::Scope scope(report.times, "contact rows");
    if (!contact_is_ready)
    {
      const bool loose = !is_last_mesh() && !exact && !parameters.all_levels;
      contact.set_parameters(loose && !control.is_on()
                                 ? parameters.refinement.loosened(method)
                                 : control.method(),
                             solver);
      contact.reinit(elasticity.mapping, elasticity.dof_handler,
                     elasticity.constraints);
      if (pressure.size() > 0)
        contact.set_pressure(pressure);
      contact_is_ready = true;
    }
    pairs->set_time(present.time);
    contact.set_pairs(pairs->pairs());
    contact.set_normal_stress(std::make_shared<ElasticNormalStress<dim>>(
        elasticity.mapping, data.materials));
  }

  template <int dim> void SolidRun<dim>::detect()
  {
    SectionTimes::Scope scope(report.times, "contact rows");
    try
    {
      contact.detect(u);
      ++n_detections;
    }
    catch (const ContactError &error)
    {
      throw InputError(pairs->parameter_of(error.what()), error.what());
    }
  }

  template <int dim> void SolidRun<dim>::warn_of_pairs()
  {
    if (has_warned || !is_last_mesh())
      return;
    has_warned = true;
    for (const PairCheck &check : contact.pair_checks())
      for (const std::string &warning : check.warnings)
        report.warn(about(check.name, warning));
  }

  template <int dim> void SolidRun<dim>::iterate()
  {
    SectionTimes::Scope scope(report.times, "solve");
    la::Vector residual = elasticity.vector();
    la::Vector increment = elasticity.vector();
    if (abut_law_needs_open_start(method.options.law))
    {
      elasticity.residual(u, residual);
      contact.relax(elasticity.stiffness, residual,
                    parameters.refinement.relaxation_sweeps, u);
    }
    bool goes_on = true;
    while (goes_on)
    {
      elasticity.residual(u, residual);
      const LinearReport linear =
          contact.solve(elasticity.stiffness, residual, increment);
      u += increment;
      goes_on = contact.update(u);
      present.linear += linear;
      present.steps += linear.n_systems;
      if (control.is_on())
        control.note_step(elasticity.energy_norm(increment), linear.tolerance);
      steps.add(report, present.level, present.steps, contact.progress(),
                linear);
    }
    elasticity.constraints.distribute(u);
    present.reason = contact.reason();
    present.progress = contact.progress();
  }

  template <int dim> bool SolidRun<dim>::is_held()
  {
    for (unsigned int body = 0; body < bodies.size(); ++body)
    {
      if (freedom[body].n_modes == 0)
        continue;
      bool held = false;
      const std::vector<PairResult<dim>> results = contact.pair_results();
      for (std::size_t i = 0; i < results.size(); ++i)
      {
        const ContactPair<dim> &pair = pairs->pairs()[i];
        if (pair.secondary == pair.primary)
          continue;
        for (const auto *side : {&pair.secondary, &pair.primary})
          for (const dealii::types::boundary_id id : *side)
            held =
                held || (bodies.body_of(id) == body && results[i].n_active > 0);
      }
      if (held)
        continue;
      failure = coded(
          ABUT_FAILURE_FLOATING_BODY,
          "Nothing holds body " + std::to_string(body + 1)
              + ": its supports allow " + freedom[body].description
              + ", and it touches nothing. Press it against something, or "
                "give it a support (Body "
              + std::to_string(body + 1) + "/Support).");
      return false;
    }
    return true;
  }

  template <int dim> bool SolidRun<dim>::is_balanced()
  {
    // Coarser meshes are solved roughly on purpose, and with a target error
    // all are; and not every variant of Nitsche's method balances forces.
    if (!is_last_mesh() || parameters.refinement.has_target()
        || (abut_law_needs_stress(method.options.law)
            && method.nitsche_theta != 0.))
      return true;
    la::Vector residual = elasticity.vector();
    elasticity.residual(u, residual);
    return diagnose_balance(
        report, contact.imbalance(residual, 1e-4 * elasticity.load.l2_norm()),
        contact.progress().penalty, failure);
  }

  template <int dim> bool SolidRun<dim>::is_complete()
  {
    SectionTimes::Scope scope(report.times, "contact rows");
    const double largest = u.linfty_norm();
    if (largest == 0.)
      return true;
    const auto missed = contact.check_penetration(u, missed_part * largest);
    if (missed.empty())
      return true;
    report.progress("  " + std::to_string(missed.size())
                    + " nodes have penetrated without a constraint: "
                    + "searching again");
    return false;
  }

  template <int dim> bool SolidRun<dim>::solve_with_contact()
  {
    elasticity.constraints.distribute(u);
    begin_contact();
    for (unsigned int round = 0; round < most_rounds; ++round)
    {
      n_rebuilds += round > 0;
      detect();
      warn_of_pairs();
      iterate();
      if (present.reason != ABUT_REASON_CONVERGED)
      {
        failure = coded(contact.failure(),
                        "The contact iteration ended without an answer after "
                            + std::to_string(present.steps)
                            + " steps: " + contact.explanation());
        return false;
      }
      if (!is_held() || !is_balanced())
        return false;
      diagnose_iteration(report, contact.progress(),
                         !parameters.refinement.nested && round == 0
                             && load_steps.n_accepted == 0
                             && abut_law_solves_once(method.options.law));
      if (is_complete())
        return true;
    }
    failure = coded(
        ABUT_FAILURE_NO_PARTNER,
        "Nodes keep on penetrating without a constraint after "
            + std::to_string(most_rounds)
            + " searches: use smaller load steps (Load steps/Steps), or a "
              "larger Reach of the pair.");
    return false;
  }

  template void SolidRun<2>::begin_contact();
  template void SolidRun<2>::detect();
  template void SolidRun<2>::warn_of_pairs();
  template void SolidRun<2>::iterate();
  template bool SolidRun<2>::is_held();
  template bool SolidRun<2>::is_balanced();
  template bool SolidRun<2>::is_complete();
  template bool SolidRun<2>::solve_with_contact();
  template void SolidRun<3>::begin_contact();
  template void SolidRun<3>::detect();
  template void SolidRun<3>::warn_of_pairs();
  template void SolidRun<3>::iterate();
  template bool SolidRun<3>::is_held();
  template bool SolidRun<3>::is_balanced();
  template bool SolidRun<3>::is_complete();
  template bool SolidRun<3>::solve_with_contact();
} // namespace abut::app

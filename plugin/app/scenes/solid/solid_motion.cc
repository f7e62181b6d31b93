// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_motion.h"

#include "app/input/short_number.h"
#include "app/pictures/time_picture.h"

#include <abut/dealii/coded.h>

#include <cmath>

namespace abut::app
{
  namespace
  {
    constexpr const char *axes[] = {"x", "y", "z"};

    /** The column of the table; 2D has one axis. */
    template <int dim> std::string angular_momentum_about(const unsigned int r)
    {
      return std::string("angular_momentum_") + axes[dim == 2 ? 2 : r];
    }

    /** How far surfaces in contact may go in a step, whose points are those of
     * its beginning: parts of a facet, and radian. */
    constexpr double largest_slip = 0.5, largest_turn = 5. * M_PI / 180.;

    template <int dim>
    std::vector<double> components(const dealii::Tensor<1, dim> &vector)
    {
      return {vector.begin_raw(), vector.end_raw()};
    }
  } // namespace

  template <int dim>
  SolidMotion<dim>::SolidMotion(const SolidParameters &parameters,
                                const ContactRunState<dim> &run,
                                Elasticity<dim> &elasticity)
      : parameters(parameters),
        run(run),
        elasticity(elasticity),
        motion(elasticity,
               {parameters.time.scheme, parameters.time.mass_damping,
                parameters.time.stiffness_damping})
  {
    balance.struct_size = sizeof(balance);
  }

  template <int dim>
  void SolidMotion<dim>::setup(
      const std::map<dealii::types::material_id, double> &density,
      const std::set<dealii::types::boundary_id> &touching)
  {
    motion.setup({density, parameters.time.mass, touching});
  }

  template <int dim>
  la::Vector SolidMotion<dim>::start(std::pair<la::Vector, la::Vector> initial)
  {
    auto &[displacement, velocity] = initial;
    elasticity.constraints.distribute(displacement);
    elasticity.hanging.distribute(velocity);
    motion.start(displacement, velocity);
    const std::size_t n = parameters.pairs.size();
    const std::vector<std::vector<double>> nothing(
        n, std::vector<double>(dim, 0.));
    records = {{motion.record(), nothing, nothing, std::vector<double>(n, 0.)}};
    balance = {};
    balance.struct_size = sizeof(balance);
    dissipated = work = 0.;
    abut_time_verdict verdict;
    judge(records.back().bodies.energy, verdict);
    look_at_step();
    return displacement;
  }

  template <int dim> void SolidMotion<dim>::look_at_step()
  {
    const double limit = motion.stable_step();
    if (!std::isfinite(limit))
      return;
    run.report.set("stable_time_step", limit);
    if (parameters.time.step > limit)
      run.report.warn(coded(ABUT_FAILURE_BLOW_UP,
                            "the time step is above the limit of the scheme, "
                                + short_number(limit, 4)
                                + ": make Time/Step smaller"));
  }

  template <int dim> double SolidMotion<dim>::step_length() const
  {
    // Differences of times have round-off; steps are equal or halved.
    const double full =
        parameters.load_steps.end_time / parameters.load_steps.steps;
    const double length = run.load_steps.target() - run.load_steps.time();
    const double halved =
        full * std::exp2(std::round(std::log2(length / full)));
    return std::abs(length - halved) < 1e-6 * halved ? halved : length;
  }

  template <int dim> bool SolidMotion<dim>::begin_step(la::Vector &u)
  {
    const bool changed = motion.begin_step(step_length(), u);
    is_new = is_new || changed;
    const std::vector<std::vector<double>> nothing(
        parameters.pairs.size(), std::vector<double>(dim, 0.));
    present = {
        {}, nothing, nothing, std::vector<double>(parameters.pairs.size(), 0.)};
    on_supports = elasticity.vector();
    friction_of_step = 0.;
    return changed;
  }

  /* What friction takes in a step: the scheme brakes by the forces at both of
   * its ends, and the assembler knows the slip under the last one. */
  template <int dim>
  double SolidMotion<dim>::friction_work(const PairResult<dim> &result,
                                         const double before) const
  {
    const abut_time_scheme &scheme = parameters.time.scheme;
    const double now = scheme.projects != 0 ? 1. : scheme.gamma;
    return result.friction_force > 0.
               ? result.dissipation
                     * (now + (1. - now) * before / result.friction_force)
               : 0.;
  }

  template <int dim>
  void SolidMotion<dim>::measure_contact(const SolidPairs<dim> &pairs)
  {
    run.contact.add_forces_on_supports(on_supports);
    const auto obstacles = pairs.moved_obstacles();
    const auto results = run.contact.pair_results();
    for (std::size_t p = 0; p < results.size(); ++p)
    {
      present.friction[p] += results[p].friction_force;
      friction_of_step += friction_work(results[p], records.back().friction[p]);
      for (unsigned int d = 0; d < dim; ++d)
        present.force[p][d] += results[p].secondary_force[d];
      for (const auto &obstacle : obstacles)
        if (obstacle.shape == pairs.pairs()[p].obstacle)
          present.place[p] = components(obstacle.motion);
    }
    const double force = run.contact.contact_force();
    present.bodies.contact_force += force;
    // Springs of penalties; what is exact has no gap under pressure.
    present.bodies.energy.contact = 0.5 * run.contact.complementarity() * force;
  }

  template <int dim>
  bool SolidMotion<dim>::next_problem(const la::Vector &u,
                                      const SolidPairs<dim> &pairs)
  {
    if (!pairs.empty())
      measure_contact(pairs);
    const bool goes_on = motion.next_problem(u);
    is_new = is_new || goes_on;
    return goes_on;
  }

  template <int dim> std::string SolidMotion<dim>::leaves_points() const
  {
    const std::vector<StepMotion> motions = run.contact.step_motion(run.u);
    for (std::size_t p = 0; p < motions.size(); ++p)
    {
      const StepMotion &pair = motions[p];
      const bool slides =
          pair.facet > 0. && pair.slip > largest_slip * pair.facet;
      if (!slides && pair.turn <= largest_turn)
        continue;
      return coded(
          ABUT_FAILURE_SLIDING,
          parameters.pairs[p].section
              + (slides
                     ? ": in this time step the surfaces in contact slide on "
                       "each other by "
                           + short_number(pair.slip / pair.facet, 3) + " facets"
                     : ": in this time step the normals in contact turn by "
                           + short_number(pair.turn * 180. / M_PI, 3)
                           + " degrees")
              + ", but contact is that of its beginning. Make Time/Step "
                "shorter.");
    }
    return "";
  }

  template <int dim> double SolidMotion<dim>::work_of_obstacles() const
  {
    const Record &before = records.back();
    double result = 0.;
    for (std::size_t p = 0; p < present.force.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        result += 0.5 * (present.force[p][d] + before.force[p][d])
                  * (present.place[p][d] - before.place[p][d]);
    return result;
  }

  template <int dim> void SolidMotion<dim>::end_step()
  {
    motion.end_step(run.u, on_supports);
    const MotionRecord<dim> contact = present.bodies;
    present.bodies = motion.record();
    present.bodies.contact_force = contact.contact_force;
    present.bodies.energy.contact = contact.energy.contact;
    present.bodies.time = run.load_steps.target();
    work_of_step = work_of_obstacles();
    present.bodies.energy.dissipated += dissipated + friction_of_step;
    present.bodies.energy.external_work += work + work_of_step;
  }

  template <int dim>
  void SolidMotion<dim>::judge(const abut_time_energy &energy,
                               abut_time_verdict &verdict)
  {
    abut_time_energy given = energy;
    given.struct_size = sizeof(given);
    verdict = ABUT_TIME_STEADY;
    abut_time_judge(&parameters.time.scheme, &given, &balance, &verdict);
  }

  template <int dim> std::string SolidMotion<dim>::commit()
  {
    motion.commit();
    records.push_back(present);
    dissipated += friction_of_step;
    work += work_of_step;
    abut_time_verdict verdict;
    judge(present.bodies.energy, verdict);
    loses = verdict == ABUT_TIME_LOSES;
    if (verdict != ABUT_TIME_GAINS && verdict != ABUT_TIME_BLOWS_UP)
      return "";
    const std::string what = "The energy balance at time "
                             + short_number(present.bodies.time, 6) + " is "
                             + short_number(100. * balance.gain, 3)
                             + " % above that of the start: ";
    if (verdict == ABUT_TIME_BLOWS_UP)
      return coded(ABUT_FAILURE_BLOW_UP,
                   what
                       + "the motion is unstable. Use Time/Scheme = hht with "
                         "Time/Mass = modified, or a shorter Time/Step.");
    if (!has_warned)
      run.report.warn(coded(
          ABUT_FAILURE_ENERGY_GAIN,
          what
              + "more than the scheme may gain. Use Time/Scheme = hht with "
                "Time/Mass = modified, or a shorter Time/Step."));
    has_warned = true;
    return "";
  }

  template <int dim> void SolidMotion<dim>::warn_of_loss() const
  {
    const auto end = static_cast<std::size_t>(balance.fall_at);
    if (loses && end > 0)
      run.report.warn(text_of_loss(parameters.time.scheme, balance,
                                   records.at(end - 1).bodies.time,
                                   records.at(end).bodies.time));
  }

  template <int dim> bool SolidMotion<dim>::keeps_energy() const
  {
    return balance.gain <= useless_gain;
  }

  template <int dim> double SolidMotion<dim>::energy() const
  {
    const abut_time_energy &e = present.bodies.energy;
    return e.kinetic + e.strain + e.contact;
  }

  template <int dim> std::vector<std::string> SolidMotion<dim>::columns() const
  {
    std::vector<std::string> result = {"kinetic_energy", "strain_energy",
                                       "contact_energy", "dissipated",
                                       "external_work",  "balance"};
    for (unsigned int d = 0; d < dim; ++d)
      result.push_back(std::string("momentum_") + axes[d]);
    for (unsigned int r = 0; r < n_rotations<dim>; ++r)
      result.push_back(angular_momentum_about<dim>(r));
    for (std::size_t p = 1; p <= parameters.pairs.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back("pair_" + std::to_string(p) + "_force_" + axes[d]);
    return result;
  }

  template <int dim>
  void SolidMotion<dim>::add_to_row(std::map<std::string, double> &row) const
  {
    const abut_time_energy &e = present.bodies.energy;
    row["kinetic_energy"] = e.kinetic;
    row["strain_energy"] = e.strain;
    row["contact_energy"] = e.contact;
    row["dissipated"] = e.dissipated;
    row["external_work"] = e.external_work;
    row["balance"] = present.balance();
    for (unsigned int r = 0; r < n_rotations<dim>; ++r)
      row[angular_momentum_about<dim>(r)] = present.bodies.angular_momentum[r];
    for (unsigned int d = 0; d < dim; ++d)
    {
      row[std::string("momentum_") + axes[d]] = present.bodies.momentum[d];
      for (std::size_t p = 0; p < present.force.size(); ++p)
        row["pair_" + std::to_string(p + 1) + "_force_" + axes[d]] =
            present.force[p][d];
    }
  }

  template <int dim> void SolidMotion<dim>::report() const
  {
    Report &report = run.report;
    report.set("scheme", std::string(parameters.time.scheme.name));
    report.set("mass", components(motion.total_mass()));
    report.set("energy_gain", balance.gain);
    report.set("energy_loss", balance.loss);
    warn_of_loss();
    report.set("initial_energy", records.front().balance());
    const MotionRecord<dim> &last = records.back().bodies;
    report.set("kinetic_energy", last.energy.kinetic);
    report.set("strain_energy", last.energy.strain);
    report.set("contact_energy", last.energy.contact);
    report.set("dissipated", last.energy.dissipated);
    report.set("external_work", last.energy.external_work);
    report.set("balance", records.back().balance());
    report.set("momentum", components(last.momentum));
    report.set("angular_momentum",
               std::vector<double>(last.angular_momentum.begin(),
                                   last.angular_momentum.end()));
    // What each pair has given to its secondary over all steps.
    for (std::size_t p = 0; p < parameters.pairs.size(); ++p)
    {
      std::vector<double> impulse(dim, 0.);
      for (std::size_t i = 1; i < records.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          impulse[d] += records[i].force[p][d]
                        * (records[i].bodies.time - records[i - 1].bodies.time);
      report.set("pair_" + std::to_string(p + 1) + "_impulse", impulse);
    }
  }

  template <int dim> void SolidMotion<dim>::draw() const
  {
    std::vector<double> times;
    TimePanel energies{"energy",
                       {{"kinetic", {}},
                        {"strain", {}},
                        {"contact", {}},
                        {"dissipated", {}},
                        {"external work", {}},
                        {"balance", {}}}};
    TimePanel forces{"force of a pair", {}};
    for (std::size_t p = 1; p <= parameters.pairs.size(); ++p)
      forces.curves.push_back({"pair " + std::to_string(p), {}});
    for (const Record &record : records)
    {
      const abut_time_energy &e = record.bodies.energy;
      times.push_back(record.bodies.time);
      const double values[] = {e.kinetic,    e.strain,        e.contact,
                               e.dissipated, e.external_work, record.balance()};
      for (std::size_t i = 0; i < energies.curves.size(); ++i)
        energies.curves[i].second.push_back(values[i]);
      for (std::size_t p = 0; p < forces.curves.size(); ++p)
      {
        double square = 0.;
        for (const double f : record.force[p])
          square += f * f;
        forces.curves[p].second.push_back(std::sqrt(square));
      }
    }
    draw_over_time(run.report, run.options.output_folder, "motion", times,
                   {energies, forces}, "Energies and forces");
  }

  template class SolidMotion<2>;
  template class SolidMotion<3>;
} // namespace abut::app

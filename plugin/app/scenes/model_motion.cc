// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model_motion.h"

#include "app/input/collective.h"
#include "app/input/short_number.h"
#include "app/restart/disk.h"

#include <abut/dealii/coded.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace abut::app
{
  namespace
  {
    /** The column of the table; 2D has one axis. */
    template <int dim> std::string angular_momentum_about(const unsigned int r)
    {
      return std::string("angular_momentum_") + "xyz"[dim == 2 ? 2 : r];
    }
  } // namespace

  template <int dim>
  ModelMotion<dim>::ModelMotion(const InertiaParameters &time,
                                MotionWords words,
                                const ContactRunState<dim> &run,
                                DiscreteProblem<dim> &problem)
      : time(time),
        words(std::move(words)),
        run(run),
        problem(problem),
        motion(problem,
               {time.scheme, time.mass_damping, time.stiffness_damping})
  {
    balance.struct_size = sizeof(balance);
  }

  namespace
  {
    /** Axis times angle, below pi, of a rotation. */
    dealii::Tensor<1, 3> rotation_vector(const dealii::Tensor<2, 3> &r)
    {
      dealii::Tensor<1, 3> axis({0.5 * (r[2][1] - r[1][2]),
                                 0.5 * (r[0][2] - r[2][0]),
                                 0.5 * (r[1][0] - r[0][1])});
      const double sine = axis.norm();
      if (sine > 0.)
        axis *= std::atan2(sine, 0.5 * (trace(r) - 1.)) / sine;
      return axis;
    }
  } // namespace

  template <int dim>
  typename ModelMotion<dim>::Record ModelMotion<dim>::no_contact() const
  {
    const std::size_t n = words.sides.size();
    const std::vector<std::vector<double>> nothing(
        n, std::vector<double>(words.components.size(), 0.));
    return {{},
            nothing,
            nothing,
            std::vector<double>(n, 0.),
            std::vector<dealii::Tensor<1, 3>>(n),
            std::vector<dealii::Tensor<2, 3>>(
                n, dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()))};
  }

  template <int dim>
  void
  ModelMotion<dim>::setup(const typename MassData<dim>::Density &density,
                          const std::set<dealii::types::boundary_id> &touching)
  {
    motion.setup({density, time.mass, touching});
  }

  template <int dim>
  la::Vector ModelMotion<dim>::start(std::pair<la::Vector, la::Vector> initial,
                                     const la::Vector &velocity_of_supports,
                                     const double rigid_energy)
  {
    auto &[displacement, velocity] = initial;
    problem.constraints.distribute(displacement);
    motion.take_prescribed(velocity_of_supports, velocity);
    problem.hanging.distribute(velocity);
    motion.start(displacement, velocity);
    records = {no_contact()};
    records.front().bodies = motion.record();
    records.front().bodies.energy.kinetic += rigid_energy;
    records.front().bodies.not_kept = motion.energy_not_kept(step_length());
    balance = {};
    balance.struct_size = sizeof(balance);
    dissipated = work = 0.;
    abut_time_verdict verdict;
    judge(records.back().bodies, verdict);
    look_at_step();
    return displacement;
  }

  template <int dim>
  bool ModelMotion<dim>::begin_start(const bool has_friction, la::Vector &u)
  {
    // Forces of laws that need the stress are not those of pressures.
    if (abut_law_needs_stress(run.method.options.law)
        || !motion.begin_start(step_length(), has_friction, u))
      return false;
    is_new = true;
    return true;
  }

  template <int dim>
  void ModelMotion<dim>::end_start(const la::Vector &u,
                                   const std::vector<ContactAction> &actions)
  {
    la::Vector contact = problem.vector(), there = problem.vector();
    run.contact.results().add_forces(contact);
    run.contact.results().add_forces(there, ForcePart::at_prescribed);
    motion.end_start(u, contact, there);
    Record &first = records.front();
    for (std::size_t s = 0; s < actions.size(); ++s)
    {
      first.force[s] = actions[s].force;
      first.friction[s] = actions[s].friction;
      first.moment[s] = actions[s].moment;
    }
    is_new = true;
  }

  template <int dim> void ModelMotion<dim>::look_at_step()
  {
    const double limit = motion.stable_step();
    if (!std::isfinite(limit))
      return;
    run.report.set("stable_time_step", limit);
    if (time.step > limit)
      run.report.warn(coded(ABUT_FAILURE_BLOW_UP,
                            "the time step is above the limit of the scheme, "
                                + short_number(limit, 4)
                                + ": make Time stepping/Step size smaller"));
  }

  template <int dim> double ModelMotion<dim>::step_length() const
  {
    // Differences of times have round-off; steps are equal or halved.
    const LoadStepOptions &steps = run.settings.load_steps;
    const double full = steps.end_time / steps.steps;
    const double length = run.load_steps.target() - run.load_steps.time();
    const double halved =
        full * std::exp2(std::round(std::log2(length / full)));
    return std::abs(length - halved) < 1e-6 * halved ? halved : length;
  }

  template <int dim> bool ModelMotion<dim>::begin_step(la::Vector &u)
  {
    const bool changed = motion.begin_step(step_length(), u);
    is_new = is_new || changed;
    present = no_contact();
    on_supports = problem.vector();
    friction_of_step = 0.;
    return changed;
  }

  /* What friction takes in a step: the scheme brakes by the forces at both of
   * its ends, and the assembler knows the slip under the last one. */
  template <int dim>
  double ModelMotion<dim>::friction_work(const ContactAction &action,
                                         const double before) const
  {
    const double now = part_of_end(time.scheme);
    return action.friction > 0.
               ? action.dissipation
                     * (now + (1. - now) * before / action.friction)
               : 0.;
  }

  template <int dim>
  void
  ModelMotion<dim>::measure_contact(const std::vector<ContactAction> &actions)
  {
    run.contact.results().add_forces(on_supports, ForcePart::at_prescribed);
    for (std::size_t s = 0; s < actions.size(); ++s)
    {
      const ContactAction &action = actions[s];
      present.friction[s] += action.friction;
      friction_of_step += friction_work(action, records.back().friction[s]);
      for (std::size_t c = 0; c < action.force.size(); ++c)
        present.force[s][c] += action.force[c];
      present.moment[s] += action.moment;
      present.rotation[s] = action.rotation;
      if (!action.place.empty())
        present.place[s] = action.place;
    }
    const ContactMeasures measures = run.contact.results().measures();
    present.bodies.contact_force += measures.force;
    // Springs of penalties; what is exact has no gap under pressure.
    present.bodies.energy.contact =
        0.5 * measures.complementarity * std::abs(measures.force);
  }

  template <int dim>
  bool ModelMotion<dim>::next_problem(const la::Vector &u,
                                      const std::vector<ContactAction> &actions)
  {
    if (!actions.empty())
      measure_contact(actions);
    const bool goes_on = motion.next_problem(u);
    is_new = is_new || goes_on;
    return goes_on;
  }

  template <int dim> double ModelMotion<dim>::work_of_obstacles() const
  {
    const Record &before = records.back();
    const double now = part_of_end(time.scheme);
    double result = 0.;
    for (std::size_t s = 0; s < present.force.size(); ++s)
    {
      for (std::size_t c = 0; c < present.force[s].size(); ++c)
        result += (now * present.force[s][c] + (1. - now) * before.force[s][c])
                  * (present.place[s][c] - before.place[s][c]);
      result += (now * present.moment[s] + (1. - now) * before.moment[s])
                * rotation_vector(present.rotation[s]
                                  * transpose(before.rotation[s]));
    }
    return result;
  }

  template <int dim> void ModelMotion<dim>::end_step()
  {
    motion.end_step(run.u, on_supports);
    const BodyMotionRecord contact = present.bodies;
    present.bodies = motion.record();
    present.bodies.contact_force = contact.contact_force;
    present.bodies.energy.contact = contact.energy.contact;
    present.bodies.time = run.load_steps.target();
    work_of_step = work_of_obstacles();
    present.bodies.energy.dissipated += dissipated + friction_of_step;
    present.bodies.energy.external_work += work + work_of_step;
  }

  template <int dim> void ModelMotion<dim>::add_work(const double more)
  {
    work_of_step += more;
    present.bodies.energy.external_work += more;
  }

  template <int dim>
  void ModelMotion<dim>::add_rigid(const double energy, const double work_there)
  {
    present.bodies.energy.kinetic += energy;
    add_work(work_there);
  }

  template <int dim>
  void ModelMotion<dim>::judge(const BodyMotionRecord &record,
                               abut_time_verdict &verdict)
  {
    abut_time_energy given = record.energy;
    given.struct_size = sizeof(given);
    given.kinetic -= record.not_kept;
    verdict = ABUT_TIME_STEADY;
    abut_time_judge(&time.scheme, &given, &balance, &verdict);
  }

  template <int dim> std::string ModelMotion<dim>::cure_of_gain() const
  {
    const std::string scheme = time.scheme.name;
    if (words.stops ? scheme == "contact stabilised"
                    : scheme == "hht" && time.mass == ABUT_TIME_MASS_MODIFIED)
      return "Use a smaller Time stepping/Step size: it is long relative to an "
             "impact.";
    return std::string("Use Time stepping/Scheme = ")
           + (words.stops ? "contact stabilised"
                          : "hht with Time stepping/Mass matrix = modified")
           + ", or a smaller Time stepping/Step size.";
  }

  template <int dim>
  const PairCheck *
  ModelMotion<dim>::overlap_of(const std::vector<PairCheck> &checks) const
  {
    constexpr double round_off = 1e-8;
    if (checks.empty() || records.size() < 2)
      return nullptr;
    const double before = records.front().balance();
    const double of_first = records[1].balance() - before,
                 all = records.back().balance() - before;
    const auto deepest =
        std::max_element(checks.begin(), checks.end(),
                         [](const PairCheck &one, const PairCheck &other)
                         { return one.first_overlap < other.first_overlap; });
    return 2. * of_first > all
                   && deepest->first_overlap > round_off * deepest->facet_size
               ? &*deepest
               : nullptr;
  }

  template <int dim>
  Message ModelMotion<dim>::explain_gain(const abut_failure failure,
                                         const std::string &judgement) const
  {
    const std::vector<PairCheck> checks = run.contact.checks().pairs();
    if (const PairCheck *const found = overlap_of(checks))
      return coded(ABUT_FAILURE_OVERLAP,
                   judgement + "The first step caused most of it: surfaces of "
                       + found->name + " overlap by "
                       + short_number(found->first_overlap, 3)
                       + " at the start and are pushed apart. Start without "
                         "penetration.");
    return coded(failure, judgement + cure_of_gain());
  }

  template <int dim> double ModelMotion<dim>::way_of_step() const
  {
    la::Vector change(run.u);
    change -= motion.displacement();
    double way = change.linfty_norm();
    const auto &place = present.place, &before = records.back().place;
    for (std::size_t s = 0; s < std::min(place.size(), before.size()); ++s)
      for (std::size_t c = 0; c < std::min(place[s].size(), before[s].size());
           ++c)
        way = std::max(way, std::abs(place[s][c] - before[s][c]));
    return way;
  }

  template <int dim>
  void ModelMotion<dim>::look_for_loss(const abut_time_balance &before,
                                       const double way)
  {
    const BodyMotionRecord &first = records.end()[-2].bodies,
                           &last = records.back().bodies;
    const double force =
        std::max(std::abs(first.contact_force), std::abs(last.contact_force));
    if (lost || !loses_motion(time.scheme, before, balance, force, way))
      return;
    // How slow bodies can oscillate is not known here.
    const Message text = text_of_lost_motion(
        before, balance, force, std::numeric_limits<double>::infinity(),
        first.time, last.time);
    lost = !text.empty();
    if (lost)
      run.report.warn(text);
  }

  template <int dim> Message ModelMotion<dim>::commit()
  {
    const double way = way_of_step();
    motion.commit();
    records.push_back(present);
    dissipated += friction_of_step;
    work += work_of_step;
    abut_time_verdict verdict;
    const abut_time_balance before = balance;
    judge(present.bodies, verdict);
    loses = verdict == ABUT_TIME_LOSES;
    look_for_loss(before, way);
    gains = verdict == ABUT_TIME_GAINS;
    if (verdict == ABUT_TIME_BLOWS_UP)
      return explain_gain(ABUT_FAILURE_BLOW_UP,
                          text_of_gain() + "the motion is unstable. ");
    // Where loads give the energy, only the end has its scale.
    constexpr double most = 0.5;
    if (gains && !has_warned && balance.first > most * balance.scale)
    {
      warn_of_gain();
      has_warned = true;
    }
    return "";
  }

  template <int dim> std::string ModelMotion<dim>::text_of_gain() const
  {
    return "The energy balance at time "
           + short_number(records.back().bodies.time, 6) + " is "
           + short_number(100. * balance.gain, 3)
           + " % above that of the start: ";
  }

  template <int dim> void ModelMotion<dim>::warn_of_gain() const
  {
    run.report.warn(
        explain_gain(ABUT_FAILURE_ENERGY_GAIN,
                     text_of_gain() + "more than the limit of the scheme. "));
  }

  template <int dim> void ModelMotion<dim>::warn_of_loss() const
  {
    const auto end = static_cast<std::size_t>(balance.fall_at);
    if (loses && !lost && end > 0)
      run.report.warn(
          text_of_loss(time.scheme, balance, records.at(end - 1).bodies.time,
                       records.at(end).bodies.time,
                       words.stops ? Touching::areas : Touching::nodes));
  }

  template <int dim> bool ModelMotion<dim>::keeps_energy() const
  {
    return !lost && balance.gain <= useless_gain;
  }

  template <int dim> double ModelMotion<dim>::energy() const
  {
    const abut_time_energy &e = present.bodies.energy;
    return e.kinetic + e.strain + e.contact;
  }

  template <int dim> std::vector<std::string> ModelMotion<dim>::columns() const
  {
    std::vector<std::string> result = {"kinetic_energy", "strain_energy",
                                       "contact_energy", "dissipated",
                                       "external_work",  "balance"};
    if (time.scheme.beta == 0.)
      result.emplace_back("kept_balance");
    for (const std::string &component : words.components)
      result.push_back("momentum" + component);
    if (words.components.size() == dim)
      for (unsigned int r = 0; r < (dim == 2 ? 1 : 3); ++r)
        result.push_back(angular_momentum_about<dim>(r));
    for (const std::string &side : words.sides)
      for (const std::string &component : words.components)
        result.push_back(side + "_force" + component);
    return result;
  }

  template <int dim>
  void ModelMotion<dim>::add_to_row(std::map<std::string, double> &row) const
  {
    const abut_time_energy &e = present.bodies.energy;
    row["kinetic_energy"] = e.kinetic;
    row["strain_energy"] = e.strain;
    row["contact_energy"] = e.contact;
    row["dissipated"] = e.dissipated;
    row["external_work"] = e.external_work;
    row["balance"] = present.balance();
    if (time.scheme.beta == 0.)
      row["kept_balance"] = present.balance() - present.bodies.not_kept;
    const std::vector<double> &turning = present.bodies.angular_momentum;
    for (std::size_t r = 0; r < turning.size(); ++r)
      row[angular_momentum_about<dim>(r)] = turning[r];
    for (std::size_t c = 0; c < words.components.size(); ++c)
    {
      const std::string &component = words.components[c];
      row["momentum" + component] = present.bodies.momentum[c];
      for (std::size_t s = 0; s < words.sides.size(); ++s)
        row[words.sides[s] + "_force" + component] = present.force[s][c];
    }
  }

  template <int dim> void ModelMotion<dim>::report() const
  {
    Report &report = run.report;
    report.set("scheme", std::string(time.scheme.name));
    report.set("mass", motion.total_mass());
    report.set("energy_gain", balance.gain);
    report.set("energy_loss", balance.loss);
    if (gains && !has_warned)
      warn_of_gain();
    warn_of_loss();
    report.set("initial_energy", records.front().balance());
    const BodyMotionRecord &last = records.back().bodies;
    report.set("kinetic_energy", last.energy.kinetic);
    report.set("strain_energy", last.energy.strain);
    report.set("contact_energy", last.energy.contact);
    report.set("dissipated", last.energy.dissipated);
    report.set("external_work", last.energy.external_work);
    report.set("balance", records.back().balance());
    report.set("momentum", last.momentum);
    if (!last.angular_momentum.empty())
      report.set("angular_momentum", last.angular_momentum);
    // What each side has given over all steps.
    for (std::size_t s = 0; s < words.sides.size(); ++s)
    {
      std::vector<double> impulse(words.components.size(), 0.);
      for (std::size_t i = 1; i < records.size(); ++i)
        for (std::size_t c = 0; c < impulse.size(); ++c)
          impulse[c] += records[i].force[s][c]
                        * (records[i].bodies.time - records[i - 1].bodies.time);
      report.set(words.sides[s] + "_impulse", impulse);
    }
  }

  template <int dim> void ModelMotion<dim>::write_table() const
  {
    std::ostringstream out;
    out << "time,kinetic_energy,strain_energy,contact_energy,"
           "dissipated_energy,external_work,energy_balance";
    for (const std::string &side : words.sides)
      out << ',' << side << "_force";
    out << '\n' << std::setprecision(17);
    for (const Record &record : records)
    {
      const abut_time_energy &e = record.bodies.energy;
      out << record.bodies.time << ',' << e.kinetic << ',' << e.strain << ','
          << e.contact << ',' << e.dissipated << ',' << e.external_work << ','
          << record.balance();
      for (const std::vector<double> &force : record.force)
      {
        double square = 0.;
        for (const double f : force)
          square += f * f;
        out << ',' << std::sqrt(square);
      }
      out << '\n';
    }
    on_root(run.communicator,
            [&] {
              write_file(run.options.output_folder / "motion.csv", out.str());
            });
  }

  template class ModelMotion<2>;
  template class ModelMotion<3>;
} // namespace abut::app

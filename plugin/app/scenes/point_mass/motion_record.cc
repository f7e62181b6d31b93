// SPDX-License-Identifier: LGPL-2.1-or-later
#include "motion_record.h"

#include "app/input/short_number.h"
#include "app/scenes/time_parameters.h"

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Forces below this part of the largest are round-off. */
    constexpr double no_force = 1e-9;

    const char *direction_name(const unsigned int d, const unsigned int dim)
    {
      const char *const axes[] = {"x", "y"};
      return d + 1 < dim ? axes[d] : "height";
    }

    const std::vector<std::string> energies = {
        "kinetic_energy",    "strain_energy",          "contact_energy",
        "dissipated_energy", "energy_lost_in_impacts", "external_work",
        "energy_balance"};
  } // namespace

  MotionRecord::MotionRecord(const abut_time_scheme &scheme_,
                             const unsigned int dimension_, const bool is_bar_,
                             const abut_time_mass mass_)
      : scheme(scheme_),
        dimension(dimension_),
        is_bar(is_bar_),
        mass(mass_),
        balance()
  {
    balance.struct_size = sizeof(balance);
  }

  void MotionRecord::declare_columns(Report &report) const
  {
    std::vector<std::string> columns = {"step", "time"};
    columns.insert(columns.end(), energies.begin(), energies.end());
    for (const char *name : {"momentum_", "force_", "u_", "v_"})
      for (unsigned int d = 0; d < dimension; ++d)
        columns.push_back(name + std::string(direction_name(d, dimension)));
    report.declare_columns(columns);
  }

  /** Look at the last step for a motion that only damping has ended.
   * @param before the balance there, @param way the largest displacement */
  void MotionRecord::look_for_loss(Report &report, Motion &motion,
                                   const abut_time_balance &before,
                                   const double way)
  {
    const Entry &last = entries.end()[-2], &now = entries.back();
    const double force = std::max(std::abs(now.force), std::abs(last.force));
    if (lost || !loses_motion(scheme, before, balance, force, way))
      return;
    const Message text = text_of_lost_motion(
        before, balance, force, motion.slowest_period(), last.time, now.time);
    lost = !text.empty();
    if (lost)
      report.warn(text);
  }

  bool MotionRecord::add(Report &report, Motion &motion, const double time)
  {
    const Entry now = {time,
                       motion.kinetic(),
                       motion.strain(),
                       motion.contact(),
                       motion.dissipated,
                       motion.lost_in_impacts,
                       motion.external_work,
                       motion.force_in(dimension - 1)};
    entries.push_back(now);
    const abut_time_energy energy = {sizeof(energy),
                                     now.kinetic,
                                     now.strain,
                                     now.contact,
                                     now.dissipated + now.lost_in_impacts,
                                     now.work};
    abut_time_verdict verdict = ABUT_TIME_STEADY;
    const abut_time_balance before = balance;
    abut_time_judge(&scheme, &energy, &balance, &verdict);
    loses = verdict == ABUT_TIME_LOSES;
    double way = 0.;
    for (std::size_t k = 0; k < displacement.size(); ++k)
      way = std::max(way, std::abs(motion.u[k] - displacement[k]));
    displacement = motion.u;
    if (entries.size() == 1)
      first = displacement;
    else
      look_for_loss(report, motion, before, way);
    for (std::size_t k = 0; k < first.size(); ++k)
      moved = std::max(moved, std::abs(displacement[k] - first[k]));
    depth = std::max(depth, motion.depth());
    std::map<std::string, double> row = {
        {"step", static_cast<double>(entries.size()) - 1.},
        {"time", time},
        {"kinetic_energy", now.kinetic},
        {"strain_energy", now.strain},
        {"contact_energy", now.contact},
        {"dissipated_energy", now.dissipated},
        {"energy_lost_in_impacts", now.lost_in_impacts},
        {"external_work", now.work},
        {"energy_balance", balance.last}};
    momentum.clear();
    for (unsigned int d = 0; d < dimension; ++d)
    {
      const std::string name = direction_name(d, dimension);
      momentum.push_back(motion.momentum(d));
      row["momentum_" + name] = momentum.back();
      row["force_" + name] = motion.force_in(d);
      row["u_" + name] = motion.u[d];
      row["v_" + name] = motion.v[d];
    }
    report.add_row(row);
    impulse = motion.impulse;
    largest_force = std::max(largest_force, now.force);
    // What sticks at rest has energies that are round-off of forces.
    constexpr double round_off = 1e-12;
    if (entries.size() > 1)
      at_rest = std::max(
          at_rest,
          round_off * motion.energy_of_forces(time - entries.end()[-2].time));
    const bool is_round_off = balance.highest - balance.first <= at_rest;
    if (verdict == ABUT_TIME_GAINS && !gains && !is_round_off)
    {
      gains = true;
      gain_time = time;
    }
    if (verdict != ABUT_TIME_BLOWS_UP)
      return true;
    report.warn(
        coded(ABUT_FAILURE_BLOW_UP,
              "the motion is unstable: at time " + short_number(time, 6)
                  + " it has more than a hundred times the energy that the "
                    "start and the loads have given; "
                  + (scheme.beta > 0.
                         ? "the step is too long for the oscillations, or the "
                           "start contradicts the fixed end. Check the units "
                           "of lengths, masses and times, and use a smaller "
                           "Time stepping/Step size"
                         : "use a smaller Time stepping/Step size, or an "
                           "implicit Time stepping/Scheme")));
    return false;
  }

  std::string MotionRecord::cure_of_gain() const
  {
    const std::string name = scheme.name,
                      shorter = "a smaller Time stepping/Step size";
    if (!is_bar && scheme.beta > 0. && largest_force > 0.)
      return "the velocity of a mass after an impact depends on where in a "
             "step it touches. Use Time stepping/Scheme = velocity level with "
             "Time stepping/Restitution";
    if (!is_bar)
      return "use " + shorter;
    if (name != "hht" && name != "contact stabilised")
      return "take hht or contact stabilised with Time stepping/Mass matrix = "
             "auto, or "
             + shorter;
    return (mass == static_cast<abut_time_mass>(scheme.mass)
                ? "use "
                : "take Time stepping/Mass matrix = auto, or ")
           + shorter;
  }

  /** Warn of springs of the plane that are too soft to be one. */
  void MotionRecord::look_for_depth(Report &report) const
  {
    // What only lies on the plane has no other length to compare with.
    constexpr double most = 0.1;
    if (depth > most * moved && depth < moved)
      report.warn(coded(
          ABUT_FAILURE_PENALTY,
          std::string(is_bar ? "the bar sinks" : "masses sink")
              + " into the plane by " + short_number(depth, 3)
              + ", and displacements are at most " + short_number(moved, 3)
              + ": the springs of the plane are too soft. Use a larger "
                "Contact/Penalty factor",
          {{"depth", depth}}));
  }

  bool MotionRecord::judge_end(Report &report) const
  {
    look_for_depth(report);
    if (gains)
      report.warn(coded(
          ABUT_FAILURE_ENERGY_GAIN,
          "the energy has grown by " + short_number(100. * balance.gain, 3)
              + " % of the " + short_number(balance.scale, 6)
              + " that the start and the loads have given, and exceeds the "
                "limit of the scheme since time "
              + short_number(gain_time, 6) + ": " + cure_of_gain()));
    const auto fall = static_cast<std::size_t>(balance.fall_at);
    if (loses && !lost && fall > 0)
      report.warn(text_of_loss(scheme, balance, entries.at(fall - 1).time,
                               entries.at(fall).time,
                               is_bar ? Touching::nodes : Touching::masses));
    return !lost && (!gains || balance.gain <= useless_gain);
  }

  void MotionRecord::fill_summary(Report &report) const
  {
    const Entry &last = entries.back();
    double first_time = NAN, last_time = NAN;
    for (const Entry &each : entries)
      if (each.force > no_force * largest_force)
      {
        if (std::isnan(first_time))
          first_time = each.time;
        last_time = each.time;
      }
    report.set("time", last.time);
    report.set("time_steps", entries.size() - 1);
    report.set("energy", last.kinetic + last.strain + last.contact);
    report.set("kinetic_energy", last.kinetic);
    report.set("strain_energy", last.strain);
    report.set("contact_energy", last.contact);
    report.set("dissipated_energy", last.dissipated);
    report.set("energy_lost_in_impacts", last.lost_in_impacts);
    report.set("external_work", last.work);
    report.set("initial_energy", balance.first);
    report.set("energy_balance", balance.last);
    report.set("energy_gain", balance.gain);
    report.set("energy_loss", balance.loss);
    report.set("momentum", momentum);
    report.set("contact_impulse", impulse);
    report.set("largest_contact_force", largest_force);
    report.set("first_contact_time", first_time);
    report.set("last_contact_time", last_time);
  }

  std::string MotionRecord::line(const unsigned int k,
                                 const unsigned int n) const
  {
    const Entry &now = entries.back();
    return "step " + std::to_string(k) + " of " + std::to_string(n) + "  time "
           + short_number(now.time, 6)
           + "  E = " + short_number(now.kinetic + now.strain + now.contact, 6)
           + "  F = " + short_number(now.force);
  }
} // namespace abut::app

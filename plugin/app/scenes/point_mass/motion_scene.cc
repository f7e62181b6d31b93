// SPDX-License-Identifier: LGPL-2.1-or-later
/* Scenes of kind `motion`: point masses and bars in time, above a rigid plane.
 */
#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "app/report/json.h"
#include "app/restart/disk.h"
#include "app/scenes/method_words.h"
#include "app/scenes/motion_effects.h"
#include "app/scenes/time_parameters.h"
#include "motion.h"
#include "motion_record.h"
#include "point_mass.h"
#include "row_formulas.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace MotionPatterns = dealii::Patterns;

    const char *const directions = "among the directions of motion";

    class MotionScene : public Scene
    {
    public:
      explicit MotionScene(unsigned int dimension);

      void declare(ParameterHandler &prm) const override;
      void parse(ParameterHandler &prm) override;
      std::vector<EffectRule> effects() const override;
      void check(const RunOptions &options, Report &report) override;
      Outcome run(const RunOptions &options, Report &report) override;

    private:
      void declare_masses(ParameterHandler &prm) const;
      void declare_loads(ParameterHandler &prm) const;
      void parse_masses(ParameterHandler &prm);
      void parse_bar(ParameterHandler &prm);
      void parse_loads(ParameterHandler &prm);
      void parse_mass(ParameterHandler &prm);
      MassSystem make_system() const;
      std::vector<double> values(RowFormula &formula, double time) const;
      std::vector<double> start_of(const MassSystem &system) const;
      std::vector<double> load_at(const MassSystem &system, double time) const;
      void describe(Report &report, const MassSystem &system) const;
      unsigned int n_steps() const;
      double limit_of(const Motion &motion) const;
      void find_step(double limit);
      void warn_of_short_contact(Report &report) const;
      bool take_steps(Report &report, Motion &motion, MotionRecord &record,
                      const MassSystem &system);
      void fill_summary(Report &report, const Motion &motion,
                        const MotionRecord &record) const;
      std::string table(const Motion &motion) const;

      MassRow row;
      Plane plane;
      double spacing = 1., penalty_factor = 1.;
      std::unique_ptr<RowFormula> displacement, velocity, acceleration,
          first_force;
      TimeParameters time;
      abut_time_mass mass_kind = ABUT_TIME_MASS_LUMPED;
      abut_mass_rule mass_rule = ABUT_MASS_NEIGHBOURS;
    };

    MotionScene::MotionScene(const unsigned int dimension)
    {
      row.dimension = dimension;
    }

    void MotionScene::declare_masses(ParameterHandler &prm) const
    {
      prm.enter_subsection("Masses");
      parameter::declare(
          prm, "Number", "1", MotionPatterns::Integer(1, 300),
          parameter::basic("1", "10"),
          "Number of masses in a row. In 1D the row stands on the plane, and "
          "the first mass may touch it. In 2D and 3D the row lies above the "
          "plane along x, and each mass may touch it.");
      parameter::declare(prm, "Mass", "1", NumberPattern::positive(),
                         parameter::basic("mass", "2"), "Mass of each point.");
      declare_row(prm, "0");
      prm.leave_subsection();
      prm.enter_subsection("Bar");
      parameter::declare(prm, "Elements", "none",
                         OrWord(MotionPatterns::Integer(1, 300), "none"),
                         parameter::basic("1", "40"),
                         "Number of linear elements of a bar that stands on "
                         "the plane, instead of point masses.");
      parameter::declare(prm, "Length", "1", NumberPattern::positive(),
                         parameter::basic("length", "10"),
                         "Length of the bar at rest. Its nodes have x from 0, "
                         "near the plane, to this length.");
      parameter::declare(prm, "Stiffness", "1", NumberPattern::positive(),
                         parameter::basic("force", "900"),
                         "Young modulus times cross section of the bar.");
      parameter::declare(prm, "Density", "1", NumberPattern::positive(),
                         parameter::basic("mass/length", "1"),
                         "Mass of the bar per length.");
      parameter::declare(prm, "Fixed end", "false", MotionPatterns::Bool(),
                         parameter::advanced(),
                         "Whether the end far from the plane is fixed.");
      prm.leave_subsection();
    }

    void MotionScene::declare_loads(ParameterHandler &prm) const
    {
      const std::string by_direction =
          " Formulas are separated by semicolons, directions along the plane "
          "first, height last; missing ones are 0.";
      prm.enter_subsection("Motion");
      parameter::declare(
          prm, "Gap", "0", NumberPattern::from(0),
          parameter::basic("length", "5"),
          "Height of the row above the plane at displacement 0.");
      parameter::declare(
          prm, "Initial displacement", "0", TextPattern::vector(),
          parameter::advanced("length", "0.1*x"),
          "Displacement at time 0: a formula in x for each direction."
              + by_direction);
      parameter::declare(
          prm, "Initial velocity", "0", TextPattern::vector(),
          parameter::basic("length/time", "1; -10"),
          "Velocity at time 0: a formula in x for each direction."
              + by_direction);
      parameter::declare(prm, "Acceleration", "0", TextPattern::vector(),
                         parameter::basic("length/time^2", "-9.81"),
                         "Load per mass, such as gravity: a formula in x and t "
                         "for each direction."
                             + by_direction);
      parameter::declare(
          prm, "Force on first", "0", TextPattern::vector(),
          parameter::advanced("force", "sin(t)"),
          "Force on the first mass: a formula in t for each direction."
              + by_direction);
      prm.leave_subsection();
      prm.enter_subsection("Contact");
      parameter::declare(
          prm, "Friction", "0", NumberPattern::between(0, 1e6),
          parameter::basic("1", "0.3"),
          "Coefficient of Coulomb friction of `velocity level`. Values above "
          "1e6 give the same motion and lose precision.");
      parameter::declare(
          prm, "Penalty factor", "1", NumberPattern::positive(),
          parameter::advanced("stiffness of the row", "10"),
          "Stiffness of the springs that stand for the plane, for `central "
          "difference` and `energy momentum`. Unit: `Masses/Spring`, for one "
          "mass `Masses/Wall spring`, for a bar its stiffness divided by the "
          "length of an element.");
      prm.leave_subsection();
    }

    /** Words of the schemes; the first is the default. */
    std::string scheme_words()
    {
      const std::string first = "velocity level";
      std::string words = first;
      for (std::int32_t i = 0; abut_time_scheme_name(i) != nullptr; ++i)
        if (first != abut_time_scheme_name(i))
          words += std::string("|") + abut_time_scheme_name(i);
      return words;
    }

    void MotionScene::declare(ParameterHandler &prm) const
    {
      declare_masses(prm);
      declare_loads(prm);
      TimeParameters::declare(
          prm, scheme_words(),
          "auto, for bars only: the time of a wave through an element, or 0.9 "
          "of the limit of an explicit scheme.");
      prm.enter_subsection("Time stepping");
      parameter::declare(
          prm, "Mass matrix", "auto",
          MotionPatterns::Selection("auto|consistent|lumped|modified|modified "
                                    "with centre"),
          parameter::advanced(),
          "Mass matrix of a bar. consistent: of the elements. lumped: row "
          "sums. modified: the node at the plane has no mass, its neighbour "
          "has it. modified with centre: the same with the centre of mass "
          "unchanged. auto: as the scheme needs it.");
      prm.leave_subsection();
    }

    void MotionScene::parse_bar(ParameterHandler &prm)
    {
      prm.enter_subsection("Bar");
      const auto elements =
          static_cast<std::size_t>(parameter::number_or_zero(prm, "Elements"));
      const double length = prm.get_double("Length"),
                   stiffness = prm.get_double("Stiffness"),
                   density = prm.get_double("Density");
      row.fixed_end = prm.get_bool("Fixed end");
      prm.leave_subsection();
      row.is_bar = elements > 0;
      if (!row.is_bar)
        return;
      if (row.dimension > 1)
        throw InputError("Bar/Elements",
                         "a bar is one-dimensional: set Dimension = 1.");
      row.n = elements + (row.fixed_end ? 0 : 1);
      spacing = length / static_cast<double>(elements);
      row.spring = stiffness / spacing;
      row.wall_spring = 0.;
      row.mass = density * spacing;
    }

    void MotionScene::parse_masses(ParameterHandler &prm)
    {
      prm.enter_subsection("Masses");
      row.n = static_cast<std::size_t>(prm.get_integer("Number"));
      row.mass = prm.get_double("Mass");
      spacing = prm.get_double("Spacing");
      row.spring = prm.get_double("Spring");
      row.wall_spring = prm.get_double("Wall spring");
      prm.leave_subsection();
      parse_bar(prm);
    }

    void MotionScene::parse_loads(ParameterHandler &prm)
    {
      const auto read = [&](const char *name)
      {
        return formula_by_direction(prm.get(name),
                                    std::string("Motion/") + name,
                                    row.dimension, directions);
      };
      prm.enter_subsection("Motion");
      plane.gap = prm.get_double("Gap");
      displacement = read("Initial displacement");
      velocity = read("Initial velocity");
      acceleration = read("Acceleration");
      first_force = read("Force on first");
      prm.leave_subsection();
      prm.enter_subsection("Contact");
      plane.friction = prm.get_double("Friction");
      penalty_factor = prm.get_double("Penalty factor");
      prm.leave_subsection();
    }

    void MotionScene::parse_mass(ParameterHandler &prm)
    {
      prm.enter_subsection("Time stepping");
      const std::string word = prm.get("Mass matrix");
      prm.leave_subsection();
      mass_kind = static_cast<abut_time_mass>(time.scheme.mass);
      // Point masses are what they are; there is nobody to take theirs.
      if (!row.is_bar)
        mass_kind = ABUT_TIME_MASS_LUMPED;
      if (word == "consistent")
        mass_kind = ABUT_TIME_MASS_CONSISTENT;
      else if (word == "lumped")
        mass_kind = ABUT_TIME_MASS_LUMPED;
      else if (word != "auto")
        mass_kind = ABUT_TIME_MASS_MODIFIED;
      if (word == "modified with centre")
        mass_rule = ABUT_MASS_CENTRE;
      time.check_mass(mass_kind);
    }

    void MotionScene::parse(ParameterHandler &prm)
    {
      parse_masses(prm);
      parse_loads(prm);
      time.parse(prm, row.is_bar);
      parse_mass(prm);
      plane.restitution = time.restitution;
      const bool is_explicit =
          time.scheme.beta == 0. && time.scheme.contact_in_step != 0;
      if (is_explicit || time.scheme.keeps_springs != 0)
      {
        plane.penalty =
            penalty_factor * (row.n > 1 ? row.spring : row.wall_spring);
        const std::string unit =
            row.n > 1 ? "Masses/Spring" : "Masses/Wall spring";
        if (plane.penalty == 0.)
          throw InputError(
              unit,
              std::string(time.scheme.name)
                  + " has a spring instead of the plane, whose "
                    "stiffness is Contact/Penalty factor times "
                  + unit
                  + ", which is 0: give it, or use Time stepping/Scheme = "
                    "velocity level, which has a plane.");
      }
    }

    std::vector<EffectRule> MotionScene::effects() const
    {
      const auto scheme_is = [](std::vector<std::string> names)
      {
        return [names](const SceneValues &values)
        {
          return std::find(names.begin(), names.end(),
                           values("Time stepping/Scheme"))
                 != names.end();
        };
      };
      const auto is_bar = [](const SceneValues &values)
      { return values.number("Bar/Elements") > 0.; };
      const auto no_bar = [is_bar](const SceneValues &values)
      { return !is_bar(values); };
      const auto is_row = [](const SceneValues &values)
      { return values.number("Masses/Number") > 1.; };
      EffectRules rules = {
          effective_if("Masses/*", Weight::data, no_bar,
                       "Bar/Elements replaces the masses by a bar."),
          effective_if("Masses/Spring", Weight::data, is_row,
                       "there is one mass."),
          effective_if("Masses/Spacing", Weight::data, is_row,
                       "there is one mass."),
          effective_if(
              "Time stepping/Mass matrix", Weight::data, is_bar,
              "point masses are lumped; it belongs to bars (Bar/Elements)."),
          effective_if("Contact/Friction", Weight::data,
                       scheme_is({"velocity level"}),
                       "friction of masses needs Time stepping/Scheme = "
                       "velocity level."),
          effective_if(
              "Contact/Friction", Weight::data,
              [](const SceneValues &values)
              { return values("Dimension") != "1"; },
              "the masses do not move along the plane: set Dimension = 2."),
          effective_if("Contact/Penalty factor", Weight::data,
                       scheme_is({"central difference", "energy momentum"}),
                       "only central difference and energy momentum have "
                       "springs for the plane."),
          without_time("Motion/Initial displacement",
                       "it is the state at time 0."),
          without_time("Motion/Initial velocity",
                       "it is the state at time 0.")};
      for (const char *name : {"Length", "Stiffness", "Density", "Fixed end"})
        rules.push_back(effective_if(std::string("Bar/") + name, Weight::data,
                                     is_bar,
                                     "it belongs to bars (Bar/Elements)."));
      return joined({rules, scheme_effects(Weight::setting)});
    }

    MassSystem MotionScene::make_system() const
    {
      MassSystem system(row);
      const std::string why = system.use_mass(mass_kind, mass_rule);
      if (!why.empty())
        throw InputError("Time stepping/Mass matrix", why + ".");
      return system;
    }

    /** Values [size] at the masses. */
    std::vector<double> MotionScene::values(RowFormula &formula,
                                            const double now) const
    {
      formula.set_time(now);
      std::vector<dealii::Point<2>> places;
      for (std::size_t i = 0; i < row.n; ++i)
        places.emplace_back(static_cast<double>(i) * spacing, 0.);
      std::vector<double> result(row.n * row.dimension);
      for (unsigned int d = 0; d < row.dimension; ++d)
      {
        const std::vector<double> each = formula.evaluate(places, d);
        for (std::size_t i = 0; i < row.n; ++i)
          result[i * row.dimension + d] = each[i];
      }
      return result;
    }

    /** Displacements at the start, which must be above the plane: a scheme
     * would push masses out with energy from nowhere. */
    std::vector<double> MotionScene::start_of(const MassSystem &system) const
    {
      const std::vector<double> start = values(*displacement, 0.);
      for (const std::size_t mass : system.candidates)
      {
        const double u = start[mass * row.dimension + row.dimension - 1],
                     height = plane.gap + u;
        if (height < -1e-12 * (plane.gap + std::abs(u)))
          throw InputError("Motion/Initial displacement",
                           "mass " + std::to_string(mass + 1)
                               + " starts below the plane, by "
                               + short_number(-height)
                               + ": Motion/Gap and its displacement must not "
                                 "be negative together.");
      }
      return start;
    }

    std::vector<double> MotionScene::load_at(const MassSystem &system,
                                             const double now) const
    {
      std::vector<double> load = values(*acceleration, now);
      const std::vector<double> forces = values(*first_force, now);
      for (std::size_t k = 0; k < load.size(); ++k)
        load[k] = load[k] * system.share[k / row.dimension]
                  + (k < row.dimension ? forces[k] : 0.);
      return load;
    }

    unsigned int MotionScene::n_steps() const
    {
      return static_cast<unsigned int>(
          std::max(1., std::ceil(time.end / time.step * (1. - 1e-9))));
    }

    /** The longest step of an explicit scheme. */
    double MotionScene::limit_of(const Motion &motion) const
    {
      try
      {
        return motion.stable_step();
      }
      catch (const std::range_error &error)
      {
        throw InputError(
            row.is_bar ? "Bar/Stiffness" : "Masses/Spring",
            std::string(
                "it exceeds the range of numbers together with the masses (")
                + error.what() + ").");
      }
    }

    /** The step of a bar whose file has none. */
    void MotionScene::find_step(const double limit)
    {
      if (time.step > 0.)
        return;
      constexpr double part = 0.9;
      time.step = time.scheme.beta == 0. ? part * limit
                                         : std::sqrt(row.mass / row.spring);
      time.step = std::min(time.step, time.end);
      time.check_step();
    }

    /** A mass on a spring of the plane stays there for half a period. */
    void MotionScene::warn_of_short_contact(Report &report) const
    {
      if (row.n > 1 || time.scheme.keeps_springs == 0)
        return;
      const double duration =
          dealii::numbers::PI * std::sqrt(row.mass / plane.penalty);
      if (time.end / n_steps() > duration)
        report.warn(coded(
            ABUT_FAILURE_PENALTY,
            "the mass stays on the spring of the plane for "
                + short_number(duration, 3)
                + ", less than a step: the time and the depth of an impact are "
                  "wrong. Use a smaller Time stepping/Step size or a smaller "
                  "Contact/Penalty factor",
            {{"duration of contact", duration}}));
    }

    void MotionScene::describe(Report &report, const MassSystem &system) const
    {
      const char *const masses[] = {"consistent", "lumped", "modified"};
      report.set("method", time.scheme.name);
      report.set("discretisation", row.is_bar ? "bar" : "masses");
      report.set("dofs", system.size());
      report.set("constraints", system.candidates.size());
      report.print("  "
                   + (row.is_bar ? "a bar" : counted(row.n, "mass", "masses"))
                   + ", " + counted(system.size(), "unknown", "unknowns")
                   + "; in time by " + time.scheme.name + ", "
                   + std::to_string(n_steps()) + " steps");
      report.model("search", false, "the masses and their plane are given");
      report.model("time", true,
                   std::string(time.scheme.name) + ", mass " + masses[mass_kind]
                       + ", " + std::to_string(n_steps()) + " steps");
      report.model("friction", plane.friction > 0,
                   plane.friction > 0
                       ? "Coulomb, mu = " + short_number(plane.friction)
                       : "Contact/Friction is 0");
    }

    void MotionScene::check(const RunOptions &, Report &report)
    {
      const MassSystem system = make_system();
      start_of(system);
      load_at(system, 0.);
      load_at(system, time.end);
      find_step(limit_of(Motion(system, plane, time.scheme)));
      describe(report, system);
    }

    bool MotionScene::take_steps(Report &report, Motion &motion,
                                 MotionRecord &record, const MassSystem &system)
    {
      const unsigned int n = n_steps();
      const double dt = time.end / n;
      std::vector<double> before = load_at(system, 0.);
      record.add(report, motion, 0.);
      for (unsigned int k = 1; k <= n; ++k)
      {
        const double now = k == n ? time.end : k * dt;
        const std::vector<double> after = load_at(system, now);
        const Message failure = motion.step(dt, before, after);
        if (!failure.empty())
        {
          report.warn(failure + " (at time " + short_number(now, 6) + ")");
          return false;
        }
        motion.time = now;
        if (!record.add(report, motion, now))
          return false;
        if (k * std::size_t(20) / n != (k - 1) * std::size_t(20) / n)
          report.progress(record.line(k, n), double(k) / n);
        before = after;
      }
      return record.judge_end(report);
    }

    void MotionScene::fill_summary(Report &report, const Motion &motion,
                                   const MotionRecord &record) const
    {
      const unsigned int dim = row.dimension;
      record.fill_summary(report);
      double penetration = 0, force = 0;
      int active = 0;
      for (std::size_t i = 0; i < row.n; ++i)
      {
        const std::size_t h = i * dim + dim - 1;
        if (i == 0 || dim > 1)
          penetration = std::max(penetration, -plane.gap - motion.u[h]);
        force += motion.force[h];
        active += motion.force[h] > 0;
      }
      report.set("active", active);
      report.set("contact_force", force);
      report.set("max_penetration", penetration);
      report.set("displacement",
                 std::vector<double>(motion.u.begin(), motion.u.begin() + dim));
      report.set("velocity",
                 std::vector<double>(motion.v.begin(), motion.v.begin() + dim));
      report.set("n_touches", motion.touch_times.size());
      report.set("touch_times",
                 std::vector<double>(
                     motion.touch_times.begin(),
                     motion.touch_times.begin()
                         + static_cast<std::ptrdiff_t>(std::min<std::size_t>(
                             motion.touch_times.size(), 20))));
    }

    /** masses.csv: where masses are at the end. */
    std::string MotionScene::table(const Motion &motion) const
    {
      const unsigned int dim = row.dimension;
      const char *const axes[] = {"x", "y"};
      std::ostringstream out;
      out << "mass,x";
      for (const char *name : {"u_", "v_", "force_"})
        for (unsigned int d = 0; d < dim; ++d)
          out << "," << name << (d + 1 < dim ? axes[d] : "height");
      out << "\n";
      for (std::size_t i = 0; i < row.n; ++i)
      {
        out << i + 1 << "," << json_number(static_cast<double>(i) * spacing);
        for (const std::vector<double> *each :
             {&motion.u, &motion.v, &motion.force})
          for (unsigned int d = 0; d < dim; ++d)
            out << "," << json_number((*each)[i * dim + d]);
        out << "\n";
      }
      return out.str();
    }

    Outcome MotionScene::run(const RunOptions &options, Report &report)
    {
      const MassSystem system = make_system();
      Motion motion(system, plane, time.scheme);
      const double limit = limit_of(motion);
      find_step(limit);
      describe(report, system);
      MotionRecord record(time.scheme, row.dimension, row.is_bar, mass_kind);
      record.declare_columns(report);
      report.set("stable_time_step", limit);
      if (time.end / n_steps() > limit)
        report.warn(coded(ABUT_FAILURE_BLOW_UP,
                          "the time step is above the limit of the scheme, "
                              + short_number(limit, 4)
                              + ": use a smaller Time stepping/Step size"));
      warn_of_short_contact(report);
      const Message failure = motion.start(
          start_of(system), values(*velocity, 0.), load_at(system, 0.));
      if (!failure.empty())
      {
        report.warn(failure + " (at time 0)");
        return Outcome::unusable;
      }
      const bool done = [&]
      {
        SectionTimes::Scope scope(report.times, "solve");
        return take_steps(report, motion, record, system);
      }();
      fill_summary(report, motion, record);
      if (dealii::Utilities::MPI::this_mpi_process(options.communicator) == 0)
        write_file(options.output_folder / "masses.csv", table(motion));
      return done ? Outcome::converged : Outcome::unusable;
    }
  } // namespace

  std::unique_ptr<Scene> make_motion(const unsigned int dimension)
  {
    return std::make_unique<MotionScene>(dimension);
  }
} // namespace abut::app

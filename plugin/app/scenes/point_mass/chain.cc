// SPDX-License-Identifier: LGPL-2.1-or-later
/* Scenes of kind `chain of masses`: masses in a row on a rigid plane, with
 * friction, in load steps. */
#include "app/input/input_error.h"
#include "app/input/short_number.h"
#include "app/report/json.h"
#include "app/restart/disk.h"
#include "app/scenes/common_parameters.h"
#include "app/scenes/diagnosis.h"
#include "app/scenes/load_step_parameters.h"
#include "app/scenes/method_effects.h"
#include "app/scenes/method_words.h"
#include "chain_model.h"
#include "mass_row.h"
#include "point_mass.h"
#include "row_formulas.h"

#include <abut/dealii/load_steps.h>
#include <abut/dealii/method_parameters.h>
#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;

    using Formula = RowFormula;

    const char *const coefficient_name = "Friction/Coefficient";

    class ChainScene : public Scene
    {
    public:
      explicit ChainScene(unsigned int dimension);

      void declare(ParameterHandler &prm) const override;
      void parse(ParameterHandler &prm) override;
      std::vector<EffectRule> effects() const override;
      void check(const RunOptions &options, Report &report) override;
      Outcome run(const RunOptions &options, Report &report) override;

    private:
      void declare_masses(ParameterHandler &prm) const;
      void declare_loads(ParameterHandler &prm) const;
      void parse_masses(ParameterHandler &prm);
      void parse_loads(ParameterHandler &prm);
      void describe(Report &report) const;
      std::vector<double> at_masses(Formula &formula, double time,
                                    double least) const;
      ChainLoad load_at(double time) const;
      void add_forces(double time, std::vector<double> &force) const;
      void add_step(Report &report, const ChainSteps &steps, double time);
      void fill_summary(Report &report, const ChainSteps &steps,
                        const LoadSteps &load_steps) const;
      bool take_steps(Report &report, ChainSteps &steps);

      Chain chain;
      double spacing, share_of_ends;
      bool has_friction;
      std::unique_ptr<Formula> driven_end, first_force, force, pressing_force,
          coefficient, cap;
      MethodParameters method;
      LoadStepParameters load_options;
      std::ostringstream table; /**< masses.csv */
      int n_rows = 0, n_systems = 0, worst_rung = 0;
    };

    ChainScene::ChainScene(const unsigned int dimension)
        : chain(), spacing(1.), share_of_ends(1.), has_friction(false)
    {
      chain.dimension = dimension;
    }

    void ChainScene::declare_masses(ParameterHandler &prm) const
    {
      prm.enter_subsection("Masses");
      parameter::declare(
          prm, "Number", "1", Patterns::Integer(1, 200),
          parameter::basic("1", "10"),
          "Number of masses in a row along x above a rigid plane. A mass moves "
          "along the plane (x; in 3D x and y) and in height.");
      declare_row(prm, "1");
      parameter::declare(prm, "End spring", "0", NumberPattern::from(0),
                         parameter::basic("force/length", "10"),
                         "Stiffness of the spring between the first mass and "
                         "`Load/Driven end`. 0: no spring.");
      parameter::declare(
          prm, "Normal spring", "1", NumberPattern::positive(),
          parameter::advanced("force/length", "1"),
          "Stiffness of the spring that carries each mass in height.");
      parameter::declare(
          prm, "Gap", "0", TextPattern::formula(),
          parameter::basic("length", "0.01*x"),
          "Height of the masses above the plane at rest: a formula in x.");
      parameter::declare(
          prm, "Share of ends", "1",
          NumberPattern({nullptr, 0., 1., true, false}),
          parameter::advanced("1", "0.5"),
          "Part of `Load/Pressing force` and `Load/Force` on the first and "
          "last mass. With 0.5 the chain is a bar of linear finite elements.");
      prm.leave_subsection();
    }

    void ChainScene::declare_loads(ParameterHandler &prm) const
    {
      const std::string along =
          " One formula in t for each direction along the plane, separated by "
          "semicolons; missing ones are 0.";
      prm.enter_subsection("Load");
      parameter::declare(
          prm, "Pressing force", "1", TextPattern::formula(),
          parameter::basic("force", "1 + x"),
          "Force on each mass towards the plane: a formula in x and t.");
      parameter::declare(prm, "Force", "0", TextPattern::vector(),
                         parameter::basic("force", "0.2*t"),
                         "Force on each mass along the plane, in x and t."
                             + along);
      parameter::declare(prm, "Force on first", "0", TextPattern::vector(),
                         parameter::advanced("force", "0.2*t"),
                         "Force along the plane on the first mass alone."
                             + along);
      parameter::declare(
          prm, "Driven end", "0", TextPattern::vector(),
          parameter::basic("length", "0.1*t"),
          "Displacement of the far end of `Masses/End spring` along the plane."
              + along);
      prm.leave_subsection();
      prm.enter_subsection("Friction");
      parameter::declare(prm, "Coefficient", "0.3", TextPattern::formula(),
                         parameter::basic("1", "0.5"),
                         "Coefficient mu of Coulomb friction, a formula in x "
                         "and t: the friction force is at most mu times the "
                         "contact force. 0: frictionless.");
      parameter::declare(prm, "Cap", "", TextPattern::formula(),
                         parameter::advanced("force", "2"),
                         "Limit of the friction force on a mass (Tresca), a "
                         "formula in x and t. Empty: none.");
      prm.leave_subsection();
    }

    void ChainScene::declare(ParameterHandler &prm) const
    {
      declare_masses(prm);
      declare_loads(prm);
      LoadStepParameters::declare(prm);
      MethodParameters::declare_parameters(prm);
    }

    void ChainScene::parse_masses(ParameterHandler &prm)
    {
      prm.enter_subsection("Masses");
      chain.n = static_cast<std::size_t>(prm.get_integer("Number"));
      spacing = prm.get_double("Spacing");
      chain.spring = prm.get_double("Spring");
      chain.end_spring = prm.get_double("End spring");
      chain.wall_spring = prm.get_double("Wall spring");
      chain.normal_spring = prm.get_double("Normal spring");
      share_of_ends = prm.get_double("Share of ends");
      const auto gap = formula_in_x(prm.get("Gap"), "Masses/Gap");
      prm.leave_subsection();
      chain.gap = at_masses(*gap, 0., -largest_value);
    }

    std::unique_ptr<RowFormula> along_plane(const std::string &text,
                                            const std::string &parameter,
                                            const unsigned int n_directions)
    {
      return formula_by_direction(text, parameter, n_directions,
                                  "along the plane");
    }

    void ChainScene::parse_loads(ParameterHandler &prm)
    {
      const unsigned int n = chain.n_tangents();
      prm.enter_subsection("Load");
      pressing_force =
          formula_in_x(prm.get("Pressing force"), "Load/Pressing force");
      force = along_plane(prm.get("Force"), "Load/Force", n);
      first_force =
          along_plane(prm.get("Force on first"), "Load/Force on first", n);
      driven_end = along_plane(prm.get("Driven end"), "Load/Driven end", n);
      prm.leave_subsection();
      prm.enter_subsection("Friction");
      coefficient = formula_in_x(prm.get("Coefficient"), coefficient_name);
      if (!prm.get("Cap").empty())
        cap = formula_in_x(prm.get("Cap"), "Friction/Cap");
      prm.leave_subsection();
      has_friction = !coefficient->is_zero();
    }

    void ChainScene::parse(ParameterHandler &prm)
    {
      parse_masses(prm);
      parse_loads(prm);
      load_options.parse(prm);
      method.parse_parameters(prm);
      require_law_without_stress(method);
      if (has_friction && abut_law_is_interior(method.options.law))
        throw InputError("Method/Enforcement",
                         std::string(method.options.law->name)
                             + " has no friction: use lagrange, penalty, "
                               "quadratic penalty or augmented lagrangian, or "
                               "set Friction/Coefficient = 0.");
    }

    std::vector<EffectRule> ChainScene::effects() const
    {
      EffectRules rules = {
          effective_if(
              "Load/Driven end", Weight::data,
              [](const SceneValues &values)
              { return values.number("Masses/End spring") > 0.; },
              "Masses/End spring is 0."),
          effective_if(
              "Friction/Cap", Weight::data,
              [](const SceneValues &values)
              { return values(coefficient_name) != "0"; },
              "Friction/Coefficient is 0: set a large one for Tresca "
              "friction."),
          without_time("Masses/Gap", "the gap at rest does not change."),
          never_effective("Output/Pictures", Weight::setting,
                          "the results are in masses.csv.")};
      for (const char *name : {"Spring", "Spacing", "Share of ends"})
        rules.push_back(effective_if(
            std::string("Masses/") + name, Weight::data,
            [](const SceneValues &values)
            { return values.number("Masses/Number") > 1.; },
            "there is one mass."));
      return joined(
          {rules, law_effects(), no_discretisation("contact acts at masses.")});
    }

    std::vector<double> ChainScene::at_masses(Formula &formula,
                                              const double time,
                                              const double least) const
    {
      formula.set_time(time);
      std::vector<dealii::Point<2>> places;
      for (std::size_t i = 0; i < chain.n; ++i)
        places.emplace_back(static_cast<double>(i) * spacing, 0.);
      const std::vector<double> values = formula.evaluate(places);
      for (std::size_t i = 0; i < chain.n; ++i)
        if (values[i] < least)
          throw InputError(formula.parameter(),
                           "it is " + short_number(values[i], 6) + " at mass "
                               + std::to_string(i + 1) + " and time "
                               + short_number(time, 6)
                               + ": it must not be negative.");
      return values;
    }

    void ChainScene::add_forces(const double time,
                                std::vector<double> &forces) const
    {
      const unsigned int dim = chain.dimension;
      for (Formula *each : {force.get(), first_force.get(), driven_end.get()})
        each->set_time(time);
      const std::vector<dealii::Point<2>> origin(1);
      for (unsigned int d = 0; d + 1 < dim; ++d)
      {
        std::vector<dealii::Point<2>> places;
        for (std::size_t i = 0; i < chain.n; ++i)
          places.emplace_back(static_cast<double>(i) * spacing, 0.);
        const std::vector<double> each = force->evaluate(places, d);
        for (std::size_t i = 0; i < chain.n; ++i)
          forces[i * dim + d] = each[i];
      }
      const std::vector<double> pressing =
          at_masses(*pressing_force, time, -largest_value);
      for (std::size_t i = 0; i < chain.n; ++i)
        forces[i * dim + dim - 1] = -pressing[i];
      for (unsigned int d = 0; d < dim && chain.n > 1; ++d)
      {
        forces[d] *= share_of_ends;
        forces[(chain.n - 1) * dim + d] *= share_of_ends;
      }
      for (unsigned int d = 0; d + 1 < dim; ++d)
        forces[d] += first_force->evaluate(origin, d)[0]
                     + chain.end_spring * driven_end->evaluate(origin, d)[0];
    }

    ChainLoad ChainScene::load_at(const double time) const
    {
      ChainLoad load;
      load.force.assign(chain.n_unknowns(), 0.);
      add_forces(time, load.force);
      load.coefficient = at_masses(*coefficient, time, 0.);
      if (cap != nullptr)
        load.cap = at_masses(*cap, time, 0.);
      return load;
    }

    void ChainScene::describe(Report &report) const
    {
      report.set("method", method.options.law->name);
      report.set("discretisation", "masses");
      report.set("dofs", chain.n_unknowns());
      report.set("constraints", chain.n);
      report.print("  " + counted(chain.n, "mass", "masses") + " on a plane, "
                   + std::to_string(chain.n_unknowns()) + " unknowns; "
                   + law_in_words(method)
                   + (has_friction ? ", friction" : ", no friction"));
      report.model("search", false, "the masses and their plane are given");
      report.model("friction", has_friction,
                   has_friction ? "Coulomb, mu = " + coefficient->text()
                                : "Friction/Coefficient is 0");
      report.model("linear solver", true,
                   "dense factorisation, unknowns: "
                       + std::to_string(chain.n_unknowns()));
    }

    void ChainScene::check(const RunOptions &, Report &report)
    {
      load_at(0.);
      load_at(load_options.end_time);
      describe(report);
    }

    /** Resultants of all masses, as act on them. */
    struct Resultants
    {
      double normal = 0, tangential[2] = {0, 0};
      int open = 0, stick = 0, slip = 0;

      Resultants(const ChainState &state, const unsigned int dim)
      {
        for (std::size_t i = 0; i < state.state.size(); ++i)
        {
          normal += state.pressure[i * dim];
          for (unsigned int t = 0; t + 1 < dim; ++t)
            tangential[t] += state.pressure[i * dim + 1 + t];
          open += state.state[i] == ABUT_STATE_OPEN;
          stick += state.state[i] == ABUT_STATE_CLOSED;
          slip += state.state[i] == ABUT_STATE_SLIP;
        }
      }

      double friction() const
      {
        return std::hypot(tangential[0], tangential[1]);
      }
    };

    const char *const axes[] = {"x", "y"};

    /** A mass's line of masses.csv. */
    void write_mass(std::ostream &out, const ChainState &state,
                    const unsigned int dim, const std::size_t i)
    {
      for (unsigned int d = 0; d < dim; ++d)
        out << "," << json_number(state.displacement[i * dim + d]);
      for (unsigned int d = 0; d < dim; ++d)
        out << "," << json_number(state.pressure[i * dim + d]);
      for (unsigned int t = 0; t + 1 < dim; ++t)
        out << "," << json_number(state.slip[i * (dim - 1) + t]);
      out << "," << static_cast<int>(state.state[i]) << "\n";
    }

    void write_header(std::ostream &out, const unsigned int dim)
    {
      out << "step,time,mass";
      for (unsigned int t = 0; t + 1 < dim; ++t)
        out << ",u_" << axes[t];
      out << ",height,normal_force";
      for (const char *name : {"friction_", "slip_"})
        for (unsigned int t = 0; t + 1 < dim; ++t)
          out << "," << name << axes[t];
      out << ",state\n";
    }

    void ChainScene::add_step(Report &report, const ChainSteps &steps,
                              const double time)
    {
      const ChainState &state = steps.state();
      const unsigned int dim = chain.dimension;
      const Resultants sum(state, dim);
      const int step = ++n_rows;
      std::map<std::string, double> row = {
          {"step", static_cast<double>(step)},
          {"time", time},
          {"open", sum.open},
          {"stick", sum.stick},
          {"slip", sum.slip},
          {"normal_force", sum.normal},
          {"dissipated_energy", state.dissipated},
          {"linear_systems", steps.progress().step},
          {"friction_rung", steps.progress().friction_rung}};
      for (unsigned int t = 0; t + 1 < dim; ++t)
      {
        row[std::string("friction_") + axes[t]] = sum.tangential[t];
        row[std::string("u_") + axes[t]] = state.displacement[t];
      }
      report.add_row(row);
      for (std::size_t i = 0; i < chain.n; ++i)
      {
        table << step << "," << json_number(time) << "," << i + 1;
        write_mass(table, state, dim, i);
      }
      report.progress(
          "time " + short_number(time, 6) + "  open " + std::to_string(sum.open)
              + "  stick " + std::to_string(sum.stick) + "  slip "
              + std::to_string(sum.slip) + "  N = " + short_number(sum.normal)
              + "  T = " + short_number(sum.friction()),
          time / load_options.end_time);
    }

    void ChainScene::fill_summary(Report &report, const ChainSteps &steps,
                                  const LoadSteps &load_steps) const
    {
      const ChainState &state = steps.state();
      const unsigned int dim = chain.dimension;
      const Resultants sum(state, dim);
      double penetration = 0;
      for (std::size_t i = 0; i < chain.n; ++i)
        penetration = std::max(
            penetration, -chain.gap[i] - state.displacement[i * dim + dim - 1]);
      report.set("active", sum.stick + sum.slip);
      report.set("n_slipping", sum.slip);
      report.set("contact_force", sum.normal);
      report.set("friction_force",
                 std::vector<double>(sum.tangential, sum.tangential + dim - 1));
      report.set("friction_over_normal",
                 sum.normal > 0 ? sum.friction() / sum.normal : NAN);
      report.set("dissipated_energy", state.dissipated);
      report.set("friction_rung", worst_rung);
      report.set("max_penetration", penetration);
      report.set("energy", steps.energy(load_at(load_steps.time())));
      report.set("nonlinear_iterations", n_systems);
      report.set("load_steps", load_steps.n_accepted());
      report.set("time", load_steps.time());
      report.set("displacement",
                 std::vector<double>(state.displacement.begin(),
                                     state.displacement.begin() + dim));
    }

    /** All load steps; false if one has no answer. */
    bool ChainScene::take_steps(Report &report, ChainSteps &steps)
    {
      LoadSteps load_steps(load_options);
      Message failure;
      while (!load_steps.is_finished() && failure.empty())
      {
        const double time = load_steps.target();
        const Message why = steps.solve(load_at(time), method);
        n_systems += steps.progress().step;
        if (why.empty())
        {
          worst_rung = std::max(worst_rung, steps.progress().friction_rung);
          steps.accept();
          load_steps.accept();
          add_step(report, steps, time);
          diagnose_iteration(report, steps.progress());
          continue;
        }
        steps.reject();
        if (load_steps.reject())
          report.detail("load step cut back to time "
                        + short_number(load_steps.target(), 6) + ": " + why);
        else
          failure = why;
      }
      fill_summary(report, steps, load_steps);
      if (!failure.empty())
        report.warn(failure + " (after time "
                    + short_number(load_steps.time(), 6) + ")");
      return failure.empty();
    }

    Outcome ChainScene::run(const RunOptions &options, Report &report)
    {
      describe(report);
      const unsigned int dim = chain.dimension;
      std::vector<std::string> columns = {"step",  "time", "open",
                                          "stick", "slip", "normal_force"};
      for (const char *name : {"friction_", "u_"})
        for (unsigned int t = 0; t + 1 < dim; ++t)
          columns.push_back(std::string(name) + axes[t]);
      for (const char *name :
           {"dissipated_energy", "linear_systems", "friction_rung"})
        columns.emplace_back(name);
      report.declare_columns(columns);
      write_header(table, dim);
      ChainSteps steps(chain, has_friction);
      const bool done = [&]
      {
        SectionTimes::Scope scope(report.times, "solve");
        return take_steps(report, steps);
      }();
      if (dealii::Utilities::MPI::this_mpi_process(options.communicator) == 0)
        write_file(options.output_folder / "masses.csv", table.str());
      return done ? Outcome::converged : Outcome::unusable;
    }
  } // namespace

  std::unique_ptr<Scene> make_chain(const unsigned int dimension)
  {
    return std::make_unique<ChainScene>(dimension);
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "point_mass.h"

#include "app/input/input_error.h"
#include "app/input/number_text.h"
#include "app/input/parameters.h"
#include "app/input/short_number.h"
#include "app/report/json.h"
#include "app/restart/disk.h"
#include "app/scenes/common_parameters.h"
#include "app/scenes/diagnosis.h"
#include "app/scenes/method_effects.h"
#include "app/scenes/method_words.h"
#include "point_mass_model.h"

#include <abut/dealii/method_parameters.h>
#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;
    namespace Utilities = dealii::Utilities;

    const char *const stiffness_name = "Masses/Stiffness";
    const char *const rows_name = "Constraints/B";

    /** Rows of numbers separated by semicolons, all of @p n entries (0: as
     * many as there are rows). */
    std::vector<std::vector<double>> parse_rows(const std::string &text,
                                                const std::string &parameter,
                                                std::size_t n)
    {
      std::vector<std::vector<double>> rows;
      for (const std::string &row : Utilities::split_string_list(text, ';'))
        rows.push_back(parse_numbers(row, parameter));
      if (n == 0)
        n = rows.size();
      for (const std::vector<double> &row : rows)
        if (row.size() != n)
          throw InputError(parameter, "a row has " + std::to_string(row.size())
                                          + " numbers where "
                                          + std::to_string(n)
                                          + " are needed; rows are separated "
                                            "by ';'."
                                          + count_hint(row.size(), n));
      return rows;
    }

    std::vector<double> parse_vector(const std::string &text,
                                     const std::string &parameter,
                                     const std::size_t n)
    {
      std::vector<double> numbers = parse_numbers(text, parameter);
      if (numbers.size() != n)
        throw InputError(parameter, std::to_string(numbers.size())
                                        + " numbers where " + std::to_string(n)
                                        + " are needed."
                                        + count_hint(numbers.size(), n));
      return numbers;
    }

    void check_stiffness(const std::vector<std::vector<double>> &stiffness)
    {
      const std::size_t n = stiffness.size();
      if (n == 0 || n > 300)
        throw InputError(stiffness_name, "from 1 to 300 masses are possible.");
      for (std::size_t i = 0; i < n; ++i)
      {
        if (stiffness[i][i] < 0)
          throw InputError(stiffness_name,
                           "the diagonal has a negative entry: the equilibrium "
                           "would be unstable.");
        for (std::size_t j = 0; j < i; ++j)
          if (stiffness[i][j] != stiffness[j][i])
            throw InputError(stiffness_name, "the matrix is not symmetric.");
      }
    }

    /** One word for all rows, or one for each. */
    std::vector<bool> parse_kinds(const std::string &text, const std::size_t n)
    {
      const std::string parameter = "Constraints/Kind";
      std::vector<std::string> words = Utilities::split_string_list(text, ',');
      if (words.size() == 1)
        words.resize(n, words[0]);
      if (words.size() != n)
        throw InputError(parameter, std::to_string(words.size()) + " words for "
                                        + std::to_string(n)
                                        + " rows: give one for all or one for "
                                          "each.");
      std::vector<bool> equality;
      for (const std::string &word : words)
      {
        if (word != "equality" && word != "inequality")
          throw InputError(
              parameter, "'" + word
                             + "' is not one of inequality, "
                               "equality."
                             + did_you_mean(word, {"inequality", "equality"}));
        equality.push_back(word == "equality");
      }
      return equality;
    }

    class PointMass : public Scene
    {
    public:
      void declare(ParameterHandler &prm) const override;
      void parse(ParameterHandler &prm) override;
      std::vector<EffectRule> effects() const override;
      void check(const RunOptions &options, Report &report) override;
      Outcome run(const RunOptions &options, Report &report) override;

    private:
      void parse_model(ParameterHandler &prm);
      std::string closed_at_start() const;
      void describe(Report &report) const;
      void fill_table(Report &report, const PointMassSolution &solution) const;
      void fill_summary(Report &report,
                        const PointMassSolution &solution) const;
      void write_sweep(const RunOptions &options) const;

      PointMassModel model;
      MethodParameters method;
      std::vector<double> penalties;
    };

    void PointMass::declare(ParameterHandler &prm) const
    {
      prm.enter_subsection("Masses");
      parameter::declare(
          prm, "Stiffness", "1", TextPattern("a matrix"),
          parameter::basic("force/length", "2, -1; -1, 2"),
          "Stiffness matrix K of the springs: n rows of n numbers, rows "
          "separated by semicolons. Symmetric, and positive where the "
          "constraints leave the masses free.");
      parameter::declare(prm, "Force", "0", TextPattern::numbers(),
                         parameter::basic("force", "-1, 0"),
                         "Force on each mass: n numbers.");
      parameter::declare(
          prm, "Start", "", TextPattern::numbers(),
          parameter::expert("length", "0.5, 0.5"),
          "Displacement from which the solve starts: n numbers. Empty: 0.");
      prm.leave_subsection();
      prm.enter_subsection("Constraints");
      parameter::declare(
          prm, "B", "", TextPattern("a matrix"),
          parameter::basic("1", "1, 0; 0, 1"),
          "Derivatives of the gaps with respect to the displacements: a row of "
          "n numbers for each constraint, rows separated by semicolons. gap = "
          "initial gap + B u; a positive gap is open.");
      parameter::declare(prm, "Initial gap", "", TextPattern::numbers(),
                         parameter::basic("length", "0.1, 0.2"),
                         "Gap of each constraint at displacement 0.");
      parameter::declare(prm, "Kind", "inequality",
                         TextPattern("a list of words"),
                         parameter::advanced("", "equality, inequality"),
                         "inequality (gap >= 0) or equality (gap = 0): one "
                         "word for all constraints, or one for each.");
      prm.leave_subsection();
      MethodParameters::declare_parameters(prm);
      prm.enter_subsection("Method");
      parameter::declare(
          prm, "Barrier parameter", "none",
          OrWord(NumberPattern::from(0), "none"),
          parameter::expert("force*length", "0.01"),
          "Fixed product of contact force and gap for `barrier`, for study "
          "only. none: the barrier goes to zero by `Barrier start`, `Barrier "
          "factor` and `Barrier end`.");
      prm.leave_subsection();
      prm.enter_subsection("Sweep");
      parameter::declare(
          prm, "Penalty factors", "", TextPattern::numbers(),
          parameter::advanced("stiffness of the constraint", "1, 10, 100"),
          "Penalty factors for which the scene is also solved by `penalty`. "
          "The solutions go to sweep.csv and into the pictures.");
      prm.leave_subsection();
    }

    void PointMass::parse_model(ParameterHandler &prm)
    {
      prm.enter_subsection("Masses");
      const auto stiffness =
          parse_rows(prm.get("Stiffness"), stiffness_name, 0);
      check_stiffness(stiffness);
      for (const std::vector<double> &row : stiffness)
        model.stiffness.insert(model.stiffness.end(), row.begin(), row.end());
      const std::size_t n = stiffness.size();
      model.force = parse_vector(prm.get("Force"), "Masses/Force", n);
      model.start = prm.get("Start").empty()
                        ? std::vector<double>(n, 0.)
                        : parse_vector(prm.get("Start"), "Masses/Start", n);
      prm.leave_subsection();

      prm.enter_subsection("Constraints");
      model.rows = parse_rows(prm.get("B"), rows_name, n);
      if (model.rows.empty())
        throw InputError(rows_name, "the scene has no constraint.");
      for (const std::vector<double> &row : model.rows)
        if (std::all_of(row.begin(), row.end(),
                        [](const double b) { return b == 0; }))
          throw InputError(rows_name, "a row is zero: its gap cannot change.");
      for (std::size_t i = 0; i < model.rows.size(); ++i)
      {
        bool resists = false;
        for (std::size_t j = 0; j < n; ++j)
          resists = resists || (model.rows[i][j] != 0 && stiffness[j][j] > 0);
        if (!resists)
          throw InputError(stiffness_name,
                           "constraint " + std::to_string(i + 1)
                               + " acts on masses without a spring only: their "
                                 "diagonal entries are 0, and contact is "
                                 "scaled by them. Give one of these masses a "
                                 "spring.");
      }
      model.initial_gap = parse_vector(
          prm.get("Initial gap"), "Constraints/Initial gap", model.rows.size());
      model.equality = parse_kinds(prm.get("Kind"), model.rows.size());
      prm.leave_subsection();
      if (model.length_scale() == 0)
        throw InputError(
            "Masses/Force",
            "there is no load: all forces and initial gaps are 0.");
    }

    void PointMass::parse(ParameterHandler &prm)
    {
      parse_model(prm);
      method.parse_parameters(prm);
      require_law_without_stress(method);
      prm.enter_subsection("Method");
      const double barrier =
          parameter::number_or_zero(prm, "Barrier parameter");
      prm.leave_subsection();
      if (barrier > 0)
        method.options.barrier_start = method.options.barrier_end =
            barrier / (model.length_scale() * model.pressure_scale());
      prm.enter_subsection("Sweep");
      penalties =
          parse_numbers(prm.get("Penalty factors"), "Sweep/Penalty factors");
      prm.leave_subsection();
      for (const double penalty : penalties)
        if (!(penalty > 0))
          throw InputError("Sweep/Penalty factors",
                           "a penalty must be above 0.");
    }

    std::vector<EffectRule> PointMass::effects() const
    {
      EffectRules barrier = {effective_if(
          "Method/Barrier parameter", Weight::setting,
          [](const SceneValues &values)
          {
            return law_may_be(values, [](const abut_law &law)
                              { return abut_law_needs_open_start(&law); });
          },
          "it belongs to Method/Enforcement = barrier.")};
      for (const char *name : {"start", "factor", "end"})
        barrier.push_back(effective_if(
            std::string("Method/Barrier ") + name, Weight::setting,
            [](const SceneValues &values)
            { return values.number("Method/Barrier parameter") == 0.; },
            "Method/Barrier parameter replaces it."));
      return joined({barrier, law_effects(false),
                     no_discretisation("the constraints are given.")});
    }

    void PointMass::describe(Report &report) const
    {
      report.set("method", method.options.law->name);
      report.set("discretisation", "point mass");
      report.set("dofs", model.n());
      report.set("constraints", model.rows.size());
      report.print("  " + counted(model.n(), "unknown", "unknowns") + ", "
                   + counted(model.rows.size(), "constraint", "constraints")
                   + "; " + law_in_words(method));
      report.model("search", false, "the constraints are given");
      report.model("friction", false, "not part of this scene");
      report.model("linear solver", true,
                   "dense factorisation, unknowns: "
                       + std::to_string(model.n()));
    }

    /** What the barrier cannot start from; else empty. */
    std::string PointMass::closed_at_start() const
    {
      if (!abut_law_needs_open_start(method.options.law))
        return "";
      std::string closed;
      for (std::size_t i = 0; i < model.rows.size(); ++i)
        if (const double gap = model.gap(i, model.start); gap <= 0.)
          closed += (closed.empty() ? "" : ", ") + std::to_string(i + 1)
                    + " with gap " + short_number(gap, 4);
      return closed.empty()
                 ? ""
                 : std::string(method.options.law->name)
                       + " needs a start with open gaps, and at Masses/Start "
                         "these constraints are closed: "
                       + closed
                       + ". Give another Masses/Start, or use "
                         "Method/Enforcement = interior point, which needs "
                         "none.";
    }

    void PointMass::check(const RunOptions &, Report &report)
    {
      const std::string closed = closed_at_start();
      if (!closed.empty())
        throw InputError("Masses/Start", closed);
      describe(report);
    }

    /** Names u_1, u_2, ... or, of one, u. */
    std::vector<std::string> numbered(const std::string &name,
                                      const std::size_t n)
    {
      std::vector<std::string> names;
      for (std::size_t i = 1; i <= n; ++i)
        names.push_back(n == 1 ? name : name + "_" + std::to_string(i));
      return names;
    }

    void PointMass::fill_table(Report &report,
                               const PointMassSolution &solution) const
    {
      const auto u = numbered("u", model.n()),
                 p = numbered("p", model.rows.size()),
                 lambda = numbered("lambda", model.rows.size());
      std::vector<std::string> columns = {"outer",   "step",   "penalty",
                                          "barrier", "energy", "penetration"};
      for (const auto &names : {u, p, lambda})
        columns.insert(columns.end(), names.begin(), names.end());
      report.declare_columns(columns);
      const double barrier_unit = model.length_scale() * model.pressure_scale();
      for (const PointMassStep &step : solution.history)
      {
        std::map<std::string, double> row = {
            {"outer", step.progress.outer},
            {"step", step.progress.step},
            {"penalty", step.progress.penalty},
            {"barrier", step.progress.barrier * barrier_unit},
            {"energy", model.energy(step.displacement)},
            {"penetration", step.progress.penetration}};
        std::string line = "step " + std::to_string(step.progress.step);
        for (std::size_t i = 0; i < u.size(); ++i)
          row[u[i]] = step.displacement[i];
        for (std::size_t i = 0; i < p.size(); ++i)
        {
          row[p[i]] = step.pressure[i];
          row[lambda[i]] = 0. - step.pressure[i];
        }
        report.add_row(row);
        for (const auto &names : {u, lambda})
          for (const std::string &name : names)
            if (names.size() <= 4)
              line += "  " + name + " = " + short_number(row[name]);
        report.progress(line);
      }
    }

    void PointMass::fill_summary(Report &report,
                                 const PointMassSolution &solution) const
    {
      double penetration = 0, complementarity = 0;
      std::vector<double> lambda;
      for (std::size_t i = 0; i < model.rows.size(); ++i)
      {
        const double gap = model.gap(i, solution.displacement);
        penetration =
            std::max(penetration, model.equality[i] ? std::abs(gap) : -gap);
        complementarity =
            std::max(complementarity, std::abs(gap * solution.pressure[i]));
        lambda.push_back(0. - solution.pressure[i]);
      }
      report.set("active", solution.progress.n_active);
      report.set("contact_force", solution.pressure);
      report.set("max_penetration", penetration);
      report.set("max_complementarity", complementarity);
      report.set("energy", model.energy(solution.displacement));
      report.set("nonlinear_iterations", solution.progress.step);
      if (!abut_law_solves_once(method.options.law))
        report.set("outer_iterations", solution.progress.outer);
      report.set("displacement", solution.displacement);
      report.set("lambda", lambda);
    }

    void PointMass::write_sweep(const RunOptions &options) const
    {
      std::ostringstream out;
      out << "penalty";
      for (const std::string &name : numbered("u", model.n()))
        out << "," << name;
      for (const std::string &name : numbered("p", model.rows.size()))
        out << "," << name;
      out << "\n";
      abut_strategy_options by_penalty = method.options;
      by_penalty.law = abut_law_find("penalty");
      for (const double penalty : penalties)
      {
        by_penalty.penalty = penalty;
        const PointMassSolution solution = solve(model, by_penalty);
        out << json_number(penalty);
        for (const double u : solution.displacement)
          out << "," << json_number(u);
        for (const double p : solution.pressure)
          out << "," << json_number(p);
        out << "\n";
      }
      write_file(options.output_folder / "sweep.csv", out.str());
    }

    Outcome PointMass::run(const RunOptions &options, Report &report)
    {
      describe(report);
      diagnose_penalty(report, method);
      const PointMassSolution solution = [&]
      {
        SectionTimes::Scope scope(report.times, "solve");
        return solve(model, method.options);
      }();
      fill_table(report, solution);
      fill_summary(report, solution);
      if (solution.reason == ABUT_REASON_CONVERGED)
        diagnose_iteration(report, solution.progress);
      else
      {
        const std::string closed = closed_at_start();
        report.warn(
            coded(abut_reason_failure(solution.reason, method.options.law,
                                      &solution.progress),
                  closed.empty() ? abut_reason_text(solution.reason) : closed));
      }

      SectionTimes::Scope scope(report.times, "output");
      if (Utilities::MPI::this_mpi_process(options.communicator) == 0
          && !penalties.empty())
        write_sweep(options);
      return solution.reason == ABUT_REASON_CONVERGED ? Outcome::converged
                                                      : Outcome::unusable;
    }
  } // namespace

  std::unique_ptr<Scene> make_point_mass(unsigned int)
  {
    return std::make_unique<PointMass>();
  }
} // namespace abut::app

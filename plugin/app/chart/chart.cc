// SPDX-License-Identifier: LGPL-2.1-or-later
/* All points are planned and their scenes loaded first, so that a mistake shows
 * before the first run. Then the runs are made, all curves' first points first:
 * what comes early is cheap and shows soon what is wrong.
 *
 * An error against the exact solution is found by a run of its own. The timed
 * runs are told of no exact solution, so that they do not integrate errors and
 * solve coarse meshes no more tightly than a user's run does. */
#include "chart.h"

#include "app/input/short_number.h"
#include "chart_clock.h"
#include "chart_file.h"
#include "chart_output.h"
#include "chart_rows.h"
#include "run_maker.h"

#include "app/input/output_folder.h"
#include "app/scenes/parameter_reference.h"

#include <algorithm>
#include <ostream>
#include <set>
#include <sstream>

namespace abut::app
{
  namespace
  {
    const std::string exact_displacement = "Exact solution/Displacement",
                      exact_gradient = "Exact solution/Gradient";

    /** What an error of the summary needs in the scene. */
    const std::vector<std::pair<std::string, std::string>> error_sources = {
        {"l2_error", exact_displacement},
        {"h1_error", exact_displacement},
        {"energy_norm_error", exact_displacement},
        {"nodal_error", exact_displacement},
        {"energy_error", "Exact solution/Energy"},
        {"contact_force_error", "Exact solution/Contact force"}};

    struct Point
    {
      std::size_t curve;
      std::size_t number; /**< along the curve */
      RunSetting measured, timed;
      std::string refusal; /**< empty: it can be run */
    };

    class Chart
    {
    public:
      Chart(const ChartFile &chart, Report &report)
          : chart(chart), maker(chart.scene_file), report(report)
      {
      }

      void plan()
      {
        for (std::size_t c = 0; c < chart.curves.size(); ++c)
          plan_curve(c);
        refuse_empty_sections();
        std::stable_sort(points.begin(), points.end(),
                         [](const Point &a, const Point &b)
                         { return a.number < b.number; });
        if (!chart.error.finer_run.empty())
        {
          const Point point = plan_point(chart.error.finer_run, 0, 0);
          if (!point.refusal.empty())
            throw InputError("", point.refusal);
          finer = point.timed;
        }
      }

      /** Print the points. */
      void print() const
      {
        for (const Point &point : points)
          report.progress(chart.curves[point.curve].name + ", "
                          + chart.curves[point.curve].values[point.number]
                          + (point.refusal.empty() ? "" : ": refused: ")
                          + point.refusal);
        report.progress(std::to_string(points.size()) + " points, up to "
                        + std::to_string(chart.repeats) + " timed runs each");
      }

      std::vector<ChartRow> run(const RunStore &folder)
      {
        store = &folder;
        find_reference();
        std::vector<std::size_t> n_points;
        for (const ChartCurve &curve : chart.curves)
          n_points.push_back(curve.values.size());
        ChartClock clock(n_points);
        std::vector<ChartRow> rows;
        for (const Point &point : points)
        {
          seconds = 0;
          rows.push_back(run_point(point));
          clock.set(point.curve, point.number, seconds);
          tell(rows.back(), rows.size(), clock);
        }
        std::stable_sort(rows.begin(), rows.end(),
                         [](const ChartRow &a, const ChartRow &b)
                         { return a.curve < b.curve; });
        mark_fronts(rows);
        return rows;
      }

    private:
      /** Settings of every run: no files of fields, pictures, pages. */
      static std::vector<Assignment> silent(const LoadedScene &scene)
      {
        std::vector<Assignment> result;
        for (const char *path :
             {"Output/Fields", "Output/Pictures", "Output/Report"})
          if (scene.declares(path))
            result.push_back({path, "false", "abut chart"});
        return result;
      }

      void plan_curve(const std::size_t c)
      {
        const ChartCurve &curve = chart.curves[c];
        for (std::size_t i = 0; i < curve.values.size(); ++i)
        {
          std::vector<Assignment> settings = curve.settings;
          for (const std::string &path : curve.axis)
            settings.push_back({path, curve.values[i], curve.axis_origin});
          points.push_back(plan_point(settings, c, i));
        }
      }

      /** One impossible combination among others is a result; a section that
       * has nothing else is a mistake. */
      void refuse_empty_sections() const
      {
        std::set<std::string> possible;
        for (const Point &point : points)
          if (point.refusal.empty())
            possible.insert(chart.curves[point.curve].section);
        for (const Point &point : points)
          if (possible.count(chart.curves[point.curve].section) == 0)
            throw InputError("", point.refusal + " (all of section '"
                                     + chart.curves[point.curve].section
                                     + "')");
      }

      Point plan_point(const std::vector<Assignment> &settings,
                       const std::size_t curve, const std::size_t number) const
      {
        std::vector<Assignment> all = silent(maker.load({}));
        all.insert(all.end(), settings.begin(), settings.end());
        LoadedScene scene = maker.load(all);
        require_error(scene);
        Point point = {curve, number, maker.setting(scene, all), {}, ""};
        point.timed = point.measured;
        if (knows(scene, exact_displacement))
        {
          for (const std::string &path : {exact_displacement, exact_gradient})
            all.push_back({path, "", "abut chart"});
          point.timed = maker.setting(maker.load(all), all);
          if (!needs_displacement(chart.error.quantity))
            point.measured = point.timed;
        }
        try
        {
          scene.parse();
        }
        catch (const InputError &error)
        {
          point.refusal = scene.file.placed(error).what();
        }
        return point;
      }

      /** Whether it is an error that is integrated over the body. */
      static bool needs_displacement(const std::string &quantity)
      {
        return std::find(error_sources.begin(), error_sources.end(),
                         std::make_pair(quantity, exact_displacement))
               != error_sources.end();
      }

      static bool knows(LoadedScene &scene, const std::string &path)
      {
        const std::size_t slash = path.find('/');
        if (!scene.declares(path))
          return false;
        const std::string value =
            scene.get(path.substr(0, slash), path.substr(slash + 1));
        return !value.empty() && value != "nan";
      }

      void require_error(LoadedScene &scene) const
      {
        const std::string &quantity = chart.error.quantity;
        if (quantity.empty() || !chart.error.is_error())
          return;
        std::vector<std::string> words;
        for (const auto &[error, source] : error_sources)
        {
          words.push_back(error);
          if (error != quantity)
            continue;
          if (knows(scene, source))
            return;
          throw InputError("Error/Quantity",
                           "there is no " + quantity + ": the scene '"
                               + chart.scene_file + "' does not know '" + source
                               + "'. Take another quantity with its right "
                                 "value as Reference, or with a section "
                                 "'Finer run'.");
        }
        throw InputError("Error/Quantity", "no scene has '" + quantity + "'."
                                               + did_you_mean(quantity, words));
      }

      void find_reference()
      {
        reference = chart.error.reference.value_or(0);
        if (chart.error.finer_run.empty())
          return;
        report.progress("finer run for the reference");
        bool made = false;
        const RunRecord record =
            maker.run(*store, finer, 0, 10 * chart.time_limit, made);
        if (record.ended != "ok")
          throw InputError("", "the finer run, which gives the reference, "
                               "ended as '"
                                   + record.ended + "': " + record.reason);
        reference = value(record, "Error/Quantity", chart.error.quantity);
        report.progress("reference: " + chart.error.quantity + " = "
                        + short_number(reference)
                        + (made ? "" : " (made earlier)"));
      }

      /** The number @p key of a run that went well. */
      static double value(const RunRecord &record, const std::string &parameter,
                          const std::string &key)
      {
        const bool of_rows = key.find('(') != std::string::npos;
        const auto number =
            of_rows ? record.figures.value(key) : record.figures.cost(key);
        if (number)
          return *number;
        throw InputError(parameter, "the runs have no number '" + key + "'"
                                        + (of_rows ? "." : " in summary.json.")
                                        + record.figures.explain(key));
      }

      ChartRow run_point(const Point &point)
      {
        ChartRow row;
        row.curve = point.curve;
        row.value = chart.curves[point.curve].values[point.number];
        if (!point.refusal.empty())
        {
          row.ended = "refused";
          row.code = static_cast<int>(ExitCode::bad_input);
          row.reason = point.refusal;
          return row;
        }
        const RunRecord measured = make(point.measured, 0);
        fill(row, measured);
        if (row.ok())
        {
          if (chart.axis_quantity.empty())
            row.x = axis_number(point);
          if (!chart.error.quantity.empty())
            value(measured, "Error/Quantity", chart.error.quantity);
          time(point, row);
        }
        return row;
      }

      RunRecord make(const RunSetting &setting, const unsigned int repeat)
      {
        bool made = false;
        const RunRecord record =
            maker.run(*store, setting, repeat, chart.time_limit, made);
        seconds += record.seconds;
        return record;
      }

      /** The value along the axis, or its number where it is a word. */
      double axis_number(const Point &point) const
      {
        const std::string &text =
            chart.curves[point.curve].values[point.number];
        char *end = nullptr;
        const double number = std::strtod(text.c_str(), &end);
        return *end == '\0' ? number : double(point.number + 1);
      }

      void fill(ChartRow &row, const RunRecord &record) const
      {
        const auto number = [&record](const std::string &key)
        { return record.figures.value(key).value_or(ChartRow::unknown); };
        row.ended = record.ended;
        row.reason = record.reason;
        row.code = record.code;
        row.key = RunStore::key(record.setting);
        row.quantity = number(chart.error.quantity);
        const ChartError &error = chart.error;
        const double scale = error.scale > 0 ? error.scale
                             : error.is_error() || reference == 0
                                 ? 1
                                 : std::abs(reference);
        if (!error.quantity.empty())
          row.error = std::abs(row.quantity - reference) / scale;
        row.dofs = number("dofs");
        row.constraints = number("constraints");
        row.active = number("active");
        if (!chart.axis_quantity.empty())
          row.x = number(chart.axis_quantity);
      }

      void time(const Point &point, ChartRow &row)
      {
        std::vector<double> times, processor, wall, memory;
        double spent = 0;
        for (unsigned int i = 0;
             i < chart.repeats && (i == 0 || spent < chart.repeat_seconds); ++i)
        {
          const RunRecord record = make(point.timed, i);
          if (record.ended != "ok")
          {
            row.ended = record.ended;
            row.reason = record.reason;
            row.code = record.code;
            return;
          }
          times.push_back(value(record, "Time", chart.time));
          processor.push_back(value(record, "Time", "processor_seconds"));
          wall.push_back(value(record, "Time", "wall_seconds"));
          memory.push_back(value(record, "Time", "peak_memory_mb"));
          spent += processor.back();
          if (i == 0)
            count_work(record, row);
        }
        row.repeats = static_cast<unsigned int>(times.size());
        row.time = median(times);
        row.fastest = *std::min_element(times.begin(), times.end());
        row.slowest = *std::max_element(times.begin(), times.end());
        row.processor_seconds = median(processor);
        row.wall_seconds = median(wall);
        row.peak_memory_mb = median(memory);
      }

      void count_work(const RunRecord &record, ChartRow &row) const
      {
        const auto number = [&record](const char *key)
        { return record.figures.value(key).value_or(ChartRow::unknown); };
        row.matvecs = number("matvecs");
        row.linear_iterations = number("linear_iterations");
        row.nonlinear_iterations = number("nonlinear_iterations");
        if (!chart.axis_quantity.empty())
          value(record, "Axis quantity", chart.axis_quantity);
      }

      void tell(const ChartRow &row, const std::size_t n_done,
                const ChartClock &clock)
      {
        std::ostringstream line;
        line << n_done << '/' << points.size() << "  "
             << chart.curves[row.curve].name << ", " << row.value << ": ";
        if (row.ok())
        {
          if (!chart.error.quantity.empty())
            line << "error " << short_number(row.error, 3) << ", ";
          line << chart.time << ' ' << short_number(row.time, 3);
        }
        else
          line << row.ended << ": " << row.reason;
        const std::string left = clock.text();
        report.progress(line.str() + (left.empty() ? "" : "; " + left));
      }

      const ChartFile &chart;
      RunMaker maker;
      const RunStore *store = nullptr;
      Report &report;
      std::vector<Point> points;
      RunSetting finer;
      double reference = 0;
      double seconds = 0; /**< of the runs of the present point */
    };

    void warn_of_failures(const ChartFile &chart,
                          const std::vector<ChartRow> &rows, Report &report)
    {
      std::size_t n = 0;
      std::string first;
      for (const ChartRow &row : rows)
        if (!row.ok() && n++ == 0)
          first = chart.curves[row.curve].name + ", " + row.value + " was "
                  + row.ended + ": " + row.reason;
      if (n > 0)
        report.warn(std::to_string(n) + " of " + std::to_string(rows.size())
                    + " points have no answer, see runs.csv; the first: "
                    + first);
    }
  } // namespace

  ExitCode make_chart(const std::string &file,
                      const std::vector<std::string> &overrides,
                      const std::filesystem::path &folder, const bool plan_only,
                      Report &report)
  {
    const ChartFile chart(file, overrides);
    std::vector<ChartRow> rows;
    try
    {
      Chart work(chart, report);
      work.plan();
      if (plan_only)
      {
        work.print();
        return ExitCode::success;
      }
      make_output_folder(folder);
      rows = work.run(RunStore(folder));
    }
    catch (const InputError &error)
    {
      throw chart.file.placed(error);
    }
    write_at_once(folder / "runs.csv", runs_csv(chart, rows));
    if (!chart.error.quantity.empty())
    {
      const std::string table = cheapest_table(chart, rows);
      write_at_once(folder / "cheapest.md", table);
      std::istringstream lines(table);
      for (std::string line; std::getline(lines, line);)
        report.progress(line);
    }
    draw_chart(report, folder, chart, rows);
    warn_of_failures(chart, rows, report);
    report.progress("runs.csv and pictures in " + folder.string());
    const bool some = std::any_of(rows.begin(), rows.end(),
                                  [](const ChartRow &row) { return row.ok(); });
    return some ? ExitCode::success : ExitCode::unusable_answer;
  }

  void write_chart_reference(std::ostream &out)
  {
    dealii::ParameterHandler prm;
    ChartFile::declare(prm);
    out << "\n## Charts\n\n"
           "Parameters of a file for `abut chart`. Beside them, the sections "
           "`All curves` and\n`Curve NAME` (one for each curve; it must set "
           "something) hold settings of the scene, in\nsections as in the "
           "scene file; values separated by ` | ` make a curve each, and "
           "several\nsuch lists are multiplied (NAME may then be left "
           "out). `Error/Finer run` holds "
           "settings likewise.\n\n";
    write_parameters(out, prm, "chart");
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_REPORT_H
#define ABUT_APP_REPORT_H

/** @file
 * What a run has to say: `summary.json`, `levels.csv`, progress lines and the
 * closing table.
 */

#include "progress_lines.h"
#include "section_times.h"

#include <abut/dealii/coded.h>

#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace abut::app
{
  /** How much a command prints. */
  enum class Verbosity
  {
    quiet, ///< warnings only
    brief, ///< a screen: the results that a reader looks for first
    all    ///< each line of progress, and all figures with their keys
  };

  /** Where a measure of the examination has no such limit. */
  inline constexpr double no_limit = std::numeric_limits<double>::quiet_NaN();

  /** A figure of the summary whose value is known beforehand. */
  struct ExpectedFigure
  {
    std::string key; ///< `energy`, or `pair_1_force[1]` of a vector
    double value;
  };

  /** Collects the results of one run. All ranks hold the same values and call
   * the same functions; only rank 0 prints and writes.
   *
   * The keys that every summary has (scene, method, dofs, active, energy, ...)
   * exist from the start in fixed order with the value null; set() fills them.
   * A key of a scene's own is appended. wall_seconds, processor_seconds (sum
   * over ranks), peak_memory_mb, ranks and the table `sections` are filled by
   * finish(). */
  class Report
  {
  public:
    /** A value of the summary; monostate and NaN are written as null. */
    using Value = std::variant<std::monostate, bool, std::int64_t, double,
                               std::string, std::vector<double>>;

    Report(MPI_Comm communicator, Verbosity verbosity);

    /** @name Summary @{ */
    /** Any number, truth value, text or vector of numbers. */
    template <typename T> void set(const std::string &key, const T &value)
    {
      if constexpr (std::is_same_v<T, Value>)
        set_value(key, value);
      else if constexpr (std::is_convertible_v<const T &, std::string>)
        set_value(key, std::string(value));
      else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
        set_value(key, static_cast<std::int64_t>(value));
      else
        set_value(key, value);
    }

    /** Add to a count (nonlinear_iterations, matvecs, ...); null counts as 0.
     */
    void add(const std::string &key, std::int64_t count);

    /** Present value of a key; monostate when there is none. */
    Value get(const std::string &key) const;

    /** All keys, those without a value too. */
    std::vector<std::string> keys() const;

    /** A number, or the component of a vector that `key[i]` names, counted
     * from 0; none when it is not there or not finite. */
    std::optional<double> number(const std::string &key) const;

    /** A figure has this value by a formula or another program. Collected
     * under the key `expected`. */
    void expect(const std::string &key, double value);

    const std::vector<ExpectedFigure> &expected_figures() const
    {
      return expected;
    }

    /** Warn of expected figures that the summary does not have. */
    void check_expected();

    /** A measure of the examination of an answer, the limits above which it is
     * a warning, and an error, and the failure that these name. Collected under
     * the key `examination`; a later value of a measure replaces the earlier
     * one. */
    void examined(const std::string &name, double value, double warning,
                  double error, abut_failure failure);

    std::size_t n_examined() const
    {
      return measures.size();
    }
    /** @} */

    /** @name Table `levels.csv` @{ */
    /** Columns, once, before the first row. */
    void declare_columns(const std::vector<std::string> &names);

    /** Whether there is a row. */
    bool has_rows() const
    {
      return !rows.empty();
    }

    /** Append a row; columns that are missing stay empty. */
    void add_row(const std::map<std::string, double> &values);
    /** @} */

    /** @name Console @{ */
    /** A line that is no progress (rank 0, unless quiet). */
    void print(const std::string &line);

    /** A step of the run has ended. One line, preceded by the elapsed time; a
     * brief report has a few of them, see ProgressLines.
     * @param done part of the run that is behind it, where that is known */
    void progress(const std::string &line, std::optional<double> done = {});

    /** A line of progress that a brief report leaves out. */
    void detail(const std::string &line);

    /** A line for the user that is printed even when quiet, and again at the
     * end. Collected under the key `warnings`; known failures, see coded(),
     * under `codes`, too, and the data of messages under `findings`. */
    void warn(const Message &message);

    std::size_t n_warnings() const
    {
      return warnings.size();
    }

    /** A line of the closing table of what was modelled: @p what ("adaptive
     * refinement"), on or off, and the reason. @p cost names the sections of
     * times whose share of time and memory is its cost. */
    void model(const std::string &what, bool on, const std::string &why,
               const std::vector<std::string> &cost = {});

    /** A parameter that was set and that this run does not use, with the
     * reason. Collected under the key `not_used`. */
    void not_used(const std::string &line);

    /** Something that the answer does not need, with the evidence; printed by
     * explain(). Collected under the key `could_be_left_out`. */
    void leave_out(const std::string &line);
    /** @} */

    /** Wall times; use `SectionTimes::Scope scope(report.times, "assembly");`.
     */
    SectionTimes times;

    /** Wall seconds since construction. */
    double elapsed() const;

    /** Take wall times and peak memory as maxima over ranks, processor times as
     * sums. Collective. */
    void finish();

    /** Write summary.json and levels.csv into @p folder (rank 0). */
    void write(const std::filesystem::path &folder) const;

    /** Print the results: a brief report the figures that a reader looks for
     * first, another one all of them and the closing tables (rank 0, unless
     * quiet). */
    void print_summary();

    /** Print what could have been left out (rank 0). */
    void explain() const;

    /** The summary as JSON. */
    void write_json(std::ostream &out) const;

    /** The table as CSV. */
    void write_csv(std::ostream &out) const;

    /** What a checkpoint keeps: all but the names of columns. Times and costs
     * go on from where they were. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      double seconds = elapsed(), processor = used_processor_seconds();
      archive &seconds &processor &times &values &rows &warnings &codes;
      archive &model_lines &left_out &measures;
      count_from(seconds, processor);
    }

    const MPI_Comm communicator;

  private:
    struct ModelLine
    {
      std::string what;
      bool on;
      std::string why;
      std::vector<std::string> cost;

      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &what &on &why &cost;
      }
    };

    struct Measure
    {
      double value, warning, error;
      abut_failure failure;

      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &value &warning &error &failure;
      }
    };

    /** Seconds and MiB of an ingredient's sections. */
    std::pair<double, double> cost_of(const ModelLine &line) const;
    double wall_seconds() const;
    double used_processor_seconds() const;
    /** Let the clocks show these times now. */
    void count_from(double seconds, double processor);
    void print_model(std::ostream &out) const;
    void print_cost(std::ostream &out) const;

    void print_all(std::ostream &out) const;

    void set_value(const std::string &key, Value value);

    bool prints() const;

    const Verbosity verbosity;
    const bool root;
    ProgressLines lines;
    std::chrono::steady_clock::time_point start;
    double processor_start;
    std::vector<std::pair<std::string, Value>> values;
    std::vector<SectionTimes::Section> sections;
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
    std::vector<Message> warnings;
    std::vector<std::string> codes; ///< sorted, each once
    std::vector<ModelLine> model_lines;
    std::vector<std::string> left_out;
    std::map<std::string, Measure> measures;
    std::vector<std::string> unused;
    std::vector<ExpectedFigure> expected;
  };
} // namespace abut::app

#endif

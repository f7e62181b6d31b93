// SPDX-License-Identifier: LGPL-2.1-or-later
#include "report.h"

#include "app/input/short_number.h"
#include "app/restart/disk.h"
#include "brief_report.h"
#include "failure_list.h"
#include "json.h"
#include "peak_memory.h"
#include "processor_time.h"

#include <abut/dealii/nearest_word.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>

namespace abut::app
{
  namespace
  {
    /** Keys of every summary, in the order in which they are written. */
    const char *const common_keys[] = {"scene",
                                       "title",
                                       "method",
                                       "discretisation",
                                       "dimension",
                                       "converged",
                                       "dofs",
                                       "constraints",
                                       "active",
                                       "contact_force",
                                       "max_penetration",
                                       "max_complementarity",
                                       "energy",
                                       "nonlinear_iterations",
                                       "linear_iterations",
                                       "matvecs",
                                       "search_rebuilds",
                                       "pairs",
                                       "l2_error",
                                       "h1_error",
                                       "ranks",
                                       "wall_seconds",
                                       "processor_seconds",
                                       "peak_memory_mb"};

    std::string text_of(const Report::Value &value)
    {
      struct Visitor
      {
        std::string operator()(std::monostate) const
        {
          return "";
        }
        std::string operator()(const bool value) const
        {
          return value ? "yes" : "no";
        }
        std::string operator()(const std::int64_t value) const
        {
          return std::to_string(value);
        }
        std::string operator()(const double value) const
        {
          return std::isfinite(value) ? short_number(value) : "";
        }
        std::string operator()(const std::string &value) const
        {
          return value;
        }
        std::string operator()(const std::vector<double> &value) const
        {
          std::string text;
          for (const double x : value)
            text += (text.empty() ? "" : "  ") + short_number(x);
          return text;
        }
      };
      return std::visit(Visitor(), value);
    }

    /** The parameters of lines `Section/Name: why`, the first few. */
    std::string names_of(const std::vector<std::string> &lines)
    {
      constexpr std::size_t most = 4;
      std::string text;
      for (std::size_t i = 0; i < std::min(most, lines.size()); ++i)
        text += (i > 0 ? ", " : "") + lines[i].substr(0, lines[i].find(": "));
      if (lines.size() > most)
        text += " and " + std::to_string(lines.size() - most) + " more";
      return text;
    }

    /** Name and remedy of each known failure that was warned of. */
    void write_failures(JsonWriter &json, const std::vector<std::string> &codes)
    {
      json.begin("failures");
      for (std::int32_t i = 0; const auto *entry = abut_failure_at(i); ++i)
        if (std::binary_search(codes.begin(), codes.end(), entry->code))
        {
          json.begin(entry->code);
          json.value("name", std::string(entry->name));
          json.value("remedy", remedy(*entry));
          json.end();
        }
      json.end();
    }

    /** The data of messages, numbered from 1 in the order of `warnings`. */
    void write_findings(JsonWriter &json, const std::vector<Message> &messages)
    {
      json.begin("findings");
      for (std::size_t i = 0; i < messages.size(); ++i)
      {
        const Message &message = messages[i];
        const auto *known = abut_failure_get(message.failure);
        json.begin(std::to_string(i + 1));
        json.value("code", std::string(known != nullptr ? known->code : ""));
        json.value("pair", message.pair);
        if (message.body >= 0)
          json.value("body", static_cast<std::int64_t>(message.body) + 1);
        json.begin("numbers");
        for (const auto &[name, number] : message.numbers)
          json.value(name, number);
        json.end();
        json.end();
      }
      json.end();
    }

    std::string padded(const std::string &text, const std::size_t width)
    {
      return text + std::string(width - std::min(width, text.size()), ' ');
    }
  } // namespace

  Report::Report(MPI_Comm communicator, const Verbosity verbosity)
      : communicator(communicator),
        verbosity(verbosity),
        root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0),
        lines(verbosity == Verbosity::all),
        start(std::chrono::steady_clock::now()),
        processor_start(processor_seconds())
  {
    for (const char *key : common_keys)
      values.emplace_back(key, std::monostate());
  }

  void Report::set_value(const std::string &key, Value value)
  {
    for (auto &[name, present] : values)
      if (name == key)
      {
        present = std::move(value);
        return;
      }
    values.emplace_back(key, std::move(value));
  }

  void Report::add(const std::string &key, const std::int64_t count)
  {
    const Value present = get(key);
    const auto *number = std::get_if<std::int64_t>(&present);
    set(key, number ? *number + count : count);
  }

  Report::Value Report::get(const std::string &key) const
  {
    for (const auto &[name, value] : values)
      if (name == key)
        return value;
    return std::monostate();
  }

  std::vector<std::string> Report::keys() const
  {
    std::vector<std::string> names;
    for (const auto &[name, value] : values)
      names.push_back(name);
    return names;
  }

  std::optional<double> Report::number(const std::string &key) const
  {
    const std::size_t bracket = key.find('[');
    const Value value = get(key.substr(0, bracket));
    std::optional<double> result;
    if (const auto *vector = std::get_if<std::vector<double>>(&value))
    {
      const std::size_t entry =
          bracket == std::string::npos
              ? 0
              : std::strtoul(&key[bracket + 1], nullptr, 10);
      if (entry < vector->size()
          && (bracket != std::string::npos || vector->size() == 1))
        result = (*vector)[entry];
    }
    else if (bracket != std::string::npos)
      return {};
    else if (const auto *number = std::get_if<double>(&value))
      result = *number;
    else if (const auto *count = std::get_if<std::int64_t>(&value))
      result = static_cast<double>(*count);
    return result && std::isfinite(*result) ? result : std::nullopt;
  }

  void Report::expect(const std::string &key, const double value)
  {
    expected.push_back({key, value});
  }

  void Report::check_expected()
  {
    for (const ExpectedFigure &figure : expected)
      if (!number(figure.key))
        warn("Output/Expected: the results have no number '" + figure.key + "'."
             + did_you_mean(figure.key, keys()));
  }

  void Report::examined(const std::string &name, const double value,
                        const double warning, const double error,
                        const abut_failure failure)
  {
    measures[name] = {value, warning, error, failure};
  }

  void Report::declare_columns(const std::vector<std::string> &names)
  {
    AssertThrow(rows.empty(), dealii::ExcMessage("the table has rows already"));
    columns = names;
  }

  void Report::add_row(const std::map<std::string, double> &row)
  {
    std::vector<double> cells(columns.size(),
                              std::numeric_limits<double>::quiet_NaN());
    for (const auto &[name, value] : row)
    {
      const auto column = std::find(columns.begin(), columns.end(), name);
      AssertThrow(column != columns.end(),
                  dealii::ExcMessage("no column '" + name + "' was declared"));
      cells[column - columns.begin()] = value;
    }
    rows.push_back(cells);
  }

  bool Report::prints() const
  {
    return root && verbosity != Verbosity::quiet;
  }

  void Report::print(const std::string &line)
  {
    if (prints())
      lines.print(line);
  }

  void Report::progress(const std::string &line,
                        const std::optional<double> done)
  {
    if (prints())
      lines.step(line, elapsed(), done);
  }

  void Report::detail(const std::string &line)
  {
    if (prints())
      lines.detail(line, elapsed());
  }

  void Report::warn(const Message &message)
  {
    const std::string &line = message.text;
    warnings.push_back(message);
    if (const auto *known = abut_failure_get(message.failure))
    {
      const auto place =
          std::lower_bound(codes.begin(), codes.end(), known->code);
      if (place == codes.end() || *place != known->code)
        codes.insert(place, known->code);
    }
    if (!root)
      return;
    lines.interrupt();
    std::cerr << "abut: warning: " << line << std::endl;
  }

  void Report::model(const std::string &what, const bool on,
                     const std::string &why,
                     const std::vector<std::string> &cost)
  {
    model_lines.push_back({what, on, why, cost});
  }

  void Report::leave_out(const std::string &line)
  {
    left_out.push_back(line);
  }

  void Report::not_used(const std::string &line)
  {
    unused.push_back(line);
  }

  double Report::elapsed() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now()
                                         - start)
        .count();
  }

  double Report::used_processor_seconds() const
  {
    return processor_seconds() - processor_start;
  }

  void Report::count_from(const double seconds, const double processor)
  {
    using Clock = std::chrono::steady_clock;
    start = Clock::now()
            - std::chrono::duration_cast<Clock::duration>(
                std::chrono::duration<double>(seconds));
    processor_start = processor_seconds() - processor;
  }

  void Report::finish()
  {
    namespace MPI = dealii::Utilities::MPI;
    set("ranks", MPI::n_mpi_processes(communicator));
    set("wall_seconds", MPI::max(elapsed(), communicator));
    set("processor_seconds", MPI::sum(used_processor_seconds(), communicator));
    const double memory = peak_memory();
    set("peak_memory_mb", MPI::max(memory, communicator));
    set("peak_memory_mb_on_rank",
        std::vector<double>{MPI::min(memory, communicator),
                            MPI::max(memory, communicator)});
    // Ranks may have entered different sections: those of rank 0 count.
    sections = times.sections();
    std::vector<std::string> names;
    for (const SectionTimes::Section &section : sections)
      names.push_back(section.name);
    names = MPI::broadcast(communicator, names);
    sections.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const SectionTimes::Section section = times.section(names[i]);
      sections[i].seconds = MPI::max(section.seconds, communicator);
      sections[i].processor_seconds =
          MPI::sum(section.processor_seconds, communicator);
      sections[i].memory_mb = MPI::max(section.memory_mb, communicator);
    }
  }

  void Report::write_json(std::ostream &out) const
  {
    JsonWriter json(out);
    json.begin();
    for (const auto &[name, value] : values)
      std::visit([&json, &name = name](const auto &v) { json.value(name, v); },
                 value);
    json.begin("examination");
    for (const auto &[name, measure] : measures)
    {
      json.begin(name);
      json.value("value", measure.value);
      json.value("warning_above", measure.warning);
      json.value("error_above", measure.error);
      json.value("code", std::string(abut_failure_get(measure.failure)->code));
      json.end();
    }
    json.end();
    json.begin("expected");
    for (const ExpectedFigure &figure : expected)
      json.value(figure.key, figure.value);
    json.end();
    std::vector<std::string> texts;
    for (const Message &message : warnings)
      texts.push_back(message.text);
    json.value("warnings", texts);
    write_findings(json, warnings);
    json.value("codes", codes);
    write_failures(json, codes);
    json.value("not_used", unused);
    json.value("could_be_left_out", left_out);
    json.begin("modelled");
    for (const ModelLine &line : model_lines)
    {
      const auto [seconds, memory] = cost_of(line);
      json.begin(line.what);
      json.value("on", line.on);
      json.value("why", line.why);
      json.value("time_share", seconds / wall_seconds());
      json.value("memory_mb", memory);
      json.end();
    }
    json.end();
    json.begin("sections");
    for (const SectionTimes::Section &section : sections)
    {
      json.begin(section.name);
      json.value("seconds", section.seconds);
      json.value("processor_seconds", section.processor_seconds);
      json.value("memory_mb", section.memory_mb);
      json.value("calls", static_cast<std::int64_t>(section.calls));
      json.end();
    }
    json.end();
    json.end();
  }

  void Report::write_csv(std::ostream &out) const
  {
    for (std::size_t i = 0; i < columns.size(); ++i)
      out << (i == 0 ? "" : ",") << columns[i];
    out << "\n";
    for (const std::vector<double> &row : rows)
    {
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        out << (i == 0 ? "" : ",");
        if (std::isfinite(row[i]))
          out << json_number(row[i]);
      }
      out << "\n";
    }
  }

  void Report::write(const std::filesystem::path &folder) const
  {
    if (!root)
      return;
    std::ostringstream table;
    write_csv(table);
    if (!columns.empty())
      replace_on_disk(folder / "levels.csv", table.str());
    // Last: who finds it finds all of the results.
    std::ostringstream summary;
    write_json(summary);
    replace_on_disk(folder / "summary.json", summary.str());
  }

  double Report::wall_seconds() const
  {
    const Value value = get("wall_seconds");
    return std::holds_alternative<double>(value) ? std::get<double>(value)
                                                 : elapsed();
  }

  std::pair<double, double> Report::cost_of(const ModelLine &line) const
  {
    std::pair<double, double> sum(0., 0.);
    for (const SectionTimes::Section &section : sections)
      if (std::find(line.cost.begin(), line.cost.end(), section.name)
          != line.cost.end())
      {
        sum.first += section.seconds;
        sum.second += section.memory_mb;
      }
    return sum;
  }

  void Report::print_model(std::ostream &out) const
  {
    if (!model_lines.empty())
      out << "\n  Model\n";
    std::size_t width = 0;
    for (const ModelLine &line : model_lines)
      width = std::max(width, line.what.size());
    for (const ModelLine &line : model_lines)
    {
      out << "  " << padded(line.what, width)
          << (line.on ? "  on   " : "  off  ") << line.why;
      const auto [seconds, memory] = cost_of(line);
      if (!line.cost.empty() && !sections.empty())
        out << " (" << short_number(100 * seconds / wall_seconds(), 2)
            << " % of the time, " << short_number(memory, 3) << " MiB)";
      out << "\n";
    }
  }

  void Report::print_cost(std::ostream &out) const
  {
    const double wall = wall_seconds();
    if (!sections.empty())
      out << "\n  Cost" << std::string(30, ' ')
          << "seconds   share       MiB     calls\n";
    for (const SectionTimes::Section &section : sections)
    {
      const std::string name = section.name.substr(section.name.rfind('/') + 1);
      out << "  " << padded(std::string(2 * section.depth, ' ') + name, 28)
          << std::fixed << std::setprecision(4) << std::setw(13)
          << section.seconds << std::setprecision(0) << std::setw(6)
          << 100 * section.seconds / wall << " %" << std::setprecision(1)
          << std::setw(10) << section.memory_mb << std::setw(10)
          << section.calls << "\n";
    }
  }

  void Report::explain() const
  {
    if (!root)
      return;
    std::ostringstream out;
    out << "\n  Parts that could be left out\n";
    for (const std::string &line : left_out)
      out << "  - " << line << "\n";
    if (left_out.empty())
      out << "  none found by this run\n";
    std::cout << out.str() << std::flush;
  }

  void Report::print_all(std::ostream &out) const
  {
    out << "\n";
    std::size_t width = 0;
    for (const auto &[name, value] : values)
      if (!text_of(value).empty())
        width = std::max(width, name.size());
    for (const auto &[name, value] : values)
      if (!text_of(value).empty())
        out << "  " << padded(name, width) << "  " << text_of(value) << "\n";

    print_model(out);
    print_cost(out);
    if (!unused.empty())
      out << "\n  Not used\n";
    for (const std::string &line : unused)
      out << "  " << line << "\n";
    for (const Message &message : warnings)
      out << "\n  warning: " << message.text << "\n";
  }

  void Report::print_summary()
  {
    if (!prints())
      return;
    lines.finish();
    std::ostringstream out;
    print_brief(out, *this, lines.n_printed());
    if (verbosity == Verbosity::all)
      print_all(out);
    else if (!unused.empty())
      out << "  settings without effect, reasons by --verbose: "
          << names_of(unused) << "\n";
    std::cout << out.str() << std::flush;
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
// The failure atlas as a page.
#include "atlas.h"
#include "remedy.h"

#include "app/input/short_number.h"
#include "app/report/report.h"

#include <algorithm>
#include <ostream>

namespace abut::app
{
  namespace
  {
    std::string text_of(const std::optional<double> &number)
    {
      return number ? short_number(*number, 3) : "-";
    }

    /** Text inside a cell of a table. */
    std::string cell(std::string text)
    {
      for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos;
           i += 2)
        text.insert(i, "\\");
      return text;
    }

    void write_codes(const std::vector<AtlasResult> &results, std::ostream &out)
    {
      out << "| code | failure | what helps | entries below |\n"
             "|---|---|---|---|\n";
      for (int i = 0; abut_failure_at(i) != nullptr; ++i)
      {
        const abut_failure_entry *failure = abut_failure_at(i);
        out << "| " << failure->code << " | " << failure->name << " | "
            << remedy(*failure) << " | ";
        std::string names, avoided;
        for (const AtlasResult &result : results)
          if (result.entry.failure == failure)
            names += (names.empty() ? "" : ", ") + result.entry.name;
          else if (result.entry.avoided == failure)
            avoided += (avoided.empty() ? "" : ", ") + result.entry.name;
        if (!avoided.empty())
          names += (names.empty() ? "avoided: " : "; avoided: ") + avoided;
        out << names;
        out << " |\n";
      }
    }

    void write_messages(const AtlasRun &run,
                        const std::filesystem::path &folder, std::ostream &out)
    {
      const std::string prefix = folder.string() + "/";
      for (std::string message : run.messages)
      {
        const std::size_t place = message.find(prefix);
        if (place != std::string::npos)
          message.erase(place, prefix.size());
        out << "> " << message << "\n>\n";
      }
      if (run.messages.empty())
        out << "> (nothing)\n";
    }

    void write_figures(const AtlasResult &result, std::ostream &out)
    {
      struct Line
      {
        std::string failing, cure; ///< what is expected there
      };
      std::vector<std::pair<std::string, Line>> lines;
      const auto line_of = [&](const std::string &quantity) -> Line &
      {
        const auto found =
            std::find_if(lines.begin(), lines.end(),
                         [&](const auto &l) { return l.first == quantity; });
        if (found != lines.end())
          return found->second;
        lines.push_back({quantity, {}});
        return lines.back().second;
      };
      const auto append = [](std::string &text, const Symptom &symptom)
      {
        text += (text.empty() ? "" : ", ")
                + symptom.text.substr(symptom.quantity.size() + 1);
      };
      for (const Symptom &symptom : result.entry.failing.symptoms)
        append(line_of(symptom.quantity).failing, symptom);
      for (const Symptom &symptom : result.entry.cure.symptoms)
        append(line_of(symptom.quantity).cure, symptom);
      if (lines.empty())
        return;
      const bool fails = result.entry.failure != nullptr;
      out << "\n| measured | " << (fails ? "failing" : "first")
          << " | expected | " << (fails ? "cured" : "second")
          << " | expected |\n|---|---|---|---|---|\n";
      for (const auto &[quantity, line] : lines)
        out << "| `" << quantity << "` | "
            << text_of(result.failing.figures.value(quantity)) << " | "
            << cell(line.failing) << " | "
            << text_of(result.cure.figures.value(quantity)) << " | "
            << cell(line.cure) << " |\n";
    }

    void write_variation(const AtlasResult &result, std::ostream &out)
    {
      const AtlasEntry &entry = result.entry;
      if (entry.values.empty())
        return;
      out << "\n| " << entry.varied;
      for (const std::string &quantity : entry.table)
        out << " | `" << quantity << "` | cured";
      out << " |\n|---";
      for (std::size_t i = 0; i < entry.table.size(); ++i)
        out << "|---|---";
      out << "|\n";
      for (std::size_t i = 0; i < entry.values.size(); ++i)
      {
        out << "| " << entry.values[i];
        for (const std::string &quantity : entry.table)
          out << " | " << text_of(result.varied[i].first.value(quantity))
              << " | " << text_of(result.varied[i].second.value(quantity));
        out << " |\n";
      }
    }

    void write_entry(const AtlasResult &result, std::ostream &out)
    {
      const AtlasEntry &entry = result.entry;
      const bool fails = entry.failure != nullptr;
      const auto folder = entry.failing.file.parent_path();
      out << "\n## "
          << (fails           ? entry.failure->code
              : entry.avoided ? entry.avoided->code + std::string(" avoided")
                              : std::string("No failure"))
          << ": " << entry.title << "\n\n"
          << "Files `" << entry.failing.file.filename().string() << "` and `"
          << entry.cure.file.filename().string() << "`.\n\n"
          << "**Done.** " << entry.failing.text << "\n\n"
          << "**The program said** (exit code " << result.failing.exit_code
          << "):\n\n";
      write_messages(result.failing, folder, out);
      write_figures(result, out);
      write_variation(result, out);
      out << (fails ? "\n**Cure.** " : "\n**Second run.** ") << entry.cure.text
          << " Exit code " << result.cure.exit_code << ".\n";
      if (!result.cure.messages.empty())
      {
        out << "\nIt says:\n\n";
        write_messages(result.cure, folder, out);
      }
      for (const std::string &complaint : result.complaints)
        out << "\n**Not as expected:** " << complaint << "\n";
    }
  } // namespace

  void write_atlas(const std::vector<AtlasResult> &results, std::ostream &out)
  {
    out << R"(# Where methods fail

Written by `abut atlas`; do not edit. Each entry is two scenes of `prm/failures`, one that
fails and one that is cured. Both were run, and what they showed was compared with what
they were expected to show. A warning or an error about a known failure begins with its
code. Exit code 3 means that the answer is unusable, 2 that the input was refused, and 0
with a warning that the answer is as accurate as the settings allow and no more. Where a pair
would be refused, the scene has `Solid/Solve known failures = true`, so that its failure can be measured.
Names of numbers are those of `summary.json` and `levels.csv`. How to add an entry stands at the end.

)";
    write_codes(results, out);
    for (const AtlasResult &result : results)
      write_entry(result, out);
    out << R"(
## A new entry

is two files in a folder that `abut atlas` is given: NAME.prm and NAME.cure.prm, the
second usually with a line `include NAME.prm`. Comments at their beginning say what is
expected, each in one line (`done` and `cure` may go on in more):

| in | comment | |
|---|---|---|
| first | `# failure: ABUT-F06` | code that a warning or an error must name; `none`: no code may be named |
| first | `# avoids: ABUT-F04` | with `none`: the failure that does not occur; may be left out |
| first | `# title: ...`, `# done: ...` | for this page |
| second | `# cure: ...` | for this page |
| both | `# exit: 3` | exit code; 0 if left out |
| both | `# symptom: contact_force < 0.5 * cure` | a number of `summary.json`, or `order(...)` or `growth(...)` of the last two rows of a column of `levels.csv`, or `starts(...)`, how often it leaves 0, or `mean(...)`, `ripple(...)` or `largest(...)` of a column or the ratio of two, within times or not, `ripple(pair_1_force_y,1,2)`; one of < <= = >= >; and a number, `true`, `false`, or the same number of the other run, `cure` |
| first | `# vary: Method/Penalty factor = 1; 10` and `# table: condition, active` | run both files with these values, too, and table these numbers |

The run that fails must say the code, the cured one must not. A failure of a new kind is one
more line of the list in `abut/failure.h`, and a place that notices it.
)";
  }
} // namespace abut::app

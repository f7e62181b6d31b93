// SPDX-License-Identifier: LGPL-2.1-or-later
#include "brief_report.h"

#include "app/input/short_number.h"
#include "report.h"
#include "text_table.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace abut::app
{
  namespace
  {
    /** Lines of a run in all, and those that follow the results. */
    constexpr unsigned int screen = 25, n_last_lines = 4;

    constexpr int digits = 6;

    constexpr const char *axes[] = {"x", "y", "z"};

    /** A figure of the summary and its words. */
    struct Word
    {
      const char *key;
      const char *label;
    };

    /** Of a pair, behind `pair_N_`. */
    constexpr Word pair_words[] = {{"force", "force"},
                                   {"pressure", "largest pressure"},
                                   {"contact_area", "contact area"},
                                   {"penetration", "penetration"},
                                   {"friction_force", "sum of |friction|"},
                                   {"slip", "slip"},
                                   {"impulse", "impulse"}};

    /** Contact of scenes without pairs. */
    constexpr Word contact_words[] = {{"contact_force", "contact force"},
                                      {"max_penetration", "penetration"},
                                      {"active", "points in contact"}};

    /** In the order in which they are dropped from the end. */
    constexpr Word words[] = {
        {"displacement", "displacement"},
        {"velocity", "velocity"},
        {"lambda", "Lagrange multiplier"},
        {"friction_force", "friction force"},
        {"friction_over_normal", "friction force / normal force"},
        {"n_touches", "touches"},
        {"contact_impulse", "contact impulse"},
        {"energy", "energy"},
        {"energy_lost_in_impacts", "energy lost in impacts"},
        {"dissipation", "energy dissipated by friction"},
        {"dissipated", "energy dissipated"},
        {"dissipated_energy", "energy dissipated"},
        {"energy_gain", "part of the energy gained by the scheme"},
        {"energy_loss", "energy lost by the time scheme"},
        {"kinetic_energy", "kinetic energy"},
        {"strain_energy", "strain energy"},
        {"outer_iterations", "outer iterations"},
        {"l2_error", "error of the displacement, L2 norm"},
        {"h1_error", "error of the gradient, L2 norm"},
        {"energy_norm_error", "error in the energy norm"},
        {"relative_estimate", "estimated error / solution, energy norm"},
        {"estimated_error", "estimated relative error"},
        {"target_error", "target of the relative error"},
        {"nodes", "nodes of the secondary surface"},
        {"facets", "facets of the primary surface"},
        {"candidates", "candidate pairs of node and facet"},
        {"contact_elements", "nodes with a partner"},
        {"pairs_with_area", "facet pairs with common area"},
        {"uncovered_area", "area without partner"},
        {"smallest_gap", "smallest gap"},
        {"largest_gap", "largest gap"},
        {"initial_overlaps", "nodes that overlap at the start"},
        {"ns_per_node", "search time per node [ns]"},
        {"bytes_per_facet", "memory per facet [byte]"}};

    /** A number with few digits. */
    std::string in_short(const double value)
    {
      return short_number(value + 0., digits); // 0, not -0
    }

    std::string short_text_of(const Report::Value &value)
    {
      if (const auto *number = std::get_if<double>(&value))
        return std::isfinite(*number) ? in_short(*number) : "";
      if (const auto *count = std::get_if<std::int64_t>(&value))
        return std::to_string(*count);
      std::string text;
      if (const auto *vector = std::get_if<std::vector<double>>(&value))
        for (const double x : *vector)
          text += (text.empty() ? "" : ", ") + in_short(x);
      return text;
    }

    /** "pair 1: " of `pair_1_force`, and the rest of the key; or nothing. */
    std::string split_number(std::string &key, const std::string &what)
    {
      if (key.rfind(what + "_", 0) != 0)
        return "";
      const std::size_t begin = what.size() + 1;
      const std::size_t end = key.find_first_not_of("0123456789", begin);
      if (end == begin || (end != std::string::npos && key[end] != '_'))
        return "";
      const std::string number = key.substr(begin, end - begin);
      key = end == std::string::npos ? "" : key.substr(end + 1);
      return what + " " + number + (key.empty() ? "" : ": ");
    }

    template <std::size_t n>
    const Word *find(const Word (&list)[n], const std::string &key)
    {
      for (const Word &word : list)
        if (key == word.key)
          return &word;
      return nullptr;
    }

    /** The parts of a brief report. */
    class BriefReport
    {
    public:
      BriefReport(std::ostream &out, const Report &report,
                  const unsigned int n_lines)
          : out(out), report(report), n_lines(n_lines)
      {
        while (has(pair_key(n_pairs + 1, "force")))
          ++n_pairs;
      }

      void print_pairs();
      void print_figures();
      void print_verdict() const;

    private:
      static std::string pair_key(const unsigned int pair, const char *word)
      {
        return "pair_" + std::to_string(pair) + "_" + word;
      }

      bool has(const std::string &key) const
      {
        return !short_text_of(report.get(key)).empty();
      }

      /** Of a vector; 0 of other values. */
      std::size_t size_of(const std::string &key) const
      {
        const Report::Value value = report.get(key);
        const auto *vector = std::get_if<std::vector<double>>(&value);
        return vector != nullptr ? vector->size() : 0;
      }

      /** Closed points that stick, of all that are closed. */
      std::string sticking(const unsigned int pair) const
      {
        const auto closed = report.number(pair_key(pair, "active")),
                   slipping = report.number(pair_key(pair, "slipping"));
        return closed && slipping
                   ? in_short(*closed - *slipping) + " of " + in_short(*closed)
                   : "-";
      }

      std::string label_of_pair(const Word &word) const
      {
        // In the plane there are lengths.
        const bool is_width =
            std::string(word.key) == "contact_area"
            && report.number("dimension") == 2.
            && report.get("plane")
                   != Report::Value(std::string("axisymmetric"));
        return is_width ? "contact width" : word.label;
      }

      /** A key of the summary in the words of the field. */
      std::string label_of(std::string key) const;

      unsigned int room() const
      {
        const unsigned int used = n_lines + n_last_lines;
        return used < screen ? screen - used : 0;
      }

      void add_figure(const std::string &key);
      void add_expected(const ExpectedFigure &figure);
      /** The figures of a list; none that has been added. */
      template <std::size_t n> void add_figures(const Word (&list)[n]);

      void print_table(const TextTable &table);

      std::ostream &out;
      const Report &report;
      unsigned int n_lines, n_pairs = 0;
      TextTable figures;
      std::vector<std::string> added;
    };

    std::string BriefReport::label_of(std::string key) const
    {
      std::string component;
      if (const std::size_t bracket = key.find('[');
          bracket != std::string::npos)
      {
        const unsigned long entry =
            std::strtoul(&key[bracket + 1], nullptr, 10);
        // Constraints and masses are no directions.
        const std::string name = key.substr(0, bracket);
        component = entry < 3 && name != "contact_force" && name != "lambda"
                            && name != "displacement"
                        ? std::string(" ") + axes[entry]
                        : ", entry " + std::to_string(entry + 1);
        key.erase(bracket);
      }
      std::string owner;
      for (const char *what : {"pair", "point", "obstacle", "body", "reaction"})
        if (owner.empty())
          owner = split_number(key, what);
      if (owner.rfind("point ", 0) == 0 && key.empty())
        owner += ": displacement";
      std::string text;
      if (const Word *word = find(pair_words, key);
          word != nullptr && owner.rfind("pair ", 0) == 0)
        text = label_of_pair(*word);
      else if (const Word *of_contact = find(contact_words, key))
        text = of_contact->label;
      else if (key == "energy" && report.number("kinetic_energy"))
        text = "kinetic, strain and contact energy";
      else if (const Word *other = find(words, key))
        text = other->label;
      else
      {
        std::replace(key.begin(), key.end(), '_', ' ');
        text = key;
      }
      return owner + text + component;
    }

    void BriefReport::print_table(const TextTable &table)
    {
      out << "\n";
      table.print(out);
      n_lines += 1 + static_cast<unsigned int>(table.size());
    }

    void BriefReport::print_pairs()
    {
      if (n_pairs == 0)
        return;
      std::vector<std::string> head = {
          report.number("load_steps").value_or(0.) > 1.
              ? "contact at time "
                    + in_short(report.number("time").value_or(0.))
              : "contact"};
      std::vector<std::string> keys;
      for (const Word &word : pair_words)
      {
        unsigned int pair = 1;
        while (pair <= n_pairs && !has(pair_key(pair, word.key)))
          ++pair;
        const std::string key = word.key;
        const std::size_t n_components = size_of(pair_key(pair, word.key));
        for (std::size_t d = 0; d < n_components; ++d)
        {
          keys.push_back(key + "[" + std::to_string(d) + "]");
          head.push_back(label_of_pair(word) + " " + axes[d]);
        }
        if (n_components == 0 && pair <= n_pairs)
        {
          keys.push_back(key);
          head.push_back(label_of_pair(word));
        }
        if (key == "friction_force" && pair <= n_pairs)
        {
          keys.push_back("slipping");
          head.push_back("sticking points");
        }
      }
      TextTable table;
      table.add(head);
      const unsigned int n_shown =
          std::max(1u, std::min(n_pairs, room() > 6 ? room() - 6 : 1));
      for (unsigned int pair = 1; pair <= n_shown; ++pair)
      {
        const Report::Value sides = report.get(pair_key(pair, "sides"));
        const auto *text = std::get_if<std::string>(&sides);
        std::vector<std::string> row = {
            std::to_string(pair) + (text != nullptr ? ": " + *text : "")};
        for (const std::string &key : keys)
        {
          const auto value = report.number(pair_key(pair, key.c_str()));
          row.push_back(key == "slipping" ? sticking(pair)
                        : value           ? in_short(*value)
                                          : "-");
        }
        table.add(row);
      }
      print_table(table);
      if (n_shown < n_pairs)
      {
        out << "  and " << n_pairs - n_shown << " more pairs in summary.json\n";
        ++n_lines;
      }
    }

    void BriefReport::add_expected(const ExpectedFigure &figure)
    {
      const auto value = report.number(figure.key);
      if (!value)
        return;
      const double off = *value - figure.value;
      figures.add(
          {label_of(figure.key), in_short(*value), in_short(figure.value),
           figure.value == 0. ? "difference " + short_number(off, 2)
                              : short_number(std::abs(off / figure.value), 2)});
      added.push_back(figure.key.substr(0, figure.key.find('[')));
    }

    void BriefReport::add_figure(const std::string &key)
    {
      std::string text = short_text_of(report.get(key));
      if (text.empty()
          || std::find(added.begin(), added.end(), key) != added.end())
        return;
      added.push_back(key);
      // Of many entries there are files.
      const Report::Value value = report.get(key);
      if (const auto *vector = std::get_if<std::vector<double>>(&value);
          vector != nullptr && vector->size() > 3)
        return;
      if (key == "active" && report.number("constraints") == 0.)
        return;
      if (key == "energy_lost_in_impacts" && report.number(key) == 0.)
        return;
      if (key == "active")
        text += " of " + short_text_of(report.get("constraints"));
      figures.add({label_of(key), text});
    }

    template <std::size_t n>
    void BriefReport::add_figures(const Word (&list)[n])
    {
      for (const Word &word : list)
        add_figure(word.key);
    }

    void BriefReport::print_figures()
    {
      figures.add({"", "result", "expected", "relative error"});
      for (const ExpectedFigure &figure : report.expected_figures())
        add_expected(figure);
      if (figures.size() == 1)
        figures = TextTable();
      if (n_pairs == 0)
        add_figures(contact_words);
      for (const char *what : {"obstacle_", "point_"})
        for (unsigned int i = 1; i <= 3; ++i)
          for (const char *end : {"_displacement", ""})
            add_figure(what + std::to_string(i) + end);
      add_figures(words);
      const unsigned int most = std::max(4u, room()) - 1; // and a blank one
      const std::size_t n_dropped =
          figures.size() > most ? figures.size() - most + 1 : 0;
      figures.keep(figures.size() - n_dropped);
      if (figures.size() == 0)
        return;
      print_table(figures);
      if (n_dropped > 0)
        out << "  and " << n_dropped << " more (--verbose)\n";
    }

    void BriefReport::print_verdict() const
    {
      const Report::Value converged = report.get("converged");
      const auto *is_solved = std::get_if<bool>(&converged);
      if (is_solved == nullptr)
        return;
      out << "\n  "
          << (*is_solved ? "solved" : "NO ANSWER TO RELY ON (exit code 3)");
      std::string checks;
      const auto add = [&](const std::string &text)
      { checks += (checks.empty() ? "" : ", ") + text; };
      if (const auto value = report.number("imbalance"))
        add("imbalance of forces / contact force " + short_number(*value, 2));
      else if (const auto other = report.number("force_imbalance"))
        add("action and reaction differ by " + short_number(*other, 2));
      if (const auto value = report.number("work_error"))
        add("error of the work " + short_number(*value, 2));
      if (report.n_examined() > 0)
        add(std::to_string(report.n_examined()) + " checks");
      if (const auto n = report.n_warnings())
        add(std::to_string(n) + (n == 1 ? " warning" : " warnings") + " above");
      else
        add("no warnings");
      out << ": " << checks << "\n";
    }
  } // namespace

  void print_brief(std::ostream &out, const Report &report,
                   const unsigned int n_lines)
  {
    BriefReport brief(out, report, n_lines);
    brief.print_pairs();
    brief.print_figures();
    brief.print_verdict();
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "atlas_entry.h"

#include "app/input/input_error.h"

#include <abut/dealii/nearest_word.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>

namespace abut::app
{
  namespace
  {
    namespace Utilities = dealii::Utilities;

    const std::string cure_ending = ".cure.prm";

    /** Comments `# word: text` of a scene file, in order. */
    class Remarks
    {
    public:
      Remarks(const std::filesystem::path &file,
              const std::vector<std::string> &words)
          : file(file)
      {
        std::ifstream in(file);
        if (!in)
          throw InputError("", "cannot read '" + file.string() + "'.");
        const std::regex form("#\\s*([a-z]+):\\s*(.*)");
        std::string line;
        std::smatch found;
        while (std::getline(in, line))
          if (line = Utilities::trim(line); std::regex_match(line, found, form))
          {
            const std::string word = found[1];
            if (std::find(words.begin(), words.end(), word) != words.end())
              lines[word].push_back(found[2]);
            else if (const std::string advice = did_you_mean(word, words);
                     !advice.empty())
              complain("'# " + word + ":' is not known." + advice);
          }
      }

      /** All lines of a word as one text. */
      std::string text(const std::string &word) const
      {
        std::string all;
        for (const std::string &line : list(word))
          all += (all.empty() ? "" : " ") + line;
        return all;
      }

      /** The same, which must be there. */
      std::string needed(const std::string &word) const
      {
        const std::string found = text(word);
        if (found.empty())
          complain("a line '# " + word + ": ...' is missing.");
        return found;
      }

      std::vector<std::string> list(const std::string &word) const
      {
        const auto found = lines.find(word);
        return found == lines.end() ? std::vector<std::string>()
                                    : found->second;
      }

      [[noreturn]] void complain(const std::string &what) const
      {
        throw InputError("", file.string() + ": " + what);
      }

    private:
      const std::filesystem::path file;
      std::map<std::string, std::vector<std::string>> lines;
    };

    bool read_number(const std::string &text, double &number)
    {
      char *end = nullptr;
      number = std::strtod(text.c_str(), &end);
      return !text.empty() && *end == '\0' && std::isfinite(number);
    }

    AtlasScene read_scene(const std::filesystem::path &file,
                          const Remarks &remarks, const std::string &text)
    {
      AtlasScene scene;
      scene.file = file;
      scene.text = remarks.needed(text);
      double code = 0.;
      if (const std::string exit = remarks.text("exit");
          !exit.empty() && !read_number(exit, code))
        remarks.complain("'# exit: " + exit + "' is not a number.");
      scene.exit_code = static_cast<int>(code);
      for (const std::string &line : remarks.list("symptom"))
        try
        {
          scene.symptoms.push_back(Symptom::parse(line));
        }
        catch (const InputError &error)
        {
          remarks.complain(error.what());
        }
      return scene;
    }

    /** The failure of a code; null for `none`. */
    const abut_failure_entry *find_failure(const Remarks &remarks,
                                           const std::string &code)
    {
      if (code == "none")
        return nullptr;
      for (int i = 0; abut_failure_at(i) != nullptr; ++i)
        if (abut_failure_at(i)->code == code)
          return abut_failure_at(i);
      remarks.complain("there is no failure '" + code + "'.");
    }

    void read_variation(const Remarks &remarks, AtlasEntry &entry)
    {
      const std::string vary = remarks.text("vary");
      if (vary.empty())
        return;
      const std::size_t sign = vary.find('=');
      if (sign == std::string::npos)
        remarks.complain("write '# vary: Section/Name = value; value'.");
      entry.varied = Utilities::trim(vary.substr(0, sign));
      entry.values = Utilities::split_string_list(vary.substr(sign + 1), ';');
      entry.table = Utilities::split_string_list(remarks.needed("table"), ',');
    }

    AtlasEntry read_entry(const std::filesystem::path &file)
    {
      AtlasEntry entry;
      entry.name = file.stem().string();
      const Remarks failing(file, {"failure", "avoids", "title", "done", "exit",
                                   "symptom", "vary", "table"});
      entry.failure = find_failure(failing, failing.needed("failure"));
      if (const std::string code = failing.text("avoids"); !code.empty())
        entry.avoided = find_failure(failing, code);
      if (entry.failure != nullptr && entry.avoided != nullptr)
        failing.complain("'# avoids:' needs '# failure: none'.");
      entry.title = failing.needed("title");
      entry.failing = read_scene(file, failing, "done");
      read_variation(failing, entry);
      const auto other = file.parent_path() / (entry.name + cure_ending);
      const Remarks cure(other, {"cure", "exit", "symptom"});
      entry.cure = read_scene(other, cure, "cure");
      return entry;
    }

    bool ends_with(const std::string &text, const std::string &ending)
    {
      return text.size() >= ending.size()
             && text.compare(text.size() - ending.size(), ending.size(), ending)
                    == 0;
    }
  } // namespace

  Symptom Symptom::parse(const std::string &text)
  {
    const std::regex form("(\\S+)\\s+(<=|>=|<|>|=)\\s+(.+)");
    const std::regex of_cure("(?:(\\S+)\\s*\\*\\s*)?cure");
    Symptom symptom;
    symptom.text = text;
    std::smatch parts, right;
    bool legal = std::regex_match(text, parts, form);
    if (legal)
    {
      symptom.quantity = parts[1];
      symptom.relation = parts[2];
      const std::string rest = Utilities::trim(parts[3]);
      symptom.of_cure = std::regex_match(rest, right, of_cure);
      if (rest == "true" || rest == "false")
        symptom.factor = rest == "true" ? 1. : 0.;
      else if (symptom.of_cure)
        legal = !right[1].matched || read_number(right[1], symptom.factor);
      else
        legal = read_number(rest, symptom.factor);
    }
    if (!legal)
      throw InputError("", "'# symptom: " + text
                               + "': write NAME < NUMBER, or NAME < NUMBER * "
                                 "cure, with one of < <= = >= >.");
    return symptom;
  }

  bool Symptom::holds(const RunFigures &run, const RunFigures &cure) const
  {
    const std::optional<double> left = run.value(quantity);
    const std::optional<double> of = cure.value(quantity);
    if (!left || (of_cure && !of))
      return false;
    const double right = of_cure ? factor * *of : factor;
    const double noise = 1e-9 * std::abs(right);
    if (relation == "<")
      return *left < right;
    if (relation == "<=")
      return *left <= right + noise;
    if (relation == ">")
      return *left > right;
    if (relation == ">=")
      return *left >= right - noise;
    return std::abs(*left - right) <= noise;
  }

  std::vector<AtlasEntry> read_atlas(const std::filesystem::path &path)
  {
    namespace fs = std::filesystem;
    if (!fs::exists(path))
      throw InputError("", "there is no '" + path.string() + "'.");
    std::vector<AtlasEntry> entries;
    if (!fs::is_directory(path))
      entries.push_back(read_entry(path));
    else
      for (const auto &item : fs::directory_iterator(path))
        if (const std::string name = item.path().filename().string();
            ends_with(name, cure_ending))
          entries.push_back(read_entry(
              path
              / (name.substr(0, name.size() - cure_ending.size()) + ".prm")));
    if (entries.empty())
      throw InputError("", "no file NAME" + cure_ending + " in '"
                               + path.string() + "'.");
    const auto key = [](const AtlasEntry &entry)
    {
      return std::make_pair(entry.failure ? int(entry.failure->failure) : 1000,
                            entry.name);
    };
    std::sort(entries.begin(), entries.end(),
              [&](const AtlasEntry &a, const AtlasEntry &b)
              { return key(a) < key(b); });
    return entries;
  }
} // namespace abut::app

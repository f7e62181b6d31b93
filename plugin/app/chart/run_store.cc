// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_store.h"

#include "app/input/input_error.h"
#include "app/input/output_folder.h"
#include "app/report/json.h"
#include "shim/fnv_hash.h"

#include <boost/property_tree/json_parser.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace abut::app
{
  namespace fs = std::filesystem;

  std::uint64_t hash(const std::string &bytes)
  {
    shim::FnvHash result;
    for (const char c : bytes)
      result.mix(static_cast<unsigned char>(c));
    return result.value;
  }

  std::string file_bytes(const fs::path &file)
  {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    if (!in)
      throw std::runtime_error("cannot read " + file.string());
    return out.str();
  }

  void write_at_once(const fs::path &file, const std::string &text)
  {
    const fs::path part = file.string() + ".part";
    std::ofstream out(part, std::ios::binary);
    out << text;
    out.close();
    if (!out)
      throw std::runtime_error("cannot write " + part.string());
    fs::rename(part, file);
  }

  RunStore::RunStore(const fs::path &chart_folder)
      : folder(chart_folder / "runs"), lock(-1)
  {
    make_output_folder(folder);
    lock = open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock < 0 || flock(lock, LOCK_EX | LOCK_NB) != 0)
    {
      if (lock >= 0)
        close(lock);
      throw InputError("", "another 'abut chart' works in '"
                               + chart_folder.string()
                               + "'. Choose another folder with --output DIR.");
    }
    std::vector<fs::path> remains;
    for (const auto &entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".part")
        remains.push_back(entry.path());
    for (const fs::path &path : remains)
      fs::remove_all(path);
  }

  RunStore::~RunStore()
  {
    close(lock);
  }

  std::string RunStore::key(const std::string &setting)
  {
    char text[17];
    std::snprintf(text, sizeof(text), "%016llx",
                  static_cast<unsigned long long>(hash(setting)));
    return text;
  }

  fs::path RunStore::place(const std::string &setting,
                           const unsigned int repeat) const
  {
    return folder / (key(setting) + "-" + std::to_string(repeat));
  }

  std::optional<RunRecord> RunStore::find(const std::string &setting,
                                          const unsigned int repeat,
                                          const double limit) const
  {
    const fs::path here = place(setting, repeat);
    boost::property_tree::ptree tree;
    try
    {
      boost::property_tree::read_json((here / "run.json").string(), tree);
    }
    catch (const boost::property_tree::json_parser_error &)
    {
      return std::nullopt;
    }
    RunRecord record;
    record.setting = tree.get<std::string>("setting", "");
    record.ended = tree.get<std::string>("ended", "");
    record.reason = tree.get<std::string>("reason", "");
    record.limit = tree.get<double>("limit", 0.);
    record.seconds = tree.get<double>("seconds", 0.);
    record.code = tree.get<int>("code", 0);
    // One ended by a signal was not finished.
    if (record.setting != setting || record.code < 0
        || (record.ended == "out of time" && record.limit < limit))
      return std::nullopt;
    record.figures = RunFigures(here);
    return record;
  }

  fs::path RunStore::begin(const std::string &setting,
                           const unsigned int repeat) const
  {
    const fs::path part = place(setting, repeat).string() + ".part";
    fs::remove_all(part);
    fs::create_directory(part);
    return part;
  }

  void RunStore::finish(const RunRecord &record,
                        const unsigned int repeat) const
  {
    const fs::path here = place(record.setting, repeat);
    const fs::path part = here.string() + ".part";
    std::ostringstream text;
    JsonWriter json(text);
    json.begin();
    json.value("ended", record.ended);
    json.value("code", std::int64_t(record.code));
    json.value("reason", record.reason);
    json.value("limit", record.limit);
    json.value("seconds", record.seconds);
    json.value("setting", record.setting);
    json.end();
    write_at_once(part / "run.json", text.str());
    // What stood here was short of time.
    fs::remove_all(here);
    fs::rename(part, here);
  }
} // namespace abut::app

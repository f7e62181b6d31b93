// SPDX-License-Identifier: LGPL-2.1-or-later
// All parameters of a scene, one after the other, at the ends of their legal
// range, just outside, and with what is no value at all: each run must solve,
// refuse the value, or say that there is no answer, within seconds. What
// escapes as another exception, crashes or does not end is a fault, and so is a
// decimal comma in a formula or a number that is not refused.
//
// walk_parameters FOLDER SCENE [EVERY]
//
// With a number, one value out of so many.
#include "app/command/program.h"
#include "app/scenes/common_parameters.h"

#include <deal.II/base/mpi.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <unistd.h>

namespace
{
  using namespace abut::app;

  /** Seconds for one run, which takes some hundredths. */
  constexpr unsigned int limit = 60;

  /** What runs now, for the handler of signals. */
  char present[1000];

  extern "C" void say_and_end(const int signal)
  {
    const char *what =
        signal == SIGALRM ? "FAILED, no end: " : "FAILED, crashed: ";
    for (const char *text : {what, static_cast<const char *>(present), "\n"})
    {
      std::size_t n = 0;
      while (text[n] != '\0')
        ++n;
      if (write(2, text, n) < 0)
        break;
    }
    _exit(1);
  }

  std::vector<DeclaredParameter> parameters_of(const std::string &scene_file)
  {
    const ParameterFile file(scene_file, {});
    const SceneKind &kind = scene_kind(file);
    const auto scene = kind.create(scene_dimension(file, kind));
    scene->count(file);
    dealii::ParameterHandler prm;
    declare_all(prm, kind, *scene);
    return declared_parameters(prm);
  }

  /** The number after @p word in @p text. */
  bool number_after(const std::string &text, const std::string &word,
                    double &number)
  {
    const std::size_t at = text.find(" " + word + " ");
    return at != std::string::npos
           && (std::istringstream(text.substr(at + word.size() + 2)) >> number);
  }

  std::string text_of(const double number)
  {
    std::ostringstream text;
    text.precision(17);
    text << number;
    return text.str();
  }

  /** Both sides of an end of a range, and the end. */
  void add_end(const double end, std::vector<std::string> &values)
  {
    const double step = end == 0. ? 1e-12 : 1e-12 * std::abs(end);
    for (const double value : {end - step, end, end + step})
      values.push_back(text_of(value));
  }

  std::vector<std::string> values_of_number(const std::string &range)
  {
    std::vector<std::string> values = {"1e-200", "1e200", "-1e200",
                                       "0",      "1e-3",  "1e3"};
    double end;
    for (const char *word : {"from", "above", "at least"})
      if (number_after(range, word, end))
        add_end(end, values);
    for (const char *word : {"to", "below", "at most"})
      if (number_after(range, word, end))
        add_end(end, values);
    return values;
  }

  std::vector<std::string> values_of_count(const std::string &range)
  {
    std::vector<std::string> values = {"1.5", "-1", "0", "1", "2"};
    double end;
    for (const char *word : {"from", "at least", "to", "at most"})
      if (number_after(range, word, end))
        for (const double value : {end - 1., end, end + 1.})
          values.push_back(text_of(value));
    return values;
  }

  std::vector<std::string> values_of(const DeclaredParameter &parameter)
  {
    std::vector<std::string> values;
    const std::string &range = parameter.pattern;
    if (!parameter.choices.empty())
      values = parameter.choices;
    else if (range == "true or false")
      values = {"true", "false"};
    else if (range.rfind("a whole number", 0) == 0)
      values = values_of_count(range);
    else if (range.rfind("a number", 0) == 0)
      values = values_of_number(range);
    else
      values = {"0",       "1",          "-1",       "1e200",    "1e400",
                "x",       "t",          "1/0",      "sqrt(-1)", "1, 2",
                "1, 2, 3", "0; 1",       "*: 1",     "1: 1",     "9: 1",
                "1: 1, 1", "2: 1, 1, 1", "nowhere",  ":",        ";",
                ",",       "*",          "1e200, 0", "1: 1e200", "2: 9"};
    for (const char *none : {"", "nan", "inf", "-inf", "nonsense"})
      values.emplace_back(none);
    return values;
  }

  /** Values with decimal commas, each of which must be refused. */
  std::vector<std::string> decimal_commas(const DeclaredParameter &parameter)
  {
    const std::string &kind = parameter.pattern;
    if (kind == "a formula" || kind.rfind("a number", 0) == 0)
      return {"0,3", "-1,25e-1"};
    if (kind == "a vector of formulas")
      return {"0,5, 0,5, 0,5", "0; 0,5; 0"};
    if (kind == "a formula by boundary id")
      return {"*: 0,5", "1: x > 0,5"};
    if (kind == "a vector of formulas by boundary id")
      return {"*: 0,5, 0,5"};
    return {};
  }

  /** The exit code of the program, as its main function has it. */
  int exit_code(const std::vector<std::string> &words, std::string &error)
  {
    try
    {
      return static_cast<int>(run_program(MPI_COMM_WORLD, words));
    }
    catch (const InputError &wrong)
    {
      error = wrong.what();
      return 2;
    }
    catch (const std::exception &fault)
    {
      error = fault.what();
      return 1;
    }
  }

  /** Swallows what the program prints. */
  class Silence
  {
  public:
    Silence()
        : out(std::cout.rdbuf(sink.rdbuf())), err(std::cerr.rdbuf(sink.rdbuf()))
    {
    }
    ~Silence()
    {
      std::cout.rdbuf(out);
      std::cerr.rdbuf(err);
    }

  private:
    std::ostringstream sink;
    std::streambuf *out, *err;
  };

  /** Whether values of more than a digit may be legal and only take long. */
  bool is_work(const std::string &path)
  {
    for (const char *name :
         {"Time stepping/Number of steps", "Refinement/Adaptive cycles",
          "Refinement/Relaxation sweeps", "Solver/Smoother sweeps",
          "Output/Linear solves for comparison", "Sweep/Repeats",
          "Time stepping/Step size", "Time stepping/End time",
          "Refinement/Maximum meshes", "Refinement/Target error"})
      if (path == name)
        return true;
    return false;
  }

  /** @param must_refuse whether 2 is the only good exit code */
  bool is_good(const std::string &scene, const std::filesystem::path &folder,
               const std::string &path, const std::string &value,
               const bool must_refuse)
  {
    const bool checks = is_work(path) && value.size() > 1;
    const std::string setting = path + "=" + value;
    const std::vector<std::string> words = {
        checks ? "check" : "run", scene,   "--quiet", "--output",
        folder.string(),          "--set", setting};
    std::snprintf(present, sizeof present, "%s --set \"%s\"", scene.c_str(),
                  setting.c_str());
    if (std::getenv("WALK_VERBOSE") != nullptr)
      std::cerr << present << std::endl;
    std::string error;
    int code;
    {
      const Silence silence;
      alarm(limit);
      code = exit_code(words, error);
      alarm(0);
    }
    const bool is_allowed =
        code == 2 || (!must_refuse && (code == 0 || code == 3));
    if (!is_allowed)
      std::cerr << "FAILED, code " << code << ": " << present << ": " << error
                << std::endl;
    // One line that says what is wrong.
    const bool is_one_line =
        error.find('\n') == std::string::npos && (code != 2 || !error.empty());
    if (!is_one_line)
      std::cerr << "FAILED, not one line: " << present << ": " << error
                << std::endl;
    return is_allowed && is_one_line;
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 3 && argc != 4)
    return 1;
  const std::filesystem::path folder = argv[1];
  const std::string scene = argv[2];
  const unsigned long every = argc == 4 ? std::stoul(argv[3]) : 1;
  for (const int signal : {SIGALRM, SIGSEGV, SIGFPE, SIGABRT, SIGBUS})
    std::signal(signal, say_and_end);
  unsigned long n = 0, n_bad = 0, n_seen = 0;
  for (const DeclaredParameter &parameter : parameters_of(scene))
    for (const std::string &value : values_of(parameter))
    {
      // Pictures take a process each and are tried elsewhere.
      if (parameter.path == "Output/Pictures" && value == "true")
        continue;
      if (n_seen++ % every != 0)
        continue;
      ++n;
      n_bad += is_good(scene, folder, parameter.path, value, false) ? 0 : 1;
    }
  // All of them: what is refused takes no time.
  for (const DeclaredParameter &parameter : parameters_of(scene))
    for (const std::string &value : decimal_commas(parameter))
    {
      ++n;
      n_bad += is_good(scene, folder, parameter.path, value, true) ? 0 : 1;
    }
  std::cout << n << " values, " << n_bad << " answered wrongly" << std::endl;
  return n_bad > 0 || n_seen < 100;
}

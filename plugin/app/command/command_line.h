// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_COMMAND_LINE_H
#define ABUT_APP_COMMAND_LINE_H

#include <string>
#include <vector>

namespace abut::app
{
  /** What the user asked for. */
  struct CommandLine
  {
    enum class Command
    {
      run,
      check,
      new_scene,
      search,
      tool, /**< a program in Python, see tools.h */
      parameters,
      serve, /**< before MPI begins, see serve.h */
      version,
      help
    };

    Command command = Command::help;
    std::string file;  /**< of the scene */
    std::string topic; /**< of `abut help TOPIC`; kind of `abut new` */
    std::vector<std::string> words;     /**< all of them */
    std::vector<std::string> overrides; /**< of `--set` */
    std::vector<std::string> offers;    /**< of `--set-if-used` */
    std::string output;                 /**< empty: output/<name of the file> */
    std::string sketch;                 /**< file of `check --draw` */
    std::string kind, level;            /**< of `abut parameters`; empty: all */
    bool quiet = false;
    bool verbose = false; /**< print all figures with their keys */
    bool resume = false;  /**< go on from the latest checkpoint */
    bool explain = false; /**< say what could be left out */
    bool values = false;  /**< print values of parameters */
  };

  /** Read the words after the program's name; throws InputError. */
  CommandLine parse_command_line(const std::vector<std::string> &words);

  /** Text of `abut help TOPIC`; "" is `abut --help`. Throws InputError for a
   * topic that does not exist. */
  std::string help_text(const std::string &topic);
} // namespace abut::app

#endif

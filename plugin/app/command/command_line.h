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
      search,
      chart,
      atlas,
      tool, /**< a program in Python, see tools.h */
      parameters,
      version,
      help
    };

    Command command = Command::help;
    std::string file;  /**< of the scene or the chart; folder of the atlas */
    std::string topic; /**< of `abut help TOPIC` */
    std::vector<std::string> words;     /**< all of them */
    std::vector<std::string> overrides; /**< of `--set` */
    std::vector<std::string> offers;    /**< of `--set-if-used` */
    std::string output;                 /**< empty: output/<name of the file> */
    std::string report; /**< page of the atlas; empty: in its output */
    bool quiet = false;
    bool resume = false;  /**< go on from the latest checkpoint */
    bool explain = false; /**< say what could be left out */
    bool plan = false;    /**< of a chart: stop before the first run */
  };

  /** Read the words after the program's name; throws InputError. */
  CommandLine parse_command_line(const std::vector<std::string> &words);

  /** Text of `abut help TOPIC`; "" is `abut --help`. Throws InputError for a
   * topic that does not exist. */
  std::string help_text(const std::string &topic);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools.h"

#include "app/process/child_process.h"
#include "app/restart/disk.h"

#include <cstdlib>
#include <iostream>
#include <sstream>

namespace abut::app
{
  namespace
  {
    namespace fs = std::filesystem;

    /** Exit code of the tools where Python lacks packages. */
    constexpr int lacks_packages = 120;

    /** `share/abut/tools` of the nearest folder above the program: of a build,
     * and of an installed tree. */
    fs::path tools_folder()
    {
      const fs::path program = fs::read_symlink("/proc/self/exe");
      for (fs::path folder = program.parent_path();;
           folder = folder.parent_path())
      {
        const fs::path tools = folder / "share/abut/tools/abut_tools";
        if (fs::exists(tools))
          return tools;
        if (folder == folder.root_path())
          throw InputError("", "the folder share/abut/tools was not found "
                               "next to "
                                   + program.string()
                                   + ": install the program again.");
      }
    }

    /** Start a tool with the first Python that has the packages. */
    ChildResult start(const std::vector<std::string> &words,
                      const fs::path &log)
    {
      const char *const named = std::getenv("ABUT_PYTHON");
      const std::vector<std::string> candidates =
          named != nullptr && named[0] != 0
              ? std::vector<std::string>{named}
              : std::vector<std::string>{"python3", "/usr/bin/python3"};
      // Of its environment a tool learns which program has started it.
      const std::string program = fs::read_symlink("/proc/self/exe").string();
      setenv("ABUT_PROGRAM", program.c_str(), 1);
      for (const std::string &python : candidates)
      {
        // No compiled files, which would stay behind a package.
        std::vector<std::string> command = {python, "-B",
                                            tools_folder().string()};
        command.insert(command.end(), words.begin(), words.end());
        const ChildResult result = run_child(command, log);
        if (result.ended != ChildResult::Ended::not_found
            && !(result.ended == ChildResult::Ended::exited
                 && result.code == lacks_packages))
          return result;
      }
      throw InputError("", "'abut " + words.at(0)
                               + "' needs Python 3 with NumPy and "
                                 "Matplotlib; "
                               + (candidates.size() == 1
                                      ? "ABUT_PYTHON = '" + candidates[0] + "'"
                                      : std::string("python3"))
                               + " does not have them. On Debian: apt install "
                                 "python3-numpy python3-matplotlib");
    }

    std::string without(std::string text, const std::string &beginning)
    {
      if (text.compare(0, beginning.size(), beginning) == 0)
        text.erase(0, beginning.size());
      return text;
    }
  } // namespace

  ExitCode run_tool(const std::vector<std::string> &words)
  {
    std::cout << std::flush;
    const ChildResult result = start(words, {});
    return result.ended == ChildResult::Ended::exited
               ? static_cast<ExitCode>(result.code)
               : ExitCode::internal_error;
  }

  std::vector<std::string> read_run(const std::string &tool,
                                    const fs::path &folder)
  {
    const fs::path log = folder / (tool + ".log");
    try
    {
      const bool well = start({tool, folder.string(), "--quiet"}, log).well();
      std::istringstream said(read_from_disk(log));
      std::vector<std::string> warnings;
      std::string last;
      for (std::string line; std::getline(said, line); last = line)
        warnings.push_back(without(line, "abut: warning: "));
      if (!well)
        return {"abut " + tool + ": " + without(last, "abut: error: ")
                + " (see " + log.string() + ")"};
      fs::remove(log);
      return warnings;
    }
    catch (const std::exception &error)
    {
      return {error.what()};
    }
  }
} // namespace abut::app

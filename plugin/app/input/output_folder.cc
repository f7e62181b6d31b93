// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_folder.h"

#include "input_error.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <unistd.h>

namespace abut::app
{
  void check_output_folder(const std::filesystem::path &folder)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::path there = fs::absolute(folder, error);
    while (!fs::exists(there, error) && there.has_relative_path())
      there = there.parent_path();
    if (!fs::is_directory(there, error) || access(there.c_str(), W_OK) != 0)
      throw InputError("", "cannot make the output folder '" + folder.string()
                               + "': '" + there.string()
                               + "' is not a writable folder. Choose another "
                                 "one with --output DIR.");
  }

  void make_output_folder(const std::filesystem::path &folder)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
      throw InputError("", "cannot make the output folder '" + folder.string()
                               + "'" + (error ? ": " + error.message() : "")
                               + ". Choose another one with --output DIR.");
    const fs::path probe = folder / ".abut-can-write";
    errno = 0;
    const bool writable =
        static_cast<bool>(std::ofstream(probe) << "x" << std::flush);
    const std::string reason =
        errno != 0 ? std::string(": ") + std::strerror(errno) : "";
    fs::remove(probe, error);
    if (!writable)
      throw InputError("", "cannot write into the output folder '"
                               + folder.string() + "'" + reason
                               + ". Choose another one with --output DIR.");
  }
} // namespace abut::app

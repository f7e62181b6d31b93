// SPDX-License-Identifier: LGPL-2.1-or-later
#include "disk.h"

#include <boost/crc.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace abut::app
{
  namespace
  {
    [[noreturn]] void fail(const std::filesystem::path &path,
                           const std::string &what)
    {
      const std::string reason = errno != 0 ? std::strerror(errno) : "";
      throw std::runtime_error("'" + path.string() + "' cannot be " + what
                               + (reason.empty() ? "" : ": " + reason));
    }
  } // namespace

  void sync(const std::filesystem::path &path)
  {
    const int file = open(path.c_str(), O_RDONLY);
    if (file < 0)
      fail(path, "opened");
    // Some file systems have no such call for folders.
    const bool synced = fsync(file) == 0 || errno == EINVAL;
    close(file);
    if (!synced)
      fail(path, "brought to the disk");
  }

  void write_to_disk(const std::filesystem::path &file,
                     const std::string &bytes)
  {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out)
      fail(file, "written");
    sync(file);
  }

  void replace_on_disk(const std::filesystem::path &file,
                       const std::string &bytes)
  {
    std::filesystem::path next = file;
    next += ".new";
    write_to_disk(next, bytes);
    std::filesystem::rename(next, file);
    sync(file.has_parent_path() ? file.parent_path() : ".");
  }

  std::string checksum(const std::string &bytes)
  {
    boost::crc_32_type crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return std::to_string(crc.checksum()) + " " + std::to_string(bytes.size());
  }

  std::string read_from_disk(const std::filesystem::path &file)
  {
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    // An empty file sets no bit of the stream but that of the output.
    if (!in)
      fail(file, "read");
    return bytes.str();
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "disk.h"

#include "app/input/input_error.h"

#include <boost/crc.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace abut::app
{
  namespace
  {
    [[noreturn]] void fail_to_write(const std::filesystem::path &path,
                                    const std::string &reason)
    {
      throw InputError("", "cannot write '" + path.string() + "'"
                               + (reason.empty() ? "" : ": " + reason)
                               + ". Make room, or choose another folder with "
                                 "--output DIR.");
    }

    std::string reason_of(const int error)
    {
      return error != 0 ? std::strerror(error) : "";
    }
  } // namespace

  void sync(const std::filesystem::path &path)
  {
    const int file = open(path.c_str(), O_RDONLY);
    if (file < 0)
      fail_to_write(path, reason_of(errno));
    // Some file systems have no such call for folders.
    const int error = fsync(file) == 0 || errno == EINVAL ? 0 : errno;
    close(file);
    if (error != 0)
      fail_to_write(path, reason_of(error));
  }

  void write_file(const std::filesystem::path &file, const std::string &bytes,
                  const bool append)
  {
    errno = 0;
    std::ofstream out(file, append ? std::ios::binary | std::ios::app
                                   : std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out)
      fail_to_write(file, reason_of(errno));
  }

  void require_room(const std::filesystem::path &folder,
                    const std::size_t bytes)
  {
    const std::filesystem::path name = folder / "room";
    const int file = open(name.c_str(), O_WRONLY | O_CREAT, 0666);
    if (file < 0)
      fail_to_write(name, reason_of(errno));
    const int error = posix_fallocate(file, 0, static_cast<off_t>(bytes));
    close(file);
    std::error_code ignored;
    std::filesystem::remove(name, ignored);
    // Some file systems have no such call.
    if (error != 0 && error != EINVAL && error != EOPNOTSUPP)
      fail_to_write(name, reason_of(error));
  }

  void write_to_disk(const std::filesystem::path &file,
                     const std::string &bytes)
  {
    write_file(file, bytes);
    sync(file);
  }

  void replace_on_disk(const std::filesystem::path &file,
                       const std::string &bytes)
  {
    std::filesystem::path next = file;
    next += ".new";
    write_to_disk(next, bytes);
    std::error_code error;
    std::filesystem::rename(next, file, error);
    if (error)
      fail_to_write(file, error.message());
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
      throw InputError("", "cannot read '" + file.string() + "'"
                               + (errno != 0 ? ": " + reason_of(errno) : "")
                               + ".");
    return bytes.str();
  }
} // namespace abut::app

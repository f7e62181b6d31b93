// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_DISK_H
#define ABUT_APP_DISK_H

/** @file
 * Files that are on the disk when the functions return. All throw
 * std::runtime_error; none is collective.
 */

#include <filesystem>
#include <string>

namespace abut::app
{
  /** Bring a file, or the names in a folder, to the disk. */
  void sync(const std::filesystem::path &path);

  /** Write @p bytes as @p file. */
  void write_to_disk(const std::filesystem::path &file,
                     const std::string &bytes);

  /** Replace @p file by one of @p bytes: whoever looks, also after a crash,
   * finds the old or the new one. */
  void replace_on_disk(const std::filesystem::path &file,
                       const std::string &bytes);

  /** Checksum and length of @p bytes, in words. */
  std::string checksum(const std::string &bytes);

  /** The bytes of @p file. */
  std::string read_from_disk(const std::filesystem::path &file);
} // namespace abut::app

#endif

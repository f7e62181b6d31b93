// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_DISK_H
#define ABUT_APP_DISK_H

/** @file
 * Files, and that they are on the disk when the functions return. What cannot
 * be written (a full disk, a folder that is gone) or read is an InputError that
 * names the file. None is collective.
 */

#include <cstddef>
#include <filesystem>
#include <string>

namespace abut::app
{
  /** Bring a file, or the names in a folder, to the disk. */
  void sync(const std::filesystem::path &path);

  /** Write @p bytes as @p file, or append them to it, without waiting for the
   * disk. */
  void write_file(const std::filesystem::path &file, const std::string &bytes,
                  bool append = false);

  /** Have room for so many bytes more in a folder. For libraries that end the
   * program when they find none. */
  void require_room(const std::filesystem::path &folder, std::size_t bytes);

  /** Write @p bytes as @p file, and bring it to the disk. */
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

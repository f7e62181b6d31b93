// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_lock.h"

#include "app/input/collective.h"
#include "app/input/input_error.h"
#include "disk.h"

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace abut::app
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Whether @p descriptor is still what has the name @p file: the run
     * before may have removed it between our opening and locking it. */
    bool is_same_file(const int descriptor, const fs::path &file)
    {
      struct stat opened = {}, named = {};
      return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0
             && opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
    }

    std::string holder(const fs::path &file)
    {
      try
      {
        return read_from_disk(file);
      }
      catch (const std::runtime_error &)
      {
        return "";
      }
    }

    [[noreturn]] void refuse(const fs::path &file)
    {
      throw InputError("", "another run writes into the output folder '"
                               + file.parent_path().string() + "'"
                               + holder(file)
                               + ". Wait for its end, or choose another "
                                 "folder with --output DIR.");
    }

    /** Who has the lock, for the message above. */
    void sign(const int descriptor)
    {
      char host[256] = "";
      gethostname(host, sizeof(host) - 1);
      char text[320];
      const int n = std::snprintf(text, sizeof(text), " (process %ld on %s)",
                                  static_cast<long>(getpid()), host);
      if (ftruncate(descriptor, 0) != 0 || write(descriptor, text, n) != n)
        return; // the lock holds without a name
    }

    /** The descriptor of the locked file; -1 where there are no locks. */
    int lock(const fs::path &file)
    {
      for (;;)
      {
        const int descriptor =
            open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0)
          return -1;
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
        {
          const bool is_taken = errno == EWOULDBLOCK;
          close(descriptor);
          if (is_taken)
            refuse(file);
          return -1;
        }
        if (is_same_file(descriptor, file))
        {
          sign(descriptor);
          return descriptor;
        }
        close(descriptor);
      }
    }
  } // namespace

  RunLock::RunLock(const fs::path &folder, const MPI_Comm communicator)
      : file(folder / ".abut-lock")
  {
    on_root(communicator, [&] { descriptor = lock(file); });
  }

  RunLock::~RunLock()
  {
    if (descriptor < 0)
      return;
    // Removed while the lock is held: whoever has opened the file before sees
    // that it is gone, and makes another one.
    unlink(file.c_str());
    close(descriptor);
  }
} // namespace abut::app

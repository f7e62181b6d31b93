// SPDX-License-Identifier: LGPL-2.1-or-later
#include "checkpoint_store.h"

#include "app/input/collective.h"
#include "app/input/input_error.h"
#include "app/input/output_folder.h"
#include "disk.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace abut::app
{
  namespace fs = std::filesystem;

  namespace
  {
    const std::string stem = "checkpoint.";
    const std::string unfinished = ".new";
    const std::string outdated = ".old";
    const std::string list_name = "contents";

    /** A line of the list: checksum, size, name. */
    std::string entry(const fs::path &file)
    {
      return checksum(read_from_disk(file)) + " " + file.filename().string()
             + "\n";
    }

    std::vector<fs::path> files_of(const fs::path &checkpoint)
    {
      std::vector<fs::path> files;
      for (const fs::directory_entry &file : fs::directory_iterator(checkpoint))
        if (file.path().filename() != list_name)
          files.push_back(file.path());
      std::sort(files.begin(), files.end());
      return files;
    }

    /** The list of the files that are there, closed by its own checksum. */
    std::string list_files(const fs::path &checkpoint)
    {
      std::string list;
      for (const fs::path &file : files_of(checkpoint))
        list += entry(file);
      return list + checksum(list) + "\n";
    }

    /** N of `checkpoint.N`, 0 for other names. */
    unsigned int number_of(const fs::path &path)
    {
      const std::string name = path.filename().string();
      if (name.compare(0, stem.size(), stem) != 0)
        return 0;
      const std::string digits = name.substr(stem.size());
      if (digits.empty() || digits.size() > 9
          || digits.find_first_not_of("0123456789") != std::string::npos)
        return 0;
      return static_cast<unsigned int>(std::stoul(digits));
    }

    bool is_remainder(const fs::path &path)
    {
      const std::string name = path.filename().string();
      return name.compare(0, stem.size(), stem) == 0
             && (path.extension() == unfinished
                 || path.extension() == outdated);
    }

    /** Remove a checkpoint without ever leaving half of it under its name. */
    void remove_checkpoint(const fs::path &checkpoint)
    {
      fs::path old = checkpoint;
      old += outdated;
      fs::remove_all(old);
      fs::rename(checkpoint, old);
      fs::remove_all(old);
    }
  } // namespace

  CheckpointStore::CheckpointStore(fs::path folder, const MPI_Comm communicator)
      : folder(std::move(folder)),
        communicator(communicator),
        is_root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
  }

  fs::path CheckpointStore::numbered(const unsigned int number) const
  {
    return folder / (stem + std::to_string(number));
  }

  unsigned int CheckpointStore::latest_number() const
  {
    unsigned int number = 0;
    collective(communicator,
               [&]
               {
                 if (!is_root || !fs::is_directory(folder))
                   return;
                 for (const auto &entry : fs::directory_iterator(folder))
                   number = std::max(number, number_of(entry.path()));
               });
    return dealii::Utilities::MPI::broadcast(communicator, number);
  }

  std::optional<fs::path> CheckpointStore::latest() const
  {
    const unsigned int number = latest_number();
    return number > 0 ? std::optional(numbered(number)) : std::nullopt;
  }

  void
  CheckpointStore::write(const std::function<void(const fs::path &)> &write)
  {
    const unsigned int number = latest_number() + 1;
    fs::path next = numbered(number);
    next += unfinished;
    collective(communicator,
               [&]
               {
                 if (!is_root)
                   return;
                 fs::remove_all(next);
                 make_output_folder(next);
               });
    write(next);
    MPI_Barrier(communicator);
    collective(communicator,
               [&]
               {
                 if (is_root)
                   publish(number);
               });
  }

  void CheckpointStore::publish(const unsigned int number) const
  {
    fs::path next = numbered(number);
    next += unfinished;
    for (const fs::path &file : files_of(next))
      sync(file);
    write_to_disk(next / list_name, list_files(next));
    sync(next);
    fs::rename(next, numbered(number));
    sync(folder);
    remove_all_but(number);
  }

  void CheckpointStore::remove_all_but(const unsigned int number) const
  {
    std::vector<fs::path> checkpoints, remainders;
    for (const fs::directory_entry &entry : fs::directory_iterator(folder))
      if (is_remainder(entry.path()))
        remainders.push_back(entry.path());
      else if (number_of(entry.path()) > 0 && number_of(entry.path()) != number)
        checkpoints.push_back(entry.path());
    for (const fs::path &path : remainders)
      fs::remove_all(path);
    for (const fs::path &path : checkpoints)
      remove_checkpoint(path);
  }

  void CheckpointStore::verify(const fs::path &checkpoint) const
  {
    collective(communicator,
               [&]
               {
                 if (!is_root)
                   return;
                 std::string problem;
                 try
                 {
                   if (read_from_disk(checkpoint / list_name)
                       != list_files(checkpoint))
                     problem = "its files were changed";
                 }
                 catch (const std::exception &error)
                 {
                   problem = error.what();
                 }
                 if (!problem.empty())
                   throw InputError("",
                                    "the checkpoint '" + checkpoint.string()
                                        + "' is damaged: " + problem
                                        + ". Run the scene without --resume.");
               });
  }

  void CheckpointStore::remove()
  {
    collective(communicator,
               [&]
               {
                 if (is_root && fs::is_directory(folder))
                   remove_all_but(0);
               });
  }
} // namespace abut::app

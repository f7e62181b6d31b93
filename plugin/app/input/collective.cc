// SPDX-License-Identifier: LGPL-2.1-or-later
#include "collective.h"

#include "input_error.h"

#include <array>
#include <string>

namespace abut::app
{
  namespace
  {
    /** What has to be known of an exception to throw it again elsewhere. */
    struct ErrorDescription
    {
      bool is_input_error = false;
      std::string parameter;
      std::string message;
    };

    ErrorDescription describe(const std::exception_ptr &exception)
    {
      try
      {
        std::rethrow_exception(exception);
      }
      catch (const InputError &error)
      {
        return {true, error.parameter, error.what()};
      }
      catch (const std::exception &error)
      {
        return {false, "", error.what()};
      }
      catch (...)
      {
        return {false, "", "unknown exception"};
      }
    }

    void broadcast(MPI_Comm communicator, const int root, std::string &text)
    {
      unsigned long long length = text.size();
      MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, root, communicator);
      text.resize(length);
      MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, root,
                communicator);
    }
  } // namespace

  void throw_agreed(MPI_Comm communicator, const std::exception_ptr mine)
  {
    int rank, size;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &size);
    int thrower = mine ? rank : size;
    MPI_Allreduce(MPI_IN_PLACE, &thrower, 1, MPI_INT, MPI_MIN, communicator);
    if (thrower == size)
      return;
    if (size == 1)
      std::rethrow_exception(mine);

    ErrorDescription error =
        rank == thrower ? describe(mine) : ErrorDescription();
    int is_input_error = error.is_input_error;
    MPI_Bcast(&is_input_error, 1, MPI_INT, thrower, communicator);
    broadcast(communicator, thrower, error.parameter);
    broadcast(communicator, thrower, error.message);
    if (is_input_error)
      throw InputError(error.parameter, error.message);
    throw std::runtime_error(error.message);
  }

  void collective(MPI_Comm communicator, const std::function<void()> &action)
  {
    std::exception_ptr mine;
    try
    {
      action();
    }
    catch (...)
    {
      mine = std::current_exception();
    }
    throw_agreed(communicator, mine);
  }

  void on_root(MPI_Comm communicator, const std::function<void()> &action)
  {
    int rank;
    MPI_Comm_rank(communicator, &rank);
    collective(
        communicator, rank == 0 ? action : [] {});
  }
} // namespace abut::app

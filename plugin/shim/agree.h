// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_AGREE_H
#define ABUT_SHIM_AGREE_H

#include "shim/core_message.h"

#include <abut/context.h>
#include <abut/dealii/coded.h>

#include <deal.II/base/mpi.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace abut::shim
{
  /** The message that is not empty of the lowest rank; empty if there is none.
   * Collective. */
  inline Message first_message(const MPI_Comm communicator,
                               const Message &message)
  {
    namespace MPI = dealii::Utilities::MPI;
    const unsigned int none = std::numeric_limits<unsigned int>::max();
    const unsigned int first =
        MPI::min(message.empty() ? none : MPI::this_mpi_process(communicator),
                 communicator);
    return first == none ? Message()
                         : MPI::broadcast(communicator, message, first);
  }

  /** Throw @p message on all ranks if it is not empty on one: that of the
   * lowest such rank. Collective. */
  template <typename Error>
  void throw_everywhere(const MPI_Comm communicator, const Message &message)
  {
    const Message first = first_message(communicator, message);
    if (first.empty())
      return;
    if constexpr (std::is_base_of_v<MessageError, Error>)
      throw Error(first);
    else
      throw Error(first.text);
  }

  /** The data of an error, or its text alone if it has none. */
  inline Message message_of(const std::exception &error)
  {
    const auto *known = dynamic_cast<const MessageError *>(&error);
    return known == nullptr ? Message(error.what()) : known->message();
  }

  /** Run @p function. An exception on any rank is thrown on all: as an Error
   * with the message of the lowest such rank, and unchanged if there is only
   * one. The function must not communicate. Collective. */
  template <typename Error, typename Function>
  void run_everywhere(const MPI_Comm communicator, const Function &function)
  {
    const bool alone =
        dealii::Utilities::MPI::n_mpi_processes(communicator) == 1;
    Message message;
    try
    {
      function();
    }
    catch (const std::exception &error)
    {
      if (alone)
        throw;
      message = message_of(error);
    }
    catch (...)
    {
      if (alone)
        throw;
      message = "an exception that is not a std::exception";
    }
    throw_everywhere<Error>(communicator, message);
  }

  /** Throw on all ranks if a call of the core failed on one. Where the core
   * has agreed on the failure, the rank that saw it has the message.
   * Collective. */
  template <typename Error = std::runtime_error>
  void check_everywhere(const MPI_Comm communicator,
                        const abut_context *context, const abut_status status)
  {
    throw_everywhere<Error>(communicator, status == ABUT_FAILED_ELSEWHERE
                                              ? ""
                                              : message_of(context, status));
  }
} // namespace abut::shim

#endif

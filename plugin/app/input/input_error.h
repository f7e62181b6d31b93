// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_INPUT_ERROR_H
#define ABUT_APP_INPUT_ERROR_H

/** @file
 * The two ways in which a run ends early, with the exit codes that belong to
 * them.
 */

#include <abut/dealii/coded.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace abut::app
{
  /** Exit codes of the program. */
  enum class ExitCode
  {
    success = 0,
    internal_error = 1,  /**< a fault of the program or of the machine */
    bad_input = 2,       /**< command line or scene file */
    unusable_answer = 3, /**< the run ended without an answer to rely on */
    stopped = 4          /**< by a signal, after a checkpoint to go on from */
  };

  /** Largest magnitude of lengths, loads and displacements, whose squares and
   * products with one another must be finite. */
  constexpr double largest_value = 1e100;

  /** Something the user wrote is wrong: a parameter's value, a file that it
   * names, the command line. The program prints file and line of the
   * parameter, its name and the message, once, and ends with exit code 2.
   *
   * To be thrown by all ranks alike, or by some inside collective(). */
  class InputError : public MessageError
  {
  public:
    /** @param parameter full name, `Section/Subsection/Name`; empty when no
     * parameter is to blame
     * @param message a sentence that says what is wrong and what is legal */
    InputError(std::string parameter, const Message &message)
        : MessageError(message), parameter(std::move(parameter))
    {
    }

    const std::string parameter;
  };
} // namespace abut::app

#endif

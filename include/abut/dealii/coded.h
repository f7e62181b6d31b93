// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CODED_H
#define ABUT_DEALII_CODED_H

#include <abut/failure.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace abut
{
  /** Data of a pair that a message is about. */
  enum class PairField
  {
    surfaces,        /**< its boundary ids, or the pair as a whole */
    obstacle,        /**< the rigid obstacle */
    upper_obstacle,  /**< of nodal obstacles */
    gap,             /**< added to the gap of the geometry */
    kinematics,      /**< MethodParameters::kinematics */
    friction,        /**< the coefficient, or friction as such */
    largest_friction /**< the largest traction */
  };

  /** A message: the known failure, the pair, its field and the body that it is
   * about, and what was measured, as data, and the text for the user. Programs
   * read the data, never the text. */
  struct Message
  {
    /** Measured values and their limits, by name; lengths in the unit of the
     * mesh, parts of 1. */
    using Numbers = std::vector<std::pair<std::string, double>>;

    abut_failure failure = ABUT_FAILURE_NONE; /**< NONE: no known one */
    std::string text; /**< begins with the code of coded() */
    std::string pair; /**< name; empty: none */
    PairField field = PairField::surfaces; /**< of the pair */
    int body = -1;   /**< number from 0 of a body without support */
    Numbers numbers; /**< that the text states */

    Message() = default;

    /** A text without data. */
    Message(std::string words) : text(std::move(words))
    {
    }

    /** A text without data. */
    Message(const char *words) : text(words)
    {
    }

    /** The text. */
    operator std::string() const
    {
      return text;
    }

    /** Whether there is no text. */
    bool empty() const
    {
      return text.empty();
    }

    /** The same data with more text. */
    friend Message operator+(Message message, const std::string &more)
    {
      message.text += more;
      return message;
    }

    /** The same data with more text. */
    friend Message operator+(Message message, const char *more)
    {
      message.text += more;
      return message;
    }

    /** The same data with text in front. */
    friend Message operator+(const std::string &before, Message message)
    {
      message.text = before + message.text;
      return message;
    }

    /** For ranks that exchange messages. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &failure &text &pair &field &body &numbers;
    }
  };

  /** A message about a known failure, with its code in front: `ABUT-F06: text`.
   * The text alone for ABUT_FAILURE_NONE.
   * @param numbers that the text states */
  inline Message coded(const abut_failure failure, const std::string &text,
                       Message::Numbers numbers = {})
  {
    const abut_failure_entry *entry = abut_failure_get(failure);
    Message message(entry == nullptr ? text : entry->code + (": " + text));
    message.failure = failure;
    message.numbers = std::move(numbers);
    return message;
  }

  /** The message without the code that coded() has put in front. */
  inline std::string uncoded(const Message &message)
  {
    const std::string code = coded(message.failure, "").text;
    return message.text.substr(
        message.text.compare(0, code.size(), code) == 0 ? code.size() : 0);
  }

  /** The message with @p subject in front of its text, and behind its code if
   * it has one: `ABUT-F11: Pair 1: text`. */
  inline Message about(const std::string &subject, Message message)
  {
    message.text =
        coded(message.failure, subject + ": " + uncoded(message)).text;
    return message;
  }

  /** A message about a pair: `Pair 'name': text`. The field is that of
   * @p message unless another one is given. */
  inline Message about_pair(const std::string &name, const Message &message,
                            const PairField field = PairField::surfaces)
  {
    Message result = "Pair '" + name + "': " + message;
    result.pair = name;
    if (field != PairField::surfaces)
      result.field = field;
    return result;
  }

  /** The message without what about_pair() has put in front. */
  inline Message without_pair(Message message)
  {
    const std::string front = "Pair '" + message.pair + "': ";
    if (message.text.compare(0, front.size(), front) == 0)
      message.text.erase(0, front.size());
    return message;
  }

  /** An error with the data of its message. */
  class MessageError : public std::runtime_error
  {
  public:
    /** With the data of the message. */
    MessageError(Message message)
        : std::runtime_error(message.text), message_(std::move(message))
    {
    }

    /** With a text alone. */
    MessageError(const std::string &text) : MessageError(Message(text))
    {
    }

    /** With a text alone. */
    MessageError(const char *text) : MessageError(Message(text))
    {
    }

    /** Failure, pair and field. */
    const Message &message() const
    {
      return message_;
    }

  private:
    Message message_;
  };
} // namespace abut

#endif

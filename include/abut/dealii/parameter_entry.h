// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_PARAMETER_ENTRY_H
#define ABUT_DEALII_PARAMETER_ENTRY_H

/** @file
 * Parameters with level, unit and an example, in addition to name, default,
 * legal values and text; and names that have changed.
 */

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace abut::parameter
{
  /** Who needs a parameter. */
  enum class Level
  {
    basic,    /**< every scene */
    advanced, /**< scenes with a special purpose */
    expert    /**< comparisons and studies of methods */
  };

  /** The word for a level. */
  const char *level_name(Level level);

  /** Data that a declaration adds to name, default, pattern and text. */
  struct Note
  {
    Level level = Level::advanced; /**< who needs the parameter */
    std::string unit;    /**< "length"; "1" without dimension; else empty */
    std::string example; /**< a legal value; empty for words and truth values */
  };

  /** The note of a basic parameter. */
  inline Note basic(const std::string &unit = "",
                    const std::string &example = "")
  {
    return {Level::basic, unit, example};
  }

  /** The note of an advanced parameter. */
  inline Note advanced(const std::string &unit = "",
                       const std::string &example = "")
  {
    return {Level::advanced, unit, example};
  }

  /** The note of an expert parameter. */
  inline Note expert(const std::string &unit = "",
                     const std::string &example = "")
  {
    return {Level::expert, unit, example};
  }

  /** Declare an entry with @p text, followed by the note in brackets:
   * "Young modulus. [basic; force/length^2; 210e3]". */
  void declare(dealii::ParameterHandler &prm, const std::string &name,
               const std::string &default_value,
               const dealii::Patterns::PatternBase &pattern, const Note &note,
               const std::string &text);

  /** The text and the note of a documentation that declare() made; a
   * documentation without a note is all text. */
  struct Documentation
  {
    /** Split the @p documentation of an entry. */
    explicit Documentation(const std::string &documentation);

    std::string text; /**< the text without the note */
    Note note;        /**< the note in brackets */
  };

  /** The value of entry @p name, or 0 where it is a word in place of a number
   * (OrWord). */
  double number_or_zero(const dealii::ParameterHandler &prm,
                        const std::string &name);

  /** A parameter that had another name. `*` is any number. */
  struct OldName
  {
    const char *old_path; /**< `Section/Name` */
    const char *path;     /**< `Section/Name` of today */
  };

  /** A word of a selection that was another one. */
  struct OldValue
  {
    const char *path;      /**< of today */
    const char *old_value; /**< the former word */
    const char *value;     /**< the word of today */
  };

  /** All names that have changed; scene files may still have them. */
  const std::vector<OldName> &old_names();

  /** All words that have changed. */
  const std::vector<OldValue> &old_values();

  /** The path of today, without an old name the same. */
  std::string present_path(const std::string &path);

  /** The value of today of the parameter at @p path, of today. */
  std::string present_value(const std::string &path, const std::string &value);

  /** Declare the old names of the entries in @p section, which must be open, as
   * deprecated aliases. For programs that read files by ParameterHandler
   * alone; words of selections are not translated. */
  void declare_old_names(dealii::ParameterHandler &prm,
                         const std::string &section);
} // namespace abut::parameter

#endif

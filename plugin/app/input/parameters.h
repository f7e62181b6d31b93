// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PARAMETERS_H
#define ABUT_APP_PARAMETERS_H

/** @file
 * Scene files: deal.II's `.prm` syntax, read so that each value knows the
 * file and line that it came from and each wrong word is answered with the
 * nearest right one.
 */

#include "input_error.h"

#include <abut/dealii/nearest_word.h>
#include <abut/dealii/parameter_entry.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace abut::app
{
  /** A declared parameter. */
  struct DeclaredParameter
  {
    std::string path;  /**< `Section/Subsection/Name` */
    std::string value; /**< present one */
    std::string default_value;
    std::string documentation;
    std::string pattern;              /**< legal values in words */
    std::vector<std::string> choices; /**< words of a selection, else empty */
    std::string zero_word; /**< in place of a number, once written 0 */
    parameter::Note note;
  };

  /** All parameters declared in @p prm, in order of declaration. */
  std::vector<DeclaredParameter>
  declared_parameters(const dealii::ParameterHandler &prm);

  /** `set Name = value` of a scene file or of the command line. */
  struct Assignment
  {
    std::string path;
    std::string value;
    std::string origin;         /**< `file:line` or the option */
    std::string written = path; /**< path in the file, perhaps an old name */
    std::string written_value = value;
  };

  /** Advice on a path that is not declared, " Sentence."; or empty. */
  using AdviceFor = std::function<std::string(const std::string &path)>;

  /** The assignments of a scene file and of the command line's `--set`. */
  class ParameterFile
  {
  public:
    /** Read @p file (subsection, set, end, include, comments, lines continued
     * by a backslash); then append @p offers and @p overrides, each
     * `Section/Name=value`, of the options `--set-if-used` and `--set`.
     * Throws InputError when file or syntax are wrong. Not collective. */
    ParameterFile(const std::string &file,
                  const std::vector<std::string> &overrides,
                  const std::vector<std::string> &offers = {});

    /** The file's path, as given. */
    const std::string &path() const
    {
      return file;
    }

    /** The file's name without folder and extension. */
    std::string name() const;

    /** The last value given for @p path, or @p otherwise. */
    std::string get(const std::string &path,
                    const std::string &otherwise) const;

    /** Where the value of @p path came from: `file:line`, the `--set` option,
     * or the file's name alone when the parameter kept its default. */
    std::string origin(const std::string &path) const;

    /** Whether the value of @p path was given by `--set`. */
    bool is_from_command_line(const std::string &path) const;

    /** @p error with the place of its parameter in front of the message, unless
     * it names none. */
    InputError placed(const InputError &error) const;

    /** The values that count, by path. */
    std::map<std::string, std::string> values() const;

    /** Set all values in @p prm and return what is declared there, with its
     * values now. Throws InputError for a parameter or section that is not
     * declared, with the advice of @p elsewhere where names here give none, and
     * for a value that its pattern refuses. */
    std::vector<DeclaredParameter> apply(dealii::ParameterHandler &prm,
                                         const AdviceFor &elsewhere = {}) const;

    /** Old names and words that were given, each with the one of today. */
    std::vector<std::string>
    old_words(const std::vector<DeclaredParameter> &declared) const;

    /** A line of a file. */
    struct Place
    {
      std::string file;
      unsigned int line;
    };

  private:
    void read(const std::string &name, unsigned int depth);
    void read_line(const std::string &line, const Place &place,
                   std::vector<std::string> &sections, unsigned int depth);
    void override_with(const std::string &option, const std::string &argument);
    void assign(const std::string &path, const std::string &value,
                const std::string &origin);
    void refuse_two_names() const;

    std::string file;
    std::vector<Assignment> assignments;
  };

  /** Numbers separated by blanks or commas; throws InputError that names
   * @p parameter. "1 2, 3" gives {1, 2, 3}. */
  std::vector<double> parse_numbers(const std::string &text,
                                    const std::string &parameter);

  /** A number, or NaN for `nan` and for an empty text (a value that is not
   * known); throws InputError that names @p parameter. */
  double parse_number_or_nan(const std::string &text,
                             const std::string &parameter);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_PARAMETER_REFERENCE_H
#define ABUT_APP_PARAMETER_REFERENCE_H

/** @file
 * The reference of parameters, as Markdown: sections that kinds of scenes share
 * are printed once.
 */

#include <abut/dealii/parameter_entry.h>

#include <iosfwd>
#include <string>

namespace abut::app
{
  /** Parameters to print. */
  struct ReferenceOptions
  {
    std::string kind; /**< one kind of scenes; empty: all */
    parameter::Level level = parameter::Level::expert; /**< up to this one */

    /** Of the words of the command line; throws InputError. */
    static ReferenceOptions parse(const std::string &kind,
                                  const std::string &level);

    /** Whether nothing is left out. */
    bool is_all() const
    {
      return kind.empty() && level == parameter::Level::expert;
    }
  };

  /** The parameters of scenes. */
  void write_reference(std::ostream &out, const ReferenceOptions &options);
} // namespace abut::app

#endif

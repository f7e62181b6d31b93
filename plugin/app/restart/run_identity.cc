// SPDX-License-Identifier: LGPL-2.1-or-later
#include "run_identity.h"

#include <abut/dealii/parameter_entry.h>
#include <abut/version.h>

#include <deal.II/base/config.h>

#include <set>

namespace abut::app
{
  namespace
  {
    /** To be raised with each change of what checkpoints hold. */
    constexpr int checkpoint_format = 1;

    /** Differences beyond these are counted only. */
    constexpr unsigned int most_named = 5;

    std::string quoted(const RunIdentity &identity, const std::string &name)
    {
      const auto found = identity.find(name);
      return found == identity.end() ? "nothing" : "'" + found->second + "'";
    }
  } // namespace

  RunIdentity program_identity()
  {
    return {{"version of abut", ABUT_VERSION},
            {"version of deal.II", DEAL_II_PACKAGE_VERSION},
            {"format of checkpoints", std::to_string(checkpoint_format)}};
  }

  RunIdentity with_present_names(const RunIdentity &before,
                                 const RunIdentity &now)
  {
    RunIdentity result;
    for (const auto &[name, old_value] : before)
    {
      const std::string path = parameter::present_path(name);
      std::string value = parameter::present_value(path, old_value);
      const auto today = now.find(path);
      const bool known = today != now.end();
      // Words in place of a 0.
      if (known && value == "0" && today->second != "0"
          && today->second.find_first_of("0123456789") == std::string::npos)
        value = today->second;
      // Two names have become one: the one that the run used counts.
      if (const auto other = result.find(path);
          other == result.end() || !known || other->second != today->second)
        result[path] = value;
    }
    return result;
  }

  std::string difference(const RunIdentity &before, const RunIdentity &now)
  {
    std::set<std::string> names;
    for (const auto *identity : {&before, &now})
      for (const auto &entry : *identity)
        if (quoted(before, entry.first) != quoted(now, entry.first))
          names.insert(entry.first);
    std::string text;
    unsigned int n = 0;
    for (const std::string &name : names)
      if (++n <= most_named)
        text += (n > 1 ? "; " : "") + name + " was " + quoted(before, name)
                + " and is " + quoted(now, name);
    if (n > most_named)
      text += "; and " + std::to_string(n - most_named) + " more";
    return text;
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "method_words.h"

#include <abut/law.h>

#include <map>

namespace abut::app
{
  std::string law_in_words(const MethodParameters &method)
  {
    static const std::map<std::string, const char *> words = {
        {"lagrange", "Lagrange multipliers"},
        {"penalty", "penalty method"},
        {"quadratic penalty", "quadratic penalty method"},
        {"augmented lagrangian", "augmented Lagrangian method"},
        {"barrier", "barrier method"},
        {"interior point", "interior point method"},
        {"nitsche", "Nitsche's method"}};
    const std::string name = method.options.law->name;
    const auto found = words.find(name);
    return (found == words.end() ? "law " + name : found->second)
           + (method.law_is_automatic ? " (chosen automatically)" : "");
  }

  std::string counted(const std::size_t n, const std::string &one,
                      const std::string &several)
  {
    return std::to_string(n) + " " + (n == 1 ? one : several);
  }
} // namespace abut::app

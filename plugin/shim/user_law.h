// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_USER_LAW_H
#define ABUT_SHIM_USER_LAW_H

#include <abut/friction.h>
#include <abut/law.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace abut
{
  /** A law from a shared object with its parameters. The object stays loaded
   * until the program ends. */
  struct UserLaw
  {
    abut_law law;
    std::vector<double> parameters;
  };

  /** The same of a friction law. */
  struct UserFriction
  {
    abut_friction law;
    std::vector<double> parameters;
  };

  namespace shim
  {
    /** The word of the parameter file for it. */
    constexpr const char *user_law_word = "user";

    /** Load the law in @p file with the parameters of the given names. Throws
     * dealii::ExceptionBase with the name of the file and what is wrong. Not
     * collective. */
    std::shared_ptr<const UserLaw>
    load_user_law(const std::string &file,
                  const std::map<std::string, double> &parameters);

    /** The same for a friction law. */
    std::shared_ptr<const UserFriction>
    load_user_friction(const std::string &file,
                       const std::map<std::string, double> &parameters);
  } // namespace shim
} // namespace abut

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_GENERATOR_ARGUMENTS_H
#define ABUT_APP_GENERATOR_ARGUMENTS_H

#include <string>
#include <vector>

namespace abut::app
{
  /** The names that deal.II's generate_from_name_and_arguments() knows (it
   * offers no list of them); only used to answer a wrong one. */
  const std::vector<std::string> &generators();

  /** What is wrong with the arguments of a generator that exists, as a sentence
   * that names all of them.
   * @param complaint deal.II's, which tells how many it wants */
  std::string wrong_arguments(const std::string &generator,
                              const std::string &arguments,
                              const std::string &complaint);
} // namespace abut::app

#endif

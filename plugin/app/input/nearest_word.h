// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NEAREST_WORD_H
#define ABUT_APP_NEAREST_WORD_H

#include <string>
#include <vector>

namespace abut::app
{
  /** The word of @p words nearest to @p word by edit distance (capitals and
   * small letters alike), or "" when none is near. */
  std::string nearest_word(const std::string &word,
                           const std::vector<std::string> &words);

  /** " Did you mean 'x'?" with the nearest word, or "". */
  std::string did_you_mean(const std::string &word,
                           const std::vector<std::string> &words);
} // namespace abut::app

#endif

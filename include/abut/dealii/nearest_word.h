// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_NEAREST_WORD_H
#define ABUT_DEALII_NEAREST_WORD_H

/** @file
 * What a user may have meant by a wrong word: the nearest word by the edit
 * distance of Damerau and Levenshtein (insertions, deletions, replacements and
 * exchanges of neighbours; optimal string alignment), by dynamic programming
 * over two words, O(length^2) each.
 */

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace abut
{
  /** Parts of nearest_word(). */
  namespace edits
  {
    /** With small letters alone. */
    inline std::string in_lower_case(std::string text)
    {
      for (char &c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      return text;
    }

    /** Up to the first blank. */
    inline std::string first_word(const std::string &text)
    {
      return text.substr(0, text.find(' '));
    }

    /** Number of edits that make @p b of @p a. */
    inline std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::vector<std::size_t>> d(
          a.size() + 1, std::vector<std::size_t>(b.size() + 1));
      for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j)
        {
          if (i == 0 || j == 0)
          {
            d[i][j] = i + j;
            continue;
          }
          d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1,
                              d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
          if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
            d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
      return d[a.size()][b.size()];
    }
  } // namespace edits

  /** The word of @p words nearest to @p word by edit distance (capitals and
   * small letters alike), or "" when none is near. */
  inline std::string nearest_word(const std::string &word,
                                  const std::vector<std::string> &words)
  {
    const std::string wanted = edits::in_lower_case(word);
    std::string nearest;
    std::size_t smallest = 0;
    for (const std::string &candidate : words)
    {
      const std::string lower = edits::in_lower_case(candidate);
      std::size_t distance = edits::edit_distance(wanted, lower);
      // "lagrang multiplier" for "lagrange": the first words are near.
      const std::string first = edits::first_word(wanted);
      if (first.size() < wanted.size())
        if (const std::size_t each =
                edits::edit_distance(first, edits::first_word(lower));
            3 * each <= first.size())
          distance = std::min(distance, 1 + each);
      // "interior" for "interior point": one begins with the other.
      if (wanted.size() > 2
          && (lower.compare(0, wanted.size(), wanted) == 0
              || wanted.compare(0, lower.size(), lower) == 0))
        distance = std::min<std::size_t>(distance, 1);
      if (distance <= 1 + std::max(wanted.size(), lower.size()) / 3
          && (nearest.empty() || distance < smallest))
      {
        nearest = candidate;
        smallest = distance;
      }
    }
    return nearest;
  }

  /** " Did you mean 'x'?" with the nearest word, or "". */
  inline std::string did_you_mean(const std::string &word,
                                  const std::vector<std::string> &words)
  {
    const std::string nearest = nearest_word(word, words);
    return nearest.empty() ? "" : " Did you mean '" + nearest + "'?";
  }
} // namespace abut

#endif

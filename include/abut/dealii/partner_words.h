// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_PARTNER_WORDS_H
#define ABUT_DEALII_PARTNER_WORDS_H

#include <abut/dealii/detection_report.h>

#include <string>

namespace abut
{
  /** A sentence, with a blank before it, on the partners that points with
   * pressure have lost, and the remedy; empty if there are none. */
  inline std::string in_words(const PartnerChanges &changes)
  {
    if (changes.lost + changes.jumped == 0)
      return "";
    std::string seen = " Of the points that press,";
    if (changes.lost > 0)
      seen +=
          " " + std::to_string(changes.lost)
          + " left the end of the opposite surface in the last linearisation"
          + (changes.jumped > 0 ? " and" : "");
    if (changes.jumped > 0)
      seen += " " + std::to_string(changes.jumped)
              + " jumped between facets that are not neighbours or have "
                "different normals";
    return seen
           + ": use Method/Discretisation = dual mortar, which follows "
             "smoothly, or round such corners and ends.";
  }
} // namespace abut

#endif

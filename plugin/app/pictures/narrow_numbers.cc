// SPDX-License-Identifier: LGPL-2.1-or-later
#include "narrow_numbers.h"

#include "app/input/short_number.h"

#include <algorithm>
#include <limits>

namespace abut::app
{
  namespace
  {
    using Float = std::numeric_limits<float>;

    void append(std::string &list, const std::string &name)
    {
      list += (list.empty() ? "" : ", ") + name;
    }
  } // namespace

  void NarrowNumbers::add_field(const std::string &name, const double largest)
  {
    double &old = largest_by_field.try_emplace(name, largest).first->second;
    old = std::max(old, largest);
  }

  void NarrowNumbers::add_mesh(const double size)
  {
    smallest_size = std::min(smallest_size, size);
  }

  void NarrowNumbers::add(const NarrowNumbers &other)
  {
    for (const auto &[name, largest] : other.largest_by_field)
      add_field(name, largest);
    add_mesh(other.smallest_size);
  }

  std::vector<std::string> NarrowNumbers::lost() const
  {
    // Cells that are smaller beside their distance from the origin are off by a
    // hundredth.
    constexpr double least_size = 6e-6;
    std::vector<std::string> sentences;
    if (smallest_size < least_size)
      sentences.push_back(
          "Cells are as small as " + short_number(smallest_size, 2)
          + " of their distance from the origin. Places in files of fields "
            "have seven digits, and pictures made of them will show cells out "
            "of shape, though what was computed has all digits, as has "
            "nodal.csv (Output/Nodal values). Move the mesh nearer.");

    std::string too_large, too_small;
    for (const auto &[name, largest] : largest_by_field)
      if (largest > double(Float::max()))
        append(too_large, name);
      else if (largest > 0. && largest < double(Float::min()))
        append(too_small, name + " (" + short_number(largest, 2) + ")");
    const std::string remedy =
        "What was computed has all digits, as have displacements and forces in "
        "nodal.csv (Output/Nodal values). Choose other units, or correct the "
        "value that leads to such numbers.";
    if (!too_large.empty())
      sentences.push_back("Files of fields end at "
                          + short_number(Float::max(), 2)
                          + ", and larger numbers are infinite or none there: "
                          + too_large + ". " + remedy);
    if (!too_small.empty())
      sentences.push_back("Numbers below " + short_number(Float::min(), 2)
                          + " are 0 in files of fields, or have few digits: "
                            "all of "
                          + too_small + ", and what is made of it. " + remedy);
    return sentences;
  }
} // namespace abut::app

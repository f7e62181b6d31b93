// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NARROW_NUMBERS_H
#define ABUT_APP_NARROW_NUMBERS_H

/** @file
 * What files of fields, whose numbers have 32 bits, cannot hold.
 */

#include <map>
#include <string>
#include <vector>

namespace abut::app
{
  /** What has been written into files of fields, to tell what was lost. */
  class NarrowNumbers
  {
  public:
    /** A field whose values are @p largest at the most, infinite if they are
     * beyond what the files hold. */
    void add_field(const std::string &name, double largest);

    /** A mesh whose cells are as small as @p size, as a part of their distance
     * from the origin. */
    void add_mesh(double size);

    void add(const NarrowNumbers &other);

    /** What was lost, a sentence for each kind; none if nothing was. */
    std::vector<std::string> lost() const;

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &largest_by_field &smallest_size;
    }

  private:
    std::map<std::string, double> largest_by_field;
    double smallest_size = 1.;
  };
} // namespace abut::app

#endif

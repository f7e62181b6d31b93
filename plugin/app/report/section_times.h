// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SECTION_TIMES_H
#define ABUT_APP_SECTION_TIMES_H

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace abut::app
{
  /** Times and memory of nested sections, on this rank. A section entered
   * within another is named `outer/inner`; sections stand in the order of their
   * first entry. Cost of a section: two readings of two clocks and of the
   * memory's peak. */
  class SectionTimes
  {
  public:
    /** One section. */
    struct Section
    {
      std::string name;
      double seconds = 0;           /**< on the wall */
      double processor_seconds = 0; /**< of this thread */
      double memory_mb = 0; /**< by which it raised the process' peak, MiB */
      long calls = 0;
      unsigned int depth = 0; /**< number of sections around it */

      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &name &seconds &processor_seconds &memory_mb &calls;
        archive &depth;
      }
    };

    /** Times the section from construction to destruction. */
    class Scope
    {
    public:
      Scope(SectionTimes &times, const std::string &name);
      ~Scope();
      Scope(const Scope &) = delete;
      Scope &operator=(const Scope &) = delete;

    private:
      SectionTimes &times;
    };

    /** Begin a section within the present one. */
    void enter(const std::string &name);

    /** End the present section. */
    void leave();

    /** All sections. */
    const std::vector<Section> &sections() const
    {
      return all;
    }

    /** The section with this full name; one without time if never entered. */
    Section section(const std::string &name) const;

    /** Its seconds on the wall. */
    double seconds(const std::string &name) const
    {
      return section(name).seconds;
    }

    /** What a checkpoint keeps; to be loaded outside of all sections. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &all;
    }

  private:
    using Clock = std::chrono::steady_clock;
    struct Open
    {
      std::size_t section;
      Clock::time_point start;
      double processor_start;
      double memory_start;
    };
    std::vector<Section> all;
    std::vector<Open> stack;
  };
} // namespace abut::app

#endif

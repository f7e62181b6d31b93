// SPDX-License-Identifier: LGPL-2.1-or-later
#include "section_times.h"

#include "peak_memory.h"
#include "processor_time.h"

#include <algorithm>

namespace abut::app
{
  SectionTimes::Scope::Scope(SectionTimes &times, const std::string &name)
      : times(times)
  {
    times.enter(name);
  }

  SectionTimes::Scope::~Scope()
  {
    times.leave();
  }

  void SectionTimes::enter(const std::string &name)
  {
    const std::string full =
        stack.empty() ? name : all[stack.back().section].name + "/" + name;
    const auto found =
        std::find_if(all.begin(), all.end(),
                     [&](const Section &s) { return s.name == full; });
    const std::size_t index = found - all.begin();
    if (found == all.end())
      all.push_back(
          {full, 0, 0, 0, 0, static_cast<unsigned int>(stack.size())});
    stack.push_back({index, Clock::now(), processor_seconds(), peak_memory()});
  }

  void SectionTimes::leave()
  {
    const Open open = stack.back();
    stack.pop_back();
    Section &section = all[open.section];
    section.seconds +=
        std::chrono::duration<double>(Clock::now() - open.start).count();
    section.processor_seconds += processor_seconds() - open.processor_start;
    section.memory_mb += peak_memory() - open.memory_start;
    ++section.calls;
  }

  SectionTimes::Section SectionTimes::section(const std::string &name) const
  {
    for (const Section &section : all)
      if (section.name == name)
        return section;
    return {};
  }
} // namespace abut::app

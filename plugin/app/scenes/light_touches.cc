// SPDX-License-Identifier: LGPL-2.1-or-later
#include "light_touches.h"

#include <algorithm>

namespace abut::app
{
  namespace
  {
    /** Depth between nodes, by the deformation, that an answer can bear: as
     * ContactChecks::examine() has it. */
    constexpr double bearable = 0.1;
  } // namespace

  bool LightTouches::is_small(const ContactFinding &finding) const
  {
    return finding.between_nodes <= bearable * deformation[finding.pair_number];
  }

  void LightTouches::note(const ContactExamination &step)
  {
    deformation.resize(step.touches.size(), 0.);
    n_steps.resize(step.touches.size(), 0);
    for (std::size_t p = 0; p < step.touches.size(); ++p)
    {
      n_steps[p] = step.touches[p] ? n_steps[p] + 1 : 0;
      if (step.touches[p])
        deformation[p] = std::max(deformation[p], step.deformation);
    }
  }

  void LightTouches::keep_back(ContactExamination &step)
  {
    const auto may_be_excused = [&](const ContactFinding &finding)
    {
      if (finding.between_nodes == 0.)
        return false;
      if (!finding.is_error || is_small(finding))
        return true;
      Held &worst = held[{static_cast<unsigned int>(finding.pair_number),
                          static_cast<int>(finding.failure)}];
      if (finding.between_nodes > worst.depth)
        worst = {finding.between_nodes, finding.text};
      return true;
    };
    step.findings.erase(std::remove_if(step.findings.begin(),
                                       step.findings.end(), may_be_excused),
                        step.findings.end());
  }

  void LightTouches::tell(ContactExamination &step) const
  {
    for (const auto &[key, worst] : held)
    {
      ContactFinding finding;
      finding.pair_number = key.first;
      finding.failure = static_cast<abut_failure>(key.second);
      finding.between_nodes = worst.depth;
      const auto is_same = [&](const ContactFinding &found)
      {
        return found.is_error && found.failure == finding.failure
               && found.pair_number == finding.pair_number;
      };
      if (is_small(finding)
          || std::any_of(step.findings.begin(), step.findings.end(), is_same))
        continue;
      // A run may end in the step in which they meet.
      const bool has_begun = n_steps[finding.pair_number] == 1;
      finding.is_error = !has_begun;
      finding.text =
          worst.text
          + (has_begun ? " First contact was in the last step."
                       : " Contact is weaker than that in all steps.");
      step.findings.push_back(finding);
    }
  }

  void LightTouches::sort(ContactExamination &step, const bool is_last,
                          const bool is_answer)
  {
    note(step);
    if (!is_last || !is_answer)
      keep_back(step);
    if (is_last)
      tell(step);
  }
} // namespace abut::app

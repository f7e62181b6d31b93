// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_LIGHT_TOUCHES_H
#define ABUT_APP_LIGHT_TOUCHES_H

#include <abut/dealii/contact_examination.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace abut::app
{
  /** What comes between nodes in the steps of a run, beside the largest
   * deformation under the contact of its pair in all of them. At its first and
   * last touch contact is lighter than facets can show: this is no error where
   * it presses more in other steps, and one where it never does. */
  class LightTouches
  {
  public:
    /** Take the findings of a step. Those that a larger deformation may excuse
     * are kept back until the last one; then those are added that it has not.
     * @p is_answer: of a run in equilibrium, whose last step is what it was
     * made for, that one is judged by itself. */
    void sort(ContactExamination &step, bool is_last, bool is_answer);

    /** What a checkpoint keeps. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &deformation &n_steps &held;
    }

  private:
    /** An error that is kept back. */
    struct Held
    {
      double depth = 0.;
      std::string text;

      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &depth &text;
      }
    };

    bool is_small(const ContactFinding &finding) const;
    void note(const ContactExamination &step);
    void keep_back(ContactExamination &step);
    void tell(ContactExamination &step) const;

    std::vector<double> deformation;   ///< by pair, the largest in contact
    std::vector<unsigned int> n_steps; ///< by pair, that it has touched by now
    /** The deepest by pair and failure. */
    std::map<std::pair<unsigned int, int>, Held> held;
  };
} // namespace abut::app

#endif

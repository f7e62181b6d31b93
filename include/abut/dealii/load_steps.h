// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_LOAD_STEPS_H
#define ABUT_DEALII_LOAD_STEPS_H

/** @file
 * The way from no load to all of it, in steps that adapt to what can be solved.
 *
 *     abut::LoadSteps steps(options);
 *     while (!steps.is_finished())
 *     {
 *       const la::Vector before(u);
 *       // loads and supports of the time steps.target()
 *       const abut::NewtonResult result = solver.solve(u);
 *       if (result.converged())
 *       {
 *         contact.commit(u); // and the material
 *         steps.accept();
 *       }
 *       else
 *       {
 *         contact.rollback(); // and the material
 *         u = before;
 *         AssertThrow(steps.reject(), ExcMessage(result.explanation));
 *       }
 *     }
 */

#include <algorithm>

namespace abut
{
  /** Limits of LoadSteps. */
  struct LoadStepOptions
  {
    /** Number of equal steps that are tried first, > 0. */
    unsigned int steps = 1;
    /** Time at the end, > 0; it begins at 0. */
    double end_time = 1.;
    /** Whether a step that fails is tried again with half its length. */
    bool cut_back = true;
    /** Length of a step, as part of the whole time, below which it is given up,
     * in (0, 1]. */
    double smallest_step = 1e-3;
  };

  /** Chooses the length of load steps: those requested, halved when one fails
   * or was hard to solve, and doubled again up to these after two good ones.
   * All ranks must call the same functions. */
  class LoadSteps
  {
  public:
    /** At time 0. */
    explicit LoadSteps(const LoadStepOptions &options)
        : options_(options), length_(full_length())
    {
    }

    /** Whether the end is reached. */
    bool is_finished() const
    {
      return reached_ >= options_.end_time;
    }

    /** Time that the next step aims at. */
    double target() const
    {
      // A last step that would be left over as a sliver is taken along.
      const double next = reached_ + length_;
      return next > options_.end_time - 1e-6 * length_ ? options_.end_time
                                                       : next;
    }

    /** Time that has been reached. */
    double time() const
    {
      return reached_;
    }

    /** The step to target() succeeded.
     * @param was_hard with so much work that the next one should be shorter; it
     * will not be shorter than allowed */
    void accept(const bool was_hard = false)
    {
      reached_ = target();
      ++n_accepted_;
      if (was_hard)
      {
        n_good_ = 0;
        if (options_.cut_back && 0.5 * length_ >= shortest_length())
          length_ *= 0.5;
        return;
      }
      ++n_good_;
      if (n_good_ == 2 && length_ < full_length())
      {
        length_ = std::min(2. * length_, full_length());
        n_good_ = 0;
      }
      else if (n_good_ == 2)
        n_good_ = 1;
    }

    /** It failed: try half of it. Returns false when that would be shorter
     * than allowed, or is not allowed at all. */
    bool reject()
    {
      ++n_rejected_;
      n_good_ = 0;
      length_ *= 0.5;
      return options_.cut_back && length_ >= shortest_length();
    }

    /** Number of steps that succeeded. */
    unsigned int n_accepted() const
    {
      return n_accepted_;
    }

    /** Number of steps that failed. */
    unsigned int n_rejected() const
    {
      return n_rejected_;
    }

    /** Its data in a checkpoint, with an archive of boost's. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &reached_ &length_ &n_good_ &n_accepted_ &n_rejected_;
    }

  private:
    /** With a smallest step of 0 there would be no end. */
    double shortest_length() const
    {
      return std::max(options_.smallest_step, 1e-12) * options_.end_time;
    }

    double full_length() const
    {
      return options_.end_time / options_.steps;
    }

    LoadStepOptions options_;
    double reached_ = 0.;
    double length_;
    unsigned int n_good_ = 0; ///< since the last failure or doubling
    unsigned int n_accepted_ = 0, n_rejected_ = 0;
  };
} // namespace abut

#endif

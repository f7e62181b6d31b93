// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MOTION_RECORD_H
#define ABUT_APP_MOTION_RECORD_H

#include "app/report/report.h"
#include "motion.h"

#include <filesystem>

namespace abut::app
{
  /** What a motion comes to from step to step: a row of levels.csv each, the
   * energy balance with what it says of the scheme, sums, and the picture. */
  class MotionRecord
  {
  public:
    /** @param is_bar a bar, else point masses
     * @param mass where its mass sits */
    MotionRecord(const abut_time_scheme &scheme, unsigned int dimension,
                 bool is_bar, abut_time_mass mass);

    void declare_columns(Report &report) const;

    /** Add the start or the end of a step. False if the motion blows up, which
     * is told then. */
    bool add(Report &report, Motion &motion, double time);

    /** Warn if the scheme has made energy, or lost it. Returns whether it is
     * less than what leaves no answer. */
    bool judge_end(Report &report) const;

    void fill_summary(Report &report) const;

    /** A line of progress after step @p k of @p n. */
    std::string line(unsigned int k, unsigned int n) const;

  private:
    std::string cure_of_gain() const;
    void look_for_loss(Report &report, Motion &motion,
                       const abut_time_balance &before, double way);
    void look_for_depth(Report &report) const;

    struct Entry
    {
      double time, kinetic, strain, contact, dissipated, lost_in_impacts, work,
          force;
    };

    const abut_time_scheme scheme;
    const unsigned int dimension;
    const bool is_bar;
    const abut_time_mass mass;
    abut_time_balance balance;
    std::vector<Entry> entries;
    std::vector<double> momentum, impulse;
    double contact_begin = 0, contact_end = 0, largest_force = 0;
    bool gains = false, loses = false, lost = false;
    std::vector<double> first, displacement; ///< at the first and last entry
    double depth = 0, moved = 0;             ///< largest so far
    double gain_time = 0;
    double at_rest = 0; ///< energy that is round-off
  };
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_STEP_TABLE_H
#define ABUT_APP_STEP_TABLE_H

#include "report.h"

#include <abut/dealii/contact_solver_types.h>
#include <abut/dealii/solver_parameters.h>
#include <abut/strategy.h>

#include <filesystem>
#include <vector>

namespace abut::app
{
  /** `steps.csv`: a row per linear system of a contact iteration; and
   * `newton.csv`: a row per linearisation of a nonlinear problem. */
  class StepTable
  {
  public:
    /** Note a step and print a line of progress.
     * @param level of the mesh or number of the load step
     * @param step number within it */
    void add(Report &report, unsigned int level, unsigned int step,
             const abut_progress &progress, const LinearReport &linear);

    /** Note a step of Newton's method, and print a line of progress. */
    void add(Report &report, unsigned int load_step, unsigned int level,
             const NewtonStep &step);

    /** Write the tables into @p folder. Collective. */
    void write(MPI_Comm communicator,
               const std::filesystem::path &folder) const;

    /** What a checkpoint keeps. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &rows &newton;
    }

  private:
    using Rows = std::vector<std::vector<double>>;

    static void write(const std::filesystem::path &file,
                      const std::vector<std::string> &columns,
                      const Rows &rows);

    Rows rows, newton;
  };
} // namespace abut::app

#endif

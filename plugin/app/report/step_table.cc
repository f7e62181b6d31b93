// SPDX-License-Identifier: LGPL-2.1-or-later
#include "step_table.h"

#include "app/input/collective.h"
#include "app/input/short_number.h"
#include "app/restart/disk.h"

#include <deal.II/base/mpi.h>

#include <iomanip>
#include <sstream>

namespace abut::app
{
  namespace
  {
    const std::vector<std::string> columns = {
        "level",  "step",    "n_active", "n_changes",   "linear_iterations",
        "setups", "penalty", "barrier",  "penetration", "outer"};

    const std::vector<std::string> newton_columns = {
        "load_step", "level",    "linearisation", "part",
        "before",    "residual", "error"};
  } // namespace

  void StepTable::add(Report &report, const unsigned int level,
                      const unsigned int step, const abut_progress &progress,
                      const LinearReport &linear)
  {
    rows.push_back({double(level), double(step), double(progress.n_active),
                    double(progress.n_changes), double(linear.n_iterations),
                    double(linear.n_setups), progress.penalty, progress.barrier,
                    progress.penetration, double(progress.outer)});
    report.detail("  step " + std::to_string(step) + ": "
                  + std::to_string(progress.n_active) + " in contact, "
                  + std::to_string(progress.n_changes) + " changed, "
                  + std::to_string(linear.n_iterations) + " linear iterations");
  }

  void StepTable::add(Report &report, const unsigned int load_step,
                      const unsigned int level, const NewtonStep &step)
  {
    newton.push_back({double(load_step), double(level), double(step.number),
                      step.part, step.before, step.residual, step.error});
    report.detail("  linearisation " + std::to_string(step.number)
                  + ": forces out of balance " + short_number(step.before, 3)
                  + " -> " + short_number(step.residual, 3)
                  + (step.part < 1.
                         ? " by " + short_number(step.part, 3) + " of the step"
                         : std::string())
                  + ", error " + short_number(step.error, 2));
  }

  void StepTable::write(const std::filesystem::path &file,
                        const std::vector<std::string> &columns,
                        const Rows &rows)
  {
    std::ostringstream out;
    for (std::size_t i = 0; i < columns.size(); ++i)
      out << (i > 0 ? "," : "") << columns[i];
    out << '\n' << std::setprecision(17);
    for (const auto &row : rows)
    {
      for (std::size_t i = 0; i < row.size(); ++i)
        out << (i > 0 ? "," : "") << row[i];
      out << '\n';
    }
    replace_on_disk(file, out.str());
  }

  void StepTable::write(const MPI_Comm communicator,
                        const std::filesystem::path &folder) const
  {
    on_root(communicator,
            [&]
            {
              write(folder / "steps.csv", columns, rows);
              if (!newton.empty())
                write(folder / "newton.csv", newton_columns, newton);
            });
  }
} // namespace abut::app

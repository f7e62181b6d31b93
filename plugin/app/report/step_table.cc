// SPDX-License-Identifier: LGPL-2.1-or-later
#include "step_table.h"

#include "app/input/collective.h"
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
  }

  void StepTable::add(Report &report, const unsigned int level,
                      const unsigned int step, const abut_progress &progress,
                      const LinearReport &linear)
  {
    rows.push_back({double(level), double(step), double(progress.n_active),
                    double(progress.n_changes), double(linear.n_iterations),
                    double(linear.n_setups), progress.penalty, progress.barrier,
                    progress.penetration, double(progress.outer)});
    report.progress("  step " + std::to_string(step) + ": "
                    + std::to_string(progress.n_active) + " in contact, "
                    + std::to_string(progress.n_changes) + " changed, "
                    + std::to_string(linear.n_iterations)
                    + " linear iterations");
  }

  void StepTable::write(const MPI_Comm communicator,
                        const std::filesystem::path &folder) const
  {
    collective(communicator,
               [&]
               {
                 if (dealii::Utilities::MPI::this_mpi_process(communicator)
                     != 0)
                   return;
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
                 replace_on_disk(folder / "steps.csv", out.str());
               });
  }
} // namespace abut::app

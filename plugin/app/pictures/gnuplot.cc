// SPDX-License-Identifier: LGPL-2.1-or-later
#include "gnuplot.h"

#include "app/process/child_process.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace abut::app
{
  std::string gnuplot_header(const std::string &name, const unsigned int width,
                             const unsigned int height)
  {
    std::ostringstream out;
    out << "set terminal svg size " << width << "," << height
        << " font 'Helvetica,14' background '#ffffff' linewidth 1.2\n"
        << "set output '" << name << ".svg'\n"
        << "set encoding utf8\n";
    // Okabe and Ito's colours, told apart by colour-blind readers too.
    const char *const colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                   "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};
    for (unsigned int i = 0; i < 8; ++i)
      out << "set linetype " << i + 1 << " lw 1.8 lc rgb '" << colours[i]
          << "' pt " << 5 + 2 * (i % 4) << " ps 0.6\n";
    out << "set border 3 lc rgb '#404040'\n"
        << "set tics nomirror out textcolor rgb '#202020'\n"
        << "set grid back lt 8 lw 0.5 lc rgb '#d8d8d8' dt 1\n"
        << "set key opaque samplen 2 spacing 1.2\n"
        << "set style textbox opaque noborder margins 0.3,0.3\n";
    return out.str();
  }

  std::string gnuplot_data(const std::string &name,
                           const std::vector<std::vector<double>> &rows)
  {
    std::ostringstream out;
    out.precision(12);
    out << "$" << name << " << EOD\n";
    for (const std::vector<double> &row : rows)
    {
      bool finite = true;
      for (const double value : row)
        finite = finite && std::isfinite(value);
      if (finite)
        for (std::size_t i = 0; i < row.size(); ++i)
          out << (i == 0 ? "" : " ") << row[i];
      out << "\n";
    }
    out << "EOD\n";
    return out.str();
  }

  bool draw_picture(Report &report, const std::filesystem::path &folder,
                    const std::string &name, const std::string &script)
  {
    if (dealii::Utilities::MPI::this_mpi_process(report.communicator) != 0)
      return false;
    const std::string file = name + ".gp", log = name + ".log";
    {
      std::ofstream out(folder / file);
      out << script;
      if (!out.flush())
      {
        report.warn("picture " + name + ": cannot write "
                    + (folder / file).string());
        return false;
      }
    }
    ChildOptions child;
    child.folder = folder;
    child.log = log;
    const ChildResult gnuplot = run_child({"gnuplot", file}, child);
    if (gnuplot.well())
    {
      std::error_code ignored;
      std::filesystem::remove(folder / log, ignored);
      return true;
    }
    report.warn(
        "picture " + name
        + (gnuplot.ended == ChildResult::Ended::not_found
               ? " not made: gnuplot is not installed (on Debian: apt "
                 "install gnuplot-nox); the script is in "
                     + (folder / file).string()
               : " not made: gnuplot failed, see " + (folder / log).string()));
    return false;
  }
} // namespace abut::app

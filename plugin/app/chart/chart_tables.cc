// SPDX-License-Identifier: LGPL-2.1-or-later
#include "chart_output.h"

#include "app/input/short_number.h"
#include "app/report/json.h"

#include <sstream>

namespace abut::app
{
  namespace
  {
    /** A cell of a CSV file (RFC 4180). */
    std::string cell(const std::string &text)
    {
      if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
      std::string result = "\"";
      for (const char c : text)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
      return result + "\"";
    }

    std::string cell(const double number)
    {
      return std::isfinite(number) ? json_number(number) : "";
    }
  } // namespace

  std::string axis_name(const ChartCurve &curve)
  {
    std::string result;
    for (const std::string &path : curve.axis)
      result += (result.empty() ? "" : ", ") + path;
    return result;
  }

  std::string runs_csv(const ChartFile &chart,
                       const std::vector<ChartRow> &rows)
  {
    std::ostringstream out;
    out << "curve,axis,value,ended,exit_code,reason,x,quantity,error,time,"
           "processor_seconds,wall_seconds,fastest,slowest,repeats,matvecs,"
           "linear_iterations,nonlinear_iterations,dofs,constraints,active,"
           "peak_memory_mb,time_front,work_front,run\n";
    for (const ChartRow &row : rows)
    {
      const ChartCurve &curve = chart.curves[row.curve];
      out << cell(curve.name) << ',' << cell(axis_name(curve)) << ','
          << cell(row.value) << ',' << row.ended << ',' << row.code << ','
          << cell(row.reason);
      for (const double number :
           {row.x, row.quantity, row.error, row.time, row.processor_seconds,
            row.wall_seconds, row.fastest, row.slowest, double(row.repeats),
            row.matvecs, row.linear_iterations, row.nonlinear_iterations,
            row.dofs, row.constraints, row.active, row.peak_memory_mb})
        out << ',' << cell(number);
      out << ',' << row.time_front << ',' << row.work_front << ',' << row.key
          << '\n';
    }
    return out.str();
  }

  std::string cheapest_table(const ChartFile &chart,
                             const std::vector<ChartRow> &rows)
  {
    std::ostringstream head, line, body;
    head << "| " << chart.time << " (value along the axis) |";
    line << "|---|";
    for (const double target : chart.targets)
    {
      head << ' ' << short_number(100 * target, 6) << " % |";
      line << "---|";
    }
    for (std::size_t c = 0; c < chart.curves.size(); ++c)
    {
      body << "| " << chart.curves[c].name << " |";
      for (const double target : chart.targets)
      {
        const ChartRow *own = cheapest(rows, target, c);
        if (own == nullptr)
        {
          body << " - |";
          continue;
        }
        const char *bold =
            is_as_fast(*own, *cheapest(rows, target)) ? "**" : "";
        body << ' ' << bold << short_number(own->time, 3) << bold << " ("
             << own->value << ") |";
      }
      body << '\n';
    }
    return head.str() + "\n" + line.str() + "\n" + body.str();
  }
} // namespace abut::app

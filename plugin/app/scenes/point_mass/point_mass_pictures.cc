// SPDX-License-Identifier: LGPL-2.1-or-later
#include "point_mass_pictures.h"

#include "app/pictures/gnuplot.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::app
{
  namespace
  {
    /** The one mass and its one row, u_free where nothing touches, u_wall
     * where the gap is closed. */
    struct OneMass
    {
      explicit OneMass(const PointMassModel &model)
          : k(model.stiffness[0]),
            f(model.force[0]),
            b(model.rows[0][0]),
            g0(model.initial_gap[0]),
            row_stiffness(model.row_stiffness(0)),
            free(f / k),
            wall(-g0 / b)
      {
        const double span = std::abs(free - wall) > 0 ? std::abs(free - wall)
                                                      : model.length_scale();
        low = std::min(free, wall) - 0.75 * span;
        high = std::max(free, wall) + 0.5 * span;
      }

      /** Contact force p at the wall, our sign: positive = compression. */
      double wall_force() const
      {
        return (k * wall - f) / b;
      }

      double k, f, b, g0, row_stiffness, free, wall, low, high;
    };

    /** 1000 and 1e6 rather than 1000000. */
    std::string penalty_text(const double value)
    {
      const double exponent = std::round(std::log10(value));
      std::ostringstream out;
      if (exponent > 3 && std::pow(10., exponent) == value)
        out << "10^{" << exponent << "}";
      else
        out << value;
      return out.str();
    }

    std::string functions(const OneMass &m)
    {
      std::ostringstream out;
      out.precision(16);
      out << "E(u) = 0.5 * " << m.k << " * u**2 - (" << m.f << ") * u\n"
          << "g(u) = (" << m.g0 << ") + (" << m.b << ") * u\n"
          << "P(u, eps) = E(u) + (g(u) < 0 ? 0.5 * eps * g(u)**2 : 0)\n"
          << "wall = " << m.wall << "\n"
          << "low = " << m.low << "\nhigh = " << m.high << "\n";
      return out.str();
    }

    PointMassSolution solve_by_penalty(const PointMassModel &model,
                                       abut_strategy_options options,
                                       const double penalty)
    {
      options.law = abut_law_find("penalty");
      options.penalty = penalty;
      return solve(model, options);
    }

    std::string energy_script(const PointMassModel &model, const OneMass &m,
                              const abut_strategy_options &options,
                              const std::vector<double> &penalties)
    {
      std::ostringstream out;
      out.precision(12);
      out << gnuplot_header("energy") << functions(m);
      std::vector<std::vector<double>> minima;
      for (const double penalty : penalties)
      {
        const double u =
            solve_by_penalty(model, options, penalty).displacement[0];
        minima.push_back({u, 0, penalty * m.row_stiffness});
      }
      out << gnuplot_data("minima", minima);
      const bool inside_left = m.b < 0;
      // Room above the lowest energy and the energy at the wall.
      const double at_wall = 0.5 * m.k * m.wall * m.wall - m.f * m.wall,
                   lowest = 0.5 * m.k * m.free * m.free - m.f * m.free,
                   height = std::max(std::abs(at_wall), at_wall - lowest);
      out << "set samples 900\nset xrange [low:high]\nset yrange ["
          << lowest - 0.4 * height << ":" << at_wall + 1.6 * height << "]\n"
          << "set xlabel 'displacement u'\nset ylabel 'energy'\n"
          << "set title 'Energy of a mass on a spring, with springs for an "
             "obstacle'\n"
          << "set key outside right top vertical Left reverse\n"
          << "set object 1 rectangle from wall, graph 0 to "
          << (inside_left ? "high" : "low")
          << ", graph 1 fc rgb '#e4e4e4' fs solid noborder behind\n"
          << "set label 1 'obstacle' at wall, graph 0.96 offset "
          << (inside_left ? "1,0 left" : "-1,0 right") << " tc rgb '#707070'\n"
          << "plot E(x) lt 8 dt 2 title 'no obstacle'";
      for (std::size_t i = 0; i < penalties.size(); ++i)
        out << ", \\\n  P(x, " << penalties[i] * m.row_stiffness << ") lt "
            << i % 6 + 1 << " title 'penalty " << penalty_text(penalties[i])
            << "'";
      out << ", \\\n  $minima using 1:(P($1, $3)) with points pt 7 ps 0.8 lc "
             "rgb 'black' title 'minima'\n";
      return out.str();
    }

    std::string penalty_script(const PointMassModel &model, const OneMass &m,
                               const abut_strategy_options &options,
                               const std::vector<double> &penalties)
    {
      std::vector<std::vector<double>> curve, marks;
      const auto [low, high] =
          std::minmax_element(penalties.begin(), penalties.end());
      const double first = std::log10(*low) - 1, last = std::log10(*high);
      const int n = 80;
      for (int i = 0; i <= n; ++i)
      {
        const double penalty = std::pow(10., first + (last - first) * i / n);
        const PointMassSolution s = solve_by_penalty(model, options, penalty);
        curve.push_back({penalty, s.displacement[0], s.pressure[0]});
      }
      for (const double penalty : penalties)
      {
        const PointMassSolution s = solve_by_penalty(model, options, penalty);
        marks.push_back({penalty, s.displacement[0], s.pressure[0]});
      }
      const double top =
          1.12
          * std::max({m.free, m.wall, m.wall_force(), 0.1 * std::abs(m.free)});
      const double bottom = std::min({0., m.free, m.wall, m.wall_force()});
      std::ostringstream out;
      out.precision(12);
      out << gnuplot_header("penalty") << gnuplot_data("curve", curve)
          << gnuplot_data("marks", marks)
          << "set logscale x\nset format x '10^{%L}'\n"
          << "set xlabel 'penalty / stiffness'\n"
          << "set ylabel 'displacement u, contact force p'\n"
          << "set title 'A penalty approaches the obstacle and its force'\n"
          << "set yrange [" << 1.12 * bottom << ":" << top << "]\n"
          << "set key right top\nset xrange [" << std::pow(10., first) << ":"
          << *high << "]\n"
          << "plot " << m.wall << " lt 1 dt 2 lw 1 title 'u at the obstacle', "
          << m.wall_force()
          << " lt 2 dt 2 lw 1 title 'exact contact force', \\\n"
          << "  $curve using 1:2 with lines lt 1 title 'displacement u', "
          << "$curve using 1:3 with lines lt 2 title 'contact force p', \\\n"
          << "  $marks using 1:2 with points lt 1 pt 7 notitle, "
          << "$marks using 1:3 with points lt 2 pt 7 notitle\n";
      return out.str();
    }

    /** Contours in colour, because an image in an SVG is scaled differently by
     * different viewers. */
    std::string lagrangian_script(const OneMass &m)
    {
      const double lambda = -m.wall_force(),
                   span = std::max(std::abs(lambda), std::abs(m.f)),
                   bottom = lambda - span, top = lambda + span;
      std::ostringstream out;
      out.precision(12);
      out << gnuplot_header("lagrangian", 700, 520) << functions(m)
          << "L(u, lambda) = E(u) + lambda * g(u)\n"
          << "bottom = " << bottom << "\ntop = " << top
          << "\nlambda = " << lambda << "\nsaddle = L(wall, lambda)\n"
          << "max(a, b) = a > b ? a : b\n"
          << "reach = max(max(abs(L(high, bottom) - saddle), "
             "abs(L(high, top) - saddle)), max(abs(L(low, bottom) - saddle), "
             "abs(L(low, top) - saddle)))\n"
          << "set xrange [low:high]\nset yrange [bottom:top]\n"
          << "set isosamples 81\nset samples 81\n"
          << "set contour base\nunset surface\nset cntrparam levels "
             "incremental saddle - reach, reach / 28, saddle + reach\n"
          << "set table $contours\nsplot L(x, y)\nunset table\n"
          << "set palette defined (0 '#08306b', 0.3 '#4a90c4', 0.5 '#909090', "
             "0.7 '#e08030', 1 '#7f2704')\n"
          << "set cbrange [saddle - reach / 2:saddle + reach / 2]\n"
          << "set cblabel 'Lagrangian L(u, \316\273)'\n"
          << "set colorbox noborder\n"
          << "set xlabel 'displacement u'\n"
          << "set ylabel 'multiplier \316\273 = - contact force p'\n"
          << "set title 'The Lagrangian and its saddle point'\n"
          << "set border 15\nunset grid\nset bmargin 6\nset key below "
             "noopaque\n"
          << "set label 1 sprintf('saddle: u = %.4g, \316\273 = %.4g', wall, "
             "lambda) at wall, lambda offset 1.5,-1 boxed front\n"
          << "set arrow 1 from wall, bottom to wall, top nohead dt 2 lw 1.2 lc "
             "rgb 'black'\n"
          << "plot $contours using 1:2:3 with lines lc palette lw 1 notitle, "
             "\\\n  ("
          << m.k << " * x - (" << m.f << ")) / (" << -m.b
          << ") with lines dt 3 lw 1.4 lc rgb 'black' title "
             "'{/:Italic dL/du} = 0', \\\n"
          << "  NaN with lines dt 2 lw 1.2 lc rgb 'black' title "
             "'{/:Italic dL/d}\316\273 = 0 (gap closed)', \\\n"
          << "  '-' using 1:2 with points pt 7 ps 1.2 lc rgb 'black' notitle\n"
          << m.wall << " " << lambda << "\ne\n";
      return out.str();
    }

    std::string path_script(const PointMassModel &model,
                            const PointMassSolution &solution)
    {
      std::vector<std::vector<double>> path = {model.start};
      for (const PointMassStep &step : solution.history)
        path.push_back(step.displacement);
      double center[2], span = 0;
      for (unsigned int i = 0; i < 2; ++i)
      {
        double low = path[0][i], high = path[0][i];
        for (const std::vector<double> &u : path)
        {
          low = std::min(low, u[i]);
          high = std::max(high, u[i]);
        }
        center[i] = 0.5 * (low + high);
        span = std::max(span, high - low);
      }
      if (span == 0)
        span = model.length_scale();
      std::ostringstream out;
      out.precision(12);
      out << gnuplot_header("path", 620, 600) << gnuplot_data("path", path)
          << "E(x, y) = 0.5 * (" << model.stiffness[0] << " * x**2 + "
          << model.stiffness[1] + model.stiffness[2] << " * x * y + "
          << model.stiffness[3] << " * y**2) - (" << model.force[0]
          << ") * x - (" << model.force[1] << ") * y\n"
          << "set xrange [" << center[0] - span << ":" << center[0] + span
          << "]\nset yrange [" << center[1] - span << ":" << center[1] + span
          << "]\nset size ratio -1\nset border 15\n"
          << "set isosamples 81\nset samples 81\n"
          << "set contour base\nunset surface\nset cntrparam levels 16\n"
          << "set table $contours\nsplot E(x, y)\nunset table\n"
          << "set xlabel 'u_1'\nset ylabel 'u_2'\n"
          << "set title 'Outer steps on the contours of the energy'\n"
          << "set key bottom left box lc rgb '#c0c0c0'\n";
      std::string constraints;
      for (std::size_t i = 0; i < model.rows.size(); ++i)
      {
        const double a = model.rows[i][0], b = model.rows[i][1],
                     g = model.initial_gap[i];
        std::ostringstream line;
        line.precision(12);
        if (b != 0)
          line << "  '+' using 1:((" << -g << " - (" << a << ") * $1) / (" << b
               << "))";
        else
          line << "  '+' using (" << -g / a << "):($0 / 80. * " << 2 * span
               << " + " << center[1] - span << ")";
        constraints += line.str() + " with lines lt 2 title '"
                       + (i == 0 ? "gap closed" : "") + "', \\\n";
      }
      out << "plot $contours using 1:2 with lines lc rgb '#a0b8cc' lw 0.8 "
             "title 'energy', \\\n"
          << constraints
          << "  $path using 1:2 with linespoints lt 1 pt 7 ps 0.6 title "
             "'outer steps'\n";
      return out.str();
    }
  } // namespace

  void draw_point_mass(const PointMassModel &model,
                       const abut_strategy_options &options,
                       const PointMassSolution &solution,
                       const std::vector<double> &penalties,
                       const std::filesystem::path &folder, Report &report)
  {
    if (model.n() == 1 && model.rows.size() == 1 && !model.equality[0]
        && !penalties.empty())
    {
      const OneMass mass(model);
      draw_picture(report, folder, "energy",
                   energy_script(model, mass, options, penalties));
      draw_picture(report, folder, "penalty",
                   penalty_script(model, mass, options, penalties));
      draw_picture(report, folder, "lagrangian", lagrangian_script(mass));
    }
    else if (model.n() == 2)
      draw_picture(report, folder, "path", path_script(model, solution));
    else
      report.warn("no pictures: they are drawn for one mass with one "
                  "inequality and penalties to sweep, and for two masses.");
  }
} // namespace abut::app

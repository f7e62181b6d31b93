// SPDX-License-Identifier: LGPL-2.1-or-later

#include "body_pictures.h"

#include "app/physics/scalar_field.h"
#include "app/physics/stress_output.h"
#include "gnuplot.h"
#include "picture_parts.h"
#include "raster.h"
#include "shim/by_element.h"
#include "shim/cell_quadrature.h"
#include "zero_line.h"

#include <abut/dealii/mapping_by_cell.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q_eulerian.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace abut::app
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();

    /** A line with this in it is an empty one: the curve begins anew. */
    const std::vector<double> interruption = {none};

    /** Factor 1, 2 or 5 times a power of ten, at least 1, that makes the
     * largest displacement about a fortieth to a sixteenth of the
     * bodies' size. */
    double exaggeration(const dealii::DoFHandler<2> &dof_handler,
                        const la::Vector &displacement)
    {
      double low[2] = {std::numeric_limits<double>::infinity(),
                       std::numeric_limits<double>::infinity()};
      double high[2] = {-low[0], -low[1]};
      for (const auto &cell :
           dof_handler.get_triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            for (unsigned int d = 0; d < 2; ++d)
            {
              low[d] = std::min(low[d], cell->vertex(v)[d]);
              high[d] = std::max(high[d], cell->vertex(v)[d]);
            }
      const MPI_Comm communicator = versions::communicator(dof_handler);
      double size = 0;
      for (unsigned int d = 0; d < 2; ++d)
        size = std::max(size, MPI::max(high[d], communicator)
                                  - MPI::min(low[d], communicator));
      const double largest = displacement.linfty_norm();
      if (!(largest > 0.) || largest > size / 50)
        return 1.;
      return std::max(1., level_step(size / largest / 4));
    }

    /** Triangles whose vertices are displaced; edges stay straight. Knows
     * vertices only. */
    class DisplacedVertices : public dealii::MappingFE<2>
    {
    public:
      using Cell = dealii::Triangulation<2>::cell_iterator;
      using Vertices =
          decltype(std::declval<const dealii::Mapping<2> &>().get_vertices(
              std::declval<Cell>()));

      /** Both must outlive it; @p displacement with ghosts. */
      DisplacedVertices(const dealii::DoFHandler<2> &dof_handler,
                        const la::Vector &displacement)
          : dealii::MappingFE<2>(dealii::FE_SimplexP<2>(1)),
            dof_handler(dof_handler),
            displacement(displacement)
      {
      }

      std::unique_ptr<dealii::Mapping<2>> clone() const override
      {
        return std::make_unique<DisplacedVertices>(dof_handler, displacement);
      }

      bool preserves_vertex_locations() const override
      {
        return false;
      }

      Vertices get_vertices(const Cell &cell) const override
      {
        Vertices vertices = dealii::MappingFE<2>::get_vertices(cell);
        const dealii::DoFHandler<2>::cell_iterator dofs(
            &dof_handler.get_triangulation(), cell->level(), cell->index(),
            &dof_handler);
        for (unsigned int v = 0; v < vertices.size(); ++v)
          for (unsigned int d = 0; d < 2; ++d)
            vertices[v][d] += displacement(dofs->vertex_dof_index(v, d));
        return vertices;
      }

    private:
      const dealii::DoFHandler<2> &dof_handler;
      const la::Vector &displacement;
    };

    /** The vertices that a picture shows, and the cells between them. */
    std::unique_ptr<dealii::Mapping<2>>
    displaced(const dealii::DoFHandler<2> &dof_handler,
              const la::Vector &displacement)
    {
      using Cubes = dealii::MappingQEulerian<2, la::Vector>;
      const DisplacedVertices simplices(dof_handler, displacement);
      dealii::hp::MappingCollection<2> mappings;
      for (const dealii::FiniteElement<2> *fe : shim::elements(dof_handler))
        if (shim::is_simplex(*fe))
          mappings.push_back(simplices);
        else
          mappings.push_back(Cubes(fe->degree, dof_handler, displacement));
      return mappings.size() == 1
                 ? mappings[0].clone()
                 : std::make_unique<MappingByCell<2>>(mappings);
    }

    /** Edges of all boundary faces, two lines each and an interruption. */
    std::vector<std::vector<double>>
    outline(const dealii::Mapping<2> &mapping,
            const dealii::Triangulation<2> &mesh, const MPI_Comm communicator)
    {
      std::vector<std::vector<double>> mine;
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
        {
          const auto vertices = mapping.get_vertices(cell);
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
            {
              for (unsigned int v = 0; v < 2; ++v)
                for (const unsigned int k : cell->vertex_indices())
                  if (cell->vertex_index(k) == face->vertex_index(v))
                    mine.push_back({vertices[k][0], vertices[k][1]});
              mine.push_back(interruption);
            }
        }
      std::vector<std::vector<double>> all;
      for (const auto &part : MPI::gather(communicator, mine))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }

    std::vector<std::vector<double>>
    pressure_rows(const std::vector<ContactLine> &lines)
    {
      std::vector<std::vector<double>> rows;
      for (const ContactLine &line : lines)
      {
        for (const ContactLineNode &node : line)
          rows.push_back({node.arc, node.pressure, node.friction});
        rows.push_back(interruption);
      }
      return rows;
    }

    /** What the picture shows: the bodies, and a strip around them where
     * surfaces of obstacles are. */
    Raster frame_of(const Raster &bodies, const bool with_obstacles)
    {
      Raster frame(bodies);
      if (!with_obstacles)
        return frame;
      const double strip =
          0.08
          * std::max(bodies.x_max - bodies.x_min, bodies.y_max - bodies.y_min);
      frame.x_min -= strip;
      frame.x_max += strip;
      frame.y_min -= strip;
      frame.y_max += strip;
      return frame;
    }

    /** Surfaces of obstacles, moved @p factor times as far as they are. */
    std::vector<std::vector<double>>
    surfaces(const std::vector<DrawnObstacle> &obstacles, const Raster &frame,
             const double factor)
    {
      std::vector<std::vector<double>> rows;
      for (const DrawnObstacle &obstacle : obstacles)
      {
        const auto distance = [&](const dealii::Point<2> &drawn)
        {
          std::vector<double> result;
          try
          {
            obstacle.shape->distance({drawn - (factor - 1.) * obstacle.motion},
                                     result);
          }
          catch (const std::exception &)
          {
            return none; // a formula without a value there
          }
          return result[0];
        };
        const auto lines = zero_line(frame, 160, distance);
        rows.insert(rows.end(), lines.begin(), lines.end());
      }
      return rows;
    }

    /** The map of the stress, in the upper part of the picture. */
    std::string map_script(const Raster &raster, const Raster &frame,
                           const bool with_obstacles, const double bottom)
    {
      auto [low, high] = value_range(raster.fields.at(0));
      if (!(high - low > 1e-5 * std::abs(high))) // all but the same everywhere
      {
        low -= 0.5 * std::abs(low);
        high = high > low ? high + 0.5 * std::abs(high) : low + 1.;
      }
      std::ostringstream script;
      script << "set origin 0, " << bottom << "\nset size 1, " << 0.95 - bottom
             << '\n'
             << palette() << ranges(frame) << "set cbrange [" << low << ':'
             << high << "]\nset size ratio -1\nunset key\nunset grid\n"
             << "set format cb '%g'\nset xlabel 'x'\nset ylabel 'y'\n"
             << "set cblabel 'von Mises stress' offset 2\n"
             << "plot $stress using 1:2:3 with image, "
             << "$outline using 1:2 with lines lc rgb '#303030' lw 0.8"
             << (with_obstacles ? ", $obstacles using 1:2 with lines lc rgb "
                                  "'#000000' lw 2.2"
                                : "")
             << '\n';
      return script.str();
    }

    /** Range of lengths in which there is pressure, with as much again on
     * both sides; all of the lines if there is none. */
    std::string pressed_range(const std::vector<PressureCurve> &pressures)
    {
      double largest = 0;
      double end = 0;
      for (const PressureCurve &curve : pressures)
        for (const ContactLine &line : curve.lines)
          for (const ContactLineNode &node : line)
          {
            largest = std::max(largest, node.pressure);
            end = std::max(end, node.arc);
          }
      double low = end;
      double high = 0;
      for (const PressureCurve &curve : pressures)
        for (const ContactLine &line : curve.lines)
          for (const ContactLineNode &node : line)
            if (node.pressure > 1e-6 * largest)
            {
              low = std::min(low, node.arc);
              high = std::max(high, node.arc);
            }
      const double width = high - low;
      if (!(width > 0.))
        return "";
      std::ostringstream out;
      out << "set xrange [" << std::max(0., low - width) << ':'
          << std::min(end, high + width) << "]\n";
      return out.str();
    }

    std::string pressure_script(const std::vector<PressureCurve> &pressures,
                                const double top)
    {
      std::vector<double> values = {0.};
      for (const PressureCurve &curve : pressures)
        for (const ContactLine &line : curve.lines)
          for (const ContactLineNode &node : line)
          {
            values.push_back(node.pressure);
            values.push_back(node.friction);
          }
      std::ostringstream script;
      script << "set origin 0, 0\nset size noratio 1, " << top
             << "\nset autoscale\n"
             << pressed_range(pressures) << fitted_axis('y', values, false)
             << "set grid\nset key top right\n"
             << "set xlabel 'length along the contact line'\n"
             << "set ylabel 'contact pressure'\n";
      for (std::size_t i = 0; i < pressures.size(); ++i)
      {
        script << (i == 0 ? "plot $pressure" : ", $pressure") << i + 1
               << " using 1:2 with linespoints ls " << i % 8 + 1 << " title "
               << quoted(pressures[i].label);
        if (pressures[i].has_friction)
          script << ", $pressure" << i + 1
                 << " using 1:3 with lines dashtype 2 linewidth 2 linecolor "
                    "rgb '#555555' title "
                 << quoted(pressures[i].label + ", friction");
      }
      script << '\n';
      return script.str();
    }
  } // namespace

  bool draw_bodies(Report &report, const std::filesystem::path &folder,
                   const std::string &name, const dealii::Mapping<2> &mapping,
                   const dealii::DoFHandler<2> &dof_handler,
                   const la::Vector &displacement,
                   const Materials<2> &materials,
                   const std::vector<PressureCurve> &pressures,
                   const std::vector<DrawnObstacle> &obstacles,
                   const std::string &title)
  {
    const double factor = exaggeration(dof_handler, displacement);
    la::Vector drawn(displacement);
    drawn *= factor;
    const std::unique_ptr<dealii::Mapping<2>> deformed =
        displaced(dof_handler, drawn);
    dealii::DoFHandler<2> scalar(dof_handler.get_triangulation());
    distribute_linear(dof_handler, scalar);
    const std::vector<la::Vector> stresses =
        nodal_stress(mapping, dof_handler, displacement, materials, scalar);
    const Raster raster =
        sample_raster(*deformed, scalar, {{&stresses.back()}}, 240);
    const auto edges = outline(*deformed, dof_handler.get_triangulation(),
                               versions::communicator(dof_handler));
    if (MPI::this_mpi_process(report.communicator) != 0)
      return false;

    const Raster frame = frame_of(raster, !obstacles.empty());
    const auto drawn_obstacles = surfaces(obstacles, frame, factor);
    const unsigned int below = pressures.empty() ? 0 : 280;
    const unsigned int height = map_height(frame, 440, 110) + below;
    std::ostringstream text;
    text << title;
    if (factor > 1.)
      text << ", displacement drawn " << factor << " times";
    std::ostringstream script;
    script << gnuplot_header(name, 760, height)
           << grid_block("stress", raster, raster.fields.at(0), 1)
           << gnuplot_data("outline", edges);
    if (!drawn_obstacles.empty())
      script << gnuplot_data("obstacles", drawn_obstacles);
    for (std::size_t i = 0; i < pressures.size(); ++i)
      script << gnuplot_data("pressure" + std::to_string(i + 1),
                             pressure_rows(pressures[i].lines));
    const double share = double(below) / height;
    script << "set multiplot title " << quoted(text.str()) << " font ',15'\n"
           << map_script(raster, frame, !drawn_obstacles.empty(), share);
    if (!pressures.empty())
      script << pressure_script(pressures, share);
    script << "unset multiplot\n";
    return draw_picture(report, folder, name, script.str());
  }
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacle_parameters.h"

#include "input_error.h"

#include <limits>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;

    void declare_membrane(ParameterHandler &prm)
    {
      prm.enter_subsection("Membrane");
      prm.declare_entry("Degree", "1", Patterns::Integer(1, 2),
                        "Polynomial degree of the displacement: 1 or 2.");
      prm.declare_entry("Conductivity", "1", Patterns::Anything(),
                        "k in -div(k grad u) = f + p: a formula in x, y, z, "
                        "positive. A tension, for a membrane.");
      prm.declare_entry("Load", "0", Patterns::Anything(),
                        "f, force per area (2D): a formula in x, y, z.");
      prm.declare_entry("Dirichlet", "*: 0", Patterns::Anything(),
                        "Prescribed displacements by boundary id, `0: 0; 1, "
                        "2: x^2; *: sin(pi*y)`; * means all other ids. Ids "
                        "that are not named are free.");
      prm.declare_entry("Neumann", "", Patterns::Anything(),
                        "Prescribed fluxes k du/dn by boundary id, written "
                        "like `Dirichlet`.");
      prm.leave_subsection();
    }

    void declare_contact(ParameterHandler &prm)
    {
      prm.enter_subsection("Contact");
      prm.declare_entry("Obstacle", "", Patterns::Anything(),
                        "psi in u >= psi: a formula in x, y, z. Empty: none, "
                        "or the height map.");
      prm.declare_entry("Upper obstacle", "", Patterns::Anything(),
                        "psi2 in u <= psi2: a formula. Empty: none.");
      prm.declare_entry("Boundary ids", "", Patterns::Anything(),
                        "Where contact is possible: boundary ids such as `0, "
                        "2` (a scalar Signorini problem), or empty for the "
                        "whole domain.");
      HeightMapParameters::declare(prm);
      prm.leave_subsection();
    }

    void declare_refinement(ParameterHandler &prm)
    {
      prm.enter_subsection("Refinement");
      prm.declare_entry("Level", "5", Patterns::Integer(0, 30),
                        "Uniform refinements of the coarse mesh.");
      prm.declare_entry("Coarsest level", "3", Patterns::Integer(0, 30),
                        "Level on which nested iteration begins; at most "
                        "`Level`.");
      prm.declare_entry("Nested iteration", "true", Patterns::Bool(),
                        "Solve on all levels from the coarsest on, each "
                        "started from the one before. Off: solve on `Level` "
                        "from displacement 0.");
      prm.declare_entry("Coarse level tolerance", "1e-3",
                        Patterns::Double(0., 1.),
                        "Linear, gap and pressure tolerance in the end on all "
                        "meshes but the last, whose results are only a start "
                        "(a thousandth of it for the barrier). Meshes whose "
                        "results "
                        "are wanted (an exact solution is given, or `All "
                        "levels`) are solved to `Method/Final linear "
                        "tolerance`.");
      prm.declare_entry("Relaxation sweeps", "3", Patterns::Integer(0),
                        "Symmetric projected Gauss-Seidel sweeps that improve "
                        "each start of nested iteration.");
      prm.declare_entry("Adaptive cycles", "0", Patterns::Integer(0),
                        "Further meshes, refined where the error estimate is "
                        "large.");
      prm.declare_entry("Refine fraction", "0.6", Patterns::Double(0., 1.),
                        "Part of the squared error estimate whose cells are "
                        "refined in an adaptive cycle.");
      prm.declare_entry("Coarsen fraction", "0.02", Patterns::Double(0., 1.),
                        "Part of it whose cells are coarsened.");
      prm.leave_subsection();
    }

    void declare_results(ParameterHandler &prm)
    {
      prm.enter_subsection("Exact solution");
      prm.declare_entry("Displacement", "", Patterns::Anything(),
                        "A formula; if given, errors are computed.");
      prm.declare_entry("Gradient", "", Patterns::Anything(),
                        "Its gradient, `du/dx; du/dy`. Empty: by differences.");
      prm.declare_entry("Energy", "nan", Patterns::Anything(),
                        "Energy of the exact solution; nan: not known.");
      prm.declare_entry("Contact force", "nan", Patterns::Anything(),
                        "Contact force of the exact solution; nan: not known.");
      prm.leave_subsection();

      prm.enter_subsection("Output");
      prm.declare_entry("Fields", "true", Patterns::Bool(),
                        "Write displacement, pressure, gap and status as VTU "
                        "and PVD files for ParaView.");
      prm.declare_entry("All levels", "false", Patterns::Bool(),
                        "Write fields on every level, not only on the last.");
      prm.declare_entry("Nodal values", "false", Patterns::Bool(),
                        "Write the fields at all nodes of the last level as "
                        "nodal.csv.");
      prm.declare_entry("Linear solves for comparison", "0",
                        Patterns::Integer(0),
                        "Solve the problem without obstacle (assembly, ML, CG "
                        "to 1e-10) this many times on the last mesh and "
                        "report the contact solve's time as a multiple of the "
                        "median.");
      prm.leave_subsection();
    }

    double number_or_nan(const std::string &text, const std::string &parameter)
    {
      if (text == "nan" || text.empty())
        return std::numeric_limits<double>::quiet_NaN();
      try
      {
        std::size_t end = 0;
        const double value = std::stod(text, &end);
        if (end == text.size())
          return value;
      }
      catch (const std::exception &)
      {
      }
      throw InputError(parameter, "'" + text + "' is not a number.");
    }
  } // namespace

  void ObstacleParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    MeshParameters::declare(prm);
    prm.leave_subsection();
    declare_membrane(prm);
    declare_contact(prm);
    declare_refinement(prm);
    declare_results(prm);
  }

  void ObstacleParameters::parse(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    mesh.parse(prm, "Mesh");
    prm.leave_subsection();

    prm.enter_subsection("Membrane");
    degree = prm.get_integer("Degree");
    conductivity = prm.get("Conductivity");
    load = prm.get("Load");
    dirichlet = prm.get("Dirichlet");
    neumann = prm.get("Neumann");
    prm.leave_subsection();

    prm.enter_subsection("Contact");
    obstacle = prm.get("Obstacle");
    upper_obstacle = prm.get("Upper obstacle");
    boundary_ids = prm.get("Boundary ids");
    height_map.parse(prm, "Contact");
    prm.leave_subsection();
    if (!obstacle.empty() && !height_map.file.empty())
      throw InputError("Contact/Obstacle",
                       "There is a height map too: give one of the two.");
    if (obstacle.empty() && height_map.file.empty() && upper_obstacle.empty())
      throw InputError("Contact/Obstacle",
                       "There is no obstacle: give a formula, a height map or "
                       "an upper obstacle.");

    prm.enter_subsection("Refinement");
    level = prm.get_integer("Level");
    coarsest_level = prm.get_integer("Coarsest level");
    nested = prm.get_bool("Nested iteration");
    relaxation_sweeps = prm.get_integer("Relaxation sweeps");
    coarse_tolerance = prm.get_double("Coarse level tolerance");
    adaptive_cycles = prm.get_integer("Adaptive cycles");
    refine_fraction = prm.get_double("Refine fraction");
    coarsen_fraction = prm.get_double("Coarsen fraction");
    prm.leave_subsection();
    coarsest_level = std::min(coarsest_level, level);
    if (refine_fraction + coarsen_fraction > 1.)
      throw InputError("Refinement/Coarsen fraction",
                       "The fractions that are refined and coarsened add up "
                       "to more than 1.");

    prm.enter_subsection("Exact solution");
    exact_displacement = prm.get("Displacement");
    exact_gradient = prm.get("Gradient");
    exact_energy = number_or_nan(prm.get("Energy"), "Exact solution/Energy");
    exact_force =
        number_or_nan(prm.get("Contact force"), "Exact solution/Contact force");
    prm.leave_subsection();

    prm.enter_subsection("Output");
    fields = prm.get_bool("Fields");
    all_levels = prm.get_bool("All levels");
    nodal_values = prm.get_bool("Nodal values");
    linear_solves = prm.get_integer("Linear solves for comparison");
    prm.leave_subsection();
  }
} // namespace abut::app

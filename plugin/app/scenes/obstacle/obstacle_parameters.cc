// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacle_parameters.h"

#include "app/input/formula_pattern.h"
#include "app/input/input_error.h"
#include "app/input/parameters.h"

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
      prm.declare_entry("Conductivity", "1", FormulaPattern::one(),
                        "k in -div(k grad u) = f + p: a formula in x, y, z, "
                        "positive. A tension, for a membrane.");
      prm.declare_entry("Load", "0", FormulaPattern::one(),
                        "f, force per area (2D): a formula in x, y, z and, of "
                        "what moves (section `Time`), t, which loads, "
                        "prescribed values and obstacles may depend on.");
      prm.declare_entry("Density", "0", FormulaPattern::one(),
                        "Of what moves: mass per area (2D), a formula in x, y, "
                        "z, positive.");
      prm.declare_entry("Initial displacement", "", FormulaPattern::one(),
                        "Of what moves: a formula. Empty: 0.");
      prm.declare_entry("Initial velocity", "", FormulaPattern::one(),
                        "Of what moves: a formula. Empty: at rest.");
      prm.declare_entry("Dirichlet", "*: 0", FormulaPattern::by_id(),
                        "Prescribed displacements by boundary id, `0: 0; 1, "
                        "2: x^2; *: sin(pi*y)`; * means all other ids. Ids "
                        "that are not named are free.");
      prm.declare_entry("Neumann", "", FormulaPattern::by_id(),
                        "Prescribed fluxes k du/dn by boundary id, written "
                        "like `Dirichlet`.");
      prm.leave_subsection();
    }

    void declare_contact(ParameterHandler &prm)
    {
      prm.enter_subsection("Contact");
      prm.declare_entry("Obstacle", "", FormulaPattern::one(),
                        "psi in u >= psi: a formula in x, y, z. Empty: none, "
                        "or the height map.");
      prm.declare_entry("Upper obstacle", "", FormulaPattern::one(),
                        "psi2 in u <= psi2: a formula. Empty: none.");
      prm.declare_entry("Boundary ids", "", Patterns::Anything(),
                        "Where contact is possible: boundary ids such as `0, "
                        "2` (a scalar Signorini problem), or empty for the "
                        "whole domain.");
      HeightMapParameters::declare(prm);
      prm.leave_subsection();
    }

    void declare_results(ParameterHandler &prm)
    {
      prm.enter_subsection("Exact solution");
      prm.declare_entry("Displacement", "", FormulaPattern::one(),
                        "A formula; if given, errors are computed.");
      prm.declare_entry("Gradient", "", FormulaPattern::vector(),
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
      prm.declare_entry("Every", "1", Patterns::Integer(1),
                        "Write fields after every so many steps of a motion, "
                        "and at its end.");
      prm.declare_entry("All levels", "false", Patterns::Bool(),
                        "Write fields on every level, not only on the last.");
      prm.declare_entry("Nodal values", "false", Patterns::Bool(),
                        "Write fields and forces at all nodes of the last "
                        "level as nodal.csv, with all digits.");
      prm.declare_entry("Linear solves for comparison", "0",
                        Patterns::Integer(0),
                        "Solve the problem without obstacle (assembly, ML, CG "
                        "to 1e-10) this many times on the last mesh and "
                        "report the contact solve's time as a multiple of the "
                        "median.");
      prm.leave_subsection();
    }
  } // namespace

  void ObstacleParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Mesh");
    MeshParameters::declare(prm);
    prm.leave_subsection();
    declare_membrane(prm);
    declare_contact(prm);
    InertiaParameters::declare(
        prm,
        "none|contact stabilised|hht|trapezoid|midpoint|newmark|generalised "
        "alpha|central difference with projection",
        "A step that fails is halved, down to a thousandth.");
    RefinementParameters::declare(prm, "5", "3");
    declare_results(prm);
  }

  void ObstacleParameters::begin_motion()
  {
    if (time.mass == ABUT_TIME_MASS_MODIFIED && boundary_ids.empty())
      throw InputError(
          "Time/Mass",
          std::string(time.scheme.name)
              + " with modified mass takes it from all nodes that may touch "
                "and hands it to neighbours that may not, of which a membrane "
                "over an obstacle has none. Set Time/Scheme = contact "
                "stabilised, which needs none, or Time/Mass = consistent, with "
                "which impacts ring.");
    time.fit(refinement);
    load_steps = time.steps(load_steps);
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
    density = prm.get("Density");
    initial_displacement = prm.get("Initial displacement");
    initial_velocity = prm.get("Initial velocity");
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

    refinement.parse(prm);
    time.parse(prm);
    load_steps.cut_back = time.is_on;
    if (time.is_on)
      begin_motion();

    prm.enter_subsection("Exact solution");
    exact_displacement = prm.get("Displacement");
    exact_gradient = prm.get("Gradient");
    exact_energy =
        parse_number_or_nan(prm.get("Energy"), "Exact solution/Energy");
    exact_force = parse_number_or_nan(prm.get("Contact force"),
                                      "Exact solution/Contact force");
    prm.leave_subsection();

    prm.enter_subsection("Output");
    fields = prm.get_bool("Fields");
    every = prm.get_integer("Every");
    all_levels = prm.get_bool("All levels");
    nodal_values = prm.get_bool("Nodal values");
    linear_solves = prm.get_integer("Linear solves for comparison");
    prm.leave_subsection();
  }
} // namespace abut::app

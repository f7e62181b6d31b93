// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacle_parameters.h"

#include "app/input/input_error.h"
#include "app/input/parameters.h"
#include "app/scenes/common_parameters.h"

#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;

    void declare_membrane(ParameterHandler &prm)
    {
      prm.enter_subsection("Membrane");
      parameter::declare(prm, "Degree", "1", Patterns::Integer(1, 2),
                         parameter::advanced("1", "2"),
                         "Polynomial degree of the displacement.");
      parameter::declare(prm, "Conductivity", "1", TextPattern::formula(),
                         parameter::basic("force/length", "1 + 0.5*x"),
                         "Coefficient k of -div(k grad u) = f + p, the tension "
                         "of a membrane: a positive formula in x, y, z.");
      parameter::declare(
          prm, "Body force", "0", TextPattern::formula(),
          parameter::basic("force/length^2", "-10"),
          "Load f, force per area: a formula in x, y, z and, in dynamics, t.");
      parameter::declare(
          prm, "Density", "0", TextPattern::formula(),
          parameter::advanced("mass/length^2", "1"),
          "Mass per area, for dynamics: a positive formula in x, y, z.");
      parameter::declare(prm, "Initial displacement", "",
                         TextPattern::formula(),
                         parameter::advanced("length", "0.1*sin(pi*x)"),
                         "Displacement at the start of a motion: a formula in "
                         "x, y, z. Empty: 0.");
      parameter::declare(
          prm, "Initial velocity", "", TextPattern::formula(),
          parameter::advanced("length/time", "-1"),
          "Velocity at the start of a motion: a formula in x, y, z. Empty: 0.");
      parameter::declare(
          prm, "Prescribed displacement", "*: 0", TextPattern::formula_by_id(),
          parameter::basic("length", "0: 0; 1, 2: x^2; *: sin(pi*y)"),
          "Prescribed displacement by boundary id: a formula in x, y, z, t. * "
          "stands for all other ids. Ids without an entry are free.");
      parameter::declare(
          prm, "Traction", "", TextPattern::formula_by_id(),
          parameter::basic("force/length", "1: 0.5*y"),
          "Prescribed flux k du/dn by boundary id: a formula in x, y, z, t.");
      prm.leave_subsection();
    }

    void declare_contact(ParameterHandler &prm)
    {
      prm.enter_subsection("Contact");
      parameter::declare(prm, "Obstacle", "", TextPattern::formula(),
                         parameter::basic("length", "-0.1 + x^2"),
                         "Lower obstacle psi in u >= psi: a formula in x, y, "
                         "z, t. Empty: none, or the height map.");
      parameter::declare(prm, "Upper obstacle", "", TextPattern::formula(),
                         parameter::advanced("length", "0.2"),
                         "Upper obstacle psi in u <= psi: a formula in x, y, "
                         "z, t. Empty: none.");
      parameter::declare(prm, "Boundary ids", "",
                         TextPattern("a list of boundary ids"),
                         parameter::advanced("", "0, 2"),
                         "Boundary where contact is possible (scalar Signorini "
                         "problem). Empty: the whole domain.");
      HeightMapParameters::declare(prm);
      prm.leave_subsection();
    }

    void declare_results(ParameterHandler &prm)
    {
      prm.enter_subsection("Exact solution");
      parameter::declare(prm, "Displacement", "", TextPattern::formula(),
                         parameter::advanced("length", "x*(1 - x)"),
                         "Displacement of the exact solution: a formula in x, "
                         "y, z. If given, errors are computed.");
      parameter::declare(
          prm, "Gradient", "", TextPattern::vector(),
          parameter::expert("1", "1 - 2*x; 0"),
          "Its gradient `du/dx; du/dy`. Empty: by finite differences.");
      parameter::declare(prm, "Contact force", "nan",
                         TextPattern("a number, or nan"),
                         parameter::expert("force", "2"),
                         "Contact force of the exact solution; nan: unknown.");
      prm.leave_subsection();

      prm.enter_subsection("Output");
      parameter::declare(prm, "Fields", "true", Patterns::Bool(),
                         parameter::basic(),
                         "Whether displacement, pressure, gap and status are "
                         "written as VTU and PVD files for ParaView.");
      parameter::declare(
          prm, "Linear solves for comparison", "0", Patterns::Integer(0),
          parameter::expert("1", "3"),
          "Number of times that the problem without obstacle is solved on the "
          "last mesh (assembly, ML, conjugate gradients to 1e-10). The time of "
          "the contact solve is reported as a multiple of the median.");
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
        "quasi-static|contact "
        "stabilised|hht|trapezoid|midpoint|newmark|generalised "
        "alpha|central difference with projection",
        "A step that fails is halved, down to a thousandth.");
    RefinementParameters::declare(prm, "5", "3");
    declare_results(prm);
    declare_mesh_results(prm);
  }

  void ObstacleParameters::begin_motion()
  {
    if (time.mass == ABUT_TIME_MASS_MODIFIED && boundary_ids.empty())
      throw InputError(
          "Time stepping/Mass matrix",
          std::string(time.scheme.name)
              + " with modified mass needs nodes that cannot touch, and all "
                "nodes of a membrane over an obstacle can. Set Time "
                "stepping/Scheme = contact stabilised, or Time stepping/Mass "
                "matrix = consistent, with which impacts cause oscillations.");
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
    load = prm.get("Body force");
    dirichlet = prm.get("Prescribed displacement");
    neumann = prm.get("Traction");
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
                       "There is a height map as well: give one of the two.");
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
    field_steps = FieldSteps(prm, load_steps.steps);
    all_levels = prm.get_bool("All levels");
    nodal_values = prm.get_bool("Nodal values");
    linear_solves = prm.get_integer("Linear solves for comparison");
    prm.leave_subsection();
  }
} // namespace abut::app

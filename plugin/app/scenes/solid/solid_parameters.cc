// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_parameters.h"

#include "app/input/input_error.h"
#include "app/input/number_text.h"
#include "app/scenes/common_parameters.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

#include <algorithm>
#include <cstdlib>

namespace abut::app
{
  namespace
  {
    using dealii::ParameterHandler;
    namespace Patterns = dealii::Patterns;

    /** Part of the energy above which a gain is told where strains are large:
     * schemes that keep that of linear forces do not keep that of others. */
    constexpr double growth_of_large_strain = 1e-2;

    /** Numbered sections that a file may have of one kind. */
    constexpr unsigned int most = 100;

    unsigned int count(const ParameterFile &file, const std::string &parameter,
                       const unsigned int smallest,
                       const unsigned int otherwise)
    {
      const std::string text = file.get(parameter, std::to_string(otherwise));
      const std::vector<double> value = parse_numbers(text, parameter);
      if (value.size() != 1 || value[0] < smallest || value[0] > most
          || value[0] != static_cast<unsigned int>(value[0]))
        throw InputError(parameter, "'" + text + "' is not a whole number from "
                                        + std::to_string(smallest) + " to "
                                        + std::to_string(most) + "."
                                        + misread_hint(text));
      return static_cast<unsigned int>(value[0]);
    }

    /** A section beyond the count of its kind would be passed over. */
    void refuse_beyond(const ParameterFile &file, const std::string &word,
                       const std::string &parameter, const unsigned int n)
    {
      for (const auto &[path, value] : file.values())
      {
        if (path.compare(0, word.size() + 1, word + " ") != 0)
          continue;
        char *end = nullptr;
        const unsigned long number =
            std::strtoul(path.c_str() + word.size() + 1, &end, 10);
        if (*end == '/' && number > n && number <= most)
          throw InputError(path, "has no effect: " + parameter + " is "
                                     + std::to_string(n) + ": set it to "
                                     + std::to_string(number) + ".");
      }
    }

    std::string numbered(const std::string &word, const unsigned int index)
    {
      return word + " " + std::to_string(index + 1);
    }

    void declare_solid(ParameterHandler &prm)
    {
      prm.enter_subsection("Solid");
      parameter::declare(
          prm, "Bodies", "1", Patterns::Integer(1, most),
          parameter::basic("1", "2"),
          "Number of bodies, described by sections `Body 1`, `Body 2`, ...");
      parameter::declare(
          prm, "Pairs", "0", Patterns::Integer(0, most),
          parameter::basic("1", "1"),
          "Number of contact pairs, described by sections `Pair 1`, ...");
      parameter::declare(
          prm, "Obstacles", "0", Patterns::Integer(0, most),
          parameter::basic("1", "1"),
          "Number of rigid obstacles, described by sections `Obstacle 1`, ...");
      parameter::declare(prm, "Degree", "auto", Patterns::Selection("auto|1|2"),
                         parameter::advanced(),
                         "Polynomial degree of the displacement. auto: 1 for "
                         "quadrilaterals and hexahedra; 2 for triangles and "
                         "tetrahedra, which are too stiff with degree 1.");
      // Known in both dimensions, so that one reference tells of it.
      parameter::declare(prm, "Plane", "strain",
                         Patterns::Selection("strain|stress|axisymmetric"),
                         parameter::basic(),
                         "Model in 2D: plane strain, plane stress (per unit of "
                         "thickness), or axisymmetric about x = 0, with forces "
                         "of the full circle. Without effect in 3D.");
      parameter::declare(
          prm, "Accept strains beyond linear theory", "false", Patterns::Bool(),
          parameter::expert(),
          "Whether a result of `Material = hooke` with strains above 50 %, or "
          "above 33 % in the mean of a body, ends with exit code 0.");
      parameter::declare(
          prm, "Solve known failures", "false", Patterns::Bool(),
          parameter::expert(),
          "Whether pairs with the failures ABUT-F01, F02, F11, F23 or F24 are "
          "solved instead of rejected, for study only. The exit code is 3 if "
          "the failure is still there at the end.");
      parameter::declare(prm, "Gravity", "", TextPattern::vector(),
                         parameter::basic("length/time^2", "0, -9810"),
                         "Acceleration of gravity: a formula in x, y, z, t for "
                         "each component. Acts on `Density` of bodies and "
                         "`Mass` of obstacles. Empty: 0.");
      prm.leave_subsection();
    }

    void declare_solid_results(ParameterHandler &prm)
    {
      prm.enter_subsection("Exact solution");
      parameter::declare(prm, "Displacement", "", TextPattern::vector(),
                         parameter::advanced("length", "0, -0.1*y"),
                         "Displacement of the exact solution: a formula for "
                         "each component. If given, errors are computed.");
      parameter::declare(prm, "Gradient", "", TextPattern::vector(),
                         parameter::expert("1", "0, 0, 0, -0.1"),
                         "Its gradient `du_x/dx, du_x/dy, du_y/dx, du_y/dy`. "
                         "Empty: by finite differences.");
      prm.leave_subsection();

      prm.enter_subsection("Output");
      parameter::declare(prm, "Fields", "true", Patterns::Bool(),
                         parameter::basic(),
                         "Whether displacement and stress are written as VTU "
                         "and PVD files for ParaView.");
      parameter::declare(
          prm, "Points", "", TextPattern("a list of points by body"),
          parameter::advanced("length", "1: 0, 0; block: 1, 0.5"),
          "Points `body: coordinates` in the reference configuration. The "
          "displacements of the nearest nodes are reported as point_1, "
          "point_2, ...");
      prm.leave_subsection();
    }
  } // namespace

  SolidCounts SolidCounts::read(const ParameterFile &file)
  {
    SolidCounts counts;
    counts.bodies = count(file, "Solid/Bodies", 1, 1);
    counts.pairs = count(file, "Solid/Pairs", 0, 0);
    counts.obstacles = count(file, "Solid/Obstacles", 0, 0);
    refuse_beyond(file, "Body", "Solid/Bodies", counts.bodies);
    refuse_beyond(file, "Pair", "Solid/Pairs", counts.pairs);
    refuse_beyond(file, "Obstacle", "Solid/Obstacles", counts.obstacles);
    return counts;
  }

  void SolidParameters::check_element(const BodyParameters &body) const
  {
    if (body.volume != VolumeChange::of_cell)
      return;
    const auto refuse = [&body](const std::string &why)
    {
      throw InputError(body.parameter("Element"),
                       why + " Set it to full integration.");
    };
    if (degree > 1)
      refuse("mean dilatation is for Solid/Degree = 1: quadratic elements "
             "would lose an order of accuracy, and hardly lock without it.");
    if (plane == PlaneModel::stress)
      refuse("in plane stress (Solid/Plane) the thickness is free, and "
             "elements do not lock.");
  }

  void SolidParameters::check_materials() const
  {
    const auto words = [](const bool large)
    {
      return material_words(" or ", [large](const MaterialKind &kind)
                            { return kind.large_strain == large; });
    };
    for (const BodyParameters &body : bodies)
    {
      if (body.material->large_strain != has_large_strain())
        throw InputError(body.parameter("Material"),
                         words(false) + " is at small strain, and "
                             + bodies.front().parameter("Material")
                             + " is not: set both to " + words(false)
                             + ", or both to " + words(true)
                             + ". Stiff bodies give nearly the same result "
                               "with each of them.");
      check_element(body);
    }
    if (!has_large_strain())
      return;
    const auto refuse =
        [&words](const std::string &parameter, const std::string &why)
    {
      throw InputError(parameter,
                       why + " Or use small strain: Body N/Material = "
                           + words(false) + ".");
    };
    if (plane == PlaneModel::stress)
      refuse("Solid/Plane",
             "finite strain is available in plane strain, axisymmetric and 3D, "
             "not in plane stress: set strain, or model the plate in 3D.");
    if (time.is_on && time.stiffness_damping > 0.)
      refuse("Time stepping/Stiffness damping",
             "stiffness of the reference configuration would damp rigid "
             "rotations: set Time stepping/Mass damping, or Time "
             "stepping/Scheme = hht, which damps high frequencies.");
    if (refinement.has_target())
      refuse("Refinement/Target error",
             "the error estimate is known to be reliable at small strain only; "
             "use "
             "Refinement/Adaptive cycles, which refines by it.");
  }

  void SolidParameters::begin_simplices(const unsigned int dim,
                                        const std::vector<bool> &of_simplices)
  {
    const std::string cells = dim == 2 ? "triangles" : "tetrahedra";
    refinement.nested = false;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (of_simplices[i] && bodies[i].volume == VolumeChange::of_cell)
        throw InputError(bodies[i].parameter("Element"),
                         "mean dilatation is for quadrilaterals and hexahedra: "
                         "linear "
                             + cells
                             + " have constant strain in each cell. Set it to "
                               "full integration, and Solid/Degree = 2.");
    if (time.is_on && time.mass == ABUT_TIME_MASS_LUMPED && simplex_degree > 1)
      throw InputError("Solid/Degree",
                       "quadratic " + cells
                           + " have no lumped mass: row sums are not positive "
                             "at corners. Set it to 1, or use another Time "
                             "stepping/Mass matrix or Scheme.");
  }

  void SolidParameters::begin_motion()
  {
    for (const BodyParameters &body : bodies)
      if (body.density <= 0.)
        throw InputError(body.parameter("Density"),
                         "dynamics needs mass: set a density, or Time "
                         "stepping/Scheme = quasi-static.");
    if (has_large_strain())
      time.scheme.growth = std::max(time.scheme.growth, growth_of_large_strain);
    time.fit(refinement);
    static_cast<LoadStepOptions &>(load_steps) = time.steps(load_steps);
  }

  void SolidParameters::declare(ParameterHandler &prm,
                                const SolidCounts &counts)
  {
    declare_solid(prm);
    for (unsigned int body = 0; body < counts.bodies; ++body)
      BodyParameters::declare(prm, numbered("Body", body));
    for (unsigned int pair = 0; pair < counts.pairs; ++pair)
      PairParameters::declare(prm, numbered("Pair", pair));
    for (unsigned int obstacle = 0; obstacle < counts.obstacles; ++obstacle)
    {
      prm.enter_subsection(numbered("Obstacle", obstacle));
      RigidObstacleParameters::declare(prm);
      prm.leave_subsection();
    }
    LoadStepParameters::declare(prm);
    prm.enter_subsection("Time stepping");
    parameter::declare(
        prm, "Extrapolate", "true", Patterns::Bool(), parameter::expert(),
        "Finite strain and large sliding: whether a load step starts where the "
        "last increment leads. Where that fails, or supports change their "
        "direction, it starts from the last answer.");
    prm.leave_subsection();
    InertiaParameters::declare(
        prm,
        "quasi-static|hht|trapezoid|midpoint|newmark|generalised alpha|contact "
        "stabilised|central difference with projection",
        "A step that fails is halved, see `Cut back`.");
    RefinementParameters::declare(prm, "2", "0");
    declare_solid_results(prm);
    declare_mesh_results(prm);
  }

  void SolidParameters::parse(ParameterHandler &prm, const SolidCounts &counts)
  {
    prm.enter_subsection("Solid");
    has_degree = prm.get("Degree") != "auto";
    degree = has_degree ? prm.get_integer("Degree") : 1;
    simplex_degree = has_degree ? degree : 2;
    const std::string word = prm.get("Plane");
    plane = word == "strain"   ? PlaneModel::strain
            : word == "stress" ? PlaneModel::stress
                               : PlaneModel::axisymmetric;
    large_strain = prm.get_bool("Accept strains beyond linear theory");
    solve_known_failures = prm.get_bool("Solve known failures");
    gravity = prm.get("Gravity");
    prm.leave_subsection();
    bodies.resize(counts.bodies);
    for (unsigned int body = 0; body < counts.bodies; ++body)
      bodies[body].parse(prm, numbered("Body", body));
    pairs.resize(counts.pairs);
    for (unsigned int pair = 0; pair < counts.pairs; ++pair)
      pairs[pair].parse(prm, numbered("Pair", pair), counts.obstacles);
    obstacles.resize(counts.obstacles);
    for (unsigned int obstacle = 0; obstacle < counts.obstacles; ++obstacle)
    {
      const std::string section = numbered("Obstacle", obstacle);
      prm.enter_subsection(section);
      obstacles[obstacle].parse(prm, section);
      prm.leave_subsection();
    }
    load_steps.parse(prm);
    refinement.parse(prm);
    time.parse(prm);
    prm.enter_subsection("Time stepping");
    extrapolate = prm.get_bool("Extrapolate");
    prm.leave_subsection();
    check_materials();
    if (time.is_on)
      begin_motion();

    prm.enter_subsection("Exact solution");
    exact_displacement = prm.get("Displacement");
    exact_gradient = prm.get("Gradient");
    exact_energy =
        parse_number_or_nan(prm.get("Energy"), "Exact solution/Energy");
    prm.leave_subsection();

    prm.enter_subsection("Output");
    fields = prm.get_bool("Fields");
    field_steps = FieldSteps(prm, load_steps.steps);
    all_levels = prm.get_bool("All levels");
    nodal_values = prm.get_bool("Nodal values");
    points = prm.get("Points");
    prm.leave_subsection();
  }
} // namespace abut::app

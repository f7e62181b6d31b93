// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_parameters.h"

#include "app/input/formula_pattern.h"
#include "app/input/input_error.h"
#include "app/input/number_text.h"

#include <abut/dealii/number_pattern.h>

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
      prm.declare_entry("Bodies", "1", Patterns::Integer(1, most),
                        "Number of bodies: there are as many sections `Body "
                        "1`, `Body 2`, ...");
      prm.declare_entry("Pairs", "0", Patterns::Integer(0, most),
                        "Number of contact pairs, sections `Pair 1`, ...");
      prm.declare_entry("Obstacles", "0", Patterns::Integer(0, most),
                        "Number of rigid obstacles, sections `Obstacle 1`, "
                        "...");
      prm.declare_entry("Degree", "auto", Patterns::Selection("auto|1|2"),
                        "Polynomial degree of the displacement. auto: 1 for "
                        "quadrilaterals and hexahedra, 2 for triangles and "
                        "tetrahedra, which are too stiff with 1, each for its "
                        "own cells where a scene has both.");
      // Known in both dimensions, so that one reference tells of it.
      prm.declare_entry("Plane", "strain",
                        Patterns::Selection("strain|stress|axisymmetric"),
                        "What 2D stands for: plane strain, plane stress (per "
                        "unit of thickness), or a body of revolution about x "
                        "= 0, whose forces are those of the full circle. "
                        "Without meaning in 3D.");
      prm.declare_entry("Allow large strain", "false", Patterns::Bool(),
                        "Whether strains from 50 %, or from a third in the "
                        "mean of a body, are an answer to be used (exit code "
                        "0) although they are computed as small ones, linear "
                        "in the displacement.");
      prm.declare_entry("Solve known failures", "false", Patterns::Bool(),
                        "Solve pairs that are known to fail (codes ABUT-F01, "
                        "F02, F11, F23, F24) where they would be refused, to "
                        "measure how they fail: exit code 3 if they still "
                        "would be in the end.");
      prm.declare_entry("Gravity", "", FormulaPattern::vector(),
                        "Acceleration: a formula for each component, separated "
                        "by commas. Empty: none.");
      prm.leave_subsection();
    }

    void declare_solid_results(ParameterHandler &prm)
    {
      prm.enter_subsection("Exact solution");
      prm.declare_entry("Displacement", "", FormulaPattern::vector(),
                        "A formula for each component, separated by commas; if "
                        "given, errors are computed.");
      prm.declare_entry("Gradient", "", FormulaPattern::vector(),
                        "Its gradient, `du_x/dx, du_x/dy, du_y/dx, du_y/dy`. "
                        "Empty: by differences.");
      prm.declare_entry("Energy", "nan", Patterns::Anything(),
                        "Energy of the exact solution; nan: not known.");
      prm.leave_subsection();

      prm.enter_subsection("Output");
      prm.declare_entry("Fields", "true", Patterns::Bool(),
                        "Write displacement and stress as VTU and PVD files "
                        "for ParaView.");
      prm.declare_entry("Every", "1", Patterns::Integer(1),
                        "Write fields after every so many steps of a motion, "
                        "and at its end.");
      prm.declare_entry("All levels", "false", Patterns::Bool(),
                        "Write fields on every level, not only on the last.");
      prm.declare_entry("Nodal values", "false", Patterns::Bool(),
                        "Write displacement and forces at all nodes of the "
                        "last level as nodal.csv, with all digits.");
      prm.declare_entry("Points", "", Patterns::Anything(),
                        "Where displacements are wanted: the summary gets "
                        "those of the nodes nearest to the points `1: 0, 0; 2: "
                        "1, 0.5` (body: coordinates without load) as point_1, "
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
      refuse("mean dilatation is for Solid/Degree = 1: one pressure in a cell "
             "would take quadratic elements an order of accuracy, and they "
             "hardly lock without it.");
    if (plane == PlaneModel::stress)
      refuse("in plane stress (Solid/Plane) the thickness follows from the "
             "other strains, nothing keeps the volume, and nothing locks.");
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
                         words(false) + " is for small strain, and "
                             + bodies.front().parameter("Material")
                             + " is not of the same kind: set both to "
                             + words(false) + ", or both to " + words(true)
                             + ". A stiff body hardly strains with any of "
                               "them.");
      check_element(body);
    }
    if (!has_large_strain())
      return;
    const auto refuse =
        [&words](const std::string &parameter, const std::string &why)
    {
      throw InputError(parameter, why
                                      + " Or describe bodies of small strain: "
                                        "Body N/Material = "
                                      + words(false) + ".");
    };
    if (plane == PlaneModel::stress)
      refuse("Solid/Plane", "large strain is computed in plane strain, around "
                            "an axis and in space, not in plane stress: set "
                            "strain, or model the plate in three dimensions.");
    if (time.is_on && time.stiffness_damping > 0.)
      refuse("Time/Stiffness damping",
             "the stiffness of the undeformed bodies would brake what only "
             "turns: set Time/Mass damping, or Time/Scheme = hht, which damps "
             "what vibrates fast.");
    if (refinement.has_target())
      refuse("Refinement/Target error",
             "what the error estimate promises is known of small strain only; "
             "Refinement/Adaptive cycles refines by it all the same.");
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
                             + " have one strain in each cell anyway. Set it "
                               "to full integration, and Solid/Degree = 2.");
    if (time.is_on && time.mass == ABUT_TIME_MASS_LUMPED && simplex_degree > 1)
      throw InputError(
          "Solid/Degree",
          "quadratic " + cells
              + " have no lumped mass: sums of rows are not positive at "
                "corners. Set it to 1, or Time/Scheme and Time/Mass to ones "
                "with another mass.");
  }

  void SolidParameters::begin_motion()
  {
    for (const BodyParameters &body : bodies)
      if (body.density <= 0.)
        throw InputError(body.parameter("Density"),
                         "a body that moves has mass: set its density, or "
                         "Time/Scheme = none.");
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
    InertiaParameters::declare(
        prm,
        "none|hht|trapezoid|midpoint|newmark|generalised alpha|contact "
        "stabilised|central difference with projection",
        "A step that fails is halved, see `Load steps/Cut back`.");
    RefinementParameters::declare(prm, "2", "0");
    declare_solid_results(prm);
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
    large_strain = prm.get_bool("Allow large strain");
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
    every = prm.get_integer("Every");
    all_levels = prm.get_bool("All levels");
    nodal_values = prm.get_bool("Nodal values");
    points = prm.get("Points");
    prm.leave_subsection();
  }
} // namespace abut::app

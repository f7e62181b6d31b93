// SPDX-License-Identifier: LGPL-2.1-or-later
#include "body_parameters.h"

#include "app/input/formula_pattern.h"
#include "app/input/input_error.h"

#include <abut/dealii/number_pattern.h>

namespace abut::app
{
  void BodyParameters::declare(dealii::ParameterHandler &prm,
                               const std::string &section)
  {
    namespace Patterns = dealii::Patterns;
    prm.enter_subsection(section);
    prm.enter_subsection("Mesh");
    MeshParameters::declare(prm);
    prm.leave_subsection();
    prm.declare_entry("Refinements", "0", Patterns::Integer(0, 30),
                      "Uniform refinements of this body before those of "
                      "`Refinement/Level`.");
    prm.declare_entry(
        "Material", "hooke",
        Patterns::Selection("hooke|neo-hooke|st venant-kirchhoff"),
        "What stress follows from: hooke is for small strain; neo-hooke and st "
        "venant-kirchhoff (Hooke's law in large rotations, for compressions of "
        "up to a fifth) are for large displacements, with loads per area and "
        "volume of the undeformed body. All bodies of a scene are of small "
        "strain or none is.");
    prm.declare_entry(
        "Element", "full integration",
        Patterns::Selection("full integration|mean dilatation"),
        "full integration takes the strain at each point as it is, and locks "
        "in nearly incompressible bodies with `Solid/Degree` = 1. mean "
        "dilatation gives each cell one change of volume and one pressure: "
        "what other programs call B-bar, F-bar, Q1/P0, hybrid or u-p elements "
        "with constant pressure, for rubber (neo-hooke) and for hooke up to nu "
        "= 0.4999 or so.");
    prm.declare_entry("Young modulus", "1",
                      NumberPattern::between(1. / largest_value, largest_value),
                      "E, force per area; of large strain that at its "
                      "beginning, as nu.");
    prm.declare_entry("Poisson ratio", "0.3",
                      NumberPattern({nullptr, -1., 0.5, true, true}),
                      "nu. At 0.5 the material would be incompressible, which "
                      "displacements alone cannot describe. From 0.45 on set "
                      "`Element` = mean dilatation.");
    prm.declare_entry("Density", "0", NumberPattern::between(0., largest_value),
                      "Mass per volume; its weight is density times "
                      "`Solid/Gravity`, and its inertia that of section "
                      "`Time`.");
    prm.declare_entry("Support", "", FormulaPattern::vector_by_id(),
                      "Prescribed displacements by boundary id, `3: 0, 0; 1, "
                      "2: free, -0.1*t`: a formula in x, y, z, t for each "
                      "component, or the word free. * means all other ids. "
                      "Ids that are not named are free.");
    prm.declare_entry("Traction", "", FormulaPattern::vector_by_id(),
                      "Forces per area by boundary id, written like "
                      "`Support`, without the word free.");
    prm.declare_entry("Pressure", "", FormulaPattern::by_id(),
                      "Pressure on the boundary by id, `1: 5*t`, positive "
                      "into the body. Adds to `Traction`. It acts along the "
                      "normals of the undeformed body.");
    prm.declare_entry("Body force", "", FormulaPattern::vector(),
                      "Force per volume: a formula for each component, "
                      "separated by commas. Adds to the weight.");
    prm.declare_entry("Initial displacement", "", FormulaPattern::vector(),
                      "Where the motion begins: a formula in x, y, z for each "
                      "component, separated by commas. Empty: undeformed.");
    prm.declare_entry("Initial velocity", "", FormulaPattern::vector(),
                      "Written like it. Empty: at rest.");
    prm.leave_subsection();
  }

  void BodyParameters::parse(dealii::ParameterHandler &prm,
                             const std::string &section_name)
  {
    section = section_name;
    prm.enter_subsection(section);
    prm.enter_subsection("Mesh");
    mesh.parse(prm, section + "/Mesh");
    prm.leave_subsection();
    refinements = prm.get_integer("Refinements");
    const std::string word = prm.get("Material");
    law = word == "hooke"       ? MaterialLaw::hooke
          : word == "neo-hooke" ? MaterialLaw::neo_hooke
                                : MaterialLaw::st_venant_kirchhoff;
    element = prm.get("Element") == "mean dilatation"
                  ? ElementKind::mean_dilatation
                  : ElementKind::full_integration;
    if (element == ElementKind::mean_dilatation
        && law == MaterialLaw::st_venant_kirchhoff)
      throw InputError(parameter("Element"),
                       "the energy of st venant-kirchhoff has no part that is "
                       "one of volume alone, so that mean dilatation has "
                       "nothing to average: set Material = neo-hooke, or "
                       "Element = full integration.");
    young_modulus = prm.get_double("Young modulus");
    poisson_ratio = prm.get_double("Poisson ratio");
    density = prm.get_double("Density");
    support = prm.get("Support");
    traction = prm.get("Traction");
    pressure = prm.get("Pressure");
    body_force = prm.get("Body force");
    initial_displacement = prm.get("Initial displacement");
    initial_velocity = prm.get("Initial velocity");
    prm.leave_subsection();
  }
} // namespace abut::app

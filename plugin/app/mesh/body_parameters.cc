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
    prm.declare_entry("Name", "", Patterns::Anything(),
                      "Word for the body in the lists of surfaces of pairs and "
                      "in `Output/Points`, beside its number. Empty: the name "
                      "that its mesh file gives all its cells, if any (of a "
                      "physical volume, in 2D of a physical surface, or of an "
                      "element set).");
    prm.declare_entry("Refinements", "0", Patterns::Integer(0, 30),
                      "Uniform refinements of this body before those of "
                      "`Refinement/Level`.");
    std::string materials;
    for (const MaterialKind *kind : material_kinds())
      materials += std::string(" ") + kind->word + ": " + kind->help;
    prm.declare_entry(
        "Material", material_kinds().front()->word,
        Patterns::Selection(
            material_words("|", [](const MaterialKind &) { return true; })),
        "Law of stress and strain." + materials
            + " All bodies of a scene are of small strain or none is.");
    prm.declare_entry(
        "Element", "full integration",
        Patterns::Selection("full integration|mean dilatation"),
        "full integration takes the strain at each point as it is, and locks "
        "in nearly incompressible bodies with `Solid/Degree` = 1. mean "
        "dilatation gives each cell one change of volume and one pressure: "
        "what other programs call B-bar, F-bar, Q1/P0, hybrid or u-p elements "
        "with constant pressure, for nu up to 0.4999 or so. Materials: "
            + material_words(", ", [](const MaterialKind &kind)
                             { return !kind.without_mean_dilatation; })
            + ".");
    for (const MaterialNumber &number : material_numbers())
      prm.declare_entry(number.name, number.value, NumberPattern(number.range),
                        number.help);
    prm.declare_entry("Density", "0", NumberPattern::between(0., largest_value),
                      "Mass per volume; its weight is density times "
                      "`Solid/Gravity`, and its inertia that of section "
                      "`Time`.");
    prm.declare_entry(
        "Support", "", FormulaPattern::vector_by_id(),
        "Prescribed displacements by boundary id or name, `3: 0, 0; 1, "
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
    name = prm.get("Name");
    refinements = prm.get_integer("Refinements");
    material = &find_material(prm.get("Material"));
    volume = prm.get("Element") == "mean dilatation" ? VolumeChange::of_cell
                                                     : VolumeChange::of_point;
    if (volume == VolumeChange::of_cell && material->without_mean_dilatation)
      throw InputError(
          parameter("Element"),
          material->without_mean_dilatation + std::string(": set Material = ")
              + material->instead + ", or Element = full integration.");
    for (const MaterialNumber &number : material->numbers)
      numbers.push_back(prm.get_double(number.name));
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

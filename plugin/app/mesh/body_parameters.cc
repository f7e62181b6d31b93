// SPDX-License-Identifier: LGPL-2.1-or-later
#include "body_parameters.h"

#include "app/input/input_error.h"

#include <abut/dealii/number_pattern.h>
#include <abut/dealii/parameter_entry.h>
#include <abut/dealii/text_pattern.h>

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
    parameter::declare(
        prm, "Name", "", TextPattern("a name"), parameter::basic("", "block"),
        "Name of the body, for the surfaces of pairs and `Output/Points`; its "
        "number works as well. Empty: the name that the mesh file gives to all "
        "cells, if there is one.");
    parameter::declare(
        prm, "Refinements", "0", Patterns::Integer(0, 30),
        parameter::advanced("1", "1"),
        "Uniform refinements of this body in addition to `Refinement/Level`.");
    std::string materials;
    for (const MaterialKind *kind : material_kinds())
      materials += std::string(" ") + kind->word + ": " + kind->help;
    parameter::declare(prm, "Material", material_kinds().front()->word,
                       Patterns::Selection(material_words(
                           "|", [](const MaterialKind &) { return true; })),
                       parameter::basic(),
                       "Law of stress and strain." + materials
                           + " All bodies of a scene are at small strain, or "
                             "all at finite strain.");
    parameter::declare(
        prm, "Element", "full integration",
        Patterns::Selection("full integration|mean dilatation"),
        parameter::advanced(),
        "Treatment of the change of volume. full integration: at each point; "
        "it locks in nearly incompressible bodies with `Solid/Degree = 1`. "
        "mean dilatation: one change of volume and one pressure per cell "
        "(B-bar, F-bar, Q1/P0), for nu up to 0.4999. Materials with mean "
        "dilatation: "
            + material_words(", ", [](const MaterialKind &kind)
                             { return !kind.without_mean_dilatation; })
            + ".");
    for (const MaterialNumber &number : material_numbers())
      parameter::declare(
          prm, number.name, number.value, NumberPattern(number.range),
          parameter::basic(number.unit, number.example), number.help);
    parameter::declare(prm, "Density", "0",
                       NumberPattern::between(0., largest_value),
                       parameter::basic("mass/length^3", "7.8e-9"),
                       "Mass density. Gives weight with `Solid/Gravity` and "
                       "inertia with `Time stepping/Scheme`.");
    parameter::declare(
        prm, "Prescribed displacement", "", TextPattern::vector_by_id(),
        parameter::basic("length", "3: 0, 0; top: free, -0.1*t"),
        "Prescribed displacement by boundary id or name: a formula in x, y, z, "
        "t for each component, or the word free. * stands for all other ids. "
        "Ids without an entry are free.");
    parameter::declare(prm, "Traction", "", TextPattern::vector_by_id(),
                       parameter::basic("force/length^2", "2: 0, -5*t"),
                       "Force per area by boundary id or name: a formula in x, "
                       "y, z, t for each component.");
    parameter::declare(
        prm, "Pressure", "", TextPattern::formula_by_id(),
        parameter::basic("force/length^2", "1: 5*t"),
        "Pressure by boundary id or name, positive into the body, along the "
        "normals of the reference configuration. Is added to `Traction`.");
    parameter::declare(prm, "Body force", "", TextPattern::vector(),
                       parameter::advanced("force/length^3", "0, -1e-3*x"),
                       "Force per volume: a formula in x, y, z, t for each "
                       "component. Is added to the weight.");
    parameter::declare(prm, "Initial displacement", "", TextPattern::vector(),
                       parameter::advanced("length", "0, 0.1"),
                       "Displacement at the start of a motion: a formula in x, "
                       "y, z for each component. Empty: 0.");
    parameter::declare(prm, "Initial velocity", "", TextPattern::vector(),
                       parameter::advanced("length/time", "0, -2"),
                       "Velocity at the start of a motion: a formula in x, y, "
                       "z for each component. Empty: 0. Supports have the "
                       "velocity of their prescribed displacement.");
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
    support = prm.get("Prescribed displacement");
    traction = prm.get("Traction");
    pressure = prm.get("Pressure");
    body_force = prm.get("Body force");
    initial_displacement = prm.get("Initial displacement");
    initial_velocity = prm.get("Initial velocity");
    prm.leave_subsection();
  }
} // namespace abut::app

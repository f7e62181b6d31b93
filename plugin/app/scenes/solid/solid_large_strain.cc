// SPDX-License-Identifier: LGPL-2.1-or-later
// How bodies of large strain are solved, and what is looked at in the answer.
#include "app/input/short_number.h"
#include "app/physics/stretches.h"
#include "solid_model.h"

#include <algorithm>

namespace abut::app
{
  template <int dim> double SolidModel<dim>::part_of_flight() const
  {
    // Gradients of displacements have the round-off of 1, which is not to be
    // asked for.
    constexpr double least = 1e-2, round_off = 1e-14;
    const double way = run.u.linfty_norm();
    const double length = half_extent(this->triangulation);
    return way > 0. ? std::clamp(
               round_off * length
                   / (way * parameters.load_steps.newton_tolerance),
               least, 1.)
                    : 1.;
  }

  template <int dim> NewtonParameters SolidModel<dim>::newton_parameters() const
  {
    NewtonParameters result;
    result.tolerance = parameters.load_steps.newton_tolerance;
    if (has_large_strain() && motion)
      result.tolerance *= part_of_flight();
    result.max_steps = parameters.load_steps.newton_steps;
    return result;
  }

  template <int dim>
  std::vector<ContactFinding> SolidModel<dim>::examine_materials() const
  {
    if (!has_large_strain())
      return {};
    const Stretches seen =
        find_stretches(elasticity.mapping, elasticity.dof_handler,
                       elasticity.ghosted(run.u), data.materials);
    run.report.set("least_stretch", seen.least);
    run.report.set("least_volume", seen.least_volume);
    std::vector<ContactFinding> findings;
    if (seen.least_at_corners <= 0.)
      findings.emplace_back(
          coded(ABUT_FAILURE_LARGE_STRAIN,
                "A cell is inverted at a corner, to "
                    + short_number(seen.least_at_corners, 3)
                    + " of its volume there; quadrature points do not detect "
                      "it, and the equilibrium may be unreachable. Use smaller "
                      "load steps, or refine the mesh there.",
                {{"least relative volume", seen.least_at_corners}}),
          false);
    if (seen.excess <= 0.)
      return findings;
    const MaterialKind &material = *bodies[seen.where].material;
    findings.emplace_back(
        coded(ABUT_FAILURE_LARGE_STRAIN,
              "Body " + std::to_string(seen.where + 1) + " is compressed to "
                  + percent(seen.allowed - seen.excess)
                  + " of its length where " + material.word
                  + " is of use down to " + percent(seen.allowed) + ": beyond, "
                  + material.below_least_stretch + ". Set "
                  + bodies[seen.where].parameter("Material") + " = "
                  + material.instead
                  + ", or check the units of loads and stiffness.",
              {{"least stretch", seen.allowed - seen.excess},
               {"limit", seen.allowed}}),
        true);
    return findings;
  }

  template double SolidModel<2>::part_of_flight() const;
  template double SolidModel<3>::part_of_flight() const;
  template NewtonParameters SolidModel<2>::newton_parameters() const;
  template std::vector<ContactFinding> SolidModel<2>::examine_materials() const;
  template NewtonParameters SolidModel<3>::newton_parameters() const;
  template std::vector<ContactFinding> SolidModel<3>::examine_materials() const;
} // namespace abut::app

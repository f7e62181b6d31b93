// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nodal_forces.h"

#include <utility>

namespace abut::app
{
  template <int dim>
  AppliedForces
  applied_forces(const DiscreteProblem<dim> &problem,
                 const ContactRunState<dim> &run, const NodalForces &forces,
                 const bool has_contact, const la::Vector *unbalanced)
  {
    la::Vector reaction(forces.internal);
    reaction.add(-1., forces.external);
    if (unbalanced != nullptr)
      reaction = *unbalanced;
    la::Vector contact(reaction);
    problem.constraints.set_zero(contact);
    reaction.add(-1., contact);
    if (!has_contact || !abut_law_needs_stress(run.method.options.law))
    {
      contact = 0.;
      if (has_contact)
        run.contact.results().add_forces(contact);
    }
    problem.constraints.set_zero(contact);
    if (has_contact)
    {
      la::Vector on_supports = problem.vector();
      run.contact.results().add_forces(on_supports, ForcePart::at_prescribed);
      contact += on_supports;
      reaction -= on_supports;
    }
    return {std::move(contact), std::move(reaction)};
  }

  template <int dim>
  std::vector<NodalColumn>
  force_columns(const DiscreteProblem<dim> &problem,
                const ContactRunState<dim> &run, const NodalForces &forces,
                const bool has_contact, const la::Vector *unbalanced)
  {
    const AppliedForces applied =
        applied_forces(problem, run, forces, has_contact, unbalanced);
    la::Vector held = problem.vector();
    for (const auto dof : problem.dof_handler.locally_owned_dofs())
      held(dof) = problem.constraints.is_constrained(dof)
                          && !problem.hanging.is_constrained(dof)
                      ? 1.
                      : 0.;
    held.compress(dealii::VectorOperation::insert);
    return {{"load", forces.external},
            {"contact", applied.contact},
            {"reaction", applied.reaction},
            {"held", held}};
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template AppliedForces applied_forces(                                       \
      const DiscreteProblem<dim> &, const ContactRunState<dim> &,              \
      const NodalForces &, bool, const la::Vector *);                          \
  template std::vector<NodalColumn> force_columns(                             \
      const DiscreteProblem<dim> &, const ContactRunState<dim> &,              \
      const NodalForces &, bool, const la::Vector *);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

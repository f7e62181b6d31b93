// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nodal_forces.h"

namespace abut::app
{
  template <int dim>
  std::vector<NodalColumn>
  force_columns(const DiscreteProblem<dim> &problem,
                const ContactRunState<dim> &run, const NodalForces &forces,
                const bool has_contact, const la::Vector *unbalanced)
  {
    la::Vector reaction(forces.internal);
    reaction.add(-1., forces.external);
    if (unbalanced != nullptr)
      reaction = *unbalanced;
    la::Vector free(reaction);
    problem.constraints.set_zero(free);
    reaction.add(-1., free);

    la::Vector contact = problem.vector();
    if (has_contact && abut_law_needs_stress(run.method.options.law))
      contact = free;
    else if (has_contact)
      run.contact.add_contact_forces(contact);
    problem.constraints.set_zero(contact);
    if (has_contact)
    {
      la::Vector on_supports = problem.vector();
      run.contact.add_forces_on_supports(on_supports);
      contact += on_supports;
      reaction -= on_supports;
    }

    la::Vector held = problem.vector();
    for (const auto dof : problem.dof_handler.locally_owned_dofs())
      held(dof) = problem.constraints.is_constrained(dof)
                          && !problem.hanging.is_constrained(dof)
                      ? 1.
                      : 0.;
    held.compress(dealii::VectorOperation::insert);
    return {{"load", forces.external},
            {"contact", contact},
            {"reaction", reaction},
            {"held", held}};
  }

  template std::vector<NodalColumn> force_columns(const DiscreteProblem<2> &,
                                                  const ContactRunState<2> &,
                                                  const NodalForces &, bool,
                                                  const la::Vector *);
  template std::vector<NodalColumn> force_columns(const DiscreteProblem<3> &,
                                                  const ContactRunState<3> &,
                                                  const NodalForces &, bool,
                                                  const la::Vector *);
} // namespace abut::app

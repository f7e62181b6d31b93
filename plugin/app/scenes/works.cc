// SPDX-License-Identifier: LGPL-2.1-or-later
#include "works.h"

#include "nodal_forces.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Work of @p forces on @p u; adds its magnitudes on this rank to @p size.
     * Collective. */
    double work(const la::Vector &forces, const la::Vector &u, double &size)
    {
      const double *f = la::data(forces), *d = la::data(u);
      for (int i = 0; i < la::n_owned(u); ++i)
        size += std::abs(f[i] * d[i]);
      return forces * u;
    }

    /** Sum of d^2 |K_ii| over the unknowns of this rank. */
    double work_apart(const la::Matrix &stiffness, const la::Vector &u)
    {
      const std::vector<double> diagonal =
          la::diagonal(la::local_rows(stiffness));
      double result = 0.;
      for (int i = 0; i < la::n_owned(u); ++i)
        result += la::data(u)[i] * la::data(u)[i] * std::abs(diagonal[i]);
      return result;
    }
  } // namespace

  template <int dim>
  Works find_works(const DiscreteProblem<dim> &problem,
                   const ContactRunState<dim> &run, const bool has_contact,
                   la::Vector &contact)
  {
    la::Vector u(run.u);
    problem.constraints.distribute(u);
    // Forces at hanging nodes are those of their parents.
    problem.hanging.set_zero(u);
    Works works;
    const NodalForces forces = problem.nodal_forces(run.u);
    works.stored = forces.internal * u;
    works.apart = work_apart(problem.stiffness, u);
    AppliedForces applied = applied_forces(problem, run, forces, has_contact);
    works.given = work(forces.external, u, works.size)
                  + work(applied.reaction, u, works.size);
    if (has_contact)
    {
      works.force = applied.contact.l1_norm();
      works.contact = work(applied.contact, u, works.size);
      contact.swap(applied.contact);
    }
    for (const ContactResult &result : run.results)
      works.before = std::max(works.before, std::abs(result.energy));
    works.size = dealii::Utilities::MPI::sum(works.size, run.communicator);
    works.apart = dealii::Utilities::MPI::sum(works.apart, run.communicator);
    return works;
  }

  template Works find_works(const DiscreteProblem<2> &,
                            const ContactRunState<2> &, bool, la::Vector &);
  template Works find_works(const DiscreteProblem<3> &,
                            const ContactRunState<3> &, bool, la::Vector &);
} // namespace abut::app

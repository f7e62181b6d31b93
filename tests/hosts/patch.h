// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_PATCH_H
#define ABUT_TESTS_PATCH_H

#include "two_blocks.h"

namespace abut::hosts
{
  /** Method with the law and the discretisation of these names. */
  inline MethodParameters
  method(const std::string &law,
         const std::optional<abut_discretisation> discretisation)
  {
    MethodParameters result;
    result.options.law = abut_law_find(law.c_str());
    result.discretisation = discretisation;
    return result;
  }

  /** Solve, print, and compare all errors with @p bound. */
  template <int dim,
            class Mesh = dealii::parallel::distributed::Triangulation<dim>>
  bool passes(const Case &run, const double bound)
  {
    const Errors errors = TwoBlocks<dim, Mesh>(run).solve();
    if (MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << run.name << ": " << errors.n_rows << " rows, "
                << errors.n_active << " in contact, " << errors.steps
                << " steps, " << errors.hanging
                << " hanging unknowns; errors of stress " << errors.stress
                << ", displacement " << errors.displacement << ", pressure "
                << errors.pressure << ", area " << errors.area - 1.
                << ", force " << errors.force - 1. << ", balance "
                << errors.imbalance << " and " << errors.moment_imbalance
                << std::endl;
    bool good = true;
    const auto check = [&](const double value, const char *what)
    { good = is_at_most(value, bound, run.name + ": " + what) && good; };
    check(errors.stress, "error of the stress");
    check(errors.displacement, "error of the displacement");
    check(errors.pressure, "error of the pressure");
    check(std::abs(errors.area - 1.), "error of the covered area");
    if (!run.yields)
      check(std::abs(errors.force - 1.), "error of the force");
    check(errors.imbalance, "difference of the forces on the two sides");
    check(errors.moment_imbalance, "difference of the moments");
    check(errors.reason == ABUT_REASON_CONVERGED ? 0. : 1.,
          "failure to converge");
    if (run.has_hanging_nodes())
      check(errors.hanging > 0 ? 0. : 1., "lack of hanging nodes");
    return good;
  }

  /** passes() with the upper and with the lower block as the secondary. */
  template <int dim,
            class Mesh = dealii::parallel::distributed::Triangulation<dim>>
  bool passes_either_way(Case run, const std::string &name, const double bound)
  {
    bool good = true;
    for (const bool upper : {true, false})
    {
      run.upper_is_secondary = upper;
      run.name = name + (upper ? ", upper side" : ", lower side");
      good = passes<dim, Mesh>(run, bound) && good;
    }
    return good;
  }
} // namespace abut::hosts

#endif

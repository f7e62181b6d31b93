// SPDX-License-Identifier: LGPL-2.1-or-later
// Every law that needs no stress of the host with every discretisation that is
// offered with it, on the blocks of the patch test: each must converge to the
// resultant 1 of the exact solution, as closely as the law and the
// discretisation allow.
#include "patch.h"

using namespace abut;

namespace
{
  /** Error of the resultant that a pair of law and discretisation may have.
   * Weak enforcement at single points moves the interface by some thousandths
   * of the shortening; the default penalty yields by about 1 / 50 of what a
   * facet does. */
  double allowed(const abut_law &law,
                 const std::optional<abut_discretisation> discretisation)
  {
    const bool is_exact = discretisation == ABUT_DISCRETISATION_MORTAR
                          || discretisation == ABUT_DISCRETISATION_DUAL_MORTAR;
    if (std::string(law.name) == "penalty")
      return 2e-2;
    return is_exact ? 1e-3 : 1e-2;
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool is_first =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  bool good = true;
  unsigned int n_runs = 0, n_refused = 0;
  for (std::int32_t i = 0; abut_law_get(i) != nullptr; ++i)
    for (const auto discretisation :
         {ABUT_DISCRETISATION_NODE_TO_SEGMENT,
          ABUT_DISCRETISATION_QUADRATURE_POINT, ABUT_DISCRETISATION_MORTAR,
          ABUT_DISCRETISATION_DUAL_MORTAR})
    {
      const abut_law &law = *abut_law_get(i);
      // It needs the host's stress, which these blocks do not tell.
      if (std::string(law.name) == "nitsche")
        continue;
      if (!refusal(law, discretisation, System::automatic, false).empty())
      {
        ++n_refused;
        continue;
      }
      ++n_runs;
      hosts::Case run;
      run.name =
          std::string(law.name) + ", " + discretisation_name(discretisation);
      run.method = hosts::method(law.name, discretisation);
      const hosts::Errors errors = hosts::TwoBlocks<2>(run).solve();
      if (is_first)
        std::cout << run.name << ": " << errors.steps << " steps, force "
                  << errors.force << ", stress to " << errors.stress
                  << std::endl;
      good = hosts::is_at_most(std::abs(errors.force - 1.),
                               allowed(law, discretisation),
                               run.name + ": error of the force")
             && good;
      good = hosts::is_at_most(errors.imbalance, 1e-11,
                               run.name + ": difference of the forces")
             && good;
      good = hosts::is_at_most(errors.reason == ABUT_REASON_CONVERGED ? 0. : 1.,
                               0., run.name + ": failure to converge")
             && good;
    }
  // Six such laws; quadrature points are refused for lagrange and interior
  // point.
  good =
      hosts::is_at_most(std::abs(n_runs - 22.), 0., "number of runs")
      && hosts::is_at_most(std::abs(n_refused - 2.), 0., "number of refusals")
      && good;
  return good ? 0 : 1;
}

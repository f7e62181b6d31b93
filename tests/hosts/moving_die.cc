// SPDX-License-Identifier: LGPL-2.1-or-later
// A meshed die that AffineConstraints move: detect() has the values prescribed
// now, without a reinit().
#include "nonlinear_blocks.h"

using namespace abut;
using hosts::Blocks;

namespace
{
  bool good = true;

  void expect(const bool holds, const std::string &what)
  {
    if (!holds && hosts::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "FAILED: " << what << std::endl;
    good = good && holds;
  }

  /** The block above is held at its top; the die is in touch at the height
   * `distance`, and presses it beyond. */
  hosts::BlocksOptions held_above()
  {
    hosts::BlocksOptions options;
    options.top = 0.;
    options.die = 0.;
    return options;
  }

  /** Gaps are those to where the die is now. */
  void check_gaps()
  {
    Blocks blocks(held_above());
    for (const double height : {0., 0.03, 0.01, 0.07})
    {
      blocks.move_die(height);
      la::Vector u(blocks.u);
      blocks.constraints.distribute(u);
      blocks.contact.detect(u);
      const la::Vector gap = blocks.contact.results().gap();
      const double exact = hosts::distance - height;
      expect(std::abs(gap.linfty_norm() - std::abs(exact)) <= 1e-14,
             "gap of a die at " + std::to_string(height));
      expect(std::abs(blocks.contact.results().measures().penetration
                      - std::max(0., -exact))
                 <= 1e-14,
             "penetration of a die at " + std::to_string(height));
    }
  }

  /** Steps of a die that presses the block above by 0.1 and then by 0.2. */
  void check_steps(const std::string &law, const double bound)
  {
    Blocks blocks(held_above());
    SolverParameters direct;
    direct.linear = SolverParameters::Linear::direct;
    blocks.contact.set_parameters(hosts::method(law, std::nullopt), direct);
    NewtonParameters parameters;
    parameters.tolerance = 1e-8;
    ContactSolver<2> solver(blocks.contact, blocks.constraints,
                            blocks.problem(), parameters);
    for (const double strain : {0.1, 0.2})
    {
      blocks.move_die(hosts::distance + strain);
      const NewtonResult result = solver.solve(blocks.u);
      const double force =
          std::abs(blocks.contact.results().pairs()[0].secondary_force[1]);
      const double exact = hosts::stiffening[1].uniaxial(strain);
      expect(result.converged(), law + ": " + result.explanation);
      expect(std::abs(force / exact - 1.) <= bound,
             law + ": force at " + std::to_string(strain) + ": "
                 + std::to_string(force) + " instead of "
                 + std::to_string(exact));
    }
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_gaps();
  check_steps("lagrange", 1e-7);
  check_steps("augmented lagrangian", 1e-4);
  return good ? 0 : 1;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// ContactSolver where the tangent is indefinite: stress that falls with strain.
// Energies of steps say nothing there; no answer may count whose forces do not
// balance.
#include "nonlinear_blocks.h"

using namespace abut;
using hosts::Blocks;

namespace
{
  /** stress = m (e - 40 e^3): highest at e = 0.0913, negative slope beyond. */
  constexpr std::array<hosts::Stiffening, 2> softening = {
      {{1., 4., -360.}, {1.4, 4.3, -400.}}};
  constexpr double strain_at_peak = 0.091287092917527685;

  bool good = true;

  void expect(const bool holds, const std::string &what)
  {
    if (!holds && hosts::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "FAILED: " << what << std::endl;
    good = good && holds;
  }

  void take_direct_solver(Blocks &blocks)
  {
    SolverParameters direct;
    direct.linear = SolverParameters::Linear::direct;
    blocks.contact.set_parameters(hosts::method("lagrange", std::nullopt),
                                  direct);
  }

  /** Both blocks beyond their highest stress, tied and pressed by prescribed
   * values: the equilibrium e + f = 0.2, 9 s(e) = 10 s(f) that is near is
   * unstable. (Without the tie they would part, and go to the strain without
   * stress.) */
  void check_unstable_equilibrium()
  {
    hosts::BlocksOptions options;
    options.materials = softening;
    options.tied = true;
    options.top = -hosts::shortening;
    Blocks blocks(options);
    take_direct_solver(blocks);
    blocks.u = blocks.uniform(0.1, 0.1);
    const NewtonResult result =
        ContactSolver<2>(blocks.contact, blocks.constraints, blocks.problem())
            .solve(blocks.u);
    const auto difference = [](const double e)
    {
      return softening[0].uniaxial(e)
             - softening[1].uniaxial(hosts::shortening - e);
    };
    double low = 0.08, high = 0.1;
    for (int i = 0; i < 60; ++i)
      (difference(low) * difference(0.5 * (low + high)) <= 0. ? high : low) =
          0.5 * (low + high);
    const double exact = softening[0].uniaxial(low);
    const double force =
        std::abs(blocks.contact.results().pairs()[0].secondary_force[1]);
    if (hosts::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "beyond the peak: " << result.n_steps << " linearisations, "
                << result.n_negative_steps << " of them not positive, force "
                << force << " of " << exact << ", strain " << low
                << ", residual " << result.residual << std::endl;
    expect(result.converged(), "beyond the peak: " + result.explanation);
    expect(std::abs(force / exact - 1.) <= 1e-5, "beyond the peak: force");
    expect(result.residual <= 1e-5 * force, "beyond the peak: balance");
    expect(result.n_negative_steps > 0
               && result.explanation.text.find("unstable") != std::string::npos,
           "beyond the peak: a word on stability");
  }

  /** The lower block pulled up by 1.2 times the highest force that it bears,
   * far from the upper one: there is no equilibrium. */
  void check_limit_load()
  {
    hosts::BlocksOptions options;
    options.materials = softening;
    options.top = 1.;
    Blocks blocks(options);
    take_direct_solver(blocks);
    HostProblem problem = blocks.problem();
    const auto internal = problem.residual;
    la::Vector load(blocks.u);
    internal(blocks.uniform(-strain_at_peak, 0.), load);
    load *= 1.2;
    problem.residual = [&](const la::Vector &u, la::Vector &residual)
    {
      internal(u, residual);
      residual -= load;
    };
    blocks.u = blocks.uniform(0., 0.);
    const NewtonResult result =
        ContactSolver<2>(blocks.contact, blocks.constraints, problem)
            .solve(blocks.u);
    if (hosts::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "beyond the limit load: " << result.n_steps
                << " linearisations, " << result.n_negative_steps
                << " of them not positive: " << result.explanation.text
                << std::endl;
    expect(!result.converged(), "an answer beyond the limit load");
    expect(result.n_negative_steps == 0
               || result.explanation.text.find("d . K d") != std::string::npos,
           "beyond the limit load: a word on the tangent");
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_unstable_equilibrium();
  check_limit_load();
  return good ? 0 : 1;
}

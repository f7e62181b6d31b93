// SPDX-License-Identifier: LGPL-2.1-or-later
// A law of the host's own that pulls: pressures below zero are kept from one
// iteration to the next.
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

  /** p = -glue g, for gaps of either sign. */
  constexpr double glue = 5.;

  abut_status classify(const abut_law_points *at, std::uint8_t *state)
  {
    std::fill(state, state + at->n, ABUT_STATE_CLOSED);
    return ABUT_SUCCESS;
  }

  abut_status linearise(const abut_law_points *at, const std::uint8_t *,
                        abut_law_linearisation *result)
  {
    for (std::int32_t i = 0; i < at->n; ++i)
    {
      result->residual[i] = at->pressure[i] + glue * at->gap[i];
      result->d_pressure[i] = 1.;
      result->d_gap[i] = glue;
    }
    return ABUT_SUCCESS;
  }

  abut_law make_law()
  {
    abut_law law = {};
    law.struct_size = sizeof(law);
    law.name = "glue";
    law.outer = ABUT_OUTER_NONE;
    law.classify = classify;
    law.linearise = linearise;
    return law;
  }

  /** Linear blocks, 0.03 apart where nothing pulls: with the stiffness 7 of
   * the lower and 9 of the upper block, g (1 + glue / 7 + glue / 9) = 0.03. */
  void check()
  {
    constexpr double opening = 0.03;
    const double exact = glue * opening / (1. + glue / 7. + glue / 9.);
    hosts::BlocksOptions options;
    options.materials = {{{3., 2., 0.}, {1., 4., 0.}}};
    options.top = opening - hosts::distance;
    Blocks blocks(options);
    const abut_law law = make_law();
    MethodParameters method;
    method.options.law = &law;
    SolverParameters direct;
    direct.linear = SolverParameters::Linear::direct;
    blocks.contact.set_parameters(method, direct);
    const HostProblem problem = blocks.problem();
    const NewtonResult result =
        ContactSolver<2>(blocks.contact, blocks.constraints, problem)
            .solve(blocks.u);
    expect(result.converged(), "glue: " + result.explanation);

    const auto check_pull = [&](const std::string &when)
    {
      const double pull =
          blocks.contact.results().pairs()[0].secondary_force[1];
      expect(std::abs(std::abs(pull) / exact - 1.) <= 1e-9,
             when + ": force " + std::to_string(pull) + " instead of "
                 + std::to_string(exact));
      la::Vector residual(blocks.u);
      residual = 0.;
      problem.residual(blocks.u, residual);
      la::Vector forces(blocks.u);
      forces = 0.;
      blocks.contact.results().add_forces(forces);
      blocks.constraints.set_zero(forces);
      residual -= forces;
      expect(residual.l2_norm() <= 1e-9 * exact, when + ": balance of forces");
    };
    check_pull("after the solve");
    blocks.contact.linearise(blocks.u);
    check_pull("after linearise()");
    blocks.contact.detect(blocks.u);
    check_pull("after detect()");
    const la::Vector pressure = blocks.contact.results().pressure();
    expect(std::abs(pressure.linfty_norm() / exact - 1.) <= 1e-9,
           "pressure as a field");
    blocks.reinit_contact();
    blocks.contact.state().set_pressure(pressure);
    blocks.contact.detect(blocks.u);
    check_pull("after set_pressure()");
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check();
  return good ? 0 : 1;
}

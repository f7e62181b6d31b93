// SPDX-License-Identifier: LGPL-2.1-or-later
// Friction by a saddle-point system, by a factorisation and by iterations: dual
// mortar gives what it gives condensed, and standard mortar, which couples all
// multipliers, the law at each of its points.
#include "patch.h"

using namespace abut;

namespace
{
  constexpr double mu = 0.1;

  /** How far the top is moved aside: some of the interface slips, or all of
   * it does. */
  constexpr double some = 0.2, all = 0.5;

  struct Answer
  {
    la::Vector displacement;
    double ratio = 0.; ///< of friction to pressure, sums of magnitudes
    dealii::types::global_dof_index n_slipping = 0, n_active = 0;
    abut_reason reason = ABUT_REASON_NONE;
  };

  template <int dim>
  Answer solve(const abut_discretisation way, const System system,
               const SolverParameters::Linear linear, const double aside)
  {
    hosts::Case run;
    run.method = hosts::method("lagrange", way);
    run.method.system = system;
    run.aside = aside;
    hosts::TwoBlocks<dim> blocks(run);
    ContactPair<dim> pair = blocks.pair();
    auto friction = std::make_shared<Friction<dim>>();
    friction->coefficient = [](const dealii::Point<dim> &) { return mu; };
    pair.friction = friction;
    blocks.prepare({pair});
    SolverParameters solver;
    solver.linear = linear;
    blocks.contact().set_parameters(run.method, solver);
    la::Vector u = blocks.start();
    blocks.solve(u);
    const PairResult<dim> result = blocks.contact().results().pairs()[0];
    Answer answer;
    answer.displacement = u;
    answer.ratio = result.friction_force / result.normal_force;
    answer.n_slipping = result.n_slipping;
    answer.n_active = result.n_active;
    answer.reason = blocks.contact().iteration().reason;
    return answer;
  }

  bool is_right(const Answer &answer, const double aside,
                const std::string &name)
  {
    if (hosts::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << name << ": " << answer.n_slipping << " of "
                << answer.n_active << " slip, T/N " << answer.ratio
                << std::endl;
    const auto check =
        [&](const double value, const double bound, const char *const what)
    { return hosts::is_at_most(value, bound, name + ": " + what); };
    const bool converged =
        check(answer.reason == ABUT_REASON_CONVERGED ? 0. : 1., 0.,
              "failure to converge");
    if (aside == all)
      return check(answer.n_slipping == answer.n_active ? 0. : 1., 0., "stick")
             && check(std::abs(answer.ratio / mu - 1.), 1e-9,
                      "friction other than mu times the pressure")
             && converged;
    return check(answer.n_slipping > 0 && answer.n_slipping < answer.n_active
                     ? 0.
                     : 1.,
                 0., "lack of stick or slip")
           && converged;
  }

  bool agrees(const Answer &a, const Answer &b, const double bound,
              const std::string &name)
  {
    la::Vector difference(a.displacement);
    difference -= b.displacement;
    return hosts::is_at_most(difference.linfty_norm(),
                             bound * b.displacement.linfty_norm(),
                             name + ": difference of the displacements");
  }

  template <int dim> bool dual_mortar(const double aside)
  {
    using Linear = SolverParameters::Linear;
    const std::string name =
        std::to_string(dim) + "D" + (aside == all ? ", slides" : "");
    const auto way = ABUT_DISCRETISATION_DUAL_MORTAR;
    const Answer condensed =
        solve<dim>(way, System::condensed, Linear::direct, aside);
    const Answer direct =
        solve<dim>(way, System::saddle_point, Linear::direct, aside);
    const Answer iterative =
        solve<dim>(way, System::saddle_point, Linear::iterative, aside);
    bool good = is_right(condensed, aside, name + ", condensed");
    good = is_right(direct, aside, name + ", saddle point") && good;
    good = is_right(iterative, aside, name + ", iterations") && good;
    good = agrees(direct, condensed, 1e-12, name + ", saddle point") && good;
    return agrees(iterative, condensed, 1e-7, name + ", iterations") && good;
  }

  template <int dim> bool mortar(const double aside)
  {
    using Linear = SolverParameters::Linear;
    const std::string name =
        std::to_string(dim) + "D, mortar" + (aside == all ? ", slides" : "");
    const auto way = ABUT_DISCRETISATION_MORTAR;
    const Answer direct =
        solve<dim>(way, System::automatic, Linear::direct, aside);
    const Answer iterative =
        solve<dim>(way, System::saddle_point, Linear::iterative, aside);
    bool good = is_right(direct, aside, name);
    good = is_right(iterative, aside, name + ", iterations") && good;
    return agrees(iterative, direct, 1e-7, name + ", iterations") && good;
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  bool good = true;
  for (const double aside : {some, all})
  {
    good = dual_mortar<2>(aside) && good;
    good = mortar<2>(aside) && good;
  }
  good = dual_mortar<3>(some) && good;
  good = mortar<3>(some) && good;
  return good ? 0 : 1;
}

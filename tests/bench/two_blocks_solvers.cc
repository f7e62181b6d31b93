// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Linear solvers of contact on two elastic blocks with non-matching meshes,
// the secondary 3:2 finer, all rows in contact.
//
//     two_blocks_solvers DIMENSION COARSE REFINEMENTS METHOD [KAPPA]
//         [NAME=VALUE]...
//
// COARSE cells along the lower block's edge, 3/2 times as many along the upper
// one's, both halved REFINEMENTS times. METHOD is constraints, saddle, mortar
// (standard multipliers, saddle point) or springs (penalty of KAPPA times the
// local stiffness). Names: linear (auto, iterative, direct), tolerance,
// support (both, slide), ratio (of Young's moduli), poisson, augmentation,
// repeat (solves with the same matrix), open (each so many-th row is open).
#include "../solve/two_blocks.h"

#include <deal.II/base/timer.h>

#include <iostream>

using namespace abut;
using namespace abut::tests;

namespace
{
  struct Settings
  {
    TwoBlocksOptions blocks;
    SolverParameters solver;
    std::string method;
    double kappa = 50., tolerance = 1e-8;
    int repeat = 1, open = 0;
  };

  template <int dim> void run(const Settings &settings)
  {
    TwoBlocks<dim> blocks(MPI_COMM_WORLD, settings.blocks);
    for (int i = 0; i < blocks.rows.n_points; ++i)
      if (settings.open > 0 && i % settings.open == 0)
        blocks.set_open(i);
      else if (settings.method == "springs")
        blocks.set_spring(i, settings.kappa);
      else
        blocks.set_constraint(i);
    const bool saddle =
        settings.method == "saddle" || settings.method == "mortar";
    const auto solver = solve::make_row_solver(
        saddle ? System::saddle_point : System::automatic, settings.solver,
        blocks.operation);
    solver->set_near_null_space(blocks.space);
    dealii::Timer timer;
    solver->reinit(blocks.stiffness, blocks.operation, blocks.row_stiffness);
    const double reinit = timer.wall_time();
    la::Vector increment(blocks.residual);
    for (int k = 0; k < settings.repeat; ++k)
    {
      timer.restart();
      const LinearReport report = solver->solve(
          blocks.residual, blocks.request(settings.tolerance), 0., increment);
      const double seconds = timer.wall_time();
      const auto errors = blocks.errors(increment);
      const int n_rows =
          dealii::Utilities::MPI::sum(blocks.rows.n_points, MPI_COMM_WORLD);
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << "dofs " << blocks.n_dofs() << "  rows " << n_rows
                  << "  iterations " << report.n_iterations << "  products "
                  << report.n_matvecs << "  reinit " << reinit << " s  setup "
                  << report.setup_seconds << " s  solve "
                  << report.solve_seconds << " s  all " << seconds
                  << " s  errors " << errors.first << " " << errors.second
                  << "  " << report.method << std::endl;
    }
  }

  void set(Settings &settings, const std::string &word)
  {
    const auto at = word.find('=');
    const std::string name = word.substr(0, at);
    const std::string value =
        at == std::string::npos ? "" : word.substr(at + 1);
    using Linear = SolverParameters::Linear;
    using Support = TwoBlocksOptions::Support;
    if (name == "linear")
      settings.solver.linear = value == "direct"      ? Linear::direct
                               : value == "iterative" ? Linear::iterative
                                                      : Linear::automatic;
    else if (name == "support")
      settings.blocks.support =
          value == "slide" ? Support::slide : Support::both;
    else if (name == "tolerance")
      settings.tolerance = std::stod(value);
    else if (name == "ratio")
      settings.blocks.young_ratio = std::stod(value);
    else if (name == "poisson")
      settings.blocks.poisson = std::stod(value);
    else if (name == "angle")
      settings.blocks.angle = std::stod(value);
    else if (name == "augmentation")
      settings.solver.augmentation = std::stod(value);
    else if (name == "threshold")
      settings.solver.aggregation_threshold = std::stod(value);
    else if (name == "repeat")
      settings.repeat = std::stoi(value);
    else if (name == "open")
      settings.open = std::stoi(value);
    else
      throw std::runtime_error("What is " + word + "?");
  }
} // namespace

int
main(int argc, char **argv)
try
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 4)
  {
    std::cerr << "two_blocks_solvers DIMENSION COARSE REFINEMENTS METHOD "
                 "[KAPPA] [NAME=VALUE]...\n";
    return 2;
  }
  Settings settings;
  settings.solver.linear = SolverParameters::Linear::iterative;
  settings.blocks.n_lower = std::stoi(words[1]);
  settings.blocks.n_upper = settings.blocks.n_lower * 3 / 2;
  settings.blocks.refinements = std::stoi(words[2]);
  settings.method = words[3];
  if (settings.method == "mortar")
    settings.blocks.discretisation = ABUT_DISCRETISATION_MORTAR;
  for (std::size_t k = 4; k < words.size(); ++k)
    if (k == 4 && words[k].find('=') == std::string::npos)
      settings.kappa = std::stod(words[k]);
    else
      set(settings, words[k]);
  if (words[0] == "2")
    run<2>(settings);
  else
    run<3>(settings);
  return 0;
}
catch (const std::exception &error)
{
  std::cerr << error.what() << std::endl;
  return 1;
}

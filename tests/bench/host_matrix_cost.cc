// SPDX-License-Identifier: LGPL-2.1-or-later
// What it costs to take a host's matrix of another type: the time of
// ContactAssembler::copy_of(), by one pass over the entries with deal.II's own
// iterators, on a block of cells^3 hexahedra.
//     host_matrix_cost [CELLS]
#include <abut/dealii/contact_assembler.h>

#include <deal.II/base/timer.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/sparse_matrix.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

using namespace dealii;

namespace
{
  /** Median of nine, seconds. */
  template <typename Work> double seconds(const Work &work)
  {
    std::vector<double> times(9);
    for (double &time : times)
    {
      Timer timer;
      work();
      time = timer.wall_time();
    }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
  }
} // namespace

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int cells = argc > 1 ? std::stoi(argv[1]) : 24;
  Triangulation<3> mesh;
  GridGenerator::subdivided_hyper_cube(mesh, cells);
  const FESystem<3> fe(FE_Q<3>(1), 3);
  DoFHandler<3> dofs(mesh);
  dofs.distribute_dofs(fe);
  AffineConstraints<double> constraints;
  constraints.close();
  DynamicSparsityPattern dynamic(dofs.n_dofs());
  DoFTools::make_sparsity_pattern(dofs, dynamic);
  SparsityPattern pattern;
  pattern.copy_from(dynamic);
  SparseMatrix<double> K(pattern);
  for (auto &entry : K)
    entry.value() = 1. + entry.row() + entry.column();
  abut::ContactAssembler<3> contact(MPI_COMM_SELF);
  const MappingQ<3> mapping(1);
  contact.reinit(mapping, dofs, constraints);

  double sum = 0.;
  const double pass = seconds(
      [&]
      {
        for (const auto &entry : K)
          sum += entry.value() * entry.column();
      });
  Timer timer;
  contact.copy_of(abut::Tangent(K));
  const double first = timer.wall_time();
  const double again = seconds([&] { contact.copy_of(abut::Tangent(K)); });
  std::printf("%zu entries: one pass %.4g s, copy %.2f of it, the first with "
              "its pattern %.1f (%g)\n",
              std::size_t(K.n_nonzero_elements()), pass, again / pass,
              first / pass, sum);
  return 0;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// The lines of the document that save a run and go on with it, between two
// objects that share nothing but the files: the next load step has the answer
// of the run that was not interrupted.
#include "elastic_blocks.h"
#include "expect.h"

#include <abut/dealii/contact_solver.h>

using namespace abut;
using hosts::expect;

// doc/your-program.md, see document_lines.py
template <int dim>
void save_run(const dealii::IndexSet &owned, const dealii::IndexSet &relevant,
              MPI_Comm communicator,
              dealii::parallel::distributed::Triangulation<dim> &triangulation,
              const dealii::DoFHandler<dim> &dof_handler,
              ContactAssembler<dim> &contact, const la::Vector &u);
template <int dim>
void load_run(dealii::parallel::distributed::Triangulation<dim> &triangulation,
              const dealii::Mapping<dim> &mapping,
              const dealii::DoFHandler<dim> &dof_handler,
              const dealii::AffineConstraints<double> &constraints,
              ContactAssembler<dim> &contact, la::Vector &u,
              const std::function<void()> &prepare);

namespace
{
  /** Two blocks, the upper one pressed down and drawn to the side. */
  struct Run
  {
    explicit Run(const unsigned int n_refinements)
        : blocks(hosts::BlockCase{1, n_refinements, {2, 3}})
    {
      ContactPair<2> pair;
      pair.name = "upper on lower";
      pair.secondary = {hosts::block_side::upper_interface};
      pair.primary = {hosts::block_side::lower_interface};
      auto friction = std::make_shared<Friction<2>>();
      friction->coefficient = [](const dealii::Point<2> &) { return 0.3; };
      pair.friction = friction;
      contact.set_pairs({pair});
    }

    void solve(la::Vector &u, const double down, const double aside)
    {
      blocks.move(hosts::block_side::top, dealii::Tensor<1, 2>({aside, -down}));
      blocks.constraints.distribute(u);
      contact.detect(u);
      la::Matrix matrix;
      la::Vector load, residual(u), step(u);
      blocks.assemble(matrix, load);
      do
      {
        matrix.vmult(residual, u);
        residual -= load;
        blocks.constraints.set_zero(residual);
        contact.solve(matrix, residual, step);
        u += step;
        blocks.constraints.distribute(u);
      } while (contact.update(u));
      expect(contact.iteration().reason == ABUT_REASON_CONVERGED,
             contact.iteration().explanation);
    }

    hosts::ElasticBlocks<2> blocks;
    ContactAssembler<2> contact{MPI_COMM_WORLD};
  };
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Run first(2);
  la::Vector u = first.blocks.start();
  first.contact.reinit(first.blocks.mapping, first.blocks.dof_handler,
                       first.blocks.constraints);
  first.solve(u, 0.02, 0.);
  first.contact.commit(u);
  first.solve(u, 0.02, 0.003);
  const la::Vector committed(u);
  save_run(first.blocks.dof_handler.locally_owned_dofs(), first.blocks.relevant,
           MPI_COMM_WORLD, first.blocks.triangulation, first.blocks.dof_handler,
           first.contact, u);
  first.solve(u, 0.02, 0.001);

  Run second(0);
  la::Vector again = second.blocks.start();
  load_run(
      second.blocks.triangulation, second.blocks.mapping,
      second.blocks.dof_handler, second.blocks.constraints, second.contact,
      again,
      [&]
      {
        auto &blocks = second.blocks;
        blocks.dof_handler.distribute_dofs(blocks.fe);
        blocks.relevant =
            dealii::DoFTools::extract_locally_relevant_dofs(blocks.dof_handler);
        blocks.move(hosts::block_side::top, {});
        again.reinit(blocks.dof_handler.locally_owned_dofs(), MPI_COMM_WORLD);
      });
  la::Vector difference(again);
  difference -= committed;
  expect(difference.linfty_norm() < 1e-14, "the displacement that was saved");
  second.solve(again, 0.02, 0.001);
  difference = again;
  difference -= u;
  expect(difference.linfty_norm() < 1e-9 * u.linfty_norm(),
         "the step after it");
  const PairResult<2> a = first.contact.results().pairs()[0],
                      b = second.contact.results().pairs()[0];
  expect(a.secondary_friction.norm() > 1e-6
             && (a.secondary_friction - b.secondary_friction).norm()
                    < 1e-6 * a.secondary_friction.norm(),
         "friction goes on from where it was: "
             + std::to_string(a.secondary_friction[0]) + " and "
             + std::to_string(b.secondary_friction[0]));
  return hosts::good ? 0 : 1;
}

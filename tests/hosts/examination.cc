// SPDX-License-Identifier: LGPL-2.1-or-later
// What an answer is worth, as a program that only has the public headers is
// told: a residual of wrong sign, obstacles turned round, strains that are not
// small, and motions that nothing holds.
#include "patch.h"

#include <abut/dealii/contact_solver.h>
#include <abut/dealii/rigid_obstacle.h>

using namespace abut;

namespace
{
  bool good = true;

  void expect(const bool holds, const std::string &what)
  {
    if (!holds && hosts::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "FAILED: " << what << std::endl;
    good = good && holds;
  }

  bool has(const ContactExamination &seen, const abut_failure failure,
           const bool is_error)
  {
    return std::any_of(seen.findings.begin(), seen.findings.end(),
                       [&](const ContactFinding &finding) {
                         return finding.failure == failure
                                && finding.is_error == is_error;
                       });
  }

  /** Blocks of modulus 7 and 3 under unit pressure; the stiffness of both is
   * multiplied by @p factor. */
  hosts::Case pressed(const double factor)
  {
    hosts::Case run;
    run.pressed = true;
    for (hosts::Material &material : run.materials)
      material.young *= factor;
    return run;
  }

  /** The problem of the blocks; @p sign of its residual, right if 1. */
  HostProblem problem(const hosts::TwoBlocks<2> &blocks, const double sign)
  {
    HostProblem result;
    result.linear = true;
    result.residual = [&blocks, sign](const la::Vector &u, la::Vector &residual)
    {
      blocks.stiffness().vmult(residual, u);
      residual -= blocks.load();
      blocks.constraints().set_zero(residual);
      residual *= sign;
    };
    result.tangent = [&blocks](const la::Vector &) -> const la::Matrix &
    { return blocks.stiffness(); };
    return result;
  }

  NewtonResult solve(hosts::TwoBlocks<2> &blocks, const double sign,
                     la::Vector &u)
  {
    return ContactSolver<2>(blocks.contact(), blocks.constraints(),
                            problem(blocks, sign))
        .solve(u);
  }

  /** A residual of wrong sign moves the bodies apart: nothing is in contact,
   * and nothing but the residual itself can tell. The upper block must be held
   * for there to be an answer at all, so it is glued on. */
  void check_sign()
  {
    hosts::Case run = pressed(1e3);
    run.tied = true;
    hosts::TwoBlocks<2> blocks(run);
    blocks.prepare({blocks.pair()});
    for (const double sign : {1., -1.})
    {
      la::Vector u = blocks.start();
      const NewtonResult result = solve(blocks, sign, u);
      if (sign > 0.)
        expect(result.converged(), "the right sign: " + result.explanation);
      else
        expect(result.reason == NewtonReason::unbalanced
                   && result.explanation.failure == ABUT_FAILURE_UNBALANCED
                   && result.explanation.text.find("sign") != std::string::npos,
               "the wrong sign: " + result.explanation);
      // The same for those with a loop of their own.
      la::Vector residual(u);
      problem(blocks, sign).residual(u, residual);
      const ContactExamination seen =
          blocks.contact().checks().examine(u, residual);
      expect(has(seen, ABUT_FAILURE_UNBALANCED, true) == (sign < 0.),
             "balance of an answer of sign " + std::to_string(sign));
      expect(sign < 0. ? seen.imbalance > 1. : seen.imbalance < 1e-6,
             "imbalance " + std::to_string(seen.imbalance));
    }
  }

  /** Uniform strain of unit pressure in plane strain: (1 - nu^2) / E of the
   * softer block, here E = 3 factor and nu = 0.2. */
  void check_strain()
  {
    for (const double strain : {0.01, 0.1, 0.4, 0.6})
    {
      hosts::TwoBlocks<2> blocks(pressed(0.32 / strain));
      blocks.prepare({blocks.pair()});
      la::Vector u = blocks.start();
      const NewtonResult result = solve(blocks, 1., u);
      expect(result.converged(), "strain: " + result.explanation);
      const ContactExamination seen = blocks.contact().checks().examine(u);
      expect(std::abs(seen.strain / strain - 1.) < 1e-6,
             "largest strain " + std::to_string(seen.strain) + " instead of "
                 + std::to_string(strain));
      expect(has(seen, ABUT_FAILURE_LARGE_STRAIN, false) == (strain == 0.1),
             "a warning of strain " + std::to_string(strain));
      // A host reads the value, not the sentence.
      for (const ContactFinding &finding : seen.findings)
        if (finding.failure == ABUT_FAILURE_LARGE_STRAIN)
          for (const auto &[name, value] : finding.numbers)
            expect(name != "largest strain"
                       || std::abs(value / strain - 1.) < 1e-6,
                   "number of the finding " + std::to_string(value));
      // A third in the mean is an error already.
      expect(has(seen, ABUT_FAILURE_LARGE_STRAIN, true) == (strain > 0.3)
                 && seen.is_usable() == (strain < 0.3),
             "an error of strain " + std::to_string(strain));
      expect(blocks.contact().checks().examine(u, {}, true).is_usable(),
             "large strain that is allowed");
    }
  }

  /** The upper block moved sideways by more than a quarter, its facet. */
  void check_slip()
  {
    hosts::TwoBlocks<2> blocks(pressed(1e3));
    blocks.prepare({blocks.pair()});
    la::Vector u = blocks.start();
    expect(solve(blocks, 1., u).converged(), "blocks that slide");
    for (const double way : {0.2, 0.6})
    {
      la::Vector moved(u);
      moved += blocks.sideways(way);
      const ContactExamination seen = blocks.contact().checks().examine(moved);
      const double slip = blocks.contact().results().pairs()[0].slip;
      expect(std::abs(slip - way) < 1e-2, "slip " + std::to_string(slip));
      // The facets of the lower block, a third, are the larger ones.
      expect(has(seen, ABUT_FAILURE_SLIDING, false) == (way > 0.5),
             "a word about a slip of " + std::to_string(way));
    }
  }

  /** All turned about the origin by @p angle, beside what @p u is. */
  la::Vector turned(const hosts::TwoBlocks<2> &blocks, const la::Vector &u,
                    const double angle)
  {
    la::Vector moved(u);
    std::vector<dealii::types::global_dof_index> dofs(
        blocks.dof_handler().get_fe().n_dofs_per_cell());
    for (const auto &cell : blocks.dof_handler().active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const auto [component, vertex] =
            blocks.dof_handler().get_fe().system_to_component_index(i);
        const dealii::Point<2> x = cell->vertex(vertex);
        if (u.locally_owned_elements().is_element(dofs[i]))
          moved(dofs[i]) =
              component == 0
                  ? (std::cos(angle) - 1.) * x[0] - std::sin(angle) * x[1]
                  : std::sin(angle) * x[0] + (std::cos(angle) - 1.) * x[1];
      }
    }
    moved.compress(dealii::VectorOperation::insert);
    return moved;
  }

  /** Both blocks turned: directions are those of before, and turned with the
   * bodies by the same angle, forces as well. */
  void check_turn()
  {
    for (const auto discretisation :
         {ABUT_DISCRETISATION_DUAL_MORTAR, ABUT_DISCRETISATION_NODE_TO_SEGMENT,
          ABUT_DISCRETISATION_QUADRATURE_POINT})
    {
      hosts::Case run = pressed(1e3);
      run.method.discretisation = discretisation;
      if (discretisation == ABUT_DISCRETISATION_QUADRATURE_POINT)
        run.method.options.law = abut_law_find("penalty");
      hosts::TwoBlocks<2> blocks(run);
      blocks.prepare({blocks.pair()});
      la::Vector u = blocks.start();
      expect(solve(blocks, 1., u).converged(), "blocks that turn");
      for (const double angle : {0., 0.03, -0.07, 0.2})
      {
        const ContactExamination seen =
            blocks.contact().checks().examine(turned(blocks, u, angle));
        const PairResult<2> pair = blocks.contact().results().pairs()[0];
        expect(std::abs(pair.rotation - std::abs(angle)) < 1e-9
                   && std::abs(pair.largest_rotation - std::abs(angle)) < 1e-9,
               "a turn of " + std::to_string(pair.rotation) + " instead of "
                   + std::to_string(angle));
        const dealii::Tensor<1, 2> &force = pair.secondary_force;
        const dealii::Tensor<1, 2> change(
            {(std::cos(angle) - 1.) * force[0] - std::sin(angle) * force[1],
             std::sin(angle) * force[0] + (std::cos(angle) - 1.) * force[1]});
        expect((pair.rotated_force - change).norm() < 1e-9 * force.norm(),
               "what the force changes by in a turn of "
                   + std::to_string(angle));
        // A resultant that was upright has a part to the side from a fiftieth.
        expect(has(seen, ABUT_FAILURE_SLIDING, false)
                       == (angle == 0.03 || angle == -0.07)
                   && has(seen, ABUT_FAILURE_SLIDING, true) == (angle > 0.1),
               "what is said of a turn of " + std::to_string(angle));
      }
    }
  }

  ContactPair<2> against(const std::shared_ptr<RigidObstacle<2>> &obstacle)
  {
    ContactPair<2> pair;
    pair.name = "press";
    pair.secondary = {hosts::top};
    pair.obstacle = obstacle;
    return pair;
  }

  /** Plates above the blocks, whose top is at height 1, turned round. */
  void check_turned()
  {
    hosts::Case run = pressed(1e3);
    for (const bool turned : {false, true})
      for (const bool hollow : {false, true})
      {
        abut_obstacle_shape shape = abut_obstacle_shape_defaults();
        shape.dimension = 2;
        shape.kind = ABUT_OBSTACLE_PLANE;
        shape.point[1] = 1.;
        shape.axis[1] = turned ? 1. : -1.;
        shape.hollow = hollow;
        const bool is_wrong = turned != hollow;
        hosts::TwoBlocks<2> blocks(run);
        blocks.prepare({against(std::make_shared<RigidObstacle<2>>(shape))});
        std::string message;
        try
        {
          blocks.contact().detect(blocks.displacement());
        }
        catch (const ContactError &error)
        {
          message = error.what();
        }
        // Five nodes: four cells.
        expect(is_wrong
                   ? message.find("ABUT-F23") != std::string::npos
                         && message.find("5 of 5 nodes") != std::string::npos
                   : message.empty(),
               "a plate turned round: '" + message + "'");
      }
  }

  /** A bar of half the width of a facet between two nodes of the top: it is
   * seen between them, by its depth. */
  void check_between_nodes()
  {
    abut_obstacle_shape shape = abut_obstacle_shape_defaults();
    shape.dimension = 2;
    shape.kind = ABUT_OBSTACLE_BOX;
    shape.point[0] = 0.375;
    shape.point[1] = 1. + 0.05 - 0.03;
    shape.size[0] = 0.125;
    shape.size[1] = 0.1;
    hosts::TwoBlocks<2> blocks(pressed(1e3));
    blocks.prepare({against(std::make_shared<RigidObstacle<2>>(shape))});
    const la::Vector rest = blocks.displacement();
    blocks.contact().detect(rest);
    const ContactExamination seen = blocks.contact().checks().examine(rest);
    expect(std::abs(seen.missed_depth - 0.03) < 1e-12,
           "depth of the bar: " + std::to_string(seen.missed_depth));
    expect(has(seen, ABUT_FAILURE_UNSEEN, true), "a bar that no node sees");
    dealii::Vector<float> depth;
    expect(std::abs(blocks.contact().checks().missed_depth(rest, depth) - 0.03)
               < 1e-12,
           "the same by cell");
    double x = 0.;
    for (const auto &cell : blocks.dof_handler().active_cell_iterators())
      if (depth(cell->active_cell_index()) > 0.)
        x = cell->center()[0];
    expect(std::abs(hosts::MPI::max(x, MPI_COMM_WORLD) - 0.375) < 1e-12,
           "the cell that the bar is in");
  }

  /** The upper block may slide, and the pair cannot hold it there; the tie
   * does. */
  void check_free_motion()
  {
    for (const bool tied : {false, true})
    {
      hosts::Case run = pressed(1e3);
      run.tied = tied;
      run.slides = true;
      hosts::TwoBlocks<2> blocks(run);
      blocks.prepare({blocks.pair()});
      blocks.contact().detect(blocks.displacement());
      std::string message;
      try
      {
        blocks.contact().checks().supports(blocks.stiffness());
      }
      catch (const SolverFailure &failure)
      {
        message = failure.what();
      }
      expect(tied
                 ? message.empty()
                 : message.find("ABUT-F12") != std::string::npos
                       && message.find("body 2 can slide") != std::string::npos,
             "a block that can slide: '" + message + "'");
    }
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_sign();
  check_strain();
  check_slip();
  check_turn();
  check_turned();
  check_between_nodes();
  check_free_motion();
  return good ? 0 : 1;
}

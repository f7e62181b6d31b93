// SPDX-License-Identifier: LGPL-2.1-or-later
// What fails on one rank alone is thrown on all of them, with one message, and
// no rank is left waiting.
#include "patch.h"

#include <abut/dealii/rigid_obstacle.h>

#include <limits>

using namespace abut;

namespace
{
  namespace MPI = dealii::Utilities::MPI;

  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  bool good = true;

  unsigned int me()
  {
    return MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  void expect(const bool holds, const std::string &what)
  {
    if (holds)
      return;
    good = false;
    std::cout << "FAILED on rank " << me() << ": " << what << std::endl;
  }

  /** @p function throws the same on all ranks, with all of @p words. Meeting
   * here shows that no rank waits elsewhere. */
  template <typename Function>
  void throws_everywhere(const std::string &what, const Function &function,
                         const std::vector<std::string> &words)
  {
    std::string message;
    try
    {
      function();
    }
    catch (const std::exception &error)
    {
      message = error.what();
    }
    for (const std::string &other : MPI::all_gather(MPI_COMM_WORLD, message))
    {
      expect(!other.empty(), what + ": no exception");
      expect(other == message,
             what + ": '" + message + "', not '" + other + "'");
    }
    for (const std::string &word : words)
      expect(message.find(word) != std::string::npos,
             what + ": '" + word + "' in '" + message + "'");
  }

  /** Faces of own cells with boundary id @p id. */
  template <typename Function>
  void for_each_face(const dealii::DoFHandler<2> &dof_handler,
                     const dealii::types::boundary_id id,
                     const Function &function)
  {
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == id)
            function(cell, face);
  }

  /** The highest rank that owns both nodes of a face of the upper interface. */
  unsigned int rank_at_interface(hosts::TwoBlocks<2> &blocks)
  {
    const auto &dof_handler = blocks.dof_handler();
    int found = -1;
    for_each_face(dof_handler, hosts::upper_interface,
                  [&](const auto &, const auto &face)
                  {
                    const auto &owned = dof_handler.locally_owned_dofs();
                    if (owned.is_element(face->vertex_dof_index(0, 0))
                        && owned.is_element(face->vertex_dof_index(1, 0)))
                      found = static_cast<int>(me());
                  });
    return static_cast<unsigned int>(MPI::max(found, MPI_COMM_WORLD));
  }

  /** A facet of one rank has no length. */
  void check_flat_facet()
  {
    hosts::TwoBlocks<2> blocks(hosts::Case{});
    blocks.prepare({blocks.pair()});
    const bool here = me() == rank_at_interface(blocks);
    bool done = !here;
    const auto &owned = blocks.dof_handler().locally_owned_dofs();
    for_each_face(blocks.dof_handler(), hosts::upper_interface,
                  [&](const auto &, const auto &face)
                  {
                    if (done || !owned.is_element(face->vertex_dof_index(0, 0))
                        || !owned.is_element(face->vertex_dof_index(1, 0)))
                      return;
                    face->vertex(1) = face->vertex(0);
                    done = true;
                  });
    blocks.forget();
    throws_everywhere("flat facet",
                      [&] { blocks.contact().detect(blocks.displacement()); },
                      {"interface", "facet"});
  }

  /** One unknown of one rank is not a number. */
  void check_displacement()
  {
    hosts::TwoBlocks<2> blocks(hosts::Case{});
    blocks.prepare({blocks.pair()});
    ContactAssembler<2> &contact = blocks.contact();
    la::Vector u = blocks.displacement();
    const bool here = me() == rank_at_interface(blocks);
    for_each_face(blocks.dof_handler(), hosts::upper_interface,
                  [&](const auto &, const auto &face)
                  {
                    const auto dof = face->vertex_dof_index(0, 1);
                    if (here && u.in_local_range(dof))
                      u(dof) = nan;
                  });
    u.compress(dealii::VectorOperation::insert);
    throws_everywhere("NaN in the displacement", [&] { contact.detect(u); },
                      {"interface", "displacement", "not finite"});
    contact.detect(blocks.displacement());
    throws_everywhere("NaN in the displacement of the check",
                      [&] { contact.checks().penetrations(u, 1e-6); },
                      {"interface", "displacement", "not finite"});
    // Nothing is left behind.
    contact.detect(blocks.displacement());
    expect(contact.results().measures().n_rows > 0, "rows after the errors");
  }

  /** The plane y = 0, on all ranks but one. */
  class Floor : public dealii::Function<2>
  {
  public:
    Floor(const bool throws, const bool is_bad)
        : throws_(throws), is_bad_(is_bad)
    {
    }

    double value(const dealii::Point<2> &p, const unsigned int) const override
    {
      if (throws_)
        throw std::runtime_error("the table of heights ends here");
      return is_bad_ ? nan : p[1];
    }

    dealii::Tensor<1, 2> gradient(const dealii::Point<2> &,
                                  const unsigned int) const override
    {
      return dealii::Point<2>(0., 1.);
    }

  private:
    const bool throws_, is_bad_;
  };

  void check_obstacle()
  {
    for (const bool throws : {true, false})
    {
      hosts::TwoBlocks<2> blocks(hosts::Case{});
      blocks.prepare({blocks.pair()});
      const bool here = me() == rank_at_interface(blocks);
      ContactPair<2> pair;
      pair.name = "floor";
      pair.secondary = {hosts::upper_interface};
      pair.obstacle = std::make_shared<RigidObstacle<2>>(
          std::make_shared<Floor>(here && throws, here));
      blocks.contact().set_pairs({pair});
      throws_everywhere(throws ? "obstacle that throws" : "obstacle of NaN",
                        [&] { blocks.contact().detect(blocks.displacement()); },
                        {"floor", throws ? "table of heights" : "finite"});
    }
  }

  /** A material that one rank does not know. */
  class Stress : public SurfaceTraction<2>
  {
  public:
    Stress(const bool throws, const bool is_bad)
        : throws_(throws), is_bad_(is_bad)
    {
    }

    void evaluate(const dealii::DoFHandler<2>::active_cell_iterator &,
                  const std::vector<dealii::Point<2>> &,
                  const std::vector<dealii::Tensor<1, 2>> &,
                  dealii::FullMatrix<double> &derivative) const override
    {
      if (throws_)
        throw std::runtime_error("no such material");
      derivative = 0.;
      derivative(0, 0) = is_bad_ ? nan : 1.;
    }

  private:
    const bool throws_, is_bad_;
  };

  void check_stress()
  {
    for (const bool throws : {true, false})
    {
      hosts::Case run;
      run.method =
          hosts::method("nitsche", ABUT_DISCRETISATION_QUADRATURE_POINT);
      hosts::TwoBlocks<2> blocks(run);
      blocks.prepare({blocks.pair()});
      const bool here = me() == rank_at_interface(blocks);
      blocks.contact().set_surface_traction(
          std::make_shared<Stress>(here && throws, here));
      throws_everywhere(throws ? "stress that throws" : "stress of NaN",
                        [&] { blocks.contact().detect(blocks.displacement()); },
                        {throws ? "no such material" : "stress"});
    }
  }

  bool law_fails = false;

  /** A law of the host that fails on one rank says so on all, in the words of
   * that rank. */
  void check_law()
  {
    static const abut_law *const penalty = abut_law_find("penalty");
    abut_law law = *penalty;
    law.linearise = [](const abut_law_points *points, const std::uint8_t *state,
                       abut_law_linearisation *result)
    {
      return law_fails ? ABUT_NOT_FINITE
                       : penalty->linearise(points, state, result);
    };
    hosts::Case run;
    run.method = hosts::method("penalty", std::nullopt);
    run.method.options.law = &law;
    hosts::TwoBlocks<2> blocks(run);
    blocks.prepare({blocks.pair()});
    law_fails = me() == rank_at_interface(blocks);
    la::Vector u = blocks.start();
    throws_everywhere("law that fails", [&] { blocks.solve(u); }, {"law"});
    law_fails = false;
  }

  /** A residual of which one rank's part is not a number stops all. */
  void check_residual()
  {
    hosts::TwoBlocks<2> blocks(hosts::Case{});
    blocks.prepare({blocks.pair()});
    const bool here = me() == rank_at_interface(blocks);
    la::Vector u = blocks.displacement(), residual(u), increment(u);
    if (here)
      residual(*u.locally_owned_elements().begin()) = nan;
    residual.compress(dealii::VectorOperation::insert);
    blocks.contact().detect(u);
    throws_everywhere(
        "NaN in the residual",
        [&]
        {
          blocks.contact().solve(blocks.stiffness(), residual, increment);
          expect(!blocks.contact().update(increment), "an end after NaN");
          throw std::runtime_error(blocks.contact().iteration().explanation);
        },
        {});
  }
  /** Entries for an unknown of another rank, which were not sent. */
  void check_entries()
  {
    if (MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
      return;
    hosts::TwoBlocks<2> blocks(hosts::Case{});
    blocks.prepare({blocks.pair()});
    const la::Vector u = blocks.displacement();
    la::Vector residual(u), increment(u);
    residual = 0.;
    // One of the program's own, as copies have no place for such entries.
    auto &matrix = const_cast<la::Matrix &>(blocks.stiffness());
    const auto refuses = [&](const std::string &what)
    {
      throws_everywhere(
          what, [&] { blocks.contact().solve(matrix, residual, increment); },
          {what, "other ranks", "compress("});
    };
    blocks.contact().detect(u);
    // A rank gives the unknowns of its cells to those of lower ranks.
    for (const auto &cell : blocks.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
        {
          const auto row = cell->vertex_dof_index(v, 0);
          if (u.in_local_range(row))
            continue;
          matrix.add(row, row, 1.);
          residual(row) += 1.;
        }
    refuses("matrix given to solve()");
    matrix.compress(dealii::VectorOperation::add);
    refuses("residual given to solve()");
    residual.compress(dealii::VectorOperation::add);
    residual = 0.;
    blocks.contact().solve(matrix, residual, increment);
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_flat_facet();
  check_displacement();
  check_obstacle();
  check_stress();
  check_law();
  check_residual();
  check_entries();
  return good ? 0 : 1;
}

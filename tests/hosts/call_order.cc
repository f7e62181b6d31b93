// SPDX-License-Identifier: LGPL-2.1-or-later
// Calls out of order, and after a change of the mesh that the assembler was not
// told of: an exception that names the call and what to do, on all ranks.
#include "nonlinear_blocks.h"

#include <functional>
#include <vector>

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

  /** @p call must throw, with both texts in what it says. */
  void refuses(const std::string &name, const std::string &remedy,
               const std::function<void()> &call)
  {
    std::string message;
    try
    {
      call();
    }
    catch (const std::exception &error)
    {
      message = error.what();
    }
    expect(message.find(name + "()") != std::string::npos
               && message.find(remedy) != std::string::npos,
           name + "() must ask for " + remedy
               + (message.empty() ? ", but does nothing" : ": " + message));
  }

  struct Call
  {
    std::string name;
    std::function<void()> make;
  };

  /** All calls that need rows, on vectors and a matrix of the host's. */
  std::vector<Call> calls(ContactAssembler<2> &contact, la::Matrix &matrix,
                          la::Vector &u, la::Vector &r)
  {
    return {
        {"linearise", [&] { contact.linearise(u); }},
        {"relax", [&] { contact.relax(matrix, r, 1, u); }},
        {"solve", [&] { contact.solve(matrix, r, u); }},
        {"add", [&] { contact.add(matrix, r); }},
        {"update", [&] { contact.update(u); }},
        {"solve_linearised", [&] { contact.solve_linearised(matrix, r, u); }},
        {"evaluate", [&] { contact.evaluate(u, r); }},
        {"add_forces", [&] { contact.results().add_forces(r); }},
        {"candidate_nodes", [&] { contact.results().candidate_nodes(); }},
        {"imbalance", [&] { contact.checks().imbalance(r, 1.); }},
        {"transfer_errors", [&] { contact.checks().transfer_errors(u); }},
        {"penetrations", [&] { contact.checks().penetrations(u, 1e-3); }},
    };
  }

  void check_order()
  {
    ContactAssembler<2> nothing(MPI_COMM_WORLD);
    Blocks blocks;
    la::Vector u(blocks.u), r(blocks.u);
    la::Matrix matrix;
    la::copy(blocks.problem().tangent(u).matrix(), matrix);
    refuses("detect", "reinit()", [&] { nothing.detect(u); });
    refuses("commit", "reinit()", [&] { nothing.commit(u); });
    for (const Call &call : calls(nothing, matrix, u, r))
      refuses(call.name, "reinit()", call.make);
    for (const Call &call : calls(blocks.contact, matrix, u, r))
      refuses(call.name, "detect()", call.make);
    blocks.contact.detect(u);
    refuses("update", "solve()", [&] { blocks.contact.update(u); });
    refuses("evaluate", "solve()", [&] { blocks.contact.evaluate(u, r); });
  }

  /** The mesh is refined, and reinit() forgotten. */
  void check_refinement()
  {
    Blocks blocks;
    la::Vector u(blocks.u), r(blocks.u);
    la::Matrix matrix;
    la::copy(blocks.problem().tangent(u).matrix(), matrix);
    blocks.contact.detect(u);
    blocks.refine();
    la::Vector new_u(blocks.u), new_r(blocks.u);
    la::Matrix new_matrix;
    la::copy(blocks.problem().tangent(new_u).matrix(), new_matrix);
    ContactAssembler<2> &contact = blocks.contact;
    refuses("detect", "reinit()", [&] { contact.detect(new_u); });
    refuses("detect", "reinit()", [&] { contact.detect(u); });
    refuses("pressure", "reinit()", [&] { contact.results().pressure(); });
    refuses("pairs", "reinit()", [&] { contact.results().pairs(); });
    for (const Call &call : calls(contact, new_matrix, new_u, new_r))
      refuses(call.name, "reinit()", call.make);

    // Or what is given is still that of the mesh before.
    contact.set_vertex_origins(std::vector<VertexOrigin>(3));
    refuses("set_vertex_origins", "vertices", [&] { blocks.reinit_contact(); });
    blocks.reinit_contact();
    refuses("detect", "after each change of the mesh",
            [&] { contact.detect(u); });
    contact.detect(new_u);
    refuses("solve", "matrix", [&] { contact.solve(matrix, new_r, new_u); });
    refuses("solve", "residual", [&] { contact.solve(new_matrix, r, new_u); });
    refuses("solve", "increment", [&] { contact.solve(new_matrix, new_r, u); });
    refuses("linearise", "displacement", [&] { contact.linearise(u); });
    contact.solve(new_matrix, new_r, new_u);
  }

  /** What penetrations() throws leaves no surface displaced. */
  void check_surfaces_after_failure()
  {
    Blocks blocks;
    la::Vector u(blocks.u);
    blocks.contact.detect(u);
    const la::Vector before = blocks.contact.results().gap();
    la::Vector far(blocks.uniform(1e160, -1e160));
    bool has_thrown = false;
    try
    {
      blocks.contact.checks().penetrations(far, 1e-3);
    }
    catch (const std::exception &error)
    {
      has_thrown = true;
    }
    expect(has_thrown, "a search of points out of range");
    blocks.contact.detect(u);
    la::Vector after = blocks.contact.results().gap();
    after -= before;
    expect(before.linfty_norm() > 0.9 * hosts::distance
               && after.linfty_norm() == 0.,
           "surfaces after a search that failed");
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_order();
  check_refinement();
  check_surfaces_after_failure();
  return good ? 0 : 1;
}

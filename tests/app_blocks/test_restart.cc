// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a restart is made of: checkpoints on the disk, the lock of a folder,
// signals, and meshes with fields as they were bit by bit.

#include "app/restart/checkpoint_store.h"
#include "app/restart/disk.h"
#include "app/restart/mesh_history.h"
#include "app/restart/run_identity.h"
#include "app/restart/run_lock.h"
#include "app/restart/saved_mesh.h"
#include "app/restart/stop_signal.h"

#include "problem.h"
#include "run_checks.h"

#include <deal.II/grid/grid_generator.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <limits>

using namespace abut;
using namespace abut::app;
namespace fs = std::filesystem;
namespace mpi = dealii::Utilities::MPI;

namespace
{
  unsigned int rank()
  {
    return mpi::this_mpi_process(MPI_COMM_WORLD);
  }

  fs::path empty_folder(const fs::path &folder)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank() == 0)
    {
      fs::remove_all(folder);
      fs::create_directories(folder);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    return folder;
  }

  /** Only rank 0 changes files, while the others wait. */
  void on_root(const std::function<void()> &action)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank() == 0)
      action();
    MPI_Barrier(MPI_COMM_WORLD);
  }

  void write_ranks(CheckpointStore &store, const std::string &text)
  {
    store.write(
        [&](const fs::path &folder)
        {
          write_to_disk(folder / ("rank." + std::to_string(rank())),
                        text + std::to_string(rank()));
        });
  }

  std::string text_of(const fs::path &checkpoint)
  {
    return read_from_disk(checkpoint / ("rank." + std::to_string(rank())));
  }

  void store_finds_what_is_whole(const fs::path &folder)
  {
    CheckpointStore store(empty_folder(folder), MPI_COMM_WORLD);
    Expect::that(!store.latest(), "no checkpoint in an empty folder");
    write_ranks(store, "first");
    write_ranks(store, "second");
    const fs::path second = folder / "checkpoint.2";
    Expect::that(store.latest() == second, "the second one is the latest");
    Expect::that(!fs::exists(folder / "checkpoint.1"), "the first one is gone");
    store.verify(second);
    Expect::that(text_of(second) == "second" + std::to_string(rank()),
                 "each rank's file");

    // What a kill leaves: one half written, one half removed, one not yet.
    on_root(
        [&]
        {
          fs::create_directory(folder / "checkpoint.3.new");
          std::ofstream(folder / "checkpoint.3.new/rank.0") << "half";
          fs::create_directory(folder / "checkpoint.9.old");
          fs::copy(second, folder / "checkpoint.1");
          std::ofstream(folder / "checkpoint.x") << "no checkpoint";
        });
    Expect::that(store.latest() == second, "neither unfinished nor outdated");
    write_ranks(store, "third");
    Expect::that(store.latest() == folder / "checkpoint.3", "the third");
    store.verify(folder / "checkpoint.3");
    Expect::that(text_of(folder / "checkpoint.3")
                     == "third" + std::to_string(rank()),
                 "nothing of the half is left");
    for (const char *name : {"checkpoint.1", "checkpoint.2", "checkpoint.9.old",
                             "checkpoint.3.new"})
      Expect::that(!fs::exists(folder / name), std::string(name) + " is gone");
    MPI_Barrier(MPI_COMM_WORLD);
    store.remove();
    Expect::that(!store.latest(), "all removed");
  }

  void store_keeps_the_last_if_writing_fails(const fs::path &folder)
  {
    CheckpointStore store(empty_folder(folder), MPI_COMM_WORLD);
    write_ranks(store, "good");
    bool failed = false;
    try
    {
      store.write([](const fs::path &) { throw std::runtime_error("full"); });
    }
    catch (const std::runtime_error &)
    {
      failed = true;
    }
    Expect::that(failed, "the failure is told");
    Expect::that(store.latest() == folder / "checkpoint.1", "the one before");
    store.verify(folder / "checkpoint.1");
  }

  void store_sees_damage(const fs::path &folder)
  {
    CheckpointStore store(empty_folder(folder), MPI_COMM_WORLD);
    const auto damaged = [&](const std::string &what, const auto &damage)
    {
      write_ranks(store, "content");
      const fs::path checkpoint = *store.latest();
      on_root([&] { damage(checkpoint); });
      Expect::input_error([&] { store.verify(checkpoint); }, "",
                          {"damaged", checkpoint.string(), what});
      MPI_Barrier(MPI_COMM_WORLD);
    };
    damaged("files were changed",
            [](const fs::path &checkpoint)
            {
              std::fstream file(checkpoint / "rank.0");
              file.seekp(2);
              file << '#'; // same size
            });
    damaged("files were changed", [](const fs::path &checkpoint)
            { fs::resize_file(checkpoint / "rank.0", 3); });
    damaged("files were changed", [](const fs::path &checkpoint)
            { fs::remove(checkpoint / "rank.0"); });
    damaged("files were changed", [](const fs::path &checkpoint)
            { std::ofstream(checkpoint / "more") << "x"; });
    damaged("contents", [](const fs::path &checkpoint)
            { fs::remove(checkpoint / "contents"); });
    damaged("files were changed",
            [](const fs::path &checkpoint)
            {
              fs::resize_file(checkpoint / "contents",
                              fs::file_size(checkpoint / "contents") - 1);
            });
  }

  /** Whether another process gets the lock of @p folder. */
  bool can_lock(const fs::path &folder)
  {
    const pid_t child = fork();
    if (child == 0)
    {
      try
      {
        const RunLock lock(folder, MPI_COMM_SELF);
      }
      catch (const InputError &error)
      {
        const std::string text = error.what();
        _exit(text.find("process") != std::string::npos ? 2 : 3);
      }
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    Expect::that(WIFEXITED(status) && WEXITSTATUS(status) != 3,
                 "the holder is named");
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  void one_run_for_a_folder(const fs::path &folder)
  {
    if (rank() > 0)
      return;
    fs::remove_all(folder);
    fs::create_directories(folder);
    {
      const RunLock lock(folder, MPI_COMM_SELF);
      Expect::that(!can_lock(folder), "a second process is refused");
      Expect::input_error([&] { const RunLock again(folder, MPI_COMM_SELF); },
                          "", {"another run", folder.string(), "--output"});
    }
    Expect::that(fs::is_empty(folder), "nothing is left of the lock");
    Expect::that(can_lock(folder), "free after the end");

    // A process that is killed leaves the file, but no lock.
    int ready[2];
    Expect::that(pipe(ready) == 0, "pipe");
    const pid_t child = fork();
    if (child == 0)
    {
      const RunLock lock(folder, MPI_COMM_SELF);
      if (write(ready[1], "x", 1) == 1)
        pause();
      _exit(0);
    }
    char byte;
    Expect::that(read(ready[0], &byte, 1) == 1, "the child has the lock");
    Expect::that(!can_lock(folder), "taken by the child");
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    Expect::that(!fs::is_empty(folder), "the file of the killed one");
    Expect::that(can_lock(folder), "free after a kill");
  }

  void signals_are_noted()
  {
    for (const int signal : {SIGTERM, SIGINT})
    {
      const StopSignal stop;
      Expect::that(!stop.has_come(MPI_COMM_WORLD), "not yet");
      const unsigned int last = mpi::n_mpi_processes(MPI_COMM_WORLD) - 1;
      if (rank() == last)
        raise(signal);
      Expect::that(stop.has_come(MPI_COMM_WORLD), "one rank is enough");
      Expect::that(stop.has_come(MPI_COMM_WORLD), "and it stays");
    }
    // The old handlers are back.
    struct sigaction action = {};
    sigaction(SIGTERM, nullptr, &action);
    Expect::that(action.sa_handler == SIG_DFL, "the handler of before");
  }

  void differences_are_named()
  {
    const RunIdentity before = {{"Mesh/Level", "3"}, {"a", "1"}, {"gone", "x"}};
    RunIdentity now = before;
    Expect::that(difference(before, now).empty(), "the same");
    now["Mesh/Level"] = "4";
    now.erase("gone");
    Expect::that(difference(before, now)
                     == "Mesh/Level was '3' and is '4'; gone was 'x' and is "
                        "nothing",
                 difference(before, now));
    for (int i = 0; i < 9; ++i)
      now["b" + std::to_string(i)] = "new";
    Expect::that(difference(before, now).find("and 6 more")
                     != std::string::npos,
                 difference(before, now));
  }

  /** Checkpoints of before names changed belong to the same runs. */
  void old_names_are_the_same()
  {
    const RunIdentity before = {
        {"Load steps/Steps", "3"}, {"Load steps/End time", "2"},
        {"Time/End", "1"},         {"Time/Scheme", "none"},
        {"Pair 2/Reach", "0"},     {"Body 1/Support", "3: 0, 0"}};
    RunIdentity now = {{"Time stepping/Number of steps", "3"},
                       {"Time stepping/End time", "2"},
                       {"Time stepping/Scheme", "quasi-static"},
                       {"Pair 2/Reach", "auto"},
                       {"Body 1/Prescribed displacement", "3: 0, 0"}};
    const auto found = [&]
    { return difference(with_present_names(before, now), now); };
    Expect::that(found().empty(), found());
    now["Time stepping/Number of steps"] = "4";
    now["Pair 2/Reach"] = "0.5";
    Expect::that(found()
                     == "Pair 2/Reach was '0' and is '0.5'; Time "
                        "stepping/Number of steps was '3' and is '4'",
                 found());
  }

  void values_keep_all_bits()
  {
    using Optional = std::optional<double>;
    const std::map<std::string, std::vector<Optional>> before = {
        {"a", {1. / 3., {}, -0., std::numeric_limits<double>::denorm_min()}},
        {"b", {}}};
    std::map<std::string, std::vector<Optional>> after;
    from_bytes(to_bytes(before), after);
    Expect::that(before == after, "map of vectors");
    Expect::that(std::signbit(*after["a"][2]), "the sign of zero");
  }

  /** Refine about a point that moves, coarsen behind it. */
  template <int dim>
  void change(typename MeshHistory<dim>::Mesh &mesh, const double angle)
  {
    dealii::Point<dim> centre;
    centre[0] = 0.9 * std::cos(angle);
    centre[1] = 0.9 * std::sin(angle);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const double distance = cell->center().distance(centre);
        if (distance < 0.4)
          cell->set_refine_flag();
        else if (distance > 1.3)
          cell->set_coarsen_flag();
      }
    mesh.execute_coarsening_and_refinement();
  }

  /** A curved coarse mesh: manifold and boundary ids are not saved. */
  template <int dim> struct Ball : Problem<dim>
  {
    explicit Ball(const unsigned int degree)
        : Problem<dim>(degree), history(this->mesh)
    {
      dealii::GridGenerator::hyper_ball(this->mesh);
    }

    MeshHistory<dim> history;
  };

  /** All that numbers follow from: cells in their order, where they are, their
   * ranks and their unknowns. */
  template <int dim> std::string numbering(const Problem<dim> &problem)
  {
    std::ostringstream text;
    text.precision(17);
    std::vector<dealii::types::global_dof_index> dofs(
        problem.fe.n_dofs_per_cell());
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      text << cell->id() << ' ' << cell->subdomain_id() << ' '
           << cell->center();
      if (!cell->is_artificial())
      {
        cell->get_dof_indices(dofs);
        for (const auto dof : dofs)
          text << ' ' << dof;
      }
      text << '\n';
    }
    return text.str();
  }

  const char *const formula = "exp(x) * sin(3 * y) + 1 / 3";

  template <int dim>
  void mesh_comes_back(const fs::path &folder, const unsigned int degree)
  {
    empty_folder(folder);
    Ball<dim> before(degree);
    before.mesh.refine_global(2);
    for (int i = 0; i < 4; ++i)
      change<dim>(before.mesh, i);
    before.distribute();
    la::Vector field(before.owned, MPI_COMM_WORLD);
    field = before.interpolate(formula);
    const MeshPart part = save_mesh<dim>(folder, before.mesh, before.history,
                                         before.dof_handler, {field});

    Ball<dim> same(degree);
    const auto fields =
        load_mesh<dim>(folder, &part, 1, same.mesh, same.history,
                       same.dof_handler, [&] { same.distribute(); });
    Expect::that(numbering(same) == numbering(before),
                 "cells and unknowns in the same order, 1: same ranks");
    Expect::that(owned_values(fields[0]) == part.fields[0],
                 "the field bit by bit");
    // Whatever is done next is the same, too.
    change<dim>(before.mesh, 4.);
    change<dim>(same.mesh, 4.);
    before.distribute();
    same.distribute();
    Expect::that(numbering(same) == numbering(before),
                 "cells and unknowns in the same order, 2: refined further");

    // Without the notes: the same cells and field, however numbered.
    Ball<dim> loaded(degree);
    const auto other =
        load_mesh<dim>(folder, nullptr, 1, loaded.mesh, loaded.history,
                       loaded.dof_handler, [&] { loaded.distribute(); });
    const la::Vector exact = loaded.interpolate(formula);
    double difference = 0.;
    for (const auto i : other[0].locally_owned_elements())
      difference = std::max(difference, std::abs(other[0](i) - exact(i)));
    Expect::near(mpi::max(difference, MPI_COMM_WORLD), 0., 1e-15,
                 "field loaded by p4est");
    Expect::that(!loaded.history.is_known(), "its history is not known");
  }

  /** A mesh saved on other numbers of ranks: on one by rank 0 alone. */
  template <int dim> void mesh_of_other_ranks(const fs::path &folder)
  {
    if (mpi::n_mpi_processes(MPI_COMM_WORLD) == 1)
      return;
    empty_folder(folder);
    dealii::types::global_dof_index n_cells = 0;
    {
      MPI_Comm part;
      MPI_Comm_split(MPI_COMM_WORLD, rank() == 0 ? 0 : MPI_UNDEFINED, 0, &part);
      if (rank() == 0)
      {
        dealii::parallel::distributed::Triangulation<dim> mesh(part);
        const MeshHistory<dim> history(mesh);
        dealii::GridGenerator::hyper_ball(mesh);
        mesh.refine_global(2);
        for (int i = 0; i < 4; ++i)
          change<dim>(mesh, i);
        const dealii::FE_Q<dim> fe(2);
        dealii::DoFHandler<dim> dof_handler(mesh);
        dof_handler.distribute_dofs(fe);
        la::Vector field(dof_handler.locally_owned_dofs(), part);
        dealii::VectorTools::interpolate(dealii::MappingQ<dim>(1), dof_handler,
                                         Expression<dim>(formula, "u"), field);
        save_mesh<dim>(folder, mesh, history, dof_handler, {field});
        n_cells = mesh.n_global_active_cells();
      }
      if (part != MPI_COMM_NULL)
        MPI_Comm_free(&part);
    }
    Ball<dim> loaded(2);
    const auto fields =
        load_mesh<dim>(folder, nullptr, 1, loaded.mesh, loaded.history,
                       loaded.dof_handler, [&] { loaded.distribute(); });
    n_cells = mpi::broadcast(MPI_COMM_WORLD, n_cells);
    Expect::that(loaded.mesh.n_global_active_cells() == n_cells,
                 "cells on other ranks");
    la::Vector exact(fields[0]), difference(fields[0]);
    dealii::VectorTools::interpolate(loaded.mapping, loaded.dof_handler,
                                     Expression<dim>(formula, "u"), exact);
    difference -= exact;
    Expect::near(difference.linfty_norm(), 0., 1e-15, "field on other ranks");
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(argc, argv,
                    [](const fs::path &folder)
                    {
                      store_finds_what_is_whole(folder / "store");
                      store_keeps_the_last_if_writing_fails(folder / "fails");
                      store_sees_damage(folder / "damage");
                      one_run_for_a_folder(folder / "lock");
                      signals_are_noted();
                      differences_are_named();
                      old_names_are_the_same();
                      values_keep_all_bits();
                      for (const unsigned int degree : {1, 2})
                      {
                        mesh_comes_back<2>(folder / "mesh", degree);
                        mesh_comes_back<3>(folder / "mesh", degree);
                      }
                      mesh_of_other_ranks<2>(folder / "ranks");
                      mesh_of_other_ranks<3>(folder / "ranks");
                    });
}

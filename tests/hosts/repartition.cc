// SPDX-License-Identifier: LGPL-2.1-or-later
// The mesh is cut anew between two solves: displacement and pressures are taken
// along. At once the nodes have the pressures and states that they had, though
// other ranks own them, and the next solve has nothing left to do. The same
// while the mesh is refined.
#include "patch.h"

#include <abut/dealii/rigid_obstacle.h>

#include <map>
#include <sstream>

using namespace abut;

namespace
{
  namespace MPI = dealii::Utilities::MPI;
  using dealii::Tensor;

  bool good = true;

  void expect(const bool holds, const std::string &what)
  {
    if (!holds && MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "FAILED: " << what << std::endl;
    good = good && holds;
  }

  bool is_of_interface(const dealii::types::boundary_id id)
  {
    return id == hosts::lower_interface || id == hosts::upper_interface;
  }

  /** Ranks of the cells at the interface, by side and number of the cell; the
   * same on all ranks. */
  template <int dim>
  std::map<std::string, unsigned int>
  owners(const dealii::DoFHandler<dim> &dof_handler)
  {
    std::vector<std::string> mine;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && is_of_interface(face->boundary_id()))
            mine.push_back(cell->id().to_string());
    const auto all = MPI::all_gather(MPI_COMM_WORLD, mine);
    std::map<std::string, unsigned int> result;
    for (unsigned int rank = 0; rank < all.size(); ++rank)
      for (const std::string &cell : all[rank])
        result[cell] = rank;
    return result;
  }

  /** Cells of the two sides whose owner, or that of the cell that they were
   * made of, has changed since @p before. */
  template <int dim>
  std::array<unsigned int, 2>
  n_moved(const dealii::DoFHandler<dim> &dof_handler,
          const std::map<std::string, unsigned int> &before)
  {
    std::array<unsigned int, 2> result = {{0, 0}};
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      auto old = before.find(cell->id().to_string());
      if (old == before.end() && cell->level() > 0)
        old = before.find(cell->parent()->id().to_string());
      if (old != before.end()
          && old->second != MPI::this_mpi_process(MPI_COMM_WORLD))
        ++result[cell->material_id()];
    }
    for (unsigned int &n : result)
      n = MPI::sum(n, MPI_COMM_WORLD);
    return result;
  }

  /** Pressure and state of a node of the secondary surface. */
  template <int dim> struct NodeState
  {
    Tensor<1, dim> pressure;
    double status;
  };

  /** Positions in units of 1e-9. */
  template <int dim> using Place = std::array<std::int64_t, dim>;

  /** Those of all vertices, by position; the same on all ranks. */
  template <int dim>
  std::map<Place<dim>, NodeState<dim>>
  nodes(const dealii::DoFHandler<dim> &dof_handler,
        const ContactAssembler<dim> &contact)
  {
    const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
    la::Vector pressure(dof_handler.locally_owned_dofs(), relevant,
                        MPI_COMM_WORLD),
        status(pressure);
    // Copied, because a temporary would be moved, and the ghosts be lost.
    const la::Vector p = contact.results().pressure(),
                     s = contact.results().status();
    pressure = p;
    status = s;
    std::vector<double> mine;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary()
              && face->boundary_id() == hosts::upper_interface)
            for (const unsigned int v : face->vertex_indices())
            {
              for (unsigned int d = 0; d < dim; ++d)
                mine.push_back(face->vertex(v)[d]);
              for (unsigned int d = 0; d < dim; ++d)
                mine.push_back(pressure(face->vertex_dof_index(v, d)));
              mine.push_back(status(face->vertex_dof_index(v, 0)));
            }
    std::map<Place<dim>, NodeState<dim>> result;
    for (const auto &some : MPI::all_gather(MPI_COMM_WORLD, mine))
      for (auto x = some.begin(); x != some.end(); x += 2 * dim + 1)
      {
        Place<dim> place;
        NodeState<dim> node;
        for (unsigned int d = 0; d < dim; ++d)
        {
          place[d] = std::llround(1e9 * x[d]);
          node.pressure[d] = x[dim + d];
        }
        node.status = x[2 * dim];
        result[place] = node;
      }
    return result;
  }

  /** All nodes of @p before have the same pressure and state @p after. */
  template <int dim>
  void compare(const std::map<Place<dim>, NodeState<dim>> &before,
               const std::map<Place<dim>, NodeState<dim>> &after,
               const std::string &name)
  {
    double largest = 0., difference = 0.;
    unsigned int n_missing = 0, n_other = 0;
    for (const auto &[place, node] : before)
    {
      largest = std::max(largest, node.pressure.norm());
      const auto found = after.find(place);
      if (found == after.end())
      {
        ++n_missing;
        continue;
      }
      difference =
          std::max(difference, (found->second.pressure - node.pressure).norm());
      // A hanging node has no state, but may hang no more.
      n_other += node.status >= 0. && found->second.status != node.status;
    }
    expect(n_missing == 0, name + "nodes are missing");
    expect(n_other == 0, name + std::to_string(n_other) + " other states");
    expect(difference <= 1e-10 * largest && largest > 0.,
           name + "pressures differ by " + std::to_string(difference) + " of "
               + std::to_string(largest));
  }

  /** What is done to the mesh. */
  struct Cut
  {
    unsigned int weight;
    bool refine;
  };

  /** Of the forces, relative. */
  template <int dim>
  double difference(const PairResult<dim> &a, const PairResult<dim> &b)
  {
    return (a.secondary_force - b.secondary_force).norm()
           / b.secondary_force.norm();
  }

  /** @p other: instead of the pair of the two blocks, or null. */
  template <int dim>
  void check(const hosts::Case &run, const ContactPair<dim> *other = nullptr)
  {
    // Nodal pressures of points are means, which a finer mesh has others of.
    const bool has_points =
        run.method.discretisation == ABUT_DISCRETISATION_QUADRATURE_POINT;
    hosts::TwoBlocks<dim> blocks(run);
    ContactPair<dim> pair = other != nullptr ? *other : blocks.pair();
    // All rows from the start on, or a later search would find more.
    pair.reach = 1.;
    blocks.prepare({pair});
    ContactAssembler<dim> &contact = blocks.contact();
    la::Vector u = blocks.start();
    const hosts::Errors first = blocks.solve(u);
    const std::string name = run.name + ", " + std::to_string(dim) + "D";
    expect(first.reason == ABUT_REASON_CONVERGED && first.n_active > 0
               && first.n_active < first.n_rows,
           name + ": part in contact");
    std::ostringstream line;
    line << name << ": " << first.n_active << " of " << first.n_rows
         << " rows in contact after " << first.steps << " systems";

    hosts::Errors refined;
    for (const Cut cut :
         {Cut{100, false}, Cut{10000, false}, Cut{100, true}, Cut{1000, false}})
    {
      const std::string step = name + ", weight " + std::to_string(cut.weight)
                               + (cut.refine ? ", refined: " : ": ");
      const PairResult<dim> old = contact.results().pairs().at(0);
      const auto old_owners = owners(blocks.dof_handler());
      const auto before = nodes(blocks.dof_handler(), contact);
      // Swapped, because Tpetra vectors of deal.II 9.8 have no move assignment:
      // u would keep the partition that it had.
      la::Vector moved_u = blocks.repartition(u, cut.weight, cut.refine);
      u.swap(moved_u);
      const auto moved = n_moved(blocks.dof_handler(), old_owners);
      expect(moved[0] + moved[1] > 0
                 || MPI::n_mpi_processes(MPI_COMM_WORLD) == 1,
             step + "no cell at the interface has moved");

      contact.detect(u);
      const auto after = nodes(blocks.dof_handler(), contact);
      const PairResult<dim> carried = contact.results().pairs().at(0);
      if (!cut.refine || !has_points)
        compare<dim>(before, after, step);
      if (cut.refine)
        expect(after.size() > before.size(), step + "number of nodes");
      else
      {
        expect(after.size() == before.size(), step + "number of nodes");
        expect(carried.n_active == old.n_active, step + "rows in contact");
        expect(difference(carried, old) <= 1e-10, step + "force carried");
      }

      const hosts::Errors warm = blocks.solve(u);
      const PairResult<dim> now = contact.results().pairs().at(0);
      expect(warm.reason == ABUT_REASON_CONVERGED, step + "convergence");
      line << "; weight " << cut.weight << (cut.refine ? ", refined" : "")
           << ": " << moved[0] << " + " << moved[1] << " cells moved, "
           << warm.steps << " systems";
      if (!cut.refine)
      {
        line << ", forces differ by " << difference(now, old);
        expect(warm.steps <= 2 && warm.steps < first.steps,
               step + "systems after the transfer");
        expect(now.n_active == old.n_active,
               step + "rows in contact at the end");
        expect(difference(now, old) <= 1e-8, step + "another force");
      }
      else
        refined = warm;
    }

    const PairResult<dim> last = contact.results().pairs().at(0);
    blocks.forget();
    u = blocks.start();
    const hosts::Errors cold = blocks.solve(u);
    const PairResult<dim> alone = contact.results().pairs().at(0);
    line << "; refined, without transfer: " << cold.steps
         << " systems, forces differ by " << difference(alone, last);
    expect(refined.steps < cold.steps, name + ": as many systems as without");
    expect(alone.n_active == last.n_active && difference(alone, last) <= 1e-8,
           name + ": another answer than without transfer");
    if (MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << line.str() << std::endl;
  }

  hosts::Case wedge(const std::string &law,
                    const std::optional<abut_discretisation> discretisation,
                    const std::string &name)
  {
    hosts::Case run;
    run.name = law + ", " + name;
    run.method = hosts::method(law, discretisation);
    run.method.options.gap_tolerance = 1e-9;
    run.method.options.pressure_tolerance = 1e-8;
    // Closed on one side only.
    run.tilt = 0.5;
    return run;
  }

  template <int dim> void check_all()
  {
    check<dim>(wedge("lagrange", std::nullopt, "blocks"));
    check<dim>(wedge("augmented lagrangian", std::nullopt, "blocks"));
    check<dim>(wedge("augmented lagrangian",
                     ABUT_DISCRETISATION_QUADRATURE_POINT, "blocks at points"));

    abut_obstacle_shape shape = abut_obstacle_shape_defaults();
    shape.dimension = dim;
    Tensor<1, dim> up;
    up[dim - 1] = 1.;
    up = hosts::rotation<dim>() * up;
    for (int d = 0; d < dim; ++d)
      shape.axis[d] = up[d];
    ContactPair<dim> pair;
    pair.name = "upper block on a plane";
    pair.secondary = {hosts::upper_interface};
    pair.obstacle = std::make_shared<RigidObstacle<dim>>(shape);
    check<dim>(wedge("lagrange", std::nullopt, "plane"), &pair);
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_all<2>();
  check_all<3>();
  return good ? 0 : 1;
}

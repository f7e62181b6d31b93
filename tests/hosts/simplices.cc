// SPDX-License-Identifier: LGPL-2.1-or-later
// Two blocks of triangles and tetrahedra, on meshes that each rank has for
// itself, that all ranks know, and of which each knows a part; the last two
// with hexahedra as well: patch test, friction, and a history that other ranks
// read.
#include "patch.h"
#include "two_blocks_members.h"

#include <sstream>

using namespace abut;

namespace
{
  bool good = true;

  hosts::Case named(hosts::Case one, const std::string &name)
  {
    one.name = name;
    return one;
  }

  template <int dim, class Mesh>
  void run(const hosts::Case &one, const std::string &name)
  {
    if (hosts::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
      good = hosts::passes_either_way<dim, Mesh>(one, name, 1e-11) && good;
    else
      good = hosts::passes<dim, Mesh>(named(one, name), 1e-11) && good;
  }

  hosts::Case make(const bool simplices, const unsigned int degree,
                   const std::array<unsigned int, 2> &cells)
  {
    hosts::Case one;
    one.simplices = simplices;
    one.uniform = true;
    one.degree = degree;
    one.cells = cells;
    return one;
  }

  /** Triangles or tetrahedra below, quadrilaterals or hexahedra above, or with
   * @p swapped the other way round. */
  hosts::Case mixed(const unsigned int degree, const unsigned int cube_degree,
                    const std::array<unsigned int, 2> &cells,
                    const bool swapped = false)
  {
    hosts::Case one = make(!swapped, swapped ? cube_degree : degree, cells);
    one.other_degree = swapped ? degree : cube_degree;
    return one;
  }

  hosts::Case with_mortar(hosts::Case one)
  {
    one.method = hosts::method("lagrange", ABUT_DISCRETISATION_MORTAR);
    return one;
  }

  hosts::Case tied(hosts::Case one)
  {
    one.tied = true;
    one.materials = {{{3., 0.2}, {3., 0.2}}};
    return one;
  }

  /** What all kinds of meshes have. */
  template <class Mesh2, class Mesh3> void run_mesh(const std::string &mesh)
  {
    run<2, Mesh2>(make(true, 2, {{2, 3}}), mesh + ", quadratic triangles");
    run<3, Mesh3>(make(true, 1, {{2, 3}}), mesh + ", tetrahedra");
    run<3, Mesh3>(make(true, 2, {{1, 2}}), mesh + ", quadratic tetrahedra");
    run<3, Mesh3>(make(false, 1, {{2, 3}}), mesh + ", hexahedra");
    run<2, Mesh2>(mixed(2, 1, {{2, 3}}),
                  mesh + ", triangles and quadrilaterals");
    run<3, Mesh3>(mixed(1, 1, {{2, 3}}), mesh + ", tetrahedra and hexahedra");
    run<3, Mesh3>(mixed(2, 1, {{1, 2}}, true),
                  mesh + ", hexahedra and quadratic tetrahedra");
  }

  void run_methods()
  {
    using Mesh2 = dealii::Triangulation<2>;
    using Mesh3 = dealii::Triangulation<3>;
    run<2, Mesh2>(make(true, 1, {{3, 4}}), "triangles");
    run<2, Mesh2>(with_mortar(make(true, 1, {{3, 4}})), "triangles, mortar");
    run<3, Mesh3>(with_mortar(make(true, 1, {{2, 3}})), "tetrahedra, mortar");
    for (const unsigned int degree : {1, 2})
    {
      const std::string name = " of degree " + std::to_string(degree);
      run<3, Mesh3>(tied(make(true, degree, {{1, 2}})),
                    "tied tetrahedra" + name);
      hosts::Case one = make(true, degree, {{3, 4}});
      one.uniform = false;
      run<2, Mesh2>(one, "triangles with hanging nodes" + name);
      for (const unsigned int cube_degree : {1, 2})
      {
        const std::string both =
            name + " and cubes of degree " + std::to_string(cube_degree);
        run<2, Mesh2>(with_mortar(mixed(degree, cube_degree, {{3, 4}})),
                      "triangles" + both);
        hosts::Case hanging = mixed(degree, cube_degree, {{3, 4}});
        hanging.uniform = false;
        run<2, Mesh2>(hanging, "with hanging nodes, triangles" + both);
        run<3, Mesh3>(with_mortar(mixed(degree, cube_degree, {{1, 2}})),
                      "tetrahedra" + both);
      }
      run<3, Mesh3>(tied(mixed(degree, 1, {{1, 2}})),
                    "tied tetrahedra and hexahedra" + name);
    }
  }

  /** What slides everywhere has the friction mu times the pressure. */
  template <class Mesh>
  void slide(const unsigned int degree, const std::string &mesh)
  {
    constexpr double mu = 0.3;
    hosts::Case one = make(true, degree, {{1, 2}});
    one.aside = 2.;
    hosts::TwoBlocks<3, Mesh> blocks(one);
    ContactPair<3> pair = blocks.pair();
    auto friction = std::make_shared<Friction<3>>();
    friction->coefficient = [](const dealii::Point<3> &) { return mu; };
    pair.friction = friction;
    blocks.prepare({pair});
    la::Vector u = blocks.start();
    const std::string name =
        mesh + ", friction on tetrahedra of degree " + std::to_string(degree);
    const auto check = [&](const double value, const std::string &what)
    { good = hosts::is_at_most(value, 1e-9, name + ": " + what) && good; };
    check(blocks.solve(u).reason == ABUT_REASON_CONVERGED ? 0. : 1.,
          "failure to converge");
    const PairResult<3> result = blocks.contact().results().pairs()[0];
    check(result.n_slipping == result.n_active ? 0. : 1., "stick");
    check(std::abs(result.friction_force / result.normal_force / mu - 1.),
          "friction other than mu times the pressure");
  }

  /** A history belongs to nodes of the mesh, whatever ranks these have: read by
   * each rank for itself, pressures of a mesh that all have written are those
   * of a new computation. */
  template <class Mesh>
  void read_elsewhere(const bool simplices, const std::string &mesh)
  {
    hosts::Case one = make(simplices, simplices ? 2 : 1, {{2, 2}});
    one.tilt = 0.5; // opens a part
    using Serial = dealii::Triangulation<3>;
    hosts::TwoBlocks<3, Mesh> written(one);
    hosts::TwoBlocks<3, Serial> computed(one), read(one);
    std::ostringstream file;
    written.prepare({written.pair()});
    la::Vector u = written.start();
    written.solve(u);
    written.contact().commit(u);
    written.contact().state().save(file);
    computed.prepare({computed.pair()});
    la::Vector v = computed.start();
    computed.solve(v);
    read.prepare({read.pair()});
    std::istringstream stream(
        hosts::MPI::broadcast(MPI_COMM_WORLD, file.str()));
    read.contact().state().load(stream);
    // Fields depend on the part of the surface that a search finds covered.
    for (hosts::TwoBlocks<3, Serial> *blocks : {&computed, &read})
      blocks->contact().detect(v);
    const la::Vector exact = computed.contact().results().pressure();
    la::Vector difference = read.contact().results().pressure();
    difference -= exact;
    const PairResult<3> result = computed.contact().results().pairs()[0];
    const std::string name = mesh + ", history: ";
    good =
        hosts::is_at_most(difference.linfty_norm(), 1e-9 * exact.linfty_norm(),
                          name + "difference of pressures")
        && hosts::is_at_most(result.n_active, 8., // of 9 nodes
                             name + "rows in contact")
        && good;
  }

  /** The patch test on the first two of three ranks. */
  template <class Mesh>
  void run_on_two(const hosts::Case &one, const std::string &name)
  {
    const unsigned int rank = hosts::MPI::this_mpi_process(MPI_COMM_WORLD);
    MPI_Comm part;
    MPI_Comm_split(MPI_COMM_WORLD, rank < 2 ? 0 : 1, rank, &part);
    const hosts::Errors errors = hosts::TwoBlocks<3, Mesh>(one, part).solve();
    MPI_Comm_free(&part);
    good = hosts::is_at_most(errors.stress, 1e-11, name + ": stress")
           && hosts::is_at_most(errors.imbalance, 1e-11, name + ": balance")
           && good;
  }

  template <class Mesh2, class Mesh3> void run_parallel(const std::string &mesh)
  {
    run_mesh<Mesh2, Mesh3>(mesh);
    for (const unsigned int degree : {1, 2})
      slide<Mesh3>(degree, mesh);
    run_on_two<Mesh3>(make(true, 2, {{1, 2}}), mesh + ", two ranks");
    run_on_two<Mesh3>(make(false, 1, {{2, 3}}), mesh + ", two ranks");
    read_elsewhere<Mesh3>(true, mesh);
    read_elsewhere<Mesh3>(false, mesh);
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  namespace parallel = dealii::parallel;
  if (hosts::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
  {
    run_methods();
    run_mesh<dealii::Triangulation<2>, dealii::Triangulation<3>>("serial");
  }
  run_parallel<parallel::shared::Triangulation<2>,
               parallel::shared::Triangulation<3>>("shared");
  run_parallel<parallel::fullydistributed::Triangulation<2>,
               parallel::fullydistributed::Triangulation<3>>(
      "fully distributed");
  return good ? 0 : 1;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// The patch test with triangles and tetrahedra, on meshes that each rank has
// for itself, that all ranks know, and of which each knows a part; the last two
// with quadrilaterals and hexahedra as well.
#include "patch.h"
#include "two_blocks_members.h"

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
    }
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
  run_mesh<parallel::shared::Triangulation<2>,
           parallel::shared::Triangulation<3>>("shared");
  run_mesh<parallel::fullydistributed::Triangulation<2>,
           parallel::fullydistributed::Triangulation<3>>("fully distributed");
  return good ? 0 : 1;
}

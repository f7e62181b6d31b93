// SPDX-License-Identifier: LGPL-2.1-or-later

#include "memory_check.h"

#include "app/input/input_error.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace abut::app
{
  namespace
  {
    /** MemAvailable of this machine in bytes; infinity if not told. */
    double available_here()
    {
      std::ifstream in("/proc/meminfo");
      std::string name;
      double kilobytes = 0;
      for (std::string unit; in >> name >> kilobytes; std::getline(in, unit))
        if (name == "MemAvailable:")
          return 1024 * kilobytes;
      return std::numeric_limits<double>::infinity();
    }

    /** What this process may still ask for (`ulimit -v`); infinity if it has no
     * limit, or its size is not told. */
    double allowed_here()
    {
      const double infinity = std::numeric_limits<double>::infinity();
      rlimit limit = {};
      if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return infinity;
      std::ifstream in("/proc/self/statm");
      double pages = 0.;
      if (!(in >> pages))
        return infinity;
      return std::max(0.,
                      static_cast<double>(limit.rlim_cur)
                          - pages * static_cast<double>(sysconf(_SC_PAGESIZE)));
    }

    std::string in_gib(const double bytes)
    {
      char text[64];
      std::snprintf(text, sizeof text, "%.3g GiB", bytes / 1073741824.);
      return text;
    }

    /** Triangles, or tetrahedra, with as many nodes as a cube. */
    double simplices_of_cube(const unsigned int dim)
    {
      return dim == 2 ? 2. : 5.5;
    }

    double n_dofs(const unsigned int dim, const double n_cubes,
                  const unsigned int degree, const unsigned int n_components)
    {
      return n_cubes * std::pow(degree, dim) * n_components;
    }
  } // namespace

  double estimated_bytes(const unsigned int dim, const double n_cells,
                         const unsigned int degree,
                         const unsigned int n_components)
  {
    const double dofs = n_dofs(dim, n_cells, degree, n_components);
    // A row of degree 1 has 3^dim entries, of degree 2 on average 4^dim. The
    // factors are fitted to the peak memory of runs on uniform meshes (bytes
    // per unknown, degrees 1 and 2: 1155 and 1070 in 2D, 2100 and 2360 in 3D)
    // and are at most a sixth too large.
    const double entries = dofs * std::pow(degree + 2., dim) * n_components;
    const double mesh = n_cells * (dim == 2 ? 440. : 750.);
    return mesh + 35. * entries + 400. * dofs;
  }

  double available_bytes(MPI_Comm communicator)
  {
    // Ranks of one machine share its memory: only their first one counts.
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL,
                        &machine);
    const bool first = dealii::Utilities::MPI::this_mpi_process(machine) == 0;
    MPI_Comm_free(&machine);
    return std::min(dealii::Utilities::MPI::sum(first ? available_here() : 0.,
                                                communicator),
                    dealii::Utilities::MPI::sum(allowed_here(), communicator));
  }

  void check_memory(const unsigned int dim, const double n_cells,
                    const unsigned int degree, MPI_Comm communicator,
                    const std::string &parameter,
                    const unsigned int n_components, const bool simplices)
  {
    const double n_cubes =
        simplices ? n_cells / simplices_of_cube(dim) : n_cells;
    char size[128];
    std::snprintf(size, sizeof size, "%.3g cells with %.3g unknowns", n_cells,
                  n_dofs(dim, n_cubes, degree, n_components));
    if (n_dofs(dim, n_cubes, degree, n_components)
        > double(std::numeric_limits<std::int32_t>::max()))
      throw InputError(parameter, std::string("the mesh would have ") + size
                                      + ", more than the 2^31 that can be "
                                        "numbered.");
    const double needed = estimated_bytes(dim, n_cubes, degree, n_components);
    const double available = available_bytes(communicator);
    if (needed > available)
      throw InputError(parameter, std::string("the mesh would have ") + size
                                      + ", which take about " + in_gib(needed)
                                      + " of memory; " + in_gib(available)
                                      + " are available.");
  }

  template <int dim>
  void check_memory_of_flags(const dealii::Triangulation<dim> &mesh,
                             const unsigned int degree,
                             const std::string &parameter,
                             const unsigned int n_components)
  {
    double n_cells = 0.;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const double children = std::pow(2., dim);
        n_cells += cell->refine_flag_set()    ? children
                   : cell->coarsen_flag_set() ? 1. / children
                                              : 1.;
      }
    const MPI_Comm communicator = versions::communicator(mesh);
    check_memory(dim, dealii::Utilities::MPI::sum(n_cells, communicator),
                 degree, communicator, parameter, n_components);
  }

  template void check_memory_of_flags<2>(const dealii::Triangulation<2> &,
                                         unsigned int, const std::string &,
                                         unsigned int);
  template void check_memory_of_flags<3>(const dealii::Triangulation<3> &,
                                         unsigned int, const std::string &,
                                         unsigned int);
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MEMORY_CHECK_H
#define ABUT_APP_MEMORY_CHECK_H

/** @file
 * Refuse a mesh before it is made, when the machine cannot hold it.
 */

#include <deal.II/distributed/tria.h>

#include <mpi.h>

#include <string>

namespace abut::app
{
  /** Estimate of the bytes that a scalar problem on @p n_cells hexahedra or
   * quadrilaterals of polynomial degree @p degree takes, all ranks together:
   * mesh, degrees of freedom, matrix, its condensed copy, multigrid hierarchy,
   * vectors. Linear in the number of cells.
   * @param n_components of the solution (1: scalar) */
  double estimated_bytes(unsigned int dim, double n_cells, unsigned int degree,
                         unsigned int n_components = 1);

  /** Bytes that the machines of @p communicator can still give
   * (`MemAvailable`, once per machine), and no more than its processes may ask
   * for (`ulimit -v`); infinity where the system does not say. Collective. */
  double available_bytes(MPI_Comm communicator);

  /** Throw InputError that names @p parameter, the estimate and what is there,
   * if the mesh would not fit, or would exceed the 32-bit numbering. To be
   * called before refining. Collective.
   * @param simplices whether cells are triangles or tetrahedra */
  void check_memory(unsigned int dim, double n_cells, unsigned int degree,
                    MPI_Comm communicator, const std::string &parameter,
                    unsigned int n_components = 1, bool simplices = false);

  /** The same for the mesh that @p mesh becomes when it is refined and
   * coarsened as flagged. Collective. */
  template <int dim>
  void check_memory_of_flags(const dealii::Triangulation<dim> &mesh,
                             unsigned int degree, const std::string &parameter,
                             unsigned int n_components = 1);
} // namespace abut::app

#endif

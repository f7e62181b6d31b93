// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BOUNDARY_PARTS_H
#define ABUT_APP_BOUNDARY_PARTS_H

#include <deal.II/grid/tria.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace abut::app
{
  /** The faces with one boundary id. */
  template <int dim> struct BoundaryPart
  {
    dealii::types::boundary_id id;
    unsigned int n_faces;
    double measure; ///< area, in 2D length; of straight faces
    dealii::Point<dim> least, largest; ///< corners of the box around them
    /** Mean of the outward unit normals: its length is 1 where all are the
     * same. */
    dealii::Tensor<1, dim> normal;
  };

  /** The boundary of a mesh, by id. Collective. */
  template <int dim>
  std::vector<BoundaryPart<dim>>
  boundary_parts(const dealii::Triangulation<dim> &triangulation,
                 MPI_Comm communicator);

  /** "12 faces, length 1, x from 0 to 1, y = 2, normal (0, 1)". */
  template <int dim> std::string in_words(const BoundaryPart<dim> &part);
} // namespace abut::app

#endif

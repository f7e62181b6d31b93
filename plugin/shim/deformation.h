// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_DEFORMATION_H
#define ABUT_SHIM_DEFORMATION_H

#include "solve/near_null_space.h"

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

namespace abut::shim
{
  /** How far the nodes of bodies move against each other at the most, as a
   * length, but no more than anything moves: what penetrations are compared
   * with. A body may travel far without being deformed. Collective. */
  double deformation(const solve::NearNullSpace &space, const la::Vector &u,
                     MPI_Comm communicator);

  /** The largest component of the displacement, length >= 0; other fields
   * beside it do not count. Collective. */
  double largest_displacement(const solve::NearNullSpace &space,
                              const la::Vector &u, MPI_Comm communicator);

  /** Half the diagonal of the box around the nodes of the smallest body, in the
   * reference configuration; 0 if no positions are known. Collective. */
  double smallest_body(const solve::NearNullSpace &space,
                       MPI_Comm communicator);

  /** The parts of a displacement gradient, at points of quadrature. Means are
   * over the cells of the material id with the largest one. */
  struct Strains
  {
    double largest = 0.; ///< magnitude of a principal strain
    double mean = 0.;
    double largest_rotation = 0.; ///< by the skew part, radian
    double mean_rotation = 0.;
  };

  /** Small strains and rotations of the first dim components.
   * One pass over the cells. @p u is owned.
   * @param axisymmetric the hoop strain u_x / x counts, too
   * Collective. */
  template <int dim>
  Strains strains(const dealii::Mapping<dim> &mapping,
                  const dealii::DoFHandler<dim> &dof_handler,
                  const la::Vector &u, bool axisymmetric);
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_FREE_BODIES_H
#define ABUT_SOLVE_FREE_BODIES_H

#include "near_null_space.h"
#include "stiffness.h"

#include <vector>

namespace abut::solve
{
  /** Rigid motions of bodies that a stiffness does not resist. */
  struct FreeBodies
  {
    /** A motion of one body: coefficients of its translations and rotations
     * about its centre. */
    struct Motion
    {
      unsigned int body;
      std::vector<double> coefficient;
      la::Vector displacement;
    };

    unsigned int n_modes = 0;
    std::vector<Motion> motions;
    /** [bodies] what rotations are about, and what they are measured by. */
    std::vector<dealii::Point<3>> center;
    std::vector<double> radius;
  };

  /** Find the motions that K leaves free: translations, and rotations if the
   * positions of unknowns are known. Nothing is done for scalar fields. One
   * pass over a matrix, a product for each motion of a host's, unless supports
   * obviously hold all bodies. Collective. */
  FreeBodies find_free_bodies(const Stiffness &stiffness,
                              const NearNullSpace &space);

  /** Whether prescribed values alone stop all motions of all bodies.
   * Collective. */
  bool are_supported(const NearNullSpace &space, MPI_Comm communicator);

  /** Eigenvectors of a symmetric n x n matrix with eigenvalues that are no
   * more than @p bound away from 0. Less than that is no round-off but a
   * material that softens, which resists, if badly. */
  std::vector<std::vector<double>>
  null_space(unsigned int n, const double *values, double bound);
} // namespace abut::solve

#endif

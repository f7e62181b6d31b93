// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_REFINEMENT_H
#define ABUT_DEALII_CONTACT_REFINEMENT_H

/** @file
 * Requirements of contact on a mesh in addition to small errors: call these
 * after the marking by an error estimate and before the mesh is refined. For
 * programs that are linked to Abut. */

#include <abut/dealii/linear_algebra.h>

#include <deal.II/base/types.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>

#include <set>
#include <utility>
#include <vector>

namespace abut
{
  /** Boundary ids of the secondary and the primary side of a pair. */
  using ContactSides = std::pair<std::set<dealii::types::boundary_id>,
                                 std::set<dealii::types::boundary_id>>;

  /** Flag the cells at whose secondary faces contact begins or ends: with one
   * node in contact (status > 0) and one open (0), or one of stick (1) and one
   * of slip (2); nodes without a row do not count. They are not coarsened.
   * @param status ghosted; for vectors the first component counts. Not
   * collective. Returns the number of this rank's cells that were not flagged
   * before. */
  template <int dim>
  unsigned int
  flag_contact_border(const dealii::DoFHandler<dim> &dof_handler,
                      const la::Vector &status,
                      const std::set<dealii::types::boundary_id> &secondary);

  /** Flag cells until no face, refined as flagged, is more than @p limit times
   * as large as the nearest of the other side of its pair; faces further apart
   * than their size do not count. Where multipliers are far coarser than the
   * other side, or far finer, contact is solved badly or in vain.
   *
   * Collective. All ranks look at all contact faces, O(n log n). Returns the
   * number of cells on all ranks that were not flagged before. */
  template <int dim>
  unsigned int limit_size_ratio(dealii::Triangulation<dim> &mesh,
                                const std::vector<ContactSides> &pairs,
                                double limit = 4.);
} // namespace abut

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CONTACT_TRACTION_H
#define ABUT_APP_CONTACT_TRACTION_H

/** @file
 * From contact forces at nodes to forces per area.
 */

#include "material.h"

#include <abut/dealii/linear_algebra.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <set>

namespace abut::app
{
  /** Contact forces at nodes made forces per area, on secondary and primary
   * sides and for every method alike.
   *
   * At a node with shape function phi the result is force / (integral of phi
   * over the contact boundary), which for dual multipliers is the multiplier
   * itself. Where a component is constrained the force is a reaction of the
   * support too; there, and where the integral of phi is small relative to that
   * of |phi| (corners of quadratic triangles), the mean of the other nodes of
   * the facets around takes its place. Where all rows of the node are open,
   * nothing presses there, whatever the support does.
   *
   * @param constraints all of the problem, closed
   * @param hanging the hanging nodes alone, closed
   * @param materials for the measure of axisymmetric bodies
   * @param contact ids of the contact boundaries
   * @param force contact force at the unknowns, owned entries: internal minus
   * external forces in equilibrium; not read at constrained unknowns
   * @param status states of the rows by unknown (ContactResults::status()),
   * or null: not known
   * @return the field with ghosts, 0 off the contact boundaries.
   *
   * Collective. Three passes over the cells at the boundary. */
  template <int dim>
  la::Vector
  contact_traction(const dealii::Mapping<dim> &mapping,
                   const dealii::DoFHandler<dim> &dof_handler,
                   const dealii::AffineConstraints<double> &constraints,
                   const dealii::AffineConstraints<double> &hanging,
                   const Materials<dim> &materials,
                   const std::set<dealii::types::boundary_id> &contact,
                   const la::Vector &force, const la::Vector *status = nullptr);
} // namespace abut::app

#endif

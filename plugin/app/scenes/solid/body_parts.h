// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BODY_PARTS_H
#define ABUT_APP_BODY_PARTS_H

/** @file
 * Bodies of a scene may consist of parts that do not hang together, such as
 * those of a mesh file. What holds one of them does not hold the others.
 */

#include <abut/dealii/coded.h>

#include <deal.II/grid/tria.h>

#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** A part of a body, all of whose cells hang together. */
  template <int dim> struct BodyPart
  {
    unsigned int body = 0;  ///< of the scene, from 0
    std::string given_name; ///< of the body; empty: none
    unsigned int part = 0;  ///< of its parts, from 0
    unsigned int n_parts = 1;
    dealii::Point<dim> first; ///< a corner of the part
    std::set<dealii::types::boundary_id> ids;

    /** `body 1`, `body 1 (roller)`, or `body 1, of whose 2 parts the one with
     * the corner (0 1),` */
    std::string name() const;
  };

  /** Parts in the order in which shim::BodyNumbers counts them. Of the coarse
   * mesh, which all ranks know: not collective. */
  template <int dim>
  std::vector<BodyPart<dim>>
  find_parts(const dealii::Triangulation<dim> &triangulation);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CONTACT_LINE_H
#define ABUT_APP_CONTACT_LINE_H

/** @file
 * Values along the contact boundary of a plane body, in the order of its
 * nodes.
 */

#include <abut/dealii/linear_algebra.h>
#include <deal.II/base/function.h>
#include <deal.II/base/point.h>
#include <deal.II/base/types.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <array>
#include <filesystem>
#include <set>
#include <vector>

namespace abut::app
{
  /** A node of a contact boundary. */
  struct ContactLineNode
  {
    double arc = 0.;        /**< length along the line from its first node */
    dealii::Point<2> place; /**< of the reference configuration */
    double pressure = 0.;   /**< > 0: compression */
    double gap = 0.;        /**< > 0: open; NaN where there is no row */
    double status = 0.;     /**< as ContactResults::status() */
    /** Traction on the body along the line, towards its end; 0 unless it is
     * asked for. */
    double friction = 0.;
    double slip = 0.; /**< of the step, likewise */
  };

  /** A connected piece of boundary; a closed one ends where it begins. */
  using ContactLine = std::vector<ContactLineNode>;

  /** Nodal fields of a contact boundary, ghosted, all of the displacement's
   * unknowns. */
  struct ContactLineFields
  {
    const la::Vector &traction; /**< force per area on the body */
    /** As mark_rows() and ContactResults::status(); null: 0. */
    const la::Vector *gap;
    const la::Vector *status;
    /** ContactResults::slip() where the traction has a part along the line.
     * Null: it has none, and its length is the pressure, whatever the normals
     * of facets. */
    const la::Vector *slip = nullptr;
    /** Of a traction that has a part along the line, what is pressure and what
     * is friction; null: told apart by the line's tangents, which at a corner
     * are those of neither side. */
    const la::Vector *normal = nullptr;
    const la::Vector *along = nullptr;
  };

  /** The pieces of the boundary with ids @p ids, in walking order, longest
   * first; begins at the end with the smaller x (then y). Result on rank 0,
   * empty on others. Collective; O(n log n) on rank 0. */
  std::vector<ContactLine>
  contact_lines(const dealii::Mapping<2> &mapping,
                const dealii::DoFHandler<2> &dof_handler,
                const std::set<dealii::types::boundary_id> &ids,
                const ContactLineFields &fields);

  /** Write pieces one after the other as the table @p file with the columns
   * line, arc, x, y, pressure, gap, status, friction, slip. Throws where the
   * file cannot be written. Not collective: for the rank that has them. */
  void write_contact_lines(const std::filesystem::path &file,
                           const std::vector<ContactLine> &lines);

  /** Write tractions given by formulas as the table @p file with the columns
   * line, arc, x, y, pressure, friction, at some points between nodes, too. */
  void write_closed_form(const std::filesystem::path &file,
                         const std::vector<ContactLine> &lines,
                         const dealii::Function<2> &pressure,
                         const dealii::Function<2> &friction);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NODAL_TABLE_H
#define ABUT_APP_NODAL_TABLE_H

/** @file
 * Nodal fields as a table of text, with all digits.
 */

#include <abut/dealii/linear_algebra.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  /** A field of a table: of vectors one column for each direction, `name_x`
   * and so on. */
  struct NodalColumn
  {
    std::string name;
    la::Vector values;      ///< owned entries, with or without ghosts
    bool is_scalar = false; ///< the first component stands for all
  };

  /** Write the nodes of a mesh with their fields as the table @p file: columns
   * `body` (the cells' material id, from 1; only where the element has several
   * components), x, y, z and the given ones. A node has one row; ranks write
   * theirs one after the other. Collective; an error of the file system is an
   * exception on all ranks. */
  template <int dim>
  void write_nodal_table(const std::filesystem::path &file,
                         const dealii::Mapping<dim> &mapping,
                         const dealii::DoFHandler<dim> &dof_handler,
                         const std::vector<NodalColumn> &columns);
} // namespace abut::app

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SIMPLEX_TRANSFER_H
#define ABUT_APP_SIMPLEX_TRANSFER_H

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>

#include <array>
#include <vector>

namespace abut::app
{
  /** Nodal fields from a mesh of triangles or tetrahedra to another one, whose
   * cells are parts of its cells. All ranks have all cells of both. */
  template <int dim> class SimplexTransfer
  {
  public:
    /** Note the cells and @p fields, without ghosts, of the old mesh.
     * Collective. */
    SimplexTransfer(const dealii::DoFHandler<dim> &dof_handler,
                    const std::vector<la::Vector> &fields);

    /** The fields at the nodes of the new mesh, without ghosts.
     * @param origin the old cell of each new one */
    std::vector<la::Vector>
    interpolate(const dealii::DoFHandler<dim> &dof_handler,
                const std::vector<unsigned int> &origin) const;

  private:
    struct Cell
    {
      std::array<dealii::Point<dim>, dim + 1> corners;
      std::vector<std::size_t> nodes;
    };

    std::vector<Cell> cells;
    std::vector<std::vector<double>> values; ///< of fields
  };
} // namespace abut::app

#endif

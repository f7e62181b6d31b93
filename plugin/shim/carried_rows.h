// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CARRIED_ROWS_H
#define ABUT_SHIM_CARRIED_ROWS_H

#include "point_to_point.h"

#include <abut/rows.h>

#include <cstdint>
#include <vector>

namespace abut::shim
{
  /** Pressures of rows from one mesh to the same mesh cut anew.
   *
   * The nodal field that a host carries holds the pressures of nodes, each
   * with one row. It cannot hold those of quadrature points, which are more
   * than the nodes, nor those of a node in a corner between obstacles. Where
   * only the ranks of cells have changed, rows have the numbers they had, and
   * nothing need be interpolated. */
  class CarriedRows
  {
  public:
    /** Keep the pressures of @p rows, of a mesh with this signature. Not
     * collective, but to be called on all ranks. */
    void keep(std::uint64_t mesh, const abut_rows_view &rows,
              std::vector<double> pressure);

    /** Keep nothing. */
    void clear();

    /** The pressures of @p rows into @p pressure, 0 where there was no row;
     * false on all ranks if nothing is kept, or that of another mesh.
     * Collective. */
    bool find(std::uint64_t mesh, const abut_rows_view &rows,
              PointToPoint &post, std::vector<double> &pressure) const;

  private:
    bool is_kept_ = false;
    std::uint64_t mesh_ = 0;
    std::vector<std::int64_t> id_;
    std::vector<double> pressure_;
  };
} // namespace abut::shim

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CELL_DEGREES_H
#define ABUT_APP_CELL_DEGREES_H

namespace abut::app
{
  /** Degrees of elements by kind of cells; 0: there are no such cells. */
  struct CellDegrees
  {
    CellDegrees(const unsigned int cubes = 1, const unsigned int simplices = 0)
        : cubes(cubes), simplices(simplices)
    {
    }

    unsigned int cubes, simplices;
  };
} // namespace abut::app

#endif

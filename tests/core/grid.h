/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_CORE_GRID_H
#define ABUT_TESTS_CORE_GRID_H

/* Matrices of (multi)linear and quadratic elements on the unit square or cube
 * in grids of 2^level cells a side, with the hierarchy of meshes from a
 * coarsest one. */

#include "fixture.h"

enum
{
  GRID_LEVELS = 8
};

typedef struct grid
{
  int32_t degree, dim, block, n_meshes;
  int32_t side[GRID_LEVELS]; /* nodes along a side, from the finest */
  abut_multigrid_mesh mesh[GRID_LEVELS];
  int32_t n; /* rows of the finest matrix */
  int32_t *start, *column;
  double *value;
  abut_multigrid_matrix matrix;
  abut_multigrid_hierarchy hierarchy;
} grid;

/* block = 1: the Laplacian, all of the border held; block = dim: elasticity
 * with E = 1 and Poisson's ratio 0.3, the side x = 0 held. Constrained rows
 * have their diagonal entry only. */
void grid_open(grid *g, int32_t dim, int32_t block, int32_t finest,
               int32_t coarsest);

/* The same with quadratic elements on the finest mesh, whose nodes are a mesh
 * for themselves above that of the corners of their cells. */
void grid_open_quadratic(grid *g, int32_t dim, int32_t block, int32_t finest,
                         int32_t coarsest);

void grid_close(grid *g);

/* y = A x without what is held; held may be NULL. */
void grid_times(const grid *g, const uint8_t *held, const double *x, double *y);

/* Whether an unknown of the finest mesh takes no part. */
bool grid_is_out(const grid *g, const uint8_t *held, int32_t unknown);

/* Iterations of conjugate gradients with a cycle as preconditioner until the
 * residual of a load without structure has fallen to tolerance of it. */
int32_t grid_iterations(const grid *g, abut_multigrid *mg, const uint8_t *held,
                        double tolerance);

#endif

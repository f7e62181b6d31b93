/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_MULTIGRID_INTERNAL_H
#define ABUT_MULTIGRID_INTERNAL_H

/* The inside of a hierarchy. Unknowns are numbered node * block + component
 * here; blocks are stored row by row. */

#include "base/clones.h"
#include "base/memory.h"

#include <abut/multigrid.h>
#include <stdbool.h>

enum
{
  ABUT_MULTIGRID_MESHES = 32,
  ABUT_MULTIGRID_COARSEST = 4000, /* unknowns to be factorised */
  ABUT_MULTIGRID_BLOCK = 9        /* numbers in the largest block */
};

/* Memory that is given back together. */
typedef struct abut_pool
{
  abut_context *context;
  abut_array pieces;
  int64_t n;
  bool failed; /* some request has; later ones give NULL, too */
} abut_pool;

/* Zeroed memory for n elements; NULL, and the pool has failed, if there is
 * none. */
void *abut_pool_take(abut_pool *pool, int64_t n, size_t element);

void abut_pool_release(abut_pool *pool);

/* Rows by nodes of one mesh over nodes of another, or of the same. */
typedef struct abut_node_rows
{
  int64_t *start;
  int32_t *node;
  float *weight; /* [start[n]], or blocks of a matrix */
} abut_node_rows;

typedef struct abut_multigrid_level
{
  int32_t n;               /* nodes */
  uint8_t *fixed;          /* [n * block] */
  abut_node_rows parents;  /* of nodes, on the next coarser level */
  abut_node_rows children; /* the same by nodes of the next coarser level */

  abut_node_rows matrix; /* blocks; of coarse levels the truncated ones */
  int64_t *diagonal;     /* [n] place of the diagonal block, -1: none */
  uint8_t *held;         /* [n * block] fixed, held or without stiffness */
  uint8_t *dirty;        /* [n] rows that differ from those at the last hold */
  float *inverse;        /* [n] blocks: inverse of the diagonal block, 0 in rows
                            and columns that are held */
  float *x, *r, *z;      /* [n * block] of a cycle */
  double largest;        /* bound of the eigenvalues of inverse * matrix */
} abut_multigrid_level;

/* Cholesky factor of a symmetric matrix by rows, each from its first nonzero
 * entry on. */
typedef struct abut_envelope
{
  int32_t n;
  int32_t *first;  /* [n] column of the first entry of a row */
  int64_t *start;  /* [n + 1] of rows, the diagonal last */
  double *value;   /* [start[n]] */
  int32_t *place;  /* [unknowns] row of an unknown, -1: not in it */
  int32_t *source; /* [n] unknown of a row */
  double *x;       /* [n] */
} abut_envelope;

struct abut_multigrid
{
  abut_context *context;
  int32_t block, n_levels;
  int32_t *unknown; /* [n * block] row of the host */
  abut_pool structure, matrices, coarsest;
  abut_multigrid_level level[ABUT_MULTIGRID_MESHES];
  abut_envelope factor;
  uint8_t *held;  /* [n * block] by the last hold() */
  double *added;  /* [n * block] to the diagonal */
  float *plain;   /* [n] diagonal blocks without what is added */
  int32_t *place; /* [max nodes] work: where a column stands, or -1 */
  int64_t n_renewed;
  bool has_matrix, is_ready;
};

/* Blocks of the finest level from the host's rows. */
abut_status abut_multigrid_fill(abut_multigrid *mg,
                                const abut_multigrid_matrix *matrix);

/* Pattern of the matrix of level l + 1. */
void abut_galerkin_pattern(abut_multigrid *mg, int32_t l);

/* Its rows that are marked dirty. */
void abut_galerkin_rows(abut_multigrid *mg, int32_t l);

/* Inverses of the diagonal blocks of nodes that are dirty. On coarse levels,
 * unknowns without stiffness become held. */
void abut_multigrid_invert(abut_multigrid *mg, int32_t l);

/* Find the bound of the eigenvalues by n steps of the power method. */
void abut_multigrid_bound(abut_multigrid *mg, int32_t l, int32_t n);

/* Factorise the matrix of the coarsest level. */
abut_status abut_multigrid_factorise(abut_multigrid *mg);

/* x = A^-1 r on the coarsest level. */
void abut_multigrid_solve_coarsest(abut_multigrid *mg);

/* Products and smoothers of a level, see smoother.c. */
void abut_level_smooth_first(abut_multigrid_level *level, int32_t block);
void abut_level_restrict(abut_multigrid_level *level, int32_t block,
                         abut_multigrid_level *coarse);
void abut_level_prolong(abut_multigrid_level *level, int32_t block,
                        const abut_multigrid_level *coarse);
void abut_level_smooth_last(abut_multigrid_level *level, int32_t block);

/* z = inverse * matrix * x; returns (z, matrix x) / (x, matrix x), which is at
 * most the largest eigenvalue. */
double abut_level_quotient(abut_multigrid_level *level, int32_t block);

#endif

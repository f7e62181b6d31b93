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
void *abut_pool_allocate(abut_pool *pool, int64_t n, size_t element);

void abut_pool_release(abut_pool *pool);

/* Rows by nodes of one mesh over nodes of another, or of the same. */
typedef struct abut_node_rows
{
  int64_t *start;
  int32_t *node;
  float *weight; /* [start[n]], or blocks of a matrix and one number more */
} abut_node_rows;

/* Blocks that are added to a matrix in few of its rows. */
typedef struct abut_node_terms
{
  int32_t n;           /* rows that have any */
  int32_t *at;         /* [nodes] row of a node here, -1: none; NULL: n = 0 */
  int32_t *row;        /* [n] node of a row, ascending */
  abut_node_rows rows; /* [n] by these numbers, over all nodes */
  int64_t *diagonal;   /* [n] place of the diagonal block, -1: none */
  float *sum;          /* work: blocks of a coarse row over fine columns */
} abut_node_terms;

typedef struct abut_multigrid_level
{
  int32_t n;               /* nodes */
  uint8_t *fixed;          /* [n * block] */
  abut_node_rows parents;  /* of nodes, on the next coarser level */
  abut_node_rows children; /* the same by nodes of the next coarser level */

  abut_node_rows matrix; /* blocks; of coarse levels the truncated ones */
  int64_t *upper;    /* [n + 1] of a matrix with half of its blocks: those of
                        row i begin here, its first nodes, none of which is
                        below i, are theirs; NULL: it has all blocks */
  float *below;      /* [n * block + 1] of such a matrix: what the rows before
                        add to a product; 0 at rest */
  int64_t *diagonal; /* [n] place of the diagonal block, -1: none */
  float *sum;        /* work, as that of the terms */
  abut_node_terms terms; /* what is added to the matrix */
  uint8_t *held;         /* [n * block] fixed, held or without stiffness */
  uint8_t *dirty;        /* [n] rows that differ from those at the last hold */
  float *inverse;        /* [n] blocks: inverse of the diagonal block, 0 in rows
                            and columns that are held */
  float *x, *r, *z;      /* [n * block + 1] of a cycle */
  double largest; /* bound of the eigenvalues of inverse * matrix; 0 where it is
                     not needed */

  int32_t number;                    /* of this level */
  int32_t first_own, end_own;        /* nodes that are this rank's */
  const abut_multigrid_ranks *ranks; /* NULL: there are no others */
  float *product; /* [n * block] of the matrix, added up over ranks; NULL: it
                     is not kept */
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
  abut_multigrid_ranks ranks;
  float *blocks;    /* [max nodes] work: diagonal blocks; NULL: one rank */
  uint8_t *changed; /* [n] work; NULL: one rank */
  abut_pool structure, matrices, terms, coarsest;
  abut_multigrid_level level[ABUT_MULTIGRID_MESHES];
  abut_envelope factor;
  abut_node_rows
      gathered;   /* of the coarsest level, of all ranks; one: unused */
  uint8_t *held;  /* [n * block] by the last abut_multigrid_set_constrained() */
  double *added;  /* [n * block] to the diagonal */
  float *plain;   /* [n * block] diagonal without what is added */
  uint8_t *moved; /* [n] nodes whose terms have changed since the last hold */
  int32_t *place; /* [max nodes] work: where a column stands, or -1 */
  int32_t *fine_place; /* [max nodes] the same of a finer level, -1 at rest */
  int32_t *list;       /* [max nodes] work: fine columns of a coarse row */
  int64_t n_renewed;
  bool has_matrix, is_ready;
  bool sweeps;    /* smooth by sweeps instead of polynomials */
  bool had_terms; /* at the last hold */
};

/* Whether a matrix of the host can be read. */
abut_status abut_multigrid_check(abut_multigrid *mg,
                                 const abut_multigrid_matrix *matrix,
                                 const char *call);

/* Add up values [n * n_values] over the copies of nodes on other ranks. */
void abut_level_share(const abut_multigrid_level *level, int32_t n_values,
                      float *values);

/* Set flags [n * n_flags] that are set at any copy; n_flags <= block.
 * Overwrites level->z. */
void abut_level_share_flags(abut_multigrid_level *level, int32_t n_flags,
                            uint8_t *flags);

/* The sum (or maximum) over ranks, in place. */
void abut_level_reduce(const abut_multigrid_level *level, abut_reduction op,
                       double *values, int32_t n);

/* Make mg->gathered, the sum of the matrices of all ranks. */
abut_status abut_multigrid_gather_coarsest(abut_multigrid *mg);

/* Description of the rows of the host. */
typedef struct abut_host_numbers
{
  int32_t *node;      /* [rows] */
  uint8_t *component; /* [rows] */
} abut_host_numbers;

/* False: no memory, and the pool has failed. */
bool abut_multigrid_number(abut_multigrid *mg, abut_pool *work,
                           abut_host_numbers *host);

/* Nodes of the blocks in the host's rows of node i; returns how many, and
 * writes them where there is room. Before the first call mg->place has -1. */
int32_t abut_multigrid_collect(abut_multigrid *mg,
                               const abut_multigrid_matrix *matrix,
                               const abut_host_numbers *host, int32_t i,
                               int32_t *columns);

/* Add the numbers of these rows to blocks whose columns stand at places; those
 * at -1 are passed over. */
void abut_multigrid_add_row(abut_multigrid *mg,
                            const abut_multigrid_matrix *matrix,
                            const abut_host_numbers *host, int32_t i,
                            float *row);

/* mg->place is -1 for the first n nodes. */
void abut_multigrid_clear_places(abut_multigrid *mg, int32_t n);

/* Blocks of the finest level from the host's rows. */
abut_status abut_multigrid_fill(abut_multigrid *mg,
                                const abut_multigrid_matrix *matrix);

/* Pattern of the matrix of level l + 1. */
void abut_galerkin_pattern(abut_multigrid *mg, int32_t l);

/* Its rows that are marked dirty; all, and they are marked, if the pattern
 * lacks what they need. */
abut_status abut_galerkin_rows(abut_multigrid *mg, int32_t l);

/* The same of what is added: rows of level l + 1, all of them. */
void abut_terms_pattern(abut_multigrid *mg, int32_t l);
void abut_terms_rows(abut_multigrid *mg, int32_t l);

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

/* The same for one unknown at a node, see sweep.c; prolongation is as above.
 * z is what the first sweep leaves. */
void abut_level_sweep_first(abut_multigrid_level *level);
void abut_level_sweep_restrict(abut_multigrid_level *level,
                               abut_multigrid_level *coarse);
void abut_level_sweep_last(abut_multigrid_level *level);

/* The columns of row i, n of them, as these want them; work has room for n. */
void abut_row_in_order(int32_t *node, int64_t n, int32_t i, int32_t *work);

/* z = inverse * matrix * x; returns (z, matrix x) / (x, matrix x), which is at
 * most the largest eigenvalue. Collective. */
double abut_level_quotient(abut_multigrid_level *level, int32_t block);

#endif

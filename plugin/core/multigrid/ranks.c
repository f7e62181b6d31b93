/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Communication of ranks that share a hierarchy. Each has a part of every
 * matrix, the sum of which is the matrix: coarse parts come from fine ones
 * without communication, and only vectors, diagonal blocks and the coarsest
 * matrix are added up. */
#include "multigrid/multigrid.h"

enum
{
  GATHERED_AT_ONCE = 1 << 16 /* numbers */
};

void
abut_level_share(const abut_multigrid_level *level, int32_t n_values,
                 float *values)
{
  if (level->ranks != NULL)
    level->ranks->add_copies(level->ranks->user, level->number, n_values,
                             values);
}

void
abut_level_share_flags(abut_multigrid_level *level, int32_t n_flags,
                       uint8_t *flags)
{
  if (level->ranks == NULL)
    return;
  const int64_t n = (int64_t)level->n * n_flags;
  for (int64_t k = 0; k < n; ++k)
    level->z[k] = flags[k] != 0;
  abut_level_share(level, n_flags, level->z);
  for (int64_t k = 0; k < n; ++k)
    flags[k] = level->z[k] > 0;
}

void
abut_level_reduce(const abut_multigrid_level *level, abut_reduction op,
                  double *values, int32_t n)
{
  if (level->ranks != NULL)
    level->ranks->reduce(level->ranks->user, op, values, n);
}

/* Add one row of blocks, of the matrix or of the terms, to a dense one. */
static void
add_blocks(const abut_node_rows *rows, int32_t q, int32_t size, double *dense)
{
  for (int64_t e = rows->start[q]; e < rows->start[q + 1]; ++e)
    for (int32_t k = 0; k < size; ++k)
      dense[(int64_t)rows->node[e] * size + k] +=
          (double)rows->weight[e * size + k];
}

/* Append what is not 0 of a dense row. */
static abut_status
append_row(abut_multigrid *mg, const double *dense, int32_t n, int32_t size,
           abut_array *nodes, abut_array *weights, int64_t *n_blocks)
{
  for (int32_t j = 0; j < n; ++j)
  {
    const double *block = dense + (int64_t)j * size;
    bool any = false;
    for (int32_t k = 0; k < size; ++k)
      any |= block[k] != 0;
    if (!any)
      continue;
    const int64_t at = *n_blocks;
    if (abut_array_reserve(mg->context, nodes, at, at + 1) != ABUT_SUCCESS
        || abut_array_reserve(mg->context, weights, at * size, (at + 1) * size)
               != ABUT_SUCCESS)
      return ABUT_OUT_OF_MEMORY;
    ((int32_t *)nodes->data)[at] = j;
    for (int32_t k = 0; k < size; ++k)
      ((float *)weights->data)[at * size + k] = (float)block[k];
    *n_blocks += 1;
  }
  return ABUT_SUCCESS;
}

/* Rows of all nodes, some at a time, with room for them in `dense`. The ranks
 * take part in each sum, whatever fails on one. */
static abut_status
gather_rows(abut_multigrid *mg, const abut_multigrid_level *level,
            double *dense, int32_t n_at_once, abut_array *nodes,
            abut_array *weights)
{
  const int32_t n = level->n, size = mg->block * mg->block;
  const int64_t length = (int64_t)n * size;
  int64_t n_blocks = 0;
  abut_status status = ABUT_SUCCESS;
  for (int32_t first = 0; first < n; first += n_at_once)
  {
    const int32_t m = n - first < n_at_once ? n - first : n_at_once;
    for (int64_t k = 0; k < m * length; ++k)
      dense[k] = 0;
    for (int32_t i = first; i < first + m; ++i)
    {
      double *row = dense + (i - first) * length;
      add_blocks(&level->matrix, i, size, row);
      if (level->terms.n > 0 && level->terms.at[i] >= 0)
        add_blocks(&level->terms.rows, level->terms.at[i], size, row);
    }
    abut_level_reduce(level, ABUT_REDUCTION_SUM, dense, (int32_t)(m * length));
    for (int32_t i = first; i < first + m; ++i)
    {
      if (status == ABUT_SUCCESS)
        status = append_row(mg, dense + (i - first) * length, n, size, nodes,
                            weights, &n_blocks);
      mg->gathered.start[i + 1] = n_blocks;
    }
  }
  return status;
}

static void
copy_gathered(abut_multigrid *mg, int32_t n, const abut_array *nodes,
              const abut_array *weights)
{
  abut_node_rows *rows = &mg->gathered;
  const int64_t size = (int64_t)mg->block * mg->block, m = rows->start[n];
  rows->node = abut_pool_allocate(&mg->coarsest, m, sizeof(int32_t));
  rows->weight = abut_pool_allocate(&mg->coarsest, m * size, sizeof(float));
  if (mg->coarsest.failed)
    return;
  for (int64_t e = 0; e < m; ++e)
    rows->node[e] = ((const int32_t *)nodes->data)[e];
  for (int64_t e = 0; e < m * size; ++e)
    rows->weight[e] = ((const float *)weights->data)[e];
}

abut_status
abut_multigrid_gather_coarsest(abut_multigrid *mg)
{
  const abut_multigrid_level *level = &mg->level[mg->n_levels - 1];
  const int32_t n = level->n;
  const int64_t length = (int64_t)n * mg->block * mg->block;
  const int32_t n_at_once =
      length < GATHERED_AT_ONCE
          ? (int32_t)(GATHERED_AT_ONCE / (length > 0 ? length : 1))
          : 1;
  abut_array nodes = {NULL, 0, sizeof(int32_t)};
  abut_array weights = {NULL, 0, sizeof(float)};
  double *dense =
      abut_pool_allocate(&mg->coarsest, n_at_once * length, sizeof(double));
  mg->gathered.start =
      abut_pool_allocate(&mg->coarsest, (int64_t)n + 1, sizeof(int64_t));
  if (!mg->coarsest.failed
      && gather_rows(mg, level, dense, n_at_once, &nodes, &weights)
             == ABUT_SUCCESS)
    copy_gathered(mg, n, &nodes, &weights);
  else
    mg->coarsest.failed = true;
  abut_array_release(mg->context, &nodes);
  abut_array_release(mg->context, &weights);
  return mg->coarsest.failed ? ABUT_OUT_OF_MEMORY : ABUT_SUCCESS;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The host's rows as blocks of nodes. */
#include "multigrid/multigrid.h"

static const char call[] = "abut_multigrid_set_matrix";

/* Node and component of each row of the host: node * block + component. */
static int32_t *
inverse_numbers(abut_multigrid *mg, abut_pool *work)
{
  const int64_t n = (int64_t)mg->level[0].n * mg->block;
  int32_t *own = abut_pool_take(work, n, sizeof(int32_t));
  for (int64_t u = 0; u < n && own != NULL; ++u)
    own[mg->unknown[u]] = (int32_t)u;
  return own;
}

/* Blocks of the row of node i; where `column` is given, write their nodes. */
static int32_t
collect(abut_multigrid *mg, const abut_multigrid_matrix *a, const int32_t *own,
        int32_t i, int32_t *columns)
{
  int32_t n = 0;
  for (int32_t c = 0; c < mg->block; ++c)
  {
    const int32_t row = mg->unknown[i * mg->block + c];
    for (int32_t e = a->start[row]; e < a->start[row + 1]; ++e)
    {
      const int32_t node = own[a->column[e]] / mg->block;
      if (mg->place[node] == i)
        continue;
      mg->place[node] = i;
      if (columns != NULL)
        columns[n] = node;
      ++n;
    }
  }
  return n;
}

static void
clear(abut_multigrid *mg)
{
  for (int32_t i = 0; i < mg->level[0].n; ++i)
    mg->place[i] = -1;
}

static void
make_pattern(abut_multigrid *mg, const abut_multigrid_matrix *a,
             const int32_t *own)
{
  abut_multigrid_level *level = &mg->level[0];
  abut_node_rows *rows = &level->matrix;
  const int32_t n = level->n;
  rows->start = abut_pool_take(&mg->matrices, (int64_t)n + 1, sizeof(int64_t));
  level->diagonal = abut_pool_take(&mg->matrices, n, sizeof(int64_t));
  if (mg->matrices.failed)
    return;
  clear(mg);
  for (int32_t i = 0; i < n; ++i)
    rows->start[i + 1] = rows->start[i] + collect(mg, a, own, i, NULL);
  rows->node = abut_pool_take(&mg->matrices, rows->start[n], sizeof(int32_t));
  rows->weight = abut_pool_take(
      &mg->matrices, rows->start[n] * mg->block * mg->block, sizeof(float));
  if (mg->matrices.failed)
    return;
  clear(mg);
  for (int32_t i = 0; i < n; ++i)
    collect(mg, a, own, i, rows->node + rows->start[i]);
}

/* The numbers of the row of node i. */
static void
fill_row(abut_multigrid *mg, const abut_multigrid_matrix *a, const int32_t *own,
         int32_t i)
{
  abut_multigrid_level *level = &mg->level[0];
  const int32_t b = mg->block;
  const int64_t first = level->matrix.start[i];
  level->diagonal[i] = -1;
  for (int64_t e = first; e < level->matrix.start[i + 1]; ++e)
  {
    mg->place[level->matrix.node[e]] = (int32_t)(e - first);
    if (level->matrix.node[e] == i)
      level->diagonal[i] = e;
  }
  for (int32_t c = 0; c < b; ++c)
  {
    const int32_t row = mg->unknown[i * b + c];
    for (int32_t e = a->start[row]; e < a->start[row + 1]; ++e)
    {
      const int32_t column = own[a->column[e]];
      const int64_t at = first + mg->place[column / b];
      level->matrix.weight[(at * b + c) * b + column % b] = (float)a->value[e];
    }
  }
}

static abut_status
check(abut_multigrid *mg, const abut_multigrid_matrix *a)
{
  if (a->n != mg->level[0].n * mg->block || a->start == NULL || a->start[0] != 0
      || a->column == NULL || a->value == NULL)
    return abut_fail(mg->context, ABUT_INVALID_ARGUMENT, call,
                     "the matrix is incomplete, or not that of the finest "
                     "mesh");
  double probe = 0;
  for (int32_t i = 0; i < a->n; ++i)
    for (int32_t e = a->start[i]; e < a->start[i + 1]; ++e)
    {
      if (a->column[e] < 0 || a->column[e] >= a->n)
        return abut_fail(mg->context, ABUT_INVALID_ARGUMENT, call,
                         "a column is none of the matrix");
      probe += 0.0 * a->value[e];
    }
  return probe == 0 ? ABUT_SUCCESS
                    : abut_fail(mg->context, ABUT_NOT_FINITE, call,
                                "an entry is not finite");
}

abut_status
abut_multigrid_fill(abut_multigrid *mg, const abut_multigrid_matrix *matrix)
{
  abut_status status = check(mg, matrix);
  if (status != ABUT_SUCCESS)
    return status;
  abut_pool work = {mg->context, {NULL, 0, 0}, 0, false};
  const int32_t *own = inverse_numbers(mg, &work);
  if (own == NULL)
  {
    abut_pool_release(&work);
    return abut_fail(mg->context, ABUT_OUT_OF_MEMORY, call, "no memory");
  }
  make_pattern(mg, matrix, own);
  for (int32_t i = 0; i < mg->level[0].n && !mg->matrices.failed; ++i)
    fill_row(mg, matrix, own, i);
  abut_pool_release(&work);
  return mg->matrices.failed ? abut_fail(mg->context, ABUT_OUT_OF_MEMORY, call,
                                         "no memory for the blocks")
                             : ABUT_SUCCESS;
}

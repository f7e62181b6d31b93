/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The host's rows as blocks of nodes. */
#include "multigrid/multigrid.h"

static const char set_matrix_call[] = "abut_multigrid_set_matrix";

bool
abut_multigrid_number(abut_multigrid *mg, abut_pool *work,
                      abut_host_numbers *host)
{
  const int32_t n = mg->level[0].n, b = mg->block;
  host->node = abut_pool_allocate(work, (int64_t)n * b, sizeof(int32_t));
  host->component = abut_pool_allocate(work, (int64_t)n * b, 1);
  if (work->failed)
    return false;
  for (int32_t i = 0; i < n; ++i)
    for (int32_t c = 0; c < b; ++c)
    {
      host->node[mg->unknown[i * b + c]] = i;
      host->component[mg->unknown[i * b + c]] = (uint8_t)c;
    }
  return true;
}

int32_t
abut_multigrid_collect(abut_multigrid *mg, const abut_multigrid_matrix *a,
                       const abut_host_numbers *host, int32_t i,
                       int32_t *columns)
{
  int32_t n = 0;
  for (int32_t c = 0; c < mg->block; ++c)
  {
    const int32_t row = mg->unknown[i * mg->block + c];
    if (row >= a->n)
      continue;
    int32_t last = -1; /* components of a node mostly stand side by side */
    for (int32_t e = a->start[row]; e < a->start[row + 1]; ++e)
    {
      const int32_t node = host->node[a->column[e]];
      if (node == last)
        continue;
      last = node;
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

void
abut_multigrid_clear_places(abut_multigrid *mg, int32_t n)
{
  for (int32_t i = 0; i < n; ++i)
    mg->place[i] = -1;
}

/* Memory for where the rows of the finest level begin, and its diagonals;
 * false: there is none. */
static bool
take_starts(abut_multigrid *mg)
{
  abut_multigrid_level *level = &mg->level[0];
  level->matrix.start =
      abut_pool_allocate(&mg->matrices, (int64_t)level->n + 1, sizeof(int64_t));
  level->diagonal =
      abut_pool_allocate(&mg->matrices, level->n, sizeof(int64_t));
  return !mg->matrices.failed;
}

/* The same for the nodes of the rows, which have their places. */
static bool
take_entries(abut_multigrid *mg)
{
  abut_node_rows *rows = &mg->level[0].matrix;
  const int64_t n = rows->start[mg->level[0].n];
  rows->node = abut_pool_allocate(&mg->matrices, n, sizeof(int32_t));
  return !mg->matrices.failed;
}

/* And for n blocks. */
static bool
take_blocks(abut_multigrid *mg, int64_t n)
{
  mg->level[0].matrix.weight = abut_pool_allocate(
      &mg->matrices, n * mg->block * mg->block + 1, sizeof(float));
  return !mg->matrices.failed;
}

/* Let the nodes of row i that are not below i come first, i the first of all;
 * returns how many. */
static int32_t
put_upper_first(int32_t *node, int64_t n, int32_t i, int32_t *work)
{
  int64_t n_below = 0;
  int32_t n_upper = 0;
  for (int64_t e = 0; e < n; ++e)
    if (node[e] < i)
      work[n_below++] = node[e];
    else
    {
      node[n_upper] = node[e];
      if (node[e] == i)
      {
        node[n_upper] = node[0];
        node[0] = i;
      }
      n_upper += 1;
    }
  for (int64_t e = 0; e < n_below; ++e)
    node[n_upper + e] = work[e];
  return n_upper;
}

/* The matrix is symmetric: of the largest one half is enough, which is read
 * once for both. Ranks have parts of rows, sweeps want them whole, and so does
 * who factorises. */
static void
take_half(abut_multigrid *mg)
{
  abut_multigrid_level *level = &mg->level[0];
  level->upper = NULL;
  level->below = NULL;
  if (mg->block == 1 || level->ranks != NULL || mg->n_levels == 1)
  {
    (void)take_blocks(mg, level->matrix.start[level->n]);
    return;
  }
  const int64_t n = (int64_t)level->n * mg->block;
  int64_t *upper =
      abut_pool_allocate(&mg->matrices, (int64_t)level->n + 1, sizeof(int64_t));
  level->below = abut_pool_allocate(&mg->matrices, n + 1, sizeof(float));
  if (mg->matrices.failed)
    return;
  level->upper = upper;
  for (int32_t i = 0; i < level->n; ++i)
  {
    const int64_t first = level->matrix.start[i];
    upper[i + 1] =
        upper[i]
        + put_upper_first(level->matrix.node + first,
                          level->matrix.start[i + 1] - first, i, mg->list);
  }
  (void)take_blocks(mg, upper[level->n]);
}

static void
make_pattern(abut_multigrid *mg, const abut_multigrid_matrix *a,
             const abut_host_numbers *host)
{
  abut_node_rows *rows = &mg->level[0].matrix;
  const int32_t n = mg->level[0].n;
  if (!take_starts(mg))
    return;
  abut_multigrid_clear_places(mg, n);
  for (int32_t i = 0; i < n; ++i)
    rows->start[i + 1] =
        rows->start[i] + abut_multigrid_collect(mg, a, host, i, NULL);
  if (!take_entries(mg))
    return;
  abut_multigrid_clear_places(mg, n);
  for (int32_t i = 0; i < n; ++i)
    abut_multigrid_collect(mg, a, host, i, rows->node + rows->start[i]);
  take_half(mg);
}

void
abut_multigrid_add_row(abut_multigrid *mg, const abut_multigrid_matrix *a,
                       const abut_host_numbers *host, int32_t i, float *blocks)
{
  const int32_t b = mg->block;
  for (int32_t c = 0; c < b; ++c)
  {
    const int32_t row = mg->unknown[i * b + c];
    for (int32_t e = row < a->n ? a->start[row] : 0;
         row < a->n && e < a->start[row + 1]; ++e)
    {
      const int32_t column = a->column[e];
      const int64_t at = mg->place[host->node[column]];
      if (at < 0)
        continue;
      blocks[(at * b + c) * b + host->component[column]] += (float)a->value[e];
    }
  }
}

/* The numbers of the row of node i; in half a matrix those that it has. */
static void
fill_row(abut_multigrid *mg, const abut_multigrid_matrix *a,
         const abut_host_numbers *host, int32_t i)
{
  abut_multigrid_level *level = &mg->level[0];
  const int32_t b = mg->block;
  const int64_t *begins =
      level->upper != NULL ? level->upper : level->matrix.start;
  const int64_t first = begins[i], n = begins[i + 1] - first;
  const int64_t m = level->matrix.start[i + 1] - level->matrix.start[i];
  const int32_t *node = level->matrix.node + level->matrix.start[i];
  level->diagonal[i] = -1;
  for (int64_t e = 0; e < m; ++e)
  {
    mg->place[node[e]] = e < n ? (int32_t)e : -1;
    if (node[e] == i)
      level->diagonal[i] = first + e;
  }
  abut_multigrid_add_row(mg, a, host, i, level->matrix.weight + first * b * b);
}

/* The row of node i where each has one unknown, straight into its place: what
 * is before the diagonal first, see abut_row_in_order(). A second entry of the
 * diagonal is added to the first. */
static void
copy_row(abut_multigrid *mg, const abut_multigrid_matrix *a,
         const abut_host_numbers *host, int32_t i)
{
  abut_multigrid_level *level = &mg->level[0];
  const int32_t row = mg->unknown[i];
  const int32_t begin = row < a->n ? a->start[row] : 0;
  const int32_t end = row < a->n ? a->start[row + 1] : 0;
  const int64_t first = level->matrix.start[i];
  int32_t n_before = 0, n_own = 0;
  for (int32_t e = begin; e < end; ++e)
  {
    n_before += host->node[a->column[e]] < i;
    n_own += a->column[e] == row;
  }
  int64_t before = first, own = first + n_before, after = own + n_own;
  level->diagonal[i] = n_own > 0 ? own : -1;
  for (int32_t e = begin; e < end; ++e)
  {
    const int32_t node = host->node[a->column[e]];
    int64_t *const next = node < i ? &before : node > i ? &after : &own;
    level->matrix.node[*next] = node;
    level->matrix.weight[*next] = (float)a->value[e];
    *next += 1;
  }
  for (int32_t k = 1; k < n_own; ++k)
  {
    level->matrix.weight[first + n_before] +=
        level->matrix.weight[first + n_before + k];
    level->matrix.weight[first + n_before + k] = 0;
  }
}

/* The same of all rows. */
static void
copy_rows(abut_multigrid *mg, const abut_multigrid_matrix *a,
          const abut_host_numbers *host)
{
  const int32_t n = mg->level[0].n;
  if (!take_starts(mg))
    return;
  int64_t *start = mg->level[0].matrix.start;
  for (int32_t i = 0; i < n; ++i)
  {
    const int32_t row = mg->unknown[i];
    start[i + 1] =
        start[i] + (row < a->n ? a->start[row + 1] - a->start[row] : 0);
  }
  if (!take_entries(mg) || !take_blocks(mg, start[n]))
    return;
  for (int32_t i = 0; i < n; ++i)
    copy_row(mg, a, host, i);
}

/* Pattern and numbers of blocks. */
static void
fill_rows(abut_multigrid *mg, const abut_multigrid_matrix *a,
          const abut_host_numbers *host)
{
  make_pattern(mg, a, host);
  for (int32_t i = 0; i < mg->level[0].n && !mg->matrices.failed; ++i)
    fill_row(mg, a, host, i);
}

abut_status
abut_multigrid_check(abut_multigrid *mg, const abut_multigrid_matrix *a,
                     const char *call)
{
  const int32_t n = mg->level[0].n * mg->block;
  const bool has_rows = mg->level[0].ranks == NULL ? a->n == n : a->n <= n;
  if (!has_rows || a->n < 0 || a->start == NULL || a->start[0] != 0
      || (a->start[a->n] > 0 && (a->column == NULL || a->value == NULL)))
    return abut_fail(mg->context, ABUT_INVALID_ARGUMENT, call,
                     "the matrix is incomplete, or not that of the finest "
                     "mesh");
  double probe = 0;
  for (int32_t i = 0; i < a->n; ++i)
    for (int32_t e = a->start[i]; e < a->start[i + 1]; ++e)
    {
      if (a->column[e] < 0 || a->column[e] >= n)
        return abut_fail(mg->context, ABUT_INVALID_ARGUMENT, call,
                         "a column is not in the matrix");
      probe += 0.0 * a->value[e];
    }
  return probe == 0 ? ABUT_SUCCESS
                    : abut_fail(mg->context, ABUT_NOT_FINITE, call,
                                "an entry is not finite");
}

abut_status
abut_multigrid_fill(abut_multigrid *mg, const abut_multigrid_matrix *matrix)
{
  abut_status status = abut_multigrid_check(mg, matrix, set_matrix_call);
  if (status != ABUT_SUCCESS)
    return status;
  abut_pool work = {mg->context, {NULL, 0, 0}, 0, false};
  abut_host_numbers host;
  if (!abut_multigrid_number(mg, &work, &host))
  {
    abut_pool_release(&work);
    return abut_fail(mg->context, ABUT_OUT_OF_MEMORY, set_matrix_call,
                     "no memory");
  }
  if (mg->block == 1)
    copy_rows(mg, matrix, &host);
  else
    fill_rows(mg, matrix, &host);
  abut_pool_release(&work);
  return mg->matrices.failed
             ? abut_fail(mg->context, ABUT_OUT_OF_MEMORY, set_matrix_call,
                         "no memory for the blocks")
             : ABUT_SUCCESS;
}

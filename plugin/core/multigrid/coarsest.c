/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The coarsest level is factorised: Cholesky's method on rows that begin with
 * their first nonzero entry (George and Liu, Computer Solution of Large Sparse
 * Positive Definite Systems, chapter 4), numbered by distance from a corner. */
#include "multigrid/multigrid.h"

#include <math.h>

/* A pivot below this part of its diagonal entry, single precision's noise, is
 * a coarse function that others make up for: it is left out. */
static const double smallest_pivot = 1e-6;

/* Number of free unknowns of a node, and of columns of its row. */
static bool
is_free(const abut_multigrid *mg, const abut_multigrid_level *level, int32_t i)
{
  bool result = false;
  for (int32_t c = 0; c < mg->block; ++c)
    result |= !level->held[(int64_t)i * mg->block + c];
  return result;
}

/* Rows number q of `rows`, the matrix's for 0 and those added to it for 1, that
 * node i has; NULL: none. */
static const abut_node_rows *
rows_of(const abut_multigrid *mg, const abut_multigrid_level *level,
        int32_t part, int32_t i, int32_t *q)
{
  *q = i;
  const bool is_gathered = level->ranks != NULL;
  if (part == 0)
    return is_gathered ? &mg->gathered : &level->matrix;
  if (is_gathered || level->terms.n == 0 || level->terms.at[i] < 0)
    return NULL;
  *q = level->terms.at[i];
  return &level->terms.rows;
}

/* Append the free nodes of a row that are not in the list. */
static int32_t
append(const abut_multigrid *mg, const abut_multigrid_level *level,
       const abut_node_rows *rows, int32_t q, int32_t *list, int32_t n,
       uint8_t *seen)
{
  for (int64_t e = rows->start[q]; e < rows->start[q + 1]; ++e)
  {
    const int32_t j = rows->node[e];
    if (seen[j] || !is_free(mg, level, j))
      continue;
    seen[j] = 1;
    list[n++] = j;
  }
  return n;
}

/* Append the free neighbours of the nodes in the list that are not in it. */
static int32_t
walk(const abut_multigrid *mg, const abut_multigrid_level *level, int32_t *list,
     int32_t n_done, int32_t n, uint8_t *seen)
{
  for (; n_done < n; ++n_done)
    for (int32_t part = 0; part < 2; ++part)
    {
      int32_t q = 0;
      const abut_node_rows *rows = rows_of(mg, level, part, list[n_done], &q);
      if (rows != NULL)
        n = append(mg, level, rows, q, list, n, seen);
    }
  return n;
}

/* Nodes in the order of their distance from the last one met from any node of
 * their part, which is a corner. Returns how many are free. */
static int32_t
order(const abut_multigrid *mg, const abut_multigrid_level *level,
      int32_t *list, uint8_t *seen)
{
  int32_t n = 0;
  for (int32_t i = 0; i < level->n; ++i)
  {
    if (seen[i] || !is_free(mg, level, i))
      continue;
    const int32_t first = n;
    list[n++] = i;
    seen[i] = 1;
    n = walk(mg, level, list, first, n, seen);
    const int32_t corner = list[n - 1];
    for (int32_t k = first; k < n; ++k)
      seen[list[k]] = 0;
    list[first] = corner;
    seen[corner] = 1;
    n = walk(mg, level, list, first, first + 1, seen);
  }
  return n;
}

/* Let a row of the factor begin where a part of the matrix does. */
static void
reach(abut_multigrid *mg, const abut_multigrid_level *level, int32_t part,
      int32_t row)
{
  abut_envelope *f = &mg->factor;
  const int32_t b = mg->block;
  int32_t q = 0;
  const abut_node_rows *rows = rows_of(mg, level, part, f->source[row] / b, &q);
  if (rows == NULL)
    return;
  for (int64_t e = rows->start[q]; e < rows->start[q + 1]; ++e)
    for (int32_t c = 0; c < b; ++c)
    {
      const int32_t column = f->place[rows->node[e] * b + c];
      if (column >= 0 && column < f->first[row])
        f->first[row] = column;
    }
}

/* Rows of the factor for the nodes of the list, and where they begin. */
static void
make_rows(abut_multigrid *mg, const abut_multigrid_level *level,
          const int32_t *list, int32_t n_nodes)
{
  abut_envelope *f = &mg->factor;
  const int32_t b = mg->block;
  f->n = 0;
  for (int32_t k = 0; k < n_nodes; ++k)
    for (int32_t c = 0; c < b; ++c)
    {
      const int64_t u = (int64_t)list[k] * b + c;
      if (level->held[u])
        continue;
      f->source[f->n] = (int32_t)u;
      f->place[u] = f->n++;
    }
  for (int32_t row = 0; row < f->n; ++row)
  {
    f->first[row] = row;
    for (int32_t part = 0; part < 2; ++part)
      reach(mg, level, part, row);
    f->start[row + 1] = f->start[row] + row - f->first[row] + 1;
  }
}

/* Add the numbers of a part of the matrix to a row of the factor. */
static void
add_numbers(abut_multigrid *mg, const abut_multigrid_level *level, int32_t part,
            int32_t row)
{
  abut_envelope *f = &mg->factor;
  const int32_t b = mg->block, r = f->source[row] % b;
  int32_t q = 0;
  const abut_node_rows *rows = rows_of(mg, level, part, f->source[row] / b, &q);
  if (rows == NULL)
    return;
  for (int64_t e = rows->start[q]; e < rows->start[q + 1]; ++e)
    for (int32_t c = 0; c < b; ++c)
    {
      const int32_t column = f->place[rows->node[e] * b + c];
      if (column >= 0 && column <= row)
        f->value[f->start[row] + column - f->first[row]] +=
            (double)rows->weight[(e * b + r) * b + c];
    }
}

static void
fill(abut_multigrid *mg, const abut_multigrid_level *level)
{
  for (int32_t row = 0; row < mg->factor.n; ++row)
    for (int32_t part = 0; part < 2; ++part)
      add_numbers(mg, level, part, row);
}

/* Row by row; rows of functions that are left out become 0. */
static void
factorise(abut_envelope *f)
{
  for (int32_t i = 0; i < f->n; ++i)
  {
    double *row = f->value + f->start[i] - f->first[i];
    const double diagonal = row[i];
    double pivot = diagonal;
    for (int32_t j = f->first[i]; j < i; ++j)
    {
      const double *other = f->value + f->start[j] - f->first[j];
      const int32_t first =
          f->first[i] > f->first[j] ? f->first[i] : f->first[j];
      double sum = row[j];
      for (int32_t k = first; k < j; ++k)
        sum -= row[k] * other[k];
      row[j] = other[j] > 0 ? sum / other[j] : 0;
      pivot -= row[j] * row[j];
    }
    if (pivot > smallest_pivot * diagonal)
    {
      row[i] = sqrt(pivot);
      continue;
    }
    for (int32_t j = f->first[i]; j <= i; ++j)
      row[j] = 0;
  }
}

static abut_status
reserve(abut_multigrid *mg, const abut_multigrid_level *level)
{
  abut_envelope *f = &mg->factor;
  const int64_t n = (int64_t)level->n * mg->block;
  f->first = abut_pool_allocate(&mg->coarsest, n, sizeof(int32_t));
  f->place = abut_pool_allocate(&mg->coarsest, n, sizeof(int32_t));
  f->source = abut_pool_allocate(&mg->coarsest, n, sizeof(int32_t));
  f->start = abut_pool_allocate(&mg->coarsest, n + 1, sizeof(int64_t));
  f->x = abut_pool_allocate(&mg->coarsest, n, sizeof(double));
  for (int64_t u = 0; u < n && f->place != NULL; ++u)
    f->place[u] = -1;
  return mg->coarsest.failed ? ABUT_OUT_OF_MEMORY : ABUT_SUCCESS;
}

abut_status
abut_multigrid_factorise(abut_multigrid *mg)
{
  static const char call[] = "abut_multigrid_set_constrained";
  const abut_multigrid_level *level = &mg->level[mg->n_levels - 1];
  abut_envelope *f = &mg->factor;
  abut_pool_release(&mg->coarsest);
  if ((int64_t)level->n * mg->block > ABUT_MULTIGRID_COARSEST)
    return abut_fail(mg->context, ABUT_UNSUPPORTED, call,
                     "the coarsest mesh has more than 4000 unknowns");
  if (reserve(mg, level) != ABUT_SUCCESS
      || (level->ranks != NULL
          && abut_multigrid_gather_coarsest(mg) != ABUT_SUCCESS))
    return abut_fail(mg->context, ABUT_OUT_OF_MEMORY, call, "no memory");
  int32_t *list = abut_pool_allocate(&mg->coarsest, level->n, sizeof(int32_t));
  uint8_t *seen = abut_pool_allocate(&mg->coarsest, level->n, 1);
  if (!mg->coarsest.failed)
  {
    make_rows(mg, level, list, order(mg, level, list, seen));
    f->value =
        abut_pool_allocate(&mg->coarsest, f->start[f->n], sizeof(double));
  }
  if (mg->coarsest.failed)
    return abut_fail(mg->context, ABUT_OUT_OF_MEMORY, call, "no memory");
  fill(mg, level);
  factorise(f);
  return ABUT_SUCCESS;
}

void
abut_multigrid_solve_coarsest(abut_multigrid *mg)
{
  abut_envelope *f = &mg->factor;
  abut_multigrid_level *level = &mg->level[mg->n_levels - 1];
  for (int32_t i = 0; i < f->n; ++i)
  {
    const double *row = f->value + f->start[i] - f->first[i];
    double sum = (double)level->r[f->source[i]];
    for (int32_t j = f->first[i]; j < i; ++j)
      sum -= row[j] * f->x[j];
    f->x[i] = row[i] > 0 ? sum / row[i] : 0;
  }
  for (int64_t u = 0; u < (int64_t)level->n * mg->block; ++u)
    level->x[u] = 0;
  for (int32_t i = f->n; i-- > 0;)
  {
    const double *row = f->value + f->start[i] - f->first[i];
    f->x[i] = row[i] > 0 ? f->x[i] / row[i] : 0;
    for (int32_t j = f->first[i]; j < i; ++j)
      f->x[j] -= row[j] * f->x[i];
    level->x[f->source[i]] = (float)f->x[i];
  }
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Coarse matrices P^T A P without what is held, row by row, so that only rows
 * near a change are made anew. A row is summed up from nothing in the same
 * order each time: making it anew gives the same to the last bit as making
 * all. */
#include "multigrid/multigrid.h"

#include <string.h>

/* Visit the columns of coarse row k that no visit has met yet; returns how
 * many. Writes them where there is room for them. */
static int32_t
collect(const abut_multigrid_level *fine, int32_t k, int32_t *place,
        int32_t *columns)
{
  int32_t n = 0;
  for (int64_t f = fine->children.start[k]; f < fine->children.start[k + 1];
       ++f)
  {
    const int32_t i = fine->children.node[f];
    for (int64_t e = fine->matrix.start[i]; e < fine->matrix.start[i + 1]; ++e)
    {
      const int32_t j = fine->matrix.node[e];
      for (int64_t g = fine->parents.start[j]; g < fine->parents.start[j + 1];
           ++g)
      {
        const int32_t column = fine->parents.node[g];
        if (place[column] == k)
          continue;
        place[column] = k;
        if (columns != NULL)
          columns[n] = column;
        ++n;
      }
    }
  }
  return n;
}

static void
clear(abut_multigrid *mg, int32_t n)
{
  for (int32_t i = 0; i < n; ++i)
    mg->place[i] = -1;
}

void
abut_galerkin_pattern(abut_multigrid *mg, int32_t l)
{
  const abut_multigrid_level *fine = &mg->level[l];
  abut_multigrid_level *coarse = &mg->level[l + 1];
  abut_node_rows *rows = &coarse->matrix;
  rows->start =
      abut_pool_take(&mg->matrices, (int64_t)coarse->n + 1, sizeof(int64_t));
  if (mg->matrices.failed)
    return;
  clear(mg, coarse->n);
  for (int32_t k = 0; k < coarse->n; ++k)
    rows->start[k + 1] = rows->start[k] + collect(fine, k, mg->place, NULL);
  const int64_t n = rows->start[coarse->n];
  rows->node = abut_pool_take(&mg->matrices, n, sizeof(int32_t));
  rows->weight =
      abut_pool_take(&mg->matrices, n * mg->block * mg->block, sizeof(float));
  coarse->diagonal = abut_pool_take(&mg->matrices, coarse->n, sizeof(int64_t));
  if (mg->matrices.failed)
    return;
  clear(mg, coarse->n);
  for (int32_t k = 0; k < coarse->n; ++k)
  {
    collect(fine, k, mg->place, rows->node + rows->start[k]);
    coarse->diagonal[k] = -1;
    for (int64_t e = rows->start[k]; e < rows->start[k + 1]; ++e)
      if (rows->node[e] == k)
        coarse->diagonal[k] = e;
  }
}

/* a = weight times a block of the fine matrix, without what is held. */
ABUT_INLINE void
free_part(const float *block, const uint8_t *row, const uint8_t *column,
          const int32_t b, float weight, float *a)
{
  for (int32_t r = 0; r < b; ++r)
    for (int32_t c = 0; c < b; ++c)
      a[r * b + c] = row[r] || column[c] ? 0 : weight * block[r * b + c];
}

/* Add what fine node i has for the coarse row whose columns stand at places. */
ABUT_INLINE void
add_child(const abut_multigrid_level *fine, const int32_t b, int32_t i,
          float weight, const int32_t *place, float *row)
{
  for (int64_t e = fine->matrix.start[i]; e < fine->matrix.start[i + 1]; ++e)
  {
    const int32_t j = fine->matrix.node[e];
    float a[ABUT_MULTIGRID_BLOCK];
    free_part(fine->matrix.weight + e * b * b, fine->held + (int64_t)i * b,
              fine->held + (int64_t)j * b, b, weight, a);
    for (int64_t g = fine->parents.start[j]; g < fine->parents.start[j + 1];
         ++g)
    {
      float *sum = row + (int64_t)place[fine->parents.node[g]] * b * b;
      for (int32_t r = 0; r < b * b; ++r)
        sum[r] += fine->parents.weight[g] * a[r];
    }
  }
}

/* Cut off what is fixed on the coarse level. */
ABUT_INLINE void
cut_fixed(const abut_multigrid_level *coarse, const int32_t b, int32_t k,
          float *row)
{
  const int64_t first = coarse->matrix.start[k];
  for (int64_t e = first; e < coarse->matrix.start[k + 1]; ++e)
    free_part(row + (e - first) * b * b, coarse->fixed + (int64_t)k * b,
              coarse->fixed + (int64_t)coarse->matrix.node[e] * b, b, 1,
              row + (e - first) * b * b);
}

ABUT_INLINE void
make_rows(abut_multigrid *mg, const int32_t b, int32_t l)
{
  const abut_multigrid_level *fine = &mg->level[l];
  abut_multigrid_level *coarse = &mg->level[l + 1];
  for (int32_t k = 0; k < coarse->n; ++k)
  {
    if (!coarse->dirty[k])
      continue;
    const int64_t first = coarse->matrix.start[k];
    const int32_t n = (int32_t)(coarse->matrix.start[k + 1] - first);
    float *row = coarse->matrix.weight + first * b * b;
    memset(row, 0, (size_t)n * (size_t)(b * b) * sizeof(float));
    for (int32_t e = 0; e < n; ++e)
      mg->place[coarse->matrix.node[first + e]] = e;
    for (int64_t f = fine->children.start[k]; f < fine->children.start[k + 1];
         ++f)
      add_child(fine, b, fine->children.node[f], fine->children.weight[f],
                mg->place, row);
    cut_fixed(coarse, b, k, row);
    mg->n_renewed += 1;
  }
}

void
abut_galerkin_rows(abut_multigrid *mg, int32_t l)
{
  if (mg->block == 1)
    make_rows(mg, 1, l);
  else if (mg->block == 2)
    make_rows(mg, 2, l);
  else
    make_rows(mg, 3, l);
}

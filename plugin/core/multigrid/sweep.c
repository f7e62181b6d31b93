/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Smoothing of fields with one unknown at a node: one sweep of Gauss and Seidel
 * forwards before the coarse level and one backwards after it, which makes the
 * cycle symmetric. Rows have what is before their node first, then the
 * diagonal, then the rest. The sweep from 0 needs the first part, and what it
 * leaves is minus the last part times x, which is the first part's transpose:
 * both are done at once. So a cycle reads the matrix twice, where Chebyshev's
 * polynomial of degree 2 takes it four times, and needs no eigenvalue. */
#include "multigrid/multigrid.h"

#include <string.h>

void
abut_row_in_order(int32_t *node, int64_t n, int32_t i, int32_t *work)
{
  int64_t before = 0, after = 0;
  bool own = false;
  for (int64_t e = 0; e < n; ++e)
    if (node[e] < i)
      node[before++] = node[e];
    else if (node[e] > i)
      work[after++] = node[e];
    else
      own = true;
  if (own)
    node[before++] = i;
  for (int64_t e = 0; e < after; ++e)
    node[before + e] = work[e];
}

/* Entries from `first` to `end` of the matrix times v. */
ABUT_INLINE float
product(const abut_node_rows *rows, int64_t first, int64_t end, const float *v)
{
  float sum = 0;
  for (int64_t e = first; e < end; ++e)
    sum += rows->weight[e] * v[rows->node[e]];
  return sum;
}

/* Where the part of row i before its diagonal ends. */
ABUT_INLINE int64_t
end_before(const abut_multigrid_level *level, int32_t i)
{
  const int64_t diagonal = level->diagonal[i];
  return diagonal < 0 ? level->matrix.start[i + 1] : diagonal;
}

void
abut_level_sweep_first(abut_multigrid_level *level)
{
  const abut_node_rows *rows = &level->matrix;
  memset(level->z, 0, (size_t)level->n * sizeof(float));
  for (int32_t i = 0; i < level->n; ++i)
  {
    level->x[i] = 0;
    if (level->held[i])
      continue;
    const int64_t first = rows->start[i], end = end_before(level, i);
    const float x =
        level->inverse[i] * (level->r[i] - product(rows, first, end, level->x));
    level->x[i] = x;
    for (int64_t e = first; e < end; ++e)
      level->z[rows->node[e]] -= rows->weight[e] * x;
  }
}

void
abut_level_sweep_restrict(abut_multigrid_level *level,
                          abut_multigrid_level *coarse)
{
  const abut_node_rows *up = &level->parents;
  memset(coarse->r, 0, (size_t)coarse->n * sizeof(float));
  for (int32_t i = 0; i < level->n; ++i)
  {
    if (level->held[i])
      continue;
    for (int64_t e = up->start[i]; e < up->start[i + 1]; ++e)
      coarse->r[up->node[e]] += up->weight[e] * level->z[i];
  }
}

void
abut_level_sweep_last(abut_multigrid_level *level)
{
  const abut_node_rows *rows = &level->matrix;
  for (int32_t i = level->n; i-- > 0;)
  {
    if (level->held[i])
      continue;
    const int64_t end = end_before(level, i);
    const float others = product(rows, rows->start[i], end, level->x)
                         + product(rows, end + 1, rows->start[i + 1], level->x);
    level->x[i] = level->inverse[i] * (level->r[i] - others);
  }
}

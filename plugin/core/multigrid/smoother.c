/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Smoothing and transfer on one level.
 *
 * The smoother is Chebyshev's polynomial of the fourth kind of degree 2 with
 * the weights that are best in a V-cycle (Lottes, Numer. Linear Algebra Appl.
 * 30, 2023): it needs a bound of the largest eigenvalue only. With residual r
 * and S the inverse of the diagonal blocks, its correction is
 *     z = 4/3 S r / largest
 *     weight_1 z + weight_2 (z / 5 + 12/5 S (r - A z) / largest),
 * the same before and after the coarse level, which makes the cycle symmetric.
 * Each line is one pass over the rows. With other ranks products are made
 * first, and added up over the copies of nodes.
 */
#include "multigrid/multigrid.h"

#include <string.h>

static const float weight_1 = 1.02387287570313f;
static const float weight_2 = 1.26408905371085f;

/* t += row number q times v, for blocks of 3: four products at once, the last
 * of which is of what follows and not used. There is one number more behind all
 * blocks and vectors for its sake. */
ABUT_INLINE void
add_row_times_3(const abut_node_rows *rows, int32_t q, const float *v, float *t)
{
  float sum[3][4] = {{0}};
  const int64_t end = rows->start[q + 1];
  for (int64_t e = rows->start[q]; e < end; ++e)
  {
    const float *a = rows->weight + e * 9;
    const float *x = v + (int64_t)rows->node[e] * 3;
    for (int32_t r = 0; r < 3; ++r)
      for (int32_t c = 0; c < 4; ++c)
        sum[r][c] += a[r * 3 + c] * x[c];
  }
  for (int32_t r = 0; r < 3; ++r)
    t[r] += sum[r][0] + sum[r][1] + sum[r][2];
}

/* t += row number q times v. */
ABUT_INLINE void
add_row_times(const abut_node_rows *rows, const int32_t b, int32_t q,
              const float *v, float *t)
{
  if (b == 3)
  {
    add_row_times_3(rows, q, v, t);
    return;
  }
  const int64_t end = rows->start[q + 1];
  for (int64_t e = rows->start[q]; e < end; ++e)
  {
    const float *a = rows->weight + e * b * b;
    const float *x = v + (int64_t)rows->node[e] * b;
    for (int32_t r = 0; r < b; ++r)
      for (int32_t c = 0; c < b; ++c)
        t[r] += a[r * b + c] * x[c];
  }
}

/* t += row i of half a matrix times v, and let it add to the rows behind: for
 * blocks of 3 as above. The contribution of the diagonal block, which is among
 * those of the row, to its own row is dropped. */
ABUT_INLINE void
half_row_times_3(const abut_multigrid_level *level, int32_t i, const float *v,
                 float *t)
{
  static const float lane[4] = {1, 1, 1, 0};
  float sum[3][4] = {{0}};
  const float *own = v + (int64_t)i * 3;
  const int32_t *node = level->matrix.node + level->matrix.start[i];
  const int64_t first = level->upper[i], n = level->upper[i + 1] - first;
  for (int64_t e = 0; e < n; ++e)
  {
    const float *a = level->matrix.weight + (first + e) * 9;
    const float *x = v + (int64_t)node[e] * 3;
    float *below = level->below + (int64_t)node[e] * 3;
    for (int32_t r = 0; r < 3; ++r)
      for (int32_t c = 0; c < 4; ++c)
        sum[r][c] += a[r * 3 + c] * x[c];
    for (int32_t c = 0; c < 4; ++c)
      below[c] +=
          lane[c] * (a[c] * own[0] + a[3 + c] * own[1] + a[6 + c] * own[2]);
  }
  for (int32_t r = 0; r < 3; ++r)
    t[r] += sum[r][0] + sum[r][1] + sum[r][2];
}

ABUT_INLINE void
half_row_times_2(const abut_multigrid_level *level, int32_t i, const float *v,
                 float *t)
{
  const float *own = v + (int64_t)i * 2;
  const int32_t *node = level->matrix.node + level->matrix.start[i];
  const int64_t first = level->upper[i], n = level->upper[i + 1] - first;
  for (int64_t e = 0; e < n; ++e)
  {
    const float *a = level->matrix.weight + (first + e) * 4;
    const float *x = v + (int64_t)node[e] * 2;
    float *below = level->below + (int64_t)node[e] * 2;
    for (int32_t r = 0; r < 2; ++r)
    {
      t[r] += a[r * 2] * x[0] + a[r * 2 + 1] * x[1];
      below[r] += a[r] * own[0] + a[2 + r] * own[1];
    }
  }
}

/* Whether nothing of node i is free. */
ABUT_INLINE bool
is_out(const abut_multigrid_level *level, const int32_t b, int32_t i)
{
  bool out = true;
  for (int32_t r = 0; r < b; ++r)
    out &= level->held[(int64_t)i * b + r] != 0;
  return out;
}

/* The same for blocks of b; rows come one after the other, from the first on. A
 * row of which nothing is free adds nothing, as v is 0 there. */
ABUT_INLINE void
half_row_times(const abut_multigrid_level *level, const int32_t b, int32_t i,
               bool out, const float *v, float *t)
{
  float *below = level->below + (int64_t)i * b;
  for (int32_t r = 0; r < b; ++r)
    t[r] = below[r];
  if (!out && b == 3)
    half_row_times_3(level, i, v, t);
  else if (!out)
    half_row_times_2(level, i, v, t);
  for (int32_t r = 0; r < b; ++r)
    below[r] = 0;
}

/* t = row i of the matrix, with what is added to it, times v. Rows of which
 * nothing is free are passed over, as their products are multiplied by 0: a
 * third of the work where a third of a membrane touches. */
ABUT_INLINE void
own_row_times(const abut_multigrid_level *level, const int32_t b, int32_t i,
              const float *v, float *t)
{
  for (int32_t r = 0; r < b; ++r)
    t[r] = 0;
  const bool out = is_out(level, b, i);
  if (b > 1 && level->upper != NULL)
    half_row_times(level, b, i, out, v, t);
  else if (!out)
    add_row_times(&level->matrix, b, i, v, t);
  if (!out && level->terms.n > 0 && level->terms.at[i] >= 0)
    add_row_times(&level->terms.rows, b, level->terms.at[i], v, t);
}

/* Give row_times() the product of all ranks' matrices with v, which is the same
 * at all copies. */
ABUT_INLINE void
multiply(abut_multigrid_level *level, const int32_t b, const float *v)
{
  if (level->product == NULL)
    return;
  for (int32_t i = 0; i < level->n; ++i)
    own_row_times(level, b, i, v, level->product + (int64_t)i * b);
  abut_level_share(level, b, level->product);
}

/* The same after multiply() with v. */
ABUT_INLINE void
row_times(const abut_multigrid_level *level, const int32_t b, int32_t i,
          const float *v, float *t)
{
  if (level->product == NULL)
  {
    own_row_times(level, b, i, v, t);
    return;
  }
  for (int32_t r = 0; r < b; ++r)
    t[r] = level->product[(int64_t)i * b + r];
}

/* s = factor * inverse of node i times t. */
ABUT_INLINE void
scale(const abut_multigrid_level *level, const int32_t b, int32_t i,
      float factor, const float *t, float *s)
{
  const float *a = level->inverse + (int64_t)i * b * b;
  for (int32_t r = 0; r < b; ++r)
  {
    float sum = 0;
    for (int32_t c = 0; c < b; ++c)
      sum += a[r * b + c] * t[c];
    s[r] = factor * sum;
  }
}

/* The increment of x with z from the first line. */
ABUT_INLINE void
second_line(abut_multigrid_level *level, const int32_t b, int32_t i, bool first)
{
  float t[3], s[3];
  const int64_t at = (int64_t)i * b;
  row_times(level, b, i, level->z, t);
  for (int32_t r = 0; r < b; ++r)
    t[r] = level->r[at + r] - t[r];
  scale(level, b, i, (float)(2.4 / level->largest), t, s);
  for (int32_t r = 0; r < b; ++r)
  {
    const float z = level->z[at + r];
    const float step = weight_1 * z + weight_2 * (0.2f * z + s[r]);
    level->x[at + r] = first ? step : level->x[at + r] + step;
  }
}

ABUT_INLINE void
smooth_first(abut_multigrid_level *level, const int32_t b)
{
  const float factor = (float)(4. / (3. * level->largest));
  for (int32_t i = 0; i < level->n; ++i)
    scale(level, b, i, factor, level->r + (int64_t)i * b,
          level->z + (int64_t)i * b);
  multiply(level, b, level->z);
  for (int32_t i = 0; i < level->n; ++i)
    second_line(level, b, i, true);
}

ABUT_INLINE void
smooth_last(abut_multigrid_level *level, const int32_t b)
{
  const float factor = (float)(4. / (3. * level->largest));
  multiply(level, b, level->x);
  for (int32_t i = 0; i < level->n; ++i)
  {
    float t[3];
    const int64_t at = (int64_t)i * b;
    row_times(level, b, i, level->x, t);
    for (int32_t r = 0; r < b; ++r)
      level->r[at + r] -= t[r];
    scale(level, b, i, factor, level->r + at, level->z + at);
  }
  multiply(level, b, level->z);
  for (int32_t i = 0; i < level->n; ++i)
    second_line(level, b, i, false);
}

ABUT_INLINE void
restrict_residual(abut_multigrid_level *level, const int32_t b,
                  abut_multigrid_level *coarse)
{
  memset(coarse->r, 0, (size_t)coarse->n * (size_t)b * sizeof(float));
  multiply(level, b, level->x);
  for (int32_t i = level->first_own; i < level->end_own; ++i)
  {
    float t[3];
    const int64_t at = (int64_t)i * b;
    row_times(level, b, i, level->x, t);
    for (int32_t r = 0; r < b; ++r)
      t[r] = level->held[at + r] ? 0 : level->r[at + r] - t[r];
    for (int64_t e = level->parents.start[i]; e < level->parents.start[i + 1];
         ++e)
      for (int32_t r = 0; r < b; ++r)
        coarse->r[(int64_t)level->parents.node[e] * b + r] +=
            level->parents.weight[e] * t[r];
  }
  abut_level_share(coarse, b, coarse->r);
}

ABUT_INLINE void
prolong(abut_multigrid_level *level, const int32_t b,
        const abut_multigrid_level *coarse)
{
  for (int32_t i = 0; i < level->n; ++i)
  {
    float t[3] = {0, 0, 0};
    const int64_t at = (int64_t)i * b;
    for (int64_t e = level->parents.start[i]; e < level->parents.start[i + 1];
         ++e)
      for (int32_t r = 0; r < b; ++r)
        t[r] += level->parents.weight[e]
                * coarse->x[(int64_t)level->parents.node[e] * b + r];
    for (int32_t r = 0; r < b; ++r)
      level->x[at + r] += level->held[at + r] ? 0 : t[r];
  }
}

ABUT_INLINE double
quotient(abut_multigrid_level *level, const int32_t b)
{
  double sums[2] = {0, 0};
  multiply(level, b, level->x);
  for (int32_t i = 0; i < level->n; ++i)
  {
    float t[3];
    const int64_t at = (int64_t)i * b;
    row_times(level, b, i, level->x, t);
    scale(level, b, i, 1, t, level->z + at);
    if (i < level->first_own || i >= level->end_own)
      continue;
    for (int32_t r = 0; r < b; ++r)
    {
      sums[0] += (double)level->z[at + r] * (double)t[r];
      sums[1] += (double)level->x[at + r] * (double)t[r];
    }
  }
  abut_level_reduce(level, ABUT_REDUCTION_SUM, sums, 2);
  return sums[1] > 0 ? sums[0] / sums[1] : 0;
}

/* The loops above are compiled for each size of blocks. */
#define ABUT_FOR_BLOCK(block, call_1, call_2, call_3)                          \
  switch (block)                                                               \
  {                                                                            \
  case 1:                                                                      \
    call_1;                                                                    \
    break;                                                                     \
  case 2:                                                                      \
    call_2;                                                                    \
    break;                                                                     \
  default:                                                                     \
    call_3;                                                                    \
  }

void
abut_level_smooth_first(abut_multigrid_level *level, int32_t block)
{
  ABUT_FOR_BLOCK(block, smooth_first(level, 1), smooth_first(level, 2),
                 smooth_first(level, 3))
}

void
abut_level_smooth_last(abut_multigrid_level *level, int32_t block)
{
  ABUT_FOR_BLOCK(block, smooth_last(level, 1), smooth_last(level, 2),
                 smooth_last(level, 3))
}

void
abut_level_restrict(abut_multigrid_level *level, int32_t block,
                    abut_multigrid_level *coarse)
{
  ABUT_FOR_BLOCK(block, restrict_residual(level, 1, coarse),
                 restrict_residual(level, 2, coarse),
                 restrict_residual(level, 3, coarse))
}

void
abut_level_prolong(abut_multigrid_level *level, int32_t block,
                   const abut_multigrid_level *coarse)
{
  ABUT_FOR_BLOCK(block, prolong(level, 1, coarse), prolong(level, 2, coarse),
                 prolong(level, 3, coarse))
}

double
abut_level_quotient(abut_multigrid_level *level, int32_t block)
{
  ABUT_FOR_BLOCK(block, return quotient(level, 1), return quotient(level, 2),
                 return quotient(level, 3))
}

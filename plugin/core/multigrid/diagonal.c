/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Inverses of diagonal blocks, and the bound of the eigenvalues that smoothing
 * needs. */
#include "multigrid/multigrid.h"

#include <math.h>
#include <string.h>

/* A pivot below this part of its diagonal entry: the component moves with the
 * others, as in rigid motions of a coarse function that is nearly cut off. */
static const double smallest_pivot = 1e-6;
/* Factor for the error of the power method. */
static const double margin = 1.2;

/* The inverse of the free part of a symmetric block, by Gauss and Jordan. */
static void
invert(const float *block, const uint8_t *held, int32_t b, float *inverse)
{
  double a[ABUT_MULTIGRID_BLOCK];
  bool used[3];
  for (int32_t k = 0; k < b * b; ++k)
    a[k] = held[k / b] || held[k % b] ? 0 : (double)block[k];
  for (int32_t p = 0; p < b; ++p)
  {
    const double pivot = a[p * b + p];
    used[p] = !held[p] && pivot > smallest_pivot * (double)block[p * b + p];
    if (!used[p])
      continue;
    for (int32_t r = 0; r < b; ++r)
      for (int32_t c = 0; c < b; ++c)
        if (r != p && c != p)
          a[r * b + c] -= a[r * b + p] * a[p * b + c] / pivot;
    for (int32_t r = 0; r < b; ++r)
      if (r != p)
      {
        a[p * b + r] /= pivot;
        a[r * b + p] = -a[r * b + p] / pivot;
      }
    a[p * b + p] = 1 / pivot;
  }
  for (int32_t k = 0; k < b * b; ++k)
    inverse[k] = used[k / b] && used[k % b] ? (float)a[k] : 0;
}

/* The diagonal block of node i with what is added to it. */
static void
diagonal_block(const abut_multigrid_level *level, int32_t b, int32_t i,
               float *block)
{
  const int32_t q = level->terms.n > 0 ? level->terms.at[i] : -1;
  const int64_t own = level->diagonal[i];
  const int64_t more = q < 0 ? -1 : level->terms.diagonal[q];
  for (int32_t k = 0; k < b * b; ++k)
    block[k] = (own < 0 ? 0 : level->matrix.weight[own * b * b + k])
               + (more < 0 ? 0 : level->terms.rows.weight[more * b * b + k]);
}

/* Diagonal blocks of all nodes, added up over the ranks. */
static void
share_blocks(abut_multigrid *mg, const abut_multigrid_level *level)
{
  const int32_t b = mg->block;
  for (int32_t i = 0; i < level->n; ++i)
    diagonal_block(level, b, i, mg->blocks + (int64_t)i * b * b);
  abut_level_share(level, b * b, mg->blocks);
}

void
abut_multigrid_invert(abut_multigrid *mg, int32_t l)
{
  abut_multigrid_level *level = &mg->level[l];
  const int32_t b = mg->block;
  if (level->ranks != NULL)
    share_blocks(mg, level);
  for (int32_t i = 0; i < level->n; ++i)
  {
    if (!level->dirty[i])
      continue;
    float block[ABUT_MULTIGRID_BLOCK];
    if (level->ranks == NULL)
      diagonal_block(level, b, i, block);
    else
      memcpy(block, mg->blocks + (int64_t)i * b * b,
             (size_t)(b * b) * sizeof(float));
    uint8_t *held = level->held + (int64_t)i * b;
    for (int32_t c = 0; c < b && l > 0; ++c)
      held[c] = level->fixed[(int64_t)i * b + c] || !(block[c * b + c] > 0);
    invert(block, held, b, level->inverse + (int64_t)i * b * b);
  }
}

/* Numbers in [-1, 1) without structure, the same on every machine. */
static float
noise(uint64_t *seed)
{
  *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return (float)((double)(*seed >> 11) / 4503599627370496.0 - 1);
}

void
abut_multigrid_bound(abut_multigrid *mg, int32_t l, int32_t n_steps)
{
  abut_multigrid_level *level = &mg->level[l];
  const int64_t n = (int64_t)level->n * mg->block;
  /* The same beginning each time: what a hierarchy does must not depend on the
   * sets before. */
  uint64_t seed = 1;
  for (int64_t u = 0; u < n; ++u)
  {
    const int64_t i = u / mg->block;
    const float x = noise(&seed);
    level->x[u] = i < level->first_own || i >= level->end_own ? 0 : x;
  }
  abut_level_share(level, mg->block, level->x);
  for (int64_t u = 0; u < n; ++u)
    level->x[u] = level->held[u] ? 0 : level->x[u];
  double largest = 0;
  for (int32_t step = 0; step < n_steps; ++step)
  {
    const double quotient = abut_level_quotient(level, mg->block);
    largest = fmax(largest, quotient);
    const float scale = quotient > 0 ? (float)(1 / quotient) : 0;
    for (int64_t u = 0; u < n; ++u)
      level->x[u] = scale * level->z[u];
  }
  /* Blocks alone have the eigenvalue 1. */
  level->largest = margin * fmax(largest, 1);
}

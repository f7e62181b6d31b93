/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Elimination of a point's pressures; abut/condense.h has the equations. Points
 * of one component are two divisions each, others two small factorisations. */
#include "base/dense_lu.h"
#include "base/sized.h"

#include <abut/condense.h>
#include <stdbool.h>

enum
{
  MAX_K = ABUT_CONDENSE_COMPONENTS
};

/* One point: its components, its blocks, and which components are held. */
typedef struct block
{
  int32_t k, n_held, n_sprung;
  int32_t held[MAX_K], sprung[MAX_K];
  const double *p, *c, *a, *b;
} block;

/* A dense factorisation of a part of a block. */
typedef struct part
{
  int32_t n, pivot[MAX_K];
  double a[MAX_K * MAX_K], scale[MAX_K];
} part;

static bool
factorise_part(part *f, const double *matrix, int32_t k, const int32_t *index,
               int32_t n)
{
  f->n = n;
  for (int32_t i = 0; i < n; ++i)
    for (int32_t j = 0; j < n; ++j)
      f->a[i * n + j] = matrix[index[i] * k + index[j]];
  return n == 0 || abut_dense_lu_factorise(n, f->a, f->pivot, f->scale);
}

static void
solve_part(const part *f, double *x)
{
  if (f->n > 0)
    abut_dense_lu_solve(f->n, f->a, f->pivot, f->scale, x);
}

static bool
is_held(const double *a, int32_t k, int32_t row)
{
  for (int32_t j = 0; j < k; ++j)
    if (a[row * k + j] != 0)
      return false;
  return true;
}

static block
make_block(int32_t k, const double *p, const double *c, const double *a,
           const double *b)
{
  block result = {.k = k, .p = p, .c = c, .a = a, .b = b};
  for (int32_t i = 0; i < k; ++i)
    if (is_held(a, k, i))
      result.held[result.n_held++] = i;
    else
      result.sprung[result.n_sprung++] = i;
  return result;
}

static void
set_zero(double *x, int32_t n)
{
  for (int32_t i = 0; i < n; ++i)
    x[i] = 0;
}

/* trial_H = B_HH^-1 B_H, value_H = -B_HH^-1 c_H. */
static bool
constrain(const block *at, double *value, double *trial)
{
  const int32_t k = at->k, n = at->n_held;
  part b;
  if (!factorise_part(&b, at->b, k, at->held, n))
    return false;
  double x[MAX_K] = {0};
  for (int32_t i = 0; i < n; ++i)
    x[i] = -at->c[at->held[i]];
  solve_part(&b, x);
  for (int32_t i = 0; i < n; ++i)
    value[at->held[i]] = x[i];
  for (int32_t i = 0; trial != NULL && i < n; ++i)
    trial[at->held[i] * k + at->held[i]] = 1;
  for (int32_t j = 0; trial != NULL && j < at->n_sprung; ++j)
  {
    for (int32_t i = 0; i < n; ++i)
      x[i] = at->b[at->held[i] * k + at->sprung[j]];
    solve_part(&b, x);
    for (int32_t i = 0; i < n; ++i)
      trial[at->held[i] * k + at->sprung[j]] = x[i];
  }
  return true;
}

/* x = c_S + A_SH q_H for one vector q over all components. */
static void
sprung_residual(const block *at, double factor, const double *q, double *x)
{
  for (int32_t i = 0; i < at->n_sprung; ++i)
  {
    const int32_t row = at->sprung[i];
    x[i] = at->c[row];
    for (int32_t j = 0; j < at->n_held; ++j)
      x[i] += factor * at->a[row * at->k + at->held[j]] * q[at->held[j]];
  }
}

/* Z = w A_SS^-1 B_S, f = w (p_S - A_SS^-1 (c_S - A_SH p_H)),
 * test_HS = -(A_SS^-1 A_SH)^T. */
static bool
spring(const block *at, double w, double *force, double *z, double *test)
{
  const int32_t k = at->k, n = at->n_sprung;
  part a;
  if (!factorise_part(&a, at->a, k, at->sprung, n))
    return false;
  double x[MAX_K] = {0};
  sprung_residual(at, -1, at->p, x);
  solve_part(&a, x);
  for (int32_t i = 0; i < n; ++i)
    force[at->sprung[i]] = w * (at->p[at->sprung[i]] - x[i]);
  for (int32_t j = 0; j < k; ++j)
  {
    for (int32_t i = 0; i < n; ++i)
      x[i] = at->b[at->sprung[i] * k + j];
    solve_part(&a, x);
    for (int32_t i = 0; i < n; ++i)
      z[at->sprung[i] * k + j] = w * x[i];
  }
  for (int32_t j = 0; test != NULL && j < at->n_held; ++j)
  {
    const int32_t h = at->held[j];
    for (int32_t i = 0; i < n; ++i)
      x[i] = at->a[at->sprung[i] * k + h];
    solve_part(&a, x);
    test[h * k + h] = 1;
    for (int32_t i = 0; i < n; ++i)
      test[h * k + at->sprung[i]] = -x[i];
  }
  return true;
}

/* The part that does not depend on k: where the numbers of a point begin. */
typedef struct place
{
  int64_t vector, block;
} place;

static int32_t
components(const abut_condense_points *points, int32_t i)
{
  return points->n_components == NULL ? 1 : points->n_components[i];
}

static double
weight(const abut_condense_points *points, int32_t i)
{
  return points->weight == NULL ? 1 : points->weight[i];
}

static block
block_at(const abut_condense_points *points, int32_t k, place at)
{
  return make_block(k, points->pressure + at.vector,
                    points->residual + at.vector, points->d_pressure + at.block,
                    points->d_gap + at.block);
}

static bool
condense_block(const abut_condense_points *points, int32_t i, int32_t k,
               place at, const abut_condensed *out)
{
  const block here = block_at(points, k, at);
  double *trial = out->trial == NULL ? NULL : out->trial + at.block;
  double *test = out->test == NULL ? NULL : out->test + at.block;
  set_zero(out->value + at.vector, k);
  set_zero(out->force + at.vector, k);
  set_zero(out->spring + at.block, k * k);
  if (trial != NULL)
    set_zero(trial, k * k);
  if (test != NULL)
    set_zero(test, k * k);
  for (int32_t j = 0; j < k; ++j)
    out->held[at.vector + j] = is_held(here.a, k, j);
  return constrain(&here, out->value + at.vector, trial)
         && spring(&here, weight(points, i), out->force + at.vector,
                   out->spring + at.block, test);
}

/* The same for k = 1: both answers at once, of which one is taken. */
static bool
condense_number(const abut_condense_points *points, int32_t i, place at,
                const abut_condensed *out)
{
  const double a = points->d_pressure[at.block], b = points->d_gap[at.block];
  const double c = points->residual[at.vector], w = weight(points, i);
  const bool held = a == 0;
  const double divisor = held ? b : a;
  out->held[at.vector] = held;
  out->value[at.vector] = held ? -c / divisor : 0;
  out->force[at.vector] =
      held ? 0 : w * (points->pressure[at.vector] - c / divisor);
  out->spring[at.block] = held ? 0 : w * b / divisor;
  if (out->trial != NULL)
    out->trial[at.block] = held;
  if (out->test != NULL)
    out->test[at.block] = held;
  return divisor != 0;
}

static bool
recover_block(const block *at, const double *dg, double *dp)
{
  part a;
  if (!factorise_part(&a, at->a, at->k, at->sprung, at->n_sprung))
    return false;
  double x[MAX_K] = {0};
  sprung_residual(at, 1, dp, x);
  for (int32_t i = 0; i < at->n_sprung; ++i)
    for (int32_t j = 0; j < at->k; ++j)
      x[i] += at->b[at->sprung[i] * at->k + j] * dg[j];
  solve_part(&a, x);
  for (int32_t i = 0; i < at->n_sprung; ++i)
    dp[at->sprung[i]] = -x[i];
  return true;
}

/* The points of a caller, in this version's struct; there is no context for an
 * error message. */
static abut_status
take_points(const abut_condense_points *given, abut_condense_points *points)
{
  *points = (abut_condense_points){.struct_size = sizeof(*points)};
  if (given == NULL || abut_sized_read(points, sizeof(*points), given) != NULL
      || points->n < 0)
    return ABUT_INVALID_ARGUMENT;
  if (points->n > 0
      && (points->pressure == NULL || points->residual == NULL
          || points->d_pressure == NULL || points->d_gap == NULL))
    return ABUT_INVALID_ARGUMENT;
  for (int32_t i = 0; points->n_components != NULL && i < points->n; ++i)
    if (points->n_components[i] < 1 || points->n_components[i] > MAX_K)
      return ABUT_INVALID_ARGUMENT;
  return ABUT_SUCCESS;
}

static abut_status
take_result(const abut_condensed *given, int32_t n, abut_condensed *result)
{
  *result = (abut_condensed){.struct_size = sizeof(*result)};
  if (given == NULL || abut_sized_read(result, sizeof(*result), given) != NULL)
    return ABUT_INVALID_ARGUMENT;
  const bool complete = result->held != NULL && result->value != NULL
                        && result->force != NULL && result->spring != NULL;
  return n == 0 || complete ? ABUT_SUCCESS : ABUT_INVALID_ARGUMENT;
}

static place
next_place(place at, int32_t k)
{
  return (place){at.vector + k, at.block + (int64_t)k * k};
}

/* 0 if all numbers written for a point are finite, else NaN. */
static double
finite_sum(const abut_condensed *out, int32_t k, place at)
{
  double sum = 0;
  for (int32_t j = 0; j < k; ++j)
    sum += (out->value[at.vector + j] + out->force[at.vector + j]) * 0;
  for (int32_t j = 0; j < k * k; ++j)
    sum += out->spring[at.block + j] * 0;
  return sum;
}

abut_status
abut_condense(const abut_condense_points *points, const abut_condensed *result)
{
  abut_condense_points from;
  abut_condensed to;
  abut_status status = take_points(points, &from);
  if (status == ABUT_SUCCESS)
    status = take_result(result, from.n, &to);
  if (status != ABUT_SUCCESS)
    return status;
  place at = {0, 0};
  bool regular = true;
  double finite = 0;
  for (int32_t i = 0; i < from.n; ++i)
  {
    const int32_t k = components(&from, i);
    regular &= k == 1 ? condense_number(&from, i, at, &to)
                      : condense_block(&from, i, k, at, &to);
    finite += finite_sum(&to, k, at);
    at = next_place(at, k);
  }
  if (!regular)
    return ABUT_UNSUPPORTED;
  return finite == 0 ? ABUT_SUCCESS : ABUT_NOT_FINITE;
}

abut_status
abut_condense_recover(const abut_condense_points *points,
                      const double *gap_change, double *pressure_change)
{
  abut_condense_points from;
  const abut_status status = take_points(points, &from);
  if (status != ABUT_SUCCESS)
    return status;
  if (from.n > 0 && (gap_change == NULL || pressure_change == NULL))
    return ABUT_INVALID_ARGUMENT;
  place at = {0, 0};
  bool regular = true;
  double finite = 0;
  for (int32_t i = 0; i < from.n; ++i)
  {
    const int32_t k = components(&from, i);
    const double *dg = gap_change + at.vector;
    double *dp = pressure_change + at.vector;
    if (k == 1)
    {
      const double a = from.d_pressure[at.block];
      if (a != 0)
        *dp = -(from.residual[at.vector] + from.d_gap[at.block] * *dg) / a;
    }
    else
    {
      const block here = block_at(&from, k, at);
      regular &= recover_block(&here, dg, dp);
    }
    for (int32_t j = 0; j < k; ++j)
      finite += dp[j] * 0;
    at = next_place(at, k);
  }
  if (!regular)
    return ABUT_UNSUPPORTED;
  return finite == 0 ? ABUT_SUCCESS : ABUT_NOT_FINITE;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Friction of a given bound: stick or slip, linearisation; abut/friction.h has
 * the equations. */
#include "base/sized.h"

#include <abut/friction.h>
#include <abut/law.h>
#include <math.h>
#include <stdbool.h>

enum
{
  MAX_T = 2
};

/* One point. */
typedef struct contact
{
  int32_t t;
  double x[MAX_T], tau[MAX_T], shifted[MAX_T]; /* x, tau, s~ */
  double compliance[MAX_T];                    /* 1/eps */
  double length, rho;                          /* |x|, rho */
  double c;
  bool radial_return;
} contact;

static double
norm(const double *v, int32_t t)
{
  return t == 1 ? fabs(v[0]) : hypot(v[0], v[1]);
}

static double
dot(const double *a, const double *b, int32_t t)
{
  return a[0] * b[0] + (t == 2 ? a[1] * b[1] : 0);
}

static contact
contact_at(const abut_friction_points *points, int32_t i, int64_t first)
{
  contact at = {.t = points->n_tangents[i],
                .rho = points->bound[i],
                .c = points->scale[i],
                .radial_return = points->radial_return != 0};
  for (int32_t k = 0; k < at.t; ++k)
  {
    const double reference = points->reference_traction == NULL
                                 ? 0
                                 : points->reference_traction[first + k];
    at.compliance[k] = points->tangent_compliance != NULL
                           ? points->tangent_compliance[first + k]
                       : points->compliance != NULL ? points->compliance[i]
                                                    : 0;
    at.tau[k] = points->traction[first + k];
    at.shifted[k] =
        points->slip[first + k] + (at.tau[k] - reference) * at.compliance[k];
    at.x[k] = at.tau[k] - at.c * at.shifted[k];
  }
  at.length = norm(at.x, at.t);
  return at;
}

static abut_status
take_points(const abut_friction_points *given, abut_friction_points *points)
{
  *points = (abut_friction_points){.struct_size = sizeof(*points)};
  if (given == NULL || abut_sized_read(points, sizeof(*points), given) != NULL
      || points->n < 0)
    return ABUT_INVALID_ARGUMENT;
  if (points->n > 0
      && (points->n_tangents == NULL || points->slip == NULL
          || points->traction == NULL || points->scale == NULL
          || points->bound == NULL || points->d_bound == NULL))
    return ABUT_INVALID_ARGUMENT;
  for (int32_t i = 0; i < points->n; ++i)
    if (points->n_tangents[i] < 1 || points->n_tangents[i] > MAX_T
        || !(points->scale[i] > 0) || !(points->bound[i] >= 0))
      return ABUT_INVALID_ARGUMENT;
  return ABUT_SUCCESS;
}

abut_status
abut_friction_classify(const abut_friction_points *given, uint8_t *state)
{
  abut_friction_points points;
  const abut_status status = take_points(given, &points);
  if (status != ABUT_SUCCESS)
    return status;
  if (points.n > 0 && state == NULL)
    return ABUT_INVALID_ARGUMENT;
  int64_t first = 0;
  for (int32_t i = 0; i < points.n; first += points.n_tangents[i++])
  {
    if (state[i] == ABUT_STATE_OPEN)
      continue;
    const contact at = contact_at(&points, i, first);
    state[i] =
        at.rho > 0 && at.length <= at.rho ? ABUT_STATE_CLOSED : ABUT_STATE_SLIP;
  }
  return ABUT_SUCCESS;
}

/* Where a point's numbers are written. */
typedef struct target
{
  double *residual, *a, *b, *d_pressure, *direction;
} target;

static void
set_blocks(const target *to, int32_t t, double a, double b)
{
  for (int32_t i = 0; i < t; ++i)
    for (int32_t j = 0; j < t; ++j)
    {
      to->a[i * t + j] = i == j ? a : 0;
      to->b[i * t + j] = i == j ? b : 0;
    }
}

static void
open_point(const contact *at, const target *to)
{
  set_blocks(to, at->t, 1, 0);
  for (int32_t k = 0; k < at->t; ++k)
  {
    to->residual[k] = at->tau[k];
    to->d_pressure[k] = 0;
  }
}

static void
stick(const contact *at, const target *to)
{
  set_blocks(to, at->t, 0, 1);
  for (int32_t k = 0; k < at->t; ++k)
  {
    to->a[k * at->t + k] = at->compliance[k];
    to->residual[k] = at->shifted[k];
    to->d_pressure[k] = 0;
  }
}

/* tau inside the disc, and the factor beta that keeps A regular: without it A
 * is singular at |x| = 2 rho, tau = -rho e. With rho e in the place of tau, and
 * no factor, the blocks are the derivatives of tau - rho e themselves. */
static double
safeguard(const contact *at, const double *e, double *inside)
{
  if (at->radial_return)
  {
    for (int32_t k = 0; k < at->t; ++k)
      inside[k] = at->rho * e[k];
    return 1;
  }
  const double length = norm(at->tau, at->t);
  const double factor = length > at->rho ? at->rho / length : 1;
  for (int32_t k = 0; k < at->t; ++k)
    inside[k] = at->tau[k] * factor;
  const double a = length > 0 ? dot(at->tau, e, at->t) / length : 0;
  const double d = at->rho > 0 ? fmin(length / at->rho, 1) : 0;
  return a < 0 ? 1 / (1 - a * d) : 1;
}

/* On the border to stick the spring across the slip, rho/|s|, would be infinite
 * and A singular: it is that of |x| = rho (1 + this) at most. */
static const double border = 1e-8;

static void
slip(const contact *at, double d_bound, const double *e, const target *to)
{
  const int32_t t = at->t;
  const double length = fmax(at->length, at->rho * (1 + border));
  double inside[MAX_T];
  /* Without a direction there is nothing to slip against: as if open. */
  if (!(at->length > 0))
  {
    open_point(at, to);
    return;
  }
  const double beta = safeguard(at, e, inside);
  for (int32_t i = 0; i < t; ++i)
    for (int32_t j = 0; j < t; ++j)
    {
      const double unit = i == j ? 1 : 0;
      const double m = beta / length * (at->rho * unit - inside[i] * e[j]);
      to->a[i * t + j] = unit - m * (1 - at->c * at->compliance[j]);
      to->b[i * t + j] = at->c * m;
    }
  for (int32_t i = 0; i < t; ++i)
  {
    to->residual[i] = at->tau[i] - at->rho * e[i];
    to->d_pressure[i] = -d_bound * dot(to->a + (int64_t)i * t, e, t);
  }
}

static void
linearise_point(const contact *at, uint8_t state, double d_bound,
                const target *to)
{
  double e[MAX_T] = {0, 0};
  for (int32_t k = 0; k < at->t && at->length > 0; ++k)
    e[k] = at->x[k] / at->length;
  for (int32_t k = 0; k < at->t && to->direction != NULL; ++k)
    to->direction[k] = e[k];
  if (state == ABUT_STATE_OPEN)
    open_point(at, to);
  else if (state == ABUT_STATE_CLOSED)
    stick(at, to);
  else
    slip(at, d_bound, e, to);
}

abut_status
abut_friction_linearise(const abut_friction_points *given, const uint8_t *state,
                        const abut_friction_linearisation *result)
{
  abut_friction_points points;
  abut_friction_linearisation out = {.struct_size = sizeof(out)};
  const abut_status status = take_points(given, &points);
  if (status != ABUT_SUCCESS)
    return status;
  if (result == NULL || abut_sized_read(&out, sizeof(out), result) != NULL)
    return ABUT_INVALID_ARGUMENT;
  if (points.n > 0
      && (state == NULL || out.residual == NULL || out.d_traction == NULL
          || out.d_slip == NULL || out.d_pressure == NULL))
    return ABUT_INVALID_ARGUMENT;
  int64_t first = 0, block = 0;
  double probe = 0;
  for (int32_t i = 0; i < points.n; ++i)
  {
    const contact at = contact_at(&points, i, first);
    const target to = {out.residual + first, out.d_traction + block,
                       out.d_slip + block, out.d_pressure + first,
                       out.direction == NULL ? NULL : out.direction + first};
    linearise_point(&at, state[i], points.d_bound[i], &to);
    for (int32_t k = 0; k < at.t; ++k)
      probe += (to.residual[k] + to.d_pressure[k]) * 0;
    first += at.t;
    block += (int64_t)at.t * at.t;
  }
  return probe == 0 ? ABUT_SUCCESS : ABUT_NOT_FINITE;
}

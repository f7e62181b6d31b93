/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "bar.h"

#include "base/dense_lu.h"

#include <string.h>

enum
{
  N = BAR_MAX,
  PROJECTION = ABUT_TIME_PROJECTION,
  STEP = ABUT_TIME_STEP
};

void
bar_open(bar *b, int32_t elements, double length, double stiffness,
         double density)
{
  memset(b, 0, sizeof(*b));
  b->n = elements + 1;
  b->h = length / elements;
  b->stiffness = stiffness;
  b->density = density;
  const int32_t n = b->n;
  for (int32_t e = 0; e < elements; ++e)
    for (int32_t i = 0; i < 2; ++i)
      for (int32_t j = 0; j < 2; ++j)
      {
        const int32_t at = (e + i) * n + e + j;
        b->k[at] += (i == j ? 1 : -1) * stiffness / b->h;
        b->m[at] += (i == j ? 2 : 1) * density * b->h / 6;
      }
  for (int32_t i = 0; i < n * n; ++i)
    b->full_mass[i / n] += b->m[i];
}

/* The three entries of each row, as the library wants them. */
static void
modify(bar *b, abut_mass_rule rule)
{
  int64_t start[N + 1] = {0};
  int32_t column[3 * N];
  double value[3 * N], place[N];
  uint8_t candidate[N] = {1};
  int64_t at = 0;
  for (int32_t i = 0; i < b->n; ++i)
  {
    place[i] = i * b->h;
    for (int32_t j = i > 0 ? i - 1 : 0; j <= i + 1 && j < b->n; ++j)
    {
      column[at] = j;
      value[at++] = b->m[i * b->n + j];
    }
    start[i + 1] = at;
  }
  const abut_mass_matrix mass = {sizeof(mass), b->n,  1,    start,
                                 column,       value, place};
  abut_context *context = fixture_context();
  assert_ok(abut_mass_modify(context, &mass, candidate, rule));
  assert_ok(abut_context_destroy(&context));
  for (int32_t i = 0; i < b->n; ++i)
    for (int64_t e = start[i]; e < start[i + 1]; ++e)
      b->m[i * b->n + column[e]] = value[e];
  b->massless[0] = 1;
}

/* Matrix of a stage with its last node clamped if the bar is. */
static void
factorise(bar *b, int32_t stage)
{
  abut_time_weights w;
  assert_ok(abut_time_weigh(&b->scheme, b->dt, (abut_time_stage)stage, &w));
  double *matrix = b->factor[stage];
  for (int32_t i = 0; i < b->n * b->n; ++i)
    matrix[i] = w.mass * b->m[i] + w.stiffness * b->k[i];
  for (int32_t i = 0; i < b->n && b->clamped; ++i)
    matrix[(b->n - 1) * b->n + i] = matrix[i * b->n + b->n - 1] =
        i == b->n - 1 ? 1 : 0;
  assert_true(
      abut_dense_lu_factorise(b->n, matrix, b->pivot[stage], b->scale[stage]));
  double *y = b->unit_answer[stage];
  memset(y, 0, sizeof(b->unit_answer[stage]));
  y[0] = 1;
  abut_dense_lu_solve(b->n, matrix, b->pivot[stage], b->scale[stage], y);
}

void
bar_use(bar *b, const char *scheme, double dt, abut_time_mass mass,
        abut_mass_rule rule)
{
  abut_time_options options = abut_time_defaults();
  options.name = scheme;
  assert_ok(abut_time_scheme_make(&options, &b->scheme));
  b->dt = dt;
  if (mass == ABUT_TIME_MASS_MODIFIED)
    modify(b, rule);
  for (int32_t i = 0; i < b->n * b->n && mass == ABUT_TIME_MASS_LUMPED; ++i)
    b->m[i] = i / b->n == i % b->n ? b->full_mass[i / b->n] : 0;
  for (int32_t i = 0; i < b->n; ++i)
    b->a[i] = b->load;
  if (b->scheme.projects)
    factorise(b, PROJECTION);
  factorise(b, STEP);
}

static void
multiply(const bar *b, const double *matrix, const double *x, double factor,
         double *sum)
{
  for (int32_t i = 0; i < b->n; ++i)
    for (int32_t j = i > 1 ? i - 2 : 0; j < b->n && j < i + 3; ++j)
      sum[i] += factor * matrix[i * b->n + j] * x[j];
}

/* x += A^-1 r, and so much of the wall's answer that node 0 stays above it.
 * Returns the force. */
static double
solve(bar *b, int32_t stage, double *residual, double *x, bool contact)
{
  if (b->clamped)
    residual[b->n - 1] = 0;
  abut_dense_lu_solve(b->n, b->factor[stage], b->pivot[stage], b->scale[stage],
                      residual);
  for (int32_t i = 0; i < b->n; ++i)
    x[i] += residual[i];
  if (!contact || x[0] >= b->wall)
    return 0;
  const double force = (b->wall - x[0]) / b->unit_answer[stage][0];
  for (int32_t i = 0; i < b->n; ++i)
    x[i] += force * b->unit_answer[stage][i];
  x[0] = b->wall;
  return force;
}

static abut_time_state
state_of(bar *b)
{
  const abut_time_state state = {sizeof(state), &b->scheme, b->dt, b->n,
                                 b->u,          b->v,       b->a,  b->massless};
  return state;
}

/* r = f - M inertia - K elastic, at the unknown x. */
static void
residual_at(bar *b, const abut_time_state *state, const double *x, double *r)
{
  double inertia[N], elastic[N];
  const abut_time_arguments arguments = {sizeof(arguments), inertia, NULL,
                                         elastic};
  assert_ok(abut_time_evaluate(state, x, &arguments));
  for (int32_t i = 0; i < b->n; ++i)
    r[i] = b->load * b->full_mass[i];
  multiply(b, b->m, inertia, -1, r);
  multiply(b, b->k, elastic, -1, r);
}

static void
implicit_step(bar *b, const abut_time_state *state, double *x)
{
  double r[N];
  residual_at(b, state, x, r);
  b->lambda += solve(b, STEP, r, x, b->scheme.contact_in_step != 0);
  assert_ok(abut_time_end(state, x));
}

static void
explicit_step(bar *b, const abut_time_state *state, const double *place)
{
  double r[N], x[N] = {0};
  residual_at(b, state, x, r);
  if (b->scheme.contact_in_step && place[0] < b->wall)
  {
    b->lambda = b->penalty * (b->wall - place[0]);
    r[0] += b->lambda;
  }
  solve(b, STEP, r, x, false);
  assert_ok(abut_time_end(state, x));
}

void
bar_step(bar *b)
{
  double x[N], old[N];
  const abut_time_state state = state_of(b);
  memcpy(old, b->u, sizeof(old));
  assert_ok(abut_time_begin(&state, x));
  b->lambda = 0;
  if (b->scheme.projects)
  {
    double projected[N], zero[N] = {0};
    memcpy(projected, x, sizeof(x));
    b->lambda = solve(b, PROJECTION, zero, projected, true);
    assert_ok(abut_time_project(&state, x, projected));
    memcpy(x, projected, sizeof(x));
  }
  if (b->scheme.beta > 0)
    implicit_step(b, &state, x);
  else
    explicit_step(b, &state, x);
  b->impulse += b->dt * b->lambda;
  for (int32_t i = 0; i < b->n; ++i)
    b->external_work += b->load * b->full_mass[i] * (b->u[i] - old[i]);
}

static double
square(const bar *b, const double *matrix, const double *x)
{
  double product[N] = {0}, sum = 0;
  multiply(b, matrix, x, 1, product);
  for (int32_t i = 0; i < b->n; ++i)
    sum += product[i] * x[i];
  return sum;
}

double
bar_kinetic(const bar *b)
{
  return square(b, b->m, b->v) / 2;
}

double
bar_strain(const bar *b)
{
  return square(b, b->k, b->u) / 2;
}

double
bar_contact(const bar *b)
{
  const double depth = fmax(0, b->wall - b->u[0]);
  return b->penalty * depth * depth / 2;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "membrane.h"
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

/* step-41's stairs, x in (-1, 1). */
static double
stairs(double x)
{
  return x < -0.5 ? -0.2 : x < 0 ? -0.4 : x < 0.5 ? -0.6 : -0.8;
}

membrane
membrane_create(int32_t level, double length, double force)
{
  const int32_t cells = 1 << level, m = cells - 1;
  membrane s = {.cells = cells, .m = m, .n = m * m};
  const size_t n = (size_t)s.n;
  s.h = 2 * length / cells;
  s.k = force / length;
  s.load = 10 * force / (length * length);
  s.u = calloc(n, sizeof(double));
  s.gap = calloc(n, sizeof(double));
  s.pressure = calloc(n, sizeof(double));
  s.weight = calloc(n, sizeof(double));
  s.stiffness = calloc(n, sizeof(double));
  s.psi = calloc(n, sizeof(double));
  s.state = calloc(n, 1);
  s.fixed = calloc(n, 1);
  s.band = calloc(n * (size_t)(m + 2), sizeof(double));
  s.du = calloc(n, sizeof(double));
  s.work = calloc(n, sizeof(double));
  for (int32_t i = 0; i < s.n; ++i)
  {
    const double x = -1 + 2.0 * (i % m + 1) / cells;
    s.psi[i] = length * stairs(x);
    s.weight[i] = s.h * s.h;
    s.stiffness[i] = s.k / (s.h * s.h);
  }
  return s;
}

void
membrane_destroy(membrane *s)
{
  void *arrays[] = {s->u,         s->gap, s->pressure, s->weight,
                    s->stiffness, s->psi, s->state,    s->fixed,
                    s->band,      s->du,  s->work};
  for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); ++i)
    free(arrays[i]);
}

/* y = K x: the bilinear element's stencil, 8/3 in the middle and -1/3 to the
 * eight neighbours. */
static void
apply(const membrane *s, const double *x, double *y)
{
  const int32_t m = s->m;
  for (int32_t row = 0; row < m; ++row)
    for (int32_t column = 0; column < m; ++column)
    {
      double sum = 0;
      for (int32_t r = row - 1; r <= row + 1; ++r)
        for (int32_t c = column - 1; c <= column + 1; ++c)
          if (r >= 0 && r < m && c >= 0 && c < m)
            sum += x[r * m + c];
      y[row * m + column] = s->k * (3 * x[row * m + column] - sum / 3);
    }
}

/* Lower band of K: entry (i, i - d) in band[i * (m + 2) + d]. */
static void
assemble(membrane *s)
{
  const int32_t m = s->m, width = m + 2;
  for (int32_t i = 0; i < s->n; ++i)
  {
    double *row = s->band + (size_t)i * (size_t)width;
    memset(row, 0, (size_t)width * sizeof(double));
    const bool left = i % m > 0, right = i % m < m - 1, below = i >= m;
    row[0] = 8 * s->k / 3;
    row[1] = left ? -s->k / 3 : 0;
    if (!below)
      continue;
    row[m] = -s->k / 3;
    row[m + 1] = left ? -s->k / 3 : 0;
    row[m - 1] += right ? -s->k / 3 : 0;
  }
}

/* Rows and columns of the fixed unknowns become those of the identity. */
static void
fix(membrane *s)
{
  const int32_t width = s->m + 2;
  for (int32_t i = 0; i < s->n; ++i)
    for (int32_t d = 0; d < width && d <= i; ++d)
      if (s->fixed[i] || s->fixed[i - d])
        s->band[(size_t)i * (size_t)width + (size_t)d] = d == 0 ? 1 : 0;
}

static void
factorise(membrane *s)
{
  const int32_t width = s->m + 2;
  for (int32_t i = 0; i < s->n; ++i)
  {
    double *row = s->band + (size_t)i * (size_t)width;
    const int32_t reach = i < width - 1 ? i : width - 1;
    for (int32_t d = reach; d >= 0; --d)
    {
      const double *other = s->band + (size_t)(i - d) * (size_t)width;
      double sum = row[d];
      for (int32_t e = d + 1; e <= reach; ++e)
        sum -= row[e] * other[e - d];
      row[d] = d > 0 ? sum / other[0] : sqrt(sum);
    }
  }
}

static void
substitute(const membrane *s, double *x)
{
  const int32_t width = s->m + 2;
  for (int32_t i = 0; i < s->n; ++i)
  {
    const double *row = s->band + (size_t)i * (size_t)width;
    for (int32_t d = 1; d < width && d <= i; ++d)
      x[i] -= row[d] * x[i - d];
    x[i] /= row[0];
  }
  for (int32_t i = s->n - 1; i >= 0; --i)
  {
    const double *row = s->band + (size_t)i * (size_t)width;
    x[i] /= row[0];
    for (int32_t d = 1; d < width && d <= i; ++d)
      x[i - d] -= row[d] * x[i];
  }
}

static void
build_matrix(membrane *s, const abut_request *r)
{
  const int32_t width = s->m + 2;
  assemble(s);
  for (int32_t i = 0; i < s->n; ++i)
  {
    s->fixed[i] = r->d_pressure[i] == 0;
    if (!s->fixed[i])
      s->band[(size_t)i * (size_t)width] +=
          s->weight[i] * r->d_gap[i] / r->d_pressure[i];
  }
  fix(s);
  factorise(s);
}

/* du = -R - W c / a where the pressure is condensed, and the prescribed -c / b
 * where it is not. */
static void
right_hand_side(membrane *s, const abut_request *r)
{
  double *prescribed = s->work;
  for (int32_t i = 0; i < s->n; ++i)
    prescribed[i] = s->u[i] + (s->fixed[i] ? -r->residual[i] / r->d_gap[i] : 0);
  apply(s, prescribed, s->du);
  for (int32_t i = 0; i < s->n; ++i)
    if (s->fixed[i])
      s->du[i] = prescribed[i] - s->u[i];
    else
      s->du[i] =
          -s->du[i] - s->weight[i] * s->load
          + s->weight[i] * (r->pressure[i] - r->residual[i] / r->d_pressure[i]);
}

static abut_status
solve(void *user, const abut_request *r)
{
  membrane *s = user;
  if (r->action == ABUT_ACTION_SOLVE)
  {
    /* A factor is kept for as long as the strategy says that it may be. */
    if (r->matrix_changed != 0)
      build_matrix(s, r);
    if (s->n_sets < 64)
      s->set_size[s->n_sets++] = membrane_n_active(s);
  }
  right_hand_side(s, r);
  substitute(s, s->du);
  for (int32_t i = 0; i < s->n; ++i)
    s->work[i] = s->u[i] + s->du[i];
  double *force = r->gap_change;
  apply(s, s->work, force);
  for (int32_t i = 0; i < s->n; ++i)
  {
    const double reaction = force[i] / s->weight[i] + s->load;
    r->pressure_change[i] =
        s->fixed[i]
            ? reaction - r->pressure[i]
            : (-r->residual[i] - r->d_gap[i] * s->du[i]) / r->d_pressure[i];
    r->gap_change[i] = s->du[i];
  }
  return ABUT_SUCCESS;
}

static abut_status
move(void *user, const abut_request *r, double *gap)
{
  membrane *s = user;
  for (int32_t i = 0; i < s->n; ++i)
  {
    s->u[i] += r->step_length * s->du[i];
    gap[i] = s->u[i] - s->psi[i];
  }
  return ABUT_SUCCESS;
}

static void
watch(void *user, const abut_progress *progress, const abut_request *r)
{
  membrane *s = user;
  (void)progress;
  memcpy(s->pressure, r->pressure, (size_t)s->n * sizeof(double));
  memcpy(s->state, r->state, (size_t)s->n);
}

abut_host
membrane_host(membrane *s)
{
  const abut_host host = {sizeof(abut_host), s, solve, move, watch};
  return host;
}

abut_reason
membrane_run(abut_context *context, membrane *s,
             const abut_strategy_options *options, bool use_state,
             abut_progress *progress)
{
  const abut_host host = membrane_host(s);
  abut_strategy *strategy = NULL;
  abut_reason reason = ABUT_REASON_NONE;
  s->n_sets = 0;
  for (int32_t i = 0; i < s->n; ++i)
    s->gap[i] = s->u[i] - s->psi[i];
  assert_ok(abut_strategy_create(context, options, &strategy));
  assert_ok(abut_strategy_start(strategy, s->n, NULL, s->weight, s->stiffness,
                                NULL, s->gap, s->pressure,
                                use_state ? s->state : NULL));
  assert_ok(abut_strategy_run(strategy, &host, &reason));
  assert_ok(abut_strategy_progress(strategy, progress));
  assert_ok(abut_strategy_destroy(&strategy));
  return reason;
}

abut_strategy_options
membrane_options(const membrane *s, const char *law)
{
  abut_strategy_options options = exact_options();
  options.law = abut_law_find(law);
  options.length_scale = s->h * s->cells / 2;
  options.pressure_scale = s->load;
  return options;
}

/* Value of the coarse field at the fine node, zero on the boundary. */
static double
interpolate(const membrane *coarse, const double *x, int32_t row,
            int32_t column)
{
  double sum = 0;
  for (int32_t r = row / 2; r <= (row + 1) / 2; ++r)
    for (int32_t c = column / 2; c <= (column + 1) / 2; ++c)
      if (r > 0 && r <= coarse->m && c > 0 && c <= coarse->m)
        sum += x[(r - 1) * coarse->m + c - 1];
  return sum / ((row % 2 + 1) * (column % 2 + 1));
}

void
membrane_prolong(const membrane *coarse, membrane *fine)
{
  for (int32_t i = 0; i < fine->n; ++i)
  {
    const int32_t row = i / fine->m + 1, column = i % fine->m + 1;
    fine->u[i] = interpolate(coarse, coarse->u, row, column);
    fine->pressure[i] = interpolate(coarse, coarse->pressure, row, column);
    fine->state[i] = fine->u[i] - fine->psi[i] < 1e-12 ? 1 : 0;
  }
}

double
membrane_energy(const membrane *s)
{
  double energy = 0;
  apply(s, s->u, s->work);
  for (int32_t i = 0; i < s->n; ++i)
    energy += s->u[i] * (s->work[i] / 2 + s->weight[i] * s->load);
  return energy;
}

double
membrane_force(const membrane *s)
{
  double force = 0;
  for (int32_t i = 0; i < s->n; ++i)
    force += s->weight[i] * s->pressure[i];
  return force;
}

int32_t
membrane_n_active(const membrane *s)
{
  int32_t n = 0;
  for (int32_t i = 0; i < s->n; ++i)
    n += s->fixed[i];
  return n;
}

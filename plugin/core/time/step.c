/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Updates of the motion, entry by entry; abut/time.h has the equations. */
#include "base/sized.h"
#include "time/scheme.h"

#include <math.h>

/* A state that was taken from the caller, with the scheme's numbers. */
typedef struct step
{
  abut_time_scheme scheme;
  abut_time_state state;
} step;

static abut_status
copy_in(const abut_time_state *given, step *taken)
{
  taken->state = (abut_time_state){.struct_size = sizeof(taken->state)};
  if (given == NULL
      || abut_sized_read(&taken->state, sizeof(taken->state), given) != NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_time_state *s = &taken->state;
  if (!(s->dt > 0) || !isfinite(s->dt) || s->n < 0
      || (s->n > 0
          && (s->displacement == NULL || s->velocity == NULL
              || s->acceleration == NULL)))
    return ABUT_INVALID_ARGUMENT;
  return abut_time_scheme_copy_in(s->scheme, &taken->scheme);
}

/* u + dt v + dt^2 (1/2 - beta) a. */
static double
predict(const step *s, int64_t i)
{
  const double dt = s->state.dt;
  return s->state.displacement[i]
         + dt
               * (s->state.velocity[i]
                  + dt * (0.5 - s->scheme.beta) * s->state.acceleration[i]);
}

abut_status
abut_time_begin(const abut_time_state *state, double *predicted)
{
  step s;
  const abut_status status = copy_in(state, &s);
  if (status != ABUT_SUCCESS)
    return status;
  if (s.state.n > 0 && predicted == NULL)
    return ABUT_INVALID_ARGUMENT;
  for (int64_t i = 0; i < s.state.n; ++i)
    predicted[i] = predict(&s, i);
  return ABUT_SUCCESS;
}

abut_status
abut_time_project(const abut_time_state *state, const double *predicted,
                  const double *projected)
{
  step s;
  const abut_status status = copy_in(state, &s);
  if (status != ABUT_SUCCESS)
    return status;
  if (s.state.n > 0 && (predicted == NULL || projected == NULL))
    return ABUT_INVALID_ARGUMENT;
  if (!s.scheme.projects)
    return ABUT_WRONG_ORDER;
  double probe = 0;
  for (int64_t i = 0; i < s.state.n; ++i)
    probe += 0.0 * (projected[i] - predicted[i]);
  if (probe != 0)
    return ABUT_NOT_FINITE;
  for (int64_t i = 0; i < s.state.n; ++i)
    s.state.velocity[i] += (projected[i] - predicted[i]) / s.state.dt;
  return ABUT_SUCCESS;
}

/* One unknown at the end of the step. */
typedef struct motion
{
  double u, v, a;
} motion;

static motion
advance(const step *s, int64_t i, double unknown)
{
  const double dt = s->state.dt, predicted = predict(s, i);
  const abut_time_scheme *scheme = &s->scheme;
  motion now = {predicted, 0, unknown};
  if (scheme->beta > 0)
  {
    now.u = unknown;
    now.a = (unknown - predicted) / (scheme->beta * dt * dt);
  }
  now.v = s->state.velocity[i]
          + dt
                * ((1 - scheme->gamma) * s->state.acceleration[i]
                   + scheme->gamma * now.a);
  return now;
}

abut_status
abut_time_evaluate(const abut_time_state *state, const double *unknown,
                   const abut_time_arguments *arguments)
{
  step s;
  abut_status status = copy_in(state, &s);
  if (status != ABUT_SUCCESS)
    return status;
  abut_time_arguments out = {.struct_size = sizeof(out)};
  if ((s.state.n > 0 && unknown == NULL) || arguments == NULL
      || abut_sized_read(&out, sizeof(out), arguments) != NULL)
    return ABUT_INVALID_ARGUMENT;
  const double m = s.scheme.alpha_m, f = s.scheme.alpha_f;
  const bool is_explicit = s.scheme.beta == 0;
  for (int64_t i = 0; i < s.state.n; ++i)
  {
    const motion now = advance(&s, i, unknown[i]);
    const double v = s.state.velocity[i], a = s.state.acceleration[i];
    if (out.inertia != NULL)
      out.inertia[i] = (1 - m) * now.a + m * a;
    if (out.damping != NULL)
      out.damping[i] = is_explicit ? v + (1 - s.scheme.gamma) * s.state.dt * a
                                   : (1 - f) * now.v + f * v;
    if (out.elastic != NULL)
      out.elastic[i] = (1 - f) * now.u + f * s.state.displacement[i];
  }
  return ABUT_SUCCESS;
}

abut_status
abut_time_end(const abut_time_state *state, const double *unknown)
{
  step s;
  const abut_status status = copy_in(state, &s);
  if (status != ABUT_SUCCESS)
    return status;
  if (s.state.n > 0 && unknown == NULL)
    return ABUT_INVALID_ARGUMENT;
  double probe = 0;
  for (int64_t i = 0; i < s.state.n; ++i)
  {
    const motion now = advance(&s, i, unknown[i]);
    probe += 0.0 * (now.u + now.v + now.a);
  }
  if (probe != 0)
    return ABUT_NOT_FINITE;
  for (int64_t i = 0; i < s.state.n; ++i)
  {
    motion now = advance(&s, i, unknown[i]);
    if (s.state.massless != NULL && s.state.massless[i])
    {
      now.v = (now.u - s.state.displacement[i]) / s.state.dt;
      now.a = 0;
    }
    s.state.displacement[i] = now.u;
    s.state.velocity[i] = now.v;
    s.state.acceleration[i] = now.a;
  }
  return ABUT_SUCCESS;
}

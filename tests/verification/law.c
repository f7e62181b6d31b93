/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Contact laws of other programs, pressure p of the gap g; -D LAW=... chooses:
 * LINEAR         p = k <-g>, parameter k;
 * SMOOTH_LINEAR  p = k d (1/2 + atan(d/e)/pi) with d = -g and e = pi s/k:
 * surfaces far apart pull with the tension s, parameters k and s; EXPONENTIAL
 * p = p0 exp(-ln(100) g/c0), a hundredth of p0 at the gap c0, parameters c0 and
 * p0. */
#include <abut/user_law.h>
#include <math.h>

#define LINEAR 1
#define SMOOTH_LINEAR 2
#define EXPONENTIAL 3

#if LAW == LINEAR
static const char *const names[] = {"stiffness", NULL};
#elif LAW == SMOOTH_LINEAR
static const char *const names[] = {"stiffness", "tension", NULL};
#else
static const char *const names[] = {"distance", "touch pressure", NULL};
#endif

/* The pressure at a gap, and its derivative. */
static double
pressure(const double *parameters, const double gap, double *slope)
{
#if LAW == LINEAR
  *slope = -parameters[0];
  return *slope * gap;
#elif LAW == SMOOTH_LINEAR
  const double pi = acos(-1.), k = parameters[0], e = pi * parameters[1] / k;
  const double x = -gap / e, share = 0.5 + atan(x) / pi;
  *slope = -k * (share + x / (pi * (1 + x * x)));
  return k * e * x * share;
#else
  const double rate = log(100.) / parameters[0];
  const double p = parameters[1] * exp(-rate * gap);
  *slope = -rate * p;
  return p;
#endif
}

static const char *
check(const double *parameters)
{
  for (int i = 0; names[i] != NULL; ++i)
    if (!(parameters[i] > 0))
      return "parameters must be above 0";
  return NULL;
}

static abut_status
classify(const abut_law_points *at, uint8_t *state)
{
  for (int32_t i = 0; i < at->n; ++i)
    state[i] =
        LAW != LINEAR || at->gap[i] < 0 ? ABUT_STATE_CLOSED : ABUT_STATE_OPEN;
  return ABUT_SUCCESS;
}

static abut_status
linearise(const abut_law_points *at, const uint8_t *state,
          abut_law_linearisation *result)
{
  const double *parameters = at->parameters;
  for (int32_t i = 0; i < at->n; ++i)
  {
    double p = 0, slope = 0;
    if (state[i] != ABUT_STATE_OPEN)
      p = pressure(parameters, at->gap[i], &slope);
    result->residual[i] = at->pressure[i] - p;
    result->d_pressure[i] = 1;
    result->d_gap[i] = -slope;
  }
  return ABUT_SUCCESS;
}

static const abut_law law = {.struct_size = sizeof(abut_law),
                             .name = "verification",
                             .classify = classify,
                             .linearise = linearise};

ABUT_USER_LAW(law, names, check)

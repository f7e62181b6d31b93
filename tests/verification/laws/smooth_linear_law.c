/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Pressure in proportion to the penetration d = -g, smoothed where surfaces
 * touch: p = k d (1/2 + atan(d/e)/pi), e = pi s/k. Far apart they pull with the
 * tension s. */
#include <abut/user_law.h>
#include <math.h>

static const char *const names[] = {"stiffness", "tension", NULL};

static const char *
check(const double *parameters)
{
  return parameters[0] > 0 && parameters[1] > 0
             ? NULL
             : "stiffness and tension must be above 0";
}

static abut_status
classify(const abut_law_points *at, uint8_t *state)
{
  for (int32_t i = 0; i < at->n; ++i)
    state[i] = ABUT_STATE_CLOSED;
  return ABUT_SUCCESS;
}

static abut_status
linearise(const abut_law_points *at, const uint8_t *state,
          abut_law_linearisation *result)
{
  (void)state;
  const double *parameters = at->parameters;
  const double pi = acos(-1.), k = parameters[0], e = pi * parameters[1] / k;
  for (int32_t i = 0; i < at->n; ++i)
  {
    const double x = -at->gap[i] / e;
    const double share = 0.5 + atan(x) / pi;
    result->residual[i] = at->pressure[i] - k * e * x * share;
    result->d_pressure[i] = 1;
    result->d_gap[i] = k * (share + x / (pi * (1 + x * x)));
  }
  return ABUT_SUCCESS;
}

static const abut_law smooth_linear_law = {.struct_size = sizeof(abut_law),
                                           .name = "smooth linear",
                                           .classify = classify,
                                           .linearise = linearise};

ABUT_USER_LAW(smooth_linear_law, names, check)

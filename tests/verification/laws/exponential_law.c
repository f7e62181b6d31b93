/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Pressure as an exponential of the gap, p(g) = p0 exp(-ln(100) g/c0): p0
 * where surfaces touch, a hundredth of it at the gap c0. */
#include <abut/user_law.h>
#include <math.h>

static const char *const names[] = {"distance", "touch pressure", NULL};

static const char *
check(const double *parameters)
{
  return parameters[0] > 0 && parameters[1] > 0
             ? NULL
             : "distance and touch pressure must be above 0";
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
  const double slope = log(100.) / parameters[0];
  for (int32_t i = 0; i < at->n; ++i)
  {
    const double p = parameters[1] * exp(-slope * at->gap[i]);
    result->residual[i] = at->pressure[i] - p;
    result->d_pressure[i] = 1;
    result->d_gap[i] = slope * p;
  }
  return ABUT_SUCCESS;
}

static const abut_law exponential_law = {.struct_size = sizeof(abut_law),
                                         .name = "exponential",
                                         .classify = classify,
                                         .linearise = linearise};

ABUT_USER_LAW(exponential_law, names, check)

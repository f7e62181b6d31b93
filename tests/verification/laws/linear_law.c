/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Pressure in proportion to the penetration, p = k <-g>. */
#include <abut/user_law.h>

static const char *const names[] = {"stiffness", NULL};

static const char *
check(const double *parameters)
{
  return parameters[0] > 0 ? NULL : "stiffness must be above 0";
}

static abut_status
classify(const abut_law_points *at, uint8_t *state)
{
  for (int32_t i = 0; i < at->n; ++i)
    state[i] = at->gap[i] < 0 ? ABUT_STATE_CLOSED : ABUT_STATE_OPEN;
  return ABUT_SUCCESS;
}

static abut_status
linearise(const abut_law_points *at, const uint8_t *state,
          abut_law_linearisation *result)
{
  const double *parameters = at->parameters;
  const double k = parameters[0];
  for (int32_t i = 0; i < at->n; ++i)
  {
    const bool closed = state[i] != ABUT_STATE_OPEN;
    result->residual[i] = at->pressure[i] + (closed ? k * at->gap[i] : 0);
    result->d_pressure[i] = 1;
    result->d_gap[i] = closed ? k : 0;
  }
  return ABUT_SUCCESS;
}

static const abut_law linear_law = {.struct_size = sizeof(abut_law),
                                    .name = "linear",
                                    .classify = classify,
                                    .linearise = linearise};

ABUT_USER_LAW(linear_law, names, check)

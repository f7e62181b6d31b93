/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* A soft contact: pressure begins where surfaces are still apart by the
 * clearance c and grows exponentially,
 *     p(g) = p0 / (e - 1) s (exp(s) - 1),  s = 1 - g / c  for g < c, else 0,
 * so that it is p0 where they touch. Compile it with
 *     cc -shared -fPIC $(pkg-config --cflags abut_core) soft_law.c -o
 * soft_law.so
 */
#include <abut/user_law.h>
#include <math.h>

static const char *const names[] = {"touch pressure", "clearance", NULL};

static const char *
check(const double *parameters)
{
  return parameters[0] > 0 && parameters[1] > 0
             ? NULL
             : "touch pressure and clearance must be above 0";
}

static abut_status
classify(const abut_law_points *at, uint8_t *state)
{
  const double *parameters = at->parameters;
  for (int32_t i = 0; i < at->n; ++i)
    state[i] = at->gap[i] < parameters[1] ? ABUT_STATE_CLOSED : ABUT_STATE_OPEN;
  return ABUT_SUCCESS;
}

/* Newton's method: residual + d_pressure dp + d_gap dg = 0. */
static abut_status
linearise(const abut_law_points *at, const uint8_t *state,
          abut_law_linearisation *result)
{
  const double *parameters = at->parameters;
  const double p0 = parameters[0] / expm1(1), c = parameters[1];
  for (int32_t i = 0; i < at->n; ++i)
  {
    const double s =
        state[i] == ABUT_STATE_OPEN ? 0 : fmax(0, 1 - at->gap[i] / c);
    result->residual[i] = at->pressure[i] - p0 * s * expm1(s);
    result->d_pressure[i] = 1;
    result->d_gap[i] = p0 / c * (expm1(s) + s * exp(s));
  }
  return ABUT_SUCCESS;
}

static const abut_law soft_law = {.struct_size = sizeof(abut_law),
                                  .name = "soft",
                                  .classify = classify,
                                  .linearise = linearise};

ABUT_USER_LAW(soft_law, names, check)

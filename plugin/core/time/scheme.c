/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The table of time schemes, and what matrices are multiplied by. */
#include "time/scheme.h"
#include "base/sized.h"

#include <math.h>
#include <string.h>

/* Sources of numbers that an option gives. */
typedef enum family
{
  FIXED,
  HHT,
  NEWMARK,
  GENERALISED
} family;

typedef struct entry
{
  abut_time_scheme scheme;
  family family;
} entry;

#define SIZE sizeof(abut_time_scheme)

/* Gains are the bounds of doc/dynamics.md. */
static const entry table[] = {
    {{SIZE, "hht", 0, 0, 0, 0, 1e-3, 0, 1, 0, ABUT_TIME_MASS_MODIFIED, 0}, HHT},
    {{SIZE, "trapezoid", 0, 0, 0.25, 0.5, 2e-3, 0, 1, 0,
      ABUT_TIME_MASS_MODIFIED, 0},
     FIXED},
    {{SIZE, "midpoint", 0, 0.5, 0.5, 1, 2e-3, 0, 1, 0, ABUT_TIME_MASS_MODIFIED,
      0},
     FIXED},
    {{SIZE, "newmark", 0, 0, 0, 0, 2e-3, 0, 1, 0, ABUT_TIME_MASS_MODIFIED, 0},
     NEWMARK},
    {{SIZE, "generalised alpha", 0, 0, 0, 0, 1e-3, 0, 1, 0,
      ABUT_TIME_MASS_MODIFIED, 0},
     GENERALISED},
    {{SIZE, "contact stabilised", 0, 0.5, 0.5, 1, 1e-6, 1, 1, 0,
      ABUT_TIME_MASS_CONSISTENT, 0},
     FIXED},
    {{SIZE, "central difference", 0, 0, 0, 0.5, 1e-2, 0, 1, 0,
      ABUT_TIME_MASS_LUMPED, 0},
     FIXED},
    {{SIZE, "central difference with projection", 0, 0, 0, 0.5, 1e-2, 1, 0, 0,
      ABUT_TIME_MASS_LUMPED, 0},
     FIXED},
    {{SIZE, "velocity level", 0, 0.5, 0.5, 1, 1e-6, 0, 0, 1,
      ABUT_TIME_MASS_LUMPED, 0},
     FIXED},
    {{SIZE, "energy momentum", 0, 0.5, 0.5, 1, 1e-10, 0, 1, 0,
      ABUT_TIME_MASS_CONSISTENT, 1},
     FIXED},
};

static const int32_t n_schemes = (int32_t)(sizeof(table) / sizeof(table[0]));

const char *
abut_time_scheme_name(int32_t index)
{
  return index >= 0 && index < n_schemes ? table[index].scheme.name : NULL;
}

/* Hilber, Hughes and Taylor: second order, damps what is fast. */
static abut_status
make_hht(double alpha, abut_time_scheme *scheme)
{
  if (!(alpha >= -1. / 3 && alpha <= 0))
    return ABUT_INVALID_ARGUMENT;
  scheme->alpha_f = -alpha;
  scheme->beta = (1 - alpha) * (1 - alpha) / 4;
  scheme->gamma = 0.5 - alpha;
  return ABUT_SUCCESS;
}

static abut_status
make_newmark(double beta, double gamma, abut_time_scheme *scheme)
{
  if (!(beta > 0 && beta <= 1 && gamma >= 0.5 && gamma <= 1))
    return ABUT_INVALID_ARGUMENT;
  scheme->beta = beta;
  scheme->gamma = gamma;
  return ABUT_SUCCESS;
}

/* Chung and Hulbert, equations (17) to (25). */
static abut_status
make_generalised(double rho, abut_time_scheme *scheme)
{
  if (!(rho >= 0 && rho <= 1))
    return ABUT_INVALID_ARGUMENT;
  scheme->alpha_m = (2 * rho - 1) / (rho + 1);
  scheme->alpha_f = rho / (rho + 1);
  const double shift = 1 - scheme->alpha_m + scheme->alpha_f;
  scheme->beta = shift * shift / 4;
  scheme->gamma = shift - 0.5;
  return ABUT_SUCCESS;
}

static abut_status
make(const entry *from, const abut_time_options *options,
     abut_time_scheme *scheme)
{
  *scheme = from->scheme;
  switch (from->family)
  {
  case HHT:
    return make_hht(options->alpha, scheme);
  case NEWMARK:
    return make_newmark(options->beta, options->gamma, scheme);
  case GENERALISED:
    return make_generalised(options->rho_infinity, scheme);
  case FIXED:
    break;
  }
  return ABUT_SUCCESS;
}

abut_status
abut_time_scheme_make_sized(const abut_time_options *options,
                            abut_time_scheme *scheme)
{
  abut_time_options taken = abut_time_defaults();
  if (scheme == NULL
      || (options != NULL
          && abut_sized_read(&taken, sizeof(taken), options) != NULL)
      || taken.name == NULL)
    return ABUT_INVALID_ARGUMENT;
  for (int32_t i = 0; i < n_schemes; ++i)
  {
    if (strcmp(table[i].scheme.name, taken.name) != 0)
      continue;
    abut_time_scheme made;
    const abut_status status = make(&table[i], &taken, &made);
    if (status != ABUT_SUCCESS)
      return status;
    return abut_sized_write(scheme, sizeof(made), &made) == NULL
               ? ABUT_SUCCESS
               : ABUT_INVALID_ARGUMENT;
  }
  return ABUT_UNSUPPORTED;
}

abut_status
abut_time_scheme_copy_in(const abut_time_scheme *given,
                         abut_time_scheme *scheme)
{
  *scheme = table[0].scheme;
  if (given == NULL || abut_sized_read(scheme, sizeof(*scheme), given) != NULL)
    return ABUT_INVALID_ARGUMENT;
  const bool legal = scheme->alpha_m < 1 && scheme->alpha_f >= 0
                     && scheme->alpha_f < 1 && scheme->beta >= 0
                     && scheme->beta <= 1 && scheme->gamma >= 0.5
                     && scheme->gamma <= 1.5 && scheme->growth >= 0;
  return legal ? ABUT_SUCCESS : ABUT_INVALID_ARGUMENT;
}

/* The step's weights for the unknown displacement or acceleration. */
static abut_time_weights
weigh_step(const abut_time_scheme *scheme, double dt)
{
  abut_time_weights w = {.struct_size = sizeof(w),
                         .mass = 1 - scheme->alpha_m,
                         .load = 1 - scheme->alpha_f,
                         .load_before = scheme->alpha_f};
  if (scheme->beta > 0)
  {
    w.mass /= scheme->beta * dt * dt;
    w.damping = (1 - scheme->alpha_f) * scheme->gamma / (scheme->beta * dt);
    w.stiffness = 1 - scheme->alpha_f;
  }
  return w;
}

abut_status
abut_time_weigh_sized(const abut_time_scheme *given, double dt,
                      abut_time_stage stage, abut_time_weights *weights)
{
  abut_time_scheme scheme;
  const abut_status status = abut_time_scheme_copy_in(given, &scheme);
  if (status != ABUT_SUCCESS)
    return status;
  if (!(dt > 0) || !isfinite(dt) || weights == NULL
      || (stage != ABUT_TIME_PROJECTION && stage != ABUT_TIME_STEP))
    return ABUT_INVALID_ARGUMENT;
  if (stage == ABUT_TIME_PROJECTION && !scheme.projects)
    return ABUT_UNSUPPORTED;
  abut_time_weights made = {.struct_size = sizeof(made), .mass = 1 / (dt * dt)};
  if (stage == ABUT_TIME_STEP)
    made = weigh_step(&scheme, dt);
  return abut_sized_write(weights, sizeof(made), &made) == NULL
             ? ABUT_SUCCESS
             : ABUT_INVALID_ARGUMENT;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Options of a strategy: legal ranges, and the first penalty. */
#include "strategy/options.h"
#include "strategy/outer_table.h"

#include <abut/limits.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

/* A number of the options, its legal range and its place. */
typedef struct entry
{
  abut_limit limit;
  size_t offset;
  bool is_count; /* an int32_t, not a double */
} entry;

#define POSITIVE(field)                                                        \
  {                                                                            \
    {#field, ABUT_SMALLEST_NUMBER, ABUT_LARGEST_NUMBER, false, false},         \
        offsetof(abut_strategy_options, field), false                          \
  }
#define NUMBER(field, low, high, low_open, high_open)                          \
  {                                                                            \
    {#field, low, high, low_open, high_open},                                  \
        offsetof(abut_strategy_options, field), false                          \
  }
#define COUNT(field)                                                           \
  {                                                                            \
    {#field, 1, INT32_MAX, false, false},                                      \
        offsetof(abut_strategy_options, field), true                           \
  }

/* A factor of 1 would neither raise a penalty nor lower a barrier, and a
 * relative tolerance of 1 is met by the solution 0. */
static const entry entries[] = {
    POSITIVE(length_scale),
    POSITIVE(pressure_scale),
    NUMBER(penalty, 0, ABUT_LARGEST_NUMBER, false, false),
    NUMBER(penalty_growth, 1, ABUT_LARGEST_NUMBER, true, false),
    POSITIVE(penalty_cap),
    NUMBER(allowed_penetration, 0, ABUT_LARGEST_NUMBER, false, false),
    POSITIVE(complementarity),
    POSITIVE(barrier_start),
    NUMBER(barrier_factor, ABUT_SMALLEST_NUMBER, 1, false, true),
    POSITIVE(barrier_end),
    POSITIVE(gap_tolerance),
    POSITIVE(pressure_tolerance),
    NUMBER(linear_tolerance, ABUT_SMALLEST_NUMBER, 1, false, true),
    NUMBER(final_linear_tolerance, ABUT_SMALLEST_NUMBER, 1, false, true),
    NUMBER(traction_tolerance, ABUT_SMALLEST_NUMBER, 1, false, true),
    COUNT(max_steps),
    COUNT(max_outer),
};

static double
value_of(const entry *e, const abut_strategy_options *options)
{
  const char *place = (const char *)options + e->offset;
  double value;
  int32_t count;
  if (e->is_count)
  {
    memcpy(&count, place, sizeof(count));
    return count;
  }
  memcpy(&value, place, sizeof(value));
  return value;
}

const abut_limit *
abut_strategy_limit(const char *name)
{
  for (size_t i = 0; name != NULL && i < sizeof(entries) / sizeof(entries[0]);
       ++i)
    if (strcmp(entries[i].limit.name, name) == 0)
      return &entries[i].limit;
  return NULL;
}

static abut_status
fail_range(abut_context *context, const abut_limit *limit, double value,
           const char *call)
{
  abut_text text = abut_fail_begin(context, call);
  abut_text_add(&text, limit->name);
  abut_text_add(&text, " = ");
  abut_text_add_number(&text, value);
  abut_text_add(&text, " is not between ");
  abut_text_add_number(&text, limit->low);
  abut_text_add(&text, " and ");
  abut_text_add_number(&text, limit->high);
  if (limit->low_open || limit->high_open)
    abut_text_add(&text, limit->low_open ? ", the first excluded"
                                         : ", the second excluded");
  return isfinite(value) ? ABUT_INVALID_ARGUMENT : ABUT_NOT_FINITE;
}

static abut_status
check_law(abut_context *context, const abut_law *law, const char *call)
{
  if (law == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "law is NULL");
  if (law->struct_size != sizeof(abut_law) || law->name == NULL
      || law->classify == NULL || law->linearise == NULL
      || abut_outer_get(law->outer) == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "the law's table is incomplete or of another version");
  return ABUT_SUCCESS;
}

abut_status
abut_strategy_check_options(abut_context *context,
                            const abut_strategy_options *options,
                            const char *call)
{
  for (size_t i = 0; i < sizeof(entries) / sizeof(entries[0]); ++i)
  {
    const double value = value_of(&entries[i], options);
    if (!abut_limit_contains(&entries[i].limit, value))
      return fail_range(context, &entries[i].limit, value, call);
  }
  if (options->friction_iteration < ABUT_FRICTION_PRIMAL_DUAL
      || options->friction_iteration > ABUT_FRICTION_TRESCA)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "there is no such friction_iteration");
  if (options->barrier_end > options->barrier_start)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "barrier_end is larger than barrier_start");
  return check_law(context, options->law, call);
}

double
abut_strategy_first_penalty(const abut_strategy_options *options)
{
  if (options == NULL || options->law == NULL)
    return 0;
  if (!abut_law_has_penalty(options->law))
    return 0;
  if (options->penalty > 0)
    return options->penalty;
  const abut_outer_entry *outer = abut_outer_get(options->law->outer);
  if (outer != NULL && outer->first_penalty > 0)
    return outer->first_penalty;
  return abut_law_needs_stress(options->law) ? 10 : 50;
}

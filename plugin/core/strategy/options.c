/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Options of a strategy: legal ranges, and the first penalty. */
#include "strategy/options.h"
#include "strategy/outer_table.h"

#include <math.h>

/* A number of the options and its legal range, ends included. */
typedef struct range
{
  const char *name;
  double value, low, high;
} range;

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
  const double tiny = 1e-300, huge = 1e300;
  const range ranges[] = {
      {"length_scale", options->length_scale, tiny, huge},
      {"pressure_scale", options->pressure_scale, tiny, huge},
      {"penalty", options->penalty, 0, huge},
      {"penalty_growth", options->penalty_growth, 1.01, huge},
      {"penalty_cap", options->penalty_cap, tiny, huge},
      {"allowed_penetration", options->allowed_penetration, 0, huge},
      {"complementarity", options->complementarity, tiny, huge},
      {"barrier_start", options->barrier_start, tiny, huge},
      {"barrier_factor", options->barrier_factor, tiny, 0.99},
      {"barrier_end", options->barrier_end, tiny, options->barrier_start},
      {"gap_tolerance", options->gap_tolerance, tiny, huge},
      {"pressure_tolerance", options->pressure_tolerance, tiny, huge},
      {"linear_tolerance", options->linear_tolerance, tiny, 0.99},
      {"final_linear_tolerance", options->final_linear_tolerance, tiny, 0.99},
      {"max_steps", options->max_steps, 1, INT32_MAX},
      {"max_outer", options->max_outer, 1, INT32_MAX},
  };
  for (size_t i = 0; i < sizeof(ranges) / sizeof(ranges[0]); ++i)
  {
    const range *r = &ranges[i];
    if (r->value >= r->low && r->value <= r->high)
      continue;
    abut_text text = abut_fail_begin(context, call);
    abut_text_add(&text, r->name);
    abut_text_add(&text, " = ");
    abut_text_add_number(&text, r->value);
    abut_text_add(&text, " is not between ");
    abut_text_add_number(&text, r->low);
    abut_text_add(&text, " and ");
    abut_text_add_number(&text, r->high);
    return isfinite(r->value) ? ABUT_INVALID_ARGUMENT : ABUT_NOT_FINITE;
  }
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

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Friction as the host gives it: checks, copies, memory; see friction.h. */
#include "strategy/friction.h"
#include "strategy/strategy.h"

#include <math.h>

static const char call[] = "abut_strategy_set_friction";

void
abut_friction_prepare(abut_friction_rows *f)
{
  f->given.element = f->numbers.element = sizeof(double);
  f->given_rows.element = sizeof(int32_t);
  f->given_bytes.element = f->bytes.element = sizeof(uint8_t);
}

void
abut_friction_release(abut_context *context, abut_friction_rows *f)
{
  abut_array *arrays[] = {&f->given, &f->given_rows, &f->given_bytes,
                          &f->numbers, &f->bytes};
  for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); ++i)
    abut_array_release(context, arrays[i]);
}

abut_status
abut_friction_reject(abut_strategy *s, abut_status status, int32_t i,
                     const char *what)
{
  abut_text text = abut_fail_begin(s->context, call);
  abut_text_add(&text, "point ");
  abut_text_add_integer(&text, i);
  abut_text_add(&text, ": ");
  abut_text_add(&text, what);
  return status;
}

static abut_status
check_point(abut_strategy *s, const abut_strategy_friction *in, int32_t i,
            int32_t tangent, int32_t least_row)
{
  if (in->n_tangents[i] < 1 || in->n_tangents[i] > 2)
    return abut_friction_reject(s, ABUT_INVALID_ARGUMENT, i,
                                "it has not 1 or 2 tangents");
  if (in->first[i] < least_row)
    return abut_friction_reject(
        s, ABUT_INVALID_ARGUMENT, i,
        "its rows do not come after those of the point before");
  for (int32_t k = 0; in->tangent != NULL && k < in->n_tangents[i]; ++k)
    if (in->tangent[tangent + k] > ABUT_TANGENT_PRESCRIBED)
      return abut_friction_reject(s, ABUT_INVALID_ARGUMENT, i,
                                  "one of its tangents is not an abut_tangent");
  double probe = 0 * in->coefficient[i];
  for (int32_t k = 0; in->reference_traction != NULL && k < in->n_tangents[i];
       ++k)
    probe += 0 * in->reference_traction[tangent + k];
  if (!isfinite(probe))
    return abut_friction_reject(s, ABUT_NOT_FINITE, i,
                                "coefficient or traction is not finite");
  if (in->coefficient[i] < 0 || (in->cap != NULL && !(in->cap[i] >= 0)))
    return abut_friction_reject(s, ABUT_INVALID_ARGUMENT, i,
                                "coefficient or cap is negative");
  return ABUT_SUCCESS;
}

static abut_status
check_friction(abut_strategy *s, const abut_strategy_friction *in, int32_t *m,
               int32_t *blocks)
{
  if (in->n < 0
      || (in->n > 0
          && (in->first == NULL || in->n_tangents == NULL
              || in->coefficient == NULL)))
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, call,
                     "an array is NULL, or n is negative");
  if (in->law->struct_size != sizeof(abut_friction) || in->law->bound == NULL
      || in->law->name == NULL)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, call,
                     "the law's table is incomplete or of another version");
  if (abut_law_is_interior(s->options.law))
  {
    abut_text text = abut_fail_begin(s->context, call);
    abut_text_add(&text, "the law '");
    abut_text_add(&text, s->options.law->name);
    abut_text_add(&text, "' has no friction: use lagrange, penalty, quadratic "
                         "penalty, augmented lagrangian or nitsche");
    return ABUT_UNSUPPORTED;
  }
  if (in->n_rivals < 0
      || (in->n_rivals > 0
          && (in->rival_point == NULL || in->rival_row == NULL)))
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, call,
                     "an array of rivals is NULL, or n_rivals is negative");
  for (int32_t k = 0; k < in->n_rivals; ++k)
    if (in->rival_point[k] < 0 || in->rival_point[k] >= in->n
        || in->rival_row[k] < 0)
      return abut_fail(s->context, ABUT_INVALID_ARGUMENT, call,
                       "a rival belongs to no point or has no row");
  *m = *blocks = 0;
  int32_t row = 0;
  for (int32_t i = 0; i < in->n; ++i)
  {
    const abut_status status = check_point(s, in, i, *m, row);
    if (status != ABUT_SUCCESS)
      return status;
    const int32_t t = in->n_tangents[i];
    row = in->first[i] + 1 + t;
    *m += t;
    *blocks += t * t;
  }
  return ABUT_SUCCESS;
}

static abut_status
copy_friction(abut_strategy *s, const abut_strategy_friction *in, int32_t m)
{
  abut_friction_rows *f = &s->friction;
  const int32_t n = in->n;
  abut_status status =
      abut_array_reserve(s->context, &f->given, 0, 2 * (int64_t)n + m);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &f->given_rows, 0,
                                (int64_t)n + 2 * (int64_t)in->n_rivals);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &f->given_bytes, 0, (int64_t)n + m);
  if (status != ABUT_SUCCESS || n == 0)
    return status;
  f->coefficient = f->given.data;
  f->cap = f->coefficient + n;
  f->committed = f->cap + n;
  f->first = f->given_rows.data;
  f->n_tangents = f->given_bytes.data;
  f->tangent = f->n_tangents + n;
  f->rival_point = f->first + n;
  f->rival_row = f->rival_point + in->n_rivals;
  for (int32_t k = 0; k < in->n_rivals; ++k)
  {
    f->rival_point[k] = in->rival_point[k];
    f->rival_row[k] = in->rival_row[k];
  }
  for (int32_t i = 0; i < n; ++i)
  {
    f->coefficient[i] = in->coefficient[i];
    f->cap[i] = in->cap == NULL ? INFINITY : in->cap[i];
    f->first[i] = in->first[i];
    f->n_tangents[i] = in->n_tangents[i];
  }
  /* A body's own stress remembers by itself. */
  const bool remembers =
      in->reference_traction != NULL && !abut_law_needs_stress(s->options.law);
  for (int32_t k = 0; k < m; ++k)
  {
    f->committed[k] = remembers ? in->reference_traction[k] : 0;
    f->tangent[k] =
        in->tangent == NULL ? (uint8_t)ABUT_TANGENT_FREE : in->tangent[k];
  }
  return status;
}

abut_status
abut_strategy_set_friction(abut_strategy *strategy,
                           const abut_strategy_friction *friction)
{
  if (strategy == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_strategy *s = strategy;
  abut_friction_rows *f = &s->friction;
  s->phase = ABUT_PHASE_CREATED;
  f->law = NULL;
  f->n = f->m = f->blocks = f->n_rivals = 0;
  if (friction == NULL)
    return ABUT_SUCCESS;
  abut_strategy_friction taken = {.struct_size = sizeof(taken)};
  abut_status status =
      abut_copy_in(s->context, call, &taken, sizeof(taken), friction);
  if (status != ABUT_SUCCESS)
    return status;
  if (taken.law == NULL)
    taken.law = abut_friction_get(0);
  int32_t m = 0, blocks = 0;
  status = check_friction(s, &taken, &m, &blocks);
  if (status == ABUT_SUCCESS)
    status = copy_friction(s, &taken, m);
  if (status != ABUT_SUCCESS)
    return status;
  f->law = taken.law;
  f->parameters = taken.parameters;
  f->has_cap = taken.cap != NULL;
  f->n = taken.n;
  f->n_rivals = taken.n_rivals;
  f->m = m;
  f->blocks = blocks;
  return ABUT_SUCCESS;
}

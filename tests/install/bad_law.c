/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* A user's law with the fault FAULT, to see how it is refused. */
#include <abut/user_law.h>
#include <math.h>

#define WRONG_ABI 1
#define WRONG_SIZE 2
#define NO_QUERY 3
#define NULL_QUERY 4
#define INCOMPLETE 5
#define WRONG_OUTER 6
#define TAKEN_NAME 7
#define NAN_RESULT 8
#define FAILS 9
#define ZERO_SLOPE 10
#define MISSING_SYMBOL 11

#if FAULT == MISSING_SYMBOL
double function_of_nobody(double x);
#endif

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
  (void)state;
  for (int32_t i = 0; i < at->n; ++i)
  {
    result->residual[i] = at->pressure[i] + at->gap[i];
    result->d_pressure[i] = FAULT == ZERO_SLOPE ? 0 : 1;
    result->d_gap[i] = FAULT == NAN_RESULT ? sqrt(-1 - fabs(at->gap[i])) : 1;
#if FAULT == MISSING_SYMBOL
    result->residual[i] += function_of_nobody(at->gap[i]);
#endif
  }
  return FAULT == FAILS ? ABUT_UNSUPPORTED : ABUT_SUCCESS;
}

static const abut_law law = {
    .struct_size = sizeof(abut_law),
    .name = FAULT == TAKEN_NAME ? "penalty" : "bad",
    .outer = FAULT == WRONG_OUTER ? ABUT_OUTER_BARRIER : ABUT_OUTER_NONE,
    .classify = classify,
    .linearise = FAULT == INCOMPLETE ? NULL : linearise,
};

#if FAULT == NO_QUERY
ABUT_API const abut_law *not_the_query(void);
const abut_law *
not_the_query(void)
{
  return &law;
}
#elif FAULT == NULL_QUERY
ABUT_API const abut_law *law_of_nobody(void);
const abut_law *
law_of_nobody(void)
{
  return &law;
}

ABUT_API const abut_user_law *abut_user_law_query(void);
const abut_user_law *
abut_user_law_query(void)
{
  return NULL;
}
#else
ABUT_API const abut_user_law *abut_user_law_query(void);
const abut_user_law *
abut_user_law_query(void)
{
  static const abut_user_law user = {
      ABUT_USER_LAW_ABI + (FAULT == WRONG_ABI ? 41 : 0),
      sizeof(abut_user_law),
      sizeof(abut_law),
      sizeof(abut_law_points) + (FAULT == WRONG_SIZE ? 8 : 0),
      sizeof(abut_law_linearisation),
      &law,
      NULL,
      NULL};
  return &user;
}
#endif

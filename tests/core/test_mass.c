/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Mass handed from nodes that may come into contact to their neighbours. */
#include "bar.h"

#include <string.h>

enum
{
  SIDE = 5,
  NODES = SIDE * SIDE
};

/* The mass of a square of 4 x 4 bilinear elements on a distorted grid of
 * places; the row below is to be without mass. */
typedef struct square_mass
{
  double dense[NODES * NODES], place[2 * NODES], value[NODES * NODES];
  int64_t start[NODES + 1];
  int32_t column[NODES * NODES];
  uint8_t candidate[NODES];
  abut_mass_matrix matrix;
} square_mass;

static void
square_open(square_mass *s, bool by_element)
{
  memset(s, 0, sizeof(*s));
  for (int32_t i = 0; i < NODES; ++i)
  {
    s->place[2 * i] = i % SIDE + 0.1 * (i / SIDE);
    s->place[2 * i + 1] = i / SIDE;
    s->candidate[i] = i < SIDE;
  }
  static const double line[2][2] = {{2. / 6, 1. / 6}, {1. / 6, 2. / 6}};
  for (int32_t e = 0; e < (SIDE - 1) * (SIDE - 1); ++e)
  {
    double element[16];
    uint8_t candidate[4];
    int32_t node[4];
    for (int32_t i = 0; i < 4; ++i)
    {
      node[i] = (e / (SIDE - 1) + i / 2) * SIDE + e % (SIDE - 1) + i % 2;
      candidate[i] = s->candidate[node[i]];
      for (int32_t j = 0; j < 4; ++j)
        element[i * 4 + j] = line[i % 2][j % 2] * line[i / 2][j / 2];
    }
    if (by_element)
      assert_ok(abut_mass_modify_element(4, candidate, element));
    for (int32_t i = 0; i < 16; ++i)
      s->dense[node[i / 4] * NODES + node[i % 4]] += element[i];
  }
  int64_t at = 0;
  for (int32_t i = 0; i < NODES * NODES; ++i)
  {
    if (s->dense[i] != 0 || i / NODES == i % NODES)
    {
      s->column[at] = i % NODES;
      s->value[at++] = s->dense[i];
    }
    s->start[i / NODES + 1] = at;
  }
  s->matrix = (abut_mass_matrix){sizeof(s->matrix), NODES,    2,       s->start,
                                 s->column,         s->value, s->place};
}

/* Mass, and its moments. */
static void
square_moments(const square_mass *s, double *moments)
{
  moments[0] = moments[1] = moments[2] = 0;
  for (int32_t i = 0; i < NODES; ++i)
    for (int64_t e = s->start[i]; e < s->start[i + 1]; ++e)
    {
      moments[0] += s->value[e];
      moments[1] += s->value[e] * s->place[2 * i];
      moments[2] += s->value[e] * s->place[2 * i + 1];
    }
}

static void
mass_is_handed_on_and_kept(void **unused)
{
  (void)unused;
  static square_mass s;
  abut_context *context = fixture_context();
  for (int by_element = 0; by_element < 2; ++by_element)
  {
    double before[3], after[3];
    square_open(&s, false);
    square_moments(&s, before);
    if (by_element)
      square_open(&s, true);
    else
      assert_ok(abut_mass_modify(context, &s.matrix, s.candidate,
                                 ABUT_MASS_NEIGHBOURS));
    square_moments(&s, after);
    assert_close(after[0], before[0], 1e-12);
    assert_true(after[2] > before[2] + 0.1);
    for (int32_t i = 0; i < NODES; ++i)
      for (int64_t e = s.start[i]; e < s.start[i + 1]; ++e)
        if (s.candidate[i] || s.candidate[s.column[e]])
          assert_true(s.value[e] == 0);
        else if (i == s.column[e])
          assert_true(s.value[e] > 0);
  }
  assert_ok(abut_context_destroy(&context));
}

static double
bar_moment(const bar *b, bool of_place)
{
  double sum = 0;
  for (int32_t i = 0; i < b->n * b->n; ++i)
    sum += b->m[i] * (of_place ? i % b->n * b->h : 1);
  return sum;
}

static void
centre_of_mass_is_kept_where_it_can_be(void **unused)
{
  (void)unused;
  static bar b;
  bar_open(&b, 10, 3, 900, 2);
  const double mass = bar_moment(&b, false), moment = bar_moment(&b, true);
  bar_use(&b, "trapezoid", 1, ABUT_TIME_MASS_MODIFIED, ABUT_MASS_CENTRE);
  assert_close(bar_moment(&b, false), mass, 1e-12);
  assert_close(bar_moment(&b, true), moment, 1e-12);
  /* The second row of a square would have to give back more than it has. */
  static square_mass s;
  abut_context *context = fixture_context();
  square_open(&s, false);
  static double kept[NODES * NODES];
  memcpy(kept, s.value, sizeof(kept));
  assert_int_equal(
      abut_mass_modify(context, &s.matrix, s.candidate, ABUT_MASS_CENTRE),
      ABUT_UNSUPPORTED);
  assert_non_null(strstr(abut_context_message(context), "no positive mass"));
  assert_memory_equal(kept, s.value, sizeof(kept));
  assert_ok(abut_context_destroy(&context));
}

static void
mass_that_nobody_takes_is_refused(void **unused)
{
  (void)unused;
  static square_mass s;
  abut_context *context = fixture_context();
  square_open(&s, false);
  static double kept[NODES * NODES];
  memcpy(kept, s.value, sizeof(kept));
  memset(s.candidate, 1, 3 * SIDE);
  assert_int_equal(
      abut_mass_modify(context, &s.matrix, s.candidate, ABUT_MASS_NEIGHBOURS),
      ABUT_UNSUPPORTED);
  assert_non_null(strstr(abut_context_message(context), "node 0"));
  assert_memory_equal(kept, s.value, sizeof(kept));
  const uint8_t all[] = {1, 1};
  double element[] = {2, 1, 1, 2};
  assert_int_equal(abut_mass_modify_element(2, all, element), ABUT_UNSUPPORTED);
  assert_close(element[0], 2, 0);
  /* A lumped mass has no neighbours. */
  const int64_t start[] = {0, 1, 2};
  const int32_t column[] = {0, 1};
  double value[] = {1, 1};
  const uint8_t first[] = {1, 0};
  const abut_mass_matrix lumped = {sizeof(lumped), 2,     1,   start,
                                   column,         value, NULL};
  assert_int_equal(
      abut_mass_modify(context, &lumped, first, ABUT_MASS_NEIGHBOURS),
      ABUT_UNSUPPORTED);
  assert_int_equal(abut_mass_modify(context, &lumped, first, ABUT_MASS_CENTRE),
                   ABUT_INVALID_ARGUMENT);
  value[1] = NAN;
  assert_int_equal(
      abut_mass_modify(context, &lumped, first, ABUT_MASS_NEIGHBOURS),
      ABUT_NOT_FINITE);
  assert_ok(abut_context_destroy(&context));
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mass_is_handed_on_and_kept),
      cmocka_unit_test(centre_of_mass_is_kept_where_it_can_be),
      cmocka_unit_test(mass_that_nobody_takes_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

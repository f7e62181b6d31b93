/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Time schemes on a bar that meets a wall: discrete values of each scheme, from
 * two programs that share no code with this one or with each other. */
#include "bar.h"

#include <string.h>

/* What a run of the bar comes to. */
typedef struct impact
{
  double energy_at_1, energy_at_2; /* by that of the start */
  double impulse, pressure_at_8, deviation, end, centre_velocity;
  int release;
} impact;

static double
energy(const bar *b)
{
  return bar_kinetic(b) + bar_strain(b) + bar_contact(b);
}

/* 50 elements, E = 900, falls with 10 from height 5; two seconds. */
static impact
fall(const char *scheme, abut_time_mass mass, abut_mass_rule rule, int steps)
{
  static bar b;
  bar_open(&b, 50, 10, 900, 1);
  b.wall = -5;
  b.penalty = strcmp(scheme, "central difference") == 0 ? 900 / b.h : 0;
  for (int32_t i = 0; i < b.n; ++i)
    b.v[i] = -10;
  bar_use(&b, scheme, 2. / steps, mass, rule);
  impact result = {.release = 0};
  for (int step = 1; step <= steps; ++step)
  {
    bar_step(&b);
    if (b.lambda > 1e-7)
      result.release = step + 1;
    /* .6 and 1.1 s, ends included, .8 s and 1 s. */
    if (10 * step >= 3 * steps && 20 * step <= 11 * steps)
      result.deviation = fmax(result.deviation, fabs(b.lambda - 300) / 300);
    if (10 * step == 4 * steps)
      result.pressure_at_8 = b.lambda;
    if (2 * step == steps)
      result.energy_at_1 = energy(&b) / 500;
  }
  double momentum = 0, columns[BAR_MAX] = {0};
  for (int32_t i = 0; i < b.n * b.n; ++i)
    columns[i % b.n] += b.m[i];
  for (int32_t i = 0; i < b.n; ++i)
    momentum += columns[i] * b.v[i];
  result.centre_velocity = momentum / 10;
  result.energy_at_2 = energy(&b) / 500;
  result.impulse = b.impulse;
  result.end = b.u[0];
  return result;
}

typedef struct reference
{
  const char *scheme;
  abut_time_mass mass;
  abut_mass_rule rule;
  int steps;
  impact expected;
} reference;

static void
bar_on_a_wall_is_that_of_the_table(void **unused)
{
  (void)unused;
  const abut_time_mass consistent = ABUT_TIME_MASS_CONSISTENT,
                       modified = ABUT_TIME_MASS_MODIFIED,
                       lumped = ABUT_TIME_MASS_LUMPED;
  const abut_mass_rule near = ABUT_MASS_NEIGHBOURS, centre = ABUT_MASS_CENTRE;
  const reference table[] = {
      {"trapezoid",
       consistent,
       near,
       300,
       {5.3098827222, 7.9827940090, 204.50703656, 996.33700885, 2.3925565283,
        3.9208026553, 0, 175}},
      {"hht",
       consistent,
       near,
       300,
       {0.9810026717, 0.9731965666, 197.53624841, 299.70268266, 0.0459213742,
        3.0783635036, 0, 177}},
      {"contact stabilised",
       consistent,
       near,
       300,
       {0.9942264973, 0.9942264973, 197.93880431, 300.12229925, 0.0076743210,
        3.1403246253, 0, 177}},
      {"trapezoid",
       modified,
       centre,
       300,
       {1.0000000000, 1.0003200564, 198.19785938, 299.88928212, 0.0782723343,
        3.1519727633, 0, 177}},
      {"trapezoid",
       modified,
       near,
       300,
       {1.0000000000, 1.0006903566, 198.53115070, 299.99498209, 0.0010080038,
        3.1954999794, 0, 177}},
      {"hht",
       modified,
       near,
       300,
       {0.9919532266, 0.9848786743, 198.16337922, 300.00005005, 0.0018308390,
        3.1415747479, 0, 177}},
      {"central difference",
       lumped,
       near,
       600,
       {1.0009599619, 1.0007142046, 199.21351255, 259.24525883, 0.1625208899,
        3.1260197736, 0, 355}},
  };
  for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); ++i)
  {
    const reference *r = &table[i];
    const impact got = fall(r->scheme, r->mass, r->rule, r->steps);
    assert_close(got.energy_at_1, r->expected.energy_at_1, 1e-8);
    assert_close(got.energy_at_2, r->expected.energy_at_2, 1e-8);
    assert_close(got.impulse, r->expected.impulse, 1e-8);
    assert_close(got.pressure_at_8, r->expected.pressure_at_8, 1e-8);
    assert_close(got.deviation, r->expected.deviation, 1e-8);
    assert_close(got.end, r->expected.end, 1e-8);
    assert_close(got.centre_velocity, got.impulse / 10 - 10, 1e-10);
    assert_int_equal(got.release, r->expected.release);
  }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bar_on_a_wall_is_that_of_the_table),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

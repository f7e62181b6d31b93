/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Amounts of gaps by hand, and where rows become linear functions of them. */
#include "fixture.h"

#include <abut/gap_raise.h>

/* One row. */
typedef struct row
{
  double clearance, gap, pressure, apart;
  uint8_t presses;
  abut_gap_raise raise;
} row;

static int32_t
renew(row *r, int32_t only_less)
{
  const abut_raised_rows rows = {
      sizeof(rows), 1,         &r->clearance, &r->gap,  &r->pressure,
      &r->presses,  &r->apart, 1e-6,          only_less};
  int32_t n_changed = -1;
  assert_ok(abut_gap_raise_renew(&rows, &r->raise, &n_changed));
  return n_changed;
}

/* The first amount is the clearance, from the row's own bound on. */
static void
test_first(void **state)
{
  (void)state;
  row r = {0.2, 0., 5., 0.1, 1, {0., 0., 0., 0.}};
  assert_int_equal(renew(&r, 1), 0);
  /* only less */
  assert_close(r.raise.value, 0., 0.);
  assert_int_equal(renew(&r, 0), 1);
  /* as much as it is apart */
  assert_close(r.raise.value, 0.2, 1e-15);
  /* clearance before */
  assert_close(r.raise.clearance, 0.2, 0.);
  /* pressure before */
  assert_close(r.raise.pressure, 5., 0.);
  row near_by = {0.05, 0., 5., 0.1, 1, {0., 0., 0., 0.}};
  assert_int_equal(renew(&near_by, 0), 0);
  near_by.raise.value = 0.01; /* raised rows have the least bound */
  assert_int_equal(renew(&near_by, 0), 1);
  /* raised before */
  assert_close(near_by.raise.value, 0.06, 1e-15);
  row open = {0.2, 0.1, 0., 0.1, 0, {0., 0., 0., 0.}};
  assert_int_equal(renew(&open, 0), 0);
  row unknown = {INFINITY, 0., 5., 0.1, 1, {0.3, 0., 0., 0.}};
  assert_int_equal(renew(&unknown, 0), 0);
}

/* Where pressure and clearance are linear in the amount, p = a - b c and
 * m = d - e c, the second amount is at the nearer zero. */
static void
test_secant(void **state)
{
  (void)state;
  const double a = 4., b = 2.5, d = 0.3, e = 0.25, first = 0.3;
  /* p = 0 at 1.6, m = 0 at 1.2: by the clearance. */
  row r = {d - e * first, 0., a - b * first, 0.1, 1, {first, 0., d, a}};
  assert_int_equal(renew(&r, 0), 1);
  /* zero of the clearance */
  assert_close(r.raise.value, d / e, 1e-14);
  /* value before */
  assert_close(r.raise.before, first, 0.);
  /* p = 0 at .8: by the pressure, and a little more than the way there. */
  const double steep = 5.;
  row s = {d - e * first, 0., a - steep * first, 0.1, 1, {first, 0., d, a}};
  assert_int_equal(renew(&s, 0), 1);
  /* zero of the pressure */
  assert_close(s.raise.value, first + 1.05 * (a / steep - first), 1e-14);
  /* A clearance that hardly falls: no more than 30 times. */
  row t = {d, 0., a, 0.1, 1, {1e-3, 0., d + 1e-9, a + 1e-9}};
  assert_int_equal(renew(&t, 0), 1);
  /* bounded */
  assert_close(t.raise.value, 1e-3 + 30. * d, 1e-12);
}

/* Inside: where the clearance is 0 between the last two values, or where the
 * gap without the amount is as much less as the surfaces are inside. */
static void
test_inside(void **state)
{
  (void)state;
  row r = {-0.1, 0., 3., 0.1, 1, {0.4, 0.2, 0.1, 5.}};
  assert_int_equal(renew(&r, 1), 1);
  /* half way */
  assert_close(r.raise.value, 0.3, 1e-15);
  row open = {-0.1, 0.05, 0., 0.1, 0, {0.4, 0.2, 0.1, 5.}};
  assert_int_equal(renew(&open, 0), 1);
  /* by the gap: -.1 - (.05 - .4) */
  assert_close(open.raise.value, 0.25, 1e-15);
  row deep = {-0.6, 0.05, 0., 0.1, 0, {0.4, 0.2, 0.1, 5.}};
  assert_int_equal(renew(&deep, 0), 1);
  /* never negative */
  assert_close(deep.raise.value, 0., 0.);
  row plain = {-0.1, 0., 3., 0.1, 1, {0., 0., 0., 0.}};
  assert_int_equal(renew(&plain, 0), 0);
  row small = {-0.1, -0.1 + 1e-8, 0., 0.1, 0, {1e-8, 0., 0., 0.}};
  assert_int_equal(renew(&small, 0), 0);
}

static void
test_arguments(void **state)
{
  (void)state;
  int32_t n = 0;
  abut_raised_rows rows = {0};
  rows.struct_size = sizeof(rows);
  assert_ok(abut_gap_raise_renew(&rows, NULL, &n));
  assert_int_equal(abut_gap_raise_renew(NULL, NULL, &n), ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_gap_raise_renew(&rows, NULL, NULL),
                   ABUT_INVALID_ARGUMENT);
  rows.n_rows = 1;
  assert_int_equal(abut_gap_raise_renew(&rows, NULL, &n),
                   ABUT_INVALID_ARGUMENT);
  rows.n_rows = -1;
  assert_int_equal(abut_gap_raise_renew(&rows, NULL, &n),
                   ABUT_INVALID_ARGUMENT);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_first), cmocka_unit_test(test_secant),
      cmocka_unit_test(test_inside), cmocka_unit_test(test_arguments)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

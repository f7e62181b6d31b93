/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The public face of clipping: checks of its arguments; what it computes is
 * tested with clipping itself. */
#include <abut/facet.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const double quad[12] = {0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.};
/* Shifted by (1/4, 1/2) and one up, seen from above walked the other way. */
static const double other[12] = {0.25, 0.5, 1., 0.25, 1.5, 1.,
                                 1.25, 0.5, 1., 1.25, 1.5, 1.};
static const double line[4] = {0., 0., 1., 0.};

static void
test_area(void **state)
{
  (void)state;
  double area = -1.;
  assert_int_equal(abut_facet_covered_area(ABUT_FACET_QUAD4, quad,
                                           ABUT_FACET_QUAD4, other, &area),
                   ABUT_SUCCESS);
  assert_true(fabs(area - 0.75 * 0.5) < 1e-15);
  const double half[4] = {2., 0.1, 0.75, 0.1};
  assert_int_equal(abut_facet_covered_area(ABUT_FACET_LINE2, line,
                                           ABUT_FACET_LINE2, half, &area),
                   ABUT_SUCCESS);
  assert_true(fabs(area - 0.25) < 1e-15);
}

static void
test_refusals(void **state)
{
  (void)state;
  double area = -1.;
  const abut_facet_kind kind = ABUT_FACET_QUAD4;
  assert_int_equal(abut_facet_covered_area(kind, NULL, kind, other, &area),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_facet_covered_area(kind, quad, kind, NULL, &area),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_facet_covered_area(kind, quad, kind, other, NULL),
                   ABUT_INVALID_ARGUMENT);
  assert_int_equal(
      abut_facet_covered_area(kind, quad, ABUT_FACET_LINE2, line, &area),
      ABUT_INVALID_ARGUMENT);
  assert_int_equal(abut_facet_covered_area(ABUT_FACET_N_KINDS, quad,
                                           ABUT_FACET_N_KINDS, other, &area),
                   ABUT_INVALID_ARGUMENT);
  const double wrong[2] = {(double)NAN, (double)INFINITY};
  for (int i = 0; i < 2; ++i)
  {
    double bad[12];
    for (int k = 0; k < 12; ++k)
      bad[k] = k == 11 ? wrong[i] : quad[k];
    assert_int_equal(abut_facet_covered_area(kind, bad, kind, other, &area),
                     ABUT_NOT_FINITE);
    assert_int_equal(abut_facet_covered_area(kind, quad, kind, bad, &area),
                     ABUT_NOT_FINITE);
  }
  assert_true(area == -1.);
}

int
main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_area),
                                     cmocka_unit_test(test_refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Rules of integration against the integrals of monomials. */
#include "fixture.h"
#include "geometry/quadrature.h"

static double
rule_integral(const abut_rule *rule, int i, int j)
{
  double sum = 0.;
  for (int q = 0; q < rule->n; ++q)
    sum +=
        rule->weight[q] * pow(rule->local[q][0], i) * pow(rule->local[q][1], j);
  return sum;
}

static double
factorial(int n)
{
  return n < 2 ? 1. : n * factorial(n - 1);
}

/* int x^i y^j over [-1, 1], [-1, 1]^2, or the unit triangle. */
static double
exact_integral(abut_facet_kind kind, int i, int j)
{
  const double x = i % 2 == 0 ? 2. / (i + 1) : 0.,
               y = j % 2 == 0 ? 2. / (j + 1) : 0.;
  if (abut_facet_dimension(kind) == 2)
    return x;
  return abut_facet_n_corners(kind) == 4
             ? x * y
             : factorial(i) * factorial(j) / factorial(i + j + 2);
}

/* Exact up to the degree asked for, with positive weights and points inside,
 * and with no more points than that takes. */
static void
test_degrees(void **state)
{
  (void)state;
  static const abut_facet_kind kinds[3] = {ABUT_FACET_LINE2, ABUT_FACET_QUAD4,
                                           ABUT_FACET_TRI6};
  static const int points_of_triangle[9] = {3, 3, 3, 6, 6, 12, 12, 16, 16};
  for (int k = 0; k < 3; ++k)
    for (int degree = 0; degree <= ABUT_RULE_MAX_DEGREE; ++degree)
    {
      abut_rule rule;
      abut_rule_facet(kinds[k], degree, &rule);
      const int n = degree / 2 + 1;
      assert_int_equal(rule.n, k == 0   ? n
                               : k == 1 ? n * n
                                        : points_of_triangle[degree]);
      for (int q = 0; q < rule.n; ++q)
        assert_true(rule.weight[q] > 0.
                    && rule.local[q][0] > (k == 2 ? 0. : -1.)
                    && rule.local[q][0] < 1.);
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; j <= (k == 0 ? 0 : k == 1 ? degree : degree - i); ++j)
          assert_close(rule_integral(&rule, i, j),
                       exact_integral(kinds[k], i, j), 2e-15);
      /* One degree beyond what the points can do. */
      const int beyond = k < 2 ? 2 * n : degree / 2 * 2 + 2;
      if (k < 2 || degree > 0)
      {
        double worst = 0.;
        for (int i = 0; i <= beyond + (k == 2); ++i)
          worst = fmax(
              worst,
              fabs(rule_integral(&rule, beyond + (k == 2) - i, k == 0 ? 0 : i)
                   - exact_integral(kinds[k], beyond + (k == 2) - i,
                                    k == 0 ? 0 : i)));
        assert_true(worst > 1e-8);
      }
    }
}

int
main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_degrees)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The formatter against the C library's %g. */
#include "base/text.h"
#include "fixture.h"

#include <stdlib.h>
#include <string.h>

static void
integers(void **unused)
{
  (void)unused;
  const int64_t values[] = {0, 7, -7, 1234567890123, INT64_MAX, INT64_MIN};
  for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); ++i)
  {
    char data[32], expected[32];
    abut_text text = abut_text_begin(data, sizeof(data));
    abut_text_add_integer(&text, values[i]);
    snprintf(expected, sizeof(expected), "%lld", (long long)values[i]);
    assert_string_equal(data, expected);
  }
}

/* Same six digits as %g, whatever the notation. */
static void
assert_same_number(double value)
{
  char data[32], expected[32];
  abut_text text = abut_text_begin(data, sizeof(data));
  abut_text_add_number(&text, value);
  snprintf(expected, sizeof(expected), "%g", value);
  const double read = strtod(data, NULL), wanted = strtod(expected, NULL);
  if (fabs(read - wanted) > 1.01e-5 * fabs(wanted))
    fail_msg("%s is not %s", data, expected);
}

static void
numbers(void **unused)
{
  (void)unused;
  uint64_t seed = 4;
  for (int i = 0; i < 10000; ++i)
  {
    const double exponent = 300 * (2 * fixture_random(&seed) - 1);
    const double sign = i % 2 == 0 ? 1 : -1;
    assert_same_number(sign * pow(10, exponent));
  }
  for (int i = -300; i <= 300; ++i)
  {
    assert_same_number(pow(10, i));
    assert_same_number(9.9999999 * pow(10, i));
  }
  assert_same_number(5e-324);
  assert_same_number(1.7976931348623157e308);
}

static void
notation(void **unused)
{
  (void)unused;
  const struct
  {
    double value;
    const char *text;
  } cases[] = {{0, "0"},           {1, "1"},
               {-0.5, "-0.5"},     {1e6, "1e6"},
               {250000, "250000"}, {0.001, "0.001"},
               {1e-8, "1e-8"},     {1.5e-7, "1.5e-7"},
               {NAN, "nan"},       {-INFINITY, "-inf"},
               {12.25, "12.25"},   {100.5, "100.5"},
               {0.0002, "0.0002"}, {999999.9, "1e6"}};
  for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i)
  {
    char data[32];
    abut_text text = abut_text_begin(data, sizeof(data));
    abut_text_add_number(&text, cases[i].value);
    assert_string_equal(data, cases[i].text);
  }
}

static void
what_does_not_fit_is_cut(void **unused)
{
  (void)unused;
  char data[8];
  abut_text text = abut_text_begin(data, sizeof(data));
  abut_text_add(&text, "abc");
  abut_text_add(&text, "defghijk");
  abut_text_add_integer(&text, 5);
  assert_string_equal(data, "abcdefg");
}

int
main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(integers),
      cmocka_unit_test(numbers),
      cmocka_unit_test(notation),
      cmocka_unit_test(what_does_not_fit_is_cut),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}

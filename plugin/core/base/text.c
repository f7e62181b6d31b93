/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "base/text.h"

#include <math.h>
#include <string.h>

abut_text
abut_text_begin(char *data, size_t capacity)
{
  abut_text text = {data, capacity, 0};
  data[0] = '\0';
  return text;
}

void
abut_text_add(abut_text *text, const char *string)
{
  const size_t room = text->capacity - 1 - text->length;
  size_t n = strlen(string);
  if (n > room)
    n = room;
  memcpy(text->data + text->length, string, n);
  text->length += n;
  text->data[text->length] = '\0';
}

void
abut_text_add_integer(abut_text *text, int64_t value)
{
  char digits[24];
  size_t first = sizeof(digits) - 1;
  /* The negative of INT64_MIN exists only as an unsigned number. */
  uint64_t rest = value < 0 ? (uint64_t)0 - (uint64_t)value : (uint64_t)value;
  digits[first] = '\0';
  do
  {
    digits[--first] = (char)('0' + (char)(rest % 10));
    rest /= 10;
  } while (rest > 0);
  if (value < 0)
    digits[--first] = '-';
  abut_text_add(text, digits + first);
}

/* Append mantissa (six digits, 100000..999999) with the decimal point after
 * its first n_whole digits and without trailing zeros. */
static void
add_mantissa(abut_text *text, int64_t mantissa, int n_whole)
{
  char out[16];
  int n = 0;
  int64_t divisor = 100000;
  for (int digit = 0; digit < 6; ++digit, divisor /= 10)
  {
    const int64_t rest = mantissa % (divisor * 10);
    if (digit >= n_whole && rest == 0)
      break;
    if (digit == n_whole)
      out[n++] = '.';
    out[n++] = (char)('0' + (char)(rest / divisor));
  }
  out[n] = '\0';
  abut_text_add(text, out);
}

void
abut_text_add_number(abut_text *text, double value)
{
  if (isnan(value))
  {
    abut_text_add(text, "nan");
    return;
  }
  if (value < 0)
    abut_text_add(text, "-");
  const double size = fabs(value);
  if (isinf(value))
  {
    abut_text_add(text, "inf");
    return;
  }
  if (size == 0)
  {
    abut_text_add(text, "0");
    return;
  }
  int exponent = (int)floor(log10(size));
  /* Two factors, because 10^-exponent overflows for the smallest numbers. */
  const int half = exponent / 2;
  const double scaled =
      size * pow(10.0, -half) * pow(10.0, 5 - exponent + half);
  int64_t mantissa = (int64_t)llround(scaled);
  if (mantissa < 100000)
  {
    mantissa = (int64_t)llround(scaled * 10);
    --exponent;
  }
  if (mantissa > 999999)
  {
    mantissa = (mantissa + 5) / 10;
    ++exponent;
  }
  if (exponent >= 0 && exponent < 6)
    add_mantissa(text, mantissa, exponent + 1);
  else if (exponent < 0 && exponent >= -4)
  {
    abut_text_add(text, "0.");
    for (int i = -1; i > exponent; --i)
      abut_text_add(text, "0");
    while (mantissa % 10 == 0)
      mantissa /= 10;
    abut_text_add_integer(text, mantissa);
  }
  else
  {
    add_mantissa(text, mantissa, 1);
    abut_text_add(text, "e");
    abut_text_add_integer(text, exponent);
  }
}

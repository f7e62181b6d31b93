/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_BASE_TEXT_H
#define ABUT_BASE_TEXT_H

/* A bounded line of text, built piece by piece without the C library's printf
 * family. A text that does not fit is cut off; data is always terminated. */

#include <stddef.h>
#include <stdint.h>

typedef struct abut_text
{
  char *data;      /* [capacity], terminated */
  size_t capacity; /* > 0 */
  size_t length;   /* < capacity */
} abut_text;

/* Start an empty line in data[capacity]. */
abut_text abut_text_begin(char *data, size_t capacity);

void abut_text_add(abut_text *text, const char *string);
void abut_text_add_integer(abut_text *text, int64_t value);

/* Shortest of fixed or scientific notation with six significant digits. */
void abut_text_add_number(abut_text *text, double value);

#endif

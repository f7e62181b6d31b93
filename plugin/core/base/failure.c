/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include <abut/failure.h>

#include <stddef.h>

/* One digit numbers are written with a leading zero. */
#define CODE(number)                                                           \
  ((const char[]){'A', 'B', 'U', 'T', '-', 'F', (char)('0' + (number) / 10),   \
                  (char)('0' + (number) % 10), '\0'})

static const abut_failure_entry table[] = {
#define ENTRY(name, number, text, remedy)                                      \
  {ABUT_FAILURE_##name, CODE(number), text, remedy},
    ABUT_FAILURE_LIST(ENTRY)
#undef ENTRY
};

static const int32_t n_entries = (int32_t)(sizeof(table) / sizeof(table[0]));

const abut_failure_entry *
abut_failure_at(int32_t index)
{
  return index >= 0 && index < n_entries ? &table[index] : NULL;
}

const abut_failure_entry *
abut_failure_get(abut_failure failure)
{
  for (int32_t i = 0; i < n_entries; ++i)
    if (table[i].failure == failure)
      return &table[i];
  return NULL;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "base/sized.h"

#include <stdbool.h>
#include <string.h>

enum
{
  /* No struct of any version is larger: a size above it is no size. */
  LARGEST = 4096
};

static size_t
size_of(const void *object)
{
  size_t size;
  memcpy(&size, object, sizeof(size));
  return size;
}

/* A size of some version: the size itself and at least one field, in whole
 * words, since all of these structs are aligned like their sizes. */
static bool
is_a_size(size_t size)
{
  return size >= 2 * sizeof(size_t) && size <= LARGEST
         && size % sizeof(size_t) == 0;
}

static size_t
smaller(size_t a, size_t b)
{
  return a < b ? a : b;
}

const char *
abut_sized_read(void *taken, size_t size, const void *given)
{
  const size_t stated = size_of(given);
  if (!is_a_size(stated))
    return "struct_size belongs to no version: start with the defaults";
  const unsigned char *bytes = given;
  for (size_t i = size; i < stated; ++i)
    if (bytes[i] != 0)
      return "a field is set that this version of the library does not have";
  memcpy((unsigned char *)taken + sizeof(size_t), bytes + sizeof(size_t),
         smaller(size, stated) - sizeof(size_t));
  return NULL;
}

const char *
abut_sized_write(void *result, size_t size, const void *source)
{
  const size_t stated = size_of(result);
  if (!is_a_size(stated))
    return "struct_size of the result belongs to no version";
  unsigned char *bytes = result;
  memcpy(bytes + sizeof(size_t), (const unsigned char *)source + sizeof(size_t),
         smaller(size, stated) - sizeof(size_t));
  if (stated > size)
    memset(bytes + size, 0, stated - size);
  return NULL;
}

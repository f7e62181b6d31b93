/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "base/allocator.h"

#include <stdlib.h>

void *
abut_library_allocate(void *user, size_t bytes, size_t alignment)
{
  (void)user;
  /* aligned_alloc wants a multiple of the alignment. */
  const size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  return rounded < bytes ? NULL : aligned_alloc(alignment, rounded);
}

void
abut_library_release(void *user, void *memory, size_t bytes)
{
  (void)user;
  (void)bytes;
  free(memory);
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_CORE_SCARCE_H
#define ABUT_TESTS_CORE_SCARCE_H

/* A supplier of a context's memory that counts what is out and refuses the
 * requests with the numbers first .. last, counted from 0. */

#include <abut/context.h>
#include <stdlib.h>

typedef struct scarce_memory
{
  int64_t n_requests, first, last;
  int64_t n_live;
  uint64_t bytes_live;
} scarce_memory;

static inline void *
scarce_supply(void *user, size_t bytes, size_t alignment)
{
  scarce_memory *s = user;
  const int64_t number = s->n_requests++;
  if (number >= s->first && number <= s->last)
    return NULL;
  s->n_live += 1;
  s->bytes_live += bytes;
  return aligned_alloc(alignment,
                       (bytes + alignment - 1) / alignment * alignment);
}

static inline void
scarce_take_back(void *user, void *memory, size_t bytes)
{
  scarce_memory *s = user;
  s->n_live -= 1;
  s->bytes_live -= bytes;
  free(memory);
}

static inline abut_context_options
scarce_options(scarce_memory *memory)
{
  abut_context_options options = abut_context_defaults();
  options.user = memory;
  options.allocate = scarce_supply;
  options.release = scarce_take_back;
  return options;
}

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "multigrid/multigrid.h"

#include <string.h>

typedef struct piece
{
  void *memory;
  size_t bytes;
} piece;

void *
abut_pool_allocate(abut_pool *pool, int64_t n, size_t element)
{
  pool->pieces.element = sizeof(piece);
  const size_t bytes = (size_t)(n > 0 ? n : 1) * element;
  if (pool->failed
      || abut_array_reserve(pool->context, &pool->pieces, pool->n, pool->n + 1)
             != ABUT_SUCCESS)
  {
    pool->failed = true;
    return NULL;
  }
  void *memory = abut_allocate(pool->context, bytes);
  if (memory == NULL)
  {
    pool->failed = true;
    return NULL;
  }
  memset(memory, 0, bytes);
  ((piece *)pool->pieces.data)[pool->n++] = (piece){memory, bytes};
  return memory;
}

void
abut_pool_release(abut_pool *pool)
{
  for (int64_t i = 0; i < pool->n; ++i)
  {
    const piece p = ((piece *)pool->pieces.data)[i];
    abut_release(pool->context, p.memory, p.bytes);
  }
  pool->n = 0;
  pool->failed = false;
  abut_array_release(pool->context, &pool->pieces);
}

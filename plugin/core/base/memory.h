/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_BASE_MEMORY_H
#define ABUT_BASE_MEMORY_H

/* Counted, aligned memory of a context, growing arrays, and creation and
 * destruction of objects. */

#include "base/context.h"

enum
{
  ABUT_ALIGNMENT = 64
};

/* bytes > 0 bytes aligned to 64, contents undefined; NULL when there are none.
 */
void *abut_allocate(abut_context *context, size_t bytes);

/* Give back what abut_allocate() gave; memory may be NULL. */
void abut_release(abut_context *context, void *memory, size_t bytes);

/* Zeroed memory of an object, which keeps the context alive; NULL when there
 * is none. */
void *abut_object_create(abut_context *context, size_t bytes);

/* Release the object's memory. */
void abut_object_destroy(abut_context *context, void *object, size_t bytes);

/* Growing array: a pointer to elements of one size beside its capacity. */
typedef struct abut_array
{
  void *data;
  int64_t capacity; /* elements */
  size_t element;   /* bytes per element */
} abut_array;

/* Make room for at least n elements, keeping the first used ones. Doubles, so
 * that appending is amortised O(1). */
abut_status abut_array_reserve(abut_context *context, abut_array *array,
                               int64_t used, int64_t n);

/* Release the memory; the array is empty and usable afterwards. */
void abut_array_release(abut_context *context, abut_array *array);

#endif

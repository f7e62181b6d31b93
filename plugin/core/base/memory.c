/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "base/memory.h"

#include <string.h>

void *
abut_allocate(abut_context *context, size_t bytes)
{
  const abut_context_options *options = &context->options;
  void *memory = options->allocate(options->user, bytes, ABUT_ALIGNMENT);
  if (memory == NULL)
    return NULL;
  abut_memory_usage *usage = &context->memory;
  usage->live_bytes += bytes;
  usage->n_allocations += 1;
  if (usage->peak_bytes < usage->live_bytes)
    usage->peak_bytes = usage->live_bytes;
  return memory;
}

void
abut_release(abut_context *context, void *memory, size_t bytes)
{
  if (memory == NULL)
    return;
  context->memory.live_bytes -= bytes;
  context->options.release(context->options.user, memory, bytes);
}

void *
abut_object_create(abut_context *context, size_t bytes)
{
  void *object = abut_allocate(context, bytes);
  if (object == NULL)
    return NULL;
  memset(object, 0, bytes);
  context->n_objects += 1;
  return object;
}

void
abut_object_destroy(abut_context *context, void *object, size_t bytes)
{
  context->n_objects -= 1;
  abut_release(context, object, bytes);
}

abut_status
abut_array_reserve(abut_context *context, abut_array *array, int64_t used,
                   int64_t n)
{
  if (n <= array->capacity)
    return ABUT_SUCCESS;
  int64_t capacity = 2 * array->capacity;
  if (capacity < n)
    capacity = n;
  if ((uint64_t)capacity > SIZE_MAX / 2 / array->element)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, "abut_array_reserve",
                     "an array would exceed the address space");
  const size_t bytes = (size_t)capacity * array->element;
  void *data = abut_allocate(context, bytes);
  if (data == NULL)
  {
    abut_text text = abut_fail_begin(context, "abut_array_reserve");
    abut_text_add(&text, "no memory for ");
    abut_text_add_integer(&text, (int64_t)bytes);
    abut_text_add(&text, " bytes");
    return ABUT_OUT_OF_MEMORY;
  }
  if (used > 0)
    memcpy(data, array->data, (size_t)used * array->element);
  abut_array_release(context, array);
  array->data = data;
  array->capacity = capacity;
  return ABUT_SUCCESS;
}

void
abut_array_release(abut_context *context, abut_array *array)
{
  abut_release(context, array->data, (size_t)array->capacity * array->element);
  array->data = NULL;
  array->capacity = 0;
}

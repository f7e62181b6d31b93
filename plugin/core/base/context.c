/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "base/context.h"
#include "base/allocator.h"
#include "base/sized.h"

#include <string.h>

abut_status
abut_context_create(const abut_context_options *options, abut_context **context)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_context_options chosen = abut_context_defaults();
  if (options != NULL
      && abut_sized_read(&chosen, sizeof(chosen), options) != NULL)
    return ABUT_INVALID_ARGUMENT;
  if ((chosen.allocate == NULL) != (chosen.release == NULL))
    return ABUT_INVALID_ARGUMENT;
  if (chosen.allocate == NULL)
  {
    chosen.allocate = abut_library_allocate;
    chosen.release = abut_library_release;
  }
  abut_context *made = chosen.allocate(chosen.user, sizeof(abut_context), 64);
  if (made == NULL)
    return ABUT_OUT_OF_MEMORY;
  memset(made, 0, sizeof(*made));
  made->options = chosen;
  *context = made;
  return ABUT_SUCCESS;
}

abut_status
abut_context_destroy(abut_context **context)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_context *old = *context;
  if (old == NULL)
    return ABUT_SUCCESS;
  if (old->n_objects > 0)
  {
    abut_text text = abut_fail_begin(old, "abut_context_destroy");
    abut_text_add_integer(&text, old->n_objects);
    abut_text_add(&text, " objects of this context are still alive");
    return ABUT_INVALID_ARGUMENT;
  }
  const abut_context_options options = old->options;
  options.release(options.user, old, sizeof(abut_context));
  *context = NULL;
  return ABUT_SUCCESS;
}

const char *
abut_context_message(const abut_context *context)
{
  return context != NULL ? context->message : "";
}

abut_status
abut_context_memory_sized(const abut_context *context, abut_memory_usage *usage)
{
  if (context == NULL || usage == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_sized_write(usage, sizeof(*usage), &context->memory) == NULL
             ? ABUT_SUCCESS
             : ABUT_INVALID_ARGUMENT;
}

abut_text
abut_fail_begin(abut_context *context, const char *call)
{
  abut_text text = abut_text_begin(context->message, ABUT_MESSAGE_CAPACITY);
  abut_text_add(&text, call);
  abut_text_add(&text, ": ");
  return text;
}

abut_status
abut_fail(abut_context *context, abut_status status, const char *call,
          const char *what)
{
  if (context != NULL)
  {
    abut_text text = abut_fail_begin(context, call);
    abut_text_add(&text, what);
  }
  return status;
}

abut_status
abut_copy_in(abut_context *context, const char *call, void *taken, size_t size,
             const void *given)
{
  const char *fault =
      given != NULL ? abut_sized_read(taken, size, given) : NULL;
  return fault == NULL ? ABUT_SUCCESS
                       : abut_fail(context, ABUT_INVALID_ARGUMENT, call, fault);
}

abut_status
abut_copy_out(abut_context *context, const char *call, void *result,
              size_t size, const void *source)
{
  const char *fault = abut_sized_write(result, size, source);
  return fault == NULL ? ABUT_SUCCESS
                       : abut_fail(context, ABUT_INVALID_ARGUMENT, call, fault);
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "base/context.h"
#include "base/allocator.h"

#include <stdbool.h>
#include <string.h>

static bool
options_are_legal(const abut_context_options *options)
{
  return options->struct_size == sizeof(abut_context_options)
         && (options->allocate == NULL) == (options->release == NULL);
}

abut_status
abut_context_create(const abut_context_options *options, abut_context **context)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_context_options chosen =
      options != NULL ? *options : abut_context_defaults();
  if (!options_are_legal(&chosen))
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

abut_memory_usage
abut_context_memory(const abut_context *context)
{
  const abut_memory_usage none = {0, 0, 0};
  return context != NULL ? context->memory : none;
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

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_BASE_CONTEXT_H
#define ABUT_BASE_CONTEXT_H

/* The inside of a context, for objects that are created from it. */

#include "base/text.h"

#include <abut/context.h>

enum
{
  ABUT_MESSAGE_CAPACITY = 512
};

struct abut_context
{
  abut_context_options options;
  abut_memory_usage memory;
  int64_t n_objects; /* alive */
  char message[ABUT_MESSAGE_CAPACITY];
};

/* Record "call: what" as the last failure and return status. The context may
 * be NULL: then there is nowhere to record it. */
abut_status abut_fail(abut_context *context, abut_status status,
                      const char *call, const char *what);

/* Take a struct that begins with its size from the caller, see base/sized.h:
 * `taken` holds the defaults, `given` may be NULL. */
abut_status abut_copy_in(abut_context *context, const char *call, void *taken,
                         size_t size, const void *given);

/* Give one to the caller. */
abut_status abut_copy_out(abut_context *context, const char *call, void *result,
                          size_t size, const void *source);

/* Begin a message "call: " of several pieces (see text.h); finish by returning
 * the status. The context must exist. */
abut_text abut_fail_begin(abut_context *context, const char *call);

#endif

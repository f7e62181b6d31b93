/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONTEXT_H
#define ABUT_CONTEXT_H

/** @file
 * The context: memory, and the text of the last failure.
 *
 * Every object of the library is created from a context and must be destroyed
 * before it. A context is used by one thread at a time; two contexts share
 * nothing.
 */

#include <abut/status.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Opaque context. */
  typedef struct abut_context abut_context;

  /** Options of abut_context_create(). */
  typedef struct abut_context_options
  {
    /** sizeof(abut_context_options); set by abut_context_defaults(). */
    size_t struct_size;
    /** Handed to the two functions below. */
    void *user;
    /** Returns @p bytes bytes aligned to @p alignment (a power of two), or
     * NULL; NULL selects the C library. */
    void *(*allocate)(void *user, size_t bytes, size_t alignment);
    /** Returns what allocate gave; must be given together with allocate. */
    void (*release)(void *user, void *memory, size_t bytes);
  } abut_context_options;

  /** Default options: memory from the C library. */
  static inline abut_context_options abut_context_defaults(void)
  {
    abut_context_options options = {sizeof(abut_context_options), NULL, NULL,
                                    NULL};
    return options;
  }

  /** Memory that a context has allocated. */
  typedef struct abut_memory_usage
  {
    size_t struct_size;     /**< sizeof(abut_memory_usage) */
    uint64_t live_bytes;    /**< now held */
    uint64_t peak_bytes;    /**< largest value of live_bytes so far */
    uint64_t n_allocations; /**< number of allocations so far */
  } abut_memory_usage;

  /** Create a context in @p context; @p options may be NULL. */
  ABUT_API abut_status abut_context_create(const abut_context_options *options,
                                           abut_context **context);

  /** Destroy a context and set the handle to NULL. INVALID_ARGUMENT, and
   * nothing destroyed, while objects created from it are alive. */
  ABUT_API abut_status abut_context_destroy(abut_context **context);

  /** Text of the last failure with the name of the call that failed, or "". */
  ABUT_API const char *abut_context_message(const abut_context *context);

  /** Memory held by the objects of this context. */
  ABUT_API abut_status abut_context_memory_sized(const abut_context *context,
                                                 abut_memory_usage *usage);

  /** The same; zeros if @p context is NULL. */
  static inline abut_memory_usage
  abut_context_memory(const abut_context *context)
  {
    abut_memory_usage usage = {sizeof(abut_memory_usage), 0, 0, 0};
    (void)abut_context_memory_sized(context, &usage);
    return usage;
  }

#ifdef __cplusplus
}
#endif

#endif

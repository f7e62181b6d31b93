/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_STATUS_H
#define ABUT_STATUS_H

/** @file
 * Status codes of every public call.
 *
 * 0 is success. A positive code is the caller's mistake: nothing was changed
 * and the call may be repeated with better arguments. A negative code is a
 * lack of resources or a fault of the library: the objects involved may only
 * be destroyed. Text and place of the last failure are in the context
 * (abut_context_message()).
 *
 * Calls that reduce over ranks (abut_strategy_start() and its like) fail on all
 * of them. FAILED_ELSEWHERE is the status of those where nothing was wrong:
 * status and text of another one have the cause. */

#include <abut/export.h>

#ifdef __cplusplus
extern "C"
{
#endif

/** One list yields the enumeration and the messages. */
#define ABUT_STATUS_LIST(X)                                                    \
  X(SUCCESS, 0, "success")                                                     \
  X(INVALID_ARGUMENT, 1, "an argument is out of its legal range")              \
  X(NOT_FINITE, 2, "a value is NaN or infinite")                               \
  X(WRONG_ORDER, 3, "the call is not legal in this state of the object")       \
  X(UNSUPPORTED, 4, "this combination is not defined")                         \
  X(CALLBACK_FAILED, 5, "a function supplied by the caller reported failure")  \
  X(INVALID_MESH, 6, "a facet or node of the surface is not usable")           \
  X(FAILED_ELSEWHERE, 7, "the call failed on another rank")                    \
  X(SINGULAR, 8, "a matrix is singular")                                       \
  X(OUT_OF_MEMORY, -1, "out of memory")                                        \
  X(INTERNAL, -2, "internal error")

  /** Status of a call; see the sign rule above. */
  typedef enum abut_status
  {
/** @cond */
#define ABUT_STATUS_ENTRY(name, code, text) ABUT_##name = code,
    /** @endcond */
    ABUT_STATUS_LIST(ABUT_STATUS_ENTRY)
#undef ABUT_STATUS_ENTRY
  } abut_status;

  /** English text of a status code; never NULL. */
  ABUT_API const char *abut_status_text(abut_status status);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_BASE_SIZED_H
#define ABUT_BASE_SIZED_H

/* Structs that cross the border of the library begin with their size, so that
 * fields can be added at their ends: caller and library may be of different
 * versions. */

#include <stddef.h>

/* Take what a caller gave. An older caller's struct is shorter: what it lacks
 * stays as it is in `taken`, which holds the defaults. A newer one's is longer:
 * legal as long as it does not use what this library does not know, that is,
 * if all bytes behind `size` are zero.
 *
 * Nothing beyond the size that the caller states is read. Returns what is
 * wrong, or NULL; `given` must not be. */
const char *abut_sized_read(void *taken, size_t size, const void *given);

/* Give a caller as much of a result as its struct holds, and zeros for what
 * this library does not know. Nothing is written beyond the size that the
 * caller states, which stays. Returns what is wrong, or NULL. */
const char *abut_sized_write(void *result, size_t size, const void *source);

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_BASE_ALLOCATOR_H
#define ABUT_BASE_ALLOCATOR_H

/* The C library's memory in the form of abut_context_options. */

#include <stddef.h>

void *abut_library_allocate(void *user, size_t bytes, size_t alignment);
void abut_library_release(void *user, void *memory, size_t bytes);

#endif

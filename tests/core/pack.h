/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_CORE_PACK_H
#define ABUT_TESTS_CORE_PACK_H

/* What a host does between the calls of abut/parts.h: facets as bytes, and one
 * surface of several such buffers. */

#include <abut/surface.h>

/* Write facets with their nodes, numbers, groups and present positions into
 * a buffer, for a process of the same kind of machine.
 * @param facets [n_facets] facets of the surface, each at most once
 * @param buffer NULL: only the size is asked for
 * @param bytes in: room in the buffer; out: bytes needed or written
 * INVALID_ARGUMENT if the room does not suffice. */
abut_status pack_surface(abut_surface *surface, int32_t n_facets,
                         const int32_t *facets, void *buffer, size_t *bytes);

/* Make one surface of several buffers. Facets and nodes with the same
 * number are taken once (the first one met); facets and nodes are arranged
 * by number, so that the surface does not depend on how it was cut.
 *
 * INVALID_ARGUMENT for a buffer that pack_surface() did not write, or
 * was cut off. Neighbours across the rim of a part may be missing, so that
 * orientation is not checked. */
abut_status unpack_surfaces(abut_context *context, int32_t dimension,
                            int32_t n_buffers, const void *const *buffers,
                            const size_t *bytes, abut_surface **surface);

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONSTRAINT_PLACES_H
#define ABUT_CONSTRAINT_PLACES_H

/* The arrays of the places of a set of points. Its functions keep them in step
 * with the points. */

#include "base/memory.h"

#include <abut/places.h>

#include <stdbool.h>

enum
{
  ABUT_PLACE_ARRAYS = 11
};

typedef struct abut_places
{
  abut_context *context;
  int32_t dimension, n;
  int32_t n_pairs, n_nodes;                         /* numbers are below */
  abut_array pair, node, facet;                     /* int32_t, [n] */
  abut_array position, least;                       /* double */
  abut_array line_start, column_start, block_start; /* int64_t, [n + 1] */
  abut_array line, column;                          /* int32_t */
  abut_array block;                                 /* double */
} abut_places;

void abut_places_set_up(abut_places *places, abut_context *context,
                        int32_t dimension);
void abut_places_release(abut_places *places);

/* Keep the first n. */
void abut_places_truncate(abut_places *places, int32_t n);

/* Append one that has been checked, for a point of that many components. */
abut_status abut_places_append(abut_places *places, const abut_place *place,
                               int32_t n_components);

/* Move the place of point i behind those that are kept, with the blocks of the
 * components that are kept [n_components]. */
void abut_places_keep(abut_places *places, int32_t i, int32_t n_components,
                      const uint8_t *keep);

/* The places of a set. */
abut_places *abut_points_places(abut_points *points);

/* Views of points and of their places. */
abut_status abut_points_get_placed(const abut_points *points,
                                   abut_points_view *view,
                                   abut_places_view *places);

/* New numbers of nodes, here and in entries node [n]; false and unchanged if
 * one is negative or out of range. */
bool abut_places_renumber(abut_places *places, int32_t *node, int64_t n,
                          int32_t n_nodes, const int32_t *number);

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_GRID_H
#define ABUT_SEARCH_GRID_H

/* Uniform buckets.
 *
 * Each facet is entered once, in the cell of its box's centre; a cell is at
 * least as wide as the search radius, the largest inflated half-extent, so
 * that a query at a point looks at 27 cells (9 in 2D). Facets are sorted by
 * cell along Morton's curve, occupied cells are found through a hash table:
 * memory is proportional to the facets whatever the size of the cells. */

#include "search/order.h"
#include "search/record.h"
#include "search/runs.h"
#include "search/tree.h"

typedef struct abut_grid
{
  double origin[3];
  double edge;           /* of a cell */
  double limit[3];       /* cells per direction, as a number */
  double radius;         /* largest inflated half-extent */
  double drift;          /* largest distance of a centre from its cell */
  int32_t n_cells;       /* occupied */
  int32_t hash_bits;     /* the table has 2^hash_bits places */
  bool raised;           /* the edge requested was too small */
  abut_array cell_key;   /* uint64_t, [n_cells] */
  abut_array cell_start; /* int32_t, [n_cells + 1] */
  abut_array table;      /* int32_t, cell number or -1 */
} abut_grid;

/* Sort facets into cells of the given edge (0: chosen) and build the table.
 * items[i].index is the i-th facet afterwards. */
abut_status abut_grid_build(abut_context *context, abut_grid *grid,
                            const abut_site *sites, int32_t n, double edge,
                            abut_keyed *items, abut_keyed *room);

/* After motion: recompute radius and drift. False if the cells do not serve
 * any more, because a centre left its cell by more than half an edge or
 * facets grew beyond the edge. */
bool abut_grid_refit(abut_grid *grid, const abut_record *records);

/* Runs of records in all cells that may hold a facet whose inflated box
 * touches the box. */
void abut_grid_gather(const abut_grid *grid, const double *lower,
                      const double *upper, abut_runs *runs);

#endif

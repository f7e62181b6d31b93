/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_SEARCH_H
#define ABUT_SEARCH_SEARCH_H

/* The inside of a search and of its lists. */

#include "search/grid.h"
#include "search/tree.h"

#include <abut/search.h>

/* Pairs in the order in which queries were answered: query order[k] has the
 * records slot[start[k]] .. slot[start[k + 1] - 1]. Queries without pairs may
 * be missing. */
typedef struct abut_list
{
  int32_t n;
  bool of_facets;   /* slot has ascending numbers of facets instead of slots */
  abut_array order; /* int32_t */
  abut_array start; /* int64_t, [n + 1] */
  abut_array slot;  /* int32_t */
} abut_list;

/* Data of the exact test whether a point or box is near a facet. */
typedef struct abut_exact
{
  double bound[6]; /* lower and, negative, upper bounds of the inflated box */
  double centre[3];
  double limit; /* square of reach and radius */
} abut_exact;

/* Facets near a block of queries. */
typedef struct abut_block
{
  int32_t n;
  int32_t n_padded; /* with empty boxes at the end */
  double origin[3]; /* of the steps (block.c) */
  double scale[3];
  abut_array step;  /* int8_t, [6][capacity]: lower x, y, z, upper x, y, z */
  abut_array exact; /* abut_exact */
  abut_array value; /* int32_t, slots, or facets in ascending order */
  abut_array keyed; /* uint64_t, [2][capacity], to sort them */
  uint8_t place[256][8]; /* places of the bits of a byte that are set */
  uint8_t n_places[256]; /* how many are */
} abut_block;

/* An algorithm. */
typedef struct abut_search_method
{
  const char *name; /* in the parameter file */
  /* Sort the facets into buckets and compute their records. */
  abut_status (*build)(abut_search *search);
  /* Fit the buckets to renewed records; false if they do not serve any more. */
  bool (*refit)(abut_search *search);
  /* Facets at consecutive places of the search order whose boxes have a common
   * box; and what is done with it: its extent is returned. NULL: nothing. */
  int32_t (*bucket_size)(const abut_search *search);
  double (*fit_bucket)(abut_search *search, int32_t bucket, const double *lower,
                       const double *upper);
  /* Runs of facets near the box of a block of queries. NULL: no buckets, each
   * query looks at every facet. */
  void (*gather)(const abut_search *search, const double *lower,
                 const double *upper, abut_runs *runs);
} abut_search_method;

/* All algorithms, in the order of abut_search_algorithm. */
extern const abut_search_method abut_search_methods[ABUT_SEARCH_N_ALGORITHMS];

struct abut_search
{
  abut_context *context;
  const abut_search_method *method;
  abut_surface *surface;
  abut_search_options options;
  abut_reach reach;
  double skin;
  uint64_t revision; /* of the surface in the records; 0: never built */
  bool fitted;       /* buckets fit the records */
  double extent;     /* sum of the buckets' extents, adaptive */
  uint64_t serial;   /* counts sorts: slots keep their facet in between */
  bool reach_changed;
  int32_t n;
  double lower[3], upper[3]; /* box of all inflated facets, without skin */
  double smallest;           /* inflated half-extent */
  abut_array records;        /* abut_record, in search order */
  abut_array sites;          /* abut_site, in facet order */
  abut_array items;          /* abut_keyed */
  abut_array room;           /* abut_keyed */
  abut_array runs;           /* abut_run */
  abut_tree tree;
  abut_grid grid;
  abut_list list;       /* of the last query */
  abut_array query_box; /* double, boxes of queries in query order */
  abut_block block;     /* near a block of queries */
  abut_search_statistics statistics;
};

/* The queries: n points, or n boxes. */
typedef struct abut_query
{
  int32_t n;
  int32_t dimension;    /* of points */
  const double *points; /* [n * dimension], or NULL: boxes */
  const double *boxes;  /* [6 * n] lower, upper */
} abut_query;

/* Answers to a few queries: query order[k] has the records slot[start[k]] ..
 * slot[start[k + 1] - 1]; the one with the nearest centre comes first. */
typedef struct abut_answers
{
  int32_t n;
  const int32_t *order;
  const int64_t *start;
  const int32_t *slot;
} abut_answers;

/* Takes answers while they are in the cache. */
typedef abut_status (*abut_consume)(void *user, const abut_answers *answers);

void abut_block_prepare(abut_block *block);
void abut_block_release(abut_context *context, abut_block *block);

/* The facets of the runs whose inflated box touches the box of a block of
 * queries: as slots, or as numbers of facets in ascending order. */
abut_status abut_block_fill(abut_search *search, const abut_runs *runs,
                            const double *lower, const double *upper,
                            double skin, bool of_facets);

/* Copy the facets that are pairs of a query of the block, in the same order,
 * into values, which has room for all of the block; returns their number.
 * values[*nearest] is the one with the nearest centre (NULL: not requested). */
int32_t abut_block_near_point(const abut_block *block, const double *x,
                              int32_t *values, int32_t *nearest);
int32_t abut_block_near_box(const abut_block *block, const double *lower,
                            const double *upper, int32_t *values);

/* Bring the records up to date, not the buckets: enough to use a list. */
abut_status abut_search_refresh(abut_search *search);

/* Answer a query; the search must be up to date. Either all answers go into
 * list (consume is NULL), or each block's to consume, and list is scratch. */
abut_status abut_search_list(abut_search *search, const abut_query *query,
                             double skin, abut_list *list, abut_consume consume,
                             void *user);

/* Hand the answers of a complete list to consume, a block at a time. */
abut_status abut_list_consume(const abut_list *list, abut_consume consume,
                              void *user);

/* Room for exactly n elements, contents lost: for large arrays, where
 * doubling would waste memory. */
abut_status abut_search_fit(abut_context *context, abut_array *array,
                            int64_t n);

void abut_list_prepare(abut_list *list);
void abut_list_release(abut_context *context, abut_list *list);

/* Point i of a query, padded to three dimensions. */
static inline void
abut_query_point(const abut_query *q, int32_t i, double *x)
{
  const double *p = q->points + (int64_t)q->dimension * i;
  x[0] = p[0];
  x[1] = p[1];
  x[2] = q->dimension == 3 ? p[2] : 0;
}

#endif

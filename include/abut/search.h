/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_H
#define ABUT_SEARCH_H

/** @file
 * Contact search: which nodes, points or facets are near which facets.
 *
 * Three algorithms behind one interface find identical sets of pairs:
 *
 *   all pairs         every query against every facet: O(n m). The oracle,
 *                     and the fastest for a handful of facets.
 *   uniform buckets   facets sorted into cells of one size, found through a
 *                     hash table. Degrades where facet sizes differ much,
 *                     because a cell must hold the largest.
 *   adaptive buckets  facets sorted by size and along a space-filling curve,
 *                     cut into buckets of a few facets, and buckets nested
 *                     eight by eight in larger ones. The cost does not depend
 *                     on the ratio of facet sizes. The default.
 *
 * Definition of the result, in double precision, with the facet's reach
 *
 *     h_s = max(reach, relative_reach * size of the facet)
 *
 * (size: longest side), its box (exact for facets with straight sides, else a
 * bound), its centre and its radius about the centre (abut_facet_measures):
 *
 *   a point x and a facet s are a pair if x lies in the facet's box inflated
 *   by h_s (closed) and |x - centre_s| <= h_s + radius_s;
 *   a facet q and a facet s are a pair if the box of q touches the box of s
 *   inflated by h_s (closed sets).
 *
 * Pairs are given per query in ascending order of the facet. They do not
 * depend on the algorithm, the bucket size, the order of the arrays or earlier
 * searches.
 */

#include <abut/surface.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Algorithms. */
  typedef enum abut_search_algorithm
  {
    ABUT_SEARCH_ALL_PAIRS,
    ABUT_SEARCH_UNIFORM_BUCKETS,
    ABUT_SEARCH_ADAPTIVE_BUCKETS,
    /** Number of algorithms; not an algorithm. */
    ABUT_SEARCH_N_ALGORITHMS
  } abut_search_algorithm;

  /** Name of an algorithm in the parameter file ("uniform buckets"); never
   * NULL. */
  ABUT_API const char *abut_search_name(abut_search_algorithm algorithm);

  /** Algorithm by its name; INVALID_ARGUMENT if there is none. */
  ABUT_API abut_status abut_search_find(const char *name,
                                        abut_search_algorithm *algorithm);

  /** Options of a search. */
  typedef struct abut_search_options
  {
    size_t struct_size; /**< sizeof(abut_search_options) */
    /** Default: adaptive buckets. */
    abut_search_algorithm algorithm;
    /** Edge of a bucket as a multiple of the median facet size, >= 0; 0
     * (default) chooses it from the data. Uniform: values below the search
     * radius are raised to it, which the statistics report. Adaptive: a bucket
     * holds bucket_size^2 facets (2D: bucket_size), if capacity is 0. */
    double bucket_size;
    /** Adaptive: most facets in a bucket, 0 (default: bucket_size decides) or
     * 1 .. 4096. */
    int32_t capacity;
    /** Reach as a length, >= 0; default 0. */
    double reach;
    /** Reach relative to the size of each facet, >= 0; default 0.5. */
    double relative_reach;
    /** Length, >= 0, by which lists are made too long, so that they serve again
     * after small motion; default 0: lists are made again whenever something
     * moved. */
    double skin;
    double reserved[4]; /**< 0: room for later options, since this struct stands
                             in others */
  } abut_search_options;

  /** Default options. */
  static inline abut_search_options abut_search_defaults(void)
  {
    const abut_search_options options = {sizeof(abut_search_options),
                                         ABUT_SEARCH_ADAPTIVE_BUCKETS,
                                         0.,
                                         0,
                                         0.,
                                         0.5,
                                         0.,
                                         {0., 0., 0., 0.}};
    return options;
  }

  /** Opaque search over one (primary) surface. */
  typedef struct abut_search abut_search;

  /** Opaque list of pairs. */
  typedef struct abut_pairs abut_pairs;

  /** Create a search over @p surface, which must outlive it. Nothing is
   * searched yet. */
  ABUT_API abut_status abut_search_create(abut_context *context,
                                          abut_surface *surface,
                                          const abut_search_options *options,
                                          abut_search **search);

  /** Destroy a search and set the handle to NULL. */
  ABUT_API abut_status abut_search_destroy(abut_search **search);

  /** Change reach and skin between searches; other options must be those of
   * creation. */
  ABUT_API abut_status abut_search_set_reach(abut_search *search, double reach,
                                             double relative_reach,
                                             double skin);

  /** Bring the search up to date with the positions of its surface. Queries do
   * this by themselves. After motion the buckets are kept and their boxes
   * refitted as long as the boxes have not grown by more than a half in sum;
   * else everything is sorted again. O(n). */
  ABUT_API abut_status abut_search_update(abut_search *search);

  /** Create an empty list of pairs. */
  ABUT_API abut_status abut_pairs_create(abut_context *context,
                                         abut_pairs **pairs);

  /** Destroy a list and set the handle to NULL. */
  ABUT_API abut_status abut_pairs_destroy(abut_pairs **pairs);

  /** Read-only view of a list: query i has the facets from facet[start[i]] to
   * facet[start[i + 1] - 1], ascending. Valid until the list changes. */
  typedef struct abut_pairs_view
  {
    size_t struct_size;   /**< sizeof(abut_pairs_view) */
    int32_t n_queries;    /**< number of queries */
    const int64_t *start; /**< [n_queries + 1] */
    const int32_t *facet; /**< [start[n_queries]] */
  } abut_pairs_view;

  /** View of the arrays. */
  ABUT_API abut_status abut_pairs_get_sized(const abut_pairs *pairs,
                                            abut_pairs_view *view);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_pairs_get(const abut_pairs *pairs,
                                           abut_pairs_view *view)
  {
    if (view != NULL)
      view->struct_size = sizeof(*view);
    return abut_pairs_get_sized(pairs, view);
  }

  /** Pairs of the nodes of @p secondary (which may be the searched surface)
   * with the facets of the search. With a skin, a list made by an earlier call
   * with the same arguments serves as long as the motion of all nodes since,
   * apart from a common translation, keeps to the bound that makes it safe.
   * Allocates nothing once warmed up. */
  ABUT_API abut_status abut_search_nodes(abut_search *search,
                                         const abut_surface *secondary,
                                         abut_pairs *pairs);

  /** Pairs of the facets of @p secondary (which may be the searched surface:
   * then each facet is its own pair) with the facets of the search; skin as in
   * abut_search_nodes(). */
  ABUT_API abut_status abut_search_facets(abut_search *search,
                                          const abut_surface *secondary,
                                          abut_pairs *pairs);

  /** Pairs of points with the facets of the search.
   * @param points [n * dimension] finite, magnitude at most ABUT_FACET_LIMIT */
  ABUT_API abut_status abut_search_points(abut_search *search, int32_t n,
                                          const double *points,
                                          abut_pairs *pairs);

  /** Sizes of a search and its work so far. */
  typedef struct abut_search_statistics
  {
    size_t struct_size;      /**< sizeof(abut_search_statistics) */
    int64_t n_facets;        /**< of the surface */
    int64_t n_buckets;       /**< uniform: occupied cells; adaptive: buckets of
                                  facets */
    int64_t n_levels;        /**< adaptive: classes of facet size; else 1 */
    double bucket_edge;      /**< uniform: edge in use, length; else 0 */
    int32_t capacity;        /**< adaptive: facets per bucket in use; else 0 */
    int32_t bucket_raised;   /**< nonzero: the bucket size requested was below
                                  the search radius and was raised */
    int64_t structure_bytes; /**< what the algorithm holds: order, buckets,
                                  hash table, room for sorting */
    int64_t record_bytes;    /**< boxes, centres, radii, normals of facets in
                                  search order */
    int64_t query_bytes;     /**< lists and positions of the last queries */
    int64_t n_builds;        /**< times that facets were sorted */
    int64_t n_refits;        /**< times that only boxes were refitted */
    int64_t n_searches;      /**< queries answered by searching */
    int64_t n_reuses;        /**< queries answered from a list with skin */
    int64_t n_block_tests;   /**< facets looked at for blocks of queries */
    int64_t n_box_tests;     /**< facets looked at for single queries */
    int64_t n_pairs;         /**< pairs found by the last query */
  } abut_search_statistics;

  /** Statistics of a search. */
  ABUT_API abut_status abut_search_get_statistics_sized(
      const abut_search *search, abut_search_statistics *statistics);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_search_get_statistics(const abut_search *search,
                             abut_search_statistics *statistics)
  {
    if (statistics != NULL)
      statistics->struct_size = sizeof(*statistics);
    return abut_search_get_statistics_sized(search, statistics);
  }

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SEARCH_BENCH_H
#define ABUT_SEARCH_BENCH_H

/* What the parts of the search benchmark share: a scene with the facets as
 * every program needs them, and a result that can be compared. */

#include "scenes.h"

#ifdef __cplusplus
extern "C"
{
#endif

  /* A facet as the definition of pairs sees it. */
  typedef struct bench_facet
  {
    double lower[3], upper[3], centre[3];
    double radius;
    double size; /* longest side */
  } bench_facet;

  typedef struct bench_scene
  {
    const char *name;
    scene_mesh primary, secondary; /* quad4 */
    bench_facet *facet;            /* of the primary surface */
    double largest;                /* facet size */
  } bench_scene;

  typedef enum bench_task
  {
    BENCH_CANDIDATES, /* all pairs within one facet size */
    BENCH_NEAREST,    /* nearest facet within half a size, with projection */
    BENCH_N_TASKS
  } bench_task;

  typedef struct bench_result
  {
    double build, query; /* seconds of processor time */
    double bytes;        /* of the search structure; 0: not known */
    int64_t n;           /* pairs, or nodes with a facet */
    double sum;          /* of a number made of each pair, or of distances */
  } bench_result;

  /* A program: fills the result; returns 0 if it takes no part in this. */
  typedef int (*bench_program)(const bench_scene *scene, bench_task task,
                               bench_result *result);

  /* Processor time of this process, seconds. */
  double bench_now(void);

  /* Bytes on the heap. */
  double bench_heap(void);

  /* A small whole number made of a pair: sums are exact in any order. */
  double bench_pair_number(int32_t node, int32_t facet);

  /* Whether x and a facet are a pair at relative reach 1: the exact test. */
  int bench_is_pair(const bench_facet *facet, const double *x);

  /* Distance of x to facet f of the primary surface. */
  double bench_distance(const bench_scene *scene, int32_t f, const double *x);

  void bench_measure_facets(bench_scene *scene);

  int bench_all_pairs(const bench_scene *, bench_task, bench_result *);
  int bench_uniform(const bench_scene *, bench_task, bench_result *);
  int bench_adaptive(const bench_scene *, bench_task, bench_result *);
  int bench_boost(const bench_scene *, bench_task, bench_result *);
  int bench_nanoflann(const bench_scene *, bench_task, bench_result *);
  int bench_embree(const bench_scene *, bench_task, bench_result *);
  int bench_cgal(const bench_scene *, bench_task, bench_result *);
  int bench_fcl(const bench_scene *, bench_task, bench_result *);
  int bench_bullet(const bench_scene *, bench_task, bench_result *);

  /* Stages of Abut's detection, ns per node: normals; sorting and boxes; the
   * rest with projection; then steps 2 to 11 alone; after small motion, with a
   * list that has a skin, renewal of boxes and normals, and the check that the
   * list still serves, which takes the place of steps 2 to 11. */
  typedef struct bench_stages
  {
    double normals, build, rest, steps_2_to_11, renewal, after_motion;
  } bench_stages;

  void bench_stages_of(const bench_scene *scene, int repeats,
                       bench_stages *stages);

  /* Time of the nearest task in ns per node with a bucket size, 0: chosen. */
  double bench_bucket_size(const bench_scene *scene, int algorithm,
                           double bucket_size, int repeats);

#ifdef __cplusplus
}
#endif

#endif

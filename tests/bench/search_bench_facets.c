/* SPDX-License-Identifier: LGPL-2.1-or-later */
#define _DEFAULT_SOURCE
#include "search_bench.h"

#include <abut/projection.h>

#include <malloc.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>

double
bench_now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double
bench_heap(void)
{
  const struct mallinfo2 m = mallinfo2();
  return (double)m.uordblks + (double)m.hblkhd;
}

double
bench_pair_number(int32_t node, int32_t facet)
{
  const uint32_t mixed =
      ((uint32_t)node * UINT32_C(2654435761)) ^ ((uint32_t)facet * 40503u);
  return (double)((mixed ^ mixed >> 15) & 0xffff);
}

int
bench_is_pair(const bench_facet *f, const double *x)
{
  double square = 0;
  for (int d = 0; d < 3; ++d)
  {
    if (x[d] < f->lower[d] - f->size || x[d] > f->upper[d] + f->size)
      return 0;
    square += (x[d] - f->centre[d]) * (x[d] - f->centre[d]);
  }
  const double limit = f->size + f->radius;
  return square <= limit * limit;
}

static void
gather(const scene_mesh *m, int32_t f, double *nodes)
{
  for (int a = 0; a < 4; ++a)
    for (int d = 0; d < 3; ++d)
      nodes[3 * a + d] = m->position[3 * m->connectivity[4 * f + a] + d];
}

double
bench_distance(const bench_scene *scene, int32_t f, const double *x)
{
  double nodes[12];
  abut_projection p;
  gather(&scene->primary, f, nodes);
  return abut_facet_project(ABUT_FACET_QUAD4, nodes, x, &p) == ABUT_SUCCESS
             ? p.distance
             : INFINITY;
}

void
bench_measure_facets(bench_scene *scene)
{
  static const int sides[8] = {0, 1, 1, 3, 3, 2, 2, 0};
  const scene_mesh *m = &scene->primary;
  scene->facet = malloc(sizeof(bench_facet) * (size_t)m->n_facets);
  scene->largest = 0;
  for (int32_t f = 0; f < m->n_facets; ++f)
  {
    bench_facet *b = scene->facet + f;
    double nodes[12], longest = 0;
    abut_facet_measures z;
    gather(m, f, nodes);
    (void)abut_facet_measure(ABUT_FACET_QUAD4, nodes, &z);
    for (int k = 0; k < 4; ++k)
    {
      const double *a = nodes + 3 * sides[2 * k];
      const double *c = nodes + 3 * sides[2 * k + 1];
      const double x = a[0] - c[0], y = a[1] - c[1], w = a[2] - c[2];
      longest = fmax(longest, sqrt(x * x + y * y + w * w));
    }
    for (int d = 0; d < 3; ++d)
    {
      b->lower[d] = z.lower[d];
      b->upper[d] = z.upper[d];
      b->centre[d] = z.centre[d];
    }
    b->radius = z.radius;
    b->size = longest;
    scene->largest = fmax(scene->largest, longest);
  }
}

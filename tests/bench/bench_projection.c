/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Time per projection for each kind of facet: flat, slightly warped or curved
 * as a fine mesh's facets are, and strongly distorted; for points over the
 * facet and around it. Facets and points are in the first-level cache's reach,
 * so that arithmetic is measured. */
#include "facets.h"
#include <abut/projection.h>
#include <stdio.h>
#include <time.h>

enum
{
  n_pairs = 512,
  n_repeats = 41
};

static double
now(void)
{
  struct timespec t;
  (void)timespec_get(&t, TIME_UTC);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* A point at a random height over a random place; reach 1: over the facet. */
static void
make_point(uint64_t *seed, abut_facet_kind kind, const double *nodes,
           double reach, double *x)
{
  const int dim = abut_facet_dimension(kind);
  double xi[2], n[3];
  if (abut_facet_n_corners(kind) == 3)
  {
    xi[0] = uniform(seed, 0.5 - 0.5 * reach, 0.5 * reach);
    xi[1] = uniform(seed, 0.5 - 0.5 * reach, 0.5 * reach);
  }
  else
  {
    xi[0] = uniform(seed, -reach, reach);
    xi[1] = uniform(seed, -reach, reach);
  }
  abut_facet_point(kind, nodes, xi, x, n);
  const double height = uniform(seed, -0.2, 0.2);
  for (int d = 0; d < dim; ++d)
    x[d] += height * n[d];
}

/* Best of the repeats, nanoseconds per projection. */
static double
measure(abut_facet_kind kind, double distortion, double reach)
{
  static double nodes[n_pairs][27], x[n_pairs][3];
  uint64_t seed = 1;
  for (int i = 0; i < n_pairs; ++i)
  {
    random_facet(&seed, kind, distortion, 1., nodes[i]);
    make_point(&seed, kind, nodes[i], reach, x[i]);
  }
  double best = INFINITY;
  for (int r = 0; r < n_repeats; ++r)
  {
    const double start = now();
    for (int i = 0; i < n_pairs; ++i)
    {
      abut_projection p;
      (void)abut_facet_project(kind, nodes[i], x[i], &p);
    }
    best = fmin(best, (now() - start) / n_pairs * 1e9);
  }
  return best;
}

int
main(void)
{
  static const double distortions[] = {0., 0.02, 0.2};
  printf("nanoseconds per projection: point over the facet / up to half a "
         "facet outside\n%-8s%16s%16s%16s\n",
         "kind", "flat", "moved 1 %", "moved 10 %");
  for (int k = 0; k < ABUT_FACET_N_KINDS; ++k)
  {
    const abut_facet_kind kind = (abut_facet_kind)k;
    printf("%-8s", abut_facet_name(kind));
    for (int d = 0; d < 3; ++d)
      printf("%8.0f /%6.0f", measure(kind, distortions[d], 1.),
             measure(kind, distortions[d], 2.));
    printf("\n");
  }
  return 0;
}

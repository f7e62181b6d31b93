/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Sizes of a surface and its feature sides. */
#include "geometry/surface.h"

#include <math.h>
#include <string.h>

double
abut_surface_longest_side(abut_facet_kind kind, const double *nodes)
{
  const int32_t n = abut_facet_n_corners(kind);
  if (n == 2)
    return hypot(nodes[2] - nodes[0], nodes[3] - nodes[1]);
  double longest = 0;
  for (int32_t k = 0; k < n; ++k)
  {
    const double *a = nodes + 3 * abut_facet_loop(n, k);
    const double *b = nodes + 3 * abut_facet_loop(n, k + 1);
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    longest = square > longest ? square : longest;
  }
  return sqrt(longest);
}

double
abut_facet_size(abut_facet_kind kind, const double *nodes)
{
  return nodes == NULL || abut_facet_n_corners(kind) == 0
             ? 0
             : abut_surface_longest_side(kind, nodes);
}

/* The k-th smallest of v[n] (Hoare's selection); v is reordered. */
static double
kth_smallest(double *v, int64_t n, int64_t k)
{
  int64_t low = 0, high = n - 1;
  while (low < high)
  {
    const double pivot = v[low + (high - low) / 2];
    int64_t i = low, j = high;
    while (i <= j)
    {
      while (v[i] < pivot)
        ++i;
      while (v[j] > pivot)
        --j;
      if (i > j)
        break;
      const double swap = v[i];
      v[i++] = v[j];
      v[j--] = swap;
    }
    if (k <= j)
      high = j;
    else if (k >= i)
      low = i;
    else
      break;
  }
  return v[k];
}

static void
grow_box(abut_surface_sizes *z, const double *nodes, int32_t n,
         int32_t dimension)
{
  for (int32_t a = 0; a < n; ++a)
    for (int32_t d = 0; d < dimension; ++d)
    {
      const double x = nodes[dimension * a + d];
      z->lower[d] = x < z->lower[d] ? x : z->lower[d];
      z->upper[d] = x > z->upper[d] ? x : z->upper[d];
    }
}

/* Measures of a facet, with a normal of 0 if it has none. */
static void
measure_facet(abut_facet_kind kind, const double *nodes, abut_facet_measures *m)
{
  if (abut_facet_measure(kind, nodes, m) != ABUT_SUCCESS)
    memset(m, 0, sizeof(*m));
}

static double
cosine(const double *normals, int32_t f, int32_t g)
{
  const double *const a = normals + 3 * (int64_t)f, *const b = normals
                                                               + 3 * (int64_t)g;
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

abut_status
abut_surface_features(abut_surface *surface, double angle, uint8_t *mask)
{
  if (surface == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_surface *s = surface;
  if (mask == NULL || !(angle > 0 && angle <= 3.15))
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "abut_surface_features",
                     "mask is NULL or angle is not in (0, pi]");
  const abut_status status = abut_array_reserve(
      s->context, &s->scratch, 0, 3 * (int64_t)s->view.n_facets + 1);
  if (status != ABUT_SUCCESS)
    return status;
  double *const normals = s->scratch.data;
  for (int32_t f = 0; f < s->view.n_facets; ++f)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES];
    abut_facet_measures m;
    abut_surface_gather(s, f, nodes);
    measure_facet((abut_facet_kind)s->view.kinds[f], nodes, &m);
    memcpy(normals + 3 * (int64_t)f, m.normal, sizeof(m.normal));
  }
  const double limit = cos(angle);
  for (int32_t f = 0; f < s->view.n_facets; ++f)
  {
    mask[f] = 0;
    for (int k = 0; k < 4; ++k)
    {
      const int32_t g = s->view.neighbour[4 * (int64_t)f + k];
      if (g == ABUT_NEIGHBOUR_UNUSED)
        continue;
      if (g < 0 || cosine(normals, f, g) < limit)
        mask[f] = (uint8_t)(mask[f] | 1 << k);
    }
  }
  return ABUT_SUCCESS;
}

/* Sides without neighbour, and bent sides seen from their lower facet. */
static void
count_sides(const abut_surface *s, const double *normals, abut_surface_sizes *z)
{
  const double limit = cos(s->feature_angle);
  for (int32_t f = 0; f < s->view.n_facets; ++f)
    for (int k = 0; k < 4; ++k)
    {
      const int32_t g = s->view.neighbour[4 * (int64_t)f + k];
      if (g == ABUT_NEIGHBOUR_BORDER)
        ++z->n_border_sides;
      if (g > f && cosine(normals, f, g) < limit)
        ++z->n_feature_sides;
    }
}

abut_status
abut_surface_measure_sized(abut_surface *surface, abut_surface_sizes *sizes)
{
  if (surface == NULL || sizes == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_surface *s = surface;
  const int32_t n = s->view.n_facets;
  const abut_status status =
      abut_array_reserve(s->context, &s->scratch, 0, 4 * (int64_t)n + 1);
  if (status != ABUT_SUCCESS)
    return status;
  double *const size = s->scratch.data, *const normals = size + n;
  abut_surface_sizes z = {0};
  for (int d = 0; d < 3; ++d)
  {
    z.lower[d] = d < s->view.dimension ? INFINITY : 0;
    z.upper[d] = d < s->view.dimension ? -INFINITY : 0;
  }
  for (int32_t f = 0; f < n; ++f)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES];
    abut_facet_measures m;
    const abut_facet_kind kind = (abut_facet_kind)s->view.kinds[f];
    const int32_t n_nodes = abut_surface_gather(s, f, nodes);
    measure_facet(kind, nodes, &m);
    z.area += m.area;
    memcpy(normals + 3 * (int64_t)f, m.normal, sizeof(m.normal));
    size[f] = abut_surface_longest_side(kind, nodes);
    grow_box(&z, nodes, n_nodes, s->view.dimension);
  }
  if (n > 0)
  {
    z.median = kth_smallest(size, n, n / 2);
    z.smallest = kth_smallest(size, n, 0);
    z.largest = kth_smallest(size, n, n - 1);
  }
  count_sides(s, normals, &z);
  return abut_copy_out(s->context, "abut_surface_measure", sizes, sizeof(z),
                       &z);
}

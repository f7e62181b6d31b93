/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Averaged nodal normals.
 *
 *     n_i = unit( sum_f A_f n_f )          f: facets of node i
 *     n_i = unit( sum_f alpha_fi n_fi )    where |sum A n| < cos(t/2) sum A
 *
 * with the facet's area A_f, its mean normal n_f (curved facets: the normal at
 * the node), its angle alpha_fi at the node (lines: 1) and the feature angle
 * t: two facets of equal area that meet at the angle t have |sum A n| =
 * cos(t/2) sum A. Sums run over facets in ascending order. O(n). */
#include "geometry/kernels.h"
#include "geometry/surface.h"

#include <math.h>

static void
cross(const double *a, const double *b, double *c)
{
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

static double
norm(const double *a)
{
  return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/* Area vector of a facet with straight sides; false for curved kinds. */
static bool
straight_area_vector(abut_facet_kind kind, const double *x, double *area)
{
  double a[3], b[3];
  switch (kind)
  {
  case ABUT_FACET_LINE2:
    area[0] = x[3] - x[1];
    area[1] = x[0] - x[2];
    area[2] = 0;
    return true;
  case ABUT_FACET_TRI3:
    for (int d = 0; d < 3; ++d)
    {
      a[d] = 0.5 * (x[3 + d] - x[d]);
      b[d] = x[6 + d] - x[d];
    }
    break;
  case ABUT_FACET_QUAD4:
    for (int d = 0; d < 3; ++d)
    {
      a[d] = 0.5 * (x[9 + d] - x[d]);
      b[d] = x[6 + d] - x[3 + d];
    }
    break;
  default:
    return false;
  }
  cross(a, b, area);
  return true;
}

/* Normals of a facet at its nodes, times its area: out[3 * a + d]. */
static void
node_area_vectors(abut_facet_kind kind, const double *x, int32_t n,
                  double *area, double *out)
{
  double v[3];
  if (straight_area_vector(kind, x, v))
  {
    *area = norm(v);
    for (int32_t a = 0; a < n; ++a)
      for (int d = 0; d < 3; ++d)
        out[3 * a + d] = v[d];
    return;
  }
  abut_facet_measures m;
  *area = abut_facet_measure(kind, x, &m) == ABUT_SUCCESS ? m.area : 0;
  for (int32_t a = 0; a < n; ++a)
  {
    double normal[3] = {0, 0, 0};
    (void)abut_facet_point(kind, x, abut_facet_node_local(kind, a), NULL,
                           normal);
    for (int d = 0; d < 3; ++d)
      out[3 * a + d] = *area * normal[d];
  }
}

/* sum[4 * i] = sum of area vectors, and of areas. The one hot loop: surfaces
 * of four-node quadrilaterals go through it without calls. */
static void
add_area_vectors(const abut_surface *s, double *restrict sum)
{
  double x[3 * ABUT_FACET_MAX_NODES], v[3 * ABUT_FACET_MAX_NODES], area;
  for (int32_t f = 0; f < s->view.n_facets; ++f)
  {
    const int32_t *c = s->view.connectivity + s->view.facet_start[f];
    const int32_t n = abut_surface_gather(s, f, x);
    node_area_vectors((abut_facet_kind)s->view.kinds[f], x, n, &area, v);
    for (int32_t a = 0; a < n; ++a)
    {
      double *to = sum + 4 * (int64_t)c[a];
      to[0] += v[3 * a];
      to[1] += v[3 * a + 1];
      to[2] += v[3 * a + 2];
      to[3] += area;
    }
  }
}

static void
add_quad4_area_vectors(const abut_surface *s, double *restrict sum)
{
  const int32_t *c = s->view.connectivity;
  const double *p = s->view.position;
  for (int32_t f = 0; f < s->view.n_facets; ++f, c += 4)
  {
    /* Numbers of nodes may lead anywhere. */
    if (f + 8 < s->view.n_facets)
      for (int k = 32; k < 36; ++k)
      {
        __builtin_prefetch(p + 3 * (int64_t)c[k]);
        __builtin_prefetch(sum + 4 * (int64_t)c[k], 1);
      }
    const double *x0 = p + 3 * (int64_t)c[0], *x1 = p + 3 * (int64_t)c[1];
    const double *x2 = p + 3 * (int64_t)c[2], *x3 = p + 3 * (int64_t)c[3];
    double a[3], b[3], v[4];
    for (int d = 0; d < 3; ++d)
    {
      a[d] = 0.5 * (x3[d] - x0[d]);
      b[d] = x2[d] - x1[d];
    }
    cross(a, b, v);
    v[3] = norm(v);
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < 4; ++d)
        sum[4 * (int64_t)c[k] + d] += v[d];
  }
}

double
abut_surface_angle(const abut_surface *s, int32_t f, int32_t i, const double *x)
{
  const int32_t *c = s->view.connectivity + s->view.facet_start[f];
  const int32_t n = abut_facet_n_corners((abut_facet_kind)s->view.kinds[f]);
  if (n == 2)
    return 1;
  for (int32_t k = 0; k < n; ++k)
  {
    const int32_t at = abut_facet_loop(n, k);
    if (c[at] != i)
      continue;
    const int32_t next = abut_facet_loop(n, k + 1);
    const int32_t last = abut_facet_loop(n, k + n - 1);
    double a[3], b[3], v[3], dot = 0;
    for (int d = 0; d < 3; ++d)
    {
      a[d] = x[3 * next + d] - x[3 * at + d];
      b[d] = x[3 * last + d] - x[3 * at + d];
      dot += a[d] * b[d];
    }
    cross(a, b, v);
    return atan2(norm(v), dot);
  }
  return 3.14159265358979323846;
}

void
abut_surface_angle_weighted(const abut_surface *s, int32_t i, double *sum)
{
  double x[3 * ABUT_FACET_MAX_NODES], v[3 * ABUT_FACET_MAX_NODES], area;
  sum[0] = sum[1] = sum[2] = 0;
  for (int32_t e = s->view.node_start[i]; e < s->view.node_start[i + 1]; ++e)
  {
    const int32_t f = s->view.node_facet[e];
    const int32_t *c = s->view.connectivity + s->view.facet_start[f];
    const int32_t n = abut_surface_gather(s, f, x);
    node_area_vectors((abut_facet_kind)s->view.kinds[f], x, n, &area, v);
    int32_t a = 0;
    while (c[a] != i)
      ++a;
    const double weight = area > 0 ? abut_surface_angle(s, f, i, x) / area : 0;
    for (int d = 0; d < 3; ++d)
      sum[d] += weight * v[3 * a + d];
  }
}

abut_status
abut_surface_normals(abut_surface *surface, const double **normal)
{
  if (surface == NULL || normal == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_surface *s = surface;
  const int32_t dimension = s->view.dimension;
  const int64_t n = s->view.n_nodes;
  abut_status status =
      abut_array_reserve(s->context, &s->normal, 0, n * dimension + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &s->scratch, 0, 4 * n + 1);
  if (status != ABUT_SUCCESS)
    return status;
  double *out = s->normal.data;
  *normal = out;
  if (s->normals_revision == s->revision)
    return ABUT_SUCCESS;
  double *sum = s->scratch.data;
  for (int64_t i = 0; i < 4 * n; ++i)
    sum[i] = 0;
  if (s->uniform_kind == ABUT_FACET_QUAD4)
    add_quad4_area_vectors(s, sum);
  else
    add_area_vectors(s, sum);
  const double smooth = cos(0.5 * s->feature_angle);
  for (int32_t i = 0; i < s->view.n_nodes; ++i)
  {
    double *v = sum + 4 * (int64_t)i;
    double length = norm(v);
    if (length < smooth * v[3])
    {
      abut_surface_angle_weighted(s, i, v);
      length = norm(v);
    }
    const double scale = length > 0 ? 1 / length : 0;
    for (int32_t d = 0; d < dimension; ++d)
      out[(int64_t)dimension * i + d] = scale * v[d];
  }
  s->normals_revision = s->revision;
  return ABUT_SUCCESS;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Facets as linear parts, and their common area. */
#include "geometry/clip.h"
#include "geometry/kernels.h"
#include "geometry/vector.h"

/* Corners of each part, walked around. */
static const int8_t line3_part[2][4] = {{0, 2}, {2, 1}};
static const int8_t tri6_part[4][4] = {
    {0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
static const int8_t quad9_part[4][4] = {
    {0, 6, 8, 4}, {6, 1, 5, 8}, {4, 8, 7, 2}, {8, 5, 3, 7}};
static const int8_t linear_part[4] = {0, 1, 2, 3}, quad4_part[4] = {0, 1, 3, 2};

int
abut_facet_n_parts(abut_facet_kind kind)
{
  switch (kind)
  {
  case ABUT_FACET_LINE3:
    return 2;
  case ABUT_FACET_TRI6:
  case ABUT_FACET_QUAD9:
    return 4;
  case ABUT_FACET_LINE2:
  case ABUT_FACET_TRI3:
  case ABUT_FACET_QUAD4:
  case ABUT_FACET_N_KINDS:
    break;
  }
  return 1;
}

const int8_t *
abut_facet_part_corners(abut_facet_kind kind, int part)
{
  return kind == ABUT_FACET_LINE3   ? line3_part[part]
         : kind == ABUT_FACET_TRI6  ? tri6_part[part]
         : kind == ABUT_FACET_QUAD9 ? quad9_part[part]
         : kind == ABUT_FACET_QUAD4 ? quad4_part
                                    : linear_part;
}

void
abut_facet_part(abut_facet_kind kind, const double *nodes, int part,
                abut_part *result)
{
  const int dim = abut_facet_dimension(kind);
  const int8_t *corner = abut_facet_part_corners(kind, part);
  result->n = abut_facet_n_corners(kind);
  for (int a = 0; a < result->n; ++a)
    for (int d = 0; d < 3; ++d)
      result->x[a][d] = d < dim ? nodes[dim * corner[a] + d] : 0.;
}

double
abut_part_area(const abut_part *part, double *normal)
{
  double u[3], v[3];
  if (part->n == 2)
  {
    sub3(part->x[1], part->x[0], u);
    normal[0] = u[1];
    normal[1] = -u[0];
    normal[2] = 0.;
    return unit3(normal, ABUT_TINY);
  }
  /* Half the product of the diagonals; a triangle's second ends at its third
   * corner. */
  sub3(part->x[2], part->x[0], u);
  sub3(part->x[part->n - 1], part->x[1], v);
  cross3(u, v, normal);
  return 0.5 * unit3(normal, ABUT_TINY);
}

static double
common_length(const abut_part *s, const abut_part *m)
{
  double normal[3], a[4], b[4], normals[4];
  abut_part_area(s, normal);
  for (int i = 0; i < 4; ++i)
  {
    a[i] = s->x[i / 2][i % 2];
    b[i] = m->x[i / 2][i % 2];
    normals[i] = normal[i % 2];
  }
  abut_clip2 clip;
  return abut_clip2_segments(a, b, normals, &clip) ? clip.length : 0.;
}

/* Triangle number `which` of a quadrilateral cut from corner `first`. */
static void
half(const abut_part *quad, int first, int which, abut_part *triangle)
{
  triangle->n = 3;
  for (int a = 0; a < 3; ++a)
    for (int d = 0; d < 3; ++d)
      triangle->x[a][d] = quad->x[(first + a + 2 * which) % 4][d];
}

/* The two triangles' areas add up to less if the diagonal lies within. */
int
abut_part_diagonal(const abut_part *quad)
{
  double area[2] = {0., 0.}, n[3];
  for (int first = 0; first < 2; ++first)
    for (int which = 0; which < 2; ++which)
    {
      abut_part triangle;
      half(quad, first, which, &triangle);
      area[first] += abut_part_area(&triangle, n);
    }
  return area[1] < area[0];
}

/* A quadrilateral as two triangles; a triangle stays as it is. */
static int
triangles(const abut_part *part, abut_part *result)
{
  if (part->n < 4)
  {
    result[0] = *part;
    return 1;
  }
  const int first = abut_part_diagonal(part);
  half(part, first, 0, &result[0]);
  half(part, first, 1, &result[1]);
  return 2;
}

static double
common_polygon_area(const abut_part *s, const abut_part *m)
{
  double normal[3], origin[3] = {0., 0., 0.};
  if (!(abut_part_area(s, normal) > 0.))
    return 0.;
  for (int a = 0; a < s->n; ++a)
    axpy3(origin, 1. / s->n, s->x[a], origin);
  abut_clip3 clip;
  const abut_clip_result result = abut_clip3_parts(s, m, origin, normal, &clip);
  if (result != ABUT_CLIP_NOT_CONVEX)
    return clip.area;
  abut_part u[2], v[2];
  const int n_u = triangles(s, u), n_v = triangles(m, v);
  double area = 0.;
  for (int i = 0; i < n_u; ++i)
    for (int j = 0; j < n_v; ++j)
    {
      abut_clip3_parts(&u[i], &v[j], origin, normal, &clip);
      area += clip.area;
    }
  return area;
}

double
abut_facet_common_area(abut_facet_kind secondary_kind, const double *secondary,
                       abut_facet_kind primary_kind, const double *primary)
{
  double area = 0.;
  const int dim = abut_facet_dimension(secondary_kind);
  for (int i = 0; i < abut_facet_n_parts(secondary_kind); ++i)
  {
    abut_part s = {0};
    abut_facet_part(secondary_kind, secondary, i, &s);
    for (int j = 0; j < abut_facet_n_parts(primary_kind); ++j)
    {
      abut_part m = {0};
      abut_facet_part(primary_kind, primary, j, &m);
      area += dim == 2 ? common_length(&s, &m) : common_polygon_area(&s, &m);
    }
  }
  return area;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Linear patches. All components of a patch are bilinear in two coordinates s,
 * t, so that its projection is inverted by Newton's method on two of them and
 * the others are read off. */
#include "geometry/linear_patch.h"
#include "geometry/kernels.h"
#include "geometry/surface.h"
#include "geometry/vector.h"

#include <string.h>

enum
{
  MOST_STEPS = 30,
  FAR_OUTSIDE = 20 /* coordinates of another branch of the map */
};

static int
n_corners(const abut_linear_patch *p)
{
  return p->kind == ABUT_FACET_QUAD4 ? 4 : 3;
}

/* Corners walked around, for clipping. */
void
abut_linear_patch_walk(const abut_linear_patch *p, abut_part *part)
{
  part->n = n_corners(p);
  for (int k = 0; k < part->n; ++k)
    memcpy(part->x[k], p->x[abut_facet_loop(part->n, k)], sizeof(part->x[k]));
}

/* Quarter number `which` of the reference square. */
static void
quarter(const double *nodes, int which, abut_linear_patch *p)
{
  p->kind = ABUT_FACET_QUAD4;
  for (int k = 0; k < 4; ++k)
  {
    abut_shape shape;
    p->local[k][0] = (k & 1) + (which & 1) - 1.;
    p->local[k][1] = (k >> 1) + (which >> 1) - 1.;
    abut_shape3(p->kind, p->local[k][0], p->local[k][1], &shape);
    for (int d = 0; d < 3; ++d)
    {
      p->x[k][d] = 0.;
      for (int a = 0; a < 4; ++a)
        p->x[k][d] += shape.n[a] * nodes[3 * a + d];
    }
  }
}

static void
part_patch(abut_facet_kind kind, const double *nodes, int which,
           abut_linear_patch *p)
{
  const int8_t *corner = abut_facet_part_corners(kind, which);
  const int n = abut_facet_n_corners(kind);
  p->kind = n == 4 ? ABUT_FACET_QUAD4 : ABUT_FACET_TRI3;
  for (int k = 0; k < n; ++k)
  {
    const int to = abut_facet_loop(n, k), from = corner[k];
    memcpy(p->x[to], nodes + 3 * from, sizeof(p->x[to]));
    memcpy(p->local[to], abut_facet_node_local(kind, from),
           sizeof(p->local[to]));
  }
}

int
abut_linear_patches(abut_facet_kind kind, const double *nodes, int split,
                    abut_linear_patch *patches)
{
  if (split)
  {
    for (int i = 0; i < 4; ++i)
      quarter(nodes, i, patches + i);
    return 4;
  }
  const int n = abut_facet_n_parts(kind);
  for (int i = 0; i < n; ++i)
    part_patch(kind, nodes, i, patches + i);
  return n;
}

/* Coefficients of one component from its values at the corners. */
static void
set_map(abut_facet_kind kind, const double *value, double *map)
{
  if (kind == ABUT_FACET_TRI3)
  {
    map[0] = value[0];
    map[1] = value[1] - value[0];
    map[2] = value[2] - value[0];
    map[3] = 0.;
    return;
  }
  const double a = value[0], b = value[1], c = value[2], d = value[3];
  map[0] = 0.25 * (a + b + c + d);
  map[1] = 0.25 * ((b - a) + (d - c));
  map[2] = 0.25 * ((c - a) + (d - b));
  map[3] = 0.25 * ((d - c) - (b - a));
}

static void
set_maps(abut_linear_patch *p)
{
  for (int i = 0; i < 7; ++i)
  {
    double value[4];
    for (int k = 0; k < n_corners(p); ++k)
      value[k] = i < 2   ? p->flat[2 * k + i]
                 : i < 4 ? p->local[k][i - 2]
                         : p->x[k][i - 4];
    set_map(p->kind, value, p->map[i]);
  }
}

void
abut_linear_patch_flatten(abut_linear_patch *p, const double *origin,
                          double (*e)[3])
{
  for (int k = 0; k < n_corners(p); ++k)
  {
    double r[3];
    sub3(p->x[k], origin, r);
    p->flat[2 * k] = dot3(r, e[0]);
    p->flat[2 * k + 1] = dot3(r, e[1]);
  }
  set_maps(p);
}

/* The triangles of a patch in the plane; a triangle is its own. */
int
abut_linear_patch_triangles(const abut_linear_patch *p,
                            abut_linear_patch *result)
{
  if (p->kind == ABUT_FACET_TRI3)
  {
    *result = *p;
    return 1;
  }
  abut_part flat = {.n = 4};
  for (int k = 0; k < 4; ++k)
    for (int d = 0; d < 2; ++d)
      flat.x[k][d] = p->flat[2 * abut_facet_loop(4, k) + d];
  const int first = abut_part_diagonal(&flat);
  for (int i = 0; i < 2; ++i)
  {
    result[i].kind = ABUT_FACET_TRI3;
    for (int k = 0; k < 3; ++k)
    {
      const int from = abut_facet_loop(4, (first + 2 * i + k) % 4);
      memcpy(result[i].x[k], p->x[from], sizeof(p->x[0]));
      memcpy(result[i].local[k], p->local[from], sizeof(p->local[0]));
      memcpy(result[i].flat + 2 * k, p->flat + 2 * from, 2 * sizeof(double));
    }
    set_maps(&result[i]);
  }
  return 2;
}

static double
map_value(const double *m, double s, double t)
{
  return m[0] + m[1] * s + m[2] * t + m[3] * s * t;
}

/* Determinant of the derivatives of components i and i + 1. */
static double
map_determinant(const abut_linear_patch *p, int i, double s, double t)
{
  const double *u = p->map[i], *v = p->map[i + 1];
  return (u[1] + u[3] * t) * (v[2] + v[3] * s)
         - (u[2] + u[3] * s) * (v[1] + v[3] * t);
}

/* Local coordinates of a patch over a point of the plane: Newton's method from
 * its centre, which converges in convex quadrilaterals; one step for triangles
 * and parallelograms. */
static int
invert(const abut_linear_patch *p, const double *uv, double *st)
{
  const double *u = p->map[0], *v = p->map[1];
  double s = p->kind == ABUT_FACET_TRI3 ? 1. / 3. : 0., t = s;
  for (int k = 0; k < MOST_STEPS; ++k)
  {
    const double r = map_value(u, s, t) - uv[0], q = map_value(v, s, t) - uv[1],
                 determinant = map_determinant(p, 0, s, t);
    if (determinant == 0.)
      return 0;
    const double ds = (r * (v[2] + v[3] * s) - q * (u[2] + u[3] * s))
                      / determinant,
                 dt = (q * (u[1] + u[3] * t) - r * (v[1] + v[3] * t))
                      / determinant;
    s -= ds;
    t -= dt;
    if (!(fabs(s) + fabs(t) < FAR_OUTSIDE))
      return 0;
    st[0] = s;
    st[1] = t;
    const double length = fabs(ds) + fabs(dt);
    if (length <= 1e-14 || (k > 4 && length <= 1e-11))
      return 1;
  }
  return 0;
}

/* Place on a patch over a point of the plane: local coordinates on the facet
 * and position; ratio: area of local coordinates by area of the plane. */
int
abut_linear_patch_lift(const abut_linear_patch *p, const double *uv,
                       double *local, double *x, double *ratio)
{
  double st[2];
  if (!invert(p, uv, st))
    return 0;
  for (int d = 0; d < 2; ++d)
    local[d] = map_value(p->map[2 + d], st[0], st[1]);
  for (int d = 0; d < 3; ++d)
    x[d] = map_value(p->map[4 + d], st[0], st[1]);
  if (ratio != NULL)
    *ratio = fabs(map_determinant(p, 2, st[0], st[1])
                  / map_determinant(p, 0, st[0], st[1]));
  return 1;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Points that move, against the nearest point of the primary surface: the gap
 * is the signed distance, with its first and second derivatives by the point
 * and by the nodes of the facet.
 *
 * Where the nearest point is on an edge or a corner with facets around it, the
 * gap is the distance to that, and the pseudonormal decides the side. Where the
 * surface ends, its own normal is all that is known of the body behind: the
 * facet is continued beyond its border. Points nearer than round-off to an edge
 * have no direction from there: they get that of the facet. */
#include "contact/coupling.h"
#include "geometry/kernels.h"
#include "geometry/pseudonormal.h"
#include "geometry/vector.h"

#include <string.h>

/* Part of a facet's size below which a distance has no direction. */
static const double no_distance = 1e-9;

/* Local coordinates at the most of a facet that is continued; the facets
 * themselves end at 1. */
static const double farthest = 2.;

enum
{
  MAX_STEPS = 30
};

/* A facet continued beyond its sides. */
typedef struct continued
{
  int dim, n;
  abut_facet_kind kind;
  const double *nodes, *x;
  double r[3];         /* x - y */
  double t[2][3];      /* y,i */
  double second[3][3]; /* y,ij: 11, 22, 12 */
} continued;

static void
evaluate(continued *f, const double *local)
{
  abut_shape s;
  double y[3] = {0., 0., 0.};
  if (f->dim == 2)
    abut_shape2(f->kind, local[0], &s);
  else
    abut_shape3(f->kind, local[0], local[1], &s);
  memset(f->t, 0, sizeof(f->t));
  memset(f->second, 0, sizeof(f->second));
  memset(f->r, 0, sizeof(f->r));
  for (int d = 0; d < f->dim; ++d)
  {
    for (int a = 0; a < f->n; ++a)
    {
      /* The derivatives of all shape functions add up to zero. */
      const double from_first = f->nodes[a * f->dim + d] - f->nodes[d];
      y[d] += s.n[a] * from_first;
      for (int i = 0; i < f->dim - 1; ++i)
        f->t[i][d] += s.d[i][a] * from_first;
      for (int i = 0; i < (f->dim == 2 ? 1 : 3); ++i)
        f->second[i][d] += s.dd[i][a] * from_first;
    }
    f->r[d] = (f->x[d] - f->nodes[d]) - y[d];
  }
}

/* One step of Newton's method for r . y,i = 0; false where there is no
 * minimum. */
static bool
step(const continued *f, double *local, double *length)
{
  double h[3], force[2] = {dot3(f->r, f->t[0]), 0.};
  h[0] = dot3(f->t[0], f->t[0]) - dot3(f->r, f->second[0]);
  if (f->dim == 2)
  {
    if (!(h[0] > 0.))
      return false;
    local[0] += force[0] / h[0];
    *length = fabs(force[0] / h[0]);
    return true;
  }
  force[1] = dot3(f->r, f->t[1]);
  h[1] = dot3(f->t[1], f->t[1]) - dot3(f->r, f->second[1]);
  h[2] = dot3(f->t[0], f->t[1]) - dot3(f->r, f->second[2]);
  const double det = h[0] * h[1] - h[2] * h[2];
  if (!(h[0] > 0. && det > 1e-13 * h[0] * h[1]))
    return false;
  const double d[2] = {(h[1] * force[0] - h[2] * force[1]) / det,
                       (h[0] * force[1] - h[2] * force[0]) / det};
  local[0] += d[0];
  local[1] += d[1];
  *length = max2(fabs(d[0]), fabs(d[1]));
  return true;
}

/* Make a projection that of the facet continued beyond its sides; false where
 * that has no nearest point. */
static bool
continue_facet(const abut_surface *surface, int32_t facet, const double *nodes,
               const double *x, abut_projection *p)
{
  continued f;
  double length = INFINITY;
  memset(&f, 0, sizeof(f));
  f.kind = (abut_facet_kind)surface->view.kinds[facet];
  f.dim = surface->view.dimension;
  f.n = abut_facet_n_nodes(f.kind);
  f.nodes = nodes;
  f.x = x;
  for (int k = 0; k < MAX_STEPS && length > 1e-14; ++k)
  {
    evaluate(&f, p->local);
    if (!step(&f, p->local, &length) || fabs(p->local[0]) > farthest
        || fabs(p->local[1]) > farthest)
      return false;
  }
  evaluate(&f, p->local);
  abut_coupling_normal(f.kind, nodes, p->local, p->normal);
  p->gap = dot3(p->normal, f.r);
  p->distance = norm3(f.r);
  for (int d = 0; d < f.dim; ++d)
    p->point[d] = x[d] - f.r[d];
  p->inside = 1;
  return length <= 1e-8;
}

/* Make the derivatives of the gap at a projection. */
static abut_status
differentiate(const abut_coupling *c, int32_t facet, const double *nodes,
              const double *x, abut_projection *p, double *gradient,
              double *hessian)
{
  const abut_facet_kind kind = (abut_facet_kind)c->primary->view.kinds[facet];
  const double size = abut_surface_longest_side(kind, nodes);
  double side = 1.;
  if (!p->inside && p->distance <= no_distance * size)
    p->inside = 1;
  if (!p->inside)
  {
    side = abut_side_of(c->primary, facet, x, p);
    p->gap = side * p->distance;
  }
  return abut_facet_distance_derivatives(kind, nodes, x, p, side, gradient,
                                         hessian);
}

abut_status
abut_coupling_follow(abut_coupling *c, int32_t primary, const double *x,
                     bool *found, abut_coupling_opposite *opposite)
{
  const abut_facet_kind kind = (abut_facet_kind)c->primary->view.kinds[primary];
  const int64_t dim = c->view.dimension, n_nodes = abut_facet_n_nodes(kind),
                n = dim * (1 + n_nodes);
  double nodes[3 * ABUT_FACET_MAX_NODES],
      gradient[3 * (1 + ABUT_FACET_MAX_NODES)];
  abut_projection p;
  *found = false;
  abut_surface_gather(c->primary, primary, nodes);
  abut_project(kind, nodes, x, &p);
  if (abut_beyond_border(c->primary, primary, &p)
      && !continue_facet(c->primary, primary, nodes, x, &p))
    return ABUT_SUCCESS;
  abut_status status =
      abut_array_reserve(c->context, &c->answer.hessian, c->answer.n_hessian,
                         c->answer.n_hessian + n * n);
  if (status != ABUT_SUCCESS)
    return status;
  status =
      differentiate(c, primary, nodes, x, &p, gradient,
                    (double *)c->answer.hessian.data + c->answer.n_hessian);
  if (status == ABUT_UNSUPPORTED) /* at a centre of curvature, no normal */
    return ABUT_SUCCESS;
  if (status != ABUT_SUCCESS)
    return abut_fail(c->context, status, "abut_coupling_build",
                     "the nearest point of a facet is not finite");
  memset(opposite, 0, sizeof(*opposite));
  opposite->gap = p.gap;
  opposite->hessian = c->answer.n_hessian;
  abut_coupling_shape(kind, nodes, p.local, opposite->shape, NULL);
  for (int d = 0; d < dim; ++d)
    opposite->normal[d] = -gradient[d];
  c->answer.n_hessian += n * n;
  *found = true;
  return ABUT_SUCCESS;
}

/* Square of the distance of x to the box of nodes. */
static double
box_distance(int dim, int n, const double *nodes, const double *x)
{
  double square = 0.;
  for (int d = 0; d < dim; ++d)
  {
    double low = INFINITY, high = -INFINITY;
    for (int a = 0; a < n; ++a)
    {
      low = min2(low, nodes[a * dim + d]);
      high = max2(high, nodes[a * dim + d]);
    }
    const double out = max2(0., max2(low - x[d], x[d] - high));
    square += out * out;
  }
  return square;
}

/* The nearest point to a point of the secondary: among the candidates, and of
 * the borders that it lies beyond. */
typedef struct nearest
{
  double least, border;
  int32_t facet; /* -1: none */
  bool inside;
} nearest;

/* Whether a facet's nearest point can be that of a point of the secondary.
 * Where the border is nearer it cannot be on the edge of a facet behind. */
static bool
suits(const abut_coupling *c, const abut_coupling_facet *facet, int32_t m,
      double size, const abut_projection *p, nearest *n)
{
  const double extension = abut_detection_defaults().extension * size;
  const double overshoot = p->distance * p->distance - p->gap * p->gap;
  if (!(dot3(p->normal, facet->normal) <= c->options.normal_cosine)
      || !abut_coupling_in_reach(c, p->gap < 0. ? -p->distance : p->distance,
                                 size))
    return false;
  if (overshoot > extension * extension && abut_beyond_border(c->primary, m, p))
  {
    n->border = min2(n->border, p->distance);
    return false;
  }
  return p->inside || p->distance <= n->border;
}

static void
scan(const abut_coupling *c, const abut_coupling_facet *facet,
     int32_t n_candidates, const double *x, nearest *found)
{
  const int32_t *candidate = c->work.candidates.data;
  found->least = INFINITY;
  found->facet = -1;
  for (int32_t k = 0; k < n_candidates; ++k)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES];
    const int32_t m = candidate[k];
    const abut_facet_kind kind = (abut_facet_kind)c->primary->view.kinds[m];
    const int32_t n = abut_surface_gather(c->primary, m, nodes);
    const double size = abut_surface_longest_side(kind, nodes);
    /* Curved facets bulge out of the box of their nodes. */
    const double bulge = n > abut_facet_n_corners(kind) ? size : 0.;
    if (found->facet >= 0
        && box_distance(c->view.dimension, n, nodes, x)
               > (found->least + bulge) * (found->least + bulge))
      continue;
    abut_projection p;
    abut_project(kind, nodes, x, &p);
    if (!(p.distance < found->least) || !suits(c, facet, m, size, &p, found))
      continue;
    found->least = p.distance;
    found->facet = m;
    found->inside = p.inside;
  }
}

/* The candidate with the nearest point, or -1. */
static int32_t
nearest_facet(const abut_coupling *c, const abut_coupling_facet *facet,
              int32_t n_candidates, const double *x)
{
  nearest found = {INFINITY, INFINITY, -1, false};
  do
    scan(c, facet, n_candidates, x, &found);
  while (found.facet >= 0 && !found.inside && found.least > found.border);
  return found.facet;
}

static abut_status
follow_point(abut_coupling *c, const abut_coupling_facet *facet,
             int32_t n_candidates, abut_coupling_point *p)
{
  abut_coupling_opposite opposite;
  bool found = false;
  const int32_t m = nearest_facet(c, facet, n_candidates, p->position);
  const abut_status status =
      m < 0 ? ABUT_SUCCESS
            : abut_coupling_follow(c, m, p->position, &found, &opposite);
  if (status != ABUT_SUCCESS || !found)
    return status;
  p->primary = m;
  p->hessian = opposite.hessian;
  p->distance = opposite.gap;
  memcpy(p->normal, opposite.normal, sizeof(p->normal));
  memcpy(p->opposite, opposite.shape, sizeof(p->opposite));
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_near(abut_coupling *c, const abut_coupling_facet *facet,
                   bool final)
{
  int32_t n_candidates, n = 0;
  abut_status status =
      abut_coupling_find_candidates(c, facet->index, &n_candidates);
  if (status == ABUT_SUCCESS)
    status = abut_coupling_whole(c, facet);
  abut_coupling_point *points = c->work.points.data;
  for (int32_t q = 0; q < c->work.n_points && status == ABUT_SUCCESS; ++q)
  {
    status = follow_point(c, facet, n_candidates, points + q);
    if (points[q].primary >= 0)
      points[n++] = points[q];
  }
  c->work.n_points = n;
  c->statistics.n_pairs += final ? n : 0;
  return status;
}

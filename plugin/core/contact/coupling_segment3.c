/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Integration over the common polygons of two surfaces (Puso and Laursen,
 * Comput. Methods Appl. Mech. Engrg. 193 (2004) 601; quadratic facets: Puso,
 * Laursen and Solberg, ibid. 197 (2008) 555).
 *
 * Each facet is cut into linear patches: quadratic facets along their middle
 * nodes, secondary quadrilaterals warped by more than 20 degrees at their
 * middle. For each pair
 *
 *   1  the plane of the secondary patch: its centre and mean normal (for
 *      quadrature points the whole facet's)
 *   2  both patches projected into it, and clipped
 *   3  the polygon cut into triangles, a rule on each of them
 *   4  points taken back along the normal to both patches, and from there to
 *      the parameters of the facets, at which shape functions and positions
 *      are evaluated
 *
 * Areas are those of the secondary facet: da = |X,xi x X,eta| dxi deta with
 * dxi deta from the plane by the derivatives of the projection. Where facets
 * that share no node cover one spot, the nearest has it and the polygons of
 * the others are cut back. O(pairs), and the square of the pairs of one patch
 * for the boxes of its polygons. */
#include "contact/coupling.h"
#include "geometry/linear_patch.h"
#include "geometry/pull_back.h"
#include "geometry/quadrature.h"
#include "geometry/vector.h"

#include <string.h>

enum
{
  MAX_FRAGMENTS = 64
};

static const double split_warping = 0.349;      /* radian: 20 degrees */
static const double smallest_overlap = 1e-6;    /* of the smaller polygon */
static const double largest_area_ratio = 1000.; /* of facet by plane */

typedef struct segment
{
  abut_linear_patch s, m;
  abut_clip3 polygon;
  int32_t primary;
} segment;

/* A pair of patches, with what it is part of. */
typedef struct work
{
  abut_coupling *c;
  const abut_coupling_facet *facet;
  const abut_linear_patch *plane; /* that the normal is of */
  double origin[3], normal[3], e[2][3];
  int32_t n; /* segments */
} work;

/* Gap along the normal over a point of the plane. */
static int
gap_at(const work *w, const segment *g, const double *uv, double *gap)
{
  double local[2], x[3], y[3], r[3];
  if (!abut_linear_patch_lift(&g->s, uv, local, x, NULL)
      || !abut_linear_patch_lift(&g->m, uv, local, y, NULL))
    return 0;
  sub3(y, x, r);
  *gap = dot3(r, w->normal);
  return 1;
}

/* Keep the common polygon of two patches if it is within reach. */
static abut_status
keep(work *w, const segment *g, double size)
{
  double gap;
  if (!gap_at(w, g, g->polygon.centroid, &gap)
      || !abut_coupling_in_reach(w->c, gap, size))
    return ABUT_SUCCESS;
  const abut_status status = abut_array_reserve(
      w->c->context, &w->c->work.segments, w->n, (int64_t)w->n + 1);
  if (status == ABUT_SUCCESS)
    ((segment *)w->c->work.segments.data)[w->n++] = *g;
  return status;
}

/* Common polygons of the secondary patch with one of a primary facet. */
static abut_status
intersect(work *w, const abut_linear_patch *s, const abut_linear_patch *m,
          int32_t primary, double size)
{
  abut_part a, b;
  double normal[3];
  segment g = {.s = *s, .m = *m, .primary = primary};
  abut_linear_patch_walk(s, &a);
  abut_linear_patch_walk(m, &b);
  abut_part_area(&b, normal);
  if (!(dot3(normal, w->normal) <= w->c->options.normal_cosine))
    return ABUT_SUCCESS;
  abut_linear_patch_flatten(&g.m, w->origin, w->e);
  const abut_clip_result result =
      abut_clip3_parts(&a, &b, w->origin, w->normal, &g.polygon);
  if (result == ABUT_CLIP_EMPTY)
    return ABUT_SUCCESS;
  if (result == ABUT_CLIP_POLYGON)
    return keep(w, &g, size);
  abut_linear_patch u[2], v[2];
  const int n_u = abut_linear_patch_triangles(s, u),
            n_v = abut_linear_patch_triangles(&g.m, v);
  for (int i = 0; i < n_u; ++i)
    for (int k = 0; k < n_v; ++k)
    {
      g.s = u[i];
      g.m = v[k];
      abut_linear_patch_walk(&u[i], &a);
      abut_linear_patch_walk(&v[k], &b);
      if (abut_clip3_parts(&a, &b, w->origin, w->normal, &g.polygon)
          != ABUT_CLIP_POLYGON)
        continue;
      const abut_status status = keep(w, &g, size);
      if (status != ABUT_SUCCESS)
        return status;
    }
  return ABUT_SUCCESS;
}

/* All common polygons of a secondary patch. */
static abut_status
collect(work *w, const abut_linear_patch *s, int32_t n_candidates)
{
  const int32_t *candidate = w->c->work.candidates.data;
  w->n = 0;
  for (int32_t k = 0; k < n_candidates; ++k)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES];
    abut_linear_patch m[ABUT_MAX_LINEAR_PATCHES];
    const abut_facet_kind kind =
        (abut_facet_kind)w->c->primary->view.kinds[candidate[k]];
    abut_surface_gather(w->c->primary, candidate[k], nodes);
    const double size = abut_surface_longest_side(kind, nodes);
    const int n = abut_linear_patches(kind, nodes, false, m);
    for (int i = 0; i < n; ++i)
    {
      const abut_status status = intersect(w, s, &m[i], candidate[k], size);
      if (status != ABUT_SUCCESS)
        return status;
    }
  }
  return ABUT_SUCCESS;
}

static void
box_of(const abut_clip3 *p, double *lower, double *upper)
{
  for (int d = 0; d < 2; ++d)
  {
    lower[d] = upper[d] = p->vertex[0][d];
    for (int i = 1; i < p->n; ++i)
    {
      lower[d] = min2(lower[d], p->vertex[i][d]);
      upper[d] = max2(upper[d], p->vertex[i][d]);
    }
  }
}

/* Whether the boxes of two polygons overlap by more than round-off. */
static bool
boxes_overlap(const abut_clip3 *p, const abut_clip3 *q)
{
  double a[2], b[2], u[2], v[2];
  box_of(p, a, b);
  box_of(q, u, v);
  for (int d = 0; d < 2; ++d)
  {
    const double overlap = min2(b[d], v[d]) - max2(a[d], u[d]);
    if (!(overlap > smallest_overlap * min2(b[d] - a[d], v[d] - u[d])))
      return false;
  }
  return true;
}

static bool
share_node(const abut_surface_view *v, int32_t f, int32_t g)
{
  for (int32_t e = v->facet_start[f]; e < v->facet_start[f + 1]; ++e)
    for (int32_t k = v->facet_start[g]; k < v->facet_start[g + 1]; ++k)
      if (v->connectivity[e] == v->connectivity[k])
        return true;
  return false;
}

/* Whether segment j has the spot that it shares with segment i. */
static bool
is_before(const work *w, int32_t j, int32_t i)
{
  const segment *list = w->c->work.segments.data;
  abut_clip3 common;
  double gap_i, gap_j;
  if (list[i].primary == list[j].primary
      || !boxes_overlap(&list[i].polygon, &list[j].polygon)
      || share_node(&w->c->primary->view, list[i].primary, list[j].primary)
      || !abut_clip3_intersect(&list[i].polygon, &list[j].polygon,
                               smallest_overlap, &common)
      || !gap_at(w, &list[i], common.centroid, &gap_i)
      || !gap_at(w, &list[j], common.centroid, &gap_j))
    return false;
  return fabs(gap_j) < fabs(gap_i) || (fabs(gap_j) == fabs(gap_i) && j < i);
}

/* The rest of polygon i without the parts of all that are nearer; returns the
 * number of fragments. */
static int
cut_back(const work *w, int32_t i, abut_clip3 *fragments)
{
  const segment *list = w->c->work.segments.data;
  int n = 1;
  fragments[0] = list[i].polygon;
  for (int32_t j = 0; j < w->n && n > 0; ++j)
  {
    if (j == i || !is_before(w, j, i))
      continue;
    abut_clip3 pieces[MAX_FRAGMENTS + abut_clip_max];
    int n_pieces = 0;
    for (int k = 0; k < n && n_pieces <= MAX_FRAGMENTS; ++k)
      n_pieces += abut_clip3_subtract(&fragments[k], &list[j].polygon,
                                      smallest_overlap, pieces + n_pieces);
    n = n_pieces < MAX_FRAGMENTS ? n_pieces : MAX_FRAGMENTS;
    memcpy(fragments, pieces, sizeof(pieces[0]) * (size_t)n);
  }
  return n;
}

static abut_status
add_point(work *w, const segment *g, const double *uv, double area)
{
  const abut_facet_kind kind =
      (abut_facet_kind)w->c->primary->view.kinds[g->primary];
  double local[2], opposite[2], x[3], n[3], t[2][3], ratio;
  if (!abut_linear_patch_lift(&g->s, uv, local, x, &ratio)
      || !abut_linear_patch_lift(&g->m, uv, opposite, x, NULL))
    return ABUT_SUCCESS;
  abut_coupling_point *p = abut_coupling_new_point(w->c);
  if (p == NULL)
    return ABUT_OUT_OF_MEMORY;
  p->primary = g->primary;
  memcpy(p->local, local, sizeof(local));
  abut_coupling_shape(w->facet->kind, w->facet->x, local, p->shape, t);
  abut_coupling_shape(kind, NULL, opposite, p->opposite, NULL);
  cross3(t[0], t[1], n);
  ratio *= norm3(n);
  p->weight = area * (ratio <= largest_area_ratio ? ratio : 1.)
              * abut_coupling_area_ratio(w->c, w->facet, local);
  abut_coupling_finish_point(w->c, w->facet, p);
  return abut_coupling_follows(w->c) ? abut_coupling_rate3(
             w->c, w->facet, w->plane, &g->s, &g->m, opposite, p)
                                     : ABUT_SUCCESS;
}

/* A polygon as a fan of triangles. */
static abut_status
integrate(work *w, const segment *g, const abut_clip3 *polygon,
          const abut_rule *rule)
{
  const double *a = polygon->vertex[0];
  for (int i = 2; i < polygon->n; ++i)
  {
    const double *b = polygon->vertex[i - 1], *d = polygon->vertex[i];
    const double area = (b[0] - a[0]) * (d[1] - a[1])
                        - (b[1] - a[1]) * (d[0] - a[0]); /* twice */
    /* Nearly equal vertices are round-off: no points, or else the numbers of
     * those that follow would depend on it. */
    if (!(area > ABUT_CLIP_SMALLEST * polygon->area))
      continue;
    for (int q = 0; q < rule->n; ++q)
    {
      const double u = rule->local[q][0], v = rule->local[q][1];
      const double uv[2] = {a[0] + u * (b[0] - a[0]) + v * (d[0] - a[0]),
                            a[1] + u * (b[1] - a[1]) + v * (d[1] - a[1])};
      const abut_status status = add_point(w, g, uv, rule->weight[q] * area);
      if (status != ABUT_SUCCESS)
        return status;
    }
  }
  return ABUT_SUCCESS;
}

/* Points of all polygons of a secondary patch. */
static abut_status
integrate_all(work *w, bool final)
{
  int degree = -1;
  abut_rule rule;
  for (int32_t i = 0; i < w->n; ++i)
  {
    const segment *g = (const segment *)w->c->work.segments.data + i;
    abut_clip3 fragments[MAX_FRAGMENTS];
    const int n = cut_back(w, i, fragments);
    const int wanted = abut_coupling_degree(
        w->c, w->facet->kind,
        (abut_facet_kind)w->c->primary->view.kinds[g->primary], final);
    if (wanted != degree)
      abut_rule_facet(ABUT_FACET_TRI3, wanted, &rule);
    degree = wanted;
    for (int k = 0; k < n; ++k)
    {
      const abut_status status = integrate(w, g, &fragments[k], &rule);
      if (status != ABUT_SUCCESS)
        return status;
    }
    w->c->statistics.n_pairs += final;
    w->c->statistics.n_layers +=
        final && (n != 1 || fragments[0].area < g->polygon.area);
  }
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_segments3(abut_coupling *c, const abut_coupling_facet *facet,
                        bool final)
{
  int32_t n_candidates;
  abut_linear_patch s[ABUT_MAX_LINEAR_PATCHES];
  work w = {.c = c, .facet = facet};
  c->work.n_points = 0;
  c->change.n_rates = 0;
  c->work.segments.element = sizeof(segment);
  abut_status status =
      abut_coupling_find_candidates(c, facet->index, &n_candidates);
  const bool split =
      facet->kind == ABUT_FACET_QUAD4 && facet->warping > split_warping;
  const int n = abut_linear_patches(facet->kind, facet->x, split, s);
  for (int i = 0; i < n && n_candidates > 0 && status == ABUT_SUCCESS; ++i)
  {
    abut_part part;
    abut_linear_patch_walk(&s[i], &part);
    w.plane = &s[i];
    if (!(abut_part_area(&part, w.normal) > 0.))
      continue;
    if (!abut_coupling_is_mortar(c))
      memcpy(w.normal, facet->normal, sizeof(w.normal));
    w.origin[0] = w.origin[1] = w.origin[2] = 0.;
    for (int k = 0; k < part.n; ++k)
      axpy3(w.origin, 1. / part.n, part.x[k], w.origin);
    abut_plane_basis(3, w.normal, w.e);
    abut_linear_patch_flatten(&s[i], w.origin, w.e);
    status = collect(&w, &s[i], n_candidates);
    if (status == ABUT_SUCCESS)
      status = integrate_all(&w, final);
  }
  return status;
}

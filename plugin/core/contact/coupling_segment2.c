/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Integration over the common segments of two curves.
 *
 * The ends of each linear part of a primary facet are projected onto the part
 * of the secondary along the normals at the secondary's nodes (for quadrature
 * points: the facet's), interpolated linearly (Yang, Laursen and Meng, Int. J.
 * Numer. Meth. Engng 62 (2005) 1183); Gauss's points of the common interval are
 * projected back the same way. Shape functions and positions are those of the
 * facets at the parameters found on their parts. Where several facets cover one
 * spot the nearest has it. Cost: O(pairs). */
#include "contact/coupling.h"
#include "geometry/clip.h"
#include "geometry/quadrature.h"
#include "geometry/vector.h"

/* Common interval of the current part with a part of a primary facet, whose
 * points are middle + r half, r in [-1, 1]. */
typedef struct segment
{
  double from, to; /* parameter of the secondary's part */
  double middle[2], half[2];
  double gap; /* in the middle */
  int32_t primary;
  int32_t part;
} segment;

/* Part of the secondary: points centre + s half, normals n + s slope. */
typedef struct base
{
  double x[4], normals[4]; /* of the two ends */
  double centre[2], half[2], n[2], slope[2];
  double mean[3]; /* unit normal */
  int part, n_parts;
} base;

static double
cross2(const double *a, const double *b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/* Parameter of the whole facet at parameter s of a part. */
static double
whole_parameter(int part, int n_parts, double s)
{
  return n_parts == 1 ? s : 0.5 * s + (part == 0 ? -0.5 : 0.5);
}

static void
set_base(const abut_coupling *c, const abut_coupling_facet *facet, int part,
         base *b)
{
  const bool averaged = abut_coupling_is_mortar(c);
  abut_part p;
  const int8_t *corner = abut_facet_part_corners(facet->kind, part);
  abut_facet_part(facet->kind, facet->x, part, &p);
  abut_part_area(&p, b->mean);
  b->part = part;
  b->n_parts = abut_facet_n_parts(facet->kind);
  for (int d = 0; d < 2; ++d)
  {
    for (int i = 0; i < 2; ++i)
    {
      b->x[2 * i + d] = p.x[i][d];
      b->normals[2 * i + d] =
          averaged ? facet->node_normal[3 * corner[i] + d] : facet->normal[d];
    }
    b->half[d] = 0.5 * (p.x[1][d] - p.x[0][d]);
    b->centre[d] = p.x[0][d] + b->half[d];
    b->slope[d] = 0.5 * (b->normals[2 + d] - b->normals[d]);
    b->n[d] = b->normals[d] + b->slope[d];
  }
}

/* Opposite parameter on the primary's part and the gap along the secondary's
 * mean normal, at parameter s. */
static double
opposite(const base *b, const segment *g, double s, double *gap)
{
  double n[2], r[2];
  for (int d = 0; d < 2; ++d)
  {
    n[d] = b->n[d] + s * b->slope[d];
    r[d] = b->centre[d] + s * b->half[d] - g->middle[d];
  }
  const double along = cross2(g->half, n);
  const double t = along != 0. ? clamp(cross2(r, n) / along, -1., 1.) : 0.;
  *gap = 0.;
  for (int d = 0; d < 2; ++d)
    *gap += b->mean[d] * (t * g->half[d] - r[d]);
  return t;
}

static bool
reaches(const abut_coupling *c, const base *b, const segment *g, double size,
        double s)
{
  double gap;
  opposite(b, g, s, &gap);
  return abut_coupling_in_reach(c, gap, size);
}

/* Where a segment, of which an end is out of reach, leaves the reach between
 * parameters in and out. */
static double
border_of_reach(const abut_coupling *c, const base *b, const segment *g,
                double size, double in, double out)
{
  for (int k = 0; k < 50; ++k)
  {
    const double middle = 0.5 * (in + out);
    if (reaches(c, b, g, size, middle))
      in = middle;
    else
      out = middle;
  }
  return in;
}

/* Cut off what is out of reach, so that what is covered does not jump while
 * surfaces move, as where a facet leans on the flank beside a corner. */
static int
cut_to_reach(const abut_coupling *c, const base *b, double size, segment *g)
{
  const double middle = 0.5 * (g->from + g->to);
  const bool first = reaches(c, b, g, size, g->from),
             last = reaches(c, b, g, size, g->to);
  if (!first && !last)
    return reaches(c, b, g, size, middle);
  if (!first)
    g->from = border_of_reach(c, b, g, size, g->to, g->from);
  if (!last)
    g->to = border_of_reach(c, b, g, size, g->from, g->to);
  return g->to - g->from > ABUT_CLIP_SMALLEST;
}

/* Common interval with one part of a primary facet; nonzero if there is one.
 */
static int
intersect(const abut_coupling *c, const base *b, abut_facet_kind kind,
          const double *nodes, double size, segment *g)
{
  abut_part p;
  double normal[3], x[4];
  abut_facet_part(kind, nodes, g->part, &p);
  abut_part_area(&p, normal);
  if (!(dot3(b->mean, normal) <= c->options.normal_cosine))
    return 0;
  for (int d = 0; d < 2; ++d)
  {
    x[d] = p.x[0][d];
    x[2 + d] = p.x[1][d];
    g->half[d] = 0.5 * (x[2 + d] - x[d]);
    g->middle[d] = x[d] + g->half[d];
  }
  abut_clip2 clip;
  if (!abut_clip2_segments(b->x, x, b->normals, &clip))
    return 0;
  g->from = clip.secondary[0];
  g->to = clip.secondary[1];
  opposite(b, g, 0.5 * (g->from + g->to), &g->gap);
  return abut_coupling_follows(c) ? cut_to_reach(c, b, size, g)
                                  : abut_coupling_in_reach(c, g->gap, size);
}

static abut_status
append(abut_coupling *c, int32_t *n, const segment *g)
{
  const abut_status status =
      abut_array_reserve(c->context, &c->work.segments, *n, (int64_t)*n + 1);
  if (status == ABUT_SUCCESS)
    ((segment *)c->work.segments.data)[(*n)++] = *g;
  return status;
}

/* All common intervals of a part. */
static abut_status
collect(abut_coupling *c, const base *b, int32_t n_candidates, int32_t *n)
{
  const int32_t *candidate = c->work.candidates.data;
  abut_status status = ABUT_SUCCESS;
  *n = 0;
  for (int32_t k = 0; k < n_candidates && status == ABUT_SUCCESS; ++k)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES];
    segment g = {.primary = candidate[k]};
    const abut_facet_kind kind =
        (abut_facet_kind)c->primary->view.kinds[g.primary];
    abut_surface_gather(c->primary, g.primary, nodes);
    const double size = abut_surface_longest_side(kind, nodes);
    for (g.part = 0; g.part < abut_facet_n_parts(kind); ++g.part)
      if (status == ABUT_SUCCESS && intersect(c, b, kind, nodes, size, &g))
        status = append(c, n, &g);
  }
  return status;
}

/* Whether segment g gives way to another one at parameter s: a nearer one, or
 * as near and earlier. */
static bool
is_behind(const base *b, const segment *list, int32_t n, int32_t g, double s)
{
  double gap, other;
  opposite(b, list + g, s, &gap);
  for (int32_t i = 0; i < n; ++i)
    if (i != g && list[i].from < s && s < list[i].to)
    {
      opposite(b, list + i, s, &other);
      if (fabs(other) < fabs(gap) || (fabs(other) == fabs(gap) && i < g))
        return true;
    }
  return false;
}

/* Least end of a segment beyond s. */
static double
next_end(const segment *list, int32_t n, double s, double to)
{
  double next = to;
  for (int32_t i = 0; i < n; ++i)
  {
    if (list[i].from > s && list[i].from < next)
      next = list[i].from;
    if (list[i].to > s && list[i].to < next)
      next = list[i].to;
  }
  return next;
}

/* Points of integration of an interval of segment g. */
static abut_status
add_points(abut_coupling *c, const abut_coupling_facet *facet, const base *b,
           const segment *g, double from, double to)
{
  const abut_facet_kind kind =
      (abut_facet_kind)c->primary->view.kinds[g->primary];
  const int n_parts = abut_facet_n_parts(kind);
  abut_rule rule;
  abut_rule_facet(ABUT_FACET_LINE2,
                  abut_coupling_degree(c, facet->kind, kind, true), &rule);
  for (int q = 0; q < rule.n; ++q)
  {
    double gap, tangent[2][3];
    const double s = 0.5 * (from + to) + 0.5 * (to - from) * rule.local[q][0];
    const double t = opposite(b, g, s, &gap);
    const double local[2] = {whole_parameter(g->part, n_parts, t), 0.};
    abut_coupling_point *p = abut_coupling_new_point(c);
    if (p == NULL)
      return ABUT_OUT_OF_MEMORY;
    p->primary = g->primary;
    p->local[0] = whole_parameter(b->part, b->n_parts, s);
    abut_coupling_shape(facet->kind, facet->x, p->local, p->shape, tangent);
    p->weight = rule.weight[q] * 0.5 * (to - from) / b->n_parts
                * norm3(tangent[0])
                * abut_coupling_area_ratio(c, facet, p->local);
    abut_coupling_shape(kind, NULL, local, p->opposite, NULL);
    abut_coupling_finish_point(c, facet, p);
    const abut_status status =
        abut_coupling_follows(c)
            ? abut_coupling_rate2(c, facet, b->part, s, g->part, t, p)
            : ABUT_SUCCESS;
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

/* Points of a segment, of which intervals that are behind others are left out.
 */
static abut_status
integrate(abut_coupling *c, const abut_coupling_facet *facet, const base *b,
          int32_t n, int32_t k, bool *cut)
{
  const segment *list = c->work.segments.data;
  const double tolerance = 2. * ABUT_CLIP_SMALLEST;
  double from = list[k].from, s = from;
  abut_status status = ABUT_SUCCESS;
  while (s < list[k].to && status == ABUT_SUCCESS)
  {
    const double next = next_end(list, n, s, list[k].to);
    if (next - s > tolerance && is_behind(b, list, n, k, 0.5 * (s + next)))
    {
      *cut = true;
      if (s - from > tolerance)
        status = add_points(c, facet, b, list + k, from, s);
      from = next;
    }
    s = next;
  }
  if (status == ABUT_SUCCESS && s > from)
    status = add_points(c, facet, b, list + k, from, s);
  return status;
}

abut_status
abut_coupling_segments2(abut_coupling *c, const abut_coupling_facet *facet,
                        bool final)
{
  int32_t n_candidates, n;
  c->work.n_points = 0;
  c->change.n_rates = 0;
  c->work.segments.element = sizeof(segment);
  abut_status status =
      abut_coupling_find_candidates(c, facet->index, &n_candidates);
  for (int part = 0;
       part < abut_facet_n_parts(facet->kind) && status == ABUT_SUCCESS; ++part)
  {
    base b;
    set_base(c, facet, part, &b);
    status = collect(c, &b, n_candidates, &n);
    for (int32_t k = 0; k < n && status == ABUT_SUCCESS; ++k)
    {
      bool cut = false;
      status = integrate(c, facet, &b, n, k, &cut);
      c->statistics.n_pairs += final;
      c->statistics.n_layers += final && cut;
    }
  }
  return status;
}

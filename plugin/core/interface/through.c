/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nodes that go through a surface within a step.
 *
 * Facet f stays as it was at the start, with corners X_c, and node n goes
 *
 *     from x_n to x_n + u_n - u_f ,   u_f: mean displacement of the corners.
 *
 * The search knows the facets at the end of the step. Seen from there, the
 * facet is at X_c + u_f and the node goes from x_n + u_f to x_n + u_n. With the
 * mean m of all u_f, the box around x_n + m and x_n + u_n, enlarged by
 *
 *     max_f |u_f - m| + max_fc |u_c - u_f|
 *
 * in each direction, meets the box of every facet that the node can go through.
 * Bodies that move without strain cost as much as their shortest paths. */
#include "geometry/vector.h"
#include "interface/inside.h"
#include "search/search.h"

#include <string.h>

typedef struct work
{
  abut_context *context;
  const abut_surface *nodes, *facets;
  abut_starts start;
  const double *normal; /* of nodes, at the end */
  abut_search *search;
  abut_array displacement; /* double[3] of each facet */
  abut_array box;          /* double[6] of each node */
  abut_inside *deepest;    /* of each node */
} work;

/* Displacement of a node of a surface from its start. */
static void
displacement_of(const abut_surface *s, const double *start, int32_t i,
                double *u)
{
  double from[3];
  load3(start, s->view.dimension, i, from);
  load3(s->view.position, s->view.dimension, i, u);
  sub3(u, from, u);
}

static int32_t
n_corners(const abut_surface *s, int32_t f)
{
  return abut_facet_n_corners((abut_facet_kind)s->view.kinds[f]);
}

/* Node at corner k of facet f. */
static int32_t
corner_node(const abut_surface *s, int32_t f, int32_t k)
{
  return s->view.connectivity[s->view.facet_start[f] + k];
}

/* Mean displacement u of each facet and, over all facets, their mean and what
 * boxes are enlarged by, [3] each. */
static void
displace_facets(work *w, double *mean, double *margin)
{
  const abut_surface *s = w->facets;
  const int32_t n = s->view.n_facets;
  double(*u)[3] = w->displacement.data;
  double strain[3] = {0.}, spread[3] = {0.};
  memset(mean, 0, 3 * sizeof(*mean));
  for (int32_t f = 0; f < n; ++f)
  {
    const int32_t m = n_corners(s, f);
    double of_corner[4][3];
    memset(u[f], 0, sizeof(u[f]));
    for (int32_t k = 0; k < m; ++k)
    {
      displacement_of(s, w->start.facets, corner_node(s, f, k), of_corner[k]);
      axpy3(u[f], 1. / m, of_corner[k], u[f]);
    }
    axpy3(mean, 1. / n, u[f], mean);
    for (int32_t k = 0; k < m; ++k)
      for (int d = 0; d < 3; ++d)
        strain[d] = max2(strain[d], fabs(of_corner[k][d] - u[f][d]));
  }
  for (int32_t f = 0; f < n; ++f)
    for (int d = 0; d < 3; ++d)
      spread[d] = max2(spread[d], fabs(u[f][d] - mean[d]));
  for (int d = 0; d < 3; ++d)
    margin[d] = strain[d] + spread[d];
}

static void
make_boxes(work *w, const double *mean, const double *margin)
{
  /* Round-off of crossings, relative to coordinates and displacements. */
  const double round_off = 1e-12;
  const abut_surface *s = w->nodes;
  double(*box)[6] = w->box.data;
  for (int32_t i = 0; i < s->view.n_nodes; ++i)
  {
    double from[3], to[3];
    load3(w->start.nodes, s->view.dimension, i, from);
    load3(s->view.position, s->view.dimension, i, to);
    for (int d = 0; d < 3; ++d)
    {
      const double a = from[d] + mean[d], b = to[d];
      const double slack =
          margin[d]
          + round_off * (fabs(from[d]) + fabs(mean[d]) + fabs(b) + margin[d]);
      box[i][d] = min2(a, b) - slack;
      box[i][3 + d] = max2(a, b) + slack;
    }
  }
}

/* Whether a point of the plane of a line or triangle is on it. */
static bool
is_on(int32_t dimension, double (*corner)[3], const double *x)
{
  double a[3], b[3], n[3], c[3];
  if (dimension == 2)
  {
    sub3(x, corner[0], a);
    sub3(x, corner[1], b);
    return dot3(a, b) <= 0.;
  }
  corner_normal3(dimension, corner, n);
  for (int k = 0; k < 3; ++k)
  {
    sub3(corner[(k + 1) % 3], corner[k], a);
    sub3(x, corner[k], b);
    cross3(a, b, c);
    if (dot3(n, c) < 0.)
      return false;
  }
  return true;
}

/* Depth behind a line or triangle at the end of the path from x by u, if the
 * path goes through it from outside and against the normal of the node; else 0.
 */
static double
depth_behind_part(int32_t dimension, double (*corner)[3], const double *x,
                  const double *u, const double *normal)
{
  double n[3], to[3], a[3], b[3], crossing[3];
  corner_normal3(dimension, corner, n);
  const double length = norm3(n);
  if (length == 0.)
    return 0.;
  const double inverse = 1. / length;
  for (int d = 0; d < 3; ++d)
  {
    n[d] *= inverse;
    to[d] = x[d] + u[d];
  }
  sub3(x, corner[0], a);
  sub3(to, corner[0], b);
  const double before = dot3(n, a), after = dot3(n, b);
  if (dot3(n, normal) >= 0. || before < 0. || after >= 0.)
    return 0.;
  sub3(to, x, a);
  axpy3(x, before / (before - after), a, crossing);
  return is_on(dimension, corner, crossing) ? -after : 0.;
}

/* The same of facet f, a quadrilateral being two triangles. */
static double
depth_behind(const work *w, int32_t i, int32_t f)
{
  static const int8_t half[2][3] = {{0, 1, 3}, {0, 3, 2}};
  const abut_surface *s = w->facets;
  const int32_t dimension = s->view.dimension, m = n_corners(s, f);
  double corner[4][3], part[3][3], x[3], u[3], normal[3], depth = 0.;
  for (int32_t k = 0; k < m; ++k)
    load3(w->start.facets, dimension, corner_node(s, f, k), corner[k]);
  load3(w->start.nodes, dimension, i, x);
  load3(w->normal, dimension, i, normal);
  displacement_of(w->nodes, w->start.nodes, i, u);
  sub3(u, ((const double(*)[3])w->displacement.data)[f], u);
  if (m < 4)
    return depth_behind_part(dimension, corner, x, u, normal);
  for (int p = 0; p < 2; ++p)
  {
    for (int k = 0; k < 3; ++k)
      memcpy(part[k], corner[half[p][k]], sizeof(part[k]));
    depth = max2(depth, depth_behind_part(3, part, x, u, normal));
  }
  return depth;
}

static abut_status
consume(void *user, const abut_answers *answers)
{
  work *w = user;
  const abut_record *records = w->search->records.data;
  for (int32_t k = 0; k < answers->n; ++k)
  {
    const int32_t i = answers->order[k];
    abut_inside *deepest = &w->deepest[i];
    for (int64_t e = answers->start[k]; e < answers->start[k + 1]; ++e)
    {
      const int32_t f = records[answers->slot[e]].facet;
      const double depth = depth_behind(w, i, f);
      if (depth > deepest->depth
          || (depth == deepest->depth && f < deepest->facet))
      {
        deepest->depth = depth;
        deepest->facet = f;
      }
    }
  }
  return ABUT_SUCCESS;
}

static abut_status
search_paths(work *w, abut_surface *facets, const abut_search_options *options)
{
  const int32_t n = w->nodes->view.n_nodes;
  abut_search_options o = *options;
  double mean[3], margin[3];
  o.reach = o.relative_reach = o.skin = 0.;
  w->displacement.element = 3 * sizeof(double);
  w->box.element = 6 * sizeof(double);
  abut_status status = abut_array_reserve(w->context, &w->displacement, 0,
                                          facets->view.n_facets);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(w->context, &w->box, 0, n);
  if (status == ABUT_SUCCESS)
    status = abut_search_create(w->context, facets, &o, &w->search);
  if (status == ABUT_SUCCESS)
    status = abut_search_update(w->search);
  if (status != ABUT_SUCCESS)
    return status;
  displace_facets(w, mean, margin);
  make_boxes(w, mean, margin);
  const abut_query query = {n, facets->view.dimension, NULL, w->box.data};
  return abut_search_list(w->search, &query, 0., &w->search->list, consume, w);
}

abut_status
abut_nodes_through(abut_context *context, abut_surface *nodes,
                   abut_surface *facets, const abut_search_options *options,
                   abut_starts start, double depth, abut_inside *found,
                   int32_t *n)
{
  const int32_t n_nodes = nodes->view.n_nodes;
  work w;
  *n = 0;
  if (n_nodes == 0 || facets->view.n_facets == 0)
    return ABUT_SUCCESS;
  memset(&w, 0, sizeof(w));
  w.context = context;
  w.nodes = nodes;
  w.facets = facets;
  w.start = start;
  w.deepest = found;
  for (int32_t i = 0; i < n_nodes; ++i)
  {
    const abut_inside none = {i, -1, max2(depth, 0.)};
    found[i] = none;
  }
  abut_status status = abut_surface_normals(nodes, &w.normal);
  if (status == ABUT_SUCCESS)
    status = search_paths(&w, facets, options);
  for (int32_t i = 0; i < n_nodes && status == ABUT_SUCCESS; ++i)
    if (found[i].facet >= 0)
      found[(*n)++] = found[i];
  (void)abut_search_destroy(&w.search);
  abut_array_release(context, &w.displacement);
  abut_array_release(context, &w.box);
  return status;
}

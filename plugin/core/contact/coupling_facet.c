/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The current secondary facet, and its points of integration. */
#include "contact/coupling.h"
#include "geometry/kernels.h"
#include "geometry/measure.h"
#include "geometry/quadrature.h"
#include "geometry/vector.h"

#include <string.h>

void
abut_coupling_shape(abut_facet_kind kind, const double *nodes,
                    const double *local, double *shape, double (*tangents)[3])
{
  const int n = abut_facet_n_nodes(kind), dim = abut_facet_dimension(kind);
  abut_shape s;
  if (dim == 2)
    abut_shape2(kind, local[0], &s);
  else
    abut_shape3(kind, local[0], local[1], &s);
  memcpy(shape, s.n, sizeof(double) * (size_t)n);
  if (tangents == NULL)
    return;
  for (int k = 0; k < dim - 1; ++k)
    for (int d = 0; d < 3; ++d)
    {
      tangents[k][d] = 0.;
      /* The derivatives of all shape functions add up to zero. */
      for (int a = 1; a < n && d < dim; ++a)
        tangents[k][d] += s.d[k][a] * (nodes[a * dim + d] - nodes[d]);
    }
}

void
abut_coupling_normal(abut_facet_kind kind, const double *nodes,
                     const double *local, double *normal)
{
  double shape[ABUT_FACET_MAX_NODES], t[2][3];
  abut_coupling_shape(kind, nodes, local, shape, t);
  if (abut_facet_dimension(kind) == 3)
    cross3(t[0], t[1], normal);
  else
  {
    normal[0] = t[0][1];
    normal[1] = -t[0][0];
    normal[2] = 0.;
  }
  unit3(normal, ABUT_TINY);
}

/* The averaged normals of the nodes; at a feature of the surface, where they
 * lean away from the facet's own by more than half the feature angle, the
 * facet's own. */
static void
set_node_normals(const abut_coupling *c, abut_coupling_facet *facet)
{
  const abut_surface_view *v = &c->secondary->view;
  const int32_t *node = v->connectivity + v->facet_start[facet->index];
  const double limit = cos(0.5 * c->secondary->feature_angle);
  facet->own_normals = 0;
  for (int32_t a = 0; a < facet->n; ++a)
  {
    double *n = facet->node_normal + 3 * a;
    double own[3];
    abut_coupling_normal(facet->kind, facet->x,
                         abut_facet_node_local(facet->kind, a), own);
    n[2] = 0.;
    for (int32_t d = 0; d < v->dimension; ++d)
      n[d] = c->of_node.normal[(int64_t)v->dimension * node[a] + d];
    if (dot3(n, own) >= limit)
      continue;
    memcpy(n, own, sizeof(own));
    facet->own_normals |= UINT32_C(1) << a;
  }
}

void
abut_coupling_node_normal(const abut_coupling *c,
                          const abut_coupling_facet *facet, int32_t node,
                          double *normal)
{
  const abut_surface_view *v = &c->secondary->view;
  const int32_t *own = v->connectivity + v->facet_start[facet->index];
  normal[2] = 0.;
  for (int32_t d = 0; d < v->dimension; ++d)
    normal[d] = c->of_node.normal[(int64_t)v->dimension * node + d];
  for (int32_t a = 0; a < facet->n; ++a)
    if (own[a] == node)
      memcpy(normal, facet->node_normal + 3 * a, 3 * sizeof(double));
}

/* Positions that the facet's weights are measured at: of the reference
 * configuration, where the surface has another one. */
static const double *
weighing_positions(const abut_coupling *c)
{
  const double *reference = c->target->reference;
  return reference != NULL ? reference : c->secondary->view.position;
}

double
abut_coupling_area_ratio(const abut_coupling *c,
                         const abut_coupling_facet *facet, const double *local)
{
  if (c->target->reference == NULL)
    return 1.;
  const bool in_plane = c->secondary->view.dimension == 2;
  const double *nodes[2] = {facet->reference, facet->x};
  double shape[ABUT_FACET_MAX_NODES], area[2];
  for (int k = 0; k < 2; ++k)
  {
    double t[2][3], n[3];
    abut_coupling_shape(facet->kind, nodes[k], local, shape, t);
    if (!in_plane)
      cross3(t[0], t[1], n);
    area[k] = norm3(in_plane ? t[0] : n);
  }
  return area[1] > 0. ? area[0] / area[1] : 1.;
}

static void
load_reference(const abut_coupling *c, abut_coupling_facet *facet)
{
  const abut_surface_view *v = &c->secondary->view;
  const int32_t *node = v->connectivity + v->facet_start[facet->index];
  const int32_t dim = v->dimension;
  const double *from = weighing_positions(c);
  for (int32_t a = 0; a < facet->n; ++a)
    memcpy(facet->reference + dim * a, from + (int64_t)dim * node[a],
           sizeof(double) * (size_t)dim);
}

void
abut_coupling_load(const abut_coupling *c, int32_t f,
                   abut_coupling_facet *facet)
{
  abut_facet_measures m;
  double vector_area, lowest_cosine;
  facet->index = f;
  facet->kind = (abut_facet_kind)c->secondary->view.kinds[f];
  facet->n = abut_surface_gather(c->secondary, f, facet->x);
  load_reference(c, facet);
  if (c->secondary->view.dimension == 2)
    abut_measure2(facet->kind, facet->x, &m, &vector_area, &lowest_cosine);
  else
    abut_measure3(facet->kind, facet->x, &m, &vector_area, &lowest_cosine);
  memcpy(facet->normal, m.normal, sizeof(m.normal));
  facet->warping = m.warping;
  facet->size = abut_surface_longest_side(facet->kind, facet->x);
  set_node_normals(c, facet);
}

abut_coupling_point *
abut_coupling_new_point(abut_coupling *c)
{
  if (abut_array_reserve(c->context, &c->work.points, c->work.n_points,
                         (int64_t)c->work.n_points + 1)
      != ABUT_SUCCESS)
    return NULL;
  abut_coupling_point *p =
      (abut_coupling_point *)c->work.points.data + c->work.n_points;
  ++c->work.n_points;
  memset(p, 0, sizeof(*p));
  p->primary = -1;
  return p;
}

/* Position of a point by shape functions. */
static void
position(int dim, int n, const double *nodes, const double *shape, double *x)
{
  x[0] = x[1] = x[2] = 0.;
  for (int a = 0; a < n; ++a)
    for (int d = 0; d < dim; ++d)
      x[d] += shape[a] * nodes[a * dim + d];
}

void
abut_coupling_finish_point(const abut_coupling *c,
                           const abut_coupling_facet *facet,
                           abut_coupling_point *p)
{
  const int dim = c->secondary->view.dimension;
  double nodes[3 * ABUT_FACET_MAX_NODES], *x = p->position;
  position(dim, facet->n, facet->x, p->shape, x);
  memcpy(p->normal, facet->normal, sizeof(p->normal));
  if (c->options.axisymmetric)
  {
    double at[3];
    position(dim, facet->n, facet->reference, p->shape, at);
    p->weight *= 2. * 3.14159265358979323846 * at[0];
  }
  if (c->primary == NULL || p->primary < 0)
    return;
  double y[3];
  const int n = abut_surface_gather(c->primary, p->primary, nodes);
  position(dim, n, nodes, p->opposite, y);
  sub3(y, x, p->gap);
}

/* Degree of the shape functions over lines, or of their products over
 * quadrilaterals. */
static int
degree_of(abut_facet_kind kind)
{
  static const int8_t degree[ABUT_FACET_N_KINDS] = {1, 2, 1, 2, 2, 4};
  return degree[kind];
}

int
abut_coupling_degree(const abut_coupling *c, abut_facet_kind secondary,
                     abut_facet_kind primary, bool products)
{
  if (c->options.quadrature_degree > 0)
    return c->options.quadrature_degree;
  /* A point is a row: no more than uniform pressures need. */
  if (!abut_coupling_is_mortar(c))
    return abut_facet_dimension(secondary) == 3
               ? (degree_of(primary) > degree_of(secondary)
                      ? degree_of(primary)
                      : degree_of(secondary))
           : degree_of(secondary) + degree_of(primary) > 2 ? 5
                                                           : 3;
  if (abut_facet_dimension(secondary) == 3)
    return degree_of(secondary) + (products ? degree_of(primary) : 0);
  /* The map to a curved or inclined primary is not a polynomial. */
  return degree_of(secondary) + degree_of(primary) > 2 ? 9 : 5;
}

/* Degree of a rule over whole facets. Quadrature points and areas of shape
 * functions need few points, integrals over the kinks of the primary's
 * functions, or against obstacles, many. */
static int
whole_degree(const abut_coupling *c, abut_facet_kind kind)
{
  const int n_corners = abut_facet_n_corners(kind),
            quadratic = abut_facet_n_nodes(kind) > n_corners;
  if (c->options.quadrature_degree > 0)
    return c->options.quadrature_degree;
  const bool few = !abut_coupling_is_mortar(c)
                   || (c->options.segments && c->obstacle == NULL);
  if (abut_facet_dimension(kind) == 3 && n_corners == 3)
    return !few ? 8 : quadratic ? 4 : 2;
  return few ? (quadratic ? 5 : 3) : (quadratic ? 9 : 7);
}

abut_status
abut_coupling_whole(abut_coupling *c, const abut_coupling_facet *facet)
{
  abut_rule rule;
  abut_rule_facet(facet->kind, whole_degree(c, facet->kind), &rule);
  c->work.n_points = 0;
  for (int q = 0; q < rule.n; ++q)
  {
    abut_coupling_point *p = abut_coupling_new_point(c);
    if (p == NULL)
      return ABUT_OUT_OF_MEMORY;
    double t[2][3], n[3];
    p->number = q;
    memcpy(p->local, rule.local[q], sizeof(p->local));
    abut_coupling_shape(facet->kind, facet->reference, p->local, p->shape, t);
    if (c->secondary->view.dimension == 2)
      memcpy(n, t[0], sizeof(n));
    else
      cross3(t[0], t[1], n);
    p->weight = rule.weight[q] * norm3(n);
    abut_coupling_finish_point(c, facet, p);
  }
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_make_points(abut_coupling *c, const abut_coupling_facet *facet,
                          bool final)
{
  if (c->obstacle != NULL)
    return abut_coupling_face_obstacle(c, facet, final);
  if (abut_coupling_moves(c))
    return abut_coupling_near(c, facet, final);
  if (!c->options.segments && !abut_coupling_follows(c))
    return abut_coupling_rays(c, facet, final);
  const abut_status status = c->secondary->view.dimension == 2
                                 ? abut_coupling_segments2(c, facet, final)
                                 : abut_coupling_segments3(c, facet, final);
  if (status == ABUT_SUCCESS && !abut_coupling_is_mortar(c))
    abut_coupling_find_opposites(c, facet);
  return status;
}

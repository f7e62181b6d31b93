/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Points of a rule over the whole facet, and nodes, against a rigid obstacle:
 * signed distance phi for the gap, minus its gradient for the normal. All
 * points of a build are evaluated in one call, because obstacles made of facets
 * search for many points at once; the answers are taken in the same order. */
#include "contact/discretisation.h"
#include "geometry/vector.h"

#include <abut/obstacle_edge.h>

#include <string.h>

/* Append a point, dimension numbers of x and of the surface's normal, and the
 * size of its facet. */
static abut_status
ask(abut_coupling *c, const double *x, const double *normal, double size)
{
  const int64_t dim = c->view.dimension, n = c->answer.n_asked;
  abut_status status =
      abut_array_reserve(c->context, &c->answer.asked, n * dim, (n + 1) * dim);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(c->context, &c->answer.asked_normal, n * dim,
                                (n + 1) * dim);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(c->context, &c->answer.asked_size, n, n + 1);
  if (status != ABUT_SUCCESS)
    return status;
  memcpy((double *)c->answer.asked.data + n * dim, x,
         sizeof(double) * (size_t)dim);
  memcpy((double *)c->answer.asked_normal.data + n * dim, normal,
         sizeof(double) * (size_t)dim);
  ((double *)c->answer.asked_size.data)[n] = size;
  ++c->answer.n_asked;
  return ABUT_SUCCESS;
}

/* The points of a facet, then their mean. */
static abut_status
ask_facet(abut_coupling *c, int32_t f)
{
  abut_coupling_facet facet;
  double mean[3] = {0., 0., 0.};
  abut_coupling_load(c, f, &facet);
  abut_status status = abut_coupling_whole(c, &facet);
  const abut_coupling_point *points = c->work.points.data;
  for (int32_t q = 0; q < c->work.n_points && status == ABUT_SUCCESS; ++q)
  {
    axpy3(mean, 1. / c->work.n_points, points[q].position, mean);
    status = ask(c, points[q].position, facet.normal, facet.size);
  }
  return status == ABUT_SUCCESS ? ask(c, mean, facet.normal, 0.) : status;
}

/* Each node has the size of the smallest facet around it. */
static void
set_sizes_of_nodes(abut_coupling *c)
{
  const abut_surface_view *v = &c->secondary->view;
  double *size = c->answer.asked_size.data;
  for (int32_t f = 0; f < v->n_facets && abut_obstacle_has_edges(c->obstacle);
       ++f)
  {
    abut_coupling_facet facet;
    abut_coupling_load(c, f, &facet);
    for (int32_t e = v->facet_start[f]; e < v->facet_start[f + 1]; ++e)
    {
      double *of_node = size + v->connectivity[e];
      *of_node = *of_node > 0. ? min2(*of_node, facet.size) : facet.size;
    }
  }
}

/* Answer number i: signed distance and normal. */
static void
answer(const abut_coupling *c, int64_t i, double *distance, double *normal)
{
  const int dim = c->view.dimension;
  const double *gradient = (const double *)c->answer.gradient.data + i * dim;
  *distance = ((const double *)c->answer.distance.data)[i];
  for (int d = 0; d < 3; ++d)
    normal[d] = d < dim ? -gradient[d] : 0.;
}

/* Whether the middle of a facet, answer number i, faces the obstacle. */
static bool
middle_faces(const abut_coupling *c, const abut_coupling_facet *facet,
             int64_t i)
{
  double distance, normal[3];
  answer(c, i, &distance, normal);
  unit3(normal, 0.);
  return -dot3(normal, facet->normal) <= c->options.normal_cosine;
}

/* Whether a node faces the obstacle and is not farther than a size. */
static bool
node_faces(const abut_coupling *c, int32_t node, double size)
{
  static const double beyond_doubt = 0.5;
  const int dim = c->view.dimension;
  const double *outward =
      (const double *)c->answer.asked_normal.data + node * dim;
  double distance, normal[3], cosine = 0.;
  answer(c, node, &distance, normal);
  unit3(normal, 0.);
  for (int d = 0; d < dim; ++d)
    cosine += normal[d] * outward[d];
  return distance <= size && cosine >= beyond_doubt;
}

/* An obstacle smaller than the facets may face a node, but the middle of no
 * facet around it: such nodes are lone, and their facets are taken. */
static abut_status
find_lone_nodes(abut_coupling *c)
{
  const abut_surface_view *v = &c->secondary->view;
  const int32_t *order = c->order.facet.data,
                *hanging = c->of_node.hanging.data;
  const uint8_t *purpose = c->of_node.purpose.data,
                *wanted = c->of_node.given->wanted;
  uint8_t *lone = c->of_node.lone.data;
  abut_status status = ABUT_SUCCESS;
  for (int pass = 0; pass < 2 && c->method->detects_nodes; ++pass)
  {
    int64_t next = v->n_nodes;
    for (int32_t i = 0; i < v->n_facets && status == ABUT_SUCCESS; ++i)
    {
      abut_coupling_facet facet;
      const int32_t f = order[i];
      if (!(purpose[f] & ABUT_COUPLING_FOR_ROWS))
        continue;
      abut_coupling_load(c, f, &facet);
      status = abut_coupling_whole(c, &facet);
      next += c->work.n_points + 1;
      const bool faces =
          status == ABUT_SUCCESS && middle_faces(c, &facet, next - 1);
      for (int32_t e = v->facet_start[f]; e < v->facet_start[f + 1]; ++e)
      {
        const int32_t n = v->connectivity[e];
        if (pass == 0 && hanging[n] < 0 && (wanted == NULL || wanted[n])
            && node_faces(c, n, facet.size))
          lone[n] = 1;
        else if (pass == 1 && faces)
          lone[n] = 0;
      }
    }
  }
  return status;
}

static bool
has_lone_node(const abut_coupling *c, const abut_coupling_facet *facet)
{
  const abut_surface_view *v = &c->secondary->view;
  const uint8_t *lone = c->of_node.lone.data;
  for (int32_t e = v->facet_start[facet->index];
       e < v->facet_start[facet->index + 1]; ++e)
    if (lone[v->connectivity[e]])
      return true;
  return false;
}

/* Points behind the middle of a thin obstacle, and near its edges. */
static abut_status
correct(abut_coupling *c)
{
  const bool moves = abut_coupling_moves(c);
  const abut_status status = abut_coupling_leave_far_side(c);
  return status != ABUT_SUCCESS
             ? status
             : abut_obstacle_face(
                 c->obstacle, moves, (int32_t)c->answer.n_asked,
                 c->answer.asked.data, c->answer.asked_normal.data,
                 c->answer.asked_size.data, c->answer.distance.data,
                 c->answer.gradient.data,
                 moves ? c->answer.hessian.data : NULL);
}

abut_status
abut_coupling_measure_obstacle(abut_coupling *c)
{
  const int32_t dim = c->view.dimension, *order = c->order.facet.data;
  const uint8_t *purpose = c->of_node.purpose.data;
  const abut_surface_view *v = &c->secondary->view;
  const double *normal = NULL;
  abut_status status = abut_surface_normals(c->secondary, &normal);
  c->answer.n_asked = c->answer.n_answered = 0;
  if (c->method->detects_nodes || c->method->dual)
    for (int64_t i = 0; i < v->n_nodes && status == ABUT_SUCCESS; ++i)
      status = ask(c, v->position + dim * i, normal + dim * i, 0.);
  if (c->answer.n_asked > 0 && status == ABUT_SUCCESS)
    set_sizes_of_nodes(c);
  c->answer.n_answered = c->answer.n_asked;
  for (int32_t i = 0; i < v->n_facets && status == ABUT_SUCCESS; ++i)
    if (purpose[order[i]] & ABUT_COUPLING_FOR_ROWS)
      status = ask_facet(c, order[i]);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(c->context, &c->answer.distance, 0,
                                c->answer.n_asked + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(c->context, &c->answer.gradient, 0,
                                c->answer.n_asked * dim + 1);
  if (status == ABUT_SUCCESS && abut_coupling_moves(c))
    status = abut_array_reserve(c->context, &c->answer.hessian, 0,
                                c->answer.n_asked * dim * dim + 1);
  if (status != ABUT_SUCCESS || c->answer.n_asked == 0)
    return status;
  status =
      abut_coupling_moves(c)
          ? abut_obstacle_gap(c->obstacle, (int32_t)c->answer.n_asked,
                              c->answer.asked.data, c->answer.distance.data,
                              c->answer.gradient.data, c->answer.hessian.data)
          : abut_obstacle_distance(
              c->obstacle, (int32_t)c->answer.n_asked, c->answer.asked.data,
              c->answer.distance.data, c->answer.gradient.data, NULL);
  if (status == ABUT_SUCCESS)
    status = correct(c);
  return status == ABUT_SUCCESS ? find_lone_nodes(c) : status;
}

/* Keep the rows of the facet's nodes as far as the largest reach. */
static void
set_reach(abut_coupling *c, const abut_coupling_facet *facet)
{
  const abut_surface_view *v = &c->secondary->view;
  const int32_t *hanging = c->of_node.hanging.data;
  double *reach = c->of_node.reach.data;
  const double own =
      max2(c->reach, c->options.search.relative_reach * facet->size);
  for (int32_t e = v->facet_start[facet->index];
       e < v->facet_start[facet->index + 1]; ++e)
  {
    const int32_t node = v->connectivity[e], h = hanging[node];
    if (h < 0)
      reach[node] = max2(reach[node], own);
    for (int32_t k = h < 0 ? 0 : c->of_node.given->hanging_start[h];
         h >= 0 && k < c->of_node.given->hanging_start[h + 1]; ++k)
    {
      const int32_t parent = c->of_node.given->hanging_parent[k];
      reach[parent] = max2(reach[parent], own);
    }
  }
}

/* A point of quadrature keeps its row by itself. No point is too deep: behind
 * the surface of an obstacle there is nothing else that it could touch. */
static bool
is_kept(const abut_coupling *c, const abut_coupling_facet *facet,
        const abut_coupling_point *p)
{
  return !c->method->info.row_per_point
         || p->distance <= max2(c->reach,
                                c->options.search.relative_reach * facet->size);
}

abut_status
abut_coupling_face_obstacle(abut_coupling *c, const abut_coupling_facet *facet,
                            bool final)
{
  int32_t n = 0;
  const abut_status status = abut_coupling_whole(c, facet);
  if (status != ABUT_SUCCESS)
    return status;
  const int64_t first = c->answer.n_answered, n_points = c->work.n_points;
  abut_coupling_point *p = c->work.points.data;
  c->answer.n_answered += n_points + 1;
  c->work.n_points = 0;
  if (!middle_faces(c, facet, first + n_points) && !has_lone_node(c, facet))
    return ABUT_SUCCESS;
  for (int64_t q = 0; q < n_points; ++q)
  {
    answer(c, first + q, &p[q].distance, p[q].normal);
    p[q].hessian = (first + q) * c->view.dimension * c->view.dimension;
    if (is_kept(c, facet, p + q))
      p[n++] = p[q];
  }
  c->work.n_points = n;
  set_reach(c, facet);
  c->statistics.n_pairs += final;
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_add_node_obstacle(abut_coupling *c, int32_t node)
{
  const double weight = ((const double *)c->of_node.covered.data)[node];
  double normal[3], distance;
  answer(c, node, &distance, normal);
  abut_coupling_share *s = abut_coupling_new_share(c);
  if (s == NULL)
    return ABUT_OUT_OF_MEMORY;
  s->node = node;
  s->facet = -1;
  s->weight = weight;
  s->distance = weight * distance;
  s->hessian = (int64_t)node * c->view.dimension * c->view.dimension;
  for (int d = 0; d < 3; ++d)
    s->normal[d] = weight * normal[d];
  return abut_coupling_new_entry(c, &s->n_secondary, node, weight);
}

abut_status
abut_coupling_create_obstacle(abut_context *context, abut_surface *secondary,
                              abut_obstacle *obstacle,
                              const abut_coupling_options *options,
                              abut_coupling **coupling)
{
  static const char call[] = "abut_coupling_create_obstacle";
  abut_obstacle_view view;
  if (context == NULL || secondary == NULL || obstacle == NULL
      || coupling == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "context, surface, obstacle or result is NULL");
  const abut_status status = abut_obstacle_get(obstacle, &view);
  if (status != ABUT_SUCCESS)
    return status;
  if (view.dimension != secondary->view.dimension)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "surface and obstacle have different dimensions");
  return abut_coupling_create_any(context, call, secondary, NULL, obstacle,
                                  options, coupling);
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Obstacles between the nodes of facets, by a regular grid of points in each
 * facet: the middles of cells in lines and quadrilaterals, shifted corners in
 * triangles. */
#include "base/memory.h"
#include "geometry/surface.h"
#include "geometry/vector.h"

#include <abut/missed_contact.h>
#include <abut/obstacle_facets.h>

#include <stdbool.h>
#include <string.h>

typedef struct work
{
  abut_context *context;
  abut_obstacle *obstacle;
  const abut_surface_view *view;
  const double *normal; /* [n_nodes * dimension] */
  abut_facet_samples samples;
  int32_t kind, n_points; /* of the grid; kind -1: none yet */
  abut_array shape;       /* double, [n_points][n_nodes] */
  abut_array point;       /* double, [n_points * dimension] */
  abut_array start;       /* the same */
  abut_array distance;    /* double, [n_points] or [n_nodes of the surface] */
  abut_array at_node;     /* double, [n_nodes of the surface] */
  abut_array path;        /* abut_obstacle_path, [n_points] */
} work;

static abut_status
begin(work *w, const char *call, abut_obstacle *obstacle, abut_surface *surface,
      const abut_facet_samples *samples)
{
  memset(w, 0, sizeof(*w));
  if (surface == NULL)
    return ABUT_INVALID_ARGUMENT;
  w->context = surface->context;
  w->view = &surface->view;
  w->obstacle = obstacle;
  w->kind = -1;
  w->shape.element = w->point.element = w->start.element = sizeof(double);
  w->distance.element = w->at_node.element = sizeof(double);
  w->path.element = sizeof(abut_obstacle_path);
  w->samples = abut_facet_samples_defaults();
  abut_status status =
      abut_copy_in(w->context, call, &w->samples, sizeof(w->samples), samples);
  if (status != ABUT_SUCCESS)
    return status;
  if (obstacle == NULL || w->samples.n < 1)
    return abut_fail(w->context, ABUT_INVALID_ARGUMENT, call,
                     "obstacle is NULL or n below 1");
  if (w->samples.position == NULL)
    w->samples.position = w->view->position;
  if (w->samples.made == NULL)
    w->samples.made = w->view->position;
  return abut_surface_normals(surface, &w->normal);
}

static void
finish(work *w)
{
  abut_array *all[] = {&w->shape,    &w->point,   &w->start,
                       &w->distance, &w->at_node, &w->path};
  for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); ++i)
    abut_array_release(w->context, all[i]);
}

static bool
is_wanted(const work *w, int32_t f)
{
  return w->samples.wanted == NULL || w->samples.wanted[f] != 0;
}

static int32_t
n_nodes_of(const work *w, int32_t f)
{
  return w->view->facet_start[f + 1] - w->view->facet_start[f];
}

static int32_t
node_of(const work *w, int32_t f, int32_t a)
{
  return w->view->connectivity[w->view->facet_start[f] + a];
}

static void
place_of(const work *w, const double *position, int32_t f, int32_t a, double *x)
{
  load3(position, w->view->dimension, node_of(w, f, a), x);
}

/* Longest distance of the first node to another one. */
static double
size_of(const work *w, int32_t f)
{
  double first[3], size = 0.;
  place_of(w, w->samples.position, f, 0, first);
  for (int32_t a = 0; a < n_nodes_of(w, f); ++a)
  {
    double x[3], d[3];
    place_of(w, w->samples.position, f, a, x);
    sub3(x, first, d);
    size = max2(size, norm3(d));
  }
  return size;
}

static abut_status
find_distances(work *w, int32_t n, const double *points, abut_array *distance)
{
  const abut_status status = abut_array_reserve(w->context, distance, 0, n);
  return status == ABUT_SUCCESS ? abut_obstacle_distance(
             w->obstacle, n, points, distance->data, NULL, NULL)
                                : status;
}

/* Least distance of the nodes of a facet, once all are known. */
static double
nearest_of(const work *w, int32_t f)
{
  double nearest = INFINITY;
  for (int32_t a = 0; a < n_nodes_of(w, f); ++a)
    nearest =
        min2(nearest, ((const double *)w->at_node.data)[node_of(w, f, a)]);
  return nearest;
}

/* Local coordinates of point k of the n * n, or n, of a grid; false: it is not
 * in the facet. */
static bool
grid_point(int32_t kind, int32_t dimension, int32_t n, int32_t k, double *local)
{
  const int32_t i = k % n, j = k / n;
  local[1] = 0.;
  if (abut_facet_n_corners((abut_facet_kind)kind) == 3)
  {
    local[0] = (i + 1. / 3.) / n;
    local[1] = (j + 1. / 3.) / n;
    return local[0] + local[1] < 1.;
  }
  local[0] = (2. * i + 1.) / n - 1.;
  if (dimension == 3)
    local[1] = (2. * j + 1.) / n - 1.;
  return true;
}

/* Shape functions at the points of the grid of a kind of facet. */
static abut_status
tabulate(work *w, int32_t kind)
{
  if (w->kind == kind)
    return ABUT_SUCCESS;
  const int32_t n = w->samples.n, dim = w->view->dimension,
                n_nodes = abut_facet_n_nodes((abut_facet_kind)kind),
                most = dim == 2 ? n : n * n;
  abut_status status =
      abut_array_reserve(w->context, &w->shape, 0, (int64_t)most * n_nodes);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(w->context, &w->point, 0, (int64_t)most * dim);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(w->context, &w->start, 0, (int64_t)most * dim);
  double *shape = w->shape.data;
  w->n_points = 0;
  for (int32_t k = 0; k < most && status == ABUT_SUCCESS; ++k)
  {
    double local[2];
    if (grid_point(kind, dim, n, k, local))
      status = abut_facet_shape((abut_facet_kind)kind, local,
                                shape + (int64_t)w->n_points++ * n_nodes, NULL,
                                NULL);
  }
  w->kind = status == ABUT_SUCCESS ? kind : -1;
  return status;
}

/* The points of the grid of a facet whose nodes are at these positions. */
static void
grid_points(const work *w, int32_t f, const double *position, double *points)
{
  const int32_t dim = w->view->dimension, n = n_nodes_of(w, f);
  const double *shape = w->shape.data;
  for (int32_t q = 0; q < w->n_points; ++q)
    for (int32_t d = 0; d < dim; ++d)
    {
      double x = 0.;
      for (int32_t a = 0; a < n; ++a)
        x += shape[(int64_t)q * n + a]
             * position[(int64_t)node_of(w, f, a) * dim + d];
      points[(int64_t)q * dim + d] = x;
    }
}

/* How far a facet is before the hollow curve through its nodes at the most: all
 * of an obstacle that fits is in the facet that far. It is h^2 / (8 R) by the
 * rotation of the normals, twice: at the ends of a surface they are those of
 * one facet and rotate by half. */
static double
hollow_of(const work *w, int32_t f)
{
  double hollow = 0.;
  for (int32_t a = 0; a < n_nodes_of(w, f); ++a)
    for (int32_t b = 0; b < a; ++b)
    {
      double x[3], y[3], m[3], n[3];
      place_of(w, w->samples.made, f, a, x);
      place_of(w, w->samples.made, f, b, y);
      load3(w->normal, w->view->dimension, node_of(w, f, a), m);
      load3(w->normal, w->view->dimension, node_of(w, f, b), n);
      sub3(x, y, x);
      sub3(m, n, m);
      hollow = max2(hollow, -0.25 * dot3(m, x));
    }
  return hollow;
}

/* The part of the depths at the points [n_points] of a facet that its nodes do
 * not see. */
static abut_status
find_peak(work *w, int32_t f, const double *depth, double *peak)
{
  const int32_t dim = w->view->dimension, n = n_nodes_of(w, f);
  double node[3 * ABUT_FACET_MAX_NODES], known = INFINITY;
  for (int32_t a = 0; a < n; ++a)
    memcpy(node + (int64_t)a * dim,
           w->samples.made + (int64_t)node_of(w, f, a) * dim,
           (size_t)dim * sizeof(double));
  abut_status status = find_distances(w, n, node, &w->distance);
  const double *gap = w->distance.data;
  for (int32_t a = 0; a < n && status == ABUT_SUCCESS; ++a)
    known = min2(known, gap[a]);
  known -= hollow_of(w, f);
  grid_points(w, f, w->samples.made, w->start.data);
  if (status == ABUT_SUCCESS)
    status = find_distances(w, w->n_points, w->start.data, &w->distance);
  gap = w->distance.data;
  *peak = 0.;
  for (int32_t q = 0; q < w->n_points && status == ABUT_SUCCESS; ++q)
    *peak = max2(*peak, min2(known - gap[q], depth[q]));
  return status;
}

/* Look at the points of a facet; depth 0: nothing is inside. */
static abut_status
look_at_facet(work *w, int32_t f, abut_array *depths, abut_facet_depth *here)
{
  const int32_t dim = w->view->dimension;
  abut_status status = tabulate(w, w->view->kinds[f]);
  if (status != ABUT_SUCCESS)
    return status;
  double *points = w->point.data;
  grid_points(w, f, w->samples.position, points);
  status = find_distances(w, w->n_points, points, depths);
  double *depth = depths->data;
  for (int32_t q = 0; q < w->n_points && status == ABUT_SUCCESS; ++q)
  {
    depth[q] = -depth[q] - w->samples.gap;
    if (depth[q] <= here->depth)
      continue;
    here->depth = depth[q];
    load3(points, dim, q, here->place);
  }
  return status == ABUT_SUCCESS && here->depth > 0.
             ? find_peak(w, f, depth, &here->peak)
             : status;
}

static abut_status
find_in_facets(work *w, abut_facet_depth *found, int32_t *n_found)
{
  abut_obstacle_view obstacle;
  abut_array depths = {NULL, 0, sizeof(double)};
  abut_status status = abut_obstacle_get(w->obstacle, &obstacle);
  if (status == ABUT_SUCCESS)
    status =
        find_distances(w, w->view->n_nodes, w->samples.position, &w->at_node);
  for (int32_t f = 0; f < w->view->n_facets && status == ABUT_SUCCESS; ++f)
  {
    if (!is_wanted(w, f))
      continue;
    abut_facet_depth here = {f, 0, 0., size_of(w, f), 0., {0., 0., 0.}};
    if (obstacle.kind != ABUT_OBSTACLE_FUNCTION
        && nearest_of(w, f) + w->samples.gap > here.size)
      continue;
    status = look_at_facet(w, f, &depths, &here);
    if (status == ABUT_SUCCESS && here.depth > 0.)
      found[(*n_found)++] = here;
  }
  abut_array_release(w->context, &depths);
  return status;
}

abut_status
abut_obstacle_in_facets(abut_obstacle *obstacle, abut_surface *surface,
                        const abut_facet_samples *samples,
                        abut_facet_depth *found, int32_t *n_found)
{
  static const char call[] = "abut_obstacle_in_facets";
  work w;
  abut_status status = begin(&w, call, obstacle, surface, samples);
  if (status != ABUT_SUCCESS)
    return status;
  if (n_found == NULL || (w.view->n_facets > 0 && found == NULL))
    return abut_fail(w.context, ABUT_INVALID_ARGUMENT, call,
                     "a result is NULL");
  *n_found = 0;
  status = find_in_facets(&w, found, n_found);
  finish(&w);
  return status;
}

/* The longest of the paths of a facet's points that pass through. */
static abut_status
follow_facet(work *w, int32_t f, const double *from, double *way)
{
  const int32_t dim = w->view->dimension;
  abut_status status = tabulate(w, w->view->kinds[f]);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(w->context, &w->path, 0, w->n_points);
  if (status != ABUT_SUCCESS)
    return status;
  grid_points(w, f, from, w->start.data);
  grid_points(w, f, w->samples.position, w->point.data);
  status = abut_obstacle_follow(w->obstacle, w->n_points, w->start.data,
                                w->point.data, w->path.data);
  const abut_obstacle_path *path = w->path.data;
  for (int32_t q = 0; q < w->n_points && status == ABUT_SUCCESS; ++q)
  {
    double a[3], b[3];
    load3(w->start.data, dim, q, a);
    load3(w->point.data, dim, q, b);
    sub3(b, a, b);
    if (path[q].through != 0)
      *way = max2(*way, norm3(b));
  }
  return status;
}

abut_status
abut_obstacle_passes_facets(abut_obstacle *obstacle, abut_surface *surface,
                            const abut_facet_samples *samples,
                            const double *from, double *way)
{
  static const char call[] = "abut_obstacle_passes_facets";
  work w;
  abut_status status = begin(&w, call, obstacle, surface, samples);
  if (status != ABUT_SUCCESS)
    return status;
  if (way == NULL || (w.view->n_nodes > 0 && from == NULL))
    return abut_fail(w.context, ABUT_INVALID_ARGUMENT, call,
                     "positions or the result are NULL");
  *way = 0.;
  for (int32_t f = 0; f < w.view->n_facets && status == ABUT_SUCCESS; ++f)
    if (is_wanted(&w, f))
      status = follow_facet(&w, f, from, way);
  finish(&w);
  return status;
}

/* Width of the obstacle for a surface along the first corners of a facet. */
static double
width_at(const work *w, int32_t f)
{
  double n[3];
  abut_surface_corner_normal(w->view, f, w->samples.position, n);
  (void)unit3(n, 0.);
  return abut_obstacle_width(w->obstacle, n);
}

static const abut_obstacle_beside none = {INFINITY, 1., INFINITY, 0, 0};

static abut_status
find_narrowest(work *w, abut_obstacle_beside *result)
{
  *result = none;
  abut_status status =
      find_distances(w, w->view->n_nodes, w->samples.position, &w->at_node);
  for (int32_t f = 0; f < w->view->n_facets && status == ABUT_SUCCESS; ++f)
  {
    if (!is_wanted(w, f))
      continue;
    const double size = size_of(w, f), width = width_at(w, f);
    if (nearest_of(w, f) + w->samples.gap <= size
        && width / size < result->width / result->size)
    {
      result->width = width;
      result->size = size;
    }
  }
  return status;
}

abut_status
abut_obstacle_narrowest(abut_obstacle *obstacle, abut_surface *surface,
                        const abut_facet_samples *samples,
                        abut_obstacle_beside *result)
{
  static const char call[] = "abut_obstacle_narrowest";
  work w;
  abut_status status = begin(&w, call, obstacle, surface, samples);
  if (status != ABUT_SUCCESS)
    return status;
  if (result == NULL)
    return abut_fail(w.context, ABUT_INVALID_ARGUMENT, call, "result is NULL");
  status = find_narrowest(&w, result);
  finish(&w);
  return status;
}

/* A point beside a facet, if it is nearer to its middle than before. */
static void
compare_middle(const work *w, int32_t f, const double *point,
               abut_obstacle_beside *result)
{
  const int32_t n_nodes = n_nodes_of(w, f);
  double middle[3] = {0.}, normal[3] = {0.}, way[3];
  for (int32_t a = 0; a < n_nodes; ++a)
  {
    double x[3], n[3];
    place_of(w, w->samples.position, f, a, x);
    load3(w->normal, w->view->dimension, node_of(w, f, a), n);
    for (int d = 0; d < 3; ++d)
    {
      middle[d] += x[d] / n_nodes;
      normal[d] += n[d];
    }
  }
  sub3(point, middle, way);
  const double distance = norm3(way);
  if (distance >= result->distance)
    return;
  (void)unit3(normal, 0.);
  const double height = dot3(normal, way), size = size_of(w, f),
               width = width_at(w, f);
  axpy3(way, -height, normal, way);
  const abut_obstacle_beside nearer = {
      width, size, distance, norm3(way) <= 0.5 * size && height > -width, 0};
  *result = nearer;
}

abut_status
abut_obstacle_beside_facet(abut_obstacle *obstacle, abut_surface *surface,
                           const abut_facet_samples *samples,
                           const double *point, abut_obstacle_beside *result)
{
  static const char call[] = "abut_obstacle_beside_facet";
  work w;
  const abut_status status = begin(&w, call, obstacle, surface, samples);
  if (status != ABUT_SUCCESS)
    return status;
  if (point == NULL || result == NULL)
    return abut_fail(w.context, ABUT_INVALID_ARGUMENT, call,
                     "point or result is NULL");
  double x[3];
  load3(point, w.view->dimension, 0, x);
  *result = none;
  for (int32_t f = 0; f < w.view->n_facets; ++f)
    if (is_wanted(&w, f))
      compare_middle(&w, f, x, result);
  finish(&w);
  return ABUT_SUCCESS;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Signed distance to a surface of facets.
 *
 * 1  Points look for facets within a reach h that starts at the median size of
 *    a facet and grows by a factor of three.
 * 2  Candidates whose ball (centre, radius) lies farther than the nearest
 *    centre are skipped, the others projected onto. A nearest facet at most h
 *    away is the nearest of all, since the search lists every facet within h.
 * 3  Points farther than an eighth of the surface's box would list most of the
 *    surface, and a round for a FEW points costs more in boxes to be inflated
 *    than it saves: these go through all balls instead, without lists.
 * 4  Sign and gradient: within a facet its normal; else the direction from the
 *    nearest point, on the side that the pseudonormal tells.
 *
 * Lists are made for blocks of points, which are kept so small that they hold
 * at most about LISTED pairs. O(n) near the surface, O(n facets) far from it.
 */
#include "geometry/kernels.h"
#include "geometry/obstacle.h"
#include "geometry/pseudonormal.h"
#include "geometry/vector.h"

#include <abut/obstacle_surface.h>
#include <string.h>

enum
{
  BLOCK = 4096,
  LISTED = 1 << 20,
  GROWTH = 3,
  FEW = 32
};

typedef struct surface_obstacle
{
  abut_obstacle base;
  abut_surface *surface;
  abut_search *search;
  abut_pairs *pairs;
  double limit;       /* infinite: none */
  uint64_t revision;  /* of the surface that what follows belongs to */
  double size;        /* median size of a facet */
  double diagonal;    /* of the box */
  double centre[3];   /* of the box */
  abut_array balls;   /* double, [4 * n_facets] centre and radius */
  abut_array waiting; /* int32_t, points without a facet yet */
  abut_array block;   /* double, positions of those asked for */
} surface_obstacle;

static void
release(abut_obstacle *o)
{
  surface_obstacle *s = (surface_obstacle *)o;
  abut_array_release(o->context, &s->balls);
  abut_array_release(o->context, &s->waiting);
  abut_array_release(o->context, &s->block);
  (void)abut_pairs_destroy(&s->pairs);
  (void)abut_search_destroy(&s->search);
}

/* Sizes of the surface and balls of its facets at the present positions. */
static abut_status
refresh(surface_obstacle *s)
{
  if (s->revision == s->surface->revision)
    return ABUT_SUCCESS;
  const int32_t n = s->surface->view.n_facets;
  abut_surface_sizes z;
  abut_status status = abut_surface_measure(s->surface, &z);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->base.context, &s->balls, 0, 4 * (int64_t)n);
  if (status != ABUT_SUCCESS)
    return status;
  double extent[3];
  sub3(z.upper, z.lower, extent);
  s->size = z.median;
  s->diagonal = norm3(extent);
  for (int d = 0; d < 3; ++d)
    s->centre[d] = 0.5 * (z.lower[d] + z.upper[d]);
  double *ball = s->balls.data;
  for (int32_t f = 0; f < n; ++f, ball += 4)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES];
    abut_facet_measures m;
    abut_surface_gather(s->surface, f, nodes);
    status = abut_facet_measure((abut_facet_kind)s->surface->view.kinds[f],
                                nodes, &m);
    if (status != ABUT_SUCCESS)
      return status;
    memcpy(ball, m.centre, sizeof(m.centre));
    ball[3] = m.radius;
  }
  s->revision = s->surface->revision;
  return ABUT_SUCCESS;
}

/* Nearest of the n facets listed (NULL: of facets 0 .. n - 1), the first of
 * equally near ones, and the projection; or -1. x has three components. */
static int32_t
nearest_facet(const surface_obstacle *s, const int32_t *list, int32_t n,
              const double *x, abut_projection *best)
{
  const double *balls = s->balls.data;
  double upper = INFINITY;
  int32_t found = -1;
  for (int32_t i = 0; i < n; ++i)
  {
    const double *ball = balls + 4 * (int64_t)(list != NULL ? list[i] : i);
    double r[3];
    sub3(x, ball, r);
    upper = min2(upper, dot3(r, r));
  }
  /* Round-off must not exclude the facet whose centre is nearest. */
  upper = sqrt(upper) * (1. + 1e-12);
  for (int32_t i = 0; i < n; ++i)
  {
    const int32_t f = list != NULL ? list[i] : i;
    const double *ball = balls + 4 * (int64_t)f;
    double r[3], nodes[3 * ABUT_FACET_MAX_NODES];
    sub3(x, ball, r);
    if (dot3(r, r) > (upper + ball[3]) * (upper + ball[3]))
      continue;
    abut_projection p;
    abut_surface_gather(s->surface, f, nodes);
    abut_project((abut_facet_kind)s->surface->view.kinds[f], nodes, x, &p);
    if (found >= 0 && !(p.distance < best->distance))
      continue;
    *best = p;
    found = f;
    upper = min2(upper, p.distance);
  }
  return found;
}

/* Step 4. */
static void
store(const surface_obstacle *s, int32_t f, const abut_projection *p,
      const double *x, double *distance, double *gradient)
{
  double n[3], r[3];
  abut_pseudonormal(s->surface, f, p, n);
  sub3(x, p->point, r);
  if (p->inside)
    *distance = p->gap;
  else
  {
    const double side = dot3(r, n) < 0. ? -1. : 1.;
    *distance = side * p->distance;
    /* On the surface the direction is round-off. */
    if (p->distance > 1e-12 * (norm3(x) + s->size))
      for (int d = 0; d < 3; ++d)
        n[d] = side * r[d] / p->distance;
  }
  memcpy(gradient, n, (size_t)s->surface->view.dimension * sizeof(*gradient));
}

/* A point farther than the limit: away from the middle of the surface. Outside
 * the material, also if that is hollow. */
static void
store_beyond(surface_obstacle *s, const double *x, double *distance,
             double *gradient)
{
  const int32_t dimension = s->surface->view.dimension;
  const double sign = s->base.view.hollow ? -1. : 1.;
  double r[3];
  sub3(x, s->centre, r);
  if (!(unit3(r, ABUT_TINY) > 0.) || dot3(r, r) == 0.)
    r[dimension - 1] = 1.;
  *distance = sign * s->limit;
  for (int32_t d = 0; d < dimension; ++d)
    gradient[d] = sign * r[d];
  ++s->base.view.n_beyond;
}

static void
load(const double *points, int32_t dimension, int32_t i, double *x)
{
  x[2] = 0.;
  for (int32_t d = 0; d < dimension; ++d)
    x[d] = points[(int64_t)i * dimension + d];
}

/* Where results go. */
typedef struct results
{
  const double *points;
  double *distance;
  double *gradient;
} results;

/* Step 3. */
static void
go_through_all(surface_obstacle *s, const results *out, int32_t n,
               const int32_t *waiting)
{
  const int32_t dimension = s->surface->view.dimension;
  for (int32_t k = 0; k < n; ++k)
  {
    const int32_t i = waiting[k];
    double x[3], *g = out->gradient + (int64_t)i * dimension;
    abut_projection p;
    load(out->points, dimension, i, x);
    const int32_t f = nearest_facet(s, NULL, s->surface->view.n_facets, x, &p);
    if (p.distance > s->limit)
      store_beyond(s, x, out->distance + i, g);
    else
      store(s, f, &p, x, out->distance + i, g);
  }
}

/* Steps 1 and 2 for the first n waiting points with reach h; keeps those that
 * go on waiting at the front of `left` and adds up their number. */
static abut_status
ask(surface_obstacle *s, const results *out, double h, int32_t n,
    const int32_t *waiting, int32_t *left, int32_t *n_left, int64_t *n_pairs)
{
  const int32_t dimension = s->surface->view.dimension;
  abut_status status =
      abut_array_reserve(s->base.context, &s->block, 0, (int64_t)n * dimension);
  if (status != ABUT_SUCCESS)
    return status;
  double *block = s->block.data;
  for (int32_t k = 0; k < n; ++k)
    memcpy(block + (int64_t)k * dimension,
           out->points + (int64_t)waiting[k] * dimension,
           (size_t)dimension * sizeof(*block));
  abut_pairs_view v;
  status = abut_search_points(s->search, n, block, s->pairs);
  if (status == ABUT_SUCCESS)
    status = abut_pairs_get(s->pairs, &v);
  if (status != ABUT_SUCCESS)
    return status;
  *n_pairs = v.start[n];
  for (int32_t k = 0; k < n; ++k)
  {
    const int32_t i = waiting[k];
    double x[3], *g = out->gradient + (int64_t)i * dimension;
    abut_projection p;
    load(out->points, dimension, i, x);
    const int32_t f = nearest_facet(
        s, v.facet + v.start[k], (int32_t)(v.start[k + 1] - v.start[k]), x, &p);
    if (f >= 0 && p.distance <= min2(h, s->limit))
      store(s, f, &p, x, out->distance + i, g);
    else if (h >= s->limit)
      store_beyond(s, x, out->distance + i, g);
    else
      left[(*n_left)++] = i;
  }
  return ABUT_SUCCESS;
}

/* One round: all waiting points with reach h, in blocks. */
static abut_status
ask_all(surface_obstacle *s, const results *out, double h, int32_t *n_waiting)
{
  int32_t *waiting = s->waiting.data, n_left = 0;
  int64_t per_point = 1;
  abut_status status = abut_search_set_reach(s->search, h, 0., 0.);
  for (int32_t first = 0; status == ABUT_SUCCESS && first < *n_waiting;)
  {
    const int64_t fit = LISTED / per_point;
    const int32_t most = fit < 16 ? 16 : fit < BLOCK ? (int32_t)fit : BLOCK;
    const int32_t rest = *n_waiting - first, n = rest < most ? rest : most;
    int64_t n_pairs = 0;
    /* Points are read before their place is overwritten: at most as many stay
     * as have been asked for. */
    status = ask(s, out, h, n, waiting + first, waiting, &n_left, &n_pairs);
    per_point = 1 + n_pairs / n;
    first += n;
  }
  *n_waiting = n_left;
  return status;
}

static abut_status
evaluate(abut_obstacle *o, int32_t n, const double *points, double *distance,
         double *gradient, double *hessian)
{
  surface_obstacle *s = (surface_obstacle *)o;
  const results out = {points, distance, gradient};
  (void)hessian;
  abut_status status = refresh(s);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(o->context, &s->waiting, 0, n);
  if (status != ABUT_SUCCESS)
    return status;
  int32_t *waiting = s->waiting.data, n_waiting = n;
  for (int32_t i = 0; i < n; ++i)
    waiting[i] = i;
  double h = min2(s->size, s->limit);
  while (status == ABUT_SUCCESS && n_waiting > FEW && h < 0.125 * s->diagonal)
  {
    status = ask_all(s, &out, h, &n_waiting);
    h = h < s->limit ? min2(GROWTH * h, s->limit) : INFINITY;
  }
  if (status == ABUT_SUCCESS)
    go_through_all(s, &out, n_waiting, waiting);
  return status;
}

static const abut_obstacle_methods methods = {evaluate, release, false};

static abut_status
refuse_facet(abut_context *context, const char *call, int32_t f,
             const char *what)
{
  abut_text text = abut_fail_begin(context, call);
  abut_text_add(&text, "facet ");
  abut_text_add_integer(&text, f);
  abut_text_add(&text, what);
  return ABUT_INVALID_MESH;
}

static abut_status
check_sides(abut_context *context, const char *call, const abut_surface *s,
            bool open)
{
  for (int32_t f = 0; f < s->view.n_facets; ++f)
    for (int32_t k = 0; k < 4; ++k)
    {
      const int32_t across = s->view.neighbour[4 * (int64_t)f + k];
      if (across == ABUT_NEIGHBOUR_MANY)
        return refuse_facet(context, call, f,
                            " has a side where more than two facets meet");
      if (across == ABUT_NEIGHBOUR_BORDER && !open)
        return refuse_facet(context, call, f,
                            " has a side without a neighbour: the surface is "
                            "not closed");
    }
  return abut_surface_check_orientation(s);
}

/* Three times the volume within a closed surface (2D: twice the area). */
static double
enclosed(const surface_obstacle *s)
{
  double volume = 0.;
  for (int32_t f = 0; f < s->surface->view.n_facets; ++f)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES], r[3];
    abut_facet_measures m;
    abut_surface_gather(s->surface, f, nodes);
    if (abut_facet_measure((abut_facet_kind)s->surface->view.kinds[f], nodes,
                           &m)
        != ABUT_SUCCESS)
      return 0.;
    sub3(m.centre, s->centre, r);
    volume += m.area * dot3(m.normal, r);
  }
  return volume;
}

static abut_status
prepare(surface_obstacle *s, const abut_search_options *options,
        const char *call, bool open)
{
  abut_context *context = s->base.context;
  abut_search_options chosen = *options;
  chosen.reach = chosen.relative_reach = chosen.skin = 0.;
  s->balls.element = s->block.element = sizeof(double);
  s->waiting.element = sizeof(int32_t);
  abut_status status =
      abut_search_create(context, s->surface, &chosen, &s->search);
  if (status == ABUT_SUCCESS)
    status = abut_pairs_create(context, &s->pairs);
  if (status == ABUT_SUCCESS)
    status = check_sides(context, call, s->surface, open);
  if (status == ABUT_SUCCESS)
    status = refresh(s);
  if (status == ABUT_SUCCESS && !open && !(enclosed(s) > 0.))
    status = refuse_facet(context, call, 0,
                          " and all others point inwards: the surface is "
                          "inside out");
  return status;
}

abut_status
abut_obstacle_create_surface(abut_context *context, abut_surface *surface,
                             const abut_obstacle_surface *options,
                             abut_obstacle **obstacle)
{
  static const char call[] = "abut_obstacle_create_surface";
  const abut_obstacle_surface chosen =
      options != NULL ? *options : abut_obstacle_surface_defaults();
  if (context == NULL || surface == NULL || obstacle == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "context, surface or result is NULL");
  if (chosen.struct_size != sizeof(chosen))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "options of another version");
  if (!(chosen.limit >= 0. && chosen.limit <= ABUT_FACET_LIMIT))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "limit is negative or not finite");
  if (surface->view.n_facets == 0)
    return abut_fail(context, ABUT_INVALID_MESH, call,
                     "the surface has no facets");
  surface_obstacle *s = abut_obstacle_make(
      context, call, sizeof(*s), &methods, ABUT_OBSTACLE_SURFACE,
      surface->view.dimension, chosen.hollow);
  if (s == NULL)
    return ABUT_OUT_OF_MEMORY;
  s->surface = surface;
  s->limit = chosen.limit > 0. ? chosen.limit : INFINITY;
  s->base.view.limit = chosen.limit;
  const abut_status status = prepare(s, &chosen.search, call, chosen.open);
  abut_obstacle *made = &s->base;
  if (status != ABUT_SUCCESS)
  {
    (void)abut_obstacle_destroy(&made);
    return status;
  }
  *obstacle = made;
  return ABUT_SUCCESS;
}

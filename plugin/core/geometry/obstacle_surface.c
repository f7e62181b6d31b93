/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Signed distance to a surface of facets: the nearest one by a tree of boxes;
 * within it sign and gradient are those of its normal, else the gradient is the
 * direction from the nearest point, on the side that the pseudonormal decides.
 */
#include "geometry/facet_tree.h"
#include "geometry/kernels.h"
#include "geometry/obstacle.h"
#include "geometry/pseudonormal.h"
#include "geometry/vector.h"

#include <abut/obstacle_surface.h>
#include <string.h>

typedef struct surface_obstacle
{
  abut_obstacle base;
  abut_surface *surface;
  double limit;      /* infinite: none */
  uint64_t revision; /* of the surface that what follows belongs to */
  double size;       /* median size of a facet */
  double centre[3];  /* of the box */
  abut_facet_tree tree;
} surface_obstacle;

static void
release(abut_obstacle *o)
{
  abut_facet_tree_release(o->context, &((surface_obstacle *)o)->tree);
}

/* Sizes of the surface and its tree at the current positions. */
static abut_status
refresh(surface_obstacle *s)
{
  if (s->revision == s->surface->revision)
    return ABUT_SUCCESS;
  abut_surface_sizes z;
  abut_status status = abut_surface_measure(s->surface, &z);
  if (status == ABUT_SUCCESS)
    status = abut_facet_tree_build(s->base.context, s->surface, &s->tree);
  if (status != ABUT_SUCCESS)
    return status;
  s->size = z.median;
  for (int d = 0; d < 3; ++d)
    s->centre[d] = 0.5 * (z.lower[d] + z.upper[d]);
  s->revision = s->surface->revision;
  return ABUT_SUCCESS;
}

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
  const int32_t dimension = s->surface->view.dimension == 2 ? 2 : 3;
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

static abut_status
evaluate(abut_obstacle *o, int32_t n, const double *points, double *distance,
         double *gradient, double *hessian)
{
  surface_obstacle *s = (surface_obstacle *)o;
  const int32_t dimension = o->view.dimension;
  const abut_status status = refresh(s);
  if (status != ABUT_SUCCESS)
    return status;
  if (hessian != NULL)
    memset(hessian, 0,
           (size_t)n * (size_t)(dimension * dimension) * sizeof(*hessian));
  for (int64_t i = 0; i < n; ++i)
  {
    double x[3] = {0., 0., 0.}, *g = gradient + i * dimension;
    abut_projection p;
    memcpy(x, points + i * dimension, (size_t)dimension * sizeof(*x));
    const int32_t f =
        abut_facet_tree_nearest(&s->tree, s->surface, x, s->limit, &p);
    if (f >= 0)
      store(s, f, &p, x, distance + i, g);
    else
      store_beyond(s, x, distance + i, g);
  }
  return ABUT_SUCCESS;
}

static const abut_obstacle_methods methods = {evaluate, NULL, release};

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
                            " has an edge with more than two facets");
      if (across == ABUT_NEIGHBOUR_BORDER && !open)
        return refuse_facet(
            context, call, f,
            " has an edge without a neighbour: the surface is not closed");
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
prepare(surface_obstacle *s, const char *call, bool open)
{
  abut_context *context = s->base.context;
  abut_facet_tree_prepare(&s->tree);
  abut_status status = check_sides(context, call, s->surface, open);
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
  abut_obstacle_surface chosen = abut_obstacle_surface_defaults();
  if (context == NULL || surface == NULL || obstacle == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "context, surface or result is NULL");
  abut_status status =
      abut_copy_in(context, call, &chosen, sizeof(chosen), options);
  if (status != ABUT_SUCCESS)
    return status;
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
  status = prepare(s, call, chosen.open);
  abut_obstacle *made = &s->base;
  if (status != ABUT_SUCCESS)
  {
    (void)abut_obstacle_destroy(&made);
    return status;
  }
  *obstacle = made;
  return ABUT_SUCCESS;
}

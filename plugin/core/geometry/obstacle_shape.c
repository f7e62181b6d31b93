/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Obstacles of closed formulas: checks of their numbers, and the loop over
 * points around the kernels. */
#include "geometry/obstacle_shape.h"

#include "geometry/kernels.h"
#include "geometry/obstacle.h"
#include "geometry/vector.h"

#include <string.h>

typedef struct shape_obstacle
{
  abut_obstacle base;
  abut_shape_data data;
  void (*kernel)(const abut_shape_data *s, const double *x,
                 abut_shape_distance *d);
} shape_obstacle;

static abut_status
evaluate(abut_obstacle *o, int32_t n, const double *points, double *distance,
         double *gradient, double *hessian)
{
  const shape_obstacle *s = (const shape_obstacle *)o;
  const int32_t dimension = o->view.dimension;
  for (int64_t i = 0; i < n; ++i)
  {
    double x[3] = {0., 0., 0.};
    abut_shape_distance d;
    for (int32_t k = 0; k < dimension; ++k)
      x[k] = points[i * dimension + k];
    s->kernel(&s->data, x, &d);
    distance[i] = d.value;
    for (int32_t k = 0; k < dimension; ++k)
      gradient[i * dimension + k] = d.gradient[k];
    if (hessian == NULL)
      continue;
    for (int32_t k = 0; k < dimension; ++k)
      for (int32_t l = 0; l < dimension; ++l)
        hessian[(i * dimension + k) * dimension + l] = d.hessian[3 * k + l];
  }
  return ABUT_SUCCESS;
}

static const abut_obstacle_methods methods = {evaluate, NULL, NULL};

static bool
is_length(double v)
{
  return v > 0. && v <= ABUT_FACET_LIMIT;
}

static void prepare_cylinder(abut_shape_data *s);
static void prepare_cone(abut_shape_data *s);
static void sphere_extents(const abut_obstacle_shape *s,
                           abut_obstacle_extents *e);
static void cylinder_extents(const abut_obstacle_shape *s,
                             abut_obstacle_extents *e);
static void box_extents(const abut_obstacle_shape *s, abut_obstacle_extents *e);

/* A shape: its fields, its kernel with what that needs, and its size. */
typedef struct shape_entry
{
  uint32_t fields; /* sum of abut_shape_field; none: no shape */
  void (*kernel)(const abut_shape_data *s, const double *x,
                 abut_shape_distance *d);
  void (*prepare)(abut_shape_data *s); /* or NULL */
  void (*extents)(const abut_obstacle_shape *s, abut_obstacle_extents *e);
  /* NULL: not bounded; its axis is unit */
  bool smooth;           /* no edges, corners or tips */
  const char *not_in_2d; /* why it exists in 3D only; NULL: in 2D, too */
} shape_entry;

static const shape_entry shapes[ABUT_OBSTACLE_N_KINDS] = {
    [ABUT_OBSTACLE_PLANE] = {ABUT_SHAPE_AXIS, abut_plane_distance, NULL, NULL,
                             true, NULL},
    [ABUT_OBSTACLE_SPHERE] = {ABUT_SHAPE_RADIUS, abut_sphere_distance, NULL,
                              sphere_extents, true, NULL},
    [ABUT_OBSTACLE_CYLINDER] = {ABUT_SHAPE_AXIS | ABUT_SHAPE_RADIUS
                                    | ABUT_SHAPE_LENGTH,
                                abut_revolved_distance, prepare_cylinder,
                                cylinder_extents, false,
                                "a cylinder exists in 3 dimensions only; in 2, "
                                "its section is a sphere or a box"},
    [ABUT_OBSTACLE_BOX] = {ABUT_SHAPE_SIZE, abut_box_distance, NULL,
                           box_extents, false, NULL},
    [ABUT_OBSTACLE_CONE] = {
        ABUT_SHAPE_AXIS | ABUT_SHAPE_LENGTH | ABUT_SHAPE_ANGLE,
        abut_revolved_distance, prepare_cone, NULL, false, NULL}};

uint32_t
abut_obstacle_fields(abut_obstacle_kind kind)
{
  const int i = (int)kind;
  return i >= 0 && i < ABUT_OBSTACLE_N_KINDS ? shapes[i].fields : 0;
}

/* Error in a number that belongs to the kind, or NULL. */
static const char *
fault_of_numbers(const abut_obstacle_shape *s)
{
  const uint32_t fields = shapes[s->kind].fields;
  if ((fields & ABUT_SHAPE_RADIUS) != 0 && !is_length(s->radius))
    return "radius is not positive and finite";
  if ((fields & ABUT_SHAPE_LENGTH) != 0 && s->length != 0.
      && !is_length(s->length))
    return "length is negative or not finite";
  if ((fields & ABUT_SHAPE_ANGLE) != 0
      && !(s->angle >= 1e-8 && s->angle <= 1.5707963))
    return "angle is not between 0 and pi/2";
  for (int32_t d = 0; (fields & ABUT_SHAPE_SIZE) != 0 && d < s->dimension; ++d)
    if (!is_length(s->size[d]))
      return "size is not positive and finite";
  return NULL;
}

static bool
uses_axis(const abut_obstacle_shape *s)
{
  return (shapes[s->kind].fields & ABUT_SHAPE_AXIS) != 0;
}

static abut_status
check(abut_context *context, const char *call, const abut_obstacle_shape *s)
{
  if (s->dimension != 2 && s->dimension != 3)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "dimension is neither 2 nor 3");
  if (abut_obstacle_fields(s->kind) == 0)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "kind is not one of the shapes");
  if (s->dimension == 2 && shapes[s->kind].not_in_2d != NULL)
    return abut_fail(context, ABUT_UNSUPPORTED, call,
                     shapes[s->kind].not_in_2d);
  if (!abut_facet_finite(s->point, s->dimension))
    return abut_fail(context, ABUT_NOT_FINITE, call,
                     "point is NaN, infinite or out of range");
  if (uses_axis(s) && !abut_facet_finite(s->axis, s->dimension))
    return abut_fail(context, ABUT_NOT_FINITE, call,
                     "axis is NaN, infinite or out of range");
  const char *fault = fault_of_numbers(s);
  if (fault != NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, fault);
  return ABUT_SUCCESS;
}

/* Scale to unit length, whatever the size; false for the zero vector. */
static bool
make_unit(double *a)
{
  const double largest = max2(fabs(a[0]), max2(fabs(a[1]), fabs(a[2])));
  if (!(largest > 0.))
    return false;
  for (int d = 0; d < 3; ++d)
    a[d] /= largest;
  unit3(a, 0.);
  return true;
}

/* A unit vector orthogonal to the axis, in the plane in 2D. */
static void
find_across(int32_t dimension, const double *axis, double *across)
{
  if (dimension == 2)
  {
    across[0] = axis[1];
    across[1] = -axis[0];
    return;
  }
  int smallest = 0;
  for (int d = 1; d < 3; ++d)
    if (fabs(axis[d]) < fabs(axis[smallest]))
      smallest = d;
  double e[3] = {0., 0., 0.};
  e[smallest] = 1.;
  axpy3(e, -axis[smallest], axis, across);
  unit3(across, 0.);
}

/* The half plane around the axis of cylinder and cone. */
static void
prepare_cylinder(abut_shape_data *s)
{
  const abut_obstacle_shape *p = &s->shape;
  find_across(p->dimension, p->axis, s->across);
  s->side[0] = 1.;
  s->offset = p->radius;
  s->top = p->length > 0. ? 0.5 * p->length : INFINITY;
  s->corner[0] = p->radius;
  s->corner[1] = s->top;
}

static void
prepare_cone(abut_shape_data *s)
{
  const abut_obstacle_shape *p = &s->shape;
  find_across(p->dimension, p->axis, s->across);
  s->side[0] = cos(p->angle);
  s->side[1] = -sin(p->angle);
  s->top = p->length > 0. ? p->length : INFINITY;
  s->corner[0] = s->top * tan(p->angle);
  s->corner[1] = s->top;
}

/* Append a length along an axis; NULL: in all directions. */
static void
add_extent(abut_obstacle_extents *e, double length, const double *axis)
{
  if (axis != NULL)
    memcpy(e->axis[e->n], axis, sizeof(e->axis[0]));
  e->length[e->n++] = length;
}

static void
sphere_extents(const abut_obstacle_shape *s, abut_obstacle_extents *e)
{
  add_extent(e, 2. * s->radius, NULL);
}

static void
cylinder_extents(const abut_obstacle_shape *s, abut_obstacle_extents *e)
{
  sphere_extents(s, e);
  if (s->length > 0.)
    add_extent(e, s->length, s->axis);
}

static void
box_extents(const abut_obstacle_shape *s, abut_obstacle_extents *e)
{
  for (int32_t d = 0; d < s->dimension; ++d)
  {
    add_extent(e, s->size[d], NULL);
    e->axis[d][d] = 1.;
  }
}

abut_status
abut_obstacle_create_shape(abut_context *context,
                           const abut_obstacle_shape *given,
                           abut_obstacle **obstacle)
{
  static const char call[] = "abut_obstacle_create_shape";
  if (context == NULL || obstacle == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "context or result is NULL");
  if (given == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "shape is NULL");
  abut_obstacle_shape taken = abut_obstacle_shape_defaults();
  abut_status status =
      abut_copy_in(context, call, &taken, sizeof(taken), given);
  const abut_obstacle_shape *shape = &taken;
  if (status == ABUT_SUCCESS)
    status = check(context, call, shape);
  if (status != ABUT_SUCCESS)
    return status;
  abut_shape_data data;
  memset(&data, 0, sizeof(data));
  data.shape = *shape;
  for (int32_t d = 0; d < 3; ++d)
  {
    const bool used = d < shape->dimension;
    data.half[d] = used ? 0.5 * shape->size[d] : INFINITY;
    data.shape.point[d] = used ? shape->point[d] : 0.;
    data.shape.axis[d] = used ? shape->axis[d] : 0.;
  }
  if (uses_axis(shape) && !make_unit(data.shape.axis))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "axis is zero");
  shape_obstacle *o =
      abut_obstacle_make(context, call, sizeof(*o), &methods, shape->kind,
                         shape->dimension, shape->hollow);
  if (o == NULL)
    return ABUT_OUT_OF_MEMORY;
  o->data = data;
  const shape_entry *entry = &shapes[shape->kind];
  o->kernel = entry->kernel;
  o->base.smooth = entry->smooth;
  if (entry->prepare != NULL)
    entry->prepare(&o->data);
  if (entry->extents != NULL)
    entry->extents(&o->data.shape, &o->base.extents);
  *obstacle = &o->base;
  return ABUT_SUCCESS;
}

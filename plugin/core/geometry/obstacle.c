/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Common part of all obstacles: life, pose, and the call for distances.
 *
 * Points go to the obstacle's own frame by X = R'(x - T), gradients back by
 * R, second derivatives by R H R'. A hollow obstacle is the same with the
 * opposite sign. */
#include "geometry/obstacle.h"

#include "geometry/kernels.h"
#include "geometry/vector.h"

#include <math.h>
#include <string.h>

const char *
abut_obstacle_name(abut_obstacle_kind kind)
{
  static const char *const names[] = {
#define NAME(kind, name) name,
      ABUT_OBSTACLE_KIND_LIST(NAME)
#undef NAME
  };
  const int i = (int)kind;
  return i >= 0 && i < ABUT_OBSTACLE_N_KINDS ? names[i] : "";
}

abut_status
abut_obstacle_find(const char *name, abut_obstacle_kind *kind)
{
  if (name == NULL || kind == NULL)
    return ABUT_INVALID_ARGUMENT;
  for (int i = 0; i < ABUT_OBSTACLE_N_KINDS; ++i)
    if (strcmp(name, abut_obstacle_name((abut_obstacle_kind)i)) == 0)
    {
      *kind = (abut_obstacle_kind)i;
      return ABUT_SUCCESS;
    }
  return ABUT_INVALID_ARGUMENT;
}

/* Length of an extent along a surface with this normal. */
static double
length_along(const abut_obstacle *o, int32_t i, const double *normal)
{
  static const double parallel = 1e-8; /* faces without an end in the surface */
  const int32_t dim = o->view.dimension;
  double axis[3] = {0., 0., 0.}, n[3] = {0., 0., 0.};
  for (int32_t k = 0; k < dim; ++k)
  {
    n[k] = normal[k];
    for (int32_t l = 0; l < dim; ++l)
      axis[k] += o->view.rotation[dim * k + l] * o->extents.axis[i][l];
  }
  if (unit3(axis, 0.) == 0.)
    return o->extents.length[i];
  axpy3(axis, -dot3(axis, n), n, axis);
  const double along = norm3(axis);
  return along > parallel ? o->extents.length[i] / along : INFINITY;
}

double
abut_obstacle_width(const abut_obstacle *o, const double *normal)
{
  double least = INFINITY;
  if (o == NULL || normal == NULL || o->view.hollow)
    return least;
  for (int32_t i = 0; i < o->extents.n; ++i)
    least = min2(least, length_along(o, i, normal));
  return least;
}

double
abut_obstacle_depth(const abut_obstacle *o)
{
  double least = INFINITY;
  if (o == NULL || o->view.hollow)
    return least;
  for (int32_t i = 0; i < o->extents.n; ++i)
    least = min2(least, o->extents.length[i]);
  return least / 2.;
}

static void
set_identity(abut_obstacle_view *v)
{
  memset(v->rotation, 0, sizeof(v->rotation));
  memset(v->translation, 0, sizeof(v->translation));
  for (int32_t d = 0; d < v->dimension; ++d)
    v->rotation[d * (v->dimension + 1)] = 1.;
}

void *
abut_obstacle_make(abut_context *context, const char *call, size_t bytes,
                   const abut_obstacle_methods *methods,
                   abut_obstacle_kind kind, int32_t dimension, bool hollow)
{
  abut_obstacle *o = abut_object_create(context, bytes);
  if (o == NULL)
  {
    abut_fail(context, ABUT_OUT_OF_MEMORY, call, "no memory");
    return NULL;
  }
  o->context = context;
  o->methods = methods;
  o->bytes = bytes;
  o->view.dimension = dimension;
  o->view.kind = kind;
  o->view.hollow = hollow;
  o->local.element = o->gradient.element = sizeof(double);
  set_identity(&o->view);
  return o;
}

abut_status
abut_obstacle_destroy(abut_obstacle **obstacle)
{
  if (obstacle == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_obstacle *o = *obstacle;
  if (o == NULL)
    return ABUT_SUCCESS;
  if (o->methods->release != NULL)
    o->methods->release(o);
  abut_array_release(o->context, &o->local);
  abut_array_release(o->context, &o->gradient);
  abut_object_destroy(o->context, o, o->bytes);
  *obstacle = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_obstacle_get_sized(const abut_obstacle *obstacle, abut_obstacle_view *view)
{
  if (obstacle == NULL || view == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_copy_out(obstacle->context, "abut_obstacle_get", view,
                       sizeof(obstacle->view), &obstacle->view);
}

abut_status
abut_obstacle_fail(abut_obstacle *obstacle, abut_status status, int32_t i,
                   const char *what)
{
  const int32_t dimension = obstacle->view.dimension;
  abut_text text = abut_fail_begin(obstacle->context, "abut_obstacle_distance");
  abut_text_add(&text, what);
  abut_text_add(&text, " at point ");
  abut_text_add_integer(&text, i);
  for (int32_t d = 0; d < dimension; ++d)
  {
    abut_text_add(&text, d == 0 ? " = (" : ", ");
    abut_text_add_number(&text, obstacle->space[(int64_t)i * dimension + d]);
  }
  abut_text_add(&text, ")");
  return status;
}

static double
determinant(const double *r, int32_t dimension)
{
  if (dimension == 2)
    return r[0] * r[3] - r[1] * r[2];
  return r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6])
         + r[2] * (r[3] * r[7] - r[4] * r[6]);
}

static bool
is_rotation(const double *r, int32_t dimension)
{
  for (int32_t i = 0; i < dimension; ++i)
    for (int32_t j = 0; j <= i; ++j)
    {
      double s = i == j ? -1. : 0.;
      for (int32_t k = 0; k < dimension; ++k)
        s += r[i * dimension + k] * r[j * dimension + k];
      if (!(fabs(s) <= 1e-10))
        return false;
    }
  return determinant(r, dimension) > 0.;
}

abut_status
abut_obstacle_set_pose(abut_obstacle *obstacle, const double *rotation,
                       const double *translation)
{
  if (obstacle == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_obstacle *o = obstacle;
  const int32_t dimension = o->view.dimension;
  if (rotation != NULL && !is_rotation(rotation, dimension))
    return abut_fail(o->context, ABUT_INVALID_ARGUMENT,
                     "abut_obstacle_set_pose",
                     "the matrix is not a rotation: its rows must be "
                     "orthogonal unit vectors and its determinant 1");
  if (translation != NULL && !abut_facet_finite(translation, dimension))
    return abut_fail(o->context, ABUT_NOT_FINITE, "abut_obstacle_set_pose",
                     "the translation is NaN, infinite or out of range");
  set_identity(&o->view);
  if (rotation != NULL)
    memcpy(o->view.rotation, rotation,
           (size_t)(dimension * dimension) * sizeof(double));
  if (translation != NULL)
    memcpy(o->view.translation, translation,
           (size_t)dimension * sizeof(double));
  o->placed = rotation != NULL || translation != NULL;
  return ABUT_SUCCESS;
}

static abut_status
check_points(abut_obstacle *o, int32_t n, const double *points)
{
  const int32_t dimension = o->view.dimension;
  for (int32_t i = 0; i < n; ++i)
    if (!abut_facet_finite(points + (int64_t)i * dimension, dimension))
      return abut_obstacle_fail(o, ABUT_NOT_FINITE, i,
                                "a coordinate is NaN, infinite or out of "
                                "range");
  return ABUT_SUCCESS;
}

static void
to_local(const abut_obstacle_view *v, int64_t n, const double *points,
         double *local)
{
  const int32_t dimension = v->dimension;
  const double *r = v->rotation, *t = v->translation;
  for (int64_t i = 0; i < n; ++i)
    for (int32_t d = 0; d < dimension; ++d)
    {
      double s = 0.;
      for (int32_t k = 0; k < dimension; ++k)
        s += r[k * dimension + d] * (points[i * dimension + k] - t[k]);
      local[i * dimension + d] = s;
    }
}

/* Multiply n vectors, at steps of `step` numbers, by the rotation. */
static void
rotate(const abut_obstacle_view *v, int64_t n, double *vectors, int32_t step)
{
  const int32_t dimension = v->dimension;
  const double *r = v->rotation;
  for (int64_t i = 0; i < n; ++i)
  {
    double *x = vectors + i * (step == 1 ? dimension : dimension * dimension);
    double y[3];
    for (int32_t d = 0; d < dimension; ++d)
    {
      y[d] = 0.;
      for (int32_t k = 0; k < dimension; ++k)
        y[d] += r[d * dimension + k] * x[k * step];
    }
    for (int32_t d = 0; d < dimension; ++d)
      x[d * step] = y[d];
  }
}

/* R H R': R on the columns of H, then on the rows. */
static void
rotate_hessians(const abut_obstacle_view *v, int64_t n, double *hessian)
{
  const int32_t dimension = v->dimension;
  for (int32_t d = 0; d < dimension; ++d)
    rotate(v, n, hessian + d, dimension);
  rotate(v, n * dimension, hessian, 1);
}

static void
negate(int64_t n, double *values)
{
  for (int64_t i = 0; i < n; ++i)
    values[i] = -values[i];
}

/* Points in the obstacle's own frame, and room for the gradients. */
static abut_status
prepare(abut_obstacle *o, int32_t n, const double *points, const double **local,
        double **gradient)
{
  const int64_t size = (int64_t)n * o->view.dimension;
  abut_status status = ABUT_SUCCESS;
  *local = points;
  if (*gradient == NULL)
  {
    status = abut_array_reserve(o->context, &o->gradient, 0, size);
    *gradient = o->gradient.data;
  }
  if (status != ABUT_SUCCESS || !o->placed)
    return status;
  status = abut_array_reserve(o->context, &o->local, 0, size);
  if (status != ABUT_SUCCESS)
    return status;
  to_local(&o->view, n, points, o->local.data);
  *local = o->local.data;
  return ABUT_SUCCESS;
}

/* The opposite sign of everything: the material is outside. */
static void
invert(int64_t n, int64_t dimension, double *distance, double *gradient,
       double *hessian)
{
  negate(n, distance);
  if (gradient != NULL)
    negate(n * dimension, gradient);
  if (hessian != NULL)
    negate(n * dimension * dimension, hessian);
}

/* Distances, or gaps of points that move. */
static abut_status
ask(abut_obstacle *o, bool moving, int32_t n, const double *points,
    double *distance, double *gradient, double *hessian)
{
  if (n < 0 || (n > 0 && (points == NULL || distance == NULL)))
    return abut_fail(o->context, ABUT_INVALID_ARGUMENT,
                     moving ? "abut_obstacle_gap" : "abut_obstacle_distance",
                     "n is negative, or points or distance is NULL");
  o->view.n_beyond = 0;
  if (n == 0)
    return ABUT_SUCCESS;
  o->space = points;
  const double *local;
  double *g = gradient;
  abut_status status = check_points(o, n, points);
  if (status == ABUT_SUCCESS)
    status = prepare(o, n, points, &local, &g);
  if (status == ABUT_SUCCESS)
    status = (moving && o->methods->gap != NULL
                  ? o->methods->gap
                  : o->methods->evaluate)(o, n, local, distance, g, hessian);
  if (status != ABUT_SUCCESS)
    return status;
  if (o->placed && gradient != NULL)
    rotate(&o->view, n, gradient, 1);
  if (o->placed && hessian != NULL)
    rotate_hessians(&o->view, n, hessian);
  if (o->view.hollow)
    invert(n, o->view.dimension, distance, gradient, hessian);
  return ABUT_SUCCESS;
}

abut_status
abut_obstacle_distance(abut_obstacle *obstacle, int32_t n, const double *points,
                       double *distance, double *gradient, double *hessian)
{
  return obstacle == NULL
             ? ABUT_INVALID_ARGUMENT
             : ask(obstacle, false, n, points, distance, gradient, hessian);
}

abut_status
abut_obstacle_gap(abut_obstacle *obstacle, int32_t n, const double *points,
                  double *gap, double *gradient, double *hessian)
{
  return obstacle == NULL
             ? ABUT_INVALID_ARGUMENT
             : ask(obstacle, true, n, points, gap, gradient, hessian);
}

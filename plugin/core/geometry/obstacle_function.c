/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Obstacles from a function of the caller.
 *
 * phi = f / |grad f|, n = grad f / |grad f|: to first order the distance to
 * the surface f = 0 (Taubin, Distance approximations for rasterizing implicit
 * curves, ACM Trans. Graph. 13 (1994) 3, eq. 2).
 *
 * Second derivatives are those of a distance that has the same level surface
 * through the point, H = P (D grad f) P / |grad f| with P = I - n n'. D are
 * differences of the caller's gradient of fourth order, with four evaluations
 * for each axis: (8 (g(+h) - g(-h)) - (g(+2h) - g(-2h))) / (12 h).
 *
 * For points that move the caller's derivative, where there is one, replaces
 * the gradient. Where f is no distance, H misses what n changes by along
 * itself, and Newton's method has the order sqrt(2): an error is that of the
 * gap before, which is the square of the one before that. */
#include "geometry/obstacle.h"

#include "geometry/kernels.h"
#include "geometry/vector.h"

#include <string.h>

typedef struct function_obstacle
{
  abut_obstacle base;
  abut_obstacle_function function;
  abut_array points, values, gradients; /* double, for differences */
} function_obstacle;

/* Step as a part of the length over which the gradient changes: with round-off
 * of 1e-16 in gradients the error of both is about 1e-12, with 1e-10 (gradients
 * that are differences themselves) 1e-7. */
static const double relative_step = 1e-3;

static void
release(abut_obstacle *o)
{
  function_obstacle *f = (function_obstacle *)o;
  abut_array_release(o->context, &f->points);
  abut_array_release(o->context, &f->values);
  abut_array_release(o->context, &f->gradients);
}

/* Length that steps are a part of: the caller's, else the largest coordinate of
 * the points. */
static double
length_of(const function_obstacle *f, int64_t size, const double *points)
{
  double length = f->function.length;
  if (length > 0.)
    return length;
  for (int64_t i = 0; i < size; ++i)
    length = max2(length, fabs(points[i]));
  return length > 0. ? length : 1.;
}

/* Values that second derivatives are differences of. */
static int
slopes(const function_obstacle *f, bool moving, int32_t n, const double *points)
{
  return moving ? f->function.derivative(f->function.user, n, points,
                                         f->gradients.data)
                : f->function.evaluate(f->function.user, n, points,
                                       f->values.data, f->gradients.data);
}

/* hessian[i][a][d] += factor * gradient_a at the points moved by `step` along
 * axis d. */
static abut_status
add_moved(function_obstacle *f, bool moving, int32_t n, const double *points,
          int32_t d, double step, double factor, double *hessian)
{
  const int32_t dimension = f->base.view.dimension;
  double *moved = f->points.data;
  const double *gradient = f->gradients.data;
  memcpy(moved, points, (size_t)n * (size_t)dimension * sizeof(*moved));
  for (int64_t i = 0; i < n; ++i)
    moved[i * dimension + d] += step;
  if (slopes(f, moving, n, moved) != 0)
    return abut_obstacle_fail(&f->base, ABUT_CALLBACK_FAILED, 0,
                              "the obstacle's function failed near points that "
                              "begin");
  for (int64_t i = 0; i < n; ++i)
    for (int32_t a = 0; a < dimension; ++a)
      hessian[(i * dimension + a) * dimension + d] +=
          factor * gradient[i * dimension + a];
  return ABUT_SUCCESS;
}

/* Differences of the caller's gradient. */
static abut_status
differences(function_obstacle *f, bool moving, int32_t n, const double *points,
            double *hessian)
{
  const int32_t dimension = f->base.view.dimension;
  const int64_t size = (int64_t)n * dimension;
  abut_context *context = f->base.context;
  abut_status status = abut_array_reserve(context, &f->points, 0, size);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &f->values, 0, n);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &f->gradients, 0, size);
  const double h = relative_step * length_of(f, size, points);
  memset(hessian, 0, (size_t)(size * dimension) * sizeof(*hessian));
  for (int32_t d = 0; d < dimension; ++d)
    for (int32_t k = -2; k <= 2 && status == ABUT_SUCCESS; ++k)
      if (k != 0)
        status = add_moved(
            f, moving, n, points, d, k * h,
            (k % 2 != 0 ? 8. : -1.) * (k > 0 ? 1. : -1.) / (12. * h), hessian);
  return status;
}

/* From the derivatives of a gradient to those of the distance: P H P / slope,
 * symmetric; zero where that is not finite or has no meaning. */
static void
finish_hessian(int32_t dimension, double slope, const double *normal,
               double *hessian)
{
  double h[3][3] = {{0.}}, along[3] = {0., 0., 0.}, both = 0.;
  bool good = slope > 0.;
  for (int32_t a = 0; a < dimension; ++a)
    for (int32_t d = 0; d < dimension; ++d)
    {
      h[a][d] = 0.5 * (hessian[a * dimension + d] + hessian[d * dimension + a])
                / slope;
      good = good && isfinite(h[a][d]);
      along[a] += h[a][d] * normal[d];
    }
  for (int32_t a = 0; a < dimension; ++a)
    both += along[a] * normal[a];
  for (int32_t a = 0; a < dimension; ++a)
    for (int32_t d = 0; d < dimension; ++d)
      hessian[a * dimension + d] = good ? h[a][d] - along[a] * normal[d]
                                              - normal[a] * along[d]
                                              + both * normal[a] * normal[d]
                                        : 0.;
}

/* Divide by the length of the gradient, which is returned; where it is zero,
 * the last axis of the frame stands for it. */
static double
normalise(int32_t dimension, double *value, double *gradient)
{
  double largest = 0., square = 0.;
  for (int32_t d = 0; d < dimension; ++d)
    largest = max2(largest, fabs(gradient[d]));
  if (!(largest > 0.))
  {
    gradient[dimension - 1] = 1.;
    return 0.;
  }
  for (int32_t d = 0; d < dimension; ++d)
  {
    const double g = gradient[d] / largest;
    square += g * g;
  }
  const double length = sqrt(square);
  for (int32_t d = 0; d < dimension; ++d)
    gradient[d] = gradient[d] / largest / length;
  *value = *value / largest / length;
  return largest * length;
}

/* Values and the vectors that they are divided by the length of. */
static int
ask(const abut_obstacle_function *f, bool moving, int32_t n,
    const double *points, double *value, double *gradient)
{
  const int failed = f->evaluate(f->user, n, points, value, gradient);
  return failed != 0 || !moving ? failed
                                : f->derivative(f->user, n, points, gradient);
}

static abut_status
measure(abut_obstacle *o, bool moving, int32_t n, const double *points,
        double *distance, double *gradient, double *hessian)
{
  function_obstacle *self = (function_obstacle *)o;
  const int32_t dimension = o->view.dimension;
  if (ask(&self->function, moving, n, points, distance, gradient) != 0)
    return abut_obstacle_fail(o, ABUT_CALLBACK_FAILED, 0,
                              "the obstacle's function failed for points that "
                              "begin");
  if (hessian != NULL)
  {
    const abut_status status = differences(self, moving, n, points, hessian);
    if (status != ABUT_SUCCESS)
      return status;
  }
  for (int32_t i = 0; i < n; ++i)
  {
    double *g = gradient + (int64_t)i * dimension;
    if (!isfinite(distance[i]))
      return abut_obstacle_fail(o, ABUT_NOT_FINITE, i,
                                "the obstacle's function is not finite");
    for (int32_t d = 0; d < dimension; ++d)
      if (!isfinite(g[d]))
        return abut_obstacle_fail(o, ABUT_NOT_FINITE, i,
                                  "the gradient of the obstacle's function is "
                                  "not finite");
    const double slope = normalise(dimension, distance + i, g);
    if (hessian != NULL)
      finish_hessian(dimension, slope, g,
                     hessian + (int64_t)i * dimension * dimension);
    if (!isfinite(distance[i]))
      return abut_obstacle_fail(o, ABUT_NOT_FINITE, i,
                                "the obstacle's function divided by its slope "
                                "is not finite");
  }
  return ABUT_SUCCESS;
}

static abut_status
evaluate(abut_obstacle *o, int32_t n, const double *points, double *distance,
         double *gradient, double *hessian)
{
  return measure(o, false, n, points, distance, gradient, hessian);
}

static abut_status
gap(abut_obstacle *o, int32_t n, const double *points, double *value,
    double *gradient, double *hessian)
{
  const bool moving = ((function_obstacle *)o)->function.derivative != NULL;
  return measure(o, moving, n, points, value, gradient, hessian);
}

static const abut_obstacle_methods methods = {evaluate, gap, release};

abut_status
abut_obstacle_create_function(abut_context *context,
                              const abut_obstacle_function *function,
                              abut_obstacle **obstacle)
{
  static const char call[] = "abut_obstacle_create_function";
  if (context == NULL || obstacle == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "context or result is NULL");
  if (function == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "function is NULL");
  abut_obstacle_function chosen = abut_obstacle_function_defaults();
  const abut_status status =
      abut_copy_in(context, call, &chosen, sizeof(chosen), function);
  if (status != ABUT_SUCCESS)
    return status;
  if (chosen.dimension != 2 && chosen.dimension != 3)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "dimension is neither 2 nor 3");
  if (chosen.evaluate == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "evaluate is NULL");
  if (!(chosen.length >= 0. && chosen.length <= ABUT_FACET_LIMIT))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "length is negative or not finite");
  function_obstacle *o = abut_obstacle_make(context, call, sizeof(*o), &methods,
                                            ABUT_OBSTACLE_FUNCTION,
                                            chosen.dimension, chosen.hollow);
  if (o == NULL)
    return ABUT_OUT_OF_MEMORY;
  o->function = chosen;
  o->points.element = o->values.element = o->gradients.element = sizeof(double);
  *obstacle = &o->base;
  return ABUT_SUCCESS;
}

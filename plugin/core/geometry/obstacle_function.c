/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Obstacles from a function of the caller.
 *
 * phi = f / |grad f|, n = grad f / |grad f|: to first order the distance to
 * the surface f = 0 (Taubin, Distance approximations for rasterizing implicit
 * curves, ACM Trans. Graph. 13 (1994) 3, eq. 2). */
#include "geometry/obstacle.h"

#include "geometry/kernels.h"
#include "geometry/vector.h"

typedef struct function_obstacle
{
  abut_obstacle base;
  abut_obstacle_function function;
} function_obstacle;

/* Divide by the length of the gradient; where it is zero, the last axis of the
 * frame stands for it. */
static void
normalise(int32_t dimension, double *value, double *gradient)
{
  double largest = 0., square = 0.;
  for (int32_t d = 0; d < dimension; ++d)
    largest = max2(largest, fabs(gradient[d]));
  if (!(largest > 0.))
  {
    gradient[dimension - 1] = 1.;
    return;
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
}

static abut_status
evaluate(abut_obstacle *o, int32_t n, const double *points, double *distance,
         double *gradient, double *hessian)
{
  const abut_obstacle_function *f = &((function_obstacle *)o)->function;
  const int32_t dimension = o->view.dimension;
  (void)hessian;
  if (f->evaluate(f->user, n, points, distance, gradient) != 0)
    return abut_obstacle_fail(o, ABUT_CALLBACK_FAILED, 0,
                              "the obstacle's function failed for points that "
                              "begin");
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
    normalise(dimension, distance + i, g);
    if (!isfinite(distance[i]))
      return abut_obstacle_fail(o, ABUT_NOT_FINITE, i,
                                "the obstacle's function divided by its slope "
                                "is not finite");
  }
  return ABUT_SUCCESS;
}

static const abut_obstacle_methods methods = {evaluate, NULL, false};

abut_status
abut_obstacle_create_function(abut_context *context,
                              const abut_obstacle_function *function,
                              abut_obstacle **obstacle)
{
  static const char call[] = "abut_obstacle_create_function";
  if (context == NULL || obstacle == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "context or result is NULL");
  if (function == NULL || function->struct_size != sizeof(*function))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "function is NULL or of another version");
  if (function->dimension != 2 && function->dimension != 3)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "dimension is neither 2 nor 3");
  if (function->evaluate == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "evaluate is NULL");
  function_obstacle *o = abut_obstacle_make(
      context, call, sizeof(*o), &methods, ABUT_OBSTACLE_FUNCTION,
      function->dimension, function->hollow);
  if (o == NULL)
    return ABUT_OUT_OF_MEMORY;
  o->function = *function;
  *obstacle = &o->base;
  return ABUT_SUCCESS;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_OBSTACLE_H
#define ABUT_OBSTACLE_H

/** @file
 * Rigid obstacles: signed distance, its gradient and its second derivatives.
 *
 * The distance phi of a point is positive outside the obstacle's material and
 * negative inside. Its gradient has unit length and points out of the
 * material; the gap of a body that may not penetrate is g = phi, and the
 * normal of its contact row is minus the gradient.
 *
 * An obstacle is described in its own frame and placed in space by a pose, x =
 * R X + T, which may change at every load step. Three ways lead to one:
 *
 *   shapes     plane, sphere, cylinder, box, cone: closed formulas, some ten
 *              nanoseconds per point, exact also at edges and tips
 *   functions  the caller's value and gradient, for heights and implicit
 *              surfaces; second derivatives by differences
 *   surfaces   the nearest facet of an abut_surface: abut/obstacle_surface.h
 *
 * Where two points of the obstacle are equally near (centre of a sphere, axis
 * of a cylinder, medial surfaces of a box) there is no gradient; then one of
 * the two directions is given, always the same, and the second derivatives are
 * those of that side; they are zero where they would be infinite. Results are
 * never NaN.
 */

#include <abut/context.h>
#include <abut/export.h>
#include <abut/facet.h>
#include <stdbool.h>
#include <string.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Opaque obstacle. */
  typedef struct abut_obstacle abut_obstacle;

/** Kind, name. */
#define ABUT_OBSTACLE_KIND_LIST(X)                                             \
  X(PLANE, "plane")                                                            \
  X(SPHERE, "sphere")                                                          \
  X(CYLINDER, "cylinder")                                                      \
  X(BOX, "box")                                                                \
  X(CONE, "cone")                                                              \
  X(FUNCTION, "function")                                                      \
  X(SURFACE, "surface")

  /** Kinds of obstacles; the first five are shapes. */
  typedef enum abut_obstacle_kind
  {
/** @cond */
#define ABUT_OBSTACLE_KIND_ENTRY(kind, name) ABUT_OBSTACLE_##kind,
    /** @endcond */
    ABUT_OBSTACLE_KIND_LIST(ABUT_OBSTACLE_KIND_ENTRY)
#undef ABUT_OBSTACLE_KIND_ENTRY
    /** Number of kinds; not a kind. */
    ABUT_OBSTACLE_N_KINDS
  } abut_obstacle_kind;

  /** Name of a kind ("sphere"); never NULL. */
  ABUT_API const char *abut_obstacle_name(abut_obstacle_kind kind);

  /** Kind by its name; INVALID_ARGUMENT if there is none. */
  ABUT_API abut_status abut_obstacle_find(const char *name,
                                          abut_obstacle_kind *kind);

  /** Fields of abut_obstacle_shape that belong to some kinds only. */
  typedef enum abut_shape_field
  {
    ABUT_SHAPE_AXIS = 1,   /**< axis */
    ABUT_SHAPE_RADIUS = 2, /**< radius */
    ABUT_SHAPE_LENGTH = 4, /**< length */
    ABUT_SHAPE_SIZE = 8,   /**< size */
    ABUT_SHAPE_ANGLE = 16  /**< angle */
  } abut_shape_field;

  /** Sum of the abut_shape_field that a shape has; 0 for kinds that are no
   * shapes. */
  ABUT_API uint32_t abut_obstacle_fields(abut_obstacle_kind kind);

  /** A shape. Vectors have `dimension` components; the others are not read,
   * nor are fields that do not belong to the kind. Lengths and coordinates must
   * not exceed ABUT_FACET_LIMIT. */
  typedef struct abut_obstacle_shape
  {
    size_t struct_size;      /**< sizeof(abut_obstacle_shape) */
    int32_t dimension;       /**< 2 or 3 */
    abut_obstacle_kind kind; /**< one of the shapes */
    /** Plane: a point of it. Sphere and box: the centre. Cylinder: its middle.
     * Cone: the tip. */
    double point[3];
    /** Plane: the normal out of the material. Cylinder: its axis. Cone: from
     * the tip into the material. Any length but zero. Default (0, 1) or (0, 0,
     * 1), whatever is last. */
    double axis[3];
    /** Sphere (2D: disc) and cylinder: > 0. Default 1. */
    double radius;
    /** Cylinder and cone: length along the axis, > 0, or 0 (default): without
     * end. */
    double length;
    /** Box (2D: rectangle): lengths of the edges along the coordinate axes of
     * its own frame, > 0. Default 1. */
    double size[3];
    /** Cone (2D: wedge): angle between axis and side, radian in (0, pi/2).
     * Default pi/4. */
    double angle;
    /** The material is outside of the shape: a hole. Default false. */
    bool hollow;
  } abut_obstacle_shape;

  /** Defaults: a plane in 3D through the origin, material below. */
  static inline abut_obstacle_shape abut_obstacle_shape_defaults(void)
  {
    abut_obstacle_shape shape;
    memset(&shape, 0, sizeof(shape));
    shape.struct_size = sizeof(abut_obstacle_shape);
    shape.dimension = 3;
    shape.kind = ABUT_OBSTACLE_PLANE;
    shape.axis[2] = 1.;
    shape.radius = 1.;
    shape.size[0] = shape.size[1] = shape.size[2] = 1.;
    shape.angle = 0.78539816339744831;
    return shape;
  }

  /** Create a shape. UNSUPPORTED for a cylinder in 2D; INVALID_ARGUMENT or
   * NOT_FINITE, with the name of the field, for a value out of range. O(1). */
  ABUT_API abut_status abut_obstacle_create_shape(
      abut_context *context, const abut_obstacle_shape *shape,
      abut_obstacle **obstacle);

  /** A function of the caller. */
  typedef struct abut_obstacle_function
  {
    size_t struct_size; /**< sizeof(abut_obstacle_function) */
    int32_t dimension;  /**< 2 or 3 */
    void *user;         /**< handed to evaluate */
    /** Values and gradients at n points of the obstacle's own frame.
     *
     * The value is zero on the surface, positive outside the material; it need
     * not be a distance, because value and gradient are divided by the length
     * of the gradient: a distance stays what it is, and any other function
     * becomes one to first order near the surface. Where the gradient is zero
     * the value is taken as it is. The gradient may differ from the
     * derivative: a height above a plane whose gap is measured along the axis
     * gives the axis.
     * @param points [n * dimension]
     * @param value [n] out, finite
     * @param gradient [n * dimension] out, finite
     * Returns 0, or anything else for failure. */
    int (*evaluate)(void *user, int32_t n, const double *points, double *value,
                    double *gradient);
    bool hollow; /**< the material is where the value is positive */
    /** Length > 0 over which the gradient changes a good deal, such as the
     * smallest radius of curvature: second derivatives are differences with a
     * thousandth of it as their step. 0 (default): the largest coordinate of
     * the points requested, in the obstacle's frame. */
    double length;
    /** The derivative of the value where the gradient of evaluate is another
     * vector, such as the axis of a height: (h', -1) instead of (0, -1).
     * abut_obstacle_gap() takes it in the place of the gradient. NULL
     * (default): the gradient is the derivative. Returns as evaluate does.
     * @param points [n * dimension]
     * @param derivative [n * dimension] out, finite */
    int (*derivative)(void *user, int32_t n, const double *points,
                      double *derivative);
  } abut_obstacle_function;

  /** Defaults: 3D, no function yet. */
  static inline abut_obstacle_function abut_obstacle_function_defaults(void)
  {
    const abut_obstacle_function function = {
        sizeof(abut_obstacle_function), 3, NULL, NULL, false, 0., NULL};
    return function;
  }

  /** Create an obstacle from a function. INVALID_ARGUMENT without one. */
  ABUT_API abut_status abut_obstacle_create_function(
      abut_context *context, const abut_obstacle_function *function,
      abut_obstacle **obstacle);

  /** Destroy an obstacle and set the handle to NULL. */
  ABUT_API abut_status abut_obstacle_destroy(abut_obstacle **obstacle);

  /** Place an obstacle: a point X of its own frame is at x = R X + T.
   * @param rotation [dimension * dimension] R, row by row; NULL: identity.
   *   INVALID_ARGUMENT unless it is a rotation to 1e-10 (no mirror image)
   * @param translation [dimension] T, finite; NULL: zero */
  ABUT_API abut_status abut_obstacle_set_pose(abut_obstacle *obstacle,
                                              const double *rotation,
                                              const double *translation);

  /** Signed distances of n points.
   *
   * @param points [n * dimension] in space, finite, magnitude at most
   *   ABUT_FACET_LIMIT (else NOT_FINITE, with the number of the point)
   * @param distance [n] out, length
   * @param gradient [n * dimension] out, unit vectors; or NULL
   * @param hessian [n * dimension * dimension] out, 1/length, symmetric; or
   *   NULL. Shapes: exact. Functions: the curvature of the level surface
   *   through the point, which is exact where the value is a distance or zero,
   *   by differences of the gradient: to 1e-9 of 1/length for a gradient that
   *   is exact and changes smoothly, zero where one of the points a step away
   *   has no finite gradient; it is zero for a height whose gradient is its
   *   axis, because such a gap does not depend on sideways motion. Surfaces:
   *   zero, which is exact beside plane facets; the curvature that a mesh has
   *   in its edges and corners, and within curved facets, is left out.
   * CALLBACK_FAILED or NOT_FINITE, with the coordinates of the point, if a
   * function fails or gives NaN.
   *
   * One thread at a time per obstacle: room for points in its own frame is
   * kept in it. Cost: shapes O(n); functions one evaluation of all points,
   * with second derivatives 1 + 4 * dimension; surfaces O(log n facets) for a
   * point near the surface, more for one that many facets are equally near to.
   */
  ABUT_API abut_status abut_obstacle_distance(abut_obstacle *obstacle,
                                              int32_t n, const double *points,
                                              double *distance,
                                              double *gradient,
                                              double *hessian);

  /** Gaps of n points that move: the same as abut_obstacle_distance(), but for
   * functions with a derivative, which is in the place of their gradient. So
   * the gap of a height along its axis, too, is normal to the surface, and a
   * pressure is force by area there. Newton's method has the order sqrt(2)
   * where a function is no distance, not 2. Arguments, errors and cost as
   * there. */
  ABUT_API abut_status abut_obstacle_gap(abut_obstacle *obstacle, int32_t n,
                                         const double *points, double *gap,
                                         double *gradient, double *hessian);

  /** Width of a bounded shape for a surface with this unit normal, length > 0:
   * the least length of the shape through its centre along the surface.
   * Infinite for planes, cones, hollow shapes, functions and surfaces. O(1).
   * @param normal [dimension] in space */
  ABUT_API double abut_obstacle_width(const abut_obstacle *obstacle,
                                      const double *normal);

  /** Depth of a bounded shape: half of its least length, which no point inside
   * exceeds. Infinite for planes, cones, hollow shapes, functions and
   * surfaces. O(1). */
  ABUT_API double abut_obstacle_depth(const abut_obstacle *obstacle);

  /** Description of an obstacle, and its statistics. */
  typedef struct abut_obstacle_view
  {
    size_t struct_size;      /**< sizeof(abut_obstacle_view) */
    int32_t dimension;       /**< 2 or 3 */
    abut_obstacle_kind kind; /**< as created */
    bool hollow;             /**< as created */
    double rotation[9];      /**< R of the pose, [dimension * dimension] */
    double translation[3];   /**< T of the pose */
    double limit;            /**< surfaces: as created; else 0 */
    /** Surfaces: points of the last abut_obstacle_distance() beyond the limit;
     * else 0. */
    int64_t n_beyond;
  } abut_obstacle_view;

  /** View of an obstacle. O(1). */
  ABUT_API abut_status abut_obstacle_get_sized(const abut_obstacle *obstacle,
                                               abut_obstacle_view *view);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_obstacle_get(const abut_obstacle *obstacle,
                                              abut_obstacle_view *view)
  {
    if (view != NULL)
      view->struct_size = sizeof(*view);
    return abut_obstacle_get_sized(obstacle, view);
  }

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_POINTS_H
#define ABUT_POINTS_H

/** @file
 * Contact points: what every discretisation of contact produces and every way
 * of enforcing it consumes.
 *
 * Point i has a weight w_i (tributary area of its node, or volume for a volume
 * obstacle), one stencil c_l over nodes, and up to three components that share
 * it. Component a has a direction f_a (the normal n first, then the tangents
 * t1, t2; not of unit length where a gap is no distance), and at displacements
 * v of the nodes the value
 *
 *     g_a(v) = g_a + sigma_a f_a . sum_l c_l v_l
 *
 * with sigma = -1 for the normal gap and +1 for the slip of the secondary in a
 * tangent; the components of a tie are gaps along its directions: -1 for all
 * (abut_point_sign()). Nodes of the secondary have c_l = D_l / W, those of the
 * primary c_l = -M_l / W, so that for n outward of the secondary a primary that
 * comes nearer closes the gap. The contact force on node l is
 *
 *     sum_a w q_a sigma_a f_a c_l
 *
 * with the pressure, or the traction on the secondary, q_a. With one component
 * B = sigma f c is dg/du: a membrane above an obstacle has one node with one
 * unknown, f = -1 and c = 1.
 *
 * Nodes are numbered by the caller, those of both sides together, and each has
 * as many unknowns as the set has dimensions; what these unknowns are is the
 * caller's business. An obstacle that forces drive is one more node: of the
 * primary, with c = -1 in each point against it, whose unknowns (its
 * translations) need not belong to any mesh. Against other obstacles there are
 * no nodes of the primary.
 *
 * Laws and strategies work on components, in the order of the points: their
 * arrays are component_id, component_weight and bilateral.
 */

#include <abut/context.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** The condition at a point. */
  typedef enum abut_point_kind
  {
    ABUT_POINT_CONTACT = 0, /**< the normal gap may open */
    ABUT_POINT_TIE = 1      /**< all components are equalities */
  } abut_point_kind;

  /** sigma_a of the file's head: the sign with which component @p component
   * follows the displacement of the secondary along its direction. */
  static inline double abut_point_sign(int kind, int32_t component)
  {
    return kind == ABUT_POINT_TIE || component == 0 ? -1. : 1.;
  }

  /** A point to append; arrays are copied. */
  typedef struct abut_point
  {
    size_t struct_size;   /**< sizeof(abut_point) */
    int64_t id;           /**< number, >= 0; those of its components are
                               id, id + 1, ..; unique over all points */
    int32_t kind;         /**< abut_point_kind */
    int32_t n_components; /**< 1 .. dimension */
    double weight;        /**< w > 0 */
    const double *frame;  /**< [n_components * dimension] f_a */
    const double *gap;    /**< [n_components] g_a, length */
    int32_t n_nodes;      /**< entries of the stencil */
    int32_t n_secondary;  /**< of these, nodes of the secondary: they come first
                           */
    const int32_t *node;  /**< [n_nodes] >= 0 */
    const double *coefficient; /**< [n_nodes] c_l */
  } abut_point;

  /** A contact point of weight one with one component, without nodes. */
  static inline abut_point abut_point_defaults(void)
  {
    const abut_point point = {sizeof(abut_point),
                              0,
                              ABUT_POINT_CONTACT,
                              1,
                              1.,
                              NULL,
                              NULL,
                              0,
                              0,
                              NULL,
                              NULL};
    return point;
  }

  /** Opaque set of points; grows by appending. */
  typedef struct abut_points abut_points;

  /** Read-only view of the arrays of a set; valid until the next change. Point
   * i has the components component_start[i] .. component_start[i+1]-1 and the
   * entries start[i] .. start[i+1]-1, of which the first n_secondary[i] are
   * nodes of the secondary. */
  typedef struct abut_points_view
  {
    size_t struct_size;             /**< sizeof(abut_points_view) */
    int32_t dimension;              /**< unknowns of a node, 1 .. 3 */
    int32_t n_points;               /**< number of points */
    int32_t n_components;           /**< of all points */
    const int64_t *id;              /**< [n_points] */
    const uint8_t *kind;            /**< [n_points] abut_point_kind */
    const double *weight;           /**< [n_points] */
    const int32_t *component_start; /**< [n_points + 1] */
    const double *frame;            /**< [n_components * dimension] f_a */
    const double *gap;              /**< [n_components] g_a */
    const int64_t *component_id;    /**< [n_components] */
    const double *component_weight; /**< [n_components] that of the point */
    const uint8_t *bilateral;       /**< [n_components] nonzero: equality */
    const int32_t *n_secondary;     /**< [n_points] */
    const int64_t *start;           /**< [n_points + 1] */
    const int32_t *node;            /**< [start[n_points]] */
    const double *coefficient;      /**< [start[n_points]] c_l */
  } abut_points_view;

  /** Create an empty set of points over nodes with @p dimension (1 .. 3)
   * unknowns each. */
  ABUT_API abut_status abut_points_create(abut_context *context,
                                          int32_t dimension,
                                          abut_points **points);

  /** Destroy a set and set the handle to NULL. */
  ABUT_API abut_status abut_points_destroy(abut_points **points);

  /** Remove all points and keep the memory. */
  ABUT_API abut_status abut_points_clear(abut_points *points);

  /** Make room for @p n_points points with @p n_components components and
   * @p n_entries entries of stencils in all. */
  ABUT_API abut_status abut_points_reserve(abut_points *points,
                                           int32_t n_points,
                                           int32_t n_components,
                                           int64_t n_entries);

  /** Append a point; all numbers must be finite and weight > 0. Amortised
   * O(n_nodes). */
  ABUT_API abut_status abut_points_append(abut_points *points,
                                          const abut_point *point);

  /** Append a point of one component over nodes with one unknown each
   * (dimension 1), g = gap + sum_l coefficient_l v_l: f = -1, and all nodes
   * count as the secondary's. */
  ABUT_API abut_status
  abut_points_append_scalar(abut_points *points, int64_t id, double weight,
                            double gap, abut_point_kind kind, int32_t n_nodes,
                            const int32_t *node, const double *coefficient);

  /** Remove the components of ties, and the tangents of contact points, with
   * @p keep [n_components] zero; contact points whose first component has zero
   * there, and ties without components; what is left stays in its order. */
  ABUT_API abut_status abut_points_filter(abut_points *points,
                                          const uint8_t *keep);

  /** Give all nodes new numbers: node l becomes @p number [n_nodes] [l] >= 0.
   */
  ABUT_API abut_status abut_points_renumber(abut_points *points,
                                            int32_t n_nodes,
                                            const int32_t *number);

  /** View of the arrays; view->struct_size must be set. */
  ABUT_API abut_status abut_points_get_sized(const abut_points *points,
                                             abut_points_view *view);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_points_get(const abut_points *points,
                                            abut_points_view *view)
  {
    if (view != NULL)
      view->struct_size = sizeof(*view);
    return abut_points_get_sized(points, view);
  }

  /** value[a] = g_a(v), [n_components], at displacements [n_nodes * dimension]
   * of the nodes; all nodes must be below @p n_nodes. */
  ABUT_API abut_status abut_points_gap(const abut_points *points,
                                       int32_t n_nodes,
                                       const double *displacement,
                                       double *value);

  /** Take the gaps g_a of the points first .. first + n_points - 1 for those
   * at displacements of the nodes [n_nodes * dimension]: g_a(v) becomes, at
   * these displacements, what g_a was. For points that were made where the
   * nodes are now. After a failure nothing has changed. */
  ABUT_API abut_status abut_points_set_origin(abut_points *points,
                                              int32_t first, int32_t n_points,
                                              int32_t n_nodes,
                                              const double *displacement);

  /** Add the contact force on the nodes to force [n_nodes * dimension], for
   * pressures (tractions) [n_components]. */
  ABUT_API abut_status abut_points_add_force(const abut_points *points,
                                             int32_t n_nodes,
                                             const double *pressure,
                                             double *force);

#ifdef __cplusplus
}
#endif

#endif

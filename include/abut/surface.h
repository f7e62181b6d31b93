/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SURFACE_H
#define ABUT_SURFACE_H

/** @file
 * Contact surfaces: facets over nodes, from plain arrays.
 *
 * A surface may hold the facets of several groups (bodies, boundary ids). Its
 * topology is fixed at creation; positions move by abut_surface_update().
 * Numbers that the caller gives to nodes and facets determine which nodes are
 * the same (in self contact, and between surfaces) and settle ties, so that a
 * result does not depend on the order of the arrays or on how a surface was cut
 * into parts.
 *
 * Directions of normals and orders of nodes are those of abut/facet.h.
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

  /** Opaque surface. */
  typedef struct abut_surface abut_surface;

  /** Arrays that a surface is made from. */
  typedef struct abut_surface_data
  {
    size_t struct_size; /**< sizeof(abut_surface_data) */
    int32_t dimension;  /**< of space: 2 or 3 */
    int32_t n_nodes;    /**< >= 0 */
    int32_t n_facets;   /**< >= 0 */
    /** Kind of all facets, if kinds is NULL. */
    abut_facet_kind kind;
    /** [n_facets] an abut_facet_kind each, all of this dimension; or NULL */
    const uint8_t *kinds;
    /** Nodes of the facets one after the other, each in [0, n_nodes). */
    const int32_t *connectivity;
    /** [n_nodes * dimension] positions, length; magnitude at most
     * ABUT_FACET_LIMIT */
    const double *position;
    /** [n_nodes] number of each node; equal numbers are one node. NULL: 0, 1,
     * ... */
    const int64_t *node_id;
    /** [n_facets] number of each facet, unique. NULL: 0, 1, ... */
    const int64_t *facet_id;
    /** [n_facets] group of each facet. NULL: 0 */
    const int32_t *group;
    /** Use the arrays above where they are; they must then outlive the
     * surface and stay unchanged (except positions, see
     * abut_surface_update()). Default false: they are copied. */
    bool borrow;
    /** Refuse facets that run around a common edge in the same direction as
     * their neighbour (inverted normals). Default true. */
    bool check_orientation;
    /** Angle between the normals of neighbours, radian in (0, pi], above
     * which an edge is a feature (a corner of the body) where nodal normals
     * are weighted by angle instead of area. Default 0.7 (40 degrees). */
    double feature_angle;
  } abut_surface_data;

  /** Defaults: three-dimensional, quad4, no facets. */
  static inline abut_surface_data abut_surface_data_defaults(void)
  {
    abut_surface_data data;
    memset(&data, 0, sizeof(data));
    data.struct_size = sizeof(abut_surface_data);
    data.dimension = 3;
    data.kind = ABUT_FACET_QUAD4;
    data.check_orientation = true;
    data.feature_angle = 0.7;
    return data;
  }

  /** Create a surface.
   *
   * Every facet is checked: INVALID_MESH, with the number of the facet in the
   * message, for a node out of range, a node used twice, a kind of the other
   * dimension, zero area, a facet folded in itself or inverted with respect
   * to its neighbour; NOT_FINITE with the number of the node. O(n), about a
   * microsecond per facet. */
  ABUT_API abut_status abut_surface_create(abut_context *context,
                                           const abut_surface_data *data,
                                           abut_surface **surface);

  /** Destroy a surface and set the handle to NULL. */
  ABUT_API abut_status abut_surface_destroy(abut_surface **surface);

  /** Move the nodes. @p position as in abut_surface_data: copied, or, for a
   * borrowing surface, used where it is from now on (it may be the same array
   * with new values). Topology and groups stay. NOT_FINITE, and nothing
   * changed, for NaN, infinity or a magnitude above ABUT_FACET_LIMIT. O(n). */
  ABUT_API abut_status abut_surface_update(abut_surface *surface,
                                           const double *position);

  /** Read-only view of a surface; arrays live as long as the surface and
   * follow its updates. */
  typedef struct abut_surface_view
  {
    size_t struct_size; /**< sizeof(abut_surface_view) */
    int32_t dimension;  /**< 2 or 3 */
    int32_t n_nodes;    /**< number of nodes */
    int32_t n_facets;   /**< number of facets */
    /** Facet f has the nodes from connectivity[facet_start[f]] to
     * connectivity[facet_start[f + 1] - 1]. [n_facets + 1] */
    const int32_t *facet_start;
    const int32_t *connectivity; /**< [facet_start[n_facets]] */
    const uint8_t *kinds;        /**< [n_facets] abut_facet_kind */
    const double *position;      /**< [n_nodes * dimension] */
    const int64_t *node_id;      /**< [n_nodes], or NULL: 0, 1, ... */
    const int64_t *facet_id;     /**< [n_facets], or NULL: 0, 1, ... */
    const int32_t *group;        /**< [n_facets], or NULL: 0 */
    /** Facets of node i: from node_facet[node_start[i]] to
     * node_facet[node_start[i + 1] - 1], ascending. [n_nodes + 1] */
    const int32_t *node_start;
    const int32_t *node_facet; /**< [node_start[n_nodes]] */
    /** [4 * n_facets] the facet across side k of facet f at 4 * f + k, or an
     * abut_neighbour. Side k of a surface facet joins its corners k and k + 1
     * on the way around; sides of a line are its two ends. */
    const int32_t *neighbour;
  } abut_surface_view;

  /** Values of abut_surface_view.neighbour that are no facet. */
  typedef enum abut_neighbour
  {
    ABUT_NEIGHBOUR_BORDER = -1, /**< no facet across: the surface ends here */
    ABUT_NEIGHBOUR_MANY = -2,   /**< more than two facets meet at the side */
    ABUT_NEIGHBOUR_UNUSED = -3  /**< the facet has no such side */
  } abut_neighbour;

  /** View of the arrays. O(1). */
  ABUT_API abut_status abut_surface_get_sized(const abut_surface *surface,
                                              abut_surface_view *view);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_surface_get(const abut_surface *surface,
                                             abut_surface_view *view)
  {
    if (view != NULL)
      view->struct_size = sizeof(*view);
    return abut_surface_get_sized(surface, view);
  }

  /** Averaged unit normals of the nodes at the current positions, [n_nodes *
   * dimension] (step 1 of the detection).
   *
   * The mean of the normals of the facets of a node, weighted by their areas;
   * at corners of the body (feature_angle) weighted by the angle of the facet
   * at the node, so that the mesh on either side of the corner does not tilt
   * the normal. Zero for a node without facets. Computed at the first call
   * after an update, O(n); the array lives as long as the surface. */
  ABUT_API abut_status abut_surface_normals(abut_surface *surface,
                                            const double **normal);

  /** Sizes of a surface at the current positions. The size of a facet is the
   * length of its longest side. */
  typedef struct abut_surface_sizes
  {
    size_t struct_size;      /**< sizeof(abut_surface_sizes) */
    double area;             /**< area of all facets (2D: length) */
    double smallest;         /**< smallest size of a facet; 0 without facets */
    double median;           /**< median size: the one at n_facets / 2 */
    double largest;          /**< largest size */
    double lower[3];         /**< box of the nodes of all facets */
    double upper[3];         /**< lower > upper without facets */
    int64_t n_border_sides;  /**< sides without a neighbour */
    int64_t n_feature_sides; /**< sides across which the normal rotates by more
                                than feature_angle (each counted once) */
  } abut_surface_sizes;

  /** Sizes of a surface. O(n). */
  ABUT_API abut_status abut_surface_measure_sized(abut_surface *surface,
                                                  abut_surface_sizes *sizes);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_surface_measure(abut_surface *surface,
                                                 abut_surface_sizes *sizes)
  {
    if (sizes != NULL)
      sizes->struct_size = sizeof(*sizes);
    return abut_surface_measure_sized(surface, sizes);
  }

  /** Mark the sides at which the surface ends or bends.
   * @param angle radian in (0, pi]; sides whose two normals differ by more
   * @param mask [n_facets] out: bit k is set if side k is a border, has more
   *   than two facets, or bends by more than @p angle. O(n). */
  ABUT_API abut_status abut_surface_features(abut_surface *surface,
                                             double angle, uint8_t *mask);

#ifdef __cplusplus
}
#endif

#endif

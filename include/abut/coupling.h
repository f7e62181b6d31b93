/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_COUPLING_H
#define ABUT_COUPLING_H

/** @file
 * Coupling of two surfaces, or of a surface and a rigid obstacle: the contact
 * condition discretised into points over nodes (abut/points.h).
 *
 * Point j has a weighting function psi_j on the secondary surface and
 *
 *     W_j  = integral of psi_j                       weight, area
 *     D_jl = integral of psi_j phi_l                 l: secondary nodes
 *     M_jl = integral of psi_j N_l                   l: primary nodes
 *     g_j  = n_j . integral of psi_j (x_m - x_s) / W_j    gap, length
 *
 * where the integrals run over the part of the secondary surface that the
 * primary covers, x_m is the point of the primary opposite the point x_s of
 * the secondary, phi and N are the shape functions of the two sides, and n_j
 * the outward unit normal of the secondary. The stencil has the coefficients
 * D_jl / W_j at nodes of the secondary and -M_jl / W_j at those of the primary;
 * for small displacements u
 *
 *     g_j(u) = g_j - n_j . (sum_l D_jl / W_j u_l - sum_l M_jl / W_j u_l)
 *
 * Dual mortar has the gaps of nodes instead, sum_l D_jl / W_j g_l, because its
 * psi_j are negative in places (doc/develop/coupling.md, "Gaps of dual
 * mortar"); but not where points move.
 *
 * Both sums of coefficients are one, and the weights of all points add up to
 * the covered area.
 *
 *   node to segment    psi_j is the node itself: one point per node, against
 * the nearest point of the primary surface; n_j is minus the normal there. A
 * constant pressure is not transferred exactly. quadrature point   one per
 * point of a quadrature rule on each common segment or polygon, or on each
 * facet, against the primary along the secondary's normal. mortar psi_j =
 * phi_j, integrals over the exact common segments (2D) or polygons (3D) of the
 * facets: Puso and Laursen, Comput. Methods Appl. Mech. Engrg. 193 (2004) 601 ;
 * quadratic facets are cut into linear parts for clipping: Puso, Laursen and
 * Solberg, Comput. Methods Appl. Mech. Engrg. 197 (2008) 555. dual mortar psi_j
 * biorthogonal to phi_j, on partly covered facets over the covered part:
 * Wohlmuth, SIAM J. Numer. Anal. 38 (2000) 989; Popp, Gitterle, Gee and Wall,
 * Int. J. Numer. Meth. Engng 83 (2010) 1428; Cichosz and Bischoff, Comput.
 * Methods Appl. Mech. Engrg. 200 (2011) 1317. The row of a node has no other
 * secondary node than its own and dropped neighbours.
 *
 * Stencils are sums over facets in the order of the facets' numbers, so that
 * they are bitwise independent of which other points are wanted. Nothing here
 * is collective: a process that holds all facets around its nodes (two layers
 * of them for quadratic facets and at corners) builds complete points by
 * itself.
 */

#include <abut/context.h>
#include <abut/export.h>
#include <abut/kinematics.h>
#include <abut/obstacle.h>
#include <abut/points.h>
#include <abut/search.h>
#include <abut/surface.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C"
{
#endif

/** Name in the parameter file. */
#define ABUT_DISCRETISATION_LIST(X)                                            \
  X(NODE_TO_SEGMENT, "node to segment")                                        \
  X(QUADRATURE_POINT, "quadrature point")                                      \
  X(MORTAR, "mortar")                                                          \
  X(DUAL_MORTAR, "dual mortar")

  /** Ways of discretising the contact condition. */
  typedef enum abut_discretisation
  {
/** @cond */
#define ABUT_DISCRETISATION_ENTRY(name, text) ABUT_DISCRETISATION_##name,
    /** @endcond */
    ABUT_DISCRETISATION_LIST(ABUT_DISCRETISATION_ENTRY)
#undef ABUT_DISCRETISATION_ENTRY
    /** Number of discretisations; not one. */
    ABUT_DISCRETISATION_N
  } abut_discretisation;

  /** Name of a discretisation ("dual mortar"); never NULL. */
  ABUT_API const char *
  abut_discretisation_name(abut_discretisation discretisation);

  /** Properties of a discretisation. */
  typedef struct abut_discretisation_info
  {
    size_t struct_size; /**< sizeof(abut_discretisation_info) */
    const char *help;   /**< what it is, a part of a sentence */
    /** Rows are at points of a quadrature rule, more of them than the surface
     * has unknowns: exact laws lock. Else at nodes. */
    bool row_per_point;
    bool is_weighted;  /**< gaps in weighted mean: a constant pressure is
                            transferred exactly */
    bool couples_rows; /**< a row has several secondary nodes: its multiplier
                            cannot be eliminated by itself */
    bool has_degree;   /**< abut_coupling_options.multiplier_degree has a
                            meaning */
  } abut_discretisation_info;

  /** Describe a discretisation; INVALID_ARGUMENT if there is no such one. */
  ABUT_API abut_status abut_discretisation_describe_sized(
      abut_discretisation discretisation, abut_discretisation_info *info);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_discretisation_describe(abut_discretisation discretisation,
                               abut_discretisation_info *info)
  {
    if (info != NULL)
      info->struct_size = sizeof(*info);
    return abut_discretisation_describe_sized(discretisation, info);
  }

  /** Discretisation by its name; INVALID_ARGUMENT if there is none. */
  ABUT_API abut_status abut_discretisation_find(
      const char *name, abut_discretisation *discretisation);

  /** Options of a coupling. */
  typedef struct abut_coupling_options
  {
    size_t struct_size; /**< sizeof(abut_coupling_options) */
    /** Default: dual mortar. */
    abut_discretisation discretisation;
    /** Degree of the weighting functions: 0 (default) that of the facet; 1 on
     * quadratic facets: linear between the corners, rows at corners only
     * (mortar). */
    int32_t multiplier_degree;
    /** Polynomials up to this degree are integrated exactly on flat facets: 0
     * (default) automatic, or 1 .. 8. */
    int32_t quadrature_degree;
    /** Integrate over the exact common parts of facets (default true); each of
     * them has quadrature points of its own. False: over whole facets with the
     * points projected one by one; faster and with fewer points, but a constant
     * pressure is only transferred to within some 1e-2. Node to segment has no
     * integrals. */
    bool segments;
    /** Integrals are those of the body of revolution about the axis x = 0: the
     * weight of a point is multiplied by 2 pi x (2D only; x >= 0 at all
     * nodes). Default false. */
    bool axisymmetric;
    /** Dual mortar, where points stay: interpolate the gaps at nodes, which a
     * convex primary does not make smaller (default true). False: weighted
     * gaps. Contact forces are their derivatives, and conserve energy where
     * points are renewed in each step. */
    bool interpolated_gaps;
    /** Largest cosine of the angle between the two outward normals, in
     * [-1, 1]; default -0.17: within 80 degrees of opposite. */
    double normal_cosine;
    /** Thickness of the primary's body, length: what is deeper than half of it
     * is on the wrong side. Against an obstacle that of the secondary's: no
     * point behind the middle of a thin obstacle is pushed back by more. 0
     * (default): no limit but the reach, or the extent of the surface. */
    double thickness;
    /** Reach (of each primary facet; with an obstacle: of each secondary
     * facet), algorithm and skin. Parts with a gap above the reach, or, but for
     * obstacles, deeper than it, are not covered. */
    abut_search_options search;
  } abut_coupling_options;

  /** Default options. */
  static inline abut_coupling_options abut_coupling_defaults(void)
  {
    const abut_coupling_options options = {sizeof(abut_coupling_options),
                                           ABUT_DISCRETISATION_DUAL_MORTAR,
                                           0,
                                           0,
                                           true,
                                           false,
                                           true,
                                           -0.17,
                                           0.,
                                           abut_search_defaults()};
    return options;
  }

  /** Whether a discretisation with weighting functions of this degree exists
   * on facets of this kind. UNSUPPORTED, with the reason in *reason (may be
   * NULL; a string that lives for ever), if not:
   *
   *   weighting functions of degree 0 per facet are never offered: they are
   *   not stable on facets of degree 1;
   *   dual functions of degree 1 on quadratic facets are not biorthogonal to
   *   the shape functions;
   *   the shape functions of tri6 have no weight at the corners: only mortar
   *   with degree 1 and quadrature points are offered there. */
  ABUT_API abut_status abut_coupling_check(abut_discretisation discretisation,
                                           int32_t multiplier_degree,
                                           abut_facet_kind kind,
                                           const char **reason);

  /** Data of the nodes of the secondary surface; n_nodes is their number.
   * Arrays are read during abut_coupling_build() only. */
  typedef struct abut_coupling_nodes
  {
    size_t struct_size; /**< sizeof(abut_coupling_nodes) */
    /** [n_nodes] nonzero: the row of this node is wanted. NULL: all. Not used
     * for quadrature points. */
    const uint8_t *wanted;
    /** [n_facets] nonzero: the rows of this facet are wanted (quadrature
     * points only). NULL: all. */
    const uint8_t *wanted_facet;
    /** [n_nodes] nonzero: the node carries no multiplier (held in normal
     * direction, or at a crosspoint); its share goes to the kept nodes of the
     * same facet in equal parts. NULL: none. */
    const uint8_t *dropped;
    /** Hanging nodes: displacement of node hanging_node[h] is the sum over e =
     * hanging_start[h] .. hanging_start[h + 1] - 1 of hanging_weight[e] times
     * that of node hanging_parent[e]. Parents are nodes of the same surface
     * that do not hang themselves; they may have no facet. Weights of a node
     * add up to one. A hanging node has no row. */
    int32_t n_hanging;
    const int32_t *hanging_node;   /**< [n_hanging] each once */
    const int32_t *hanging_start;  /**< [n_hanging + 1] */
    const int32_t *hanging_parent; /**< [hanging_start[n_hanging]] */
    const double *hanging_weight;  /**< [hanging_start[n_hanging]] */
  } abut_coupling_nodes;

  /** Defaults: all rows wanted, no node dropped, none hanging. */
  static inline abut_coupling_nodes abut_coupling_nodes_defaults(void)
  {
    const abut_coupling_nodes nodes = {sizeof(abut_coupling_nodes),
                                       NULL,
                                       NULL,
                                       NULL,
                                       0,
                                       NULL,
                                       NULL,
                                       NULL,
                                       NULL};
    return nodes;
  }

  /** Opaque coupling. */
  typedef struct abut_coupling abut_coupling;

  /** Create a coupling between two surfaces, which must outlive it. Node
   * numbers exclude pairs of facets with a common node if both surfaces are
   * the same object or both were given numbers. @p options may be NULL.
   * UNSUPPORTED as in abut_coupling_check(). */
  ABUT_API abut_status abut_coupling_create(
      abut_context *context, abut_surface *secondary, abut_surface *primary,
      const abut_coupling_options *options, abut_coupling **coupling);

  /** Create a coupling between a surface and a rigid obstacle, which must
   * outlive it. Rows have no primary entries; the gap is the weighted mean of
   * the obstacle's signed distance (dual mortar: of that at nodes), the normal
   * that of minus its gradient. A facet takes part as a whole or not at all: if
   * the obstacle faces its centre; rows with a gap above the reach are left
   * out. */
  ABUT_API abut_status abut_coupling_create_obstacle(
      abut_context *context, abut_surface *secondary, abut_obstacle *obstacle,
      const abut_coupling_options *options, abut_coupling **coupling);

  /** Destroy a coupling and set the handle to NULL. */
  ABUT_API abut_status abut_coupling_destroy(abut_coupling **coupling);

  /** Where the points of a build go, and what they are to be. */
  typedef struct abut_coupling_target
  {
    size_t struct_size;  /**< sizeof(abut_coupling_target) */
    abut_points *points; /**< appended to; as many dimensions as the surfaces */
    /** [n_nodes] numbers >= 0 that nodes of the secondary have in the set;
     * NULL: their own. */
    const int32_t *secondary_node;
    /** The same of the primary; NULL: they follow those of the secondary. */
    const int32_t *primary_node;
    /** Number of the point of a node, [n_nodes] of the secondary, or of the
     * first quadrature point of a facet, [n_facets]; further ones follow it.
     * NULL: that of the node itself, or the facet's times
     * ABUT_COUPLING_POINTS_PER_FACET. */
    const int64_t *id;
    /** 0 (default): contact along the normal. Else ties along those axes whose
     * bits (1, 2, 4) are set, with one component each and gaps of zero. */
    uint32_t tie_axes;
    double gap; /**< added to gaps of contact, length; default 0 */
    bool flush; /**< surfaces count as touching: leave out their distance */
    /** Points of contact have their tangents, too, with slips of zero: in the
     * plane t = (-n2, n1); in space t1 is the axis that is most tangential, in
     * the tangent plane, and t2 = n x t1. In other kinematics than reference
     * they rotate with the secondary instead: t1 is, in the tangent plane, half
     * way between a facet's first local direction and its second one rotated by
     * a right angle; at a node it is the facet with the smallest number there,
     * but for those that are 60 degrees off. Their numbers follow that of the
     * normal: numbers of points that are given must leave room. */
    bool tangents;
    /** Default: reference. Ties have no other. Updated and current: the
     * surfaces stand at that configuration. Current: gaps against an obstacle
     * are those of abut_obstacle_gap(), against a surface the signed distance
     * of the nearest point (abut_facet_distance_derivatives(); a little beyond
     * its border, up to abut_detection_options.extension, that of the facet
     * there continued). The first direction of a point is minus their gradient,
     * and the view has their second derivatives. Quadrature points are on whole
     * facets then, and mortar has its segments. Points of mortar meet what is
     * opposite along the normals, and the view has what their forces change by;
     * nodes that are covered by less than a fifth have none. No mortar against
     * obstacles. Corotational: a pair that rotates as one keeps gaps and
     * pressures; the view has what the forces change by as nodes move. Mortar
     * between surfaces only. With flush gaps are what they have changed by. */
    abut_kinematics kinematics;
    /** Updated and current: [n_nodes * dimension] positions of the secondary's
     * nodes in the reference configuration, which weights are measured in;
     * else, and where there are no nodes, NULL (default). */
    const double *reference;
    /** Corotational: [n_nodes * dimension] current positions of the nodes of
     * the secondary; else NULL (default). */
    const double *current;
    const double *current_primary; /**< those of the primary's nodes */
  } abut_coupling_target;

  enum
  {
    /** More than the quadrature points of any facet. */
    ABUT_COUPLING_POINTS_PER_FACET = 1 << 24
  };

  /** Contact points, nodes and points with their own numbers. */
  static inline abut_coupling_target
  abut_coupling_target_defaults(abut_points *points)
  {
    const abut_coupling_target target = {sizeof(abut_coupling_target),
                                         points,
                                         NULL,
                                         NULL,
                                         NULL,
                                         0,
                                         0.,
                                         false,
                                         false,
                                         ABUT_KINEMATICS_REFERENCE,
                                         NULL,
                                         NULL,
                                         NULL};
    return target;
  }

  /** Append the points at the current positions (and pose).
   *
   * @param nodes may be NULL: the defaults
   * @param motion length >= 0: largest relative motion of the surfaces since
   *   the last call (over all processes); the reach is at least 1.5 times as
   *   large. 0 if unknown
   *
   * Points come in ascending order of the numbers that the surface was given
   * for its nodes (quadrature points: of the facet, then of the point), entries
   * of a side in that of its nodes. After a failure nothing is appended.
   *
   * Nodes without coverage have no point; nor have nodes whose weight is below
   * 1e-6 of their full weight. On quadratic facets, whose shape functions
   * change sign, a node of which less than about a quarter is covered is
   * treated as dropped. A hanging node is in no stencil as one of the
   * secondary; it may be in one as a node of the primary.
   *
   * 2D: about a microsecond per pair of facets; 3D: about ten. Allocates
   * nothing once warmed up. */
  ABUT_API abut_status abut_coupling_build(abut_coupling *coupling,
                                           const abut_coupling_nodes *nodes,
                                           double motion,
                                           const abut_coupling_target *target);

  /** Read-only view of what is known of the points beside the set that they
   * are in; lives until the next build. */
  typedef struct abut_coupling_view
  {
    size_t struct_size;   /**< sizeof(abut_coupling_view) */
    int32_t dimension;    /**< 2 or 3 */
    int32_t n_points;     /**< points of the last build */
    int32_t first;        /**< place of the first of them in the set */
    const int32_t *node;  /**< [n_points] secondary node, with its number on the
                               surface; -1: quadrature point */
    const int32_t *facet; /**< [n_points] quadrature point: its secondary facet;
                               node to segment: the primary facet; else -1 */
    const int32_t *point; /**< [n_points] quadrature point: number of the point
                               within the facet; else 0 */
    /** [n_points] weight if the whole surface were covered: the integral of
     * phi_j plus the shares of dropped neighbours. */
    const double *full_weight;
    const double *position; /**< [n_points * dimension] where the point sits:
                                 the node, or the quadrature point */
    /** Second derivatives of the gaps: those of point i are the square matrix
     * from hessian_start[i] on, with respect to the place of the point, which
     * is the sum of the secondary's part of the stencil, then the nodes of its
     * primary facet, in their order there, if it has one. With tangents it is
     * followed by as many more matrices: row k of each has the derivatives of
     * the derivative of the slip along that tangent with respect to unknown k,
     * by present tangents and shares. For mortar it is one matrix with
     * dimension lines for each node line[line_start[i]] .., those of the
     * stencil and some with coefficients 0, and dimension columns for each node
     * column[column_start[i]] ..: the derivatives of the gap's derivatives,
     * - n c_l, by the places of nodes. The direction n and the primary's
     * coefficients change; those of the secondary and the weight do not, as
     * long as the border of the primary does not cut a facet. It is not
     * symmetric. With tangents it is followed by as many more matrices of that
     * size, those of t c_l. NULL: the points are fixed. */
    const double *hessian;
    const int64_t *hessian_start; /**< [n_points + 1]; NULL likewise */
    /** [n_points] primary facet that has the nearest point of one that moves;
     * else -1. */
    const int32_t *primary;
    /** Mortar that moves: nodes by their numbers in the set, those of point i
     * from start[i] to start[i + 1] - 1; else NULL. */
    const int64_t *line_start;   /**< [n_points + 1] */
    const int32_t *line;         /**< [line_start[n_points]] */
    const int64_t *column_start; /**< [n_points + 1] */
    const int32_t *column;       /**< [column_start[n_points]] */
    /** [n_points] mortar that moves: the least gap, length, at points of
     * integration on facets with a share in the row, along the facets' mean
     * normals, without the gap of the target; else NULL. */
    const double *least;
    /** [nodes of the secondary] as full_weight, of nodes with and without
     * points; on the facets of points that are wanted. */
    const double *full_of_node;
  } abut_coupling_view;

  /** View of the last build. O(1). */
  ABUT_API abut_status abut_coupling_get_sized(const abut_coupling *coupling,
                                               abut_coupling_view *view);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status abut_coupling_get(const abut_coupling *coupling,
                                              abut_coupling_view *view)
  {
    if (view != NULL)
      view->struct_size = sizeof(*view);
    return abut_coupling_get_sized(coupling, view);
  }

  /** Statistics of a build. Areas and numbers of rows add up over processes, if
   * each row is wanted on one; the others count facets that a process had to
   * look at. */
  typedef struct abut_coupling_statistics
  {
    size_t struct_size;  /**< sizeof(abut_coupling_statistics) */
    double covered_area; /**< sum of the weights of all rows */
    double full_area;    /**< sum of the full weights of all wanted nodes */
    int64_t n_facets;    /**< secondary facets looked at */
    int64_t n_covered;   /**< of these, covered at least in part */
    int64_t n_pairs;     /**< pairs of linear parts of facets with a common
                              part; points with an opposite point, if not
                              integrated over segments */
    int64_t n_lumped;    /**< facets too little covered, or too distorted, for
                              dual functions: lumped functions instead */
    int64_t n_weak;      /**< wanted nodes with coverage, but without a row */
    int64_t n_split;     /**< rows at a feature of the surface whose normal is
                              that of the covered side only */
    int64_t n_corners;   /**< wanted nodes at a feature that is covered on both
                              sides: treated as dropped */
    int64_t n_bent;      /**< rows at such a place all the same, because their
                              facets have no other node */
    int64_t n_layers;    /**< common parts cut back because a nearer facet
                              covers the same spot */
    double largest_warping; /**< largest angle between the normals of a
                                 secondary facet's nodes and its mean normal,
                                 radian */
    double size_ratio; /**< median facet size of secondary by primary; 0 with
                            an obstacle or without facets. Far above 1: primary
                            nodes may pass between secondary ones */
  } abut_coupling_statistics;

  /** Statistics of the last build. */
  ABUT_API abut_status abut_coupling_get_statistics_sized(
      const abut_coupling *coupling, abut_coupling_statistics *statistics);

  /** The same, with the size of the caller's struct filled in. */
  static inline abut_status
  abut_coupling_get_statistics(const abut_coupling *coupling,
                               abut_coupling_statistics *statistics)
  {
    if (statistics != NULL)
      statistics->struct_size = sizeof(*statistics);
    return abut_coupling_get_statistics_sized(coupling, statistics);
  }

#ifdef __cplusplus
}
#endif

#endif

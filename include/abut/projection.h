/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_PROJECTION_H
#define ABUT_PROJECTION_H

/** @file
 * Projection of points onto facets: nearest point, gap, normal, and the
 * derivatives of the gap.
 *
 * The nearest point y of the facet to the point x minimises |x - y(xi)| over
 * the closed reference domain. Gap and normal follow the facet's side:
 * g = n . (x - y) with the facet's outward unit normal n at y, so that g > 0
 * where x lies on the outward side (open) and g < 0 where it has penetrated.
 * Where y is inside the facet |g| is the distance.
 */

#include <abut/export.h>
#include <abut/facet.h>
#include <math.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Result of a projection; third components are zero in 2D. */
  typedef struct abut_projection
  {
    double local[2];  /**< local coordinates of the nearest point y (lines: the
                           second is zero) */
    double point[3];  /**< y */
    double normal[3]; /**< unit outward normal of the facet at y; zero where
                           the facet has none */
    double gap;       /**< n . (x - y); the distance where n is zero */
    double distance;  /**< |x - y| >= 0 */
    /** How far the orthogonal projection onto the facet continued beyond its
     * edges lies outside, in local coordinates (largest component; on
     * triangles the largest of -xi, -eta and xi + eta - 1); 0 inside. Exact
     * for lines, tri3 and planar parallelograms; for the other kinds the
     * estimate of the tangent plane at y. */
    double violation;
    int32_t iterations; /**< Newton steps; 0 where there is a closed form */
    uint8_t inside;     /**< nonzero: x - y is orthogonal to the facet at y, or
                             misses the edge by at most 1e-12 in local
                             coordinates */
    uint8_t converged;  /**< zero: y is the best point found, to less than full
                             accuracy */
  } abut_projection;

  /** Project the point @p x onto a facet.
   *
   * Closed form for line2, tri3 and planar parallelograms; else Newton's
   * method, safeguarded, with as many starts as the curvature of the facet
   * calls for, and the edges where the minimum lies on them. Terminates
   * always. A point that does not converge is data (field converged), not an
   * error. Ties of equally near points are broken deterministically.
   * @param nodes [n_nodes * dimension]
   * @param x [dimension]
   * Errors: INVALID_ARGUMENT (kind, NULL), NOT_FINITE. A facet without area
   * is no error: its nearest point is found, its normal may be zero. Cost: 20
   * to 100 ns for the linear kinds near the facet, some microseconds for
   * strongly curved ones. */
  ABUT_API abut_status abut_facet_project(abut_facet_kind kind,
                                          const double *nodes, const double *x,
                                          abut_projection *projection);

  /** Pairs of points and facets of one kind, and their data. Arrays are owned
   * by the caller; result arrays may be NULL. */
  typedef struct abut_projection_batch
  {
    size_t struct_size;         /**< sizeof(abut_projection_batch) */
    abut_facet_kind kind;       /**< of all facets */
    int32_t n_points;           /**< number of points */
    int32_t n_nodes;            /**< number of nodes of the facets */
    int32_t n_facets;           /**< number of facets */
    int64_t n_pairs;            /**< number of pairs */
    const double *points;       /**< [n_points * dimension] */
    const double *positions;    /**< [n_nodes * dimension] */
    const int32_t *facet_nodes; /**< [n_facets * nodes per facet] */
    const int32_t *pair_point;  /**< [n_pairs] number of the point */
    const int32_t *pair_facet;  /**< [n_pairs] number of the facet */
    double *local;              /**< [n_pairs * (dimension - 1)], out */
    double *gap;                /**< [n_pairs], out */
    double *distance;           /**< [n_pairs], out */
    double *violation;          /**< [n_pairs], out */
    double *normal;             /**< [n_pairs * dimension], out */
    uint8_t *inside;            /**< [n_pairs], out */
  } abut_projection_batch;

  /** Project many pairs; each result is the one of abut_facet_project(), bit
   * for bit. All arguments are checked before anything is written: O(n_pairs +
   * n_nodes + n_points). */
  ABUT_API abut_status
  abut_facet_project_batch(const abut_projection_batch *batch);

  /** Bounds of the distance of a point to a facet of which only centre and
   * radius are known (abut_facet_measures): the distance is at least
   * max(0, |x - c| - r) and at most |x - c|, because the centre is a point of
   * the facet. No checks; a few nanoseconds, for the ranking of candidates. */
  static inline void abut_facet_distance_bounds(int32_t dimension,
                                                const double *centre,
                                                double radius, const double *x,
                                                double *lower, double *upper)
  {
    double s = 0.;
    for (int32_t d = 0; d < dimension; ++d)
      s += (x[d] - centre[d]) * (x[d] - centre[d]);
    s = sqrt(s);
    *upper = s;
    *lower = s > radius ? s - radius : 0.;
  }

  /** Gradient and Hessian of the gap with respect to the point and the nodes
   * of the facet, at a projection with inside set:
   *
   *     dg  = n . (dx - sum_a N_a dx_a)
   *     d2g = - T'H^-1 E - E'H^-1 T - g E'H^-1 E - T'A^-1 B H^-1 T
   *
   * with A the metric, B the curvature n . y_,ab and H = A - g B of the facet
   * at y, T_a = y_,a . (dx - sum N dx) and E_a = n . sum N_,a dx (Konyukhov
   * and Schweizerhof, Computational Contact Mechanics, 2013, ch. 5).
   * Unknowns: the components of x, then those of the nodes in order; n =
   * dimension * (1 + n_nodes).
   * @param gradient [n], or NULL
   * @param hessian [n * n], symmetric, or NULL
   * UNSUPPORTED where the projection lies on the edge, the facet has no
   * normal, or x is a centre of curvature (H singular). */
  ABUT_API abut_status abut_facet_gap_derivatives(
      abut_facet_kind kind, const double *nodes,
      const abut_projection *projection, double *gradient, double *hessian);

  /** The same of the signed distance g = side |x - y|, wherever the nearest
   * point y is: inside, where it is the gap as above, on an edge, or at a
   * corner. On an edge T and E are those along it, at a corner there are none,
   * and the direction n = (x - y) / g rotates about the edge or the corner:
   *
   *     d2g += v' (I - n n' - t t') v / g,  v = dx - sum N dx,
   *
   * with the unit tangent t of the edge. Where y passes from the inside to an
   * edge g and dg are continuous, and d2g are those of the side that the
   * projection is on.
   * @param x [dimension] the point that was projected
   * @param side 1 where x is outside of the surface, -1 inside; the facet's own
   * normal does not decide it near a corner. Without meaning inside the facet
   * UNSUPPORTED where x lies on the edge, in addition to the cases above. */
  ABUT_API abut_status abut_facet_distance_derivatives(
      abut_facet_kind kind, const double *nodes, const double *x,
      const abut_projection *projection, double side, double *gradient,
      double *hessian);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_FACET_H
#define ABUT_FACET_H

/** @file
 * Facets: the pieces of a contact surface. Their kinds, shape functions,
 * measures and checks.
 *
 * Positions of a facet are given as one array `nodes` of n_nodes * dimension
 * numbers, node after node. Local coordinates lie in [-1, 1] for lines, in
 * [-1, 1]^2 for quadrilaterals, and in the unit triangle xi >= 0, eta >= 0,
 * xi + eta <= 1 for triangles. The order of the nodes is that of the degrees
 * of freedom of a deal.II face: corners lexicographically, then the middle of
 * the edges, then the centre.
 *
 *     line2, line3      quad4, quad9            tri3, tri6
 *
 *                       2 --- 7 --- 3           2
 *     0 --- 2 --- 1     |           |           | \
 *                       4     8     5           5   4
 *                       |           |           |     \
 *                       0 --- 6 --- 1           0 - 3 - 1
 *
 * The outward normal of a line with tangent (tx, ty) is (ty, -tx); a surface
 * facet's is the vector product of its tangents along xi and eta. A 2D body
 * whose boundary is walked counter-clockwise, and a 3D body whose facets are
 * numbered counter-clockwise as seen from outside, has outward normals.
 *
 * All functions are pure, allocate nothing and may be called by any thread.
 * They work relative to the facet's centre and with tolerances relative to
 * its size. Coordinates must not exceed ABUT_FACET_LIMIT.
 */

#include <abut/export.h>
#include <abut/status.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

/** Largest magnitude of a coordinate; larger ones count as not finite. The
 * smallest size of a facet is its inverse. Between the two no product of
 * lengths that occurs here overflows or vanishes. */
#define ABUT_FACET_LIMIT 1e40

/** Largest number of nodes of a facet of any kind. */
#define ABUT_FACET_MAX_NODES 9

/** Kind, name, nodes, corners, dimension of space. */
#define ABUT_FACET_KIND_LIST(X)                                                \
  X(LINE2, "line2", 2, 2, 2)                                                   \
  X(LINE3, "line3", 3, 2, 2)                                                   \
  X(TRI3, "tri3", 3, 3, 3)                                                     \
  X(TRI6, "tri6", 6, 3, 3)                                                     \
  X(QUAD4, "quad4", 4, 4, 3)                                                   \
  X(QUAD9, "quad9", 9, 4, 3)

  /** Kinds of facets: lines in 2D, triangles and quadrilaterals in 3D. */
  typedef enum abut_facet_kind
  {
/** @cond */
#define ABUT_FACET_KIND_ENTRY(kind, name, nodes, corners, dimension)           \
  ABUT_FACET_##kind,
    /** @endcond */
    ABUT_FACET_KIND_LIST(ABUT_FACET_KIND_ENTRY)
#undef ABUT_FACET_KIND_ENTRY
    /** Number of kinds; not a kind. */
    ABUT_FACET_N_KINDS
  } abut_facet_kind;

  /** Number of nodes of a kind; 0 for a number that is no kind. */
  ABUT_API int32_t abut_facet_n_nodes(abut_facet_kind kind);

  /** Number of corners of a kind; 0 for a number that is no kind. */
  ABUT_API int32_t abut_facet_n_corners(abut_facet_kind kind);

  /** Dimension of the space that a kind lives in: 2 or 3; 0 for a number that
   * is no kind. */
  ABUT_API int32_t abut_facet_dimension(abut_facet_kind kind);

  /** Name of a kind ("quad4"); never NULL. */
  ABUT_API const char *abut_facet_name(abut_facet_kind kind);

  /** Order of the nodes in VTK's cell of this kind (VTK_LINE,
   * VTK_QUADRATIC_EDGE, VTK_TRIANGLE, VTK_QUADRATIC_TRIANGLE, VTK_QUAD,
   * VTK_BIQUADRATIC_QUAD): VTK's node i is our node order[i]. NULL for a
   * number that is no kind. */
  ABUT_API const int8_t *abut_facet_vtk_order(abut_facet_kind kind);

  /** Number of second derivatives of a shape function: 1 for lines, 3 for
   * surfaces. */
  ABUT_API int32_t abut_facet_n_second(abut_facet_kind kind);

  /** Shape functions and their derivatives at a point of the reference domain
   * (or outside it).
   * @param local [dimension - 1] local coordinates
   * @param value [n_nodes] N_a, or NULL
   * @param first [n_nodes * (dimension - 1)] dN_a/dxi, dN_a/deta, or NULL
   * @param second [n_nodes * n_second] d2N_a/dxi2, (d2N_a/deta2,
   *   d2N_a/dxi deta), or NULL */
  ABUT_API abut_status abut_facet_shape(abut_facet_kind kind,
                                        const double *local, double *value,
                                        double *first, double *second);

/** Faults of a facet: name, text. */
#define ABUT_FACET_FAULT_LIST(X)                                               \
  X(NONE, "no fault")                                                          \
  X(KIND, "the facet's kind is not known")                                     \
  X(NOT_FINITE, "a coordinate is NaN, infinite or out of range")               \
  X(COINCIDENT, "two nodes of the facet coincide")                             \
  X(ZERO_AREA, "the facet has no area (or length)")                            \
  X(FOLDED,                                                                    \
    "the facet is folded or inverted: its normal rotates by more than "        \
    "90 degrees within it")

  /** Faults of a facet, in the order in which they are looked for. */
  typedef enum abut_facet_fault
  {
/** @cond */
#define ABUT_FACET_FAULT_ENTRY(name, text) ABUT_FACET_FAULT_##name,
    /** @endcond */
    ABUT_FACET_FAULT_LIST(ABUT_FACET_FAULT_ENTRY)
#undef ABUT_FACET_FAULT_ENTRY
  } abut_facet_fault;

  /** English text of a fault; never NULL. */
  ABUT_API const char *abut_facet_fault_text(abut_facet_fault fault);

  /** The first fault of a facet, or ABUT_FACET_FAULT_NONE.
   *
   * Zero area: less than 1e-12 of the squared diameter, or lost in the
   * round-off of the coordinates; slivers and needles above that are legal.
   * Folded: the normal at a node has no positive component along the mean
   * normal; for quad4 the nodes decide for the whole facet, for the quadratic
   * kinds they are a sample. */
  ABUT_API abut_facet_fault abut_facet_check(abut_facet_kind kind,
                                             const double *nodes);

  /** Measures of a facet; 3-vectors have a zero third component in 2D. */
  typedef struct abut_facet_measures
  {
    double centre[3]; /**< point of the facet at the centre of the reference
                           domain (triangles: at (1/3, 1/3)) */
    double normal[3]; /**< unit mean outward normal; 0 if there is none */
    double lower[3];  /**< box that surely contains the facet */
    double upper[3];  /**< the box, other corner */
    double area;      /**< area (2D: length) */
    double radius;    /**< ball about the centre that surely contains the facet
                           (exact for the linear kinds) */
    double diameter;  /**< largest distance of two nodes */
    double warping;   /**< largest angle of the normal at a node with the mean
                           normal, radian */
    double aspect;    /**< squared diameter by area (2D: diameter by length);
                           about 2 for a square, large for a sliver, infinite
                           without area */
  } abut_facet_measures;

  /** Size of a facet, to which relative reaches refer: the length of its
   * longest side between corners. 0 for an unknown kind or NULL. */
  ABUT_API double abut_facet_size(abut_facet_kind kind, const double *nodes);

  /** Measure a facet. A facet with the faults COINCIDENT, ZERO_AREA or FOLDED
   * is measured, too. NOT_FINITE if a coordinate is. Cost: some 100
   * operations for the linear kinds, 10 times that for the quadratic ones,
   * whose area is integrated by a Gauss rule of 4 x 4 points (line3: 5). */
  ABUT_API abut_status abut_facet_measure(abut_facet_kind kind,
                                          const double *nodes,
                                          abut_facet_measures *measures);

  /** Area (2D: length) of the part of a secondary facet that a primary facet
   * covers: the common polygon of the two in the plane of the secondary facet
   * (of each of its linear parts), by clipping; 0 if it is smaller than 1e-9
   * of the smaller facet. How far the two are apart and whether they face each
   * other is not looked at.
   * @param secondary [n_nodes * dimension] nodes of the secondary facet
   * @param primary nodes of the primary facet
   * @param area out
   * INVALID_ARGUMENT for NULL, no kinds, or kinds of two dimensions;
   * NOT_FINITE for a coordinate. About 300 ns for two quadrilaterals. */
  ABUT_API abut_status abut_facet_covered_area(abut_facet_kind secondary_kind,
                                               const double *secondary,
                                               abut_facet_kind primary_kind,
                                               const double *primary,
                                               double *area);

  /** Point and unit normal of a facet at local coordinates.
   * @param local [dimension - 1]
   * @param point [dimension], or NULL
   * @param normal [dimension], or NULL; zero where the facet has none */
  ABUT_API abut_status abut_facet_point(abut_facet_kind kind,
                                        const double *nodes,
                                        const double *local, double *point,
                                        double *normal);

#ifdef __cplusplus
}
#endif

#endif

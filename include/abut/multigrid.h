/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_MULTIGRID_H
#define ABUT_MULTIGRID_H

/** @file
 * Geometric multigrid for a symmetric matrix some unknowns of which are held,
 * over plain arrays: the preconditioner of a contact problem whose set changes.
 *
 * A field has `block` unknowns at each node. The host gives, for each mesh, by
 * what weights its nodes follow from those of the next coarser mesh; the same
 * for all components. Coarse matrices are P^T A P without rows and columns that
 * are held on the finest mesh, and nothing else: where the set has changed, the
 * rows of the coarse matrices nearby are computed again. (With coarse matrices
 * that ignore the set it takes 34 to 189 iterations instead of 8 to 11.)
 *
 *     abut_multigrid_create(context, &hierarchy, &mg);
 *     abut_multigrid_set_matrix(mg, &matrix);
 *     abut_multigrid_set_terms(mg, &terms);   // if something is eliminated
 *     abut_multigrid_set_constrained(mg, held, NULL);  // if the set changed
 *     abut_multigrid_cycle(mg, r, x);         // x is about A^-1 r
 *
 * A cycle is one V-cycle in single precision, with a Chebyshev smoother of
 * degree 2 before and after the coarse level; of fields with one unknown at a
 * node, without terms and on one rank, one sweep of Gauss and Seidel; as an
 * operator it is symmetric and positive definite on what is free, and 0 on what
 * is held.
 *
 * Several ranks can share a hierarchy. Each has the nodes that it owns and
 * copies of some others, and sums up its own part of all matrices: those of all
 * ranks together are the matrix. The core does not know which copies belong
 * together; two functions of the host do (abut_multigrid_ranks). Then
 * abut_multigrid_set_constrained() and cycle() are collective, and so is
 * failure. */

#include <abut/strategy.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Opaque hierarchy. */
  typedef struct abut_multigrid abut_multigrid;

  /** A mesh. Arrays are the caller's and are copied. */
  typedef struct abut_multigrid_mesh
  {
    int32_t n_nodes; /**< >= 0 */
    /** [n_nodes * block] nonzero for unknowns that never take part:
     * prescribed values, components of hanging nodes. NULL: none. */
    const uint8_t *fixed;
    /** [n_nodes + 1] the weights of node i of this mesh over nodes of the next
     * coarser one begin at start[i] and end before start[i + 1]; NULL on the
     * coarsest. */
    const int64_t *start;
    const int32_t *parent; /**< nodes of the next coarser mesh */
    const double *weight;  /**< of these */
  } abut_multigrid_mesh;

  /** Data of the other ranks that a rank needs. */
  typedef struct abut_multigrid_ranks
  {
    /** [n_meshes] The nodes first_own[l] to first_own[l] + n_own[l] - 1 of mesh
     * l are this rank's. The others are copies of nodes of other ranks: all
     * that matrix and terms have columns for, and all their parents; of the
     * coarsest mesh all nodes, in the same order on all ranks. */
    const int32_t *first_own;
    const int32_t *n_own; /**< [n_meshes] see first_own */
    /** Replace values [nodes of the mesh * n_values] by the sums of all copies
     * of each node, to the last bit the same for each. */
    void (*add_copies)(void *user, int32_t mesh, int32_t n_values,
                       float *values);
    /** Sums (or maximum) over ranks of n values in place. */
    void (*reduce)(void *user, abut_reduction op, double *values, int32_t n);
    void *user; /**< handed to both */
  } abut_multigrid_ranks;

  /** Meshes from the finest to the coarsest. */
  typedef struct abut_multigrid_hierarchy
  {
    size_t struct_size;              /**< sizeof(abut_multigrid_hierarchy) */
    int32_t block;                   /**< unknowns per node, 1 to 3 */
    int32_t n_meshes;                /**< >= 1 */
    const abut_multigrid_mesh *mesh; /**< [n_meshes] */
    /** [nodes of the finest mesh * block] row of the matrix, and entry of
     * vectors, of each unknown; NULL: node * block + component. Own nodes have
     * the first rows, which are all that vectors have. */
    const int32_t *unknown;
    /** NULL: there are no other ranks. The arrays are copied. */
    const abut_multigrid_ranks *ranks;
  } abut_multigrid_hierarchy;

  /** A symmetric matrix of the finest mesh in compressed rows, with symmetric
   * pattern; arrays are the caller's and are copied. */
  typedef struct abut_multigrid_matrix
  {
    size_t struct_size; /**< sizeof(abut_multigrid_matrix) */
    /** Rows: nodes of the finest mesh * block. If there are other ranks it may
     * be less, and rows from there on are empty; rows of copies may have parts
     * of what is in the row of the node. */
    int32_t n;
    const int32_t *start;  /**< [n + 1] where rows begin */
    const int32_t *column; /**< [start[n]] */
    const double *value;   /**< [start[n]] */
  } abut_multigrid_matrix;

  /** Sizes of a hierarchy and its cost. */
  typedef struct abut_multigrid_report
  {
    size_t struct_size; /**< sizeof(abut_multigrid_report) */
    int32_t n_meshes;   /**< levels */
    int32_t n_coarsest; /**< free unknowns of the coarsest level */
    int64_t n_entries;  /**< numbers in the matrices of all levels */
    int64_t n_renewed;  /**< coarse rows that the last
                           abut_multigrid_set_constrained() computed again */
    double largest[32]; /**< [n_meshes] bound of the eigenvalues of the
                             matrix scaled by its diagonal blocks */
  } abut_multigrid_report;

  /** Create a hierarchy. INVALID_ARGUMENT for parents that are no nodes of the
   * next coarser mesh, unknowns that are not a permutation, or more than 32
   * meshes. */
  ABUT_API abut_status abut_multigrid_create(
      abut_context *context, const abut_multigrid_hierarchy *hierarchy,
      abut_multigrid **multigrid);

  /** Destroy and set the handle to NULL. */
  ABUT_API abut_status abut_multigrid_destroy(abut_multigrid **multigrid);

  /** Take a matrix, or another one. Call abut_multigrid_set_constrained() next.
   * O(entries). */
  ABUT_API abut_status abut_multigrid_set_matrix(
      abut_multigrid *multigrid, const abut_multigrid_matrix *matrix);

  /** Take what is added to the matrix from the next
   * abut_multigrid_set_constrained() on, in a few of its rows, such as by
   * unknowns that are eliminated; NULL: nothing. Pattern and numbers are
   * symmetric, and the sum must be positive definite on what is free. Stays
   * when the matrix changes. O(rows + entries), and
   * abut_multigrid_set_constrained() then costs what is near these rows. */
  ABUT_API abut_status abut_multigrid_set_terms(
      abut_multigrid *multigrid, const abut_multigrid_matrix *terms);

  /** Set the unknowns that are held ([rows], nonzero; NULL: none) and the
   * values added to the diagonal ([rows], >= 0; NULL: nothing). Costs what is
   * near the rows that have changed; after a new matrix, all. UNSUPPORTED if
   * the coarsest level has too many unknowns to be factorised: 4000. */
  ABUT_API abut_status abut_multigrid_set_constrained(abut_multigrid *multigrid,
                                                      const uint8_t *held,
                                                      const double *added);

  /** One cycle: @p x = M @p r, both [own rows]; NULL where there are none. */
  ABUT_API abut_status abut_multigrid_cycle(abut_multigrid *multigrid,
                                            const double *r, double *x);

  /** Description for reports and tests. */
  ABUT_API abut_status abut_multigrid_describe_sized(
      const abut_multigrid *multigrid, abut_multigrid_report *report);

#ifdef __cplusplus
}
#endif

#endif

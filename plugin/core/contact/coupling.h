/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONTACT_COUPLING_H
#define ABUT_CONTACT_COUPLING_H

/* The inside of a coupling. A build goes over the secondary facets in the
 * order of their numbers; for each one
 *
 *   coupling_facet.c       points of integration on its covered part, with the
 *                          opposite points (coupling_segment2.c and _segment3.c
 *                          by clipping, coupling_ray.c point by point,
 *                          coupling_near.c for those that move,
 *                          coupling_obstacle.c)
 *   coupling_functions.c   its free nodes, those that keep a multiplier, and
 *                          the weighting functions psi
 *   coupling_shares.c      its shares in the rows of its nodes
 *   coupling_interpolant.c of dual mortar, the gaps at nodes instead of
 *                          weighted ones
 *   coupling_rates.c       of mortar that moves, how these shares change
 *
 * and coupling_append.c adds the shares of each node up to a point. Node to
 * segment (coupling_nodal.c) takes its weights from the functions and its
 * entries from a detection. Directions of mortar that moves, and how its forces
 * change, are coupling_direction.c's and coupling_block.c's. */

#include "geometry/surface.h"

#include <abut/coupling.h>
#include <abut/detect.h>

enum
{
  /* Largest number of free nodes that the shape functions of a facet depend
   * on; by hanging nodes they can be others than its own. */
  ABUT_COUPLING_MAX_FREE = 32
};

/* A point of integration. Third components are zero in 2D. */
typedef struct abut_coupling_point
{
  double local[2];                    /* on the secondary facet */
  double weight;                      /* area, times 2 pi r if axisymmetric */
  double position[3];                 /* x_s */
  double gap[3];                      /* x_m - x_s; obstacle: zero */
  double distance;                    /* obstacle: phi; points that move: the
                                         gap; else zero */
  double normal[3];                   /* of the secondary facet; obstacle:
                                         - grad phi; points that move: minus the
                                         derivative of the gap */
  int64_t hessian;                    /* points that move: its place */
  int64_t rate;                       /* mortar that moves: place of how
                                         `opposite` changes */
  int32_t primary;                    /* facet; obstacle: -1 */
  int32_t number;                     /* within the facet */
  double shape[ABUT_FACET_MAX_NODES]; /* of the secondary */
  double opposite[ABUT_FACET_MAX_NODES]; /* shape functions N there */
} abut_coupling_point;

/* The current secondary facet. */
typedef struct abut_coupling_facet
{
  int32_t index;
  abut_facet_kind kind;
  int32_t n;                                    /* nodes */
  double x[3 * ABUT_FACET_MAX_NODES];           /* [n * dimension] */
  double reference[3 * ABUT_FACET_MAX_NODES];   /* where weights are measured */
  double normal[3];                             /* mean */
  double node_normal[3 * ABUT_FACET_MAX_NODES]; /* [3 * n] averaged; at a
                                                   feature the facet's own */
  uint32_t own_normals; /* bits of the nodes that have that */
  double size;          /* longest side */
  double warping;       /* radian */
} abut_coupling_facet;

/* The functions of one facet. base_a are the shape functions or, for
 * multipliers of degree 1, the linear functions of the corners. */
typedef struct abut_coupling_functions
{
  int32_t n; /* free nodes */
  int32_t node[ABUT_COUPLING_MAX_FREE];
  bool dropped[ABUT_COUPLING_MAX_FREE];
  /* phi_l of free node l = sum_a phi[l][a] (shape function a) */
  double phi[ABUT_COUPLING_MAX_FREE][ABUT_FACET_MAX_NODES];
  int32_t n_base;
  int32_t n_kept;
  int32_t kept[ABUT_COUPLING_MAX_FREE]; /* which of the free nodes */
  /* chi_j = sum_a chi[j][a] base_a: with the shares of dropped nodes */
  double chi[ABUT_COUPLING_MAX_FREE][ABUT_FACET_MAX_NODES];
  double psi[ABUT_COUPLING_MAX_FREE][ABUT_FACET_MAX_NODES]; /* likewise */
  bool diagonal; /* D between kept nodes is diagonal */
  bool lumped;   /* ... because it was lumped */
} abut_coupling_functions;

/* Share of a facet in the row of a node (or a whole row of a quadrature
 * point); its entries follow those of the share before. */
typedef struct abut_coupling_share
{
  int32_t node;    /* -1: quadrature point */
  int32_t facet;   /* secondary; node to segment: primary */
  int32_t primary; /* facet of points that move; -1: none */
  int32_t point;
  int32_t n_secondary, n_primary;
  int64_t first; /* entry: secondary ones, then primary ones */
  double weight; /* integral of psi */
  double gap[3]; /* integral of psi (x_m - x_s) */
  double distance;
  double least;        /* mortar against a surface: least gap at the points of
                          its facet along the facet's normal */
  double offset[3];    /* dual mortar: integral of psi (I - 1) (x_m - x_s), with
                          the interpolant I of the gaps at nodes */
  double normal[3];    /* integral of psi n */
  double position[3];  /* quadrature point: where it is */
  int64_t hessian;     /* of points that move: place in that array */
  int64_t first_block; /* of mortar that moves */
  int32_t n_blocks;
} abut_coupling_share;

/* How the entries of a share at the nodes of one primary facet change: rows
 * are these nodes, columns the unknowns of abut_coupling_columns(). */
typedef struct abut_coupling_block
{
  int64_t first; /* in block_values */
  int32_t facet; /* secondary */
  int32_t primary;
  uint32_t own_normals; /* as of abut_coupling_facet */
  uint32_t unused;
} abut_coupling_block;

/* A unit normal at a node of the secondary with its derivatives by places of
 * nodes, 9 numbers each: component by component. */
typedef struct abut_coupling_direction
{
  double normal[3];
  int64_t first; /* in direction_node, and in direction_change / 9 */
  int32_t n;     /* nodes; -1: not known yet */
  int32_t unused;
} abut_coupling_direction;

typedef struct abut_coupling_entry
{
  double value;
  int32_t node;
  int32_t unused;
} abut_coupling_entry;

/* Purposes of looking at a secondary facet. */
enum
{
  ABUT_COUPLING_FOR_ROWS = 1,    /* it has a share in wanted rows */
  ABUT_COUPLING_FOR_DROPPING = 2 /* it decides which neighbours to drop */
};

typedef struct abut_discretisation_methods abut_discretisation_methods;

/* Orders by the caller's numbers; fixed. */
typedef struct abut_coupling_order
{
  abut_array facet;              /* int32_t, secondary facets */
  abut_array node_rank;          /* int32_t, of secondary nodes */
  abut_array node;               /* int32_t, its inverse */
  abut_array primary_facet_rank; /* int32_t */
  abut_array primary_node_rank;  /* int32_t */
  abut_array keyed;              /* abut_keyed */
} abut_coupling_order;

/* Data of the nodes and facets of this build. */
typedef struct abut_coupling_node_state
{
  const abut_coupling_nodes *given;
  const double *normal;
  abut_array hanging;          /* int32_t, [n_nodes] number h or -1 */
  abut_array dropped_as_given; /* uint8_t, [n_nodes] dropped as given */
  abut_array dropped;          /* uint8_t, [n_nodes] and weak nodes */
  abut_array purpose;          /* uint8_t, [n_facets] */
  abut_array full;        /* double, [n_nodes] integral of chi, whole facets */
  abut_array covered;     /* double, [n_nodes] integral of chi, covered part */
  abut_array hat;         /* double, [n_nodes] integral of hats, whole facets */
  abut_array covered_hat; /* double, [n_nodes] the same, covered part */
  abut_array reach;       /* double, [n_nodes] obstacles */
  abut_array lone;        /* uint8_t, [n_nodes] they alone face the obstacle */
  abut_array corner;      /* uint8_t, [n_nodes] 1: at a feature, 2: and kept */
  abut_array bend;        /* double, [3 n_nodes] integral of hat n, covered */
  bool drops;             /* nodes are looked for to be dropped */
  abut_array flag;        /* uint8_t, [n_nodes] */
} abut_coupling_node_state;

/* Data of the current facet. */
typedef struct abut_coupling_work
{
  abut_array candidates; /* int32_t, primary facets in order */
  abut_array segments;   /* of coupling_segment2.c or _segment3.c */
  abut_array points;     /* abut_coupling_point */
  abut_array values;     /* double, psi times weight at the points */
  int32_t n_points;
} abut_coupling_work;

/* Obstacles: points requested, in the order in which the answers are taken. */
typedef struct abut_coupling_answers
{
  abut_array asked;        /* double */
  abut_array distance;     /* double */
  abut_array gradient;     /* double */
  abut_array hessian;      /* double, of points that move, one after the
                                    other, obstacles: [n_asked * dimension^2] */
  abut_array asked_normal; /* double, [n_asked * dimension] of the surface */
  abut_array asked_size;   /* double, [n_asked] of its facets */
  abut_array walkers;      /* of coupling_far_side.c */
  abut_array walk;         /* of coupling_far_side.c */
  int64_t n_asked;
  int64_t n_answered;
  int64_t n_hessian; /* numbers in the Hessians against surfaces */
} abut_coupling_answers;

/* Derivatives of mortar rows. */
typedef struct abut_coupling_changes
{
  abut_array rates;            /* double, of the current points */
  abut_array blocks;           /* abut_coupling_block */
  abut_array block_values;     /* double */
  abut_array directions;       /* abut_coupling_direction, [n_nodes] averaged */
  abut_array direction_node;   /* int32_t */
  abut_array direction_change; /* double */
  abut_array line_place;       /* int32_t, [n_nodes of both sides] */
  abut_array column_place;     /* int32_t, [n_nodes of both sides] */
  int64_t n_rates;
  int64_t n_blocks;
  int64_t n_block_values;
  int64_t n_directions;
} abut_coupling_changes;

/* Shares of facets, and their sums by row. */
typedef struct abut_coupling_sums
{
  abut_array shares;  /* abut_coupling_share */
  abut_array entries; /* abut_coupling_entry */
  int64_t n_shares;
  int64_t n_entries;
  abut_array share_start; /* int64_t, [n_nodes + 1] */
  abut_array share_list;  /* int64_t */
  abut_array of_node[2];  /* double, [nodes of the side] */
  abut_array seen[2];     /* uint8_t, [nodes of the side] */
  abut_array touched;     /* int32_t */
} abut_coupling_sums;

/* The points of this build. */
typedef struct abut_coupling_made
{
  abut_array node;                /* int32_t */
  abut_array facet;               /* int32_t */
  abut_array number;              /* int32_t */
  abut_array full;                /* double */
  abut_array position;            /* double */
  abut_array least;               /* double */
  abut_array primary;             /* int32_t */
  abut_array hessian_start;       /* int64_t */
  abut_array hessian;             /* double */
  abut_array line_start;          /* int64_t */
  abut_array column_start;        /* int64_t */
  abut_array line;                /* int32_t */
  abut_array column;              /* int32_t */
  abut_array stencil_node;        /* int32_t, of one point */
  abut_array stencil_coefficient; /* double */
} abut_coupling_made;

struct abut_coupling
{
  abut_context *context;
  abut_surface *secondary;
  abut_surface *primary;   /* or NULL */
  abut_obstacle *obstacle; /* or NULL */
  abut_coupling_options options;
  const abut_discretisation_methods *method;
  bool compare_nodes; /* node numbers of both surfaces mean the same nodes */
  bool quadratic;     /* some secondary facet is */
  abut_search *search;
  abut_pairs *pairs;
  abut_pairs_view pairs_view;
  abut_detection *detection; /* node to segment */
  double reach;              /* absolute part, of this build */
  /* The last search and its input, if there was one. */
  bool has_searched;
  double searched_motion;
  uint64_t searched_revision[2];          /* of the secondary and the primary */
  const abut_coupling_target *target;     /* of this build */
  const abut_kinematics_info *kinematics; /* of the target */
  abut_coupling_order order;
  abut_coupling_node_state of_node;
  abut_coupling_work work;
  abut_coupling_answers answer;
  abut_coupling_changes change;
  abut_coupling_sums sum;
  abut_coupling_made made;
  abut_coupling_view view;
  abut_coupling_statistics statistics;
};

/* Whether the rows are weighted means over facets. */
bool abut_coupling_is_mortar(const abut_coupling *c);

/* Whether the points of this build are at the nearest point, or a distance, in
 * the current configuration. */
static inline bool
abut_coupling_moves(const abut_coupling *c)
{
  return c->kinematics->points == ABUT_CONFIGURATION_CURRENT
         && !abut_coupling_is_mortar(c);
}

/* Whether those of mortar meet what is opposite there. */
static inline bool
abut_coupling_follows(const abut_coupling *c)
{
  return c->kinematics->points == ABUT_CONFIGURATION_CURRENT
         && abut_coupling_is_mortar(c);
}

/* Whether rows of mortar have derivatives. */
static inline bool
abut_coupling_has_current_directions(const abut_coupling *c)
{
  return c->kinematics->directions == ABUT_CONFIGURATION_CURRENT
         && abut_coupling_is_mortar(c);
}

/* Where the nodes of a side (0: secondary) are. */
static inline const double *
abut_coupling_place(const abut_coupling *c, int side)
{
  const abut_coupling_target *t = c->target;
  if (t->current != NULL)
    return side == 0 ? t->current : t->current_primary;
  return side == 0 ? c->secondary->view.position : c->primary->view.position;
}

/* Gather facet f at the current positions. */
void abut_coupling_load(const abut_coupling *c, int32_t f,
                        abut_coupling_facet *facet);

/* Unit normal at a node of a facet, or at one that hanging nodes of it hang
 * on: averaged, at a feature the facet's own. */
void abut_coupling_node_normal(const abut_coupling *c,
                               const abut_coupling_facet *facet, int32_t node,
                               double *normal);

/* Area where weights are measured by that of the facet as it is, at @p local
 * of it; for rules over parts of the present facet. */
double abut_coupling_area_ratio(const abut_coupling *c,
                                const abut_coupling_facet *facet,
                                const double *local);

/* Degree of the rule for the common parts of facets of two kinds, for products
 * of their shape functions or for those of the secondary alone. */
int abut_coupling_degree(const abut_coupling *c, abut_facet_kind secondary,
                         abut_facet_kind primary, bool products);

/* Rule of the whole facet: points, with weights and shape functions of the
 * secondary only, in c->work.points. */
abut_status abut_coupling_whole(abut_coupling *c,
                                const abut_coupling_facet *facet);

/* Points on the covered part, in the order of the primary facets' numbers, in
 * c->work.points; final: for the rows, with statistics, not only for the
 * covered part of the secondary's functions. */
abut_status abut_coupling_make_points(abut_coupling *c,
                                      const abut_coupling_facet *facet,
                                      bool final);

/* The ways of abut_coupling_make_points(); all but the last find the opposite
 * points on the candidates. */
abut_status abut_coupling_segments2(abut_coupling *c,
                                    const abut_coupling_facet *facet,
                                    bool final);
abut_status abut_coupling_segments3(abut_coupling *c,
                                    const abut_coupling_facet *facet,
                                    bool final);
abut_status abut_coupling_rays(abut_coupling *c,
                               const abut_coupling_facet *facet, bool final);
abut_status abut_coupling_face_obstacle(abut_coupling *c,
                                        const abut_coupling_facet *facet,
                                        bool final);

/* Points of a rule over the whole facet against the nearest points of the
 * candidates: those that move. */
abut_status abut_coupling_near(abut_coupling *c,
                               const abut_coupling_facet *facet, bool final);

/* The opposite point, on a primary facet, of a point that moves. */
typedef struct abut_coupling_opposite
{
  double shape[ABUT_FACET_MAX_NODES]; /* at the nearest point */
  double gap;
  double normal[3]; /* minus the derivative of the gap by the point */
  int64_t hessian;  /* its place; [(dimension (1 + n_nodes))^2] */
} abut_coupling_opposite;

/* Find it; *found: there is one. */
abut_status abut_coupling_follow(abut_coupling *c, int32_t primary,
                                 const double *x, bool *found,
                                 abut_coupling_opposite *opposite);

/* The vector [3] of unit length that tangents are made of in space: of the
 * point of a share, or sum of shares, with a unit normal. Returns the facet of
 * the secondary that it rotates with; -1: it is an axis. */
int32_t abut_coupling_auxiliary_vector(const abut_coupling *c,
                                       const abut_coupling_share *share,
                                       const double *normal, double *auxiliary);

/* How such a facet turns the tangents of a unit normal about that, radian, by
 * the places of its corners: node[n], rotation[n][3]. Returns n. */
int abut_coupling_tangent_rotation(const abut_coupling *c, int32_t facet,
                                   const double *normal, const int32_t **node,
                                   double (*rotation)[3]);

/* The tangents of a unit normal; see abut_coupling_target. */
void abut_coupling_tangents(int32_t dim, const double *normal,
                            const double *auxiliary, double *tangents);

/* Derivatives of the rows of the tangents of a point that moves, from its unit
 * normal: n unknowns, shape functions of its n / dim - 1 primary nodes, Hessian
 * [n^2] of the gap; turning [(dim - 1) n^2]. The auxiliary vector counts as
 * constant. */
void abut_coupling_tangent_derivatives(int32_t dim, int32_t n,
                                       const double *normal,
                                       const double *auxiliary,
                                       const double *shape,
                                       const double *hessian, double *turning);

/* The same of a point of mortar with a unit normal: of its matrix by the normal
 * [dim n_lines][n_columns], minus the derivatives of n c_l, that by its
 * tangents [dim - 1], of t c_l. The auxiliary vector counts as constant. */
void abut_coupling_tangent_derivatives_of_lines(
    int32_t dim, int32_t n_lines, int64_t n_columns, const double *normal,
    const double *auxiliary, const double *block, double *turning);

struct abut_linear_patch;

/* Columns of a block: components of the places of the nodes of the secondary
 * facet, of those of the primary one, and (2D) of the normals at the nodes of
 * the secondary one. */
static inline int32_t
abut_coupling_columns(const abut_coupling *c, int32_t n_secondary,
                      int32_t n_primary)
{
  const int32_t dim = c->view.dimension;
  return dim * ((dim == 2 ? 2 : 1) * n_secondary + n_primary);
}

/* How the opposite point of a point of integration changes while that stays on
 * its facet: of the secondary's and the primary's current parts at their
 * parameters s and t, and in space from patch s to m along the normal of a
 * patch of the facet. Sets the point's rate. */
abut_status abut_coupling_rate2(abut_coupling *c,
                                const abut_coupling_facet *facet, int part,
                                double s, int primary_part, double t,
                                abut_coupling_point *point);
abut_status abut_coupling_rate3(abut_coupling *c,
                                const abut_coupling_facet *facet,
                                const struct abut_linear_patch *plane,
                                const struct abut_linear_patch *s,
                                const struct abut_linear_patch *m,
                                const double *opposite,
                                abut_coupling_point *point);

/* Add the blocks of a share, with the values of its weighting function. */
abut_status abut_coupling_add_blocks(abut_coupling *c,
                                     const abut_coupling_facet *facet,
                                     abut_coupling_share *share);

/* The averaged normal of a node of the secondary where it is. */
abut_status abut_coupling_average(abut_coupling *c, int32_t node,
                                  abut_coupling_direction *direction);

/* The normal of a facet where it is, at its node a or (a < 0) in the mean, with
 * the derivatives by its nodes in direction_node. */
abut_status abut_coupling_facet_direction(abut_coupling *c, int32_t facet,
                                          int a,
                                          abut_coupling_direction *direction);

/* The direction of the point of the shares list[n] with sum total: as the
 * normal of one that is fixed, but where the surfaces are. */
abut_status abut_coupling_direct(abut_coupling *c, const int64_t *list,
                                 int64_t n, const abut_coupling_share *total,
                                 abut_coupling_direction *direction);

/* int psi (x_m - x_s) / W in the current configuration (present), or in that of
 * the build. */
void abut_coupling_gap(const abut_coupling *c, const int64_t *list, int64_t n,
                       bool present, double *gap);

/* Note how the force of the next point changes; see abut_coupling_view. */
abut_status
abut_coupling_record_block(abut_coupling *c, const int64_t *list, int64_t n,
                           const abut_coupling_share *total,
                           const abut_coupling_direction *direction);

/* Number that a node of a side has in the set of points. */
static inline int32_t
abut_coupling_number(const abut_coupling *c, int side, int32_t node)
{
  const abut_coupling_target *t = c->target;
  const int32_t *given = side == 0 ? t->secondary_node : t->primary_node;
  return given != NULL ? given[node]
         : side == 0   ? node
                       : c->secondary->view.n_nodes + node;
}

/* Number the points of the segments of a facet, and take their opposite points
 * along the facet's normal. */
void abut_coupling_find_opposites(abut_coupling *c,
                                  const abut_coupling_facet *facet);

/* Whether the line from x along a unit normal meets one of the candidates;
 * gap [3]: from there to the nearest of them. */
bool abut_coupling_intersect_line(const abut_coupling *c, const double *x,
                                  const double *normal, int32_t n_candidates,
                                  double *gap);

/* Whether the gaps of the build are those of the interpolants at nodes. */
bool abut_coupling_interpolates(const abut_coupling *c);

/* Gaps at the free nodes of the current facet. */
typedef struct abut_coupling_node_gaps
{
  bool found[ABUT_COUPLING_MAX_FREE];
  double gap[ABUT_COUPLING_MAX_FREE][3]; /* against an obstacle: {distance} */
} abut_coupling_node_gaps;

/* Find them. */
abut_status abut_coupling_find_node_gaps(abut_coupling *c,
                                         const abut_coupling_facet *facet,
                                         const abut_coupling_functions *f,
                                         abut_coupling_node_gaps *gaps);

/* Give a share, the last one, with values of its function at the current
 * points, the gaps at nodes. */
void abut_coupling_interpolate(const abut_coupling *c,
                               const abut_coupling_facet *facet,
                               const abut_coupling_functions *f,
                               const abut_coupling_node_gaps *gaps,
                               abut_coupling_share *share);

/* Candidates of a facet: the *n primary facets within reach of its box that
 * share no node with it, in c->work.candidates. */
abut_status abut_coupling_find_candidates(abut_coupling *c, int32_t facet,
                                          int32_t *n);

/* Whether a gap is within the reach of a primary facet of this size, and not
 * too deep. */
bool abut_coupling_in_reach(const abut_coupling *c, double gap, double size);

/* Make room for one more point; NULL without memory. */
abut_coupling_point *abut_coupling_new_point(abut_coupling *c);

/* Complete a point of which local, shape, weight without 2 pi r, primary and
 * opposite are set. */
void abut_coupling_finish_point(const abut_coupling *c,
                                const abut_coupling_facet *facet,
                                abut_coupling_point *point);

/* Shape functions of a facet at local coordinates; tangents [2][3] or NULL. */
void abut_coupling_shape(abut_facet_kind kind, const double *nodes,
                         const double *local, double *shape,
                         double (*tangents)[3]);

/* Unit normal of a facet at local coordinates; third component 0 in 2D. */
void abut_coupling_normal(abut_facet_kind kind, const double *nodes,
                          const double *local, double *normal);

/* Free nodes and the functions phi and chi of a facet, without multipliers at
 * dropped nodes. UNSUPPORTED if they are
 * more than ABUT_COUPLING_MAX_FREE. */
abut_status abut_coupling_make_functions(abut_coupling *c,
                                         const abut_coupling_facet *facet,
                                         const uint8_t *dropped,
                                         abut_coupling_functions *functions);

/* Weighting functions psi from the points of the covered part; whole: area of
 * the whole facet by the same measure. */
void abut_coupling_make_psi(abut_coupling *c, const abut_coupling_facet *facet,
                            double whole, abut_coupling_functions *functions);

/* The base functions at a point. */
void abut_coupling_base(const abut_coupling *c, abut_facet_kind kind,
                        const abut_coupling_point *point, double *base);

/* Append an empty share (NULL without memory), or an entry to the last one,
 * counted in *count. */
abut_coupling_share *abut_coupling_new_share(abut_coupling *c);
abut_status abut_coupling_new_entry(abut_coupling *c, int32_t *count,
                                    int32_t node, double value);

/* Append the shares of a facet in the rows of its nodes, or its rows of
 * quadrature points. */
abut_status abut_coupling_add_shares(abut_coupling *c,
                                     const abut_coupling_facet *facet,
                                     const abut_coupling_functions *functions);
abut_status abut_coupling_add_points(abut_coupling *c,
                                     const abut_coupling_facet *facet,
                                     const abut_coupling_functions *functions);

/* Ask for the distances of all points of the build; then the share of a node.
 */
abut_status abut_coupling_measure_obstacle(abut_coupling *c);

/* Correct the answers of points behind the middle of a thin obstacle. */
abut_status abut_coupling_leave_far_side(abut_coupling *c);
abut_status abut_coupling_add_node_obstacle(abut_coupling *c, int32_t node);

/* Create a coupling with a surface or with an obstacle, the other is NULL. */
abut_status abut_coupling_create_any(abut_context *context, const char *call,
                                     abut_surface *secondary,
                                     abut_surface *primary,
                                     abut_obstacle *obstacle,
                                     const abut_coupling_options *options,
                                     abut_coupling **coupling);

/* Add a small weight of nodes on the axis, which quadratic facets do not give
 * them, to the sums of the nodes. */
void abut_coupling_add_axis(const abut_coupling *c,
                            const abut_coupling_facet *facet, double *sum);

/* Shares of node to segment: the entries of nodes against the contact elements
 * of the detection, or against the obstacle. */
abut_status abut_coupling_add_nodal(abut_coupling *c);

/* Mark corners in c->of_node.corner; returns whether there are any. */
bool abut_coupling_find_corners(abut_coupling *c);

/* Drop weak nodes, and corners that are covered on both sides. */
abut_status abut_coupling_drop(abut_coupling *c);

/* Add the shares up to points. */
abut_status abut_coupling_append(abut_coupling *c);

/* Check and spread what is known of the nodes. */
abut_status abut_coupling_read_nodes(abut_coupling *c);

/* Decide which facets to look at. */
void abut_coupling_set_purpose(abut_coupling *c);

/* Whether weak nodes are looked for: quadratic weighting functions, against
 * obstacles, which cover all, around an axis alone. */
bool abut_coupling_has_weak(const abut_coupling *c);

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_FAILURE_H
#define ABUT_FAILURE_H

/** @file
 * The known ways in which contact computations fail, each with a code that
 * never changes its meaning. Warnings and errors that name one begin with the
 * code, `ABUT-F06: ...`, followed by what was seen and what to do. Programs
 * name their own parameters beside the remedy that stands here.
 */

#include <abut/export.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

/** One list yields the enumeration and the table: name in the program, number
 * of the code, name for people, remedy in general. Numbers are never used
 * again for something else; gaps belong to failures that cannot occur yet. */
#define ABUT_FAILURE_LIST(X)                                                   \
  X(BOTH_SIDES, 1, "multipliers on both sides",                                \
    "let one side of a pair of surfaces carry the constraints")                \
  X(RICH_MULTIPLIERS, 2, "more multipliers than the surface has unknowns",     \
    "mortar or dual mortar; or penalty, augmented lagrangian or nitsche")      \
  X(TRANSFER, 3, "uniform pressure is not transferred",                        \
    "mortar or dual mortar")                                                   \
  X(CROSSPOINT, 4, "contact meets a support",                                  \
    "hand the share of dropped multipliers to their neighbours")               \
  X(COVERAGE, 5, "surface partly uncovered",                                   \
    "make the primary surface as large as the secondary")                      \
  X(PENALTY, 6, "penalty out of range",                                        \
    "leave the penalty to the law, or use augmented lagrangian or lagrange")   \
  X(MULTIPLIERS_STALL, 7, "method of multipliers does not converge",           \
    "let the penalty adapt itself, or begin with a larger one")                \
  X(CYCLE, 8, "active sets come back",                                         \
    "fallback to single changes, or interior point")                           \
  X(COLD_START, 9, "too many active set iterations from a cold start",         \
    "start from the solution on a coarser mesh")                               \
  X(INFEASIBLE_START, 10, "barrier with initial penetration",                  \
    "interior point, which needs no feasible start")                           \
  X(OVERLAP, 11, "bodies overlap from the start",                              \
    "move the bodies apart, or give the interference as an initial gap")       \
  X(FLOATING_BODY, 12, "a body without supports",                              \
    "give the body a support, or press it against another body")               \
  X(LOCKING, 16, "elements that are too stiff", "quadratic elements")          \
  X(COARSE_SECONDARY, 19, "secondary surface much coarser than the primary",   \
    "exchange the two sides of the pair")                                      \
  X(DEGENERATE_FACET, 20, "facets without area, or inside out",                \
    "repair the mesh: each facet once, with distinct corners")                 \
  X(COARSE_CURVE, 21, "surface too coarse for its curvature",                  \
    "refine it, or leave its corners out of the pair")                         \
  X(BUCKETS, 22, "bucket size far from the size of facets",                    \
    "Bucket size = auto, or adaptive buckets")                                 \
  X(WRONG_SIDE, 23, "surfaces that face in the same direction",                \
    "use the sides that face each other; repair inverted cells")               \
  X(NO_PARTNER, 24, "surfaces are not paired",                                 \
    "a larger Reach of the pair, or smaller load steps")                       \
  X(HELD_NODES, 26,                                                            \
    "prescribed displacements of nodes that contact must move",                \
    "leave such nodes free along the normal, or change the prescribed "        \
    "displacement")                                                            \
  X(LINEAR_SOLVER, 30, "linear solver does not converge", "a direct solver")   \
  X(NITSCHE, 31, "Nitsche's parameter too small",                              \
    "leave the penalty to the law, or use the variant with theta = -1")        \
  X(NEGATIVE_WEIGHTS, 32, "dual multipliers of negative weight", "mortar")     \
  X(INTERIOR, 33, "interior method stalls",                                    \
    "lagrange, or a looser tolerance of the gap")                              \
  X(SINGULAR, 34, "energy converges slowly", "adaptive meshes; smooth data")   \
  X(LARGE_STRAIN, 35, "strains that are not small",                            \
    "check the units of loads and stiffness; smaller loads")                   \
  X(SLIDING, 36, "surfaces slide too far for small sliding",                   \
    "Contact geometry = current, or smaller motions")                          \
  X(UNSEEN, 37, "obstacle passes between the nodes",                           \
    "refine the mesh where the obstacle is")                                   \
  X(UNBALANCED, 38, "forces are not in balance",                               \
    "check the sign of the residual: internal minus external forces")          \
  X(NOT_FINITE, 39, "a number is infinite or none",                            \
    "check loads, supports and materials for values that are not finite")      \
  X(STEP_LIMIT, 40, "limit of steps",                                          \
    "allow more steps, start closer to the solution, or another method")       \
  X(STICK_SLIP, 41, "no state of stick and slip found",                        \
    "smaller load steps, or a smaller coefficient of friction")                \
  X(FREE_SLIDING, 42, "a body supported by friction slides",                   \
    "give the body a support, or less load along the surface")                 \
  X(ENERGY_GAIN, 43, "a time scheme gains energy",                             \
    "modified mass with hht, or contact stabilised; smaller time steps")       \
  X(BLOW_UP, 44, "a motion blows up",                                          \
    "time steps below the limit of the scheme, or an implicit scheme")         \
  X(ENERGY_LOSS, 45, "a time scheme loses energy",                             \
    "shorter time steps; a scheme that damps less")                            \
  X(NEWTON, 46, "Newton's method does not converge",                           \
    "smaller load steps; a tangent that is the derivative of the residual")    \
  X(PARTNERS, 47, "loaded points lose their facets or jump to others",         \
    "mortar; rounded ends; smaller load steps")                                \
  X(FEW_POINTS, 48, "few points in contact",                                   \
    "a finer mesh where the surfaces touch")                                   \
  X(NARROW_LOAD, 49, "loads that change within facets or cells",               \
    "cells that end where the load does; a finer mesh there")                  \
  X(LATE_CONTACT, 50, "points close late in a step with friction",             \
    "smaller load steps while the contact grows")                              \
  X(OSCILLATION, 51, "pressures alternate from node to node",                  \
    "the softer body as the secondary side; dual mortar; quadratic elements")  \
  X(UNSTABLE, 52, "an equilibrium that is unstable",                           \
    "a small disturbance, or the motion")

  /** Codes of failures: ABUT_FAILURE_PENALTY is `ABUT-F06`. */
  typedef enum abut_failure
  {
    ABUT_FAILURE_NONE = 0, /**< no failure with a code */
/** @cond */
#define ABUT_FAILURE_ENTRY(name, code, t, remedy) ABUT_FAILURE_##name = code,
    ABUT_FAILURE_LIST(ABUT_FAILURE_ENTRY) /** @endcond */
#undef ABUT_FAILURE_ENTRY
  } abut_failure;

  /** An entry of the table. All texts are constant. */
  typedef struct abut_failure_entry
  {
    abut_failure failure; /**< which one */
    const char *code;     /**< `ABUT-F06` */
    const char *name;     /**< a few words */
    const char *remedy;   /**< what helps in general */
  } abut_failure_entry;

  /** Entry @p index >= 0 of the table in order of codes; NULL behind its end.
   */
  ABUT_API const abut_failure_entry *abut_failure_at(int32_t index);

  /** Entry of a failure; NULL for NONE and for numbers without a failure. */
  ABUT_API const abut_failure_entry *abut_failure_get(abut_failure failure);

#ifdef __cplusplus
}
#endif

#endif

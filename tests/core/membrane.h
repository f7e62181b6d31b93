/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_CORE_MEMBRANE_H
#define ABUT_TESTS_CORE_MEMBRANE_H

/* A membrane over an obstacle on the square (-1,1)^2 scaled by length: -Lap u =
 * -10 k/length, u = 0 on the boundary, u >= psi at the nodes, bilinear elements
 * on 2^level x 2^level cells, lumped weights, exact linear solves by a banded
 * Cholesky factorisation. With psi = stairs it is deal.II's tutorial program
 * step-41. */

#include <abut/abut.h>

typedef struct membrane
{
  int32_t cells, m; /* per side; m = cells - 1 interior nodes per side */
  int32_t n;        /* unknowns = rows = m^2 */
  double h, k;      /* cell size; stiffness, force per length */
  double load;      /* force per area, downwards */
  double *u, *gap, *pressure, *weight, *stiffness, *psi;
  uint8_t *state;
  double *band; /* [n * (m + 2)] lower band of the matrix, then its factor */
  double *du, *work;
  uint8_t *fixed;
  /* Written by membrane_run(). */
  int32_t n_sets, set_size[64];
} membrane;

/* u = 0, p = 0. length scales the domain and the obstacle, force the load. */
membrane membrane_create(int32_t level, double length, double force);
void membrane_destroy(membrane *scene);

/* Take displacement, pressure and the set that they call for from the
 * solution of the next coarser level. */
void membrane_prolong(const membrane *coarse, membrane *fine);

/* Run from the present u and p; from the present set if use_state. Returns the
 * reason. */
abut_reason membrane_run(abut_context *context, membrane *scene,
                         const abut_strategy_options *options, bool use_state,
                         abut_progress *progress);

/* The functions that serve a strategy's requests. */
abut_host membrane_host(membrane *scene);

/* Options with the scene's scales and exact linear solves. */
abut_strategy_options membrane_options(const membrane *scene, const char *law);

/* 1/2 u'Ku - f'u, and the contact force. */
double membrane_energy(const membrane *scene);
double membrane_force(const membrane *scene);
int32_t membrane_n_active(const membrane *scene);

#endif

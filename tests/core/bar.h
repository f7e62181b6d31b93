/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_CORE_BAR_H
#define ABUT_TESTS_CORE_BAR_H

/* A bar of linear elements along x, above a wall that its first node must not
 * pass, in time: the smallest host of abut/time.h. Matrices are dense; contact
 * is one row, so that its force follows from a single division. */

#include "fixture.h"

enum
{
  BAR_MAX = 101
};

typedef struct bar
{
  int32_t n; /* nodes, at most BAR_MAX */
  double h, stiffness, density;
  double wall;    /* least displacement of node 0 */
  double penalty; /* force per length; 0: exact contact */
  double load;    /* on each unit of mass */
  bool clamped;   /* the last node does not move */
  abut_time_scheme scheme;
  double dt;
  double m[BAR_MAX * BAR_MAX], k[BAR_MAX * BAR_MAX];
  double full_mass[BAR_MAX]; /* sums of rows of the unmodified mass */
  double u[BAR_MAX], v[BAR_MAX], a[BAR_MAX];
  uint8_t massless[BAR_MAX];
  double lambda; /* contact force of the last step, that of a projection
                    included */
  double impulse, external_work;
  bool started;
  /* Factors of the stage's matrix and its answer to a unit force at node 0. */
  double factor[2][BAR_MAX * BAR_MAX], scale[2][BAR_MAX],
      unit_answer[2][BAR_MAX];
  int32_t pivot[2][BAR_MAX];
} bar;

/* Matrices at rest; the mass as the scheme wants it, or as `mass` says. */
void bar_open(bar *b, int32_t elements, double length, double stiffness,
              double density);
void bar_use(bar *b, const char *scheme, double dt, abut_time_mass mass,
             abut_mass_rule rule);
void bar_step(bar *b);
double bar_kinetic(const bar *b);
double bar_strain(const bar *b);
double bar_contact(const bar *b);

#endif

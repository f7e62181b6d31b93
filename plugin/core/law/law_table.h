/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_LAW_LAW_TABLE_H
#define ABUT_LAW_LAW_TABLE_H

/* The built-in laws of contact and of friction, one file each. */

#include <abut/friction.h>
#include <abut/law.h>

extern const abut_law abut_law_lagrange;
extern const abut_law abut_law_penalty;
extern const abut_law abut_law_quadratic_penalty;
extern const abut_law abut_law_augmented_lagrangian;
extern const abut_law abut_law_barrier;
extern const abut_law abut_law_interior_point;
extern const abut_law abut_law_nitsche;

extern const abut_friction abut_friction_coulomb;

#endif

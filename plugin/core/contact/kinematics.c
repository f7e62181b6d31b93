/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The table of kinematics. */
#include <abut/kinematics.h>

#include <stddef.h>

static const abut_kinematics_info table[ABUT_KINEMATICS_N] = {
    [ABUT_KINEMATICS_REFERENCE] = {.name = "reference",
                                   .points = ABUT_CONFIGURATION_REFERENCE,
                                   .directions = ABUT_CONFIGURATION_REFERENCE,
                                   .weighted_obstacle = true,
                                   .interior_laws = true,
                                   .stress_laws = true},
    [ABUT_KINEMATICS_COROTATIONAL] = {.name = "corotational",
                                      .points = ABUT_CONFIGURATION_REFERENCE,
                                      .directions = ABUT_CONFIGURATION_CURRENT,
                                      .bodies_only = true,
                                      .stress_laws = true},
    [ABUT_KINEMATICS_UPDATED] = {.name = "updated",
                                 .points = ABUT_CONFIGURATION_COMMITTED,
                                 .directions = ABUT_CONFIGURATION_COMMITTED,
                                 .weighted_obstacle = true,
                                 .interior_laws = true},
    [ABUT_KINEMATICS_CURRENT] = {.name = "current",
                                 .points = ABUT_CONFIGURATION_CURRENT,
                                 .directions = ABUT_CONFIGURATION_CURRENT}};

const abut_kinematics_info *
abut_kinematics_get(abut_kinematics kinematics)
{
  const int i = (int)kinematics;
  return i >= 0 && i < ABUT_KINEMATICS_N ? &table[i] : NULL;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Augmented Lagrangian: p = pbar - eps g where closed (method of multipliers,
 * Hestenes 1969, Powell 1969). */
#include "law/complementarity.h"
#include "law/law_table.h"

enum
{
  TERMS = ABUT_TERM_COMPLIANCE | ABUT_TERM_REFERENCE
};

static abut_status
classify(const abut_law_points *points, uint8_t *state)
{
  return abut_complementarity_classify(points, TERMS, state);
}

static abut_status
linearise(const abut_law_points *points, const uint8_t *state,
          abut_law_linearisation *result)
{
  return abut_complementarity_linearise(points, TERMS, state, result);
}

const abut_law abut_law_augmented_lagrangian = {
    .struct_size = sizeof(abut_law),
    .name = "augmented lagrangian",
    .flags = 0,
    .outer = ABUT_OUTER_MULTIPLIER,
    .classify = classify,
    .linearise = linearise,
};

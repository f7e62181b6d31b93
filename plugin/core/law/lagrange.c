/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Lagrange multiplier: g = 0 where closed, p = 0 where open. */
#include "law/complementarity.h"
#include "law/law_table.h"

enum
{
  TERMS = 0
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

const abut_law abut_law_lagrange = {
    .struct_size = sizeof(abut_law),
    .name = "lagrange",
    .flags = ABUT_LAW_HARD,
    .outer = ABUT_OUTER_NONE,
    .classify = classify,
    .linearise = linearise,
};

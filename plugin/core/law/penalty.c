/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Penalty laws. p = eps <-g - e> with a fixed eps ("penalty"), or p = eps <-g>
 * with an eps that grows from outer step to outer step ("quadratic penalty",
 * the textbook's sequence of quadratic penalty functions). Nitsche's method is
 * the latter with a fixed eps and a gap that holds the body's own normal stress
 * (Chouly, Hild and Renard, Math. Comp. 84 (2015) 1089). */
#include "law/complementarity.h"
#include "law/law_table.h"

static abut_status
classify_fixed(const abut_law_points *points, uint8_t *state)
{
  return abut_complementarity_classify(
      points, ABUT_TERM_COMPLIANCE | ABUT_TERM_ALLOWED, state);
}

static abut_status
linearise_fixed(const abut_law_points *points, const uint8_t *state,
                abut_law_linearisation *result)
{
  return abut_complementarity_linearise(
      points, ABUT_TERM_COMPLIANCE | ABUT_TERM_ALLOWED, state, result);
}

static abut_status
classify_plain(const abut_law_points *points, uint8_t *state)
{
  return abut_complementarity_classify(points, ABUT_TERM_COMPLIANCE, state);
}

static abut_status
linearise_plain(const abut_law_points *points, const uint8_t *state,
                abut_law_linearisation *result)
{
  return abut_complementarity_linearise(points, ABUT_TERM_COMPLIANCE, state,
                                        result);
}

const abut_law abut_law_penalty = {
    .struct_size = sizeof(abut_law),
    .name = "penalty",
    .flags = 0,
    .outer = ABUT_OUTER_NONE,
    .classify = classify_fixed,
    .linearise = linearise_fixed,
};

const abut_law abut_law_quadratic_penalty = {
    .struct_size = sizeof(abut_law),
    .name = "quadratic penalty",
    .flags = 0,
    .outer = ABUT_OUTER_PENALTY,
    .classify = classify_plain,
    .linearise = linearise_plain,
};

const abut_law abut_law_nitsche = {
    .struct_size = sizeof(abut_law),
    .name = "nitsche",
    .flags = ABUT_LAW_STRESS,
    .outer = ABUT_OUTER_NONE,
    .classify = classify_plain,
    .linearise = linearise_plain,
};

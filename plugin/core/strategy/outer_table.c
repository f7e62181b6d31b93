/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "strategy/outer_table.h"
#include "strategy/active_set.h"
#include "strategy/interior.h"

#include <stddef.h>

static const abut_outer_entry table[] = {
    [ABUT_OUTER_NONE] = {&abut_method_active_set, NULL, 0},
    [ABUT_OUTER_PENALTY] = {&abut_method_active_set, abut_penalty_settled, 1},
    [ABUT_OUTER_MULTIPLIER] = {&abut_method_active_set, abut_multiplier_settled,
                               20},
    [ABUT_OUTER_BARRIER] = {&abut_method_barrier, NULL, 0},
    [ABUT_OUTER_PRIMAL_DUAL] = {&abut_method_interior_point, NULL, 0}};

const abut_outer_entry *
abut_outer_get(abut_outer outer)
{
  const int i = (int)outer;
  return i >= 0 && i < (int)(sizeof(table) / sizeof(table[0])) ? &table[i]
                                                               : NULL;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "law/law_table.h"

#include <string.h>

static const abut_law *const table[] = {
    &abut_law_lagrange,          &abut_law_penalty,
    &abut_law_quadratic_penalty, &abut_law_augmented_lagrangian,
    &abut_law_barrier,           &abut_law_interior_point,
    &abut_law_nitsche,
};

/* The first is the default. */
static const abut_friction *const friction_table[] = {
    &abut_friction_coulomb,
};

enum
{
  N_LAWS = (int)(sizeof(table) / sizeof(table[0])),
  N_FRICTION_LAWS = (int)(sizeof(friction_table) / sizeof(friction_table[0]))
};

const abut_law *
abut_law_get(int32_t i)
{
  return i >= 0 && i < N_LAWS ? table[i] : NULL;
}

const abut_law *
abut_law_find(const char *name)
{
  if (name == NULL)
    return NULL;
  for (int32_t i = 0; i < N_LAWS; ++i)
    if (strcmp(table[i]->name, name) == 0)
      return table[i];
  return NULL;
}

const abut_friction *
abut_friction_get(int32_t i)
{
  return i >= 0 && i < N_FRICTION_LAWS ? friction_table[i] : NULL;
}

const abut_friction *
abut_friction_find(const char *name)
{
  for (int32_t i = 0; name != NULL && i < N_FRICTION_LAWS; ++i)
    if (strcmp(friction_table[i]->name, name) == 0)
      return friction_table[i];
  return NULL;
}

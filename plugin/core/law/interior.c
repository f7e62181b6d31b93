/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "law/interior.h"

void
abut_interior_classify(const abut_law_points *points, const double *distance,
                       uint8_t *state)
{
  for (int32_t i = 0; i < points->n; ++i)
    state[i] = points->pressure[i] > points->scale[i] * distance[i]
                   ? ABUT_STATE_CLOSED
                   : ABUT_STATE_OPEN;
}

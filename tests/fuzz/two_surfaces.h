/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_FUZZ_TWO_SURFACES_H
#define ABUT_FUZZ_TWO_SURFACES_H

#include "surfaces.h"

/* What a target does with two sound surfaces; moved: the arrays of the
 * primary. */
void run(input *in, abut_context *context, abut_surface *secondary,
         abut_surface *primary, arrays *moved);

#endif

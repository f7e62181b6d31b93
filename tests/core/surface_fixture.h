/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_CORE_SURFACE_FIXTURE_H
#define ABUT_TESTS_CORE_SURFACE_FIXTURE_H

/* What the tests of surfaces, search and detection share: one context per
 * test, and surfaces of the scenes' meshes. */

#include "scenes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
/* cmocka wants the above first. */
#include <cmocka.h>

static abut_context *context;

static inline int
set_up(void **state)
{
  (void)state;
  return abut_context_create(NULL, &context) != ABUT_SUCCESS;
}

static inline int
tear_down(void **state)
{
  (void)state;
  /* Refuses while anything is alive. */
  return abut_context_destroy(&context) != ABUT_SUCCESS;
}

static inline void
require(abut_status status)
{
  if (status != ABUT_SUCCESS)
    fail_msg("%s: %s", abut_status_text(status), abut_context_message(context));
}

/* |value - expected| <= tolerance */
static inline void
near(double value, double expected, double tolerance, const char *what)
{
  if (!(fabs(value - expected) <= tolerance))
    fail_msg("%s: %.17g is not %.17g (difference %.3g)", what, value, expected,
             value - expected);
}

#define require_near(value, expected, tolerance)                               \
  near((value), (expected), (tolerance), #value)

static inline abut_surface *
surface_of(const scene_mesh *mesh)
{
  abut_surface *s = NULL;
  const abut_surface_data data = scene_data(mesh);
  require(abut_surface_create(context, &data, &s));
  return s;
}

#endif

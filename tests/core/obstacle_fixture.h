/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_OBSTACLE_FIXTURE_H
#define ABUT_TESTS_OBSTACLE_FIXTURE_H

/* The context of the tests of obstacles. */
#include "fixture.h"

#include <string.h>

static const double pi = 3.14159265358979323846;

static abut_context *context;

static int
set_up(void **state)
{
  (void)state;
  return abut_context_create(NULL, &context) != ABUT_SUCCESS;
}

static int
tear_down(void **state)
{
  (void)state;
  return abut_context_destroy(&context) != ABUT_SUCCESS;
}

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The entry point of the targets that work on two surfaces. */
#include "two_surfaces.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Entry of the fuzzer: two surfaces, and what the target does with them. */
int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static arrays a, b;
  input in = {data, size};
  abut_context *context = NULL;
  abut_surface *secondary = NULL, *primary = NULL;
  REQUIRE(abut_context_create(NULL, &context) == ABUT_SUCCESS);
  take_arrays(&in, &a);
  take_arrays(&in, &b);
  const abut_status one = abut_surface_create(context, &a.data, &secondary),
                    two = abut_surface_create(context, &b.data, &primary);
  REQUIRE(one >= 0 && two >= 0);
  if (one == ABUT_SUCCESS && two == ABUT_SUCCESS)
    run(&in, context, secondary, primary, &b);
  if (secondary)
    REQUIRE(abut_surface_destroy(&secondary) == ABUT_SUCCESS);
  if (primary)
    REQUIRE(abut_surface_destroy(&primary) == ABUT_SUCCESS);
  REQUIRE(abut_context_destroy(&context) == ABUT_SUCCESS);
  return 0;
}

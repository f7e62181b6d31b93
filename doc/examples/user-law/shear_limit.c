/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Friction that saturates: at small pressures it is Coulomb's, at large ones
 * the softer body shears before the surfaces slide, rho(p) = k (1 - exp(-mu p /
 * k)), with the shear strength k; mu is the coefficient of the pair. Compile it
 * with cc -shared -fPIC $(pkg-config --cflags abut_core) shear_limit.c -o
 * shear_limit.so
 */
#include <abut/user_law.h>
#include <math.h>

static const char *const names[] = {"shear strength", NULL};

static const char *
check(const double *parameters)
{
  return parameters[0] > 0 ? NULL : "shear strength must be above 0";
}

/* Where nothing presses, the bound is 0, but its derivative that of a point
 * that has just closed. */
static abut_status
bound(const abut_friction_bounds *at, double *rho, double *d_rho)
{
  const double k = *(const double *)at->parameters;
  for (int32_t i = 0; i < at->n; ++i)
  {
    const double mu = at->coefficient[i], p = fmax(at->pressure[i], 0);
    rho[i] = -k * expm1(-mu * p / k);
    d_rho[i] = mu * exp(-mu * p / k);
  }
  return ABUT_SUCCESS;
}

static const abut_friction shear_limit = {.struct_size = sizeof(abut_friction),
                                          .name = "shear limit",
                                          .bound = bound};

ABUT_USER_FRICTION(shear_limit, names, check)

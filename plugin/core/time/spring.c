/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Springs of contact whose force is the difference of their energy by that of
 * the gap: Laursen and Chawla, Int. J. Numer. Meth. Engng 40 (1997), with the
 * potential of a penalty. */
#include <abut/time.h>

#include <math.h>
#include <stddef.h>

/* Both depths positive: (a + b) / 2, whatever their difference. Else one side
 * is open, and the way goes through the surface. */
abut_status
abut_time_spring(double stiffness, double before, double after, double *force,
                 double *derivative)
{
  if (!(stiffness >= 0) || !isfinite(stiffness) || !isfinite(before)
      || !isfinite(after) || force == NULL || derivative == NULL)
    return ABUT_INVALID_ARGUMENT;
  const double in = fmax(0, -before), out = fmax(0, -after);
  double mean = 0, slope = 0;
  if (in > 0 && out > 0)
  {
    mean = (in + out) / 2;
    slope = -0.5;
  }
  else if (in > 0)
  {
    const double way = in + after;
    mean = in * in / (2 * way);
    slope = -mean / way;
  }
  else if (out > 0)
  {
    const double way = before + out, part = out / way;
    mean = part * out / 2;
    slope = part * (part / 2 - 1);
  }
  *force = stiffness * mean;
  *derivative = stiffness * slope;
  return ABUT_SUCCESS;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "geometry/vector.h"

#include <abut/gap_raise.h>

#include <math.h>
#include <stdbool.h>

/* The value of a row that presses at a clearance m > 0. */
static double
more(const abut_gap_raise *r, double m, double pressure)
{
  const double a_little = 1.05, most = 30.;
  const double last = r->value - r->before;
  const double slope = r->clearance - m, fall = r->pressure - pressure;
  double step = m;
  if (last > 0. && slope > 0. && fall > 0.)
    step = max2(step,
                min2(min2(a_little * pressure / fall * last, m / slope * last),
                     most * m));
  return r->value + step;
}

/* The value of a row that is inside at a clearance m < 0. */
static double
less(const abut_gap_raise *r, double m, double gap, bool presses)
{
  const double last = r->value - r->before;
  return presses && last > 0. && r->clearance > 0.
             ? r->value + m / (r->clearance - m) * last
             : max2(0., m - (gap - r->value));
}

abut_status
abut_gap_raise_renew(const abut_raised_rows *rows, abut_gap_raise *raise,
                     int32_t *n_changed)
{
  if (rows == NULL || n_changed == NULL
      || rows->struct_size != sizeof(abut_raised_rows) || rows->n_rows < 0
      || (rows->n_rows > 0
          && (raise == NULL || rows->clearance == NULL || rows->gap == NULL
              || rows->pressure == NULL || rows->presses == NULL
              || rows->apart == NULL)))
    return ABUT_INVALID_ARGUMENT;
  *n_changed = 0;
  for (int32_t i = 0; i < rows->n_rows; ++i)
  {
    const double m = rows->clearance[i], p = rows->pressure[i];
    const bool presses = rows->presses[i] != 0;
    if (!isfinite(m))
      continue;
    const abut_gap_raise old = raise[i];
    const bool is_raised = old.value > 0.;
    const bool is_apart =
        presses && m > (is_raised ? rows->least : rows->apart[i]);
    const bool is_inside = is_raised && m < -rows->least;
    if (!is_inside && !(is_apart && rows->only_less == 0))
      continue;
    const double wanted =
        is_apart ? more(&old, m, p) : less(&old, m, rows->gap[i], presses);
    if (fabs(wanted - old.value) <= rows->least)
      continue;
    raise[i] = (abut_gap_raise){wanted, old.value, m, p};
    ++*n_changed;
  }
  return ABUT_SUCCESS;
}

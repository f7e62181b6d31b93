/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Rows of tangents: evaluation and states; see friction.h. */
#include "strategy/friction.h"
#include "strategy/strategy.h"

#include <math.h>
#include <string.h>

static const char call[] = "abut_strategy_next";

/* c of the tangents, as a multiple of that of the normals. */
static const double tangent_scale = 0.3;

/* Coefficient of friction above which a point that has just closed does not
 * slip before it has pressure: equilibrium along the surface would have mu
 * times that across it, and no accuracy of its own. */
static const double sticking = 1e5;

/* Blocks of all points: rows that belong to no point with friction are blocks
 * of one number. */
static void
count_blocks(const abut_strategy *s, int32_t *n_blocks, int64_t *numbers)
{
  const abut_friction_rows *f = &s->friction;
  *n_blocks = s->n - f->m;
  *numbers = (int64_t)s->n - f->m - f->n;
  for (int32_t i = 0; i < f->n; ++i)
  {
    const int64_t k = 1 + f->n_tangents[i];
    *numbers += k * k;
  }
}

static abut_status
place_arrays(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  const int64_t n = f->n, m = f->m, rows = s->n;
  count_blocks(s, &f->n_blocks, &f->block_numbers);
  /* One more of each: without rows on this rank a request has blocks, too. */
  abut_status status = abut_array_reserve(
      s->context, &f->numbers, 0,
      1 + 5 * n + 9 * m + 2 * (int64_t)f->blocks + 2 * f->block_numbers + rows);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &f->bytes, 0,
                                1 + f->n_blocks + 3 * n + 3 * rows);
  if (status != ABUT_SUCCESS)
    return status;
  double *next = f->numbers.data;
  double **by_point[] = {&f->pressure, &f->scale, &f->bound, &f->d_bound,
                         &f->frozen};
  for (size_t k = 0; k < sizeof(by_point) / sizeof(by_point[0]); ++k, next += n)
    *by_point[k] = next;
  double **by_tangent[] = {&f->slip,       &f->traction,   &f->reference,
                           &f->anchor,     &f->compliance, &f->residual,
                           &f->d_pressure, &f->direction,  &f->turned};
  for (size_t k = 0; k < sizeof(by_tangent) / sizeof(by_tangent[0]);
       ++k, next += m)
    *by_tangent[k] = next;
  f->d_traction = next;
  f->d_slip = f->d_traction + f->blocks;
  f->a = f->d_slip + f->blocks;
  f->b = f->a + f->block_numbers;
  f->row_excess = f->b + f->block_numbers;
  f->block_size = f->bytes.data;
  f->state = f->block_size + f->n_blocks;
  f->trial = f->state + n;
  f->shares = f->trial + n;
  f->row_state = f->shares + n;
  f->row_changes = f->row_state + rows;
  f->row_mark = f->row_changes + rows;
  return ABUT_SUCCESS;
}

/* Sizes of blocks, and marks at the rows of tangents. */
static void
mark_rows(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  int32_t block = 0, row = 0;
  for (int32_t i = 0; i <= f->n; ++i)
  {
    const int32_t end = i < f->n ? f->first[i] : s->n;
    for (; row < end; ++row)
      f->block_size[block++] = 1;
    if (i == f->n)
      break;
    f->block_size[block++] = (uint8_t)(1 + f->n_tangents[i]);
    for (int32_t k = 1; k <= f->n_tangents[i]; ++k)
    {
      s->bilateral[row + k] = ABUT_ROW_TANGENT;
      s->scale[row + k] *= tangent_scale;
    }
    row += 1 + f->n_tangents[i];
  }
}

abut_status
abut_friction_start(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  if (!abut_friction_is_on(f))
    return ABUT_SUCCESS;
  for (int32_t i = 0; i < f->n; ++i)
  {
    if (f->first[i] + f->n_tangents[i] >= s->n)
      return abut_friction_reject(s, ABUT_INVALID_ARGUMENT, i,
                                  "there are not so many rows");
    for (int32_t k = 0; k <= f->n_tangents[i]; ++k)
      if (s->bilateral[f->first[i] + k] != 0)
        return abut_friction_reject(s, ABUT_INVALID_ARGUMENT, i,
                                    "one of its rows is a tie");
  }
  for (int32_t k = 0; k < f->n_rivals; ++k)
    if (f->rival_row[k] >= s->n)
      return abut_friction_reject(s, ABUT_INVALID_ARGUMENT, f->rival_point[k],
                                  "its rival's row is beyond the last one");
  const abut_status status = place_arrays(s);
  if (status != ABUT_SUCCESS)
    return status;
  mark_rows(s);
  f->iteration = s->options.friction_iteration;
  f->rung = ABUT_RUNG_NEWTON;
  f->quarter = ABUT_FRICTION_QUARTERS;
  f->steps = f->rounds = 0;
  f->corrections = 0;
  for (int32_t k = 0; k < f->m; ++k)
  {
    f->direction[k] = f->turned[k] = 0;
    f->anchor[k] = f->committed[k];
  }
  if (f->n > 0)
    memset(f->shares, 0, (size_t)f->n);
  if (s->n > 0)
  {
    memset(f->row_changes, 0, (size_t)s->n);
    memset(f->row_mark, 0, (size_t)s->n);
  }
  return ABUT_SUCCESS;
}

/* Springs of stick along tangents that supports or other contacts hold, as a
 * multiple of the stiffness, and the slip there, as a part of the length scale,
 * below which it counts as 0. */
static const double stiff = 1e4, no_slip = 1e-12;

/* Continuous, so that round-off does not decide. */
static double
beyond_noise(double slip, double noise)
{
  return slip > noise ? slip - noise : slip < -noise ? slip + noise : 0;
}

/* Whether supports or other contacts of its node hold tangent t of point i, and
 * the law has no penalty of its own. */
static bool
is_held(const abut_strategy *s, int32_t i, int32_t t)
{
  const abut_friction_rows *f = &s->friction;
  const abut_law *law = s->options.law;
  return (f->tangent[t] != ABUT_TANGENT_FREE || f->shares[i] != 0)
         && (abut_law_is_exact(law) || !abut_law_solves_once(law));
}

/* Slip, traction, and spring of a tangent. */
static void
gather_tangent(abut_strategy *s, int32_t i, int32_t row, int32_t t)
{
  abut_friction_rows *f = &s->friction;
  const bool held = is_held(s, i, t);
  f->slip[t] = s->gap[row];
  if (held || f->tangent[t] == ABUT_TANGENT_PRESCRIBED)
    f->slip[t] = beyond_noise(f->slip[t], no_slip * s->options.length_scale);
  f->traction[t] = s->pressure[row];
  f->reference[t] =
      s->reference != NULL && !held ? s->reference[row] : f->anchor[t];
  f->compliance[t] = held                    ? 1 / (stiff * s->stiffness[row])
                     : s->compliance == NULL ? 0
                                             : s->compliance[row];
}

/* Whether the slip of a point is known before anything is solved. */
static bool
is_prescribed(const abut_friction_rows *f, int32_t i, int32_t tangent)
{
  for (int32_t k = tangent; k < tangent + f->n_tangents[i]; ++k)
    if (f->tangent[k] != ABUT_TANGENT_PRESCRIBED)
      return false;
  return true;
}

/* Points that slip have no springs: their traction is against the slip alone,
 * the committed one where there is none. */
static void
release_slip(abut_strategy *s, int32_t i, int32_t tangent)
{
  abut_friction_rows *f = &s->friction;
  const bool known = is_prescribed(f, i, tangent);
  bool any = false;
  for (int32_t k = tangent; k < tangent + f->n_tangents[i]; ++k)
    any |= f->slip[k] != 0;
  for (int32_t k = tangent; k < tangent + f->n_tangents[i]; ++k)
    if (f->state[i] == ABUT_STATE_SLIP && is_held(s, i, k))
    {
      f->compliance[k] = known ? f->compliance[k] : 0;
      f->reference[k] = known && any ? 0 : f->reference[k];
    }
}

/* Gaps of other contacts of a node that touch, as a part of the length scale.
 */
static const double touching = 1e-10;

/* Mark points whose node another contact holds, too: one that is closed, or
 * touches, so that stick does not take the place of its pressure. */
static void
find_shares(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  const double limit = touching * s->options.length_scale;
  if (f->n > 0)
    memset(f->shares, 0, (size_t)f->n);
  for (int32_t k = 0; k < f->n_rivals; ++k)
    if (s->state[f->rival_row[k]] != ABUT_STATE_OPEN
        || s->gap[f->rival_row[k]] <= limit)
      f->shares[f->rival_point[k]] = 1;
}

/* Pressures, slips and tractions of the rows, by point. */
static void
gather(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  const bool returns = f->iteration == ABUT_FRICTION_RADIAL_RETURN;
  find_shares(s);
  int32_t t = 0;
  for (int32_t i = 0; i < f->n; ++i)
  {
    const int32_t row = f->first[i];
    f->pressure[i] = s->pressure[row];
    f->scale[i] = s->scale[row + 1];
    const int32_t first = t;
    for (int32_t k = 1; k <= f->n_tangents[i]; ++k, ++t)
      gather_tangent(s, i, row + k, t);
    /* So that x is the trial traction of the spring. */
    if ((returns || is_prescribed(f, i, first)) && f->compliance[first] > 0)
      f->scale[i] = 1 / f->compliance[first];
    release_slip(s, i, first);
  }
}

abut_status
abut_friction_find_bounds(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  gather(s);
  const abut_friction_bounds points = {
      .struct_size = sizeof(points),
      .n = f->n,
      .pressure = f->pressure,
      .coefficient = f->coefficient,
      .cap = f->has_cap ? f->cap : NULL,
      .parameters = f->parameters,
  };
  const abut_status status = f->law->bound(&points, f->bound, f->d_bound);
  if (status != ABUT_SUCCESS)
  {
    abut_text text = abut_fail_begin(s->context, call);
    abut_text_add(&text, "the friction law '");
    abut_text_add(&text, f->law->name);
    abut_text_add(&text, "' fails: ");
    abut_text_add(&text, abut_status_text(status));
    return status;
  }
  const double factor = (double)f->quarter / ABUT_FRICTION_QUARTERS;
  for (int32_t i = 0; i < f->n; ++i)
  {
    if (!(f->bound[i] >= 0) || !isfinite(f->d_bound[i]))
      return abut_friction_reject(
          s, ABUT_NOT_FINITE, i,
          "the friction law gives a limit that is negative or not finite");
    f->bound[i] *= factor;
    f->d_bound[i] *= factor;
    if (f->rung == ABUT_RUNG_TRESCA)
    {
      f->bound[i] = f->frozen[i];
      f->d_bound[i] = 0;
    }
    else if ((f->rung == ABUT_RUNG_BOUND
              || f->iteration == ABUT_FRICTION_RADIAL_RETURN)
             && f->pressure[i] <= 0)
      f->d_bound[i] = 0;
  }
  return status;
}

/* Tresca's problem has an energy: where its sets come back, the derivative that
 * forgets where the traction was does better. */
static bool
forgets_traction(const abut_strategy *s)
{
  return s->friction.iteration == ABUT_FRICTION_RADIAL_RETURN
         || (s->friction.rung == ABUT_RUNG_TRESCA && s->active_set.budget == 0);
}

static abut_friction_points
points_of(const abut_strategy *s)
{
  const abut_friction_rows *f = &s->friction;
  const abut_friction_points points = {
      .struct_size = sizeof(points),
      .n = f->n,
      .n_tangents = f->n_tangents,
      .slip = f->slip,
      .traction = f->traction,
      .reference_traction = f->reference,
      .tangent_compliance = f->compliance,
      .scale = f->scale,
      .bound = f->bound,
      .d_bound = f->d_bound,
      .radial_return = forgets_traction(s),
  };
  return points;
}

/* The rows' states, with slip. */
static void
write_row_states(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  if (s->n > 0)
    memcpy(f->row_state, s->state, (size_t)s->n);
  for (int32_t i = 0; i < f->n; ++i)
    for (int32_t k = 0; k <= f->n_tangents[i]; ++k)
      f->row_state[f->first[i] + k] = f->state[i];
}

abut_status
abut_friction_first_state(abut_strategy *s, const uint8_t *state)
{
  abut_friction_rows *f = &s->friction;
  if (!abut_friction_is_on(f))
    return ABUT_SUCCESS;
  for (int32_t i = 0; i < f->n; ++i)
    f->state[i] = s->state[f->first[i]];
  abut_status status = f->iteration == ABUT_FRICTION_TRESCA
                           ? abut_friction_begin_tresca(s)
                           : ABUT_SUCCESS;
  if (status == ABUT_SUCCESS)
    status = abut_friction_find_bounds(s);
  const abut_friction_points points = points_of(s);
  if (status == ABUT_SUCCESS)
    status = abut_friction_classify(&points, f->state);
  int32_t tangent = 0;
  for (int32_t i = 0; i < f->n; tangent += f->n_tangents[i++])
    if (is_prescribed(f, i, tangent))
      continue;
    else if (state != NULL)
      f->state[i] =
          state[f->first[i]] == ABUT_STATE_SLIP && f->d_bound[i] > sticking
              ? ABUT_STATE_CLOSED
              : state[f->first[i]];
    /* Before anything presses nothing is known: stick holds bodies that
     * friction alone holds. */
    else if (f->state[i] == ABUT_STATE_SLIP && !(f->pressure[i] > 0)
             && f->d_bound[i] > 0)
      f->state[i] = ABUT_STATE_CLOSED;
  if (status == ABUT_SUCCESS)
    write_row_states(s);
  return status;
}

/* A point's block: the normal law's two numbers and friction's blocks. */
static void
write_block(abut_strategy *s, int32_t i, int32_t tangent, int32_t part,
            int64_t at)
{
  abut_friction_rows *f = &s->friction;
  const int32_t t = f->n_tangents[i], k = t + 1, row = f->first[i];
  memset(f->a + at, 0, sizeof(double) * (size_t)(k * k));
  memset(f->b + at, 0, sizeof(double) * (size_t)(k * k));
  f->a[at] = s->d_pressure[row];
  f->b[at] = s->d_gap[row];
  for (int32_t r = 0; r < t; ++r)
  {
    double *a = f->a + at + (int64_t)(r + 1) * k;
    double *b = f->b + at + (int64_t)(r + 1) * k;
    a[0] = f->d_pressure[tangent + r];
    for (int32_t c = 0; c < t; ++c)
    {
      a[c + 1] = f->d_traction[part + r * t + c];
      b[c + 1] = f->tangent[tangent + c] == ABUT_TANGENT_PRESCRIBED
                     ? 0
                     : f->d_slip[part + r * t + c];
    }
    s->residual[row + 1 + r] = f->residual[tangent + r];
    /* The diagonal distinguishes a length from a pressure. */
    s->d_pressure[row + 1 + r] = a[r + 1];
    s->d_gap[row + 1 + r] = b[r + 1];
  }
}

static void
write_blocks(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  int64_t at = 0;
  int32_t row = 0, tangent = 0, part = 0;
  for (int32_t i = 0; i <= f->n; ++i)
  {
    const int32_t end = i < f->n ? f->first[i] : s->n;
    for (; row < end; ++row, ++at)
    {
      f->a[at] = s->d_pressure[row];
      f->b[at] = s->d_gap[row];
    }
    if (i == f->n)
      break;
    const int32_t t = f->n_tangents[i];
    write_block(s, i, tangent, part, at);
    at += (int64_t)(t + 1) * (t + 1);
    row += t + 1;
    tangent += t;
    part += t * t;
  }
}

abut_status
abut_friction_evaluate(abut_strategy *s)
{
  abut_friction_rows *f = &s->friction;
  abut_status status = abut_friction_find_bounds(s);
  const abut_friction_points points = points_of(s);
  const abut_friction_linearisation result = {
      .struct_size = sizeof(result),
      .residual = f->residual,
      .d_traction = f->d_traction,
      .d_slip = f->d_slip,
      .d_pressure = f->d_pressure,
      .direction = f->turned,
  };
  if (status != ABUT_SUCCESS)
    return status;
  status = abut_friction_linearise(&points, f->state, &result);
  if (status != ABUT_SUCCESS)
    return abut_fail(s->context, status, call,
                     "slips or tractions are not finite");
  write_blocks(s);
  return status;
}

/* In the plane, slip that has turned round is another state; in space its
 * direction is one of eight. */
static uint8_t
sector(const double *e, int32_t t)
{
  if (t == 1)
    return e[0] < 0;
  const bool steep = fabs(e[1]) > fabs(e[0]);
  return (uint8_t)((e[0] < 0) + 2 * (e[1] < 0) + 4 * steep);
}

/* Whether a point contradicts its state. */
static bool
is_bad(const abut_friction_rows *f, int32_t i, int32_t tangent)
{
  if (f->trial[i] != f->state[i])
    return true;
  if (f->state[i] != ABUT_STATE_SLIP || f->bound[i] == 0)
    return false;
  double along = 0;
  for (int32_t k = 0; k < f->n_tangents[i]; ++k)
    along += f->direction[tangent + k] * f->turned[tangent + k];
  return along < 0;
}

/* By how much: how far x is from the border between stick and slip. */
static double
excess(const abut_friction_rows *f, int32_t i, int32_t tangent)
{
  double square = 0;
  for (int32_t k = tangent; k < tangent + f->n_tangents[i]; ++k)
  {
    const double shifted =
        f->slip[k] + (f->traction[k] - f->reference[k]) * f->compliance[k];
    const double x = f->traction[k] - f->scale[i] * shifted;
    square += x * x;
  }
  return fabs(sqrt(square) - f->bound[i]);
}

/* Pressures and slips below the noise leave a state as it is: the disc is a
 * little smaller for who slips and a little larger for who sticks. */
static void
allow_noise(abut_friction_rows *f, double pressure_noise, double slip_noise)
{
  int32_t tangent = 0;
  for (int32_t i = 0; i < f->n; tangent += f->n_tangents[i++])
  {
    /* A slip that is prescribed has none. */
    const double noise =
        pressure_noise
        + (is_prescribed(f, i, tangent) ? 0 : slip_noise * f->scale[i]);
    f->bound[i] = f->state[i] == ABUT_STATE_CLOSED
                      ? f->bound[i] + noise
                      : fmax(f->bound[i] - noise, 0);
  }
}

/* Whether springs hold all tangents of a point. */
static bool
has_springs(const abut_strategy *s, int32_t i, int32_t tangent)
{
  for (int32_t k = tangent; k < tangent + s->friction.n_tangents[i]; ++k)
    if (!is_held(s, i, k))
      return false;
  return true;
}

/* Whether springs are strong enough to let a point stick: what supports and
 * other contacts leave no slip has none, whatever its traction is. */
static bool
springs_suffice(const abut_strategy *s, int32_t i, int32_t tangent)
{
  const abut_friction_rows *f = &s->friction;
  double square = 0;
  for (int32_t k = 0; k < f->n_tangents[i]; ++k)
  {
    const double x =
        f->anchor[tangent + k]
        - stiff * s->stiffness[f->first[i] + 1 + k] * f->slip[tangent + k];
    square += x * x;
  }
  return sqrt(square) <= f->bound[i];
}

abut_status
abut_friction_find_states(abut_strategy *s, double pressure_noise,
                          double slip_noise)
{
  abut_friction_rows *f = &s->friction;
  if (!abut_friction_is_on(f))
    return ABUT_SUCCESS;
  abut_status status = abut_friction_find_bounds(s);
  allow_noise(f, pressure_noise, slip_noise);
  int32_t tangent = 0;
  for (int32_t i = 0; i < f->n; tangent += f->n_tangents[i++])
  {
    f->trial[i] = s->trial_state[f->first[i]];
    for (int32_t k = tangent; k < tangent + f->n_tangents[i]; ++k)
      if (is_held(s, i, k))
        f->reference[k] = f->anchor[k];
  }
  const abut_friction_points points = points_of(s);
  if (status == ABUT_SUCCESS)
    status = abut_friction_classify(&points, f->trial);
  tangent = 0;
  for (int32_t i = 0; i < f->n; tangent += f->n_tangents[i++])
  {
    const int32_t row = f->first[i];
    const bool has_closed = !(f->bound[i] > 0) && f->d_bound[i] > sticking;
    const bool is_spring = f->bound[i] > 0 && has_springs(s, i, tangent)
                           && springs_suffice(s, i, tangent);
    if (f->trial[i] == ABUT_STATE_SLIP && (has_closed || is_spring))
      f->trial[i] = ABUT_STATE_CLOSED;
    f->row_changes[row] = is_bad(f, i, tangent);
    f->row_excess[row] = f->row_changes[row] ? excess(f, i, tangent) : 0;
    f->row_mark[row] =
        f->state[i] == ABUT_STATE_SLIP
            ? (uint8_t)(1 + sector(f->direction + tangent, f->n_tangents[i]))
            : 0;
  }
  return status;
}

void
abut_friction_accept_states(abut_strategy *s, bool all, double only)
{
  abut_friction_rows *f = &s->friction;
  if (!abut_friction_is_on(f))
    return;
  for (int32_t i = 0; i < f->n; ++i)
    if (all || (double)s->id[f->first[i]] == only)
      f->state[i] = f->trial[i];
  write_row_states(s);
}

void
abut_friction_store_directions(abut_friction_rows *f)
{
  if (abut_friction_is_on(f) && f->m > 0)
    memcpy(f->direction, f->turned, (size_t)f->m * sizeof(double));
}

bool
abut_friction_row_is_free(const abut_strategy *s, int32_t i)
{
  return s->bilateral[i] == ABUT_ROW_TANGENT
         && s->friction.row_state[i] != ABUT_STATE_CLOSED;
}

bool
abut_friction_point_is_bad(const abut_strategy *s, int32_t i)
{
  return abut_friction_is_on(&s->friction) && s->friction.row_changes[i] != 0;
}

double
abut_friction_excess(const abut_strategy *s, int32_t i)
{
  return s->friction.row_excess[i];
}

int64_t
abut_friction_mark(const abut_strategy *s, int32_t i)
{
  /* Beyond all numbers of rows. */
  return abut_friction_is_on(&s->friction)
             ? (int64_t)s->friction.row_mark[i] << 54
             : 0;
}

void
abut_friction_correct_springs(abut_strategy *s, double *change)
{
  abut_friction_rows *f = &s->friction;
  int32_t tangent = 0;
  *change = 0;
  for (int32_t i = 0; i < f->n; tangent += f->n_tangents[i++])
    for (int32_t k = tangent; k < tangent + f->n_tangents[i]; ++k)
      if (f->state[i] == ABUT_STATE_CLOSED && is_held(s, i, k)
          && f->tangent[k] != ABUT_TANGENT_PRESCRIBED)
      {
        *change = fmax(*change, fabs(f->traction[k] - f->anchor[k]));
        f->anchor[k] = f->traction[k];
      }
}

int32_t
abut_friction_n_slipping(const abut_friction_rows *f)
{
  int32_t n = 0;
  for (int32_t i = 0; i < f->n; ++i)
    n += f->state[i] == ABUT_STATE_SLIP;
  return n;
}

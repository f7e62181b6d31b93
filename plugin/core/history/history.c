/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Entries are kept sorted by number: rows come in that order, so that most
 * calls append, and what is looked up is found by bisection. */
#include "history/history.h"

#include <math.h>
#include <string.h>

static const double nowhere[3] = {0, 0, 0};

static abut_history_problem
no_problem(void)
{
  abut_history_problem problem;
  memset(&problem, 0, sizeof(problem));
  problem.struct_size = sizeof(problem);
  return problem;
}

static void
prepare(abut_entry_set *set)
{
  set->id.element = sizeof(int64_t);
  set->pressure.element = sizeof(double);
  set->state.element = sizeof(uint8_t);
  set->place.element = 3 * sizeof(double);
  set->problem = no_problem();
}

static void
release(abut_context *context, abut_entry_set *set)
{
  abut_array_release(context, &set->id);
  abut_array_release(context, &set->pressure);
  abut_array_release(context, &set->state);
  abut_array_release(context, &set->place);
}

abut_status
abut_entry_set_reserve(abut_context *context, abut_entry_set *set, int64_t n)
{
  abut_array *arrays[] = {&set->id, &set->pressure, &set->state, &set->place};
  const int n_arrays = set->has_places ? 4 : 3;
  abut_status status = ABUT_SUCCESS;
  for (int i = 0; i < n_arrays && status == ABUT_SUCCESS; ++i)
    status = abut_array_reserve(context, arrays[i], set->n, n);
  return status;
}

abut_status
abut_entry_set_reserve_places(abut_context *context, abut_entry_set *set,
                              int64_t n)
{
  if (set->has_places)
    return ABUT_SUCCESS;
  const abut_status status = abut_array_reserve(context, &set->place, 0, n);
  if (status == ABUT_SUCCESS && set->n > 0)
    memset(set->place.data, 0, (size_t)set->n * 3 * sizeof(double));
  set->has_places = status == ABUT_SUCCESS;
  return status;
}

static const int64_t *
ids(const abut_entry_set *set)
{
  return set->id.data;
}

static const double *
place_of(const abut_entry_set *set, int64_t i)
{
  return set->has_places ? (const double *)set->place.data + 3 * i : nowhere;
}

void
abut_entry_set_append(abut_entry_set *set, int64_t id, double pressure,
                      uint8_t state, const double *place)
{
  const int64_t i = set->n++;
  ((int64_t *)set->id.data)[i] = id;
  ((double *)set->pressure.data)[i] = pressure;
  ((uint8_t *)set->state.data)[i] = state;
  if (set->has_places)
    memcpy((double *)set->place.data + 3 * i, place, 3 * sizeof(double));
}

abut_status
abut_entry_set_copy(abut_context *context, const abut_entry_set *a,
                    abut_entry_set *b)
{
  b->n = 0;
  b->has_places = a->has_places;
  const abut_status status = abut_entry_set_reserve(context, b, a->n);
  if (status != ABUT_SUCCESS)
    return status;
  b->n = a->n;
  b->problem = a->problem;
  if (a->n == 0)
    return ABUT_SUCCESS;
  const size_t n = (size_t)a->n;
  memcpy(b->id.data, a->id.data, n * sizeof(int64_t));
  memcpy(b->pressure.data, a->pressure.data, n * sizeof(double));
  memcpy(b->state.data, a->state.data, n);
  if (a->has_places)
    memcpy(b->place.data, a->place.data, 3 * n * sizeof(double));
  return ABUT_SUCCESS;
}

abut_status
abut_history_create(abut_context *context, abut_history **history)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (history == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_history_create",
                     "history is NULL");
  abut_history *made = abut_object_create(context, sizeof(abut_history));
  if (made == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, "abut_history_create",
                     "no memory");
  made->context = context;
  prepare(&made->committed);
  prepare(&made->trial);
  prepare(&made->spare);
  *history = made;
  return ABUT_SUCCESS;
}

abut_status
abut_history_destroy(abut_history **history)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_history *old = *history;
  if (old == NULL)
    return ABUT_SUCCESS;
  release(old->context, &old->committed);
  release(old->context, &old->trial);
  release(old->context, &old->spare);
  abut_object_destroy(old->context, old, sizeof(*old));
  *history = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_history_clear(abut_history *history)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  history->committed.n = history->trial.n = 0;
  history->committed.has_places = history->trial.has_places = 0;
  history->committed.problem = history->trial.problem = no_problem();
  return ABUT_SUCCESS;
}

abut_status
abut_history_begin_step(abut_history *history)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  history->trial.n = 0;
  history->trial.has_places = 0;
  return ABUT_SUCCESS;
}

/* Record what is wrong with a point. */
static abut_status
reject(abut_context *context, abut_status status, const char *call, int64_t id,
       const char *what)
{
  abut_text text = abut_fail_begin(context, call);
  abut_text_add(&text, "point ");
  abut_text_add_integer(&text, id);
  abut_text_add(&text, what);
  return status;
}

abut_status
abut_entries_check(abut_context *context, const char *call,
                   const abut_history_entries *entries)
{
  const abut_history_entries *e = entries;
  for (int64_t i = 0; i < e->n; ++i)
  {
    if (e->id[i] < 0)
      return reject(context, ABUT_INVALID_ARGUMENT, call, e->id[i],
                    " has a negative number");
    if (i > 0 && e->id[i] <= e->id[i - 1])
      return reject(context, ABUT_INVALID_ARGUMENT, call, e->id[i],
                    " is not larger than the one before");
    double probe = e->pressure[i];
    for (int d = 0; d < 3 && e->place != NULL; ++d)
      probe += 0.0 * e->place[3 * i + d];
    if (!isfinite(probe))
      return reject(context, ABUT_NOT_FINITE, call, e->id[i],
                    ": pressure or position is not finite");
  }
  return ABUT_SUCCESS;
}

static void
append_given(abut_entry_set *set, const abut_history_entries *e, int64_t i)
{
  abut_entry_set_append(set, e->id[i], e->pressure[i],
                        e->state == NULL ? 0 : e->state[i],
                        e->place == NULL ? nowhere : e->place + 3 * i);
}

static void
append_old(abut_entry_set *set, const abut_entry_set *old, int64_t i)
{
  abut_entry_set_append(
      set, ids(old)[i], ((const double *)old->pressure.data)[i],
      ((const uint8_t *)old->state.data)[i], place_of(old, i));
}

/* Old and new entries into the spare set; new ones win. There must be room. */
static void
merge(abut_entry_set *to, const abut_entry_set *old,
      const abut_history_entries *given)
{
  to->n = 0;
  to->problem = old->problem;
  int64_t i = 0;
  for (int64_t k = 0; k < given->n; ++k)
  {
    while (i < old->n && ids(old)[i] < given->id[k])
      append_old(to, old, i++);
    if (i < old->n && ids(old)[i] == given->id[k])
      ++i;
    append_given(to, given, k);
  }
  while (i < old->n)
    append_old(to, old, i++);
}

/* Put checked entries into the trial version. */
static abut_status
insert(abut_history *history, const abut_history_entries *entries)
{
  abut_entry_set *trial = &history->trial;
  const int64_t n = trial->n + entries->n;
  abut_status status = ABUT_SUCCESS;
  if (entries->place != NULL)
    status = abut_entry_set_reserve_places(history->context, trial, n);
  if (status != ABUT_SUCCESS)
    return status;
  if (trial->n == 0 || ids(trial)[trial->n - 1] < entries->id[0])
  {
    status = abut_entry_set_reserve(history->context, trial, n);
    for (int64_t i = 0; i < entries->n && status == ABUT_SUCCESS; ++i)
      append_given(trial, entries, i);
    return status;
  }
  history->spare.n = 0;
  history->spare.has_places = trial->has_places;
  status = abut_entry_set_reserve(history->context, &history->spare, n);
  if (status != ABUT_SUCCESS)
    return status;
  merge(&history->spare, trial, entries);
  const abut_entry_set merged = history->spare;
  history->spare = *trial;
  *trial = merged;
  return ABUT_SUCCESS;
}

abut_status
abut_history_set(abut_history *history, const abut_history_entries *entries)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  static const char call[] = "abut_history_set";
  abut_context *context = history->context;
  abut_history_entries given = {.struct_size = sizeof(given)};
  if (entries == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call, "entries is NULL");
  abut_status status =
      abut_copy_in(context, call, &given, sizeof(given), entries);
  if (status != ABUT_SUCCESS)
    return status;
  if (given.n < 0
      || (given.n > 0 && (given.id == NULL || given.pressure == NULL)))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "id or pressure is NULL, or n is negative");
  status = abut_entries_check(context, call, &given);
  return status == ABUT_SUCCESS && given.n > 0 ? insert(history, &given)
                                               : status;
}

/* First entry whose number is not below id. */
static int64_t
lower_bound(const abut_entry_set *set, int64_t id)
{
  int64_t begin = 0, end = set->n;
  while (begin < end)
  {
    const int64_t middle = begin + (end - begin) / 2;
    if (ids(set)[middle] < id)
      begin = middle + 1;
    else
      end = middle;
  }
  return begin;
}

static const abut_entry_set *
version_of(const abut_history *history, abut_history_version version)
{
  return version == ABUT_HISTORY_COMMITTED ? &history->committed
         : version == ABUT_HISTORY_TRIAL   ? &history->trial
                                           : NULL;
}

/* The places for answers that a caller gave. */
static abut_status
take_past(const abut_history *history, const char *call,
          const abut_history_values *past, abut_history_values *taken)
{
  *taken = (abut_history_values){.struct_size = sizeof(*taken)};
  return past == NULL ? abut_fail(history->context, ABUT_INVALID_ARGUMENT, call,
                                  "past is NULL")
                      : abut_copy_in(history->context, call, taken,
                                     sizeof(*taken), past);
}

/* Give out entry i of a set as the k-th answer; i < 0: none. */
static void
write_entry(const abut_entry_set *set, int64_t i, int64_t k,
            const abut_history_values *past)
{
  if (past->found != NULL)
    past->found[k] = i >= 0;
  if (past->pressure != NULL)
    past->pressure[k] = i < 0 ? 0 : ((const double *)set->pressure.data)[i];
  if (past->state != NULL)
    past->state[k] = i < 0 ? 0 : ((const uint8_t *)set->state.data)[i];
}

abut_status
abut_history_get(const abut_history *history, abut_history_version version,
                 int64_t n, const int64_t *id, const abut_history_values *past)
{
  static const char call[] = "abut_history_get";
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_entry_set *set = version_of(history, version);
  abut_history_values taken;
  if (set == NULL || n < 0 || (n > 0 && id == NULL))
    return abut_fail(history->context, ABUT_INVALID_ARGUMENT, call,
                     "an argument is NULL, or a size or the version is wrong");
  const abut_status status = take_past(history, call, past, &taken);
  if (status != ABUT_SUCCESS)
    return status;
  for (int64_t k = 0; k < n; ++k)
  {
    const int64_t i = lower_bound(set, id[k]);
    write_entry(set, i < set->n && ids(set)[i] == id[k] ? i : -1, k, &taken);
  }
  return ABUT_SUCCESS;
}

static double
distance_square(const double *a, const double *b)
{
  double sum = 0;
  for (int d = 0; d < 3; ++d)
    sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

abut_status
abut_history_nearest(const abut_history *history, abut_history_version version,
                     int64_t n, const int64_t *first_id, const int64_t *end_id,
                     const double *place, const abut_history_values *past)
{
  static const char call[] = "abut_history_nearest";
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_entry_set *set = version_of(history, version);
  abut_history_values taken;
  if (set == NULL || n < 0
      || (n > 0 && (first_id == NULL || end_id == NULL || place == NULL)))
    return abut_fail(history->context, ABUT_INVALID_ARGUMENT, call,
                     "an argument is NULL, or a size or the version is wrong");
  const abut_status status = take_past(history, call, past, &taken);
  if (status != ABUT_SUCCESS)
    return status;
  for (int64_t k = 0; k < n; ++k)
  {
    int64_t best = -1;
    double least = INFINITY;
    for (int64_t i = lower_bound(set, first_id[k]);
         i < set->n && ids(set)[i] < end_id[k]; ++i)
    {
      const double d = distance_square(place_of(set, i), place + 3 * k);
      if (d < least)
      {
        least = d;
        best = i;
      }
    }
    write_entry(set, best, k, &taken);
  }
  return ABUT_SUCCESS;
}

abut_status
abut_history_view_sized(const abut_history *history,
                        abut_history_version version,
                        abut_history_entries *entries)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_entry_set *set = version_of(history, version);
  if (set == NULL || entries == NULL)
    return abut_fail(history->context, ABUT_INVALID_ARGUMENT,
                     "abut_history_view",
                     "entries is NULL, or the version is wrong");
  const abut_history_entries view = {
      sizeof(view),    set->n,
      set->id.data,    set->pressure.data,
      set->state.data, set->has_places ? set->place.data : NULL};
  return abut_copy_out(history->context, "abut_history_view", entries,
                       sizeof(view), &view);
}

abut_status
abut_history_set_problem(abut_history *history, abut_history_version version,
                         const abut_history_problem *problem)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  static const char call[] = "abut_history_set_problem";
  abut_history_problem taken = no_problem();
  if (version_of(history, version) == NULL || problem == NULL)
    return abut_fail(history->context, ABUT_INVALID_ARGUMENT, call,
                     "problem is NULL, or the version is wrong");
  const abut_status status =
      abut_copy_in(history->context, call, &taken, sizeof(taken), problem);
  if (status != ABUT_SUCCESS)
    return status;
  if (memchr(taken.law, 0, sizeof(taken.law)) == NULL
      || !isfinite(taken.first_penalty) || !isfinite(taken.penalty))
    return abut_fail(history->context, ABUT_INVALID_ARGUMENT, call,
                     "the law has no end, or a penalty is not finite");
  abut_entry_set *set =
      version == ABUT_HISTORY_COMMITTED ? &history->committed : &history->trial;
  set->problem = taken;
  set->problem.struct_size = sizeof(taken);
  set->problem.resumes = taken.resumes != 0;
  return ABUT_SUCCESS;
}

abut_status
abut_history_get_problem_sized(const abut_history *history,
                               abut_history_version version,
                               abut_history_problem *problem)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_entry_set *set = version_of(history, version);
  if (set == NULL || problem == NULL)
    return abut_fail(history->context, ABUT_INVALID_ARGUMENT,
                     "abut_history_get_problem",
                     "problem is NULL, or the version is wrong");
  return abut_copy_out(history->context, "abut_history_get_problem", problem,
                       sizeof(set->problem), &set->problem);
}

abut_status
abut_history_commit(abut_history *history)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_entry_set_copy(history->context, &history->trial,
                             &history->committed);
}

abut_status
abut_history_rollback(abut_history *history)
{
  if (history == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_entry_set_copy(history->context, &history->committed,
                             &history->trial);
}

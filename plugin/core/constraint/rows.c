/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "base/memory.h"

#include <abut/rows.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

struct abut_rows
{
  abut_context *context;
  int32_t n_rows;
  abut_array id;          /* int64_t */
  abut_array weight;      /* double */
  abut_array initial_gap; /* double */
  abut_array bilateral;   /* uint8_t */
  abut_array row_start;   /* int64_t, n_rows + 1 */
  abut_array column;      /* int64_t */
  abut_array coefficient; /* double */
};

abut_status
abut_rows_create(abut_context *context, abut_rows **rows)
{
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (rows == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_rows_create",
                     "rows is NULL");
  abut_rows *made = abut_object_create(context, sizeof(abut_rows));
  if (made == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, "abut_rows_create",
                     "no memory");
  made->context = context;
  made->id.element = sizeof(int64_t);
  made->weight.element = sizeof(double);
  made->initial_gap.element = sizeof(double);
  made->bilateral.element = sizeof(uint8_t);
  made->row_start.element = sizeof(int64_t);
  made->column.element = sizeof(int64_t);
  made->coefficient.element = sizeof(double);
  const abut_status status =
      abut_array_reserve(context, &made->row_start, 0, 1);
  if (status != ABUT_SUCCESS)
  {
    abut_object_destroy(context, made, sizeof(*made));
    return status;
  }
  *(int64_t *)made->row_start.data = 0;
  *rows = made;
  return ABUT_SUCCESS;
}

abut_status
abut_rows_destroy(abut_rows **rows)
{
  if (rows == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_rows *old = *rows;
  if (old == NULL)
    return ABUT_SUCCESS;
  abut_array *arrays[] = {&old->id,         &old->weight,    &old->initial_gap,
                          &old->bilateral,  &old->row_start, &old->column,
                          &old->coefficient};
  for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); ++i)
    abut_array_release(old->context, arrays[i]);
  abut_object_destroy(old->context, old, sizeof(*old));
  *rows = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_rows_clear(abut_rows *rows)
{
  if (rows == NULL)
    return ABUT_INVALID_ARGUMENT;
  rows->n_rows = 0;
  return ABUT_SUCCESS;
}

static int64_t
n_entries_of(const abut_rows *rows)
{
  return ((const int64_t *)rows->row_start.data)[rows->n_rows];
}

/* Room for n_rows rows and n_entries entries, keeping what is there. */
static abut_status
make_room(abut_rows *rows, int64_t n_rows, int64_t n_entries)
{
  abut_context *context = rows->context;
  const int64_t used = rows->n_rows, entries = n_entries_of(rows);
  abut_array *per_row[] = {&rows->id, &rows->weight, &rows->initial_gap,
                           &rows->bilateral};
  abut_status status = ABUT_SUCCESS;
  for (int i = 0; i < 4 && status == ABUT_SUCCESS; ++i)
    status = abut_array_reserve(context, per_row[i], used, n_rows);
  if (status == ABUT_SUCCESS)
    status =
        abut_array_reserve(context, &rows->row_start, used + 1, n_rows + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &rows->column, entries, n_entries);
  if (status == ABUT_SUCCESS)
    status =
        abut_array_reserve(context, &rows->coefficient, entries, n_entries);
  return status;
}

abut_status
abut_rows_reserve(abut_rows *rows, int32_t n_rows, int64_t n_entries)
{
  if (rows == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (n_rows < 0 || n_entries < 0)
    return abut_fail(rows->context, ABUT_INVALID_ARGUMENT, "abut_rows_reserve",
                     "a size is negative");
  return make_room(rows, n_rows, n_entries);
}

/* Record what is wrong with row id. */
static abut_status
reject(const abut_rows *rows, abut_status status, int64_t id, const char *what)
{
  abut_text text = abut_fail_begin(rows->context, "abut_rows_append");
  abut_text_add(&text, "row ");
  abut_text_add_integer(&text, id);
  abut_text_add(&text, what);
  return status;
}

static abut_status
check_row(const abut_rows *rows, int64_t id, double weight, double initial_gap,
          int32_t n_entries, const int64_t *column, const double *coefficient)
{
  const int64_t *ids = rows->id.data;
  if (rows->n_rows == INT32_MAX)
    return reject(rows, ABUT_INVALID_ARGUMENT, id, " exceeds 2^31 - 1 rows");
  if (rows->n_rows > 0 && id <= ids[rows->n_rows - 1])
    return reject(rows, ABUT_INVALID_ARGUMENT, id,
                  " is not larger than the last one");
  if (n_entries < 0
      || (n_entries > 0 && (column == NULL || coefficient == NULL)))
    return reject(rows, ABUT_INVALID_ARGUMENT, id, " has no entries array");
  if (!isfinite(weight) || !isfinite(initial_gap))
    return reject(rows, ABUT_NOT_FINITE, id, ": weight or gap is not finite");
  if (weight <= 0)
    return reject(rows, ABUT_INVALID_ARGUMENT, id, ": weight is not positive");
  for (int32_t k = 0; k < n_entries; ++k)
  {
    if (!isfinite(coefficient[k]))
      return reject(rows, ABUT_NOT_FINITE, id, ": coefficient is not finite");
    if (column[k] < 0)
      return reject(rows, ABUT_INVALID_ARGUMENT, id, ": column is negative");
  }
  return ABUT_SUCCESS;
}

abut_status
abut_rows_append(abut_rows *rows, int64_t id, double weight, double initial_gap,
                 int bilateral, int32_t n_entries, const int64_t *column,
                 const double *coefficient)
{
  if (rows == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_status status =
      check_row(rows, id, weight, initial_gap, n_entries, column, coefficient);
  if (status != ABUT_SUCCESS)
    return status;
  const int64_t start = n_entries_of(rows);
  status = make_room(rows, (int64_t)rows->n_rows + 1, start + n_entries);
  if (status != ABUT_SUCCESS)
    return status;
  const int32_t i = rows->n_rows;
  ((int64_t *)rows->id.data)[i] = id;
  ((double *)rows->weight.data)[i] = weight;
  ((double *)rows->initial_gap.data)[i] = initial_gap;
  ((uint8_t *)rows->bilateral.data)[i] = bilateral != 0;
  ((int64_t *)rows->row_start.data)[i + 1] = start + n_entries;
  if (n_entries > 0)
  {
    const size_t n = (size_t)n_entries;
    memcpy((int64_t *)rows->column.data + start, column, n * sizeof(int64_t));
    memcpy((double *)rows->coefficient.data + start, coefficient,
           n * sizeof(double));
  }
  rows->n_rows = i + 1;
  return ABUT_SUCCESS;
}

abut_status
abut_rows_get_sized(const abut_rows *rows, abut_rows_view *view)
{
  if (rows == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (view == NULL)
    return abut_fail(rows->context, ABUT_INVALID_ARGUMENT, "abut_rows_get",
                     "view is NULL");
  const abut_rows_view present = {.n_rows = rows->n_rows,
                                  .id = rows->id.data,
                                  .weight = rows->weight.data,
                                  .initial_gap = rows->initial_gap.data,
                                  .bilateral = rows->bilateral.data,
                                  .row_start = rows->row_start.data,
                                  .column = rows->column.data,
                                  .coefficient = rows->coefficient.data};
  return abut_give(rows->context, "abut_rows_get", view, sizeof(present),
                   &present);
}

/* Arguments shared by gap and force: arrays, and every column in range. */
static abut_status
check_product(const abut_rows *rows, const char *call, const void *per_unknown,
              const void *per_row, int64_t offset, int64_t n_unknowns)
{
  const int64_t n_entries = n_entries_of(rows);
  if (n_unknowns < 0 || (n_entries > 0 && per_unknown == NULL)
      || (rows->n_rows > 0 && per_row == NULL))
    return abut_fail(rows->context, ABUT_INVALID_ARGUMENT, call,
                     "an array is NULL or a size negative");
  const int64_t *column = rows->column.data;
  for (int64_t k = 0; k < n_entries; ++k)
    if (column[k] < offset || column[k] - offset >= n_unknowns)
    {
      abut_text text = abut_fail_begin(rows->context, call);
      abut_text_add(&text, "column ");
      abut_text_add_integer(&text, column[k]);
      abut_text_add(&text, " is outside the range of the unknowns");
      return ABUT_INVALID_ARGUMENT;
    }
  return ABUT_SUCCESS;
}

abut_status
abut_rows_gap(const abut_rows *rows, const double *displacement, int64_t offset,
              int64_t n_unknowns, double *gap)
{
  if (rows == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_status status = check_product(rows, "abut_rows_gap", displacement,
                                           gap, offset, n_unknowns);
  if (status != ABUT_SUCCESS)
    return status;
  const int64_t *start = rows->row_start.data, *column = rows->column.data;
  const double *initial = rows->initial_gap.data, *b = rows->coefficient.data;
  double probe = 0;
  for (int32_t i = 0; i < rows->n_rows; ++i)
  {
    double sum = initial[i];
    for (int64_t k = start[i]; k < start[i + 1]; ++k)
      sum += b[k] * displacement[column[k] - offset];
    gap[i] = sum;
    probe += sum * 0.0;
  }
  return probe == 0 ? ABUT_SUCCESS
                    : abut_fail(rows->context, ABUT_NOT_FINITE, "abut_rows_gap",
                                "a displacement is not finite");
}

abut_status
abut_rows_add_force(const abut_rows *rows, const double *pressure,
                    int64_t offset, int64_t n_unknowns, double *force)
{
  if (rows == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_status status = check_product(rows, "abut_rows_add_force", force,
                                           pressure, offset, n_unknowns);
  if (status != ABUT_SUCCESS)
    return status;
  double probe = 0;
  for (int32_t i = 0; i < rows->n_rows; ++i)
    probe += pressure[i] * 0.0;
  if (!(probe == 0))
    return abut_fail(rows->context, ABUT_NOT_FINITE, "abut_rows_add_force",
                     "a pressure is not finite");
  const int64_t *start = rows->row_start.data, *column = rows->column.data;
  const double *weight = rows->weight.data, *b = rows->coefficient.data;
  for (int32_t i = 0; i < rows->n_rows; ++i)
    for (int64_t k = start[i]; k < start[i + 1]; ++k)
      force[column[k] - offset] += weight[i] * pressure[i] * b[k];
  return ABUT_SUCCESS;
}

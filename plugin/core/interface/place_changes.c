/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Partners of points from one set to a later one. */
#include "constraint/places.h"
#include "constraint/points.h"
#include "geometry/vector.h"
#include "search/order.h"

/* The point whose first component has a number; -1: none. Items are sorted. */
static int32_t
find(const abut_keyed *list, int32_t n, uint64_t id)
{
  int32_t low = 0, high = n;
  while (low < high)
  {
    const int32_t middle = low + (high - low) / 2;
    if (list[middle].key < id)
      low = middle + 1;
    else
      high = middle;
  }
  return low < n && list[low].key == id ? list[low].index : -1;
}

static bool
have_common_node(const abut_places_view *a, int32_t i,
                 const abut_places_view *b, int32_t j)
{
  for (int64_t k = a->line_start[i]; k < a->line_start[i + 1]; ++k)
    for (int64_t l = b->line_start[j]; l < b->line_start[j + 1]; ++l)
      if (a->line[k] == b->line[l])
        return true;
  return false;
}

static void
count(const abut_points_view *v, const abut_places_view *before,
      const abut_points_view *later, const abut_places_view *now,
      const abut_keyed *list, const uint8_t *wanted,
      abut_place_changes *changes)
{
  const double far_apart = cos(30. * 3.14159265358979323846 / 180.);
  for (int32_t i = 0; i < before->n_points; ++i)
  {
    if (wanted[i] == 0 || before->line_start[i + 1] == before->line_start[i]
        || before->column_start[i + 1] > before->column_start[i])
      continue;
    const int32_t j = find(list, now->n_points,
                           (uint64_t)v->component_id[v->component_start[i]]);
    if (j < 0)
    {
      ++changes->lost;
      continue;
    }
    double a[3], b[3];
    load3(v->frame, v->dimension, v->component_start[i], a);
    load3(later->frame, later->dimension, later->component_start[j], b);
    changes->jumped += !have_common_node(before, i, now, j)
                       || dot3(a, b) < far_apart * norm3(a) * norm3(b);
  }
}

abut_status
abut_points_count_changes(const abut_points *before, const abut_points *now,
                          const uint8_t *wanted, abut_place_changes *changes)
{
  static const char call[] = "abut_points_count_changes";
  abut_points_view v, later;
  abut_places_view p, q;
  abut_status status = abut_points_get_placed(before, &v, &p);
  if (status == ABUT_SUCCESS)
    status = abut_points_get_placed(now, &later, &q);
  if (status != ABUT_SUCCESS)
    return status;
  abut_context *context = abut_points_context(before);
  if (changes == NULL || (v.n_points > 0 && wanted == NULL))
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "wanted or changes is NULL");
  const abut_place_changes none = {0, 0};
  *changes = none;
  abut_array list = {NULL, 0, sizeof(abut_keyed)};
  status = abut_array_reserve(context, &list, 0, 2 * (int64_t)later.n_points);
  if (status != ABUT_SUCCESS)
    return status;
  abut_keyed *items = list.data;
  for (int32_t j = 0; j < later.n_points; ++j)
  {
    items[j].key = (uint64_t)later.component_id[later.component_start[j]];
    items[j].index = j;
  }
  abut_order_sort(items, items + later.n_points, later.n_points);
  count(&v, &p, &later, &q, items, wanted, changes);
  abut_array_release(context, &list);
  return ABUT_SUCCESS;
}

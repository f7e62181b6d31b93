/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Places of points: arrays that grow with the set's. */
#include "constraint/places.h"
#include "constraint/points.h"

#include <math.h>
#include <string.h>

void
abut_places_set_up(abut_places *p, abut_context *context, int32_t dimension)
{
  p->context = context;
  p->dimension = dimension;
  p->pair.element = p->node.element = p->facet.element = sizeof(int32_t);
  p->line.element = p->column.element = sizeof(int32_t);
  p->position.element = p->least.element = sizeof(double);
  p->block.element = sizeof(double);
  p->line_start.element = p->column_start.element = sizeof(int64_t);
  p->block_start.element = sizeof(int64_t);
}

void
abut_places_release(abut_places *p)
{
  abut_array *all[ABUT_PLACE_ARRAYS] = {
      &p->pair,   &p->node,        &p->facet, &p->position,
      &p->least,  &p->line_start,  &p->line,  &p->column_start,
      &p->column, &p->block_start, &p->block};
  for (int i = 0; i < ABUT_PLACE_ARRAYS; ++i)
    abut_array_release(p->context, all[i]);
}

void
abut_places_truncate(abut_places *p, int32_t n)
{
  p->n = n < p->n ? n : p->n;
  if (p->n == 0)
    p->n_pairs = p->n_nodes = 0;
}

static int64_t
end_of(const abut_array *start, int32_t n)
{
  return n == 0 ? 0 : ((const int64_t *)start->data)[n];
}

/* Append n elements to a list and note where it ends; there is room. */
static void
append_list(abut_array *list, abut_array *start, int32_t i, const void *values,
            int64_t n)
{
  const int64_t first = end_of(start, i);
  if (n > 0)
    memmove((char *)list->data + (size_t)first * list->element, values,
            (size_t)n * list->element);
  ((int64_t *)start->data)[0] = 0;
  ((int64_t *)start->data)[i + 1] = first + n;
}

static int64_t
block_size(const abut_places *p, int32_t n_lines, int32_t n_columns)
{
  const int64_t dim = p->dimension;
  return n_columns > 0 ? dim * n_lines * dim * n_columns
                       : dim * (1 + n_lines) * dim * (1 + n_lines);
}

abut_status
abut_places_append(abut_places *p, const abut_place *place,
                   int32_t n_components)
{
  const int64_t n = p->n, dim = p->dimension,
                block =
                    place->block == NULL
                        ? 0
                        : n_components
                              * block_size(p, place->n_lines, place->n_columns);
  const int64_t lines = end_of(&p->line_start, p->n),
                columns = end_of(&p->column_start, p->n),
                blocks = end_of(&p->block_start, p->n);
  struct
  {
    abut_array *array;
    int64_t used, n;
  } const list[ABUT_PLACE_ARRAYS] = {
      {&p->pair, n, n + 1},
      {&p->node, n, n + 1},
      {&p->facet, n, n + 1},
      {&p->position, n * dim, (n + 1) * dim},
      {&p->least, n, n + 1},
      {&p->line_start, n + 1, n + 2},
      {&p->column_start, n + 1, n + 2},
      {&p->block_start, n + 1, n + 2},
      {&p->line, lines, lines + place->n_lines},
      {&p->column, columns, columns + place->n_columns},
      {&p->block, blocks, blocks + block}};
  for (int i = 0; i < ABUT_PLACE_ARRAYS; ++i)
  {
    const abut_status status = abut_array_reserve(
        p->context, list[i].array,
        list[i].used <= list[i].array->capacity ? list[i].used : 0, list[i].n);
    if (status != ABUT_SUCCESS)
      return status;
  }
  const int32_t i = p->n;
  ((int32_t *)p->pair.data)[i] = place->pair;
  ((int32_t *)p->node.data)[i] = place->node;
  ((int32_t *)p->facet.data)[i] = place->facet;
  ((double *)p->least.data)[i] = place->least;
  memcpy((double *)p->position.data + i * dim, place->position,
         (size_t)dim * sizeof(double));
  append_list(&p->line, &p->line_start, i, place->line, place->n_lines);
  append_list(&p->column, &p->column_start, i, place->column, place->n_columns);
  append_list(&p->block, &p->block_start, i, place->block, block);
  p->n_pairs = place->pair >= p->n_pairs ? place->pair + 1 : p->n_pairs;
  p->n_nodes = place->node >= p->n_nodes ? place->node + 1 : p->n_nodes;
  p->n = i + 1;
  return ABUT_SUCCESS;
}

/* Move the list of point i behind those that are kept. */
static void
keep_list(abut_array *list, abut_array *start, int32_t n, int64_t first,
          int64_t size)
{
  append_list(list, start, n,
              list->data == NULL
                  ? NULL
                  : (const char *)list->data + (size_t)first * list->element,
              size);
}

void
abut_places_keep(abut_places *p, int32_t i, int32_t n_components,
                 const uint8_t *keep)
{
  const int32_t n = p->n;
  const size_t dim = (size_t)p->dimension;
  const int64_t *line = p->line_start.data, *column = p->column_start.data,
                *start = p->block_start.data;
  const int64_t first_line = line[i], n_lines = line[i + 1] - line[i],
                first_column = column[i], n_columns = column[i + 1] - column[i],
                first = start[i],
                size = (start[i + 1] - start[i]) / n_components;
  ((int32_t *)p->pair.data)[n] = ((const int32_t *)p->pair.data)[i];
  ((int32_t *)p->node.data)[n] = ((const int32_t *)p->node.data)[i];
  ((int32_t *)p->facet.data)[n] = ((const int32_t *)p->facet.data)[i];
  ((double *)p->least.data)[n] = ((const double *)p->least.data)[i];
  memmove((double *)p->position.data + (size_t)n * dim,
          (const double *)p->position.data + (size_t)i * dim,
          dim * sizeof(double));
  keep_list(&p->line, &p->line_start, n, first_line, n_lines);
  keep_list(&p->column, &p->column_start, n, first_column, n_columns);
  int64_t kept = 0;
  double *block = (double *)p->block.data;
  for (int32_t k = 0; k < n_components && size > 0; ++k)
    if (keep[k] != 0)
      memmove(block + first + size * kept++, block + first + size * k,
              (size_t)size * sizeof(double));
  keep_list(&p->block, &p->block_start, n, first, kept * size);
  p->n = n + 1;
}

static bool
has_numbers(const int32_t *node, int64_t n, int32_t n_nodes,
            const int32_t *number)
{
  for (int64_t i = 0; i < n; ++i)
    if (node[i] >= n_nodes || (node[i] >= 0 && number[node[i]] < 0))
      return false;
  return true;
}

bool
abut_places_renumber(abut_places *p, int32_t *node, int64_t n, int32_t n_nodes,
                     const int32_t *number)
{
  struct
  {
    int32_t *node;
    int64_t n;
  } const list[4] = {{p->node.data, p->n},
                     {p->line.data, end_of(&p->line_start, p->n)},
                     {p->column.data, end_of(&p->column_start, p->n)},
                     {node, n}};
  for (int k = 0; k < 4; ++k)
    if (!has_numbers(list[k].node, list[k].n, n_nodes, number))
      return false;
  for (int k = 0; k < 4; ++k)
    for (int64_t i = 0; i < list[k].n; ++i)
      if (list[k].node[i] >= 0)
        list[k].node[i] = number[list[k].node[i]];
  p->n_nodes = 0;
  for (int32_t i = 0; i < p->n; ++i)
    if (list[0].node[i] >= p->n_nodes)
      p->n_nodes = list[0].node[i] + 1;
  return true;
}

abut_status
abut_points_append_place(abut_points *points, const abut_place *place)
{
  static const char call[] = "abut_points_append_place";
  abut_points_view v;
  abut_status status = abut_points_get(points, &v);
  if (status != ABUT_SUCCESS)
    return status;
  abut_places *p = abut_points_places(points);
  if (place == NULL)
    return abut_fail(p->context, ABUT_INVALID_ARGUMENT, call,
                     "the argument is NULL");
  abut_place taken = abut_place_defaults();
  status = abut_copy_in(p->context, call, &taken, sizeof(taken), place);
  if (status != ABUT_SUCCESS)
    return status;
  if (p->n >= v.n_points)
    return abut_fail(p->context, ABUT_INVALID_ARGUMENT, call,
                     "no point is left without pair and position");
  if (taken.pair < 0 || taken.node < -1 || taken.facet < -1 || taken.n_lines < 0
      || taken.n_columns < 0 || taken.position == NULL
      || (taken.n_lines > 0 && taken.line == NULL)
      || (taken.n_columns > 0 && taken.column == NULL))
    return abut_fail(p->context, ABUT_INVALID_ARGUMENT, call,
                     "a number is out of range or an array NULL");
  return abut_places_append(
      p, &taken, v.component_start[p->n + 1] - v.component_start[p->n]);
}

abut_status
abut_points_get_places_sized(const abut_points *points, abut_places_view *view)
{
  static const char call[] = "abut_points_get_places";
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_places *p = abut_points_places((abut_points *)points);
  if (view == NULL)
    return abut_fail(p->context, ABUT_INVALID_ARGUMENT, call, "view is NULL");
  if (p->n != abut_points_n(points))
    return abut_fail(p->context, ABUT_INVALID_ARGUMENT, call,
                     "points have no pair and position");
  const abut_places_view made = {sizeof(abut_places_view),
                                 p->n,
                                 p->n_pairs,
                                 p->n_nodes,
                                 0,
                                 p->pair.data,
                                 p->node.data,
                                 p->facet.data,
                                 p->position.data,
                                 p->least.data,
                                 p->line_start.data,
                                 p->line.data,
                                 p->column_start.data,
                                 p->column.data,
                                 p->block_start.data,
                                 p->block.data};
  return abut_copy_out(p->context, call, view, sizeof(made), &made);
}

abut_status
abut_points_get_placed(const abut_points *points, abut_points_view *view,
                       abut_places_view *places)
{
  const abut_status status = abut_points_get(points, view);
  return status == ABUT_SUCCESS ? abut_points_get_places(points, places)
                                : status;
}

abut_status
abut_points_renumber_facets(abut_points *points, int32_t n_facets,
                            const int32_t *number)
{
  static const char call[] = "abut_points_renumber_facets";
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_places *p = abut_points_places(points);
  int32_t *facet = p->facet.data;
  for (int32_t i = 0; i < p->n; ++i)
    if (facet[i] >= n_facets || (facet[i] >= 0 && number == NULL))
      return abut_fail(p->context, ABUT_INVALID_ARGUMENT, call,
                       "a facet has no new number");
  for (int32_t i = 0; i < p->n; ++i)
    facet[i] = facet[i] < 0 ? -1 : number[facet[i]];
  return ABUT_SUCCESS;
}

abut_status
abut_points_force_block(const abut_points *points, int32_t point,
                        const double *value, double *sum, int64_t *n)
{
  static const char call[] = "abut_points_force_block";
  abut_points_view v;
  abut_places_view p;
  abut_status status = abut_points_get_placed(points, &v, &p);
  if (status != ABUT_SUCCESS)
    return status;
  if (point < 0 || point >= v.n_points || n == NULL)
    return abut_fail(abut_points_context(points), ABUT_INVALID_ARGUMENT, call,
                     "there is no such point, or n is NULL");
  const int32_t first = v.component_start[point],
                n_components = v.component_start[point + 1] - first;
  const double *block = p.block + p.block_start[point];
  const int64_t size =
      (p.block_start[point + 1] - p.block_start[point]) / n_components;
  if (size > 0 && sum == NULL)
    return abut_fail(abut_points_context(points), ABUT_INVALID_ARGUMENT, call,
                     "sum is NULL");
  double force = 0.;
  for (int64_t e = 0; e < size; ++e)
    sum[e] = 0.;
  for (int32_t k = 0; k < n_components; ++k)
  {
    const double each = value == NULL ? 1. : v.weight[point] * value[first + k];
    for (int64_t e = 0; e < size; ++e)
      sum[e] += each * block[k * size + e];
    force += fabs(each);
  }
  *n = force > 0. ? size : 0;
  return ABUT_SUCCESS;
}

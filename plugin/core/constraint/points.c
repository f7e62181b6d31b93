/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* A set of contact points: arrays that grow together. As long as each point has
 * one component, the arrays of components are those of the points; the first
 * point with more splits them. */
#include "constraint/points.h"
#include "base/memory.h"
#include "constraint/places.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum
{
  N_ARRAYS = 13
};

struct abut_points
{
  abut_context *context;
  int32_t dimension, n_points, n_components;
  bool is_split;          /* components have arrays of their own */
  abut_array id;          /* int64_t */
  abut_array kind;        /* uint8_t */
  abut_array weight;      /* double */
  abut_array n_secondary; /* int32_t */
  abut_array component;   /* int32_t, n_points + 1 */
  abut_array start;       /* int64_t, n_points + 1 */
  abut_array frame;       /* double, n_components * dimension */
  abut_array gap;         /* double, n_components */
  abut_array node;        /* int32_t, entries */
  abut_array coefficient; /* double, entries */
  abut_array component_id, component_weight, bilateral; /* if split */
  abut_places places;
};

static void
list_arrays(abut_points *p, abut_array *list[N_ARRAYS])
{
  abut_array *all[N_ARRAYS] = {
      &p->id,        &p->kind,        &p->weight,       &p->n_secondary,
      &p->component, &p->start,       &p->frame,        &p->gap,
      &p->node,      &p->coefficient, &p->component_id, &p->component_weight,
      &p->bilateral};
  memcpy(list, all, sizeof(all));
}

static void
set_sizes(abut_points *p)
{
  p->id.element = p->component_id.element = sizeof(int64_t);
  p->kind.element = p->bilateral.element = sizeof(uint8_t);
  p->weight.element = p->component_weight.element = sizeof(double);
  p->n_secondary.element = p->component.element = sizeof(int32_t);
  p->start.element = sizeof(int64_t);
  p->frame.element = p->gap.element = sizeof(double);
  p->node.element = sizeof(int32_t);
  p->coefficient.element = sizeof(double);
}

abut_status
abut_points_create(abut_context *context, int32_t dimension,
                   abut_points **points)
{
  static const char call[] = "abut_points_create";
  if (context == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (points == NULL || dimension < 1 || dimension > 3)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, call,
                     "points is NULL or dimension not in 1 .. 3");
  abut_points *made = abut_object_create(context, sizeof(abut_points));
  if (made == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, call, "no memory");
  made->context = context;
  made->dimension = dimension;
  set_sizes(made);
  abut_places_set_up(&made->places, context, dimension);
  abut_status status = abut_array_reserve(context, &made->component, 0, 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(context, &made->start, 0, 1);
  if (status != ABUT_SUCCESS)
  {
    (void)abut_points_destroy(&made);
    return status;
  }
  *(int32_t *)made->component.data = 0;
  *(int64_t *)made->start.data = 0;
  *points = made;
  return ABUT_SUCCESS;
}

abut_status
abut_points_destroy(abut_points **points)
{
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_points *old = *points;
  if (old == NULL)
    return ABUT_SUCCESS;
  abut_array *arrays[N_ARRAYS];
  list_arrays(old, arrays);
  for (int i = 0; i < N_ARRAYS; ++i)
    abut_array_release(old->context, arrays[i]);
  abut_places_release(&old->places);
  abut_object_destroy(old->context, old, sizeof(*old));
  *points = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_points_clear(abut_points *points)
{
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_points_truncate(points, 0);
  return ABUT_SUCCESS;
}

abut_context *
abut_points_context(const abut_points *points)
{
  return points->context;
}

int32_t
abut_points_n(const abut_points *points)
{
  return points->n_points;
}

int32_t
abut_points_dimension(const abut_points *points)
{
  return points->dimension;
}

abut_places *
abut_points_places(abut_points *points)
{
  return &points->places;
}

double *
abut_points_gaps(abut_points *points)
{
  return points->gap.data;
}

void
abut_points_truncate(abut_points *points, int32_t n)
{
  points->n_points = n;
  points->n_components = ((const int32_t *)points->component.data)[n];
  points->is_split = points->is_split && n > 0;
  abut_places_truncate(&points->places, n);
}

static int64_t
n_entries_of(const abut_points *p)
{
  return ((const int64_t *)p->start.data)[p->n_points];
}

/* Room for the components' own arrays. */
static abut_status
reserve_components(abut_points *p, int64_t used, int64_t n)
{
  abut_array *arrays[] = {&p->component_id, &p->component_weight,
                          &p->bilateral};
  abut_status status = ABUT_SUCCESS;
  for (int i = 0; i < 3 && status == ABUT_SUCCESS; ++i)
    status = abut_array_reserve(p->context, arrays[i], used, n);
  return status;
}

/* Room for that many in all, keeping what is there. */
static abut_status
make_room(abut_points *p, int64_t n_points, int64_t n_components,
          int64_t n_entries)
{
  const int64_t points = p->n_points, components = p->n_components,
                entries = n_entries_of(p), dim = p->dimension;
  struct
  {
    abut_array *array;
    int64_t used, n;
  } const list[] = {{&p->id, points, n_points},
                    {&p->kind, points, n_points},
                    {&p->weight, points, n_points},
                    {&p->n_secondary, points, n_points},
                    {&p->component, points + 1, n_points + 1},
                    {&p->start, points + 1, n_points + 1},
                    {&p->frame, components * dim, n_components * dim},
                    {&p->gap, components, n_components},
                    {&p->node, entries, n_entries},
                    {&p->coefficient, entries, n_entries}};
  abut_status status = ABUT_SUCCESS;
  for (size_t i = 0;
       i < sizeof(list) / sizeof(list[0]) && status == ABUT_SUCCESS; ++i)
    status =
        abut_array_reserve(p->context, list[i].array, list[i].used, list[i].n);
  return status == ABUT_SUCCESS && p->is_split
             ? reserve_components(p, components, n_components)
             : status;
}

abut_status
abut_points_reserve(abut_points *points, int32_t n_points, int32_t n_components,
                    int64_t n_entries)
{
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (n_points < 0 || n_components < 0 || n_entries < 0)
    return abut_fail(points->context, ABUT_INVALID_ARGUMENT,
                     "abut_points_reserve", "a size is negative");
  return make_room(points, n_points, n_components, n_entries);
}

/* Record what is wrong with a point. */
static abut_status
reject(const abut_points *p, abut_status status, int64_t id, const char *what)
{
  abut_text text = abut_fail_begin(p->context, "abut_points_append");
  abut_text_add(&text, "point ");
  abut_text_add_integer(&text, id);
  abut_text_add(&text, what);
  return status;
}

static const char *
fault_of(const abut_points *p, const abut_point *point)
{
  if (point->id < 0)
    return ": its number is negative";
  if (point->kind != ABUT_POINT_CONTACT && point->kind != ABUT_POINT_TIE)
    return " is of no kind";
  if (point->n_components < 1 || point->n_components > p->dimension
      || point->frame == NULL || point->gap == NULL)
    return ": components are missing, or more than dimensions";
  if (p->n_components > INT32_MAX - point->n_components)
    return " exceeds 2^31 - 1 components";
  if (point->n_nodes < 0 || point->n_secondary < 0
      || point->n_secondary > point->n_nodes
      || (point->n_nodes > 0
          && (point->node == NULL || point->coefficient == NULL)))
    return " has no stencil";
  if (point->weight <= 0)
    return ": weight is not positive";
  for (int32_t l = 0; l < point->n_nodes; ++l)
    if (point->node[l] < 0)
      return ": a node is negative";
  return NULL;
}

static bool
is_finite(const abut_points *p, const abut_point *point)
{
  const int32_t n = point->n_components;
  double probe = point->weight * 0.0;
  for (int32_t a = 0; a < n; ++a)
    probe += point->gap[a] * 0.0;
  for (int32_t d = 0; d < n * p->dimension; ++d)
    probe += point->frame[d] * 0.0;
  for (int32_t l = 0; l < point->n_nodes; ++l)
    probe += point->coefficient[l] * 0.0;
  return probe == 0;
}

/* Components get arrays of their own: each point had one so far. */
static abut_status
split(abut_points *p, int64_t n)
{
  const size_t have = (size_t)p->n_points;
  const abut_status status = reserve_components(p, 0, n);
  if (status != ABUT_SUCCESS)
    return status;
  p->is_split = true;
  if (have == 0)
    return ABUT_SUCCESS;
  memcpy(p->component_id.data, p->id.data, have * sizeof(int64_t));
  memcpy(p->component_weight.data, p->weight.data, have * sizeof(double));
  memcpy(p->bilateral.data, p->kind.data, have);
  return ABUT_SUCCESS;
}

/* Write a point behind the last one; there is room. The point may be one of the
 * set itself, from there on. */
static void
write_point(abut_points *p, const abut_point *point)
{
  const int32_t i = p->n_points, first = p->n_components,
                n = point->n_components;
  const int64_t start = n_entries_of(p), dim = p->dimension;
  const size_t entries = (size_t)point->n_nodes;
  ((int64_t *)p->id.data)[i] = point->id;
  ((uint8_t *)p->kind.data)[i] = (uint8_t)point->kind;
  ((double *)p->weight.data)[i] = point->weight;
  ((int32_t *)p->n_secondary.data)[i] = point->n_secondary;
  ((int32_t *)p->component.data)[i + 1] = first + n;
  ((int64_t *)p->start.data)[i + 1] = start + point->n_nodes;
  memmove((double *)p->frame.data + first * dim, point->frame,
          sizeof(double) * (size_t)(n * dim));
  memmove((double *)p->gap.data + first, point->gap,
          sizeof(double) * (size_t)n);
  for (int32_t a = 0; a < n && p->is_split; ++a)
  {
    ((int64_t *)p->component_id.data)[first + a] = point->id + a;
    ((double *)p->component_weight.data)[first + a] = point->weight;
    ((uint8_t *)p->bilateral.data)[first + a] = point->kind == ABUT_POINT_TIE;
  }
  if (entries > 0)
  {
    memmove((int32_t *)p->node.data + start, point->node,
            entries * sizeof(int32_t));
    memmove((double *)p->coefficient.data + start, point->coefficient,
            entries * sizeof(double));
  }
  p->n_points = i + 1;
  p->n_components = first + n;
}

/* Append a point of this version. */
static abut_status
append(abut_points *p, const abut_point *point)
{
  const char *fault = fault_of(p, point);
  if (fault == NULL && !is_finite(p, point))
    return reject(p, ABUT_NOT_FINITE, point->id, ": a number is not finite");
  if (fault != NULL)
    return reject(p, ABUT_INVALID_ARGUMENT, point->id, fault);
  const int64_t n = (int64_t)p->n_components + point->n_components;
  abut_status status = make_room(p, (int64_t)p->n_points + 1, n,
                                 n_entries_of(p) + point->n_nodes);
  if (status == ABUT_SUCCESS && point->n_components > 1 && !p->is_split)
    status = split(p, n);
  if (status == ABUT_SUCCESS)
    write_point(p, point);
  return status;
}

abut_status
abut_points_append(abut_points *points, const abut_point *point)
{
  static const char call[] = "abut_points_append";
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (point == NULL)
    return abut_fail(points->context, ABUT_INVALID_ARGUMENT, call,
                     "point is NULL");
  abut_point taken = abut_point_defaults();
  const abut_status status =
      abut_copy_in(points->context, call, &taken, sizeof(taken), point);
  return status == ABUT_SUCCESS ? append(points, &taken) : status;
}

abut_status
abut_points_append_scalar(abut_points *points, int64_t id, double weight,
                          double gap, abut_point_kind kind, int32_t n_nodes,
                          const int32_t *node, const double *coefficient)
{
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (points->dimension != 1)
    return abut_fail(points->context, ABUT_INVALID_ARGUMENT,
                     "abut_points_append_scalar",
                     "nodes have more than one unknown");
  const double frame = -1.;
  const abut_point point = {sizeof(abut_point),
                            id,
                            kind,
                            1,
                            weight,
                            &frame,
                            &gap,
                            n_nodes,
                            n_nodes,
                            node,
                            coefficient};
  return append(points, &point);
}

/* Point i as one to be appended, its components from the given one on. */
static abut_point
point_of(const abut_points *p, int32_t i, int32_t first)
{
  const int32_t *component = p->component.data;
  const int64_t *start = p->start.data;
  abut_point point = abut_point_defaults();
  point.id = ((const int64_t *)p->id.data)[i];
  point.kind = ((const uint8_t *)p->kind.data)[i];
  point.n_components = component[i + 1] - first;
  point.weight = ((const double *)p->weight.data)[i];
  point.frame = (const double *)p->frame.data + (int64_t)first * p->dimension;
  point.gap = (const double *)p->gap.data + first;
  point.n_nodes = (int32_t)(start[i + 1] - start[i]);
  point.n_secondary = ((const int32_t *)p->n_secondary.data)[i];
  point.node = (const int32_t *)p->node.data + start[i];
  point.coefficient = (const double *)p->coefficient.data + start[i];
  return point;
}

/* Move the components that are kept to the front. */
static void
keep_components(abut_points *p, const uint8_t *keep, abut_point *point)
{
  const size_t dim = (size_t)p->dimension;
  const int64_t first = point->gap - (const double *)p->gap.data;
  double *gap = (double *)p->gap.data + first,
         *frame = (double *)p->frame.data + (size_t)first * dim;
  int32_t n = 0;
  for (int32_t a = 0; a < point->n_components; ++a)
    if (keep[a])
    {
      gap[n] = gap[a];
      memmove(frame + (size_t)n * dim, frame + (size_t)a * dim,
              sizeof(double) * dim);
      ++n;
    }
  point->n_components = n;
}

abut_status
abut_points_filter(abut_points *points, const uint8_t *keep)
{
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (points->n_points > 0 && keep == NULL)
    return abut_fail(points->context, ABUT_INVALID_ARGUMENT,
                     "abut_points_filter", "keep is NULL");
  const int32_t n = points->n_points, n_places = points->places.n;
  points->n_points = points->n_components = points->places.n = 0;
  /* Where a point ends is overwritten as soon as components are left out. */
  int32_t first = 0;
  for (int32_t i = 0; i < n; ++i)
  {
    const int32_t end = ((const int32_t *)points->component.data)[i + 1];
    abut_point point = point_of(points, i, first);
    const uint8_t *kept = keep + first;
    const int32_t n_components = point.n_components;
    first = end;
    if (point.kind == ABUT_POINT_TIE || kept[0])
      keep_components(points, kept, &point);
    else
      point.n_components = 0;
    if (point.n_components == 0)
      continue;
    write_point(points, &point);
    if (i < n_places)
      abut_places_keep(&points->places, i, n_components, kept);
  }
  return ABUT_SUCCESS;
}

abut_status
abut_points_check_nodes(const abut_points *p, const char *call, int32_t n_nodes)
{
  const int64_t n = n_entries_of(p);
  const int32_t *node = p->node.data;
  for (int64_t e = 0; e < n; ++e)
    if (node[e] >= n_nodes)
    {
      abut_text text = abut_fail_begin(p->context, call);
      abut_text_add(&text, "node ");
      abut_text_add_integer(&text, node[e]);
      abut_text_add(&text, " is outside the range of the nodes");
      return ABUT_INVALID_ARGUMENT;
    }
  return ABUT_SUCCESS;
}

abut_status
abut_points_renumber(abut_points *points, int32_t n_nodes,
                     const int32_t *number)
{
  static const char call[] = "abut_points_renumber";
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (n_nodes > 0 && number == NULL)
    return abut_fail(points->context, ABUT_INVALID_ARGUMENT, call,
                     "number is NULL");
  return abut_places_renumber(&points->places, points->node.data,
                              n_entries_of(points), n_nodes, number)
             ? ABUT_SUCCESS
             : abut_fail(points->context, ABUT_INVALID_ARGUMENT, call,
                         "a node that a point refers to has no new number");
}

abut_status
abut_points_get_sized(const abut_points *points, abut_points_view *view)
{
  if (points == NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_points *p = points;
  if (view == NULL)
    return abut_fail(p->context, ABUT_INVALID_ARGUMENT, "abut_points_get",
                     "view is NULL");
  const abut_points_view made = {
      sizeof(abut_points_view),
      p->dimension,
      p->n_points,
      p->n_components,
      p->id.data,
      p->kind.data,
      p->weight.data,
      p->component.data,
      p->frame.data,
      p->gap.data,
      p->is_split ? p->component_id.data : p->id.data,
      p->is_split ? p->component_weight.data : p->weight.data,
      p->is_split ? p->bilateral.data : p->kind.data,
      p->n_secondary.data,
      p->start.data,
      p->node.data,
      p->coefficient.data};
  return abut_copy_out(p->context, "abut_points_get", view, sizeof(made),
                       &made);
}

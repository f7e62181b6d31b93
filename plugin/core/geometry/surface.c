/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "geometry/surface.h"

#include <math.h>
#include <string.h>

/* Give an array its element size; it stays empty. */
static void
prepare(abut_array *array, size_t element)
{
  array->data = NULL;
  array->capacity = 0;
  array->element = element;
}

static void
prepare_all(abut_surface *s)
{
  prepare(&s->facet_start, sizeof(int32_t));
  prepare(&s->connectivity, sizeof(int32_t));
  prepare(&s->kinds, sizeof(uint8_t));
  prepare(&s->position, sizeof(double));
  prepare(&s->node_id, sizeof(int64_t));
  prepare(&s->facet_id, sizeof(int64_t));
  prepare(&s->group, sizeof(int32_t));
  prepare(&s->node_start, sizeof(int32_t));
  prepare(&s->node_facet, sizeof(int32_t));
  prepare(&s->neighbour, sizeof(int32_t));
  prepare(&s->normal, sizeof(double));
  prepare(&s->scratch, sizeof(double));
}

static void
release_all(abut_surface *s)
{
  abut_array *arrays[] = {&s->facet_start, &s->connectivity, &s->kinds,
                          &s->position,    &s->node_id,      &s->facet_id,
                          &s->group,       &s->node_start,   &s->node_facet,
                          &s->neighbour,   &s->normal,       &s->scratch};
  for (size_t i = 0; i < sizeof(arrays) / sizeof(arrays[0]); ++i)
    abut_array_release(s->context, arrays[i]);
}

/* Copy n elements into the array, or borrow them: *use is what to read. */
static abut_status
copy_or_borrow(abut_surface *s, abut_array *array, const void *from, int64_t n,
               const void **use)
{
  *use = from;
  if (from == NULL || s->borrow)
    return ABUT_SUCCESS;
  const abut_status status =
      abut_array_reserve(s->context, array, 0, n > 0 ? n : 1);
  if (status != ABUT_SUCCESS)
    return status;
  if (n > 0)
    memcpy(array->data, from, (size_t)n * array->element);
  *use = array->data;
  return ABUT_SUCCESS;
}

/* Kinds and start of each facet; the kinds of a uniform surface are stored,
 * too, so that there is one way to read them. */
static abut_status
take_kinds(abut_surface *s, const abut_surface_data *data)
{
  const int32_t n = data->n_facets;
  abut_status status =
      abut_array_reserve(s->context, &s->facet_start, 0, (int64_t)n + 1);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(s->context, &s->kinds, 0, (int64_t)n + 1);
  if (status != ABUT_SUCCESS)
    return status;
  uint8_t *kinds = s->kinds.data;
  int32_t *start = s->facet_start.data;
  start[0] = 0;
  s->uniform_kind =
      (int32_t)(data->kinds != NULL && n > 0 ? (abut_facet_kind)data->kinds[0]
                                             : data->kind);
  for (int32_t f = 0; f < n; ++f)
  {
    kinds[f] = data->kinds != NULL ? data->kinds[f] : (uint8_t)data->kind;
    start[f + 1] = start[f] + abut_facet_n_nodes((abut_facet_kind)kinds[f]);
    if (kinds[f] != s->uniform_kind)
      s->uniform_kind = -1;
  }
  s->view.kinds = kinds;
  s->view.facet_start = start;
  return ABUT_SUCCESS;
}

static abut_status
take_arrays(abut_surface *s, const abut_surface_data *data)
{
  abut_status status = take_kinds(s, data);
  if (status != ABUT_SUCCESS)
    return status;
  const int64_t n = data->n_facets;
  const void *use[5];
  struct
  {
    abut_array *array;
    const void *from;
    int64_t n;
  } const list[5] = {
      {&s->connectivity, data->connectivity, s->view.facet_start[n]},
      {&s->position, data->position, (int64_t)data->n_nodes * data->dimension},
      {&s->node_id, data->node_id, data->n_nodes},
      {&s->facet_id, data->facet_id, n},
      {&s->group, data->group, n}};
  for (int i = 0; i < 5; ++i)
  {
    status = copy_or_borrow(s, list[i].array, list[i].from, list[i].n, &use[i]);
    if (status != ABUT_SUCCESS)
      return status;
  }
  s->view.connectivity = use[0];
  s->view.position = use[1];
  s->view.node_id = use[2];
  s->view.facet_id = use[3];
  s->view.group = use[4];
  return ABUT_SUCCESS;
}

static abut_status
build(abut_surface *s, const abut_surface_data *data)
{
  abut_status status = take_arrays(s, data);
  if (status == ABUT_SUCCESS)
    status =
        abut_surface_check_position(s, "abut_surface_create", s->view.position);
  if (status == ABUT_SUCCESS)
    status = abut_surface_check_facets(s);
  if (status == ABUT_SUCCESS)
    status = abut_surface_topology(s);
  if (status == ABUT_SUCCESS && data->check_orientation)
    status = abut_surface_check_orientation(s);
  return status;
}

abut_status
abut_surface_create(abut_context *context, const abut_surface_data *given,
                    abut_surface **surface)
{
  if (context == NULL || surface == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_surface_create",
                     "context or result is NULL");
  if (given == NULL)
    return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_surface_create",
                     "data is NULL");
  abut_surface_data taken = abut_surface_data_defaults();
  const abut_surface_data *data = &taken;
  abut_status status = abut_copy_in(context, "abut_surface_create", &taken,
                                    sizeof(taken), given);
  if (status == ABUT_SUCCESS)
    status = abut_surface_check_data(context, data);
  if (status != ABUT_SUCCESS)
    return status;
  abut_surface *s = abut_object_create(context, sizeof(*s));
  if (s == NULL)
    return abut_fail(context, ABUT_OUT_OF_MEMORY, "abut_surface_create",
                     "no memory");
  s->context = context;
  s->borrow = data->borrow;
  s->feature_angle = data->feature_angle;
  s->revision = 1;
  s->view.dimension = data->dimension;
  s->view.n_nodes = data->n_nodes;
  s->view.n_facets = data->n_facets;
  prepare_all(s);
  status = build(s, data);
  if (status != ABUT_SUCCESS)
  {
    release_all(s);
    abut_object_destroy(context, s, sizeof(*s));
    return status;
  }
  *surface = s;
  return ABUT_SUCCESS;
}

abut_status
abut_surface_destroy(abut_surface **surface)
{
  if (surface == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_surface *s = *surface;
  if (s == NULL)
    return ABUT_SUCCESS;
  release_all(s);
  abut_object_destroy(s->context, s, sizeof(*s));
  *surface = NULL;
  return ABUT_SUCCESS;
}

abut_status
abut_surface_update(abut_surface *surface, const double *position)
{
  if (surface == NULL)
    return ABUT_INVALID_ARGUMENT;
  abut_surface *s = surface;
  if (position == NULL && s->view.n_nodes > 0)
    return abut_fail(s->context, ABUT_INVALID_ARGUMENT, "abut_surface_update",
                     "position is NULL");
  const abut_status status =
      abut_surface_check_position(s, "abut_surface_update", position);
  if (status != ABUT_SUCCESS)
    return status;
  if (s->borrow)
    s->view.position = position;
  else if (s->view.n_nodes > 0)
    memcpy(s->position.data, position,
           (size_t)s->view.n_nodes * (size_t)s->view.dimension
               * sizeof(double));
  ++s->revision;
  return ABUT_SUCCESS;
}

abut_status
abut_surface_get_sized(const abut_surface *surface, abut_surface_view *view)
{
  if (surface == NULL || view == NULL)
    return ABUT_INVALID_ARGUMENT;
  return abut_copy_out(surface->context, "abut_surface_get", view,
                       sizeof(surface->view), &surface->view);
}

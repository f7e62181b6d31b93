/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Checks of the arrays that a surface is made from. Every message names the
 * offending facet or node by the caller's number and by its place. */
#include "geometry/surface.h"

#include <math.h>

static abut_status
refuse(abut_context *context, const char *what)
{
  return abut_fail(context, ABUT_INVALID_ARGUMENT, "abut_surface_create", what);
}

/* "call: facet 12 (number 40)" */
static abut_text
begin_facet(const abut_surface *s, const char *call, int32_t f)
{
  abut_text text = abut_fail_begin(s->context, call);
  abut_text_add(&text, "facet ");
  abut_text_add_integer(&text, f);
  if (s->view.facet_id != NULL)
  {
    abut_text_add(&text, " (number ");
    abut_text_add_integer(&text, s->view.facet_id[f]);
    abut_text_add(&text, ")");
  }
  return text;
}

static abut_status
check_kinds(abut_context *context, const abut_surface_data *data)
{
  int64_t n = 0;
  for (int32_t f = 0; f < data->n_facets; ++f)
  {
    const abut_facet_kind kind =
        data->kinds != NULL ? (abut_facet_kind)data->kinds[f] : data->kind;
    if (abut_facet_dimension(kind) != data->dimension)
    {
      abut_text text = abut_fail_begin(context, "abut_surface_create");
      abut_text_add(&text, "facet ");
      abut_text_add_integer(&text, f);
      abut_text_add(&text, " has a kind that does not exist in ");
      abut_text_add_integer(&text, data->dimension);
      abut_text_add(&text, " dimensions");
      return ABUT_INVALID_MESH;
    }
    n += abut_facet_n_nodes(kind);
  }
  if (n > INT32_MAX / 4)
    return refuse(context, "more facets than 32-bit numbers can count");
  return ABUT_SUCCESS;
}

abut_status
abut_surface_check_data(abut_context *context, const abut_surface_data *data)
{
  if (data->dimension != 2 && data->dimension != 3)
    return refuse(context, "dimension is neither 2 nor 3");
  if (data->n_nodes < 0 || data->n_facets < 0)
    return refuse(context, "n_nodes or n_facets is negative");
  if (data->n_nodes > 0 && data->position == NULL)
    return refuse(context, "position is NULL");
  if (data->n_facets > 0 && data->connectivity == NULL)
    return refuse(context, "connectivity is NULL");
  if (!(data->feature_angle > 0 && data->feature_angle <= 3.15))
    return refuse(context, "feature_angle is not in (0, pi]");
  return check_kinds(context, data);
}

abut_status
abut_surface_check_position(const abut_surface *s, const char *call,
                            const double *position)
{
  const int32_t dimension = s->view.dimension;
  const int64_t n = (int64_t)s->view.n_nodes * dimension;
  /* One pass without branches; the offender is looked for afterwards. */
  int ok = 1;
  for (int64_t i = 0; i < n; ++i)
    ok &= fabs(position[i]) <= ABUT_FACET_LIMIT;
  if (ok)
    return ABUT_SUCCESS;
  int64_t i = 0;
  while (fabs(position[i]) <= ABUT_FACET_LIMIT)
    ++i;
  const int32_t node = (int32_t)(i / dimension);
  abut_text text = abut_fail_begin(s->context, call);
  abut_text_add(&text, "node ");
  abut_text_add_integer(&text, node);
  if (s->view.node_id != NULL)
  {
    abut_text_add(&text, " (number ");
    abut_text_add_integer(&text, s->view.node_id[node]);
    abut_text_add(&text, ")");
  }
  abut_text_add(&text, " has coordinate ");
  abut_text_add_number(&text, position[i]);
  return ABUT_NOT_FINITE;
}

/* The nodes of facet f exist and differ. */
static abut_status
check_nodes(const abut_surface *s, int32_t f)
{
  const int32_t *c = s->view.connectivity + s->view.facet_start[f];
  const int32_t n = s->view.facet_start[f + 1] - s->view.facet_start[f];
  for (int32_t a = 0; a < n; ++a)
  {
    if (c[a] < 0 || c[a] >= s->view.n_nodes)
    {
      abut_text text = begin_facet(s, "abut_surface_create", f);
      abut_text_add(&text, " has the node ");
      abut_text_add_integer(&text, c[a]);
      abut_text_add(&text, ", but nodes are 0 .. ");
      abut_text_add_integer(&text, (int64_t)s->view.n_nodes - 1);
      return ABUT_INVALID_MESH;
    }
    for (int32_t b = 0; b < a; ++b)
      if (c[a] == c[b])
      {
        abut_text text = begin_facet(s, "abut_surface_create", f);
        abut_text_add(&text, " has the node ");
        abut_text_add_integer(&text, c[a]);
        abut_text_add(&text, " twice");
        return ABUT_INVALID_MESH;
      }
  }
  return ABUT_SUCCESS;
}

abut_status
abut_surface_check_facets(const abut_surface *s)
{
  double nodes[3 * ABUT_FACET_MAX_NODES];
  for (int32_t f = 0; f < s->view.n_facets; ++f)
  {
    const abut_status status = check_nodes(s, f);
    if (status != ABUT_SUCCESS)
      return status;
    abut_surface_gather(s, f, nodes);
    const abut_facet_fault fault =
        abut_facet_check((abut_facet_kind)s->view.kinds[f], nodes);
    if (fault != ABUT_FACET_FAULT_NONE)
    {
      abut_text text = begin_facet(s, "abut_surface_create", f);
      abut_text_add(&text, ": ");
      abut_text_add(&text, abut_facet_fault_text(fault));
      return ABUT_INVALID_MESH;
    }
  }
  return ABUT_SUCCESS;
}

/* Whether facet g runs along the side from node a to node b in this direction
 * (2D: whether it has node a at its end `end`). */
static bool
runs_along(const abut_surface *s, int32_t g, int32_t a, int32_t b)
{
  const int32_t *c = s->view.connectivity + s->view.facet_start[g];
  const int32_t n = abut_facet_n_corners((abut_facet_kind)s->view.kinds[g]);
  for (int32_t k = 0; k < n; ++k)
    if (c[abut_facet_loop(n, k)] == a && c[abut_facet_loop(n, k + 1)] == b)
      return true;
  return false;
}

/* Whether neighbours f and g across side k of f are oriented alike. */
static bool
oriented_alike(const abut_surface *s, int32_t f, int32_t k, int32_t g)
{
  const int32_t *c = s->view.connectivity + s->view.facet_start[f];
  const int32_t n = abut_facet_n_corners((abut_facet_kind)s->view.kinds[f]);
  if (n == 2)
    return s->view.connectivity[s->view.facet_start[g] + k] != c[k];
  return !runs_along(s, g, c[abut_facet_loop(n, k)],
                     c[abut_facet_loop(n, k + 1)]);
}

abut_status
abut_surface_check_orientation(const abut_surface *s)
{
  for (int32_t f = 0; f < s->view.n_facets; ++f)
    for (int32_t k = 0; k < 4; ++k)
    {
      const int32_t g = s->view.neighbour[4 * (int64_t)f + k];
      if (g > f && !oriented_alike(s, f, k, g))
      {
        abut_text text = begin_facet(s, "abut_surface_create", g);
        abut_text_add(&text, " is inverted with respect to its neighbour ");
        abut_text_add_integer(&text, f);
        return ABUT_INVALID_MESH;
      }
    }
  return ABUT_SUCCESS;
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Data of the nodes: checks, and which facets to look at. A facet has a share
 * in the rows of its free nodes. On quadratic facets, and at corners, the share
 * of a node depends on which neighbours are dropped, and that on all their
 * facets. */
#include "contact/discretisation.h"

#include <math.h>
#include <string.h>

static abut_status
fail_at(abut_coupling *c, abut_status status, const char *what, int64_t number)
{
  abut_text text = abut_fail_begin(c->context, "abut_coupling_build");
  abut_text_add(&text, what);
  abut_text_add_integer(&text, number);
  return status;
}

/* The lists of hanging nodes are complete and in range. */
static abut_status
check_ranges(abut_coupling *c)
{
  const abut_coupling_nodes *n = c->of_node.given;
  const int32_t n_nodes = c->secondary->view.n_nodes;
  if (n->n_hanging < 0)
    return fail_at(c, ABUT_INVALID_ARGUMENT, "n_hanging is ", n->n_hanging);
  if (n->n_hanging == 0)
    return ABUT_SUCCESS;
  if (n->hanging_node == NULL || n->hanging_start == NULL
      || n->hanging_parent == NULL || n->hanging_weight == NULL)
    return abut_fail(c->context, ABUT_INVALID_ARGUMENT, "abut_coupling_build",
                     "an array of hanging nodes is NULL");
  if (n->hanging_start[0] != 0)
    return abut_fail(c->context, ABUT_INVALID_ARGUMENT, "abut_coupling_build",
                     "hanging_start does not begin with 0");
  for (int32_t h = 0; h < n->n_hanging; ++h)
  {
    if (n->hanging_node[h] < 0 || n->hanging_node[h] >= n_nodes)
      return fail_at(c, ABUT_INVALID_ARGUMENT,
                     "no node has the number of hanging node ", h);
    if (n->hanging_start[h + 1] <= n->hanging_start[h])
      return fail_at(c, ABUT_INVALID_ARGUMENT,
                     "there are no parents of hanging node ", h);
    for (int32_t e = n->hanging_start[h]; e < n->hanging_start[h + 1]; ++e)
      if (n->hanging_parent[e] < 0 || n->hanging_parent[e] >= n_nodes)
        return fail_at(c, ABUT_INVALID_ARGUMENT,
                       "a parent is out of range, of hanging node ", h);
  }
  return ABUT_SUCCESS;
}

/* Weights add up to one, and no parent hangs. Also sets c->of_node.hanging. */
static abut_status
check_hanging(abut_coupling *c)
{
  const abut_coupling_nodes *n = c->of_node.given;
  int32_t *hanging = c->of_node.hanging.data;
  for (int32_t i = 0; i < c->secondary->view.n_nodes; ++i)
    hanging[i] = -1;
  for (int32_t h = 0; h < n->n_hanging; ++h)
  {
    if (hanging[n->hanging_node[h]] >= 0)
      return fail_at(c, ABUT_INVALID_ARGUMENT,
                     "twice a hanging node: ", n->hanging_node[h]);
    hanging[n->hanging_node[h]] = h;
  }
  for (int32_t h = 0; h < n->n_hanging; ++h)
  {
    double sum = 0.;
    for (int32_t e = n->hanging_start[h]; e < n->hanging_start[h + 1]; ++e)
    {
      sum += n->hanging_weight[e];
      if (!(fabs(n->hanging_weight[e]) <= ABUT_FACET_LIMIT))
        return fail_at(c, ABUT_NOT_FINITE,
                       "a weight is not finite, of hanging node ",
                       n->hanging_node[h]);
      if (hanging[n->hanging_parent[e]] >= 0)
        return fail_at(c, ABUT_INVALID_ARGUMENT,
                       "resolve chains first: a parent hangs itself, of "
                       "hanging node ",
                       n->hanging_node[h]);
    }
    if (!(fabs(sum - 1.) <= 1e-10))
      return fail_at(c, ABUT_INVALID_ARGUMENT,
                     "weights do not add up to one, of hanging node ",
                     n->hanging_node[h]);
  }
  return ABUT_SUCCESS;
}

/* Call visit for each free node of facet f; stops at nonzero. */
static int
visit_free(const abut_coupling *c, int32_t f,
           int (*visit)(const abut_coupling *c, int32_t node))
{
  const abut_surface_view *v = &c->secondary->view;
  const int32_t *hanging = c->of_node.hanging.data;
  for (int32_t e = v->facet_start[f]; e < v->facet_start[f + 1]; ++e)
  {
    const int32_t node = v->connectivity[e], h = hanging[node];
    if (h < 0)
    {
      if (visit(c, node))
        return 1;
      continue;
    }
    for (int32_t k = c->of_node.given->hanging_start[h];
         k < c->of_node.given->hanging_start[h + 1]; ++k)
      if (visit(c, c->of_node.given->hanging_parent[k]))
        return 1;
  }
  return 0;
}

static int
is_wanted(const abut_coupling *c, int32_t node)
{
  return c->of_node.given->wanted == NULL || c->of_node.given->wanted[node];
}

static int
mark(const abut_coupling *c, int32_t node)
{
  ((uint8_t *)c->of_node.flag.data)[node] = 1;
  return 0;
}

static int
is_marked(const abut_coupling *c, int32_t node)
{
  return ((const uint8_t *)c->of_node.flag.data)[node];
}

bool
abut_coupling_has_weak(const abut_coupling *c)
{
  return c->quadratic && c->options.multiplier_degree != 1
         && abut_coupling_is_mortar(c)
         && (c->obstacle == NULL || c->options.axisymmetric);
}

static int
is_marked_corner(const abut_coupling *c, int32_t node)
{
  return is_marked(c, node) && ((const uint8_t *)c->of_node.corner.data)[node];
}

void
abut_coupling_set_purpose(abut_coupling *c)
{
  const int32_t n = c->secondary->view.n_facets;
  const uint8_t *wanted_facet = c->of_node.given->wanted_facet;
  uint8_t *purpose = c->of_node.purpose.data;
  const bool points = c->method->info.row_per_point;
  const bool weak = abut_coupling_has_weak(c),
             drop = weak
                    || (c->primary != NULL && abut_coupling_is_mortar(c)
                        && abut_coupling_find_corners(c));
  for (int32_t f = 0; f < n; ++f)
  {
    const bool rows = points ? wanted_facet == NULL || wanted_facet[f]
                             : visit_free(c, f, is_wanted);
    purpose[f] = rows ? ABUT_COUPLING_FOR_ROWS : 0;
    if (drop && rows)
      visit_free(c, f, mark);
  }
  for (int32_t f = 0; f < n && drop; ++f)
    if (visit_free(c, f, weak ? is_marked : is_marked_corner))
      purpose[f] |= ABUT_COUPLING_FOR_DROPPING;
  c->of_node.drops = drop;
}

abut_status
abut_coupling_read_nodes(abut_coupling *c)
{
  const int64_t n = c->secondary->view.n_nodes;
  struct
  {
    abut_array *array;
    int64_t n;
  } const list[] = {{&c->of_node.hanging, n},
                    {&c->of_node.dropped_as_given, n},
                    {&c->of_node.dropped, n},
                    {&c->of_node.full, n},
                    {&c->of_node.covered, n},
                    {&c->of_node.hat, n},
                    {&c->of_node.covered_hat, n},
                    {&c->of_node.reach, n},
                    {&c->of_node.lone, n},
                    {&c->of_node.flag, n},
                    {&c->of_node.corner, n},
                    {&c->of_node.bend, 3 * n},
                    {&c->of_node.purpose, c->secondary->view.n_facets}};
  abut_status status = check_ranges(c);
  for (size_t i = 0;
       i < sizeof(list) / sizeof(list[0]) && status == ABUT_SUCCESS; ++i)
  {
    status = abut_array_reserve(c->context, list[i].array, 0, list[i].n + 1);
    if (status == ABUT_SUCCESS)
      memset(list[i].array->data, 0,
             (size_t)list[i].n * list[i].array->element);
  }
  if (status == ABUT_SUCCESS)
    status = check_hanging(c);
  if (status != ABUT_SUCCESS)
    return status;
  for (int64_t i = 0; c->of_node.given->dropped != NULL && i < n; ++i)
    ((uint8_t *)c->of_node.dropped_as_given.data)[i] =
        ((uint8_t *)c->of_node.dropped.data)[i] = c->of_node.given->dropped[i];
  return ABUT_SUCCESS;
}

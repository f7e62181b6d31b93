/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Add up the shares of each node to its row: O(shares + entries). Shares are
 * bucketed by node in the order of their making, which is that of the facets;
 * entries are summed in dense arrays and written in the order of the nodes'
 * numbers. */
#include "contact/discretisation.h"
#include "geometry/vector.h"

#include <string.h>

/* Weight of a row relative to the full one below which there is none. */
static const double smallest_weight = 1e-6;

/* Coefficients below this are round-off where matching meshes have zeros; they
 * would fill the matrix. */
static const double smallest_coefficient = 1e-12;

/* Bucket the shares by node. */
static abut_status
bucket(abut_coupling *c)
{
  const int32_t n = c->secondary->view.n_nodes;
  abut_status status =
      abut_array_reserve(c->context, &c->share_start, 0, (int64_t)n + 2);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(c->context, &c->share_list, 0, c->n_shares);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_coupling_share *s = c->shares.data;
  int64_t *start = c->share_start.data, *list = c->share_list.data;
  memset(start, 0, sizeof(*start) * ((size_t)n + 2));
  for (int64_t i = 0; i < c->n_shares; ++i)
    ++start[s[i].node + 2];
  for (int32_t i = 0; i < n; ++i)
    start[i + 2] += start[i + 1];
  for (int64_t i = 0; i < c->n_shares; ++i)
    list[start[s[i].node + 1]++] = i;
  return ABUT_SUCCESS;
}

/* Add entries to the dense sums of a side; returns the number of touched
 * nodes. */
static abut_status
scatter(abut_coupling *c, int side, const abut_coupling_entry *e, int32_t n,
        int32_t *n_touched)
{
  double *sum = c->sum[side].data;
  uint8_t *seen = c->seen[side].data;
  const abut_status status = abut_array_reserve(
      c->context, &c->touched, *n_touched, (int64_t)*n_touched + n);
  if (status != ABUT_SUCCESS)
    return status;
  int32_t *touched = c->touched.data;
  for (int32_t i = 0; i < n; ++i)
  {
    const int32_t node = e[i].node;
    if (!seen[node])
    {
      seen[node] = 1;
      sum[node] = 0.;
      touched[(*n_touched)++] = node;
    }
    sum[node] += e[i].value;
  }
  return ABUT_SUCCESS;
}

static void
sort_by_rank(int32_t *v, int32_t n, const int32_t *rank)
{
  for (int32_t i = 1; i < n; ++i)
  {
    const int32_t node = v[i];
    int32_t j = i;
    for (; j > 0 && rank[v[j - 1]] > rank[node]; --j)
      v[j] = v[j - 1];
    v[j] = node;
  }
}

/* Write the entries of a side, divided by their sum: the weight but for
 * round-off, which the cancellation of dual functions may magnify. */
static abut_status
gather(abut_coupling *c, int side, int32_t n_touched)
{
  double weight = 0.;
  const int32_t row = c->view.n_rows;
  int64_t *start = c->start[side].data;
  int32_t *touched = c->touched.data;
  uint8_t *seen = c->seen[side].data;
  const double *sum = c->sum[side].data;
  abut_status status = abut_array_reserve(c->context, &c->column[side],
                                          start[row], start[row] + n_touched);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(c->context, &c->coefficient[side], start[row],
                                start[row] + n_touched);
  if (status != ABUT_SUCCESS)
    return status;
  sort_by_rank(touched, n_touched,
               side == 0 ? c->node_rank.data : c->primary_node_rank.data);
  int32_t *column = c->column[side].data;
  double *coefficient = c->coefficient[side].data;
  int64_t end = start[row];
  for (int32_t i = 0; i < n_touched; ++i)
    weight += sum[touched[i]];
  const double least = smallest_coefficient * fabs(weight);
  weight = 0.;
  for (int32_t i = 0; i < n_touched; ++i)
  {
    const int32_t node = touched[i];
    seen[node] = 0;
    if (!(fabs(sum[node]) > least))
      continue;
    column[end] = node;
    coefficient[end++] = sum[node];
    weight += sum[node];
  }
  for (int64_t e = start[row]; e < end; ++e)
    coefficient[e] /= weight;
  start[row + 1] = end;
  return ABUT_SUCCESS;
}

static abut_status
add_entries(abut_coupling *c, int side, const int64_t *list, int64_t n)
{
  const abut_coupling_share *shares = c->shares.data;
  const abut_coupling_entry *entries = c->entries.data;
  int32_t n_touched = 0;
  for (int64_t i = 0; i < n; ++i)
  {
    const abut_coupling_share *s = shares + list[i];
    const abut_status status =
        scatter(c, side, entries + s->first + (side == 0 ? 0 : s->n_secondary),
                side == 0 ? s->n_secondary : s->n_primary, &n_touched);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return gather(c, side, n_touched);
}

/* The averaged normal of the node; where it leans away from the mean normal of
 * the covered part by more than half the feature angle, and at nodes without
 * facets, and against obstacles, that mean. */
static void
row_normal(abut_coupling *c, const abut_coupling_share *total, double *n)
{
  const int32_t dim = c->secondary->view.dimension;
  const double limit = cos(0.5 * c->secondary->feature_angle);
  double mean[3] = {total->normal[0], total->normal[1], total->normal[2]};
  const double length = unit3(mean, 0.);
  memcpy(n, mean, sizeof(mean));
  if (total->node < 0 || c->obstacle != NULL || !abut_coupling_is_mortar(c))
    return;
  double average[3] = {0., 0., 0.};
  for (int32_t d = 0; d < dim; ++d)
    average[d] = c->normals[(int64_t)dim * total->node + d];
  c->statistics.n_bent += length < limit * total->weight;
  if (dot3(average, mean) >= limit)
    memcpy(n, average, sizeof(average));
  else
    ++c->statistics.n_split;
}

static abut_status
reserve_row(abut_coupling *c)
{
  const int64_t row = c->view.n_rows, dim = c->secondary->view.dimension;
  struct
  {
    abut_array *array;
    int64_t per_row, extra;
  } const list[] = {{&c->row_node, 1, 0},     {&c->row_facet, 1, 0},
                    {&c->row_point, 1, 0},    {&c->row_weight, 1, 0},
                    {&c->row_full, 1, 0},     {&c->row_gap, 1, 0},
                    {&c->row_normal, dim, 0}, {&c->row_position, dim, 0},
                    {&c->start[0], 1, 1},     {&c->start[1], 1, 1}};
  for (size_t i = 0; i < sizeof(list) / sizeof(list[0]); ++i)
  {
    const abut_status status = abut_array_reserve(
        c->context, list[i].array, row * list[i].per_row + list[i].extra,
        (row + 1) * list[i].per_row + list[i].extra);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

/* Write the row of the shares list[n] with sum total. */
static abut_status
add_row(abut_coupling *c, const int64_t *list, int64_t n,
        const abut_coupling_share *total, double full)
{
  const int32_t row = c->view.n_rows, dim = c->secondary->view.dimension;
  double normal[3];
  abut_status status = reserve_row(c);
  if (status != ABUT_SUCCESS)
    return status;
  row_normal(c, total, normal);
  const double *position = total->node >= 0 ? c->secondary->view.position
                                                  + (int64_t)dim * total->node
                                            : total->position;
  const double gap =
      c->obstacle != NULL ? total->distance : dot3(normal, total->gap);
  ((int32_t *)c->row_node.data)[row] = total->node;
  ((int32_t *)c->row_facet.data)[row] =
      abut_coupling_is_mortar(c) ? -1 : total->facet;
  ((int32_t *)c->row_point.data)[row] = total->point;
  ((double *)c->row_weight.data)[row] = total->weight;
  ((double *)c->row_full.data)[row] = full;
  ((double *)c->row_gap.data)[row] = gap / total->weight;
  for (int32_t d = 0; d < dim; ++d)
  {
    ((double *)c->row_normal.data)[row * (int64_t)dim + d] = normal[d];
    ((double *)c->row_position.data)[row * (int64_t)dim + d] = position[d];
  }
  for (int side = 0; side < 2 && status == ABUT_SUCCESS; ++side)
    status = add_entries(c, side, list, n);
  if (status != ABUT_SUCCESS)
    return status;
  c->statistics.covered_area += total->weight;
  ++c->view.n_rows;
  return ABUT_SUCCESS;
}

static void
add_up(const abut_coupling *c, const int64_t *list, int64_t n,
       abut_coupling_share *total)
{
  const abut_coupling_share *shares = c->shares.data;
  *total = shares[list[0]];
  for (int64_t i = 1; i < n; ++i)
  {
    const abut_coupling_share *s = shares + list[i];
    total->weight += s->weight;
    total->distance += s->distance;
    for (int d = 0; d < 3; ++d)
    {
      total->gap[d] += s->gap[d];
      total->normal[d] += s->normal[d];
    }
  }
}

/* Rows of nodes, in the order of their numbers. */
static abut_status
node_rows(abut_coupling *c)
{
  const int64_t *start = c->share_start.data, *list = c->share_list.data;
  const int32_t *order = c->node_order.data;
  const double *full = c->full.data, *reach = c->row_reach.data;
  for (int32_t i = 0; i < c->secondary->view.n_nodes; ++i)
  {
    const int32_t node = order[i];
    const int64_t n = start[node + 1] - start[node];
    if (n == 0)
      continue;
    abut_coupling_share total;
    add_up(c, list + start[node], n, &total);
    if (!(total.weight > smallest_weight * full[node]))
    {
      ++c->statistics.n_weak;
      continue;
    }
    if (c->obstacle != NULL && total.distance > reach[node] * total.weight)
      continue;
    const abut_status status =
        add_row(c, list + start[node], n, &total, full[node]);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

/* Rows of quadrature points: a share each. */
static abut_status
point_rows(abut_coupling *c)
{
  const abut_coupling_share *shares = c->shares.data;
  for (int64_t i = 0; i < c->n_shares; ++i)
  {
    if (!(shares[i].weight > 0.))
      continue;
    const abut_status status = add_row(c, &i, 1, shares + i, shares[i].weight);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

static abut_status
reserve_sums(abut_coupling *c)
{
  for (int side = 0; side < 2; ++side)
  {
    const abut_surface *s = side == 0 ? c->secondary : c->primary;
    const int64_t n = s != NULL ? s->view.n_nodes : 0;
    abut_status status =
        abut_array_reserve(c->context, &c->sum[side], 0, n + 1);
    if (status == ABUT_SUCCESS)
      status = abut_array_reserve(c->context, &c->seen[side], 0, n + 1);
    if (status == ABUT_SUCCESS)
      status = abut_array_reserve(c->context, &c->start[side], 0, 1);
    if (status != ABUT_SUCCESS)
      return status;
    memset(c->seen[side].data, 0, (size_t)n);
    *(int64_t *)c->start[side].data = 0;
  }
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_make_rows(abut_coupling *c)
{
  abut_status status = reserve_sums(c);
  if (status == ABUT_SUCCESS && c->method->info.row_per_point)
    status = point_rows(c);
  else if (status == ABUT_SUCCESS)
  {
    status = bucket(c);
    if (status == ABUT_SUCCESS)
      status = node_rows(c);
  }
  if (status != ABUT_SUCCESS)
    return status;
  abut_coupling_view *v = &c->view;
  v->node = c->row_node.data;
  v->facet = c->row_facet.data;
  v->point = c->row_point.data;
  v->weight = c->row_weight.data;
  v->full_weight = c->row_full.data;
  v->gap = c->row_gap.data;
  v->normal = c->row_normal.data;
  v->position = c->row_position.data;
  v->secondary_start = c->start[0].data;
  v->secondary_node = c->column[0].data;
  v->secondary_coefficient = c->coefficient[0].data;
  v->primary_start = c->start[1].data;
  v->primary_node = c->column[1].data;
  v->primary_coefficient = c->coefficient[1].data;
  return ABUT_SUCCESS;
}

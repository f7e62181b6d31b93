/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Add up the shares of each node to its point, written into the caller's set:
 * O(shares + entries). Shares are bucketed by node in the order of their
 * making, which is that of the facets; entries are summed in dense arrays and
 * written in the order of the nodes' numbers. */
#include "contact/discretisation.h"
#include "geometry/vector.h"

#include <string.h>

/* Weight of a point relative to the full one below which the point is dropped.
 */
static const double smallest_weight = 1e-6;

/* The same of mortar that follows: nodes that are covered less come and go
 * within a step, and with rows at wholly covered ones alone the corner of a die
 * would sink in. */
static const double smallest_share = 0.2;

/* Coefficients below this are round-off where matching meshes have zeros; they
 * would fill the matrix. */
static const double smallest_coefficient = 1e-12;

/* Bucket the shares by node. */
static abut_status
bucket(abut_coupling *c)
{
  const int32_t n = c->secondary->view.n_nodes;
  abut_status status =
      abut_array_reserve(c->context, &c->sum.share_start, 0, (int64_t)n + 2);
  if (status == ABUT_SUCCESS)
    status =
        abut_array_reserve(c->context, &c->sum.share_list, 0, c->sum.n_shares);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_coupling_share *s = c->sum.shares.data;
  int64_t *start = c->sum.share_start.data, *list = c->sum.share_list.data;
  memset(start, 0, sizeof(*start) * ((size_t)n + 2));
  for (int64_t i = 0; i < c->sum.n_shares; ++i)
    ++start[s[i].node + 2];
  for (int32_t i = 0; i < n; ++i)
    start[i + 2] += start[i + 1];
  for (int64_t i = 0; i < c->sum.n_shares; ++i)
    list[start[s[i].node + 1]++] = i;
  return ABUT_SUCCESS;
}

/* Add entries to the dense sums of a side; returns the number of touched
 * nodes. */
static abut_status
scatter(abut_coupling *c, int side, const abut_coupling_entry *e, int32_t n,
        int32_t *n_touched)
{
  double *sum = c->sum.of_node[side].data;
  uint8_t *seen = c->sum.seen[side].data;
  const abut_status status = abut_array_reserve(
      c->context, &c->sum.touched, *n_touched, (int64_t)*n_touched + n);
  if (status != ABUT_SUCCESS)
    return status;
  int32_t *touched = c->sum.touched.data;
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

/* Write the entries of a side behind the first *n of the stencil, divided by
 * their sum: the weight but for round-off, which the cancellation of dual
 * functions may magnify. Entries of the primary are negative. */
static abut_status
gather(abut_coupling *c, int side, int32_t n_touched, int32_t *n)
{
  double weight = 0.;
  int32_t *touched = c->sum.touched.data;
  uint8_t *seen = c->sum.seen[side].data;
  const double *sum = c->sum.of_node[side].data;
  const int32_t first = *n;
  abut_status status = abut_array_reserve(c->context, &c->made.stencil_node,
                                          first, (int64_t)first + n_touched);
  if (status == ABUT_SUCCESS)
    status = abut_array_reserve(c->context, &c->made.stencil_coefficient, first,
                                (int64_t)first + n_touched);
  if (status != ABUT_SUCCESS)
    return status;
  sort_by_rank(touched, n_touched,
               side == 0 ? c->order.node_rank.data
                         : c->order.primary_node_rank.data);
  int32_t *stencil = c->made.stencil_node.data;
  double *coefficient = c->made.stencil_coefficient.data;
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
    stencil[*n] = abut_coupling_number(c, side, node);
    coefficient[(*n)++] = sum[node];
    weight += sum[node];
  }
  for (int32_t e = first; e < *n; ++e)
    coefficient[e] /= side == 0 ? weight : -weight;
  return ABUT_SUCCESS;
}

static abut_status
add_entries(abut_coupling *c, int side, const int64_t *list, int64_t n,
            int32_t *n_stencil)
{
  const abut_coupling_share *shares = c->sum.shares.data;
  const abut_coupling_entry *entries = c->sum.entries.data;
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
  return gather(c, side, n_touched, n_stencil);
}

/* The averaged normal of the node; where it leans away from the mean normal of
 * the covered part by more than half the feature angle, and at nodes without
 * facets, and against obstacles, that mean. */
static void
normal_of(abut_coupling *c, const abut_coupling_share *total, double *n)
{
  if (abut_coupling_moves(c))
  {
    /* Minus the gradient of the gap as it is. */
    for (int d = 0; d < 3; ++d)
      n[d] = total->normal[d] / total->weight;
    return;
  }
  const int32_t dim = c->secondary->view.dimension;
  const double limit = cos(0.5 * c->secondary->feature_angle);
  double mean[3] = {total->normal[0], total->normal[1], total->normal[2]};
  const double length = unit3(mean, 0.);
  memcpy(n, mean, sizeof(mean));
  if (total->node < 0 || c->obstacle != NULL || !abut_coupling_is_mortar(c))
    return;
  double average[3] = {0., 0., 0.};
  for (int32_t d = 0; d < dim; ++d)
    average[d] = c->of_node.normal[(int64_t)dim * total->node + d];
  c->statistics.n_bent += length < limit * total->weight;
  if (dot3(average, mean) >= limit)
    memcpy(n, average, sizeof(average));
  else
    ++c->statistics.n_split;
}

/* The second derivatives of a point that moves, and what its tangents do. */
static abut_status
record_hessian(abut_coupling *c, const abut_coupling_share *total)
{
  const int64_t i = c->view.n_points;
  const int32_t dim = c->secondary->view.dimension,
                n_nodes = total->primary < 0 ? 0 : total->n_primary,
                n = dim * (1 + n_nodes);
  abut_status status = abut_array_reserve(c->context, &c->made.hessian_start,
                                          i > 0 ? i + 1 : 0, i + 2);
  if (status != ABUT_SUCCESS)
    return status;
  int64_t *start = c->made.hessian_start.data;
  start[0] = 0;
  start[i + 1] = start[i] + (int64_t)n * n * (c->target->tangents ? dim : 1);
  status =
      abut_array_reserve(c->context, &c->made.hessian, start[i], start[i + 1]);
  if (status != ABUT_SUCCESS)
    return status;
  double *hessian = (double *)c->made.hessian.data + start[i];
  memcpy(hessian, (const double *)c->answer.hessian.data + total->hessian,
         sizeof(double) * (size_t)(n * n));
  if (!c->target->tangents)
    return ABUT_SUCCESS;
  const abut_coupling_entry *e =
      (const abut_coupling_entry *)c->sum.entries.data + total->first
      + total->n_secondary;
  double shape[ABUT_FACET_MAX_NODES], normal[3], unit[3], auxiliary[3];
  for (int32_t a = 0; a < n_nodes; ++a)
    shape[a] = e[a].value / total->weight;
  for (int d = 0; d < 3; ++d)
    unit[d] = normal[d] = total->normal[d] / total->weight;
  unit3(unit, 0.);
  (void)abut_coupling_auxiliary_vector(c, total, unit, auxiliary);
  abut_coupling_tangent_derivatives(dim, n, normal, auxiliary, shape, hessian,
                                    hessian + n * n);
  return ABUT_SUCCESS;
}

/* Remember what the set does not hold. */
static abut_status
record_point(abut_coupling *c, const abut_coupling_share *total, double full)
{
  const int64_t i = c->view.n_points, dim = c->secondary->view.dimension;
  struct
  {
    abut_array *array;
    int64_t each;
  } const list[] = {{&c->made.node, 1},      {&c->made.facet, 1},
                    {&c->made.number, 1},    {&c->made.full, 1},
                    {&c->made.least, 1},     {&c->made.primary, 1},
                    {&c->made.position, dim}};
  for (size_t k = 0; k < sizeof(list) / sizeof(list[0]); ++k)
  {
    const abut_status status = abut_array_reserve(
        c->context, list[k].array, i * list[k].each, (i + 1) * list[k].each);
    if (status != ABUT_SUCCESS)
      return status;
  }
  const double *position = total->node >= 0
                               ? c->secondary->view.position + dim * total->node
                               : total->position;
  ((int32_t *)c->made.node.data)[i] = total->node;
  ((int32_t *)c->made.facet.data)[i] =
      abut_coupling_is_mortar(c) ? -1 : total->facet;
  ((int32_t *)c->made.number.data)[i] = total->point;
  ((int32_t *)c->made.primary.data)[i] = total->primary;
  ((double *)c->made.full.data)[i] = full;
  ((double *)c->made.least.data)[i] = total->least;
  memcpy((double *)c->made.position.data + i * dim, position,
         sizeof(double) * (size_t)dim);
  return abut_coupling_moves(c) ? record_hessian(c, total) : ABUT_SUCCESS;
}

static int64_t
id_of(const abut_coupling *c, const abut_coupling_share *total)
{
  const int64_t *id = c->target->id;
  if (total->node >= 0)
    return id != NULL ? id[total->node] : total->node;
  const int64_t first =
      id != NULL ? id[total->facet]
                 : (int64_t)total->facet * ABUT_COUPLING_POINTS_PER_FACET;
  /* Components have numbers of their own. */
  const int32_t each = c->target->tangents ? c->secondary->view.dimension : 1;
  return first + (int64_t)each * total->point;
}

/* The gap of a point of contact along its normal. */
static double
gap_of(const abut_coupling *c, const abut_coupling_share *total,
       const double *normal)
{
  const double distance =
      c->obstacle != NULL || abut_coupling_moves(c)
          ? total->distance
          : dot3(normal, total->gap) + dot3(normal, total->offset);
  return c->target->flush ? 0. : distance / total->weight;
}

/* The same of mortar whose partners stay, where the surfaces are; of those that
 * count as touching, what it has changed by. */
static double
present_gap(abut_coupling *c, const int64_t *list, int64_t n,
            const abut_coupling_share *total, const double *normal)
{
  double way[3], before[3];
  abut_coupling_gap(c, list, n, true, way);
  const abut_coupling_statistics counted = c->statistics;
  normal_of(c, total, before);
  c->statistics = counted;
  if (!c->target->flush)
    return dot3(normal, way) + dot3(before, total->offset) / total->weight;
  const double now = dot3(normal, way);
  abut_coupling_gap(c, list, n, false, way);
  return now - dot3(before, way);
}

/* Add the tangents of a unit normal to a frame, if they are wanted. Returns the
 * number of components. */
static int32_t
add_tangents(const abut_coupling *c, const abut_coupling_share *total,
             const double *unit, double *frame)
{
  const int32_t dim = c->secondary->view.dimension;
  double auxiliary[3];
  if (!c->target->tangents)
    return 1;
  (void)abut_coupling_auxiliary_vector(c, total, unit, auxiliary);
  abut_coupling_tangents(dim, unit, auxiliary, frame + dim);
  return dim;
}

/* Frame and gaps, and how they change, of a point of mortar that moves. */
static abut_status
fill_turning(abut_coupling *c, const int64_t *list, int64_t n,
             const abut_coupling_share *total, double *frame, double *gap,
             int32_t *n_components)
{
  abut_coupling_direction direction;
  abut_status status = abut_coupling_direct(c, list, n, total, &direction);
  if (status == ABUT_SUCCESS)
    status = abut_coupling_record_block(c, list, n, total, &direction);
  if (status != ABUT_SUCCESS)
    return status;
  memcpy(frame, direction.normal,
         sizeof(double) * (size_t)c->secondary->view.dimension);
  *n_components = add_tangents(c, total, direction.normal, frame);
  gap[0] = c->target->gap
           + (abut_coupling_follows(c)
                  ? gap_of(c, total, direction.normal)
                  : present_gap(c, list, n, total, direction.normal));
  gap[1] = gap[2] = 0.;
  return ABUT_SUCCESS;
}

/* Frame and gaps of a point: the normal, or the axes of a tie. */
static int32_t
fill_components(abut_coupling *c, const abut_coupling_share *total,
                double *frame, double *gap)
{
  const abut_coupling_target *t = c->target;
  const int32_t dim = c->secondary->view.dimension;
  double normal[3];
  normal_of(c, total, normal);
  if (t->tie_axes == 0)
  {
    memcpy(frame, normal, sizeof(double) * (size_t)dim);
    gap[0] = t->gap + gap_of(c, total, normal);
    gap[1] = gap[2] = 0.;
    if (abut_coupling_moves(c)) /* the tangents are unit vectors all the same */
      unit3(normal, 0.);
    return add_tangents(c, total, normal, frame);
  }
  int32_t n = 0;
  for (int32_t axis = 0; axis < dim; ++axis)
    if (t->tie_axes >> axis & 1u)
    {
      for (int32_t d = 0; d < dim; ++d)
        frame[n * dim + d] = d == axis;
      gap[n++] = 0.;
    }
  return n;
}

/* Append the point of the shares list[n] with sum total. */
static abut_status
add_point(abut_coupling *c, const int64_t *list, int64_t n,
          const abut_coupling_share *total, double full)
{
  double frame[9], gap[3];
  abut_status status = record_point(c, total, full);
  if (status != ABUT_SUCCESS)
    return status;
  abut_point point = abut_point_defaults();
  point.id = id_of(c, total);
  point.kind = c->target->tie_axes == 0 ? ABUT_POINT_CONTACT : ABUT_POINT_TIE;
  point.n_components = 1;
  if (abut_coupling_has_current_directions(c))
    status = fill_turning(c, list, n, total, frame, gap, &point.n_components);
  else
    point.n_components = fill_components(c, total, frame, gap);
  if (status != ABUT_SUCCESS)
    return status;
  point.weight = total->weight;
  point.frame = frame;
  point.gap = gap;
  status = add_entries(c, 0, list, n, &point.n_nodes);
  point.n_secondary = point.n_nodes;
  if (status == ABUT_SUCCESS)
    status = add_entries(c, 1, list, n, &point.n_nodes);
  point.node = c->made.stencil_node.data;
  point.coefficient = c->made.stencil_coefficient.data;
  if (status == ABUT_SUCCESS)
    status = abut_points_append(c->target->points, &point);
  if (status != ABUT_SUCCESS)
    return status;
  c->statistics.covered_area += total->weight;
  ++c->view.n_points;
  return ABUT_SUCCESS;
}

static void
add_up(const abut_coupling *c, const int64_t *list, int64_t n,
       abut_coupling_share *total)
{
  const abut_coupling_share *shares = c->sum.shares.data;
  *total = shares[list[0]];
  for (int64_t i = 1; i < n; ++i)
  {
    const abut_coupling_share *s = shares + list[i];
    total->weight += s->weight;
    total->distance += s->distance;
    total->least = fmin(total->least, s->least);
    for (int d = 0; d < 3; ++d)
    {
      total->gap[d] += s->gap[d];
      total->offset[d] += s->offset[d];
      total->normal[d] += s->normal[d];
    }
  }
}

/* Points of nodes, in the order of their numbers. */
static abut_status
node_points(abut_coupling *c)
{
  const int64_t *start = c->sum.share_start.data,
                *list = c->sum.share_list.data;
  const int32_t *order = c->order.node.data;
  const double *full = c->of_node.full.data, *reach = c->of_node.reach.data;
  const double smallest = abut_coupling_follows(c) && !abut_coupling_has_weak(c)
                              ? smallest_share
                              : smallest_weight;
  for (int32_t i = 0; i < c->secondary->view.n_nodes; ++i)
  {
    const int32_t node = order[i];
    const int64_t n = start[node + 1] - start[node];
    if (n == 0)
      continue;
    abut_coupling_share total;
    add_up(c, list + start[node], n, &total);
    if (!(total.weight > smallest * full[node]))
    {
      ++c->statistics.n_weak;
      continue;
    }
    if (c->obstacle != NULL && total.distance > reach[node] * total.weight)
      continue;
    const abut_status status =
        add_point(c, list + start[node], n, &total, full[node]);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

/* Quadrature points: a share each. */
static abut_status
quadrature_points(abut_coupling *c)
{
  const abut_coupling_share *shares = c->sum.shares.data;
  for (int64_t i = 0; i < c->sum.n_shares; ++i)
  {
    if (!(shares[i].weight > 0.))
      continue;
    const abut_status status =
        add_point(c, &i, 1, shares + i, shares[i].weight);
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
        abut_array_reserve(c->context, &c->sum.of_node[side], 0, n + 1);
    if (status == ABUT_SUCCESS)
      status = abut_array_reserve(c->context, &c->sum.seen[side], 0, n + 1);
    if (status != ABUT_SUCCESS)
      return status;
    memset(c->sum.seen[side].data, 0, (size_t)n);
  }
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_append(abut_coupling *c)
{
  abut_status status = reserve_sums(c);
  if (status == ABUT_SUCCESS && c->method->info.row_per_point)
    status = quadrature_points(c);
  else if (status == ABUT_SUCCESS)
  {
    status = bucket(c);
    if (status == ABUT_SUCCESS)
      status = node_points(c);
  }
  if (status != ABUT_SUCCESS)
    return status;
  abut_coupling_view *v = &c->view;
  v->node = c->made.node.data;
  v->facet = c->made.facet.data;
  v->point = c->made.number.data;
  v->full_weight = c->made.full.data;
  v->full_of_node = c->of_node.full.data;
  v->position = c->made.position.data;
  const bool turns = abut_coupling_has_current_directions(c),
             moves = turns || abut_coupling_moves(c);
  v->hessian = moves ? c->made.hessian.data : NULL;
  v->hessian_start = moves ? c->made.hessian_start.data : NULL;
  v->line_start = turns ? c->made.line_start.data : NULL;
  v->line = turns ? c->made.line.data : NULL;
  v->column_start = turns ? c->made.column_start.data : NULL;
  v->column = turns ? c->made.column.data : NULL;
  v->primary = c->made.primary.data;
  v->least = abut_coupling_follows(c) ? c->made.least.data : NULL;
  return ABUT_SUCCESS;
}

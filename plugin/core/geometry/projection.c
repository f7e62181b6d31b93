/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Public projection calls: argument checks around the kernels. */
#include "base/sized.h"
#include "geometry/kernels.h"
#include <string.h>

abut_status
abut_facet_project(abut_facet_kind kind, const double *nodes, const double *x,
                   abut_projection *projection)
{
  const int32_t n = abut_facet_n_nodes(kind),
                dimension = abut_facet_dimension(kind);
  if (n == 0 || !nodes || !x || !projection)
    return ABUT_INVALID_ARGUMENT;
  if (!abut_facet_finite(nodes, n * dimension)
      || !abut_facet_finite(x, dimension))
    return ABUT_NOT_FINITE;
  abut_project(kind, nodes, x, projection);
  return ABUT_SUCCESS;
}

static int
within(const int32_t *number, int64_t n, int32_t end)
{
  for (int64_t i = 0; i < n; ++i)
    if (number[i] < 0 || number[i] >= end)
      return 0;
  return 1;
}

static abut_status
check_batch(const abut_projection_batch *b)
{
  const int32_t n = abut_facet_n_nodes(b->kind),
                dimension = abut_facet_dimension(b->kind);
  if (n == 0 || b->n_points < 0 || b->n_nodes < 0 || b->n_facets < 0
      || b->n_pairs < 0)
    return ABUT_INVALID_ARGUMENT;
  if (b->n_pairs == 0)
    return ABUT_SUCCESS;
  if (!b->points || !b->positions || !b->facet_nodes || !b->pair_point
      || !b->pair_facet)
    return ABUT_INVALID_ARGUMENT;
  if (!within(b->facet_nodes, (int64_t)n * b->n_facets, b->n_nodes)
      || !within(b->pair_point, b->n_pairs, b->n_points)
      || !within(b->pair_facet, b->n_pairs, b->n_facets))
    return ABUT_INVALID_ARGUMENT;
  for (int64_t i = 0; i < b->n_points; ++i)
    if (!abut_facet_finite(b->points + i * dimension, dimension))
      return ABUT_NOT_FINITE;
  for (int64_t i = 0; i < b->n_nodes; ++i)
    if (!abut_facet_finite(b->positions + i * dimension, dimension))
      return ABUT_NOT_FINITE;
  return ABUT_SUCCESS;
}

static void
store(const abut_projection_batch *b, int64_t i, int32_t dimension,
      const abut_projection *p)
{
  if (b->local)
    memcpy(b->local + i * (dimension - 1), p->local,
           sizeof(double) * (size_t)(dimension - 1));
  if (b->gap)
    b->gap[i] = p->gap;
  if (b->distance)
    b->distance[i] = p->distance;
  if (b->violation)
    b->violation[i] = p->violation;
  if (b->normal)
    memcpy(b->normal + i * dimension, p->normal,
           sizeof(double) * (size_t)dimension);
  if (b->inside)
    b->inside[i] = p->inside;
}

abut_status
abut_facet_project_batch(const abut_projection_batch *batch)
{
  abut_projection_batch taken;
  memset(&taken, 0, sizeof(taken));
  if (batch == NULL || abut_sized_read(&taken, sizeof(taken), batch) != NULL)
    return ABUT_INVALID_ARGUMENT;
  const abut_projection_batch *b = &taken;
  const abut_status status = check_batch(b);
  if (status != ABUT_SUCCESS)
    return status;
  const int32_t n = abut_facet_n_nodes(b->kind),
                dimension = abut_facet_dimension(b->kind);
  for (int64_t i = 0; i < b->n_pairs; ++i)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES];
    const int32_t *facet = b->facet_nodes + (int64_t)n * b->pair_facet[i];
    for (int32_t a = 0; a < n; ++a)
      for (int32_t d = 0; d < dimension; ++d)
        nodes[a * dimension + d] =
            b->positions[(int64_t)facet[a] * dimension + d];
    abut_projection p;
    abut_project(b->kind, nodes,
                 b->points + (int64_t)b->pair_point[i] * dimension, &p);
    store(b, i, dimension, &p);
  }
  return ABUT_SUCCESS;
}

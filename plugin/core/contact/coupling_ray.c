/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Points against the primary along the secondary's mean normal, so that the
 * forces of a row have no moment: those of a rule over the whole facet, each
 * with the nearest primary facet on the line through it (lines that miss all
 * facets leave their points uncovered; O(points * candidates)), or those of
 * segments, each with the primary facet of its segment. */
#include "contact/coupling.h"
#include "geometry/measure.h"
#include "geometry/pull_back.h"
#include "geometry/vector.h"

#include <string.h>

/* Local coordinates outside by less than this are inside: a line through the
 * common edge of two facets must not fall between them by round-off. */
static const double edge_tolerance = 1e-10;

/* Where the line x + t normal meets a facet: local coordinates and t. */
static int
meet(const double *normal, double (*e)[3], abut_facet_kind kind,
     const double *nodes, const double *x, double *local, double *gap)
{
  const int n = abut_facet_n_nodes(kind), dim = abut_facet_dimension(kind);
  double flat[2 * ABUT_FACET_MAX_NODES], shape[ABUT_FACET_MAX_NODES];
  const double origin[2] = {0., 0.};
  for (int a = 0; a < n; ++a)
    for (int k = 0; k < dim - 1; ++k)
    {
      double *f = flat + a * (dim - 1) + k;
      *f = 0.;
      for (int d = 0; d < dim; ++d)
        *f += e[k][d] * (nodes[a * dim + d] - x[d]);
    }
  if (!abut_pull_back(kind, flat, origin, local, NULL)
      || abut_local_violation(kind, local) > edge_tolerance)
    return 0;
  abut_coupling_shape(kind, NULL, local, shape, NULL);
  *gap = 0.;
  for (int a = 0; a < n; ++a)
    for (int d = 0; d < dim; ++d)
      *gap += shape[a] * normal[d] * (nodes[a * dim + d] - x[d]);
  return 1;
}

/* Give a point its opposite point along a unit normal, or leave it without. */
static void
find_opposite(const abut_coupling *c, const double *direction, double (*e)[3],
              int32_t n_candidates, abut_coupling_point *p)
{
  const int32_t *candidate = c->work.candidates.data;
  double least = INFINITY;
  for (int32_t k = 0; k < n_candidates; ++k)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES], local[2], gap, normal[3];
    const int32_t m = candidate[k];
    const abut_facet_kind kind = (abut_facet_kind)c->primary->view.kinds[m];
    abut_surface_gather(c->primary, m, nodes);
    if (!meet(direction, e, kind, nodes, p->position, local, &gap)
        || !(fabs(gap) < least)
        || !abut_coupling_in_reach(c, gap,
                                   abut_surface_longest_side(kind, nodes)))
      continue;
    abut_coupling_normal(kind, nodes, local, normal);
    if (!(dot3(normal, direction) <= c->options.normal_cosine))
      continue;
    least = fabs(gap);
    p->primary = m;
    abut_coupling_shape(kind, NULL, local, p->opposite, NULL);
    for (int d = 0; d < 3; ++d)
      p->gap[d] = gap * direction[d];
  }
}

bool
abut_coupling_intersect_line(const abut_coupling *c, const double *x,
                             const double *normal, int32_t n_candidates,
                             double *gap)
{
  double e[2][3];
  abut_coupling_point p = {.primary = -1};
  for (int d = 0; d < c->view.dimension; ++d)
    p.position[d] = x[d];
  abut_plane_basis(c->view.dimension, normal, e);
  find_opposite(c, normal, e, n_candidates, &p);
  memcpy(gap, p.gap, sizeof(p.gap));
  return p.primary >= 0;
}

void
abut_coupling_find_opposites(abut_coupling *c, const abut_coupling_facet *facet)
{
  double e[2][3];
  abut_coupling_point *p = c->work.points.data;
  abut_plane_basis(c->view.dimension, facet->normal, e);
  for (int32_t q = 0; q < c->work.n_points; ++q)
  {
    double nodes[3 * ABUT_FACET_MAX_NODES], local[2], gap;
    const abut_facet_kind kind =
        (abut_facet_kind)c->primary->view.kinds[p[q].primary];
    p[q].number = q;
    abut_surface_gather(c->primary, p[q].primary, nodes);
    /* At the border of a curved facet the line may pass by: then the point
     * keeps the opposite point of its segment. */
    if (!meet(facet->normal, e, kind, nodes, p[q].position, local, &gap))
      continue;
    abut_coupling_shape(kind, NULL, local, p[q].opposite, NULL);
    for (int d = 0; d < 3; ++d)
      p[q].gap[d] = gap * facet->normal[d];
  }
}

abut_status
abut_coupling_rays(abut_coupling *c, const abut_coupling_facet *facet,
                   bool final)
{
  int32_t n_candidates, n = 0;
  double e[2][3];
  abut_status status =
      abut_coupling_find_candidates(c, facet->index, &n_candidates);
  if (status == ABUT_SUCCESS)
    status = abut_coupling_whole(c, facet);
  if (status != ABUT_SUCCESS)
    return status;
  abut_coupling_point *points = c->work.points.data;
  abut_plane_basis(c->view.dimension, facet->normal, e);
  for (int32_t q = 0; q < c->work.n_points; ++q)
  {
    find_opposite(c, facet->normal, e, n_candidates, points + q);
    if (points[q].primary >= 0)
      points[n++] = points[q];
  }
  c->work.n_points = n;
  c->statistics.n_pairs += final ? n : 0;
  return ABUT_SUCCESS;
}

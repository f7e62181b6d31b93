/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Gaps of dual mortar: those of an interpolant.
 *
 * Dual functions are negative on a part of each facet, so that the weighted
 * mean of a convex gap is too small: with psi = 2 - 3 s on [0, 1] that of s^2
 * is -1/6, and a flat facet of length h would touch a surface of curvature k
 * that is k h^2 / 12 away. The rows keep their coefficients, but their gaps
 * are integrals of
 *
 *     I g = sum_l phi_l g_l ,    int psi_j I g = sum_l D_jl g_l
 *
 * with the gaps g_l at the free nodes, along the normals there. Gaps that are
 * linear on the facet do not change, and no gap is smaller than the least one
 * on the surface. The difference int psi_j (I - 1) g is a constant of the row:
 * its derivatives stay those of the weighted gap, and matrices symmetric.
 *
 * Where a node has nothing opposite the weighted gap stays, but no smaller
 * than the least gap at the points of integration. */
#include "contact/discretisation.h"
#include "geometry/vector.h"

#include <math.h>
#include <string.h>

bool
abut_coupling_interpolates(const abut_coupling *c)
{
  return c->method->dual && c->options.interpolated_gaps
         && !abut_coupling_follows(c);
}

abut_status
abut_coupling_find_node_gaps(abut_coupling *c, const abut_coupling_facet *facet,
                             const abut_coupling_functions *f,
                             abut_coupling_node_gaps *gaps)
{
  const int64_t dim = c->view.dimension;
  const double *position = c->secondary->view.position;
  int32_t n_candidates = 0;
  memset(gaps, 0, sizeof(*gaps));
  if (c->obstacle == NULL)
  {
    const abut_status status =
        abut_coupling_find_candidates(c, facet->index, &n_candidates);
    if (status != ABUT_SUCCESS)
      return status;
  }
  for (int32_t l = 0; l < f->n; ++l)
  {
    const int32_t node = f->node[l];
    double normal[3];
    gaps->found[l] = c->obstacle != NULL;
    if (c->obstacle != NULL)
    {
      gaps->gap[l][0] = ((const double *)c->answer.distance.data)[node];
      continue;
    }
    abut_coupling_node_normal(c, facet, node, normal);
    gaps->found[l] = abut_coupling_intersect_line(
        c, position + dim * node, normal, n_candidates, gaps->gap[l]);
  }
  return ABUT_SUCCESS;
}

/* The weighted gap of a share, no smaller than the least one at its points. */
static double
bounded_gap(const abut_coupling *c, const abut_coupling_facet *facet,
            const abut_coupling_share *s)
{
  const abut_coupling_point *p = c->work.points.data;
  double least = INFINITY;
  for (int32_t q = 0; q < c->work.n_points; ++q)
    least = fmin(least, dot3(facet->normal, p[q].gap));
  return fmax(least, dot3(facet->normal, s->gap) / s->weight);
}

/* Integral of psi times the interpolant; false if a node has nothing opposite.
 */
static bool
integrate(const abut_coupling *c, const abut_coupling_functions *f,
          const abut_coupling_node_gaps *gaps, const abut_coupling_share *s,
          double *sum)
{
  const abut_coupling_entry *e =
      (const abut_coupling_entry *)c->sum.entries.data + s->first;
  sum[0] = sum[1] = sum[2] = 0.;
  for (int32_t k = 0; k < s->n_secondary; ++k)
  {
    int32_t l = 0;
    while (f->node[l] != e[k].node)
      ++l;
    if (!gaps->found[l])
      return false;
    axpy3(sum, e[k].value, gaps->gap[l], sum);
  }
  return true;
}

void
abut_coupling_interpolate(const abut_coupling *c,
                          const abut_coupling_facet *facet,
                          const abut_coupling_functions *f,
                          const abut_coupling_node_gaps *gaps,
                          abut_coupling_share *s)
{
  double sum[3], none[3] = {0., 0., 0.};
  if (!(s->weight > 0.))
    return;
  if (c->obstacle != NULL)
  {
    if (integrate(c, f, gaps, s, sum))
      s->distance = sum[0];
    return;
  }
  if (!integrate(c, f, gaps, s, sum))
    axpy3(none, s->weight * bounded_gap(c, facet, s), facet->normal, sum);
  sub3(sum, s->gap, s->offset);
}

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Weak nodes of partly covered quadratic facets.
 *
 * Quadratic shape functions change sign, so that the integral of phi_j over
 * the covered part of its facets can be small or negative beside that of
 * |phi_j|: a row with such a weight would be useless or wrong. The coverage of
 * a node is measured by its hat function, the linear one on the parts that
 * middle nodes cut the facets into:
 *
 *     h_j = int_covered hat_j ,  H_j = int_all hat_j ,  d_j = int_covered phi_j
 *
 * and the node is weak, and treated as dropped, if h_j < H_j / 4 or d_j < h_j /
 * 20. (A line covered by less than three quarters has d = 0 at its far end,
 * where h = H / 4.) The best covered node of each facet is kept in any case, so
 * that no covered part is lost. */
#include "contact/coupling.h"
#include "geometry/vector.h"

#include <string.h>

static const double smallest_coverage = 0.25, smallest_weight = 0.05;

/* The piecewise linear functions of line3 in [-1, 1], at nodes -1, 1, 0. */
static void
hats(double xi, double *h)
{
  h[0] = max2(-xi, 0.);
  h[1] = max2(xi, 0.);
  h[2] = 1. - fabs(xi);
}

/* Hat functions of the nodes; the shape functions of linear kinds. tri6 has no
 * multipliers that can be weak. */
static void
hats_of(abut_facet_kind kind, const abut_coupling_point *p, double *hat)
{
  /* Line functions along xi and eta of the nodes of quad9. */
  static const int8_t along[9][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 2},
                                     {1, 2}, {2, 0}, {2, 1}, {2, 2}};
  double u[3], v[3];
  hats(p->local[0], u);
  hats(p->local[1], v);
  for (int a = 0; a < abut_facet_n_nodes(kind); ++a)
    hat[a] = kind == ABUT_FACET_LINE3   ? u[a]
             : kind == ABUT_FACET_QUAD9 ? u[along[a][0]] * v[along[a][1]]
                                        : p->shape[a];
}

/* Integrals of the hats and shape functions of free nodes over the points in
 * work. */
typedef struct integrals
{
  double hat[ABUT_COUPLING_MAX_FREE], shape[ABUT_COUPLING_MAX_FREE];
} integrals;

static void
integrate(const abut_coupling *c, const abut_coupling_facet *facet,
          const abut_coupling_functions *f, integrals *sum)
{
  const abut_coupling_point *p = c->points.data;
  memset(sum, 0, sizeof(*sum));
  for (int32_t q = 0; q < c->n_points; ++q)
  {
    double h[ABUT_FACET_MAX_NODES];
    hats_of(facet->kind, p + q, h);
    for (int32_t l = 0; l < f->n; ++l)
      for (int32_t a = 0; a < facet->n; ++a)
      {
        const double w = p[q].weight * f->phi[l][a];
        sum->hat[l] += w * h[a];
        sum->shape[l] += w * p[q].shape[a];
      }
  }
}

/* The free node of a facet that is covered best, or -1. */
static int32_t
best_covered(const abut_coupling_functions *f, const integrals *whole,
             const integrals *covered)
{
  int32_t best = -1;
  double most = 0.;
  for (int32_t l = 0; l < f->n; ++l)
  {
    const double ratio =
        whole->hat[l] > 0. ? covered->hat[l] / whole->hat[l] : 0.;
    if (f->dropped[l] || !(covered->shape[l] > 0.) || !(ratio > most))
      continue;
    most = ratio;
    best = f->node[l];
  }
  return best;
}

static abut_status
measure(abut_coupling *c, int32_t index)
{
  abut_coupling_facet facet;
  abut_coupling_functions f;
  integrals whole, covered;
  abut_coupling_load(c, index, &facet);
  abut_status status =
      abut_coupling_make_functions(c, &facet, c->given.data, &f);
  if (status == ABUT_SUCCESS)
    status = abut_coupling_whole(c, &facet);
  if (status != ABUT_SUCCESS)
    return status;
  integrate(c, &facet, &f, &whole);
  status = abut_coupling_make_points(c, &facet, false);
  if (status != ABUT_SUCCESS)
    return status;
  integrate(c, &facet, &f, &covered);
  for (int32_t l = 0; l < f.n; ++l)
  {
    ((double *)c->hat.data)[f.node[l]] += whole.hat[l];
    ((double *)c->covered_hat.data)[f.node[l]] += covered.hat[l];
    ((double *)c->covered.data)[f.node[l]] += covered.shape[l];
  }
  const int32_t best = best_covered(&f, &whole, &covered);
  if (best >= 0)
    ((uint8_t *)c->node_flag.data)[best] = 1;
  return ABUT_SUCCESS;
}

abut_status
abut_coupling_drop_weak(abut_coupling *c)
{
  const int32_t *order = c->facet_order.data, *hanging = c->hanging.data;
  const uint8_t *purpose = c->purpose.data, *wanted = c->nodes->wanted,
                *needed = c->node_flag.data;
  if (c->secondary->view.n_nodes > 0)
    memset(c->node_flag.data, 0, (size_t)c->secondary->view.n_nodes);
  for (int32_t i = 0; i < c->secondary->view.n_facets; ++i)
    if (purpose[order[i]] & ABUT_COUPLING_FOR_WEAK)
    {
      const abut_status status = measure(c, order[i]);
      if (status != ABUT_SUCCESS)
        return status;
    }
  uint8_t *dropped = c->dropped.data;
  const double *hat = c->hat.data, *h = c->covered_hat.data,
               *d = c->covered.data;
  for (int32_t n = 0; n < c->secondary->view.n_nodes; ++n)
    if (hanging[n] < 0 && hat[n] != 0. && !dropped[n] && !needed[n]
        && (h[n] < smallest_coverage * hat[n] || d[n] < smallest_weight * h[n]))
    {
      dropped[n] = 1;
      c->statistics.n_weak += d[n] != 0. && (wanted == NULL || wanted[n]);
    }
  return ABUT_SUCCESS;
}

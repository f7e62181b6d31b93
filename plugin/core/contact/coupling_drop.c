/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nodes that carry no multiplier because of what is covered around them.
 *
 * Weak nodes. Quadratic shape functions change sign, so that the integral of
 * phi_j over the covered part of its facets can be small or negative compared
 * with that of |phi_j|: a row with such a weight would be useless or wrong. The
 * coverage of a node is measured by its hat function, the linear one on the
 * parts that middle nodes cut the facets into:
 *
 *     h_j = int_covered hat_j ,  H_j = int_all hat_j ,  d_j = int_covered phi_j
 *
 * and the node is weak if h_j < H_j / 4 or d_j < h_j / 20. (A line covered by
 * less than three quarters has d = 0 at its far end, where h = H / 4.) The best
 * covered node of each facet, of those with d_j >= h_j / 20 there if it has
 * any, is never weak, so that no covered part is lost. A node on an axis of
 * revolution has d = 0 where all is covered, but for round-off, and so is weak.
 *
 * Corners. Where facets of a feature are covered on both sides, one row cannot
 * hold both directions: with facet normals n the node is dropped if
 *
 *     |int_covered hat_j n| < cos(t / 2) h_j
 *
 * for the feature angle t of the surface; its share goes to neighbours that
 * have one direction. Facets all of whose nodes are corners keep theirs. */
#include "contact/coupling.h"
#include "geometry/kernels.h"
#include "geometry/vector.h"

#include <string.h>

enum
{
  PROTECTED = 2 /* value of abut_coupling.corner */
};

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

/* Mark the corners of a facet: nodes whose averaged normal leans away from the
 * facet's own by more than half the feature angle. Returns whether there is
 * one. */
static bool
mark_corners(abut_coupling *c, int32_t f, double limit)
{
  const abut_surface_view *v = &c->secondary->view;
  const abut_facet_kind kind = (abut_facet_kind)v->kinds[f];
  const int32_t *node = v->connectivity + v->facet_start[f];
  double x[3 * ABUT_FACET_MAX_NODES];
  const int32_t n = abut_surface_gather(c->secondary, f, x);
  bool any = false;
  for (int32_t a = 0; a < n; ++a)
  {
    double own[3], average[3] = {0., 0., 0.};
    abut_coupling_normal(kind, x, abut_facet_node_local(kind, a), own);
    for (int32_t d = 0; d < v->dimension; ++d)
      average[d] = c->of_node.normal[(int64_t)v->dimension * node[a] + d];
    if (dot3(own, average) >= limit)
      continue;
    any = true;
    ((uint8_t *)c->of_node.corner.data)[node[a]] = 1;
  }
  return any;
}

bool
abut_coupling_find_corners(abut_coupling *c)
{
  const double limit = cos(0.5 * c->secondary->feature_angle);
  bool any = false;
  for (int32_t f = 0; f < c->secondary->view.n_facets; ++f)
    any |= mark_corners(c, f, limit);
  return any;
}

/* Integrals of the hats and shape functions of free nodes over the current
 * points. */
typedef struct integrals
{
  double hat[ABUT_COUPLING_MAX_FREE], shape[ABUT_COUPLING_MAX_FREE];
} integrals;

static void
integrate(const abut_coupling *c, const abut_coupling_facet *facet,
          const abut_coupling_functions *f, integrals *sum)
{
  const abut_coupling_point *p = c->work.points.data;
  memset(sum, 0, sizeof(*sum));
  for (int32_t q = 0; q < c->work.n_points; ++q)
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

/* The free node of a facet that is covered best, or -1, among nodes with
 * integrals of phi above least times those of the hat. */
static int32_t
best_covered(const abut_coupling_functions *f, const integrals *whole,
             const integrals *covered, double least)
{
  int32_t best = -1;
  double most = 0.;
  for (int32_t l = 0; l < f->n; ++l)
  {
    const double ratio =
        whole->hat[l] > 0. ? covered->hat[l] / whole->hat[l] : 0.;
    if (f->dropped[l] || !(covered->shape[l] > least * covered->hat[l])
        || !(ratio > most))
      continue;
    most = ratio;
    best = f->node[l];
  }
  return best;
}

/* If all nodes of a covered facet are corners, keep them. */
static void
protect(abut_coupling *c, const abut_coupling_functions *f)
{
  uint8_t *corner = c->of_node.corner.data;
  for (int32_t l = 0; l < f->n; ++l)
    if (!f->dropped[l] && corner[f->node[l]] == 0)
      return;
  for (int32_t l = 0; l < f->n; ++l)
    corner[f->node[l]] = PROTECTED;
}

static abut_status
measure(abut_coupling *c, int32_t index)
{
  abut_coupling_facet facet;
  abut_coupling_functions f;
  integrals whole, covered;
  abut_coupling_load(c, index, &facet);
  abut_status status = abut_coupling_make_functions(
      c, &facet, c->of_node.dropped_as_given.data, &f);
  if (status == ABUT_SUCCESS)
    status = abut_coupling_whole(c, &facet);
  if (status != ABUT_SUCCESS)
    return status;
  integrate(c, &facet, &f, &whole);
  /* The distance of an obstacle is evaluated once, for the rows. */
  if (c->obstacle == NULL)
    status = abut_coupling_make_points(c, &facet, false);
  if (status != ABUT_SUCCESS)
    return status;
  integrate(c, &facet, &f, &covered);
  for (int32_t l = 0; l < f.n; ++l)
  {
    ((double *)c->of_node.hat.data)[f.node[l]] += whole.hat[l];
    ((double *)c->of_node.covered_hat.data)[f.node[l]] += covered.hat[l];
    ((double *)c->of_node.covered.data)[f.node[l]] += covered.shape[l];
    for (int d = 0; d < 3; ++d)
      ((double *)c->of_node.bend.data)[3 * (int64_t)f.node[l] + d] +=
          covered.hat[l] * facet.normal[d];
  }
  if (c->work.n_points > 0)
    protect(c, &f);
  int32_t best = best_covered(&f, &whole, &covered, smallest_weight);
  if (best < 0)
    best = best_covered(&f, &whole, &covered, 0.);
  if (best >= 0)
    ((uint8_t *)c->of_node.flag.data)[best] = 1;
  return ABUT_SUCCESS;
}

static bool
is_weak(const abut_coupling *c, int32_t n)
{
  const double hat = ((const double *)c->of_node.hat.data)[n],
               h = ((const double *)c->of_node.covered_hat.data)[n],
               d = ((const double *)c->of_node.covered.data)[n];
  return abut_coupling_has_weak(c) && hat != 0.
         && !((const uint8_t *)c->of_node.flag.data)[n]
         && (h < smallest_coverage * hat || d < smallest_weight * h);
}

static bool
is_bent(const abut_coupling *c, int32_t n)
{
  const double h = ((const double *)c->of_node.covered_hat.data)[n];
  return ((const uint8_t *)c->of_node.corner.data)[n] == 1 && h > 0.
         && norm3((const double *)c->of_node.bend.data + 3 * (int64_t)n)
                < cos(0.5 * c->secondary->feature_angle) * h;
}

abut_status
abut_coupling_drop(abut_coupling *c)
{
  const int32_t *order = c->order.facet.data,
                *hanging = c->of_node.hanging.data;
  const uint8_t *purpose = c->of_node.purpose.data,
                *wanted = c->of_node.given->wanted;
  const int32_t n_nodes = c->secondary->view.n_nodes;
  if (n_nodes > 0)
    memset(c->of_node.flag.data, 0, (size_t)n_nodes);
  for (int32_t i = 0; i < c->secondary->view.n_facets; ++i)
    if (purpose[order[i]] & ABUT_COUPLING_FOR_DROPPING)
    {
      const abut_status status = measure(c, order[i]);
      if (status != ABUT_SUCCESS)
        return status;
    }
  uint8_t *dropped = c->of_node.dropped.data;
  for (int32_t n = 0; n < n_nodes; ++n)
  {
    const bool bent = is_bent(c, n), weak = is_weak(c, n);
    if (hanging[n] >= 0 || dropped[n] || (!bent && !weak))
      continue;
    dropped[n] = 1;
    if (wanted != NULL && !wanted[n])
      continue;
    c->statistics.n_corners += bent;
    c->statistics.n_weak +=
        !bent && ((const double *)c->of_node.covered.data)[n] != 0.;
  }
  return ABUT_SUCCESS;
}

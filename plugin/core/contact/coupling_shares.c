/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Shares of a facet in the rows of its nodes: sums over its points of
 * integration, with
 *
 *     D_jl = sum_q w_q psi_j phi_l ,  M_jl = sum_q w_q psi_j N_l .
 *
 * Where D is diagonal between kept nodes its diagonal is what is left of the
 * weight after the dropped ones, so that the sum of D_jl is the weight to the
 * last bit. */
#include "contact/coupling.h"
#include "geometry/vector.h"

#include <math.h>
#include <string.h>

abut_coupling_share *
abut_coupling_new_share(abut_coupling *c)
{
  if (abut_array_reserve(c->context, &c->sum.shares, c->sum.n_shares,
                         c->sum.n_shares + 1)
      != ABUT_SUCCESS)
    return NULL;
  abut_coupling_share *s =
      (abut_coupling_share *)c->sum.shares.data + c->sum.n_shares++;
  memset(s, 0, sizeof(*s));
  s->primary = -1;
  s->first = c->sum.n_entries;
  return s;
}

abut_status
abut_coupling_new_entry(abut_coupling *c, int32_t *count, int32_t node,
                        double value)
{
  const abut_status status = abut_array_reserve(
      c->context, &c->sum.entries, c->sum.n_entries, c->sum.n_entries + 1);
  if (status != ABUT_SUCCESS)
    return status;
  abut_coupling_entry *e =
      (abut_coupling_entry *)c->sum.entries.data + c->sum.n_entries++;
  e->value = value;
  e->node = node;
  e->unused = 0;
  ++*count;
  return ABUT_SUCCESS;
}

/* Values of weighting function j at the points. */
static abut_status
evaluate(abut_coupling *c, const abut_coupling_facet *facet,
         const abut_coupling_functions *f, int32_t j)
{
  const abut_status status =
      abut_array_reserve(c->context, &c->work.values, 0, c->work.n_points);
  if (status != ABUT_SUCCESS)
    return status;
  const abut_coupling_point *p = c->work.points.data;
  double *value = c->work.values.data;
  for (int32_t q = 0; q < c->work.n_points; ++q)
  {
    double base[ABUT_FACET_MAX_NODES];
    abut_coupling_base(c, facet->kind, p + q, base);
    value[q] = 0.;
    for (int32_t a = 0; a < f->n_base; ++a)
      value[q] += f->psi[j][a] * base[a];
    value[q] *= p[q].weight;
  }
  return ABUT_SUCCESS;
}

/* Integral of psi phi_l. */
static double
secondary_integral(const abut_coupling *c, const abut_coupling_functions *f,
                   int32_t n, int32_t l)
{
  const abut_coupling_point *p = c->work.points.data;
  const double *value = c->work.values.data;
  double sum = 0.;
  for (int32_t q = 0; q < c->work.n_points; ++q)
  {
    double phi = 0.;
    for (int32_t a = 0; a < n; ++a)
      phi += f->phi[l][a] * p[q].shape[a];
    sum += value[q] * phi;
  }
  return sum;
}

static abut_status
add_secondary(abut_coupling *c, const abut_coupling_facet *facet,
              const abut_coupling_functions *f, int32_t j,
              abut_coupling_share *share)
{
  double rest = share->weight;
  int32_t n = 0;
  abut_status status = ABUT_SUCCESS;
  for (int32_t l = 0; l < f->n && status == ABUT_SUCCESS; ++l)
    if (!f->lumped && (!f->diagonal || f->dropped[l]))
    {
      const double value = secondary_integral(c, f, facet->n, l);
      rest -= value;
      status = abut_coupling_new_entry(c, &n, f->node[l], value);
    }
  if (f->diagonal && status == ABUT_SUCCESS)
    status = abut_coupling_new_entry(c, &n, f->node[f->kept[j]], rest);
  share->n_secondary = n;
  return status;
}

/* Points of one primary facet follow each other. */
static abut_status
add_primary(abut_coupling *c, abut_coupling_share *share)
{
  const abut_coupling_point *p = c->work.points.data;
  const double *value = c->work.values.data;
  int32_t n = 0;
  for (int32_t q = 0, end; q < c->work.n_points; q = end)
  {
    double sum[ABUT_FACET_MAX_NODES] = {0.};
    const int32_t facet = p[q].primary;
    for (end = q; end < c->work.n_points && p[end].primary == facet; ++end)
      for (int32_t a = 0; a < ABUT_FACET_MAX_NODES; ++a)
        sum[a] += value[end] * p[end].opposite[a];
    if (facet < 0)
      continue;
    const abut_surface_view *v = &c->primary->view;
    for (int32_t e = v->facet_start[facet]; e < v->facet_start[facet + 1]; ++e)
    {
      const abut_status status = abut_coupling_new_entry(
          c, &n, v->connectivity[e], sum[e - v->facet_start[facet]]);
      if (status != ABUT_SUCCESS)
        return status;
    }
  }
  share->n_primary = n;
  return ABUT_SUCCESS;
}

static void
add_gap(const abut_coupling *c, const abut_coupling_facet *facet,
        abut_coupling_share *share)
{
  const abut_coupling_point *p = c->work.points.data;
  const double *value = c->work.values.data;
  share->least = INFINITY;
  for (int32_t q = 0; q < c->work.n_points; ++q)
  {
    share->least = fmin(share->least, dot3(facet->normal, p[q].gap));
    share->weight += value[q];
    share->distance += value[q] * p[q].distance;
    for (int d = 0; d < 3; ++d)
    {
      share->gap[d] += value[q] * p[q].gap[d];
      share->normal[d] += value[q] * p[q].normal[d];
    }
  }
}

abut_status
abut_coupling_add_shares(abut_coupling *c, const abut_coupling_facet *facet,
                         const abut_coupling_functions *f)
{
  const uint8_t *wanted = c->of_node.given->wanted;
  const bool interpolates = abut_coupling_interpolates(c) && !f->lumped;
  abut_coupling_node_gaps gaps;
  abut_status status = interpolates
                           ? abut_coupling_find_node_gaps(c, facet, f, &gaps)
                           : ABUT_SUCCESS;
  for (int32_t j = 0; j < f->n_kept && status == ABUT_SUCCESS; ++j)
  {
    const int32_t node = f->node[f->kept[j]];
    if (wanted != NULL && !wanted[node])
      continue;
    status = evaluate(c, facet, f, j);
    abut_coupling_share *s =
        status == ABUT_SUCCESS ? abut_coupling_new_share(c) : NULL;
    if (s == NULL)
      return ABUT_OUT_OF_MEMORY;
    s->node = node;
    s->facet = facet->index;
    add_gap(c, facet, s);
    status = add_secondary(c, facet, f, j, s);
    if (status == ABUT_SUCCESS)
      status = add_primary(c, s);
    if (status == ABUT_SUCCESS && abut_coupling_follows(c))
      status = abut_coupling_add_blocks(c, facet, s);
    if (status == ABUT_SUCCESS && interpolates)
      abut_coupling_interpolate(c, facet, f, &gaps, s);
  }
  return status;
}

abut_status
abut_coupling_add_points(abut_coupling *c, const abut_coupling_facet *facet,
                         const abut_coupling_functions *f)
{
  const abut_coupling_point *points = c->work.points.data;
  for (int32_t q = 0; q < c->work.n_points; ++q)
  {
    const abut_coupling_point *p = points + q;
    abut_status status = ABUT_SUCCESS;
    abut_coupling_share *s = abut_coupling_new_share(c);
    if (s == NULL)
      return ABUT_OUT_OF_MEMORY;
    s->node = -1;
    s->facet = facet->index;
    s->point = p->number;
    s->hessian = p->hessian;
    s->primary = p->primary;
    s->weight = p->weight;
    s->distance = p->weight * p->distance;
    for (int d = 0; d < 3; ++d)
    {
      s->gap[d] = p->weight * p->gap[d];
      s->normal[d] = p->weight * p->normal[d];
      s->position[d] = p->position[d];
    }
    for (int32_t l = 0; l < f->n && status == ABUT_SUCCESS; ++l)
    {
      double phi = 0.;
      for (int32_t a = 0; a < facet->n; ++a)
        phi += f->phi[l][a] * p->shape[a];
      status = abut_coupling_new_entry(c, &s->n_secondary, f->node[l],
                                       p->weight * phi);
    }
    for (int32_t a = 0;
         p->primary >= 0 && status == ABUT_SUCCESS
         && a < abut_facet_n_nodes(
                (abut_facet_kind)c->primary->view.kinds[p->primary]);
         ++a)
      status = abut_coupling_new_entry(
          c, &s->n_primary,
          c->primary->view
              .connectivity[c->primary->view.facet_start[p->primary] + a],
          p->weight * p->opposite[a]);
    if (status != ABUT_SUCCESS)
      return status;
  }
  return ABUT_SUCCESS;
}

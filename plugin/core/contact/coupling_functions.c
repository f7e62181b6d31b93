/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* The functions of one secondary facet e, one formula for plain, hanging,
 * dropped and partly covered cases.
 *
 * With the shape functions N and hanging nodes resolved, u_a = sum_l T_al u_l,
 * the free nodes l have the functions
 *
 *     phi_l = sum_a T_al N_a .
 *
 * Nodes x in X are dropped; the others, kept, share theirs in equal parts:
 *
 *     chi_j = phi_j + sum_{x in X} phi_x / n_kept ,   sum_j chi_j = 1 .
 *
 * Weighting functions are psi = chi for the standard mortar method and, for
 * the dual one with integrals over the covered part of e,
 *
 *     G_kj = int chi_k phi_j ,  d_j = int phi_j     (k, j kept)
 *     psi = A chi ,  A = diag(d) G^-1
 *
 * so that int psi_k phi_j = d_j delta_kj and, because (1 .. 1) G = d, again
 * sum_j psi_j = 1. For X empty this is Cichosz and Bischoff, Comput. Methods
 * Appl. Mech. Engrg. 200 (2011) 1317; A is found with G scaled to a unit
 * diagonal, so that a small covered part does not spoil it by itself. Where G
 * is singular for practical purposes, or next to nothing is covered, psi = chi
 * and D is lumped. */
#include "base/dense_lu.h"
#include "contact/discretisation.h"

#include <math.h>
#include <string.h>

/* Covered part of a facet below which dual functions are not formed, and
 * condition number of G above which they are not. */
static const double smallest_part = 1e-3, largest_condition = 1e8;

/* Index of a free node, entered if it is new; -1 if there are too many. */
static int32_t
free_index(abut_coupling_functions *f, int32_t node)
{
  for (int32_t l = 0; l < f->n; ++l)
    if (f->node[l] == node)
      return l;
  if (f->n == ABUT_COUPLING_MAX_FREE)
    return -1;
  f->node[f->n] = node;
  memset(f->phi[f->n], 0, sizeof(f->phi[0]));
  return f->n++;
}

/* phi and the free nodes. */
static int
resolve(const abut_coupling *c, const abut_coupling_facet *facet,
        abut_coupling_functions *f)
{
  const abut_surface_view *v = &c->secondary->view;
  const int32_t *node = v->connectivity + v->facet_start[facet->index];
  const int32_t *hanging = c->of_node.hanging.data;
  const abut_coupling_nodes *nodes = c->of_node.given;
  f->n = 0;
  for (int32_t a = 0; a < facet->n; ++a)
  {
    const int32_t h = hanging[node[a]];
    if (h < 0)
    {
      const int32_t l = free_index(f, node[a]);
      if (l < 0)
        return 0;
      f->phi[l][a] += 1.;
      continue;
    }
    for (int32_t e = nodes->hanging_start[h]; e < nodes->hanging_start[h + 1];
         ++e)
    {
      const int32_t l = free_index(f, nodes->hanging_parent[e]);
      if (l < 0)
        return 0;
      f->phi[l][a] += nodes->hanging_weight[e];
    }
  }
  return 1;
}

/* Whether a free node takes part in the multiplier: with linear functions only
 * corners, and what corners hang on, do. */
static int
has_base(const abut_coupling_functions *f, int32_t l)
{
  for (int32_t a = 0; a < f->n_base; ++a)
    if (f->phi[l][a] != 0.)
      return 1;
  return 0;
}

abut_status
abut_coupling_make_functions(abut_coupling *c, const abut_coupling_facet *facet,
                             const uint8_t *dropped, abut_coupling_functions *f)
{
  if (!resolve(c, facet, f))
    return abut_fail(c->context, ABUT_UNSUPPORTED, "abut_coupling_build",
                     "the nodes of a facet hang on more than 32 others");
  f->n_base = c->options.multiplier_degree == 1
                  ? abut_facet_n_corners(facet->kind)
                  : facet->n;
  f->n_kept = 0;
  f->lumped = false;
  f->diagonal = c->method->dual;
  double shared[ABUT_FACET_MAX_NODES] = {0.};
  for (int32_t l = 0; l < f->n; ++l)
  {
    f->dropped[l] = dropped[f->node[l]] != 0;
    if (f->dropped[l])
      for (int32_t a = 0; a < f->n_base; ++a)
        shared[a] += f->phi[l][a];
    else if (has_base(f, l))
      f->kept[f->n_kept++] = l;
  }
  for (int32_t j = 0; j < f->n_kept; ++j)
    for (int32_t a = 0; a < f->n_base; ++a)
      f->chi[j][a] = f->phi[f->kept[j]][a] + shared[a] / f->n_kept;
  memcpy(f->psi, f->chi, sizeof(f->chi));
  return ABUT_SUCCESS;
}

void
abut_coupling_base(const abut_coupling *c, abut_facet_kind kind,
                   const abut_coupling_point *p, double *base)
{
  const int32_t n = abut_facet_n_nodes(kind),
                corners = abut_facet_n_corners(kind);
  if (c->options.multiplier_degree != 1 || n == corners)
  {
    memcpy(base, p->shape, sizeof(double) * (size_t)n);
    return;
  }
  const abut_facet_kind linear = corners == 2   ? ABUT_FACET_LINE2
                                 : corners == 3 ? ABUT_FACET_TRI3
                                                : ABUT_FACET_QUAD4;
  abut_coupling_shape(linear, NULL, p->local, base, NULL);
}

/* Integrals of chi_k phi_j and of phi_j; returns the covered area. */
static double
integrate(const abut_coupling *c, const abut_coupling_functions *f, int32_t n,
          double *g, double *d)
{
  const abut_coupling_point *points = c->work.points.data;
  const int32_t k = f->n_kept;
  double area = 0.;
  memset(g, 0, sizeof(double) * (size_t)(k * k));
  memset(d, 0, sizeof(double) * (size_t)k);
  for (int32_t q = 0; q < c->work.n_points; ++q)
  {
    const abut_coupling_point *p = points + q;
    double phi[ABUT_COUPLING_MAX_FREE], chi[ABUT_COUPLING_MAX_FREE];
    area += p->weight;
    for (int32_t j = 0; j < k; ++j)
    {
      phi[j] = chi[j] = 0.;
      for (int32_t a = 0; a < n; ++a)
      {
        phi[j] += f->phi[f->kept[j]][a] * p->shape[a];
        chi[j] += f->chi[j][a] * p->shape[a];
      }
      d[j] += p->weight * phi[j];
    }
    for (int32_t i = 0; i < k; ++i)
      for (int32_t j = 0; j < k; ++j)
        g[i * k + j] += p->weight * chi[i] * phi[j];
  }
  return area;
}

/* A = diag(d) G^-1 for G[k * k], which is overwritten: row j of A solves
 * G' a = d_j e_j. False if G is singular or ill conditioned. */
static int
invert(int32_t k, double *g, const double *d, double *a)
{
  double scale[ABUT_COUPLING_MAX_FREE], rows[ABUT_COUPLING_MAX_FREE];
  int32_t pivot[ABUT_COUPLING_MAX_FREE];
  double lu[ABUT_COUPLING_MAX_FREE * ABUT_COUPLING_MAX_FREE], size = 0.,
                                                              inverse = 0.;
  for (int32_t i = 0; i < k; ++i)
  {
    if (!(g[i * k + i] > 0.))
      return 0;
    scale[i] = 1. / sqrt(g[i * k + i]);
  }
  for (int32_t i = 0; i < k; ++i)
  {
    double sum = 0.;
    for (int32_t j = 0; j < k; ++j)
    {
      lu[i * k + j] = g[j * k + i] * scale[i] * scale[j];
      sum += fabs(lu[i * k + j]);
    }
    size = fmax(size, sum);
  }
  if (!abut_dense_lu_factorise(k, lu, pivot, rows))
    return 0;
  for (int32_t j = 0; j < k; ++j)
  {
    double x[ABUT_COUPLING_MAX_FREE] = {0.}, sum = 0.;
    x[j] = 1.;
    abut_dense_lu_solve(k, lu, pivot, rows, x);
    for (int32_t i = 0; i < k; ++i)
    {
      sum += fabs(x[i]);
      a[j * k + i] = d[j] * scale[j] * x[i] * scale[i];
    }
    inverse = fmax(inverse, sum);
  }
  return size * inverse <= largest_condition;
}

void
abut_coupling_make_psi(abut_coupling *c, const abut_coupling_facet *facet,
                       double whole, abut_coupling_functions *f)
{
  const int32_t k = f->n_kept;
  double g[ABUT_COUPLING_MAX_FREE * ABUT_COUPLING_MAX_FREE],
      a[ABUT_COUPLING_MAX_FREE * ABUT_COUPLING_MAX_FREE],
      d[ABUT_COUPLING_MAX_FREE];
  if (!f->diagonal || k == 0)
    return;
  const double area = integrate(c, f, facet->n, g, d);
  if (!(area >= smallest_part * whole) || !invert(k, g, d, a))
  {
    f->lumped = true;
    return;
  }
  for (int32_t j = 0; j < k; ++j)
    for (int32_t b = 0; b < f->n_base; ++b)
    {
      f->psi[j][b] = 0.;
      for (int32_t i = 0; i < k; ++i)
        f->psi[j][b] += a[j * k + i] * f->chi[i][b];
    }
}

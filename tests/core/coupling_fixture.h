/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_CORE_COUPLING_FIXTURE_H
#define ABUT_TESTS_CORE_COUPLING_FIXTURE_H

/* What the tests of couplings share: a pair of surfaces with a coupling, and
 * checks that every set of rows must pass. */

#include "surface_fixture.h"

#include <abut/coupling.h>

/* The points of a coupling by sides: nodes with their numbers on the surface,
 * coefficients D / W and M / W. */
typedef struct couple_view
{
  int32_t dimension, n_rows;
  const int32_t *node, *facet, *point;
  const double *weight, *full_weight, *gap, *normal, *position;
  int64_t *secondary_start, *primary_start;
  int32_t *secondary_node, *primary_node;
  double *secondary_coefficient, *primary_coefficient;
} couple_view;

typedef struct couple
{
  abut_surface *secondary, *primary;
  abut_coupling *coupling;
  abut_points *points;
  couple_view view;
  abut_coupling_statistics statistics;
} couple;

static inline void
couple_release(couple_view *v)
{
  free(v->secondary_start);
  free(v->primary_start);
  free(v->secondary_node);
  free(v->primary_node);
  free(v->secondary_coefficient);
  free(v->primary_coefficient);
  memset(v, 0, sizeof(*v));
}

/* Sort the stencils by sides. */
static inline void
couple_sort(couple *c, const abut_points_view *p)
{
  abut_surface_view secondary;
  couple_view *v = &c->view;
  const size_t n = (size_t)p->n_points + 1, m = (size_t)p->start[n - 1] + 1;
  require(abut_surface_get(c->secondary, &secondary));
  v->secondary_start = calloc(n, sizeof(int64_t));
  v->primary_start = calloc(n, sizeof(int64_t));
  v->secondary_node = calloc(m, sizeof(int32_t));
  v->primary_node = calloc(m, sizeof(int32_t));
  v->secondary_coefficient = calloc(m, sizeof(double));
  v->primary_coefficient = calloc(m, sizeof(double));
  for (int32_t i = 0; i < p->n_points; ++i)
  {
    int64_t s = v->secondary_start[i], q = v->primary_start[i];
    for (int64_t e = p->start[i]; e < p->start[i + 1]; ++e)
      if (e < p->start[i] + p->n_secondary[i])
      {
        assert_true(p->node[e] < secondary.n_nodes);
        v->secondary_node[s] = p->node[e];
        v->secondary_coefficient[s++] = p->coefficient[e];
      }
      else
      {
        assert_true(p->node[e] >= secondary.n_nodes);
        v->primary_node[q] = p->node[e] - secondary.n_nodes;
        v->primary_coefficient[q++] = -p->coefficient[e];
      }
    v->secondary_start[i + 1] = s;
    v->primary_start[i + 1] = q;
  }
}

/* The points of the last build. */
static inline void
couple_look(couple *c)
{
  abut_coupling_view view;
  abut_points_view points;
  require(abut_coupling_get(c->coupling, &view));
  require(abut_points_get(c->points, &points));
  require(abut_coupling_get_statistics(c->coupling, &c->statistics));
  assert_int_equal(view.first, 0);
  assert_int_equal(view.n_points, points.n_points);
  couple_release(&c->view);
  c->view.dimension = view.dimension;
  c->view.n_rows = view.n_points;
  c->view.node = view.node;
  c->view.facet = view.facet;
  c->view.point = view.point;
  c->view.full_weight = view.full_weight;
  c->view.position = view.position;
  c->view.weight = points.weight;
  c->view.gap = points.gap;
  c->view.normal = points.frame;
  couple_sort(c, &points);
}

/* Build; what was there before is gone. */
static inline abut_status
couple_try(couple *c, const abut_coupling_nodes *nodes)
{
  abut_surface_view secondary;
  require(abut_surface_get(c->secondary, &secondary));
  if (c->points == NULL)
    require(abut_points_create(context, secondary.dimension, &c->points));
  require(abut_points_clear(c->points));
  const abut_coupling_target target = abut_coupling_target_defaults(c->points);
  return abut_coupling_build(c->coupling, nodes, 0., &target);
}

static inline void
couple_build(couple *c, const abut_coupling_nodes *nodes)
{
  require(couple_try(c, nodes));
  couple_look(c);
}

/* Surfaces from two meshes, a coupling, and its rows. */
static inline couple
couple_meshes(const scene_mesh *secondary, const scene_mesh *primary,
              const abut_coupling_options *options,
              const abut_coupling_nodes *nodes)
{
  couple c;
  memset(&c, 0, sizeof(c));
  c.secondary = surface_of(secondary);
  c.primary = surface_of(primary);
  require(abut_coupling_create(context, c.secondary, c.primary, options,
                               &c.coupling));
  couple_build(&c, nodes);
  return c;
}

static inline void
couple_destroy(couple *c)
{
  couple_release(&c->view);
  require(abut_points_destroy(&c->points));
  require(abut_coupling_destroy(&c->coupling));
  require(abut_surface_destroy(&c->secondary));
  if (c->primary != NULL)
    require(abut_surface_destroy(&c->primary));
}

/* Options of a mortar method. */
static inline abut_coupling_options
mortar_options(abut_discretisation discretisation, int32_t degree)
{
  abut_coupling_options o = abut_coupling_defaults();
  o.discretisation = discretisation;
  o.multiplier_degree = degree;
  return o;
}

/* Entries of all rows on one side. */
typedef struct side_entries
{
  const int64_t *start;
  const int32_t *node;
  const double *value;
  double sign; /* of forces of a pressure */
} side_entries;

static inline side_entries
entries_of(const couple_view *v, int side)
{
  const side_entries secondary = {v->secondary_start, v->secondary_node,
                                  v->secondary_coefficient, -1.},
                     primary = {v->primary_start, v->primary_node,
                                v->primary_coefficient, 1.};
  return side == 0 ? secondary : primary;
}

static inline double
sum_of(const double *value, int64_t from, int64_t to)
{
  double sum = 0.;
  for (int64_t e = from; e < to; ++e)
    sum += value[e];
  return sum;
}

/* Finite, with positive weights and unit normals; the coefficients of each
 * side add up to one. */
static inline void
check_rows(const couple *c)
{
  const couple_view *v = &c->view;
  const int dim = v->dimension;
  for (int32_t j = 0; j < v->n_rows; ++j)
  {
    assert_true(v->weight[j] > 0. && v->weight[j] < 1e30);
    assert_true(fabs(v->gap[j]) < 1e30);
    near(sum_of(v->secondary_coefficient, v->secondary_start[j],
                v->secondary_start[j + 1]),
         1., 2e-14, "sum of secondary coefficients");
    if (c->primary != NULL)
    {
      double size = 1.;
      for (int64_t e = v->primary_start[j]; e < v->primary_start[j + 1]; ++e)
        size = fmax(size, fabs(v->primary_coefficient[e]));
      near(sum_of(v->primary_coefficient, v->primary_start[j],
                  v->primary_start[j + 1]),
           1., 2e-14 * size, "sum of primary coefficients");
    }
    double length = 0.;
    for (int d = 0; d < dim; ++d)
      length += v->normal[dim * j + d] * v->normal[dim * j + d];
    near(length, 1., 1e-14, "length of a normal");
    if (j > 0 && v->node[j] >= 0)
      assert_true(v->node[j] > v->node[j - 1]);
  }
}

/* Nodal forces of the pressure one: out[l] = sum_j W_j c_jl n_j on the primary
 * (side 1), minus that on the secondary (side 0). [n_nodes * dimension] */
static inline void
nodal_forces(const couple_view *v, int side, double *out)
{
  const side_entries c = entries_of(v, side);
  for (int32_t j = 0; j < v->n_rows; ++j)
    for (int64_t e = c.start[j]; e < c.start[j + 1]; ++e)
      for (int d = 0; d < v->dimension; ++d)
        out[v->dimension * c.node[e] + d] += c.sign * v->weight[j] * c.value[e]
                                             * v->normal[v->dimension * j + d];
}

/* Largest difference between the two sides of sum_l c_jl u(x_l). */
static inline double
field_difference(const couple *c, double (*u)(const double *x, const void *),
                 const void *data)
{
  const couple_view *v = &c->view;
  abut_surface_view s[2];
  double largest = 0.;
  require(abut_surface_get(c->secondary, &s[0]));
  require(abut_surface_get(c->primary, &s[1]));
  for (int32_t j = 0; j < v->n_rows; ++j)
  {
    double sum[2] = {0.};
    for (int side = 0; side < 2; ++side)
    {
      const side_entries of = entries_of(v, side);
      for (int64_t e = of.start[j]; e < of.start[j + 1]; ++e)
        sum[side] +=
            of.value[e] * u(s[side].position + v->dimension * of.node[e], data);
    }
    const double difference = fabs(sum[1] - sum[0]);
    if (!(difference <= largest))
      largest = difference;
  }
  return largest;
}

/* Integral of shape function a over a flat facet of area one. */
static inline double
shape_integral(abut_facet_kind kind, int a)
{
  switch (kind)
  {
  case ABUT_FACET_LINE2:
    return 1. / 2.;
  case ABUT_FACET_LINE3:
    return a < 2 ? 1. / 6. : 4. / 6.;
  case ABUT_FACET_TRI3:
    return 1. / 3.;
  case ABUT_FACET_TRI6:
    return a < 3 ? 0. : 1. / 3.;
  case ABUT_FACET_QUAD4:
    return 1. / 4.;
  case ABUT_FACET_QUAD9:
    return a < 4 ? 1. / 36. : a < 8 ? 4. / 36. : 16. / 36.;
  case ABUT_FACET_N_KINDS:
    break;
  }
  return 0.;
}

/* Consistent nodal areas of a mesh whose facets are parallelograms, triangles
 * or straight lines with their middle nodes in the middle. */
static inline void
nodal_areas(const abut_surface *surface, double *out)
{
  abut_surface_view v;
  require(abut_surface_get(surface, &v));
  memset(out, 0, sizeof(double) * (size_t)v.n_nodes);
  for (int32_t f = 0; f < v.n_facets; ++f)
  {
    const abut_facet_kind kind = (abut_facet_kind)v.kinds[f];
    const int32_t *node = v.connectivity + v.facet_start[f];
    double x[27];
    abut_facet_measures m;
    for (int a = 0; a < abut_facet_n_nodes(kind); ++a)
      for (int d = 0; d < v.dimension; ++d)
        x[a * v.dimension + d] = v.position[v.dimension * node[a] + d];
    require(abut_facet_measure(kind, x, &m));
    for (int a = 0; a < abut_facet_n_nodes(kind); ++a)
      out[node[a]] += m.area * shape_integral(kind, a);
  }
}

/* A uniform pressure gives the consistent nodal forces of a flat mesh that is
 * covered completely; normal: of the secondary. */
static inline double
force_error(const couple *c, int side, const double *normal)
{
  abut_surface_view v;
  require(abut_surface_get(side == 0 ? c->secondary : c->primary, &v));
  const size_t n = (size_t)v.n_nodes * (size_t)v.dimension;
  double *force = calloc(n, sizeof(double)), *area = calloc(n, sizeof(double)),
         error = 0.;
  nodal_forces(&c->view, side, force);
  nodal_areas(side == 0 ? c->secondary : c->primary, area);
  for (int32_t l = 0; l < v.n_nodes; ++l)
    for (int d = 0; d < v.dimension; ++d)
      error = fmax(error, fabs(force[v.dimension * l + d]
                               - (side == 0 ? -1. : 1.) * area[l] * normal[d]));
  free(force);
  free(area);
  return error;
}

/* Sum of the forces of both sides, and of their moments about the origin, for
 * row pressures p_j = 1 + j. */
static inline void
check_balance(const couple *c, double force_tolerance, double moment_tolerance)
{
  const couple_view *v = &c->view;
  const int dim = v->dimension;
  abut_surface_view s[2];
  double force[3] = {0.}, moment[3] = {0.};
  require(abut_surface_get(c->secondary, &s[0]));
  require(abut_surface_get(c->primary, &s[1]));
  for (int side = 0; side < 2; ++side)
  {
    const side_entries of = entries_of(v, side);
    for (int32_t j = 0; j < v->n_rows; ++j)
      for (int64_t e = of.start[j]; e < of.start[j + 1]; ++e)
      {
        double f[3] = {0.}, x[3] = {0.};
        for (int d = 0; d < dim; ++d)
        {
          f[d] = of.sign * (1 + j) * v->weight[j] * of.value[e]
                 * v->normal[dim * j + d];
          x[d] = s[side].position[dim * of.node[e] + d];
          force[d] += f[d];
        }
        for (int d = 0; d < 3; ++d)
          moment[d] +=
              x[(d + 1) % 3] * f[(d + 2) % 3] - x[(d + 2) % 3] * f[(d + 1) % 3];
      }
  }
  for (int d = 0; d < 3; ++d)
  {
    near(force[d], 0., force_tolerance, "sum of forces");
    near(moment[d], 0., moment_tolerance, "sum of moments");
  }
}

#endif

/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* One facet and a point: checks, measures, projection, derivatives, clipping.
 * Beside memory and arithmetic the fuzzer looks for results that contradict
 * each other. */
#include "geometry/clip.h"
#include "input.h"
#include <abut/projection.h>

typedef struct facet
{
  abut_facet_kind kind;
  int dimension, n;
  double nodes[27];
} facet;

static void
take_facet(input *in, abut_facet_kind kind, facet *f)
{
  f->kind = kind;
  f->dimension = abut_facet_dimension(kind);
  f->n = abut_facet_n_nodes(kind);
  const int style = take_byte(in) % 3;
  const double scale = take_scale(in);
  const double offset = take_byte(in) % 4 == 0 ? 1e9 * scale : 0.;
  for (int i = 0; i < f->n * f->dimension; ++i)
    f->nodes[i] = take_coordinate(in, style, scale, offset);
}

static double
distance(int dimension, const double *a, const double *b)
{
  double s = 0.;
  for (int d = 0; d < dimension; ++d)
    s += (a[d] - b[d]) * (a[d] - b[d]);
  return sqrt(s);
}

static int
finite_projection(const abut_projection *p)
{
  int finite = isfinite(p->gap) && isfinite(p->distance)
               && isfinite(p->violation) && p->violation >= 0.
               && p->distance >= 0.;
  for (int d = 0; d < 3; ++d)
    finite = finite && isfinite(p->point[d]) && isfinite(p->normal[d]);
  return finite;
}

static void
check_domain(const facet *f, const double *xi)
{
  if (abut_facet_n_corners(f->kind) == 3)
    REQUIRE(xi[0] >= 0. && xi[1] >= 0. && xi[0] + xi[1] <= 1. + 1e-15);
  else
    REQUIRE(fabs(xi[0]) <= 1. && fabs(xi[1]) <= 1.);
}

/* The nearest point is at least as near as each node. */
static void
check_projection(const facet *f, const double *x, const abut_projection *p)
{
  /* Smaller facets than this are no facets. */
  double scale = 1. / ABUT_FACET_LIMIT, nearest = INFINITY;
  REQUIRE(finite_projection(p));
  check_domain(f, p->local);
  for (int i = 0; i < f->n * f->dimension; ++i)
    scale = fmax(scale, fabs(f->nodes[i]));
  for (int d = 0; d < f->dimension; ++d)
    scale = fmax(scale, fabs(x[d]));
  for (int a = 0; a < f->n; ++a)
    nearest =
        fmin(nearest, distance(f->dimension, x, f->nodes + a * f->dimension));
  REQUIRE(p->distance <= nearest + 1e-7 * scale);
  REQUIRE(fabs(p->gap) <= p->distance * (1. + 1e-12) + 1e-7 / ABUT_FACET_LIMIT);
  REQUIRE(!p->inside || p->violation == 0.);
}

static void
check_measures(const facet *f, const double *x, const abut_projection *p)
{
  abut_facet_measures m;
  double lower, upper, scale = 1. / ABUT_FACET_LIMIT;
  REQUIRE(abut_facet_measure(f->kind, f->nodes, &m) == ABUT_SUCCESS);
  REQUIRE(m.area >= 0. && m.radius >= 0. && m.warping >= 0.);
  REQUIRE(m.aspect > 0.);
  for (int d = 0; d < f->dimension; ++d)
  {
    REQUIRE(m.lower[d] <= m.upper[d]);
    scale = fmax(scale, fmax(fabs(m.lower[d]), fabs(m.upper[d])));
    scale = fmax(scale, fabs(x[d]));
  }
  abut_facet_distance_bounds(f->dimension, m.centre, m.radius, x, &lower,
                             &upper);
  REQUIRE(lower <= p->distance + 1e-7 * scale);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  input in = {data, size};
  facet f, g;
  double x[3], gradient[30], hessian[900];
  abut_projection p;
  const abut_facet_kind kind = (abut_facet_kind)(take_byte(&in) % 6);
  take_facet(&in, kind, &f);
  const int style = take_byte(&in) % 3;
  const double scale = take_scale(&in);
  for (int d = 0; d < f.dimension; ++d)
    x[d] = take_coordinate(&in, style, scale, style == 1 ? f.nodes[d] : 0.);
  const abut_facet_fault fault = abut_facet_check(kind, f.nodes);
  REQUIRE(abut_facet_fault_text(fault) != NULL);
  const abut_status status = abut_facet_project(kind, f.nodes, x, &p);
  if (status != ABUT_SUCCESS)
  {
    REQUIRE(status == ABUT_NOT_FINITE);
    return 0;
  }
  check_projection(&f, x, &p);
  check_measures(&f, x, &p);
  if (abut_facet_gap_derivatives(kind, f.nodes, &p, gradient, hessian)
      == ABUT_SUCCESS)
    for (int d = 0; d < f.dimension; ++d)
      REQUIRE(fabs(gradient[d]) <= 1. + 1e-12);
  const int other = take_byte(&in);
  take_facet(
      &in, (abut_facet_kind)(f.dimension == 2 ? other % 2 : 2 + other % 4), &g);
  if (abut_facet_check(g.kind, g.nodes) == ABUT_FACET_FAULT_NONE
      && fault == ABUT_FACET_FAULT_NONE)
    REQUIRE(abut_facet_common_area(kind, f.nodes, g.kind, g.nodes) >= 0.);
  return 0;
}

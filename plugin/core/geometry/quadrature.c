/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Rules of integration. The numbers of the triangles' rules were refined to
 * all digits by Newton's method on the moment equations. */
#include "geometry/quadrature.h"

static const double gauss_point[5][5] = {
    {0.},
    {-0.577350269189625765, 0.577350269189625765},
    {-0.774596669241483377, 0., 0.774596669241483377},
    {-0.861136311594052575, -0.339981043584856265, 0.339981043584856265,
     0.861136311594052575},
    {-0.906179845938663993, -0.538469310105683091, 0., 0.538469310105683091,
     0.906179845938663993}};
static const double gauss_weight[5][5] = {
    {2.},
    {1., 1.},
    {5. / 9., 8. / 9., 5. / 9.},
    {0.347854845137453857, 0.652145154862546143, 0.652145154862546143,
     0.347854845137453857},
    {0.236926885056189088, 0.478628670499366468, 0.568888888888888889,
     0.478628670499366468, 0.236926885056189088}};

/* Orbits of a triangle's rule: n points that are permutations of (a, b, 1 - a
 * - b), n = 1, 3 (a = b) or 6; weights relative to the area. */
typedef struct orbit
{
  int n;
  double weight, a, b;
} orbit;

static const orbit degree2[] = {{3, 1. / 3., 1. / 6., 1. / 6.}};
static const orbit degree4[] = {
    {3, 0.223381589678011466, 0.445948490915964886, 0.445948490915964886},
    {3, 0.109951743655321868, 0.0915762135097707435, 0.0915762135097707435}};
static const orbit degree6[] = {
    {3, 0.116786275726379366, 0.249286745170910421, 0.249286745170910421},
    {3, 0.0508449063702068169, 0.0630890144915022283, 0.0630890144915022283},
    {6, 0.0828510756183735752, 0.310352451033784405, 0.0531450498448169474}};
static const orbit degree8[] = {
    {1, 0.144315607677787168, 1. / 3., 1. / 3.},
    {3, 0.0950916342672846248, 0.459292588292723156, 0.459292588292723156},
    {3, 0.10321737053471825, 0.170569307751760207, 0.170569307751760207},
    {3, 0.0324584976231980803, 0.0505472283170309755, 0.0505472283170309755},
    {6, 0.0272303141744349943, 0.263112829634638113, 0.00839477740995760534}};

const double *
abut_gauss_points(int n)
{
  return gauss_point[n - 1];
}

const double *
abut_gauss_weights(int n)
{
  return gauss_weight[n - 1];
}

static void
add(abut_rule *rule, double xi, double eta, double weight)
{
  rule->local[rule->n][0] = xi;
  rule->local[rule->n][1] = eta;
  rule->weight[rule->n] = weight;
  ++rule->n;
}

static void
triangle(int degree, abut_rule *rule)
{
  const orbit *o = degree <= 2   ? degree2
                   : degree <= 4 ? degree4
                   : degree <= 6 ? degree6
                                 : degree8;
  const int n_orbits = degree <= 2 ? 1 : degree <= 4 ? 2 : degree <= 6 ? 3 : 5;
  for (int i = 0; i < n_orbits; ++i)
  {
    const double a = o[i].a, b = o[i].b, c = 1. - a - b, w = 0.5 * o[i].weight;
    add(rule, a, b, w);
    if (o[i].n >= 3)
    {
      add(rule, a, c, w);
      add(rule, c, a, w);
    }
    if (o[i].n == 6)
    {
      add(rule, b, a, w);
      add(rule, b, c, w);
      add(rule, c, b, w);
    }
  }
}

void
abut_rule_facet(abut_facet_kind kind, int degree, abut_rule *rule)
{
  const int n = degree >= 9 ? 5 : degree / 2 + 1;
  const double *x = gauss_point[n - 1], *w = gauss_weight[n - 1];
  rule->n = 0;
  if (abut_facet_dimension(kind) == 2)
    for (int i = 0; i < n; ++i)
      add(rule, x[i], 0., w[i]);
  else if (abut_facet_n_corners(kind) == 3)
    triangle(degree, rule);
  else
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        add(rule, x[i], x[j], w[i] * w[j]);
}

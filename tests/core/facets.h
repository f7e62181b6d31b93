/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_FACETS_H
#define ABUT_TESTS_FACETS_H

/* Seeded random facets of all kinds for the tests of the geometry. */

#include <abut/facet.h>
#include <math.h>
#include <stdint.h>

/* xorshift64*: the same sequence on every machine. */
static inline double
uniform(uint64_t *state, double lower, double upper)
{
  *state ^= *state >> 12;
  *state ^= *state << 25;
  *state ^= *state >> 27;
  const uint64_t bits = (*state * UINT64_C(2685821657736338717)) >> 11;
  return lower + (upper - lower) * ((double)bits / 9007199254740992.);
}

/* Corners and middle nodes of the reference facet in the plane, edge 2. */
static inline void
reference_nodes(abut_facet_kind kind, double *nodes)
{
  static const double line[3][2] = {{-1, 0}, {1, 0}, {0, 0}};
  static const double triangle[6][2] = {{-1, -1}, {1, -1}, {-1, 1},
                                        {0, -1},  {0, 0},  {-1, 0}};
  static const double square[9][2] = {{-1, -1}, {1, -1}, {-1, 1},
                                      {1, 1},   {-1, 0}, {1, 0},
                                      {0, -1},  {0, 1},  {0, 0}};
  const int n = abut_facet_n_nodes(kind), dim = abut_facet_dimension(kind);
  for (int a = 0; a < n; ++a)
    for (int d = 0; d < dim; ++d)
      nodes[a * dim + d] = d == 2                            ? 0.
                           : dim == 2                        ? line[a][d]
                           : abut_facet_n_corners(kind) == 3 ? triangle[a][d]
                                                             : square[a][d];
}

/* Random rotation from a random quaternion (2D: an angle). */
static inline void
random_rotation(uint64_t *seed, int dim, double *q)
{
  if (dim == 2)
  {
    const double a = uniform(seed, -3.2, 3.2);
    q[0] = q[3] = cos(a);
    q[1] = -sin(a);
    q[2] = sin(a);
    return;
  }
  double u[4], s = 0.;
  for (int i = 0; i < 4; ++i)
    u[i] = uniform(seed, -1., 1.), s += u[i] * u[i];
  s = 2. / s;
  const double w = u[0], x = u[1], y = u[2], z = u[3];
  const double m[9] = {1 - s * (y * y + z * z), s * (x * y - w * z),
                       s * (x * z + w * y),     s * (x * y + w * z),
                       1 - s * (x * x + z * z), s * (y * z - w * x),
                       s * (x * z - w * y),     s * (y * z + w * x),
                       1 - s * (x * x + y * y)};
  for (int i = 0; i < 9; ++i)
    q[i] = m[i];
}

static inline void
rotate(int dim, const double *q, const double *x, double *y)
{
  for (int i = 0; i < dim; ++i)
  {
    y[i] = 0.;
    for (int j = 0; j < dim; ++j)
      y[i] += q[i * dim + j] * x[j];
  }
}

/* Reference facet with each coordinate of each node moved by at most
 * `distortion`, stretched by up to `stretch` along one axis, then rotated. */
static inline void
random_facet(uint64_t *seed, abut_facet_kind kind, double distortion,
             double stretch, double *nodes)
{
  const int n = abut_facet_n_nodes(kind), dim = abut_facet_dimension(kind);
  double q[9], f = pow(stretch, uniform(seed, 0., 1.));
  reference_nodes(kind, nodes);
  random_rotation(seed, dim, q);
  for (int a = 0; a < n; ++a)
  {
    double x[3];
    for (int d = 0; d < dim; ++d)
      x[d] = (nodes[a * dim + d] + uniform(seed, -distortion, distortion))
             * (d == 0 ? f : 1.);
    rotate(dim, q, x, nodes + a * dim);
  }
}

static inline double
distance(int dim, const double *a, const double *b)
{
  double s = 0.;
  for (int d = 0; d < dim; ++d)
    s += (a[d] - b[d]) * (a[d] - b[d]);
  return sqrt(s);
}

#endif

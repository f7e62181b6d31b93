/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* How the tangents of a point that moves rotate with its normal, and the shares
 * of the primary's nodes go on along its facet: all of it is in the second
 * derivatives H of the gap. With its gradient n at the point and - N_a n at the
 * nodes,
 *
 *     dn = H_x du ,    dN_a = - n . H_a du
 *
 * where H_x and H_a are the rows of the point and of node a. The slip along a
 * tangent t changes by t . (dx - sum_a N_a dx_a), whose derivative is
 *
 *     dt at the point,  - N_a dt - dN_a t at node a.
 *
 * With mortar the slip changes by t . sum_l c_l dx_l. The change of n c_l has a
 * part along n, n dc_l, and one across it, c_l dn, so that
 *
 *     d(t c_l) = t dc_l + c_l dt .
 *
 * In space tangents are made of an auxiliary vector, which rotates with the
 * secondary: that rotates them about the normal, too. */
#include "contact/coupling.h"
#include "geometry/vector.h"

#include <string.h>

/* Two vectors that make a frame with the unit normal; see abut_coupling_target.
 */
static void
tangents_of(int dim, const double *n, const double *auxiliary, double (*t)[3])
{
  memset(t, 0, 2 * sizeof(*t));
  if (dim == 2)
  {
    t[0][0] = -n[1];
    t[0][1] = n[0];
    return;
  }
  axpy3(auxiliary, -dot3(auxiliary, n), n, t[0]);
  unit3(t[0], 0.);
  cross3(n, t[0], t[1]);
}

/* Cosine of the angle between a facet and a tangent plane from which on the
 * facet does not show directions in that. */
static const double steepest = 0.5;

/* A direction on a facet that rotates with it: half way between those of its
 * two local coordinates, the second of which is rotated by a right angle, so
 * that shear rotates it by half. */
typedef struct facet_direction
{
  int n_corners;
  const int32_t *node;
  double share[2][4];        /* of the corners in the coordinates' directions */
  double t[2][3], length[2]; /* these, of unit length */
  double n[3], auxiliary[3];
} facet_direction;

static void
look_along(const abut_coupling *c, int32_t f, facet_direction *d)
{
  static const double quadrilateral[2][4] = {{-1., 1., -1., 1.},
                                             {-1., -1., 1., 1.}},
                      triangle[2][4] = {{-1., 1., 0., 0.}, {-1., -1., 2., 0.}};
  const abut_surface_view *v = &c->secondary->view;
  const double *place = abut_coupling_place(c, 0);
  double turned[3];
  memset(d, 0, sizeof(*d));
  d->node = v->connectivity + v->facet_start[f];
  d->n_corners = abut_facet_n_corners((abut_facet_kind)v->kinds[f]);
  memcpy(d->share, d->n_corners == 4 ? quadrilateral : triangle,
         sizeof(d->share));
  for (int k = 0; k < 2; ++k)
  {
    for (int a = 0; a < d->n_corners; ++a)
      axpy3(d->t[k], d->share[k][a], place + 3 * (int64_t)d->node[a], d->t[k]);
    d->length[k] = unit3(d->t[k], 0.);
  }
  cross3(d->t[0], d->t[1], d->n);
  unit3(d->n, 0.);
  cross3(d->t[1], d->n, turned);
  axpy3(d->t[0], 1., turned, d->auxiliary);
  unit3(d->auxiliary, 0.);
}

/* Whether a facet is near the tangent plane of a unit normal; then the
 * auxiliary vector is its direction. */
static bool
auxiliary_of_facet(const abut_coupling *c, int32_t f, const double *normal,
                   double *auxiliary)
{
  facet_direction d;
  look_along(c, f, &d);
  if (!(fabs(dot3(d.n, normal)) > steepest))
    return false;
  memcpy(auxiliary, d.auxiliary, sizeof(d.auxiliary));
  return true;
}

/* The facet of a node with the smallest number, so that it is the same wherever
 * the node goes; -1: there is none. */
static int32_t
auxiliary_of_node(const abut_coupling *c, int32_t node, const double *normal,
                  double *auxiliary)
{
  const abut_surface_view *v = &c->secondary->view;
  int64_t least = INT64_MAX;
  int32_t found = -1;
  for (int32_t e = v->node_start[node]; e < v->node_start[node + 1]; ++e)
  {
    const int32_t f = v->node_facet[e];
    const int64_t id = abut_surface_facet_id(c->secondary, f);
    if (id >= least || !auxiliary_of_facet(c, f, normal, auxiliary))
      continue;
    least = id;
    found = f;
  }
  return found;
}

int32_t
abut_coupling_auxiliary_vector(const abut_coupling *c,
                               const abut_coupling_share *share,
                               const double *normal, double *auxiliary)
{
  int32_t facet = -1;
  memset(auxiliary, 0, 3 * sizeof(*auxiliary));
  if (c->secondary->view.dimension == 2)
    return -1;
  if (c->kinematics->directions != ABUT_CONFIGURATION_REFERENCE)
    facet =
        share->node >= 0 ? auxiliary_of_node(c, share->node, normal, auxiliary)
        : auxiliary_of_facet(c, share->facet, normal, auxiliary) ? share->facet
                                                                 : -1;
  if (facet >= 0)
    return facet;
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (fabs(normal[d]) < fabs(normal[axis]))
      axis = d;
  auxiliary[axis] = 1.;
  return -1;
}

/* With the directions a and b of the coordinates, the facet's normal N and the
 * auxiliary vector g = p a + q b, dg is half the rotations of a and b about N,
 * and the part p da . N + q db . N along N. Tangents rotate by t2 . dg / |g - n
 * n . g|.
 */
int
abut_coupling_tangent_rotation(const abut_coupling *c, int32_t facet,
                               const double *normal, const int32_t **node,
                               double (*rotation)[3])
{
  facet_direction d;
  double t[2][3], across[3], turned[3], by[2][3] = {{0.}, {0.}};
  look_along(c, facet, &d);
  tangents_of(3, normal, d.auxiliary, t);
  axpy3(d.auxiliary, -dot3(d.auxiliary, normal), normal, across);
  const double length = norm3(across);
  cross3(d.n, d.auxiliary, across);
  const double half = 0.5 * dot3(t[1], across), out = dot3(t[1], d.n);
  cross3(d.t[0], d.t[1], turned);
  const double det = dot3(turned, d.n);
  for (int k = 0; k < 2; ++k)
  {
    cross3(d.auxiliary, d.t[1 - k], turned);
    const double part = (k == 0 ? 1. : -1.) * dot3(turned, d.n) / det;
    cross3(d.n, d.t[k], turned);
    axpy3(by[k], half / (d.length[k] * length), turned, by[k]);
    axpy3(by[k], part * out / (d.length[k] * length), d.n, by[k]);
  }
  memset(rotation, 0, (size_t)d.n_corners * sizeof(*rotation));
  for (int a = 0; a < d.n_corners; ++a)
    for (int k = 0; k < 2; ++k)
      axpy3(rotation[a], d.share[k][a], by[k], rotation[a]);
  *node = d.node;
  return d.n_corners;
}

void
abut_coupling_tangents(int32_t dim, const double *normal,
                       const double *auxiliary, double *tangents)
{
  double t[2][3];
  tangents_of(dim, normal, auxiliary, t);
  for (int k = 0; k < dim - 1; ++k)
    memcpy(tangents + k * dim, t[k], sizeof(double) * (size_t)dim);
}

/* How they change as the unit normal does, while their auxiliary vector stays.
 */
static void
differentiate_tangents(int dim, const double *n, const double *auxiliary,
                       const double *dn, double (*dt)[3])
{
  double t[2][3], a[3], b[3];
  tangents_of(dim, n, auxiliary, t);
  memset(dt, 0, 2 * sizeof(*dt));
  if (dim == 2)
  {
    dt[0][0] = -dn[1];
    dt[0][1] = dn[0];
    return;
  }
  /* Derivative of v = e - (e . n) n, which is made a unit vector. */
  const double along = dot3(auxiliary, n), change = dot3(auxiliary, dn);
  axpy3(auxiliary, -along, n, a);
  const double length = norm3(a);
  for (int d = 0; d < 3; ++d)
    dt[0][d] = -(change * n[d] + along * dn[d]) / length;
  axpy3(dt[0], -dot3(dt[0], t[0]), t[0], dt[0]);
  cross3(dn, t[0], a);
  cross3(n, dt[0], b);
  axpy3(a, 1., b, dt[1]);
}

void
abut_coupling_tangent_derivatives(int32_t dim, int32_t n, const double *normal,
                                  const double *auxiliary, const double *shape,
                                  const double *hessian, double *turning)
{
  double unit[3] = {0., 0., 0.}, t[2][3];
  memcpy(unit, normal, sizeof(double) * (size_t)dim);
  tangents_of(dim, unit, auxiliary, t);
  for (int32_t u = 0; u < n; ++u)
  {
    /* The normal is minus the gradient. */
    double dn[3] = {0., 0., 0.}, dt[2][3];
    for (int d = 0; d < dim; ++d)
      dn[d] = -hessian[d * n + u];
    axpy3(dn, -dot3(dn, unit), unit, dn);
    differentiate_tangents(dim, unit, auxiliary, dn, dt);
    for (int32_t a = 0; a < n / dim; ++a)
    {
      double share = 1., change = 0.;
      for (int d = 0; a > 0 && d < dim; ++d)
        change += unit[d] * hessian[(a * dim + d) * n + u];
      if (a > 0)
        share = -shape[a - 1];
      for (int k = 0; k < dim - 1; ++k)
        for (int d = 0; d < dim; ++d)
          turning[((int64_t)k * n + a * dim + d) * n + u] =
              share * dt[k][d] - change * t[k][d];
    }
  }
}

void
abut_coupling_tangent_derivatives_of_lines(int32_t dim, int32_t n_lines,
                                           int64_t n_columns,
                                           const double *normal,
                                           const double *auxiliary,
                                           const double *block, double *turning)
{
  double unit[3] = {0., 0., 0.}, t[2][3];
  const int64_t size = n_lines * dim * n_columns;
  memcpy(unit, normal, sizeof(double) * (size_t)dim);
  tangents_of(dim, unit, auxiliary, t);
  for (int32_t l = 0; l < n_lines; ++l)
    for (int64_t u = 0; u < n_columns; ++u)
    {
      double way[3] = {0., 0., 0.}, dt[2][3];
      const int64_t first = (int64_t)l * dim * n_columns + u;
      for (int d = 0; d < dim; ++d)
        way[d] = -block[first + d * n_columns];
      const double change = dot3(unit, way);
      axpy3(way, -change, unit, way);
      differentiate_tangents(dim, unit, auxiliary, way, dt);
      for (int k = 0; k < dim - 1; ++k)
        for (int d = 0; d < dim; ++d)
          turning[k * size + first + d * n_columns] =
              change * t[k][d] + dt[k][d];
    }
}

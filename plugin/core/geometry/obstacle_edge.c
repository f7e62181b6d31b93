/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Contact of a body near a convex edge, corner or tip of an obstacle.
 *
 * The gradient of the distance jumps there: inside the material from one flank
 * to the other, and outside, close to the edge, within the cone of their
 * normals. Contact of a tip with a smooth body is that of a vertex with a face:
 * its direction is the body's. So, with m the body's outward normal,
 *
 *   d = projection of -m onto the cone of the flanks' normals,
 *   gap = way along d from the obstacle's surface to the point.
 *
 * The flanks are found by the obstacle's gradient alone, so that all kinds are
 * the same: from the place where the line along m through the point meets the
 * surface, probes of a given length go along the surface to all sides of m, and
 * a jump of the gradient on the way is enclosed by bisection. A gradient that
 * only changes gradually has no such place: such points stay as they are.
 * Within half of the length of the probes d and the gap have no share of the
 * nearest flank, beyond their length nothing else; a smooth weight of the
 * edge's distance is between, so that direction and gap are continuous. Edges
 * of concave corners are left out: there the nearest flank is right on both
 * sides.
 *
 * Cost: for points near the obstacle 2 (2D) or 9 (3D) probes, with 29
 * bisections for each that meets an edge. */
#include "geometry/kernels.h"
#include "geometry/obstacle.h"
#include "geometry/vector.h"

#include <abut/obstacle_edge.h>

#include <string.h>

enum
{
  MAX_PROBES = 8,
  MAX_NORMALS = 24,
  N_ENCLOSING = 9,
  N_LOCATING = 20,
  MAX_STEPS = 40
};

/* Change of the normal that may be an edge. */
static const double least_change = 1e-3;

/* Lengths of probes: how far inside they start; what a line may pass beside. */
static const double inside_part = 1e-7, beside_part = 1e-6;

/* Cosine of a line and a flank below which they count as parallel. */
static const double least_cosine = 0.02;

/* A point with its body's normal, and the obstacle that it is near to. */
typedef struct seeker
{
  abut_obstacle *obstacle;
  bool moving;
  int dim;
  abut_status status;
  double x[3], along[3]; /* the point; -m */
  double length;         /* of probes */
  double distance, nearest[3];
} seeker;

/* Normals around a place of the surface, its own first, and the weight of the
 * nearest edge. */
typedef struct flanks
{
  double normal[MAX_NORMALS][3];
  int n;
  double weight;
} flanks;

/* Distance and gradient at x; NaN after a failure. */
static double
look(seeker *s, const double *x, double *normal)
{
  double distance = NAN;
  memset(normal, 0, 3 * sizeof(*normal));
  if (s->status == ABUT_SUCCESS)
    s->status = (s->moving ? abut_obstacle_gap : abut_obstacle_distance)(
        s->obstacle, 1, x, &distance, normal, NULL);
  return s->status == ABUT_SUCCESS ? distance : NAN;
}

/* Way along d from the surface to the point, by Newton's method from outside:
 * along a line the distance from a convex obstacle is convex, and the iteration
 * monotone. False: the line passes beside. */
static bool
find_gap(seeker *s, const double *d, double *gap)
{
  double t = max2(s->length - s->distance, 0.), n[3], x[3];
  bool outside = false;
  for (int k = 0; k < MAX_STEPS; ++k)
  {
    axpy3(s->x, t, d, x);
    const double f = look(s, x, n), cosine = dot3(n, d);
    if (!outside && f < 0.)
    {
      t += 2. * (s->length - f);
      continue;
    }
    outside = true;
    if (cosine < least_cosine)
    {
      *gap = -t;
      return fabs(f) <= beside_part * s->length;
    }
    t -= f / cosine;
    if (!(fabs(f) > 1e-12 * s->length * cosine))
    {
      *gap = -t;
      return f == f;
    }
  }
  return false;
}

static double
change(const double *a, const double *b)
{
  double c[3];
  sub3(a, b, c);
  return norm3(c);
}

/* Halve the interval from a to b on the way from y along e where the normal
 * changes from `before` to `behind`: the part with the larger change is left.
 * Returns that change. */
static double
halve(seeker *s, const double *y, const double *e, double *a, double *b,
      double *before, double *behind)
{
  const double c = 0.5 * (*a + *b);
  double middle[3], x[3];
  axpy3(y, c, e, x);
  look(s, x, middle);
  const double first = change(before, middle), last = change(middle, behind);
  const bool is_first = first >= last;
  memcpy(is_first ? behind : before, middle, sizeof(middle));
  *(is_first ? b : a) = c;
  return max2(first, last);
}

/* The edge on the way from y along e, if there is one: its distance, and the
 * normal behind it. */
static bool
find_edge(seeker *s, const double *y, const double *e, const double *own,
          double *distance, double *behind)
{
  double a = 0., b = s->length, before[3], last[3], x[3], jump[3];
  memcpy(before, own, sizeof(before));
  axpy3(y, b, e, x);
  look(s, x, behind);
  double total = change(before, behind);
  for (int k = 0; k < N_ENCLOSING && total > least_change; ++k)
  {
    const double left = halve(s, y, e, &a, &b, before, behind);
    /* A normal that changes gradually changes in both halves. */
    if (left < 0.6 * total)
      return false;
    total = left;
  }
  sub3(behind, before, jump);
  if (!(total > least_change && dot3(jump, e) > 0.))
    return false;
  /* Closer, only its place: gradients by differences change gradually here. */
  memcpy(last, behind, sizeof(last));
  for (int k = 0; k < N_LOCATING; ++k)
    halve(s, y, e, &a, &b, before, last);
  *distance = a;
  return true;
}

/* 1 up to a half, 0 from 1, with continuous derivatives. */
static double
fade(double part)
{
  const double r = clamp(2. * part - 1., 0., 1.);
  return 1. - r * r * (3. - 2. * r);
}

/* The k-th of the directions across d. */
static void
across(int dim, const double *d, int k, double *e)
{
  static const double half = 0.70710678118654752;
  static const double around[MAX_PROBES][2] = {
      {1., 0.},  {half, half},   {0., 1.},  {-half, half},
      {-1., 0.}, {-half, -half}, {0., -1.}, {half, -half}};
  double first[3] = {-d[1], d[0], 0.}, second[3] = {0., 0., 0.};
  if (dim == 3)
  {
    int smallest = 0;
    for (int i = 1; i < 3; ++i)
      if (fabs(d[i]) < fabs(d[smallest]))
        smallest = i;
    memset(first, 0, sizeof(first));
    first[smallest] = 1.;
    axpy3(first, -d[smallest], d, first);
    unit3(first, 0.);
    cross3(d, first, second);
  }
  const double *c = around[dim == 2 ? 4 * k : k];
  for (int i = 0; i < 3; ++i)
    e[i] = c[0] * first[i] + c[1] * second[i];
}

/* Add a normal behind an edge, with the weight of that edge, unless it is
 * there. */
static void
add_flank(flanks *f, const double *behind, double weight)
{
  const double *own = f->normal[0];
  double n[3];
  for (int i = 0; i < 3; ++i)
    n[i] = own[i] + weight * (behind[i] - own[i]);
  unit3(n, ABUT_TINY);
  bool is_new = weight > 0. && f->n < MAX_NORMALS;
  for (int j = 0; j < f->n && is_new; ++j)
    is_new = change(n, f->normal[j]) > 1e-10;
  if (is_new)
    memcpy(f->normal[f->n++], n, sizeof(n));
}

/* Add all flanks that meet at the place v of an edge, such as those of a
 * corner. */
static void
add_all(seeker *s, const double *y, const double *v, double weight, flanks *f)
{
  static const double around_part = 0.1;
  for (int k = 0; k < MAX_PROBES; ++k)
  {
    double e[3], x[3], way[3], n[3], jump[3];
    across(3, s->along, k, e);
    axpy3(e, -1., s->along, e);
    axpy3(v, around_part * s->length, e, x);
    look(s, x, n);
    sub3(n, f->normal[0], jump);
    sub3(x, y, way);
    if (norm3(jump) > least_change && dot3(jump, way) > 0.)
      add_flank(f, n, weight);
  }
}

/* The direction down along the surface at y in which it is straight, where it
 * is curved across: that of the tip of a cone, which no other line meets. False
 * where the surface is plane. */
static bool
find_straight(seeker *s, const double *y, const double *own, double *e)
{
  double distance = 0., normal[3], hessian[9], around[3] = {0., 0., 0.};
  if (s->status == ABUT_SUCCESS)
    s->status = (s->moving ? abut_obstacle_gap : abut_obstacle_distance)(
        s->obstacle, 1, y, &distance, normal, hessian);
  if (s->status != ABUT_SUCCESS)
    return false;
  for (int k = 0; k < 3; ++k)
    if (norm3(hessian + 3 * k) > norm3(around))
      memcpy(around, hessian + 3 * k, sizeof(around));
  if (!(norm3(around) * s->length > least_change))
    return false;
  cross3(own, around, e);
  unit3(e, ABUT_TINY);
  const double sign = dot3(e, s->along) < 0. ? -1. : 1.;
  for (int i = 0; i < 3; ++i)
    e[i] *= sign;
  return true;
}

/* The way of probe k from a place y with this normal: across the body's normal,
 * and along the surface, if that is not too steep; its length is the way across
 * but for slopes above 8. */
static bool
find_way(seeker *s, int k, const double *y, const double *own, double *e)
{
  const double cosine = dot3(own, s->along);
  if (k < MAX_PROBES)
    across(s->dim, s->along, k, e);
  else if (!find_straight(s, y, own, e))
    return false;
  else
  {
    axpy3(e, -dot3(e, s->along), s->along, e);
    unit3(e, ABUT_TINY);
  }
  if (cosine < least_cosine)
    return true;
  axpy3(e, -dot3(e, own) / cosine, s->along, e);
  const double length = norm3(e);
  for (int i = 0; i < 3; ++i)
    e[i] /= max2(1., 0.125 * length);
  return true;
}

/* Flanks around the surface's place y; none but its own where there is no edge.
 * Normals of edges that are farther count less. */
static void
find_flanks(seeker *s, const double *y, flanks *found)
{
  const int n_probes = s->dim == 2 ? 2 : MAX_PROBES + 1;
  look(s, y, found->normal[0]);
  found->n = 1;
  found->weight = 0.;
  for (int k = 0; k < n_probes; ++k)
  {
    double e[3], v[3], behind[3], distance;
    if (!find_way(s, k, y, found->normal[0], e)
        || !find_edge(s, y, e, found->normal[0], &distance, behind))
      continue;
    const double weight = fade(distance / s->length);
    add_flank(found, behind, weight);
    axpy3(y, distance, e, v);
    if (s->dim == 3 && weight > 0.)
      add_all(s, y, v, weight, found);
    found->weight = max2(found->weight, weight);
  }
}

/* The nearest vector to v of those that are sums of these with coefficients
 * above 0, as a unit vector: if it is nearer than the best one so far, it takes
 * its place. */
static void
try_pair(const double *v, const double *a, const double *b, double *cosine,
         double *best)
{
  const double ab = dot3(a, b), va = dot3(v, a), vb = dot3(v, b);
  const double ca = va - ab * vb, cb = vb - ab * va;
  if (!(ca >= 0. && cb >= 0. && 1. - ab * ab > 1e-14))
    return;
  double sum[3];
  for (int i = 0; i < 3; ++i)
    sum[i] = ca * a[i] + cb * b[i];
  unit3(sum, ABUT_TINY);
  if (!(dot3(sum, v) > *cosine))
    return;
  *cosine = dot3(sum, v);
  memcpy(best, sum, sizeof(sum));
}

static bool
is_between(const double *v, const double *a, const double *b, const double *c)
{
  double ab[3], bc[3], ca[3];
  cross3(a, b, ab);
  cross3(b, c, bc);
  cross3(c, a, ca);
  const double volume = dot3(ab, c), sign = volume < 0. ? -1. : 1.;
  return fabs(volume) > 1e-12 && sign * dot3(v, ab) >= 0.
         && sign * dot3(v, bc) >= 0. && sign * dot3(v, ca) >= 0.;
}

/* Projection of the unit vector v onto the cone of the normals, as a unit
 * vector. It lies in a cone of at most three of them. False: v is on the other
 * side of all. */
static bool
limit_to_cone(const flanks *f, const double *v, double *result)
{
  double cosine = 0.;
  for (int i = 0; i < f->n; ++i)
  {
    const double *a = f->normal[i];
    if (dot3(v, a) > cosine)
    {
      cosine = dot3(v, a);
      memcpy(result, a, 3 * sizeof(*a));
    }
    for (int j = 0; j < i; ++j)
    {
      try_pair(v, a, f->normal[j], &cosine, result);
      for (int k = 0; k < j; ++k)
        if (is_between(v, a, f->normal[j], f->normal[k]))
        {
          memcpy(result, v, 3 * sizeof(*v));
          return true;
        }
    }
  }
  /* v itself, without the round-off of its projection. */
  if (cosine > 1. - 1e-14)
    memcpy(result, v, 3 * sizeof(*v));
  return cosine > 0.;
}

/* Direction and gap of the point; false: it is not near an edge. */
static bool
find_contact(seeker *s, double *gap, double *direction, double *weight)
{
  const double inside = inside_part * s->length;
  double y[3], along = 0.;
  flanks f;
  const bool met = find_gap(s, s->along, &along);
  if (met)
    axpy3(s->x, -along - inside, s->along, y);
  else
    axpy3(s->x, -s->distance - inside, s->nearest, y);
  find_flanks(s, y, &f);
  if (!(f.weight > 0.) || !limit_to_cone(&f, s->along, direction))
    return false;
  *weight = f.weight;
  if (met && change(direction, s->along) < 1e-14)
    *gap = along;
  else if (!find_gap(s, direction, gap))
    /* The line is beside the obstacle: it meets the flank's plane far off. */
    *gap = s->distance / max2(dot3(direction, s->nearest), least_cosine);
  return s->status == ABUT_SUCCESS;
}

/* Blend what has been found with the nearest flank's. */
static void
store(const seeker *s, double gap, const double *direction, double weight,
      double *distance, double *gradient, double *hessian)
{
  double n[3];
  for (int i = 0; i < 3; ++i)
    n[i] = weight * direction[i] + (1. - weight) * s->nearest[i];
  unit3(n, ABUT_TINY);
  *distance = weight * gap + (1. - weight) * s->distance;
  memcpy(gradient, n, (size_t)s->dim * sizeof(*n));
  for (int i = 0; hessian != NULL && i < s->dim * s->dim; ++i)
    hessian[i] *= 1. - weight;
}

bool
abut_obstacle_has_edges(const abut_obstacle *o)
{
  return !o->smooth;
}

abut_status
abut_obstacle_face(abut_obstacle *o, bool moving, int32_t n,
                   const double *points, const double *normals,
                   const double *sizes, double *gap, double *gradient,
                   double *hessian)
{
  static const double probe_part = 0.25, opposite = -0.5;
  if (o == NULL)
    return ABUT_INVALID_ARGUMENT;
  if (n < 0
      || (n > 0
          && (points == NULL || normals == NULL || sizes == NULL || gap == NULL
              || gradient == NULL)))
    return abut_fail(o->context, ABUT_INVALID_ARGUMENT, "abut_obstacle_face",
                     "n is negative, or an array is NULL");
  const int dim = o->view.dimension;
  const int64_t n_beyond = o->view.n_beyond;
  seeker s = {o, moving, dim, ABUT_SUCCESS, {0.}, {0.}, 0., 0., {0.}};
  for (int64_t i = 0; i < n && abut_obstacle_has_edges(o); ++i)
  {
    double along = 0., direction[3] = {0., 0., 0.}, weight = 0.;
    s.length = probe_part * sizes[i];
    s.distance = gap[i];
    for (int d = 0; d < dim; ++d)
    {
      s.x[d] = points[i * dim + d];
      s.along[d] = -normals[i * dim + d];
      s.nearest[d] = gradient[i * dim + d];
    }
    if (gap[i] > sizes[i] || !(s.length > 0.)
        || dot3(s.along, s.nearest) <= opposite)
      continue;
    if (find_contact(&s, &along, direction, &weight))
      store(&s, along, direction, weight, gap + i, gradient + i * dim,
            hessian == NULL ? NULL : hessian + i * dim * dim);
    if (s.status != ABUT_SUCCESS)
      break;
  }
  o->view.n_beyond = n_beyond;
  return s.status;
}

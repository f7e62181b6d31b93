/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Nearest point of a curved or warped surface facet.
 *
 * Candidates are the global minima on the edges (closed form, see parabola.c)
 * and local minima inside. First one Newton iteration from the middle; if what
 * it finds, or else the best edge point, can be proved to be the global
 * minimum, that is all. The proof: let y be a point that meets the first-order
 * conditions, r = x - y, and z another point of the facet, at local distance D
 * (each coordinate scaled by its tangent's length at the middle). Then
 *
 *     |x - z|^2 = |r|^2 + |y - z|^2 - 2 r.(z - y),
 *     |y - z| >= (s - e) |D|,   r.(z - y) <= K |D|^2 / 2
 *
 * with s the smallest singular value of the scaled tangents at the middle, e
 * the largest change of the tangents within their plane, K the largest second
 * derivative along r. So (s - e)^2 >= K suffices. Else the facet is sampled on
 * a grid and Newton runs from each sample that is a minimum along one
 * coordinate: the number of steps is bounded, and the best point found is
 * returned in any case. */
#include "geometry/finish.h"
#include "geometry/patch.h"

enum
{
  max_steps = 60,
  n_short = 8, /* steps from a sample, before the best is followed to its end */
  n_samples = 9,
  n_restarts = 4
};

/* Round-off of the objective. */
static double
objective_noise(const abut_patch *patch, const double *x)
{
  return 4e-16 * patch->size * (patch->size + norm3(x));
}

double
abut_patch_objective(const double *x, const double *y)
{
  return 0.5 * dot3(y, y) - dot3(x, y);
}

/* Local coordinates at t in [-1, 1] of an edge. */
static void
edge_point(int triangle, int edge, double t, double *local)
{
  const double l = 0.5 * (1. - t), r = 0.5 * (1. + t);
  if (triangle)
  {
    local[0] = edge == 0 ? r : edge == 1 ? l : 0.;
    local[1] = edge == 0 ? 0. : edge == 1 ? r : l;
    return;
  }
  const double side = edge % 2 == 0 ? -1. : 1.;
  local[0] = edge < 2 ? side : t;
  local[1] = edge < 2 ? t : side;
}

double
abut_patch_nearest_on_edges(const abut_patch *patch, const double *x,
                            double *local, int32_t *iterations)
{
  double best = INFINITY;
  for (int e = 0; e < (patch->triangle ? 3 : 4); ++e)
  {
    abut_patch_point p[3], q;
    double c[3][3], at[2];
    for (int k = 0; k < 3; ++k)
    {
      edge_point(patch->triangle, e, k - 1., at);
      abut_patch_evaluate(patch, at[0], at[1], &p[k]);
    }
    for (int i = 0; i < 3; ++i)
    {
      const double l = p[0].y[i] - p[1].y[i], r = p[2].y[i] - p[1].y[i];
      c[0][i] = p[1].y[i];
      c[1][i] = 0.5 * (r - l);
      c[2][i] = patch->n_terms == 4 ? 0. : 0.5 * (r + l);
    }
    const double t = abut_parabola_nearest(c[0], x, iterations);
    edge_point(patch->triangle, e, t, at);
    abut_patch_evaluate(patch, at[0], at[1], &q);
    const double f = abut_patch_objective(x, q.y);
    if (f < best)
    {
      best = f;
      local[0] = at[0];
      local[1] = at[1];
    }
  }
  return best;
}

/* Does a step d from local lead out of the reference domain at once? Else the
 * largest multiple of it that stays inside, at most 1. */
static double
largest_step(int triangle, const double *local, const double *d)
{
  double t = 1.;
  for (int i = 0; i < 2; ++i)
  {
    const double lower = triangle ? 0. : -1.;
    if (d[i] < 0.)
      t = min2(t, (lower - local[i]) / d[i]);
    else if (!triangle && d[i] > 0.)
      t = min2(t, (1. - local[i]) / d[i]);
  }
  if (triangle && d[0] + d[1] > 0.)
    t = min2(t, (1. - local[0] - local[1]) / (d[0] + d[1]));
  return max2(t, 0.);
}

double
abut_patch_descent(const abut_patch *patch, const double *x,
                   const double *local, const abut_patch_point *p)
{
  /* Directions along which the point may move; their rate of descent. */
  static const double square[4][2] = {{1., 0.}, {-1., 0.}, {0., 1.}, {0., -1.}};
  static const double corner[6][2] = {{1., 0.},  {-1., 0.}, {0., 1.},
                                      {0., -1.}, {1., -1.}, {-1., 1.}};
  const int n = patch->triangle ? 6 : 4;
  double r[3], best = 0.;
  sub3(x, p->y, r);
  for (int k = 0; k < n; ++k)
  {
    const double *d = patch->triangle ? corner[k] : square[k];
    if (!(largest_step(patch->triangle, local, d) > 1e-14))
      continue;
    double t[3];
    for (int i = 0; i < 3; ++i)
      t[i] = d[0] * p->y1[i] + d[1] * p->y2[i];
    const double length = norm3(t);
    if (length > 0.)
      best = max2(best, dot3(r, t) / length);
  }
  return best;
}

/* Step -(H + shift diag(A))^-1 g; the shift grows until the matrix is positive
 * definite. */
static void
newton_step(const abut_patch_point *p, const double *r, double *shift,
            double *step)
{
  const double g1 = dot3(r, p->y1), g2 = dot3(r, p->y2);
  const double a11 = dot3(p->y1, p->y1), a22 = dot3(p->y2, p->y2);
  const double tiny = 1e-14 * (a11 + a22);
  const double d1 = max2(a11, tiny), d2 = max2(a22, tiny);
  const double b11 = dot3(r, p->y11), b22 = dot3(r, p->y22),
               h12 = dot3(p->y1, p->y2) - dot3(r, p->y12);
  step[0] = step[1] = 0.;
  for (int i = 0; i < 200; ++i)
  {
    const double h11 = a11 - b11 + *shift * d1, h22 = a22 - b22 + *shift * d2,
                 det = h11 * h22 - h12 * h12;
    if (h11 > 0. && h22 > 0. && det > 1e-13 * h11 * h22)
    {
      step[0] = (g1 * h22 - g2 * h12) / det;
      step[1] = (g2 * h11 - g1 * h12) / det;
      return;
    }
    *shift = *shift > 0. ? 4. * *shift : 1e-3;
  }
}

/* Newton step along the edge on which local lies and out of which the step
 * leads; zero at a corner. */
static void
slide(int triangle, const abut_patch_point *p, const double *r,
      const double *local, double shift, double *step)
{
  double e[2] = {0., 0.}, t[3], c[3];
  const double lower = triangle ? 0. : -1.;
  for (int i = 0; i < 2; ++i)
    if ((local[i] <= lower && step[i] < 0.)
        || (!triangle && local[i] >= 1. && step[i] > 0.))
      e[1 - i] = 1.;
  if (triangle && e[0] == 0. && e[1] == 0.)
  {
    e[0] = 1.;
    e[1] = -1.;
  }
  step[0] = step[1] = 0.;
  if (e[0] * e[1] > 0.)
    return;
  for (int i = 0; i < 3; ++i)
  {
    t[i] = e[0] * p->y1[i] + e[1] * p->y2[i];
    c[i] = e[0] * e[0] * p->y11[i] + e[1] * e[1] * p->y22[i]
           + 2. * e[0] * e[1] * p->y12[i];
  }
  const double tt = dot3(t, t), h = (1. + shift) * tt - dot3(r, c);
  if (!(tt > 0.))
    return;
  const double length = dot3(r, t) / (h > 0. ? h : tt);
  step[0] = length * e[0];
  step[1] = length * e[1];
}

int
abut_patch_descend(const abut_patch *patch, const double *x, int n_steps,
                   double *local, double *objective, int32_t *iterations)
{
  abut_patch_point p;
  abut_patch_evaluate(patch, local[0], local[1], &p);
  double f = abut_patch_objective(x, p.y), shift = 0.;
  const double distance = norm3(x);
  const double small = max2(1e-9 * patch->size, 1e-15 * distance);
  const double noise = objective_noise(patch, x);
  int converged = 0;
  for (int k = 0; k < n_steps && !converged; ++k)
  {
    double r[3], d[2], next[2];
    sub3(x, p.y, r);
    newton_step(&p, r, &shift, d);
    double t = largest_step(patch->triangle, local, d);
    const int at_edge = t == 0.;
    if (at_edge)
    {
      slide(patch->triangle, &p, r, local, shift, d);
      t = largest_step(patch->triangle, local, d);
      if (t == 0. || (d[0] == 0. && d[1] == 0.))
        break;
    }
    const double l1 = d[0] * d[0] * dot3(p.y1, p.y1),
                 l2 = d[1] * d[1] * dot3(p.y2, p.y2);
    const int last = t == 1. && l1 + l2 <= small * small;
    converged = last && shift == 0. && !at_edge;
    for (int i = 0; i < 2; ++i)
      next[i] = clamp(local[i] + t * d[i], patch->triangle ? 0. : -1., 1.);
    if (patch->triangle && next[0] + next[1] > 1.)
      next[1] = 1. - next[0];
    abut_patch_point q;
    abut_patch_evaluate(patch, next[0], next[1], &q);
    const double g = abut_patch_objective(x, q.y);
    ++*iterations;
    if (g <= f + noise)
    {
      if (last && at_edge)
        k = n_steps;
      local[0] = next[0];
      local[1] = next[1];
      f = g;
      p = q;
      shift = shift > 1e-3 ? 0.25 * shift : 0.;
    }
    else
    {
      shift = shift > 0. ? 4. * shift : 1e-3;
      converged = 0;
    }
  }
  *objective = f;
  return converged;
}

/* Bounds over the domain of the derivatives of each term beyond the linear
 * ones: change of the tangents from the middle, and second derivatives. */
typedef struct term_bounds
{
  double d1[9], d2[9], d11[9], d22[9], d12[9];
} term_bounds;

static const term_bounds square_bounds = {{0, 0, 0, 1, 2, 0, 2, 1, 2},
                                          {0, 0, 0, 1, 0, 2, 1, 2, 2},
                                          {0, 0, 0, 0, 2, 0, 2, 0, 2},
                                          {0, 0, 0, 0, 0, 2, 0, 2, 2},
                                          {0, 0, 0, 1, 0, 0, 2, 2, 4}};
static const term_bounds triangle_bounds = {{0, 0, 0, 2. / 3., 4. / 3.},
                                            {0, 0, 0, 2. / 3., 0, 4. / 3.},
                                            {0, 0, 0, 0, 2},
                                            {0, 0, 0, 0, 0, 2},
                                            {0, 0, 0, 1}};

/* See the head comment: can there be another, nearer point? */
static int
surely_global(const abut_patch *patch, const double *x, const double *y)
{
  const term_bounds *t = patch->triangle ? &triangle_bounds : &square_bounds;
  const double middle = patch->triangle ? 1. / 3. : 0.;
  abut_patch_point p;
  double n[3], r[3], e1 = 0., e2 = 0., k11 = 0., k22 = 0., k12 = 0.;
  abut_patch_evaluate(patch, middle, middle, &p);
  cross3(p.y1, p.y2, n);
  const double l1 = norm3(p.y1), l2 = norm3(p.y2);
  if (!(l1 > 0. && l2 > 0. && unit3(n, ABUT_TINY) > 0.))
    return 0;
  sub3(x, y, r);
  for (int k = 3; k < patch->n_terms; ++k)
  {
    const double *c = patch->c[k];
    const double cn = dot3(c, n), l = sqrt(max2(dot3(c, c) - cn * cn, 0.)),
                 rc = fabs(dot3(r, c));
    e1 += t->d1[k] * l;
    e2 += t->d2[k] * l;
    k11 += t->d11[k] * rc;
    k22 += t->d22[k] * rc;
    k12 += t->d12[k] * rc;
  }
  const double cosine = min2(1., fabs(dot3(p.y1, p.y2)) / (l1 * l2));
  const double s = sqrt(1. - cosine) - hypot(e1 / l1, e2 / l2);
  const double u = k11 / (l1 * l1), v = k22 / (l2 * l2), w = k12 / (l1 * l2);
  return s > 0. && s * s >= sqrt(u * u + v * v + 2. * w * w);
}

/* Newton from each sample of a grid that is a minimum along xi or along eta: a
 * minimum at the bottom of a bent valley need not be one among the samples. */
static void
search_samples(const abut_patch *patch, const double *x, double *local,
               double *best, int32_t *iterations)
{
  double f[n_samples + 2][n_samples + 2];
  const int n = n_samples;
  /* On a tie the edge point stays, which is more accurate. */
  const double noise = objective_noise(patch, x);
  const double step = (patch->triangle ? 1. : 2.) / (n - 1);
  const double lower = patch->triangle ? 0. : -1.;
  for (int i = 0; i < n + 2; ++i)
    for (int j = 0; j < n + 2; ++j)
    {
      f[i][j] = INFINITY;
      if (i == 0 || j == 0 || i > n || j > n
          || (patch->triangle && i + j > n + 1))
        continue;
      abut_patch_point p;
      abut_patch_evaluate(patch, lower + step * (i - 1), lower + step * (j - 1),
                          &p);
      f[i][j] = abut_patch_objective(x, p.y);
    }
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= n; ++j)
    {
      const double m = f[i][j];
      if (!(m < INFINITY)
          || !((m <= f[i - 1][j] && m <= f[i + 1][j])
               || (m <= f[i][j - 1] && m <= f[i][j + 1])))
        continue;
      double at[2] = {lower + step * (i - 1), lower + step * (j - 1)}, g;
      abut_patch_descend(patch, x, n_short, at, &g, iterations);
      if (g < *best - noise)
      {
        *best = g;
        local[0] = at[0];
        local[1] = at[1];
      }
    }
}

static void
finish(const abut_patch *patch, const double *x, const double *local,
       abut_projection *p)
{
  abut_patch_point q;
  abut_patch_evaluate(patch, local[0], local[1], &q);
  const double residual = abut_patch_descent(patch, x, local, &q);
  p->converged = residual <= max2(1e-9 * patch->size, 1e-14 * norm3(x));
  finish3(patch->origin, q.y, q.y1, q.y2, x, local[0], local[1],
          patch->triangle, p);
  /* A stationary point inside stays one in spite of round-off. */
  const double outside = violation3(local[0], local[1], patch->triangle);
  if (p->converged && outside < -ABUT_EDGE_TOLERANCE)
  {
    p->inside = 1;
    p->violation = 0.;
  }
}

void
abut_patch_project(const abut_patch *patch, const double *absolute,
                   abut_projection *p)
{
  double x[3], edge[2], f;
  abut_patch_point q;
  sub3(absolute, patch->origin, x);
  p->iterations = 0;
  double inner[2] = {patch->triangle ? 1. / 3. : 0.,
                     patch->triangle ? 1. / 3. : 0.};
  const int found =
      abut_patch_descend(patch, x, max_steps, inner, &f, &p->iterations);
  abut_patch_evaluate(patch, inner[0], inner[1], &q);
  if (found && surely_global(patch, x, q.y))
  {
    finish(patch, x, inner, p);
    return;
  }
  double best = abut_patch_nearest_on_edges(patch, x, edge, &p->iterations);
  const double tolerance = 1e-12 * (patch->size + norm3(x));
  abut_patch_evaluate(patch, edge[0], edge[1], &q);
  if (abut_patch_descent(patch, x, edge, &q) <= tolerance
      && surely_global(patch, x, q.y))
  {
    finish(patch, x, edge, p);
    return;
  }
  if (f < best - objective_noise(patch, x))
  {
    best = f;
    edge[0] = inner[0];
    edge[1] = inner[1];
  }
  search_samples(patch, x, edge, &best, &p->iterations);
  for (int k = 0; k < n_restarts; ++k)
  {
    abut_patch_evaluate(patch, edge[0], edge[1], &q);
    if (abut_patch_descent(patch, x, edge, &q) <= tolerance)
      break;
    abut_patch_descend(patch, x, max_steps, edge, &best, &p->iterations);
  }
  finish(patch, x, edge, p);
}

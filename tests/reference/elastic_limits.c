/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Limits of linear elastic problems whose contact is known beforehand, by a
 * program that shares nothing with Abut: quadratic elements on grids of boxes,
 * 3-point Gauss rules, conjugate gradients.
 *
 *     elastic_limits NAME [EXPECTED RELATIVE]
 *
 * prints the value on finer and finer grids and, with an expected value, ends
 * with 1 unless the last two values are that near to it. Names:
 *
 * cube   Unit cube, E = 1, nu = 0.3, one face clamped, the opposite one pushed
 *        in by 0.01 and free to slide: its force. prm/two-blocks-3d.prm is two
 *        of them, one the mirror image of the other: they touch everywhere, in
 *        a plane and without shear.
 * beam   prm/cantilever.prm, in one piece: deflection of the end's middle.
 * roller The block of prm/nafems-roller.prm alone under the pressure that Hertz
 *        gives for the two bodies: displacement under its middle. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum
{
  MAX_NODES = 27,
  MAX_LOCAL = 3 * MAX_NODES,
  MAX_CELLS = 200
};

static const double pi = 3.14159265358979323846;

/* Boxes between the places of each axis. Node i of an axis with n cells, i = 0
 * .. 2 n, is at a place or halfway between two. */
typedef struct grid
{
  int dim, n[3];
  double place[3][MAX_CELLS + 1];
  double lambda, mu;
  int n_nodes, n_unknowns;
  double *force, *value; /* [n_unknowns]; values of held ones are given */
  bool *held;
} grid;

static int
nodes_along(const grid *g, int axis)
{
  return axis < g->dim ? 2 * g->n[axis] + 1 : 1;
}

static int
node_at(const grid *g, const int *i)
{
  return i[0] + nodes_along(g, 0) * (i[1] + nodes_along(g, 1) * i[2]);
}

static void
finish(grid *g, double young, double poisson, bool plane_stress)
{
  g->mu = young / (2 * (1 + poisson));
  g->lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  if (plane_stress)
    g->lambda = young * poisson / (1 - poisson * poisson);
  g->n_nodes = nodes_along(g, 0) * nodes_along(g, 1) * nodes_along(g, 2);
  g->n_unknowns = g->dim * g->n_nodes;
  g->force = calloc((size_t)g->n_unknowns, sizeof(double));
  g->value = calloc((size_t)g->n_unknowns, sizeof(double));
  g->held = calloc((size_t)g->n_unknowns, sizeof(bool));
}

static void
release(grid *g)
{
  free(g->force);
  free(g->value);
  free(g->held);
}

static void
uniform(grid *g, int axis, double from, double to, int n)
{
  g->n[axis] = n;
  for (int i = 0; i <= n; ++i)
    g->place[axis][i] = from + (to - from) * i / n;
}

/* Hold a component at all nodes with index `at` along an axis. */
static void
hold(grid *g, int axis, int at, int component, double value)
{
  int i[3];
  for (i[2] = 0; i[2] < nodes_along(g, 2); ++i[2])
    for (i[1] = 0; i[1] < nodes_along(g, 1); ++i[1])
      for (i[0] = 0; i[0] < nodes_along(g, 0); ++i[0])
        if (i[axis] == at)
        {
          const int k = g->dim * node_at(g, i) + component;
          g->held[k] = true;
          g->value[k] = value;
        }
}

/* Quadratic shape functions on (0, 1) and their derivatives. */
static void
shape(double s, double *n, double *d)
{
  n[0] = (1 - s) * (1 - 2 * s);
  n[1] = 4 * s * (1 - s);
  n[2] = s * (2 * s - 1);
  d[0] = 4 * s - 3;
  d[1] = 4 - 8 * s;
  d[2] = 4 * s - 1;
}

static const double gauss_place[3] = {0.11270166537925831, 0.5,
                                      0.88729833462074169};
static const double gauss_weight[3] = {5. / 18, 8. / 18, 5. / 18};

/* Derivatives of all shape functions of a box at a Gauss point. */
static void
gradients(int dim, const double *size, const int *q, double (*out)[3])
{
  double n[3][3], d[3][3];
  for (int a = 0; a < dim; ++a)
    shape(gauss_place[q[a]], n[a], d[a]);
  const int count = dim == 2 ? 9 : 27;
  for (int k = 0; k < count; ++k)
  {
    const int i[3] = {k % 3, k / 3 % 3, k / 9};
    for (int a = 0; a < dim; ++a)
    {
      out[k][a] = 1;
      for (int b = 0; b < dim; ++b)
        out[k][a] *= a == b ? d[b][i[b]] / size[b] : n[b][i[b]];
    }
  }
}

static void
element_matrix(const grid *g, const double *size, double *k)
{
  const int dim = g->dim, count = dim == 2 ? 9 : 27, m = dim * count;
  memset(k, 0, sizeof(double) * (size_t)(m * m));
  for (int point = 0; point < count; ++point)
  {
    const int q[3] = {point % 3, point / 3 % 3, point / 9};
    double b[MAX_NODES][3] = {{0}}, w = 1;
    gradients(dim, size, q, b);
    for (int a = 0; a < dim; ++a)
      w *= gauss_weight[q[a]] * size[a];
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
      {
        double dot = 0;
        for (int a = 0; a < dim; ++a)
          dot += b[i][a] * b[j][a];
        for (int a = 0; a < dim; ++a)
          for (int c = 0; c < dim; ++c)
            k[(dim * i + a) * m + dim * j + c] +=
                w
                * (g->lambda * b[i][a] * b[j][c] + g->mu * b[i][c] * b[j][a]
                   + (a == c ? g->mu * dot : 0));
      }
  }
}

/* What is done with the matrix of a box and the numbers of its unknowns. */
typedef void (*visitor)(const double *k, const int *number, int m,
                        const double *x, double *y);

static void
walk(const grid *g, visitor visit, const double *x, double *y)
{
  static double k[MAX_LOCAL * MAX_LOCAL];
  double last[3] = {0, 0, 0};
  const int dim = g->dim, count = dim == 2 ? 9 : 27;
  int c[3], number[MAX_LOCAL];
  for (c[2] = 0; c[2] < (dim == 3 ? g->n[2] : 1); ++c[2])
    for (c[1] = 0; c[1] < g->n[1]; ++c[1])
      for (c[0] = 0; c[0] < g->n[0]; ++c[0])
      {
        double size[3] = {0, 0, 0};
        bool same = true;
        for (int a = 0; a < dim; ++a)
        {
          size[a] = g->place[a][c[a] + 1] - g->place[a][c[a]];
          same = same && fabs(size[a] - last[a]) < 1e-12 * size[a];
        }
        if (!same)
          element_matrix(g, size, k);
        memcpy(last, size, sizeof(last));
        for (int i = 0; i < count; ++i)
        {
          const int node[3] = {2 * c[0] + i % 3, 2 * c[1] + i / 3 % 3,
                               dim == 3 ? 2 * c[2] + i / 9 : 0};
          for (int a = 0; a < dim; ++a)
            number[dim * i + a] = dim * node_at(g, node) + a;
        }
        visit(k, number, dim * count, x, y);
      }
}

static void
multiply(const double *k, const int *number, int m, const double *x, double *y)
{
  for (int i = 0; i < m; ++i)
  {
    double sum = 0;
    for (int j = 0; j < m; ++j)
      sum += k[i * m + j] * x[number[j]];
    y[number[i]] += sum;
  }
}

static void
add_diagonal(const double *k, const int *number, int m, const double *x,
             double *y)
{
  (void)x;
  for (int i = 0; i < m; ++i)
    y[number[i]] += k[i * m + i];
}

/* y = K x; rows of held unknowns are 0 if `free_only`. */
static void
apply(const grid *g, const double *x, double *y, bool free_only)
{
  memset(y, 0, sizeof(double) * (size_t)g->n_unknowns);
  walk(g, multiply, x, y);
  for (int i = 0; i < g->n_unknowns && free_only; ++i)
    if (g->held[i])
      y[i] = 0;
}

static double
dot(const grid *g, const double *a, const double *b)
{
  double sum = 0;
  for (int i = 0; i < g->n_unknowns; ++i)
    sum += a[i] * b[i];
  return sum;
}

/* Conjugate gradients scaled by the diagonal, from the held values. */
static void
solve(grid *g)
{
  const size_t bytes = sizeof(double) * (size_t)g->n_unknowns;
  double *r = malloc(bytes), *z = malloc(bytes), *p = malloc(bytes),
         *q = malloc(bytes), *scale = calloc(1, bytes);
  walk(g, add_diagonal, NULL, scale);
  apply(g, g->value, q, true);
  for (int i = 0; i < g->n_unknowns; ++i)
    r[i] = g->held[i] ? 0 : g->force[i] - q[i];
  double rz = 0, first = 0;
  for (int step = 0; step < 20000; ++step)
  {
    for (int i = 0; i < g->n_unknowns; ++i)
      z[i] = r[i] / scale[i];
    const double next = dot(g, r, z);
    for (int i = 0; i < g->n_unknowns; ++i)
      p[i] = z[i] + (step > 0 ? next / rz * p[i] : 0);
    rz = next;
    if (step == 0)
      first = rz;
    if (rz <= 1e-22 * first)
      break;
    apply(g, p, q, true);
    const double alpha = rz / dot(g, p, q);
    for (int i = 0; i < g->n_unknowns; ++i)
    {
      g->value[i] += alpha * p[i];
      r[i] -= alpha * q[i];
    }
  }
  free(r);
  free(z);
  free(p);
  free(q);
  free(scale);
}

/* A quarter of the cube, n x n x 2 n boxes. */
static double
cube(int n)
{
  grid g = {.dim = 3};
  uniform(&g, 0, 0, 0.5, n);
  uniform(&g, 1, 0, 0.5, n);
  uniform(&g, 2, 0, 1, 2 * n);
  finish(&g, 1, 0.3, false);
  for (int a = 0; a < 3; ++a)
    hold(&g, 2, 0, a, 0);
  hold(&g, 2, 4 * n, 2, -0.01);
  hold(&g, 0, 0, 0, 0);
  hold(&g, 1, 0, 1, 0);
  solve(&g);
  double *reaction = malloc(sizeof(double) * (size_t)g.n_unknowns);
  apply(&g, g.value, reaction, false);
  /* Work of the face that is pushed in. */
  const double force = dot(&g, reaction, g.value) / 0.01;
  free(reaction);
  release(&g);
  return 4 * force;
}

/* Load (x or y, as `component`) on the side at node `at` of `axis`, integrated
 * with the rule of three points on each of `parts` parts of a side. */
static void
load(grid *g, int axis, int at, int component, double (*density)(double),
     int parts)
{
  const int along = 1 - axis;
  for (int c = 0; c < g->n[along]; ++c)
  {
    const double from = g->place[along][c],
                 size = g->place[along][c + 1] - from;
    for (int part = 0; part < parts; ++part)
      for (int q = 0; q < 3; ++q)
      {
        const double s = (part + gauss_place[q]) / parts;
        double n[3], d[3];
        shape(s, n, d);
        for (int k = 0; k < 3; ++k)
        {
          int node[3] = {0, 0, 0};
          node[axis] = at;
          node[along] = 2 * c + k;
          g->force[2 * node_at(g, node) + component] +=
              gauss_weight[q] * size / parts * n[k] * density(from + s * size);
        }
      }
  }
}

static double
parabola(double y)
{
  return 1.5 * (1 - 4 * y * y);
}

static double
beam(int n)
{
  grid g = {.dim = 2};
  uniform(&g, 0, 0, 10, 10 * n);
  uniform(&g, 1, -0.5, 0.5, n);
  finish(&g, 1000, 0.3, true);
  hold(&g, 0, 0, 0, 0);
  hold(&g, 0, 0, 1, 0);
  load(&g, 0, 20 * n, 1, parabola, 1);
  solve(&g);
  const int end[3] = {20 * n, n, 0};
  const double answer = g.value[2 * node_at(&g, end) + 1];
  release(&g);
  return answer;
}

/* Hertz: half width and largest pressure of the two bodies, 35000 in all. */
static const double load_of_roller = 35000, radius = 50;

static double
half_width(void)
{
  const double compliance = (1 - 0.09) / 210e3 + (1 - 0.09) / 70e3;
  return sqrt(4 * load_of_roller * radius * compliance / pi);
}

static double
hertz(double x)
{
  const double a = half_width();
  return fabs(x) < a
             ? -2 * load_of_roller / (pi * a) * sqrt(1 - x * x / (a * a))
             : 0;
}

/* n boxes below the contact, then sizes that grow by a constant factor. */
static int
graded(double *place, double fine, int n, double length)
{
  int k = 0;
  double size = fine / n;
  for (; k <= n; ++k)
    place[k] = size * k;
  while (place[k - 1] < length)
  {
    size *= 1 + 1.2 / n;
    place[k] = place[k - 1] + size;
    ++k;
  }
  /* The last one ends where the body does. */
  place[k - 1] = length;
  if (length - place[k - 2] < 0.5 * size)
    place[--k - 1] = length;
  return k - 1;
}

static double
roller(int n)
{
  grid g = {.dim = 2};
  g.n[0] = graded(g.place[0], half_width(), n, 100);
  g.n[1] = graded(g.place[1], half_width(), n, 200); /* depth */
  finish(&g, 70e3, 0.3, false);
  hold(&g, 0, 0, 0, 0);
  hold(&g, 1, 2 * g.n[1], 0, 0);
  hold(&g, 1, 2 * g.n[1], 1, 0);
  load(&g, 1, 0, 1, hertz, 20);
  solve(&g);
  const double answer = g.value[1];
  release(&g);
  return answer;
}

int
main(int argc, char **argv)
{
  static const struct
  {
    const char *name;
    double (*run)(int);
    int n[3];
  } problems[] = {{"cube", cube, {3, 6, 10}},
                  {"beam", beam, {2, 4, 8}},
                  {"roller", roller, {2, 4, 8}}};
  for (size_t i = 0; i < sizeof(problems) / sizeof(problems[0]); ++i)
  {
    if (argc < 2 || strcmp(argv[1], problems[i].name) != 0)
      continue;
    bool good = true;
    for (int k = 0; k < 3; ++k)
    {
      const double value = problems[i].run(problems[i].n[k]);
      printf("%s %d: %.8g\n", argv[1], problems[i].n[k], value);
      if (argc == 4 && k > 0)
      {
        const double expected = atof(argv[2]);
        good = good && fabs(value - expected) <= atof(argv[3]) * fabs(expected);
      }
    }
    return good ? 0 : 1;
  }
  fprintf(stderr, "elastic_limits cube|beam|roller [EXPECTED RELATIVE]\n");
  return 2;
}

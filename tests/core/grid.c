/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "grid.h"

#include <stdlib.h>
#include <string.h>

static int32_t
power(int32_t base, int32_t exponent)
{
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

static void
coordinates(const grid *g, int32_t side, int32_t node, int32_t *c)
{
  for (int32_t d = 0; d < g->dim; ++d, node /= side)
    c[d] = node % side;
}

static bool
is_fixed(const grid *g, int32_t side, int32_t node)
{
  int32_t c[3] = {0, 0, 0};
  coordinates(g, side, node, c);
  bool border = c[0] == 0;
  for (int32_t d = 0; d < g->dim && g->block == 1; ++d)
    border |= c[d] == 0 || c[d] == side - 1;
  return border;
}

/* Weights of all nodes: 1, 1/2, 1/4 or 1/8 of the corners around. */
static void
make_weights(const grid *g, int32_t l, int64_t *start, int32_t *parent,
             double *weight)
{
  const int32_t side = g->side[l], coarse = g->side[l + 1];
  int64_t at = 0;
  for (int32_t i = 0; i < g->mesh[l].n_nodes; ++i)
  {
    int32_t c[3];
    coordinates(g, side, i, c);
    int32_t n = 1;
    for (int32_t d = 0; d < g->dim; ++d)
      n *= 1 + c[d] % 2;
    for (int32_t k = 0; k < n; ++k)
    {
      int32_t node = 0, step = 1, bits = k;
      for (int32_t d = 0; d < g->dim; ++d, step *= coarse)
      {
        node += step * (c[d] / 2 + (c[d] % 2) * (bits % 2));
        bits /= 1 + c[d] % 2;
      }
      parent[at] = node;
      weight[at++] = 1. / n;
    }
    start[i + 1] = at;
  }
}

static void
make_mesh(grid *g, int32_t l)
{
  abut_multigrid_mesh *mesh = &g->mesh[l];
  const int32_t n = power(g->side[l], g->dim);
  mesh->n_nodes = n;
  uint8_t *fixed = calloc((size_t)(n * g->block), 1);
  for (int32_t i = 0; i < n * g->block; ++i)
    fixed[i] = is_fixed(g, g->side[l], i / g->block);
  mesh->fixed = fixed;
  if (l + 1 == g->n_meshes)
    return;
  int64_t *start = calloc((size_t)n + 1, sizeof(int64_t));
  int32_t *parent = calloc((size_t)n * 8, sizeof(int32_t));
  double *weight = calloc((size_t)n * 8, sizeof(double));
  make_weights(g, l, start, parent, weight);
  mesh->start = start;
  mesh->parent = parent;
  mesh->weight = weight;
}

/* Function number k of a cell along an axis, and its derivative. */
static double
along(const grid *g, int32_t k, double x)
{
  const double linear[2] = {1 - x, x};
  const double quadratic[3] = {(1 - x) * (1 - 2 * x), 4 * x * (1 - x),
                               x * (2 * x - 1)};
  return g->degree == 1 ? linear[k] : quadratic[k];
}

static double
slope(const grid *g, int32_t k, double x)
{
  const double linear[2] = {-1, 1};
  const double quadratic[3] = {4 * x - 3, 4 - 8 * x, 4 * x - 1};
  return g->degree == 1 ? linear[k] : quadratic[k];
}

/* The gradient of node k's function at a point of the unit cell. */
static void
gradient(const grid *g, int32_t k, const double *at, double *result)
{
  int32_t c[3];
  coordinates(g, g->degree + 1, k, c);
  for (int32_t a = 0; a < g->dim; ++a)
  {
    result[a] = 1;
    for (int32_t d = 0; d < g->dim; ++d)
      result[a] *= d == a ? slope(g, c[d], at[d]) : along(g, c[d], at[d]);
  }
}

/* What nodes i and j have for each other at a point, component by component.
 */
static void
add_point(const grid *g, const double *gi, const double *gj, double weight,
          double *block)
{
  const double mu = 1 / 2.6, lambda = 0.3 / (1.3 * 0.4);
  double product = 0;
  for (int32_t d = 0; d < g->dim; ++d)
    product += gi[d] * gj[d];
  for (int32_t r = 0; r < g->block; ++r)
    for (int32_t c = 0; c < g->block; ++c)
      block[r * g->block + c] +=
          weight
          * (g->block == 1 ? product
                           : lambda * gi[r] * gj[c] + mu * gj[r] * gi[c]
                                 + (r == c ? mu * product : 0));
}

/* Blocks of the element, [node * nodes + node]; h^(dim - 2) left out, so
 * that the Laplacian of the plane is made of sixths. */
static void
make_element(const grid *g, double (*element)[9])
{
  const int32_t n = g->degree + 1, nodes = power(n, g->dim);
  const double far_out = g->degree == 1 ? sqrt(1. / 12) : sqrt(0.15);
  const double gauss[2][3] = {{0.5 - far_out, 0.5 + far_out, 0},
                              {0.5 - far_out, 0.5, 0.5 + far_out}};
  const double weights[2][3] = {{0.5, 0.5, 0}, {5. / 18, 8. / 18, 5. / 18}};
  for (int32_t q = 0; q < nodes; ++q)
    for (int32_t i = 0; i < nodes; ++i)
      for (int32_t j = 0; j < nodes; ++j)
      {
        int32_t c[3];
        double at[3], gi[3], gj[3], weight = 1;
        coordinates(g, n, q, c);
        for (int32_t d = 0; d < g->dim; ++d)
        {
          at[d] = gauss[g->degree - 1][c[d]];
          weight *= weights[g->degree - 1][c[d]];
        }
        gradient(g, i, at, gi);
        gradient(g, j, at, gj);
        add_point(g, gi, gj, weight, element[i * nodes + j]);
      }
}

/* Nodes that share a cell with one are at most so far along an axis. */
static int32_t
n_offsets(const grid *g)
{
  return 2 * g->degree + 1;
}

/* Where a row's entry for a neighbour stands: offsets by digits. */
static int32_t
offset_of(const grid *g, const int32_t *from, const int32_t *to)
{
  int32_t result = 0, step = 1;
  for (int32_t d = 0; d < g->dim; ++d, step *= n_offsets(g))
    result += step * (to[d] - from[d] + g->degree);
  return result;
}

/* Sum the elements into rows of all neighbours. */
static void
sum_elements(const grid *g, double *sum)
{
  const int32_t side = g->side[0], cells = (side - 1) / g->degree;
  const int32_t n = g->degree + 1, nodes = power(n, g->dim), b = g->block;
  double(*element)[9] = calloc((size_t)(nodes * nodes), sizeof(*element));
  make_element(g, element);
  for (int32_t cell = 0; cell < power(cells, g->dim); ++cell)
    for (int32_t k = 0; k < nodes * nodes; ++k)
    {
      int32_t c[3] = {0, 0, 0}, to[3], from[3], node = 0, step = 1;
      coordinates(g, cells, cell, c);
      coordinates(g, n, k / nodes, from);
      coordinates(g, n, k % nodes, to);
      for (int32_t d = 0; d < g->dim; ++d, step *= side)
      {
        from[d] += g->degree * c[d];
        to[d] += g->degree * c[d];
        node += step * from[d];
      }
      double *row = sum
                    + ((int64_t)node * power(n_offsets(g), g->dim)
                       + offset_of(g, from, to))
                          * b * b;
      for (int32_t e = 0; e < b * b; ++e)
        row[e] += element[k][e];
    }
  free(element);
}

/* Rows of one node, without entries outside or constrained. */
static int32_t
write_row(grid *g, const double *sum, int32_t node, int32_t component,
          int32_t at)
{
  const int32_t side = g->side[0], b = g->block, most = n_offsets(g);
  const bool fixed = is_fixed(g, side, node);
  int32_t c[3];
  coordinates(g, side, node, c);
  for (int32_t k = 0; k < power(most, g->dim); ++k)
  {
    int32_t other = 0, step = 1, digits = k;
    bool inside = true;
    for (int32_t d = 0; d < g->dim; ++d, step *= side, digits /= most)
    {
      const int32_t x = c[d] + digits % most - g->degree;
      inside &= x >= 0 && x < side;
      other += step * x;
    }
    if (!inside || (other != node && (fixed || is_fixed(g, side, other))))
      continue;
    for (int32_t e = 0; e < b; ++e)
    {
      if (fixed && e != component)
        continue;
      g->column[at] = other * b + e;
      g->value[at++] =
          sum[(((int64_t)node * power(most, g->dim) + k) * b + component) * b
              + e];
    }
  }
  return at;
}

static void
make_matrix(grid *g)
{
  const int32_t per_row = power(n_offsets(g), g->dim) * g->block;
  g->n = g->mesh[0].n_nodes * g->block;
  g->start = calloc((size_t)g->n + 1, sizeof(int32_t));
  g->column = calloc((size_t)g->n * (size_t)per_row, sizeof(int32_t));
  g->value = calloc((size_t)g->n * (size_t)per_row, sizeof(double));
  double *sum = calloc((size_t)g->n * (size_t)per_row, sizeof(double));
  sum_elements(g, sum);
  for (int32_t i = 0; i < g->n; ++i)
    g->start[i + 1] =
        write_row(g, sum, i / g->block, i % g->block, g->start[i]);
  free(sum);
  g->matrix = (abut_multigrid_matrix){sizeof(g->matrix), g->n, g->start,
                                      g->column, g->value};
}

static void
open_grid(grid *g, int32_t degree, int32_t dim, int32_t block, int32_t finest,
          int32_t coarsest)
{
  memset(g, 0, sizeof(*g));
  g->degree = degree;
  g->dim = dim;
  g->block = block;
  g->n_meshes = finest - coarsest + 1;
  for (int32_t l = 0; l < g->n_meshes; ++l)
    g->side[l] = (1 << (finest - l)) + 1;
  for (int32_t l = g->n_meshes - 1; l >= 0; --l)
    make_mesh(g, l);
  make_matrix(g);
  g->hierarchy = (abut_multigrid_hierarchy){
      sizeof(g->hierarchy), block, g->n_meshes, g->mesh, NULL, NULL};
}

void
grid_open(grid *g, int32_t dim, int32_t block, int32_t finest, int32_t coarsest)
{
  open_grid(g, 1, dim, block, finest, coarsest);
}

/* The nodes are those of linear elements of half the size, and what they follow
 * from the corners of their cells by is the same. */
void
grid_open_quadratic(grid *g, int32_t dim, int32_t block, int32_t finest,
                    int32_t coarsest)
{
  open_grid(g, 2, dim, block, finest + 1, coarsest);
}

void
grid_close(grid *g)
{
  for (int32_t l = 0; l < g->n_meshes; ++l)
  {
    free((void *)(uintptr_t)g->mesh[l].fixed);
    free((void *)(uintptr_t)g->mesh[l].start);
    free((void *)(uintptr_t)g->mesh[l].parent);
    free((void *)(uintptr_t)g->mesh[l].weight);
  }
  free(g->start);
  free(g->column);
  free(g->value);
}

bool
grid_is_out(const grid *g, const uint8_t *held, int32_t unknown)
{
  return g->mesh[0].fixed[unknown] || (held != NULL && held[unknown]);
}

void
grid_times(const grid *g, const uint8_t *held, const double *x, double *y)
{
  for (int32_t i = 0; i < g->n; ++i)
  {
    y[i] = 0;
    for (int32_t e = g->start[i]; e < g->start[i + 1]; ++e)
      if (!grid_is_out(g, held, i) && !grid_is_out(g, held, g->column[e]))
        y[i] += g->value[e] * x[g->column[e]];
  }
}

static double
product(const grid *g, const double *a, const double *b)
{
  double sum = 0;
  for (int32_t i = 0; i < g->n; ++i)
    sum += a[i] * b[i];
  return sum;
}

int32_t
grid_iterations(const grid *g, abut_multigrid *mg, const uint8_t *held,
                double tolerance)
{
  const size_t n = (size_t)g->n;
  double *r = calloc(4 * n, sizeof(double));
  double *z = r + n, *d = z + n, *image = d + n;
  uint64_t seed = 7;
  for (size_t i = 0; i < n; ++i)
    r[i] = grid_is_out(g, held, (int32_t)i) ? 0 : fixture_random(&seed) - 0.4;
  const double first = product(g, r, r);
  double before = 0;
  int32_t k = 0;
  for (; product(g, r, r) > tolerance * tolerance * first && k < 200; ++k)
  {
    assert_ok(abut_multigrid_cycle(mg, r, z));
    const double now = product(g, r, z);
    for (size_t i = 0; i < n; ++i)
      d[i] = z[i] + (k > 0 ? now / before : 0) * d[i];
    grid_times(g, held, d, image);
    const double step = now / product(g, d, image);
    for (size_t i = 0; i < n; ++i)
      r[i] -= step * image[i];
    before = now;
  }
  free(r);
  return k;
}

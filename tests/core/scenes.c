/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include "scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

uint64_t
scene_bits(uint64_t *seed)
{
  uint64_t z = (*seed += UINT64_C(0x9e3779b97f4a7c15));
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

double
scene_uniform(uint64_t *seed)
{
  return (double)(scene_bits(seed) >> 11) * 0x1p-53;
}

void
scene_plane(const double *p, double u, double v, double *x)
{
  x[0] = p[0] + p[2] * u;
  x[1] = p[1] + p[3] * v;
  x[2] = p[4];
}

void
scene_sphere(const double *p, double u, double v, double *x)
{
  /* Axes of the six sides such that a x b = c. */
  static const int8_t axes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                    {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  const int side = (int)p[1];
  const double a = tan(p[2] * PI / 4 * (2 * u - 1));
  const double b = tan(p[2] * PI / 4 * (2 * v - 1));
  const double r = p[0] / sqrt(1 + a * a + b * b);
  x[axes[side][0]] = r * a;
  x[axes[side][1]] = r * b;
  x[axes[side][2]] = side < 3 ? r : -r;
}

void
scene_ring(const double *p, double u, double v, double *x)
{
  const double r = p[0] * pow(p[1] / p[0], u);
  x[0] = r * cos(p[3] * v);
  x[1] = r * sin(p[3] * v);
  x[2] = p[2];
}

/* Straight stretches joined by half circles. */
void
scene_fold(const double *p, double u, double v, double *x)
{
  const double length = p[0], gap = p[1], arc = PI * gap / 2;
  const double s = u * (p[2] * length + (p[2] - 1) * arc);
  double fold = floor(s / (length + arc));
  if (fold > p[2] - 1)
    fold = p[2] - 1;
  const double rest = s - fold * (length + arc);
  const bool back = fmod(fold, 2) > 0.5;
  double along = rest, up = fold * gap;
  if (rest > length)
  {
    const double angle = (rest - length) / (gap / 2);
    along = length + gap / 2 * sin(angle);
    up += gap / 2 * (1 - cos(angle));
  }
  x[0] = back ? length - along : along;
  x[1] = p[3] * v;
  x[2] = up;
}

void
scene_arc(const double *p, double u, double v, double *x)
{
  const double t = p[3] + (p[4] - p[3]) * u;
  (void)v;
  x[0] = p[0] + p[2] * cos(t);
  x[1] = p[1] + p[2] * sin(t);
}

void
scene_line(const double *p, double u, double v, double *x)
{
  (void)v;
  x[0] = p[0] + (p[2] - p[0]) * u;
  x[1] = p[1] + (p[3] - p[1]) * u;
}

static scene_mesh
allocate(abut_facet_kind kind, int32_t n_nodes, int32_t n_facets)
{
  scene_mesh m = {
      abut_facet_dimension(kind), n_nodes, n_facets, kind, NULL, NULL};
  m.position = malloc(sizeof(double) * 3 * (size_t)(n_nodes + 1));
  m.connectivity = malloc(sizeof(int32_t) * (size_t)(n_facets + 1)
                          * (size_t)abut_facet_n_nodes(kind));
  return m;
}

static bool
is_quadratic(abut_facet_kind kind)
{
  return abut_facet_n_nodes(kind) > abut_facet_n_corners(kind);
}

static scene_mesh
curve(abut_facet_kind kind, int32_t n, scene_map map, const double *p,
      bool flip)
{
  const int32_t order = is_quadratic(kind) ? 2 : 1;
  scene_mesh m = allocate(kind, order * n + 1, n);
  for (int32_t i = 0; i <= order * n; ++i)
  {
    const double u = (double)i / (order * n);
    map(p, flip ? 1 - u : u, 0, m.position + 2 * (size_t)i);
  }
  for (int32_t f = 0; f < n; ++f)
  {
    int32_t *c = m.connectivity + (size_t)(order + 1) * (size_t)f;
    c[0] = order * f;
    c[1] = order * (f + 1);
    if (order == 2)
      c[2] = 2 * f + 1;
  }
  return m;
}

/* Nodes of the facets in cell (i, j), as offsets in the lattice of nodes. */
static int32_t
cell_facets(abut_facet_kind kind, int32_t offset[18][2])
{
  static const int8_t quad4[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  static const int8_t tri3[6][2] = {{0, 0}, {1, 0}, {0, 1},
                                    {1, 1}, {0, 1}, {1, 0}};
  static const int8_t quad9[9][2] = {{0, 0}, {2, 0}, {0, 2}, {2, 2}, {0, 1},
                                     {2, 1}, {1, 0}, {1, 2}, {1, 1}};
  static const int8_t tri6[12][2] = {{0, 0}, {2, 0}, {0, 2}, {1, 0},
                                     {1, 1}, {0, 1}, {2, 2}, {0, 2},
                                     {2, 0}, {1, 2}, {1, 1}, {2, 1}};
  const int8_t(*from)[2] = kind == ABUT_FACET_QUAD4   ? quad4
                           : kind == ABUT_FACET_TRI3  ? tri3
                           : kind == ABUT_FACET_QUAD9 ? quad9
                                                      : tri6;
  const int32_t n = kind == ABUT_FACET_QUAD4   ? 4
                    : kind == ABUT_FACET_TRI3  ? 6
                    : kind == ABUT_FACET_QUAD9 ? 9
                                               : 12;
  for (int32_t k = 0; k < n; ++k)
    for (int d = 0; d < 2; ++d)
      offset[k][d] = from[k][d];
  return n;
}

scene_mesh
scene_patch(abut_facet_kind kind, int32_t nu, int32_t nv, scene_map map,
            const double *p, bool flip)
{
  if (abut_facet_dimension(kind) == 2)
    return curve(kind, nu, map, p, flip);
  const int32_t order = is_quadratic(kind) ? 2 : 1;
  const int32_t mu = order * nu + 1, mv = order * nv + 1;
  int32_t offset[18][2];
  const int32_t per_cell = cell_facets(kind, offset);
  const int32_t n_facets = nu * nv * per_cell / abut_facet_n_nodes(kind);
  scene_mesh m = allocate(kind, mu * mv, n_facets);
  for (int32_t j = 0; j < mv; ++j)
    for (int32_t i = 0; i < mu; ++i)
    {
      const double u = (double)i / (mu - 1), v = (double)j / (mv - 1);
      map(p, flip ? 1 - u : u, v,
          m.position + 3 * ((size_t)j * (size_t)mu + (size_t)i));
    }
  int32_t *c = m.connectivity;
  for (int32_t j = 0; j < nv; ++j)
    for (int32_t i = 0; i < nu; ++i)
      for (int32_t k = 0; k < per_cell; ++k)
        *c++ = (order * j + offset[k][1]) * mu + order * i + offset[k][0];
  return m;
}

static void
random_rotation(uint64_t *seed, double r[3][3])
{
  /* From a random unit quaternion. */
  double q[4], length = 0;
  for (int i = 0; i < 4; ++i)
  {
    q[i] = sqrt(-2 * log(1 - scene_uniform(seed)))
           * cos(2 * PI * scene_uniform(seed));
    length += q[i] * q[i];
  }
  length = sqrt(length);
  for (int i = 0; i < 4; ++i)
    q[i] /= length;
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double m[3][3] = {
      {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
      {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
      {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  memcpy(r, m, sizeof(m));
}

scene_mesh
scene_random(abut_facet_kind kind, int32_t n, double box, double smallest,
             double largest, uint64_t *seed)
{
  static const double zero[5] = {0, 0, 1, 1, 0};
  static const double unit[4] = {0, 0, 1, 0};
  const int32_t per = abut_facet_n_nodes(kind);
  const int32_t dim = abut_facet_dimension(kind);
  const double bend = is_quadratic(kind) ? 0.04 : 0.2;
  scene_mesh one = dim == 3 ? scene_patch(kind, 1, 1, scene_plane, zero, false)
                            : scene_patch(kind, 1, 1, scene_line, unit, false);
  scene_mesh m = allocate(kind, per * n, n);
  for (int32_t f = 0; f < n; ++f)
  {
    double r[3][3], shift[3];
    const double size = smallest * pow(largest / smallest, scene_uniform(seed));
    random_rotation(seed, r);
    if (dim == 2)
    {
      const double t = 2 * PI * scene_uniform(seed);
      r[0][0] = r[1][1] = cos(t);
      r[1][0] = sin(t);
      r[0][1] = -sin(t);
    }
    for (int d = 0; d < 3; ++d)
      shift[d] = box * scene_uniform(seed);
    for (int32_t a = 0; a < per; ++a)
    {
      /* The first facet of the patch, bent a little. */
      const double *y =
          one.position + (size_t)dim * (size_t)one.connectivity[a];
      double z[3] = {0, 0, 0};
      for (int d = 0; d < dim; ++d)
        z[d] = y[d] + bend * (scene_uniform(seed) - 0.5);
      double *x = m.position + (size_t)dim * (size_t)(per * f + a);
      for (int d = 0; d < dim; ++d)
      {
        x[d] = shift[d];
        for (int e = 0; e < dim; ++e)
          x[d] += size * r[d][e] * z[e];
      }
      m.connectivity[per * f + a] = per * f + a;
    }
  }
  scene_free(&one);
  return m;
}

scene_mesh
scene_square(abut_facet_kind kind, int32_t n, double height, bool flip)
{
  const double p[5] = {0, 0, 1, 1, height};
  return scene_patch(kind, n, n, scene_plane, p, flip);
}

scene_mesh
scene_needles(int32_t n, double length, double width)
{
  const double p[5] = {0, 0, length, n * width, 0};
  return scene_patch(ABUT_FACET_QUAD4, 1, n, scene_plane, p, false);
}

scene_mesh
scene_box(const double *lower, const double *upper, int32_t m)
{
  static const int8_t axes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                    {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  double longest = 0;
  for (int d = 0; d < 3; ++d)
    longest = fmax(longest, upper[d] - lower[d]);
  scene_mesh all = allocate(ABUT_FACET_QUAD4, 0, 0);
  for (int side = 0; side < 6; ++side)
  {
    const int8_t *a = axes[side];
    const double p[5] = {lower[a[0]], lower[a[1]], upper[a[0]] - lower[a[0]],
                         upper[a[1]] - lower[a[1]],
                         side < 3 ? upper[a[2]] : lower[a[2]]};
    const int32_t nu = (int32_t)fmax(1, round(m * p[2] / longest));
    const int32_t nv = (int32_t)fmax(1, round(m * p[3] / longest));
    scene_mesh q = scene_patch(ABUT_FACET_QUAD4, nu, nv, scene_plane, p, false);
    for (int32_t i = 0; i < q.n_nodes; ++i)
    {
      double *x = q.position + 3 * (size_t)i, y[3];
      for (int d = 0; d < 3; ++d)
        y[a[d]] = x[d];
      memcpy(x, y, sizeof(y));
    }
    all = scene_join(all, q);
  }
  return all;
}

scene_mesh
scene_join(scene_mesh a, scene_mesh b)
{
  const size_t per = (size_t)abut_facet_n_nodes(a.kind);
  const size_t dim = (size_t)a.dimension;
  scene_mesh m =
      allocate(a.kind, a.n_nodes + b.n_nodes, a.n_facets + b.n_facets);
  memcpy(m.position, a.position, sizeof(double) * dim * (size_t)a.n_nodes);
  memcpy(m.position + dim * (size_t)a.n_nodes, b.position,
         sizeof(double) * dim * (size_t)b.n_nodes);
  memcpy(m.connectivity, a.connectivity,
         sizeof(int32_t) * per * (size_t)a.n_facets);
  for (size_t e = 0; e < per * (size_t)b.n_facets; ++e)
    m.connectivity[per * (size_t)a.n_facets + e] =
        a.n_nodes + b.connectivity[e];
  scene_free(&a);
  scene_free(&b);
  return m;
}

void
scene_move(scene_mesh *mesh, double scale, const double *angles,
           const double *shift)
{
  const int dim = mesh->dimension;
  for (int32_t i = 0; i < mesh->n_nodes; ++i)
  {
    double *x = mesh->position + (size_t)dim * (size_t)i;
    double y[3] = {x[0], x[1], dim == 3 ? x[2] : 0};
    for (int turn = 0; turn < (dim == 3 ? 3 : 1); ++turn)
    {
      /* About z, y, x. */
      const int a = turn == 2 ? 1 : 0, b = turn == 0 ? 1 : 2;
      const double c = cos(angles[turn]), s = sin(angles[turn]);
      const double ya = y[a], yb = y[b];
      y[a] = c * ya - s * yb;
      y[b] = s * ya + c * yb;
    }
    for (int d = 0; d < dim; ++d)
      x[d] = scale * y[d] + shift[d];
  }
}

static void
permutation(int32_t *p, int32_t n, uint64_t *seed)
{
  for (int32_t i = 0; i < n; ++i)
    p[i] = i;
  for (int32_t i = n - 1; i > 0; --i)
  {
    const int32_t j = (int32_t)(scene_bits(seed) % (uint64_t)(i + 1));
    const int32_t swap = p[i];
    p[i] = p[j];
    p[j] = swap;
  }
}

void
scene_shuffle(scene_mesh *mesh, uint64_t *seed, int64_t *node_id,
              int64_t *facet_id)
{
  const size_t dim = (size_t)mesh->dimension;
  const size_t per = (size_t)abut_facet_n_nodes(mesh->kind);
  scene_mesh m = allocate(mesh->kind, mesh->n_nodes, mesh->n_facets);
  int32_t *node = malloc(sizeof(int32_t) * (size_t)(mesh->n_nodes + 1));
  int32_t *facet = malloc(sizeof(int32_t) * (size_t)(mesh->n_facets + 1));
  permutation(node, mesh->n_nodes, seed);
  permutation(facet, mesh->n_facets, seed);
  for (int32_t i = 0; i < mesh->n_nodes; ++i)
  {
    memcpy(m.position + dim * (size_t)node[i], mesh->position + dim * (size_t)i,
           sizeof(double) * dim);
    if (node_id != NULL)
      node_id[node[i]] = i;
  }
  for (int32_t f = 0; f < mesh->n_facets; ++f)
  {
    for (size_t a = 0; a < per; ++a)
      m.connectivity[per * (size_t)facet[f] + a] =
          node[mesh->connectivity[per * (size_t)f + a]];
    if (facet_id != NULL)
      facet_id[facet[f]] = f;
  }
  free(node);
  free(facet);
  scene_free(mesh);
  *mesh = m;
}

void
scene_free(scene_mesh *mesh)
{
  free(mesh->position);
  free(mesh->connectivity);
  mesh->position = NULL;
  mesh->connectivity = NULL;
}

abut_surface_data
scene_data(const scene_mesh *mesh)
{
  abut_surface_data data = abut_surface_data_defaults();
  data.dimension = mesh->dimension;
  data.n_nodes = mesh->n_nodes;
  data.n_facets = mesh->n_facets;
  data.kind = mesh->kind;
  data.position = mesh->position;
  data.connectivity = mesh->connectivity;
  return data;
}

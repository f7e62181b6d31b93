/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_TESTS_SCENES_H
#define ABUT_TESTS_SCENES_H

/* Surfaces for tests and benchmarks: one set for both. */

#include <abut/surface.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /* Arrays of a surface, from the C library. */
  typedef struct scene_mesh
  {
    int32_t dimension;
    int32_t n_nodes;
    int32_t n_facets;
    abut_facet_kind kind;
    double *position;
    int32_t *connectivity;
  } scene_mesh;

  /* Point x of a parametrised surface at (u, v) in [0, 1]^2 (2D: u); p are the
   * parameters of the shape. The outward normal is the vector product of the
   * derivatives along u and v (2D: tangent (tx, ty) has normal (ty, -tx)). */
  typedef void (*scene_map)(const double *p, double u, double v, double *x);

  /* Plane: p = {x0, y0, size_x, size_y, height}. */
  void scene_plane(const double *p, double u, double v, double *x);
  /* Patch of a sphere, one side of a cube blown up: p = {radius, side, half
   * angle / 45 degrees}; side 0 .. 5. */
  void scene_sphere(const double *p, double u, double v, double *x);
  /* Plane ring about the origin with facets in the ratio of the radii, all of
   * one shape: p = {inner radius, outer radius, height, angle}. */
  void scene_ring(const double *p, double u, double v, double *x);
  /* Sheet folded to and fro: p = {length of a fold, gap, folds, width}. */
  void scene_fold(const double *p, double u, double v, double *x);
  /* Circular arc in 2D, counter-clockwise: p = {x0, y0, radius, from, to}. */
  void scene_arc(const double *p, double u, double v, double *x);
  /* Straight line in 2D: p = {x0, y0, x1, y1}. */
  void scene_line(const double *p, double u, double v, double *x);

  /* Mesh of nu x nv cells (triangles: two each; lines: nu) over a map; flip
   * reverses the normals. */
  scene_mesh scene_patch(abut_facet_kind kind, int32_t nu, int32_t nv,
                         scene_map map, const double *p, bool flip);

  /* The unit square at a height, n x n cells. */
  scene_mesh scene_square(abut_facet_kind kind, int32_t n, double height,
                          bool flip);

  /* n facets of a kind with random places in a box of the given size, random
   * directions, and sizes between smallest and largest (uniform in their
   * logarithm); no two share a node. */
  scene_mesh scene_random(abut_facet_kind kind, int32_t n, double box,
                          double smallest, double largest, uint64_t *seed);

  /* n parallel needles of size length x width, side by side. */
  scene_mesh scene_needles(int32_t n, double length, double width);

  /* Closed surface of a box; m cells along its longest edge. */
  scene_mesh scene_box(const double *lower, const double *upper, int32_t m);

  /* Join two meshes of one kind; their nodes stay apart. Frees both. */
  scene_mesh scene_join(scene_mesh a, scene_mesh b);

  /* Move all nodes: x <- scale R x + shift, R from the angles about z, y, x. */
  void scene_move(scene_mesh *mesh, double scale, const double *angles,
                  const double *shift);

  /* Renumber nodes and facets at random; node_id and facet_id (may be NULL)
   * receive the old numbers. */
  void scene_shuffle(scene_mesh *mesh, uint64_t *seed, int64_t *node_id,
                     int64_t *facet_id);

  void scene_free(scene_mesh *mesh);

  /* Data of a surface that borrows nothing. */
  abut_surface_data scene_data(const scene_mesh *mesh);

  /* Random number in [0, 1); splitmix64. */
  double scene_uniform(uint64_t *seed);
  uint64_t scene_bits(uint64_t *seed);

#ifdef __cplusplus
}
#endif

#endif

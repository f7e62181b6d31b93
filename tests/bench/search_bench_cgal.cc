/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* CGAL: box_intersection_d for the candidates, the AABB tree (with two
 * triangles for each quadrilateral) for the nearest facet. */
#include "search_bench.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/box_intersection_d.h>

#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

static void
candidates(const bench_scene *scene, bench_result *r)
{
  std::vector<Box> facets, nodes;
  for (int f = 0; f < scene->primary.n_facets; ++f)
  {
    const bench_facet &b = scene->facet[f];
    double lower[3], upper[3];
    for (int d = 0; d < 3; ++d)
    {
      lower[d] = b.lower[d] - b.size;
      upper[d] = b.upper[d] + b.size;
    }
    facets.emplace_back(lower, upper, f);
  }
  for (int i = 0; i < scene->secondary.n_nodes; ++i)
  {
    double x[3];
    for (int d = 0; d < 3; ++d)
      x[d] = scene->secondary.position[3L * i + d];
    nodes.emplace_back(x, x, i);
  }
  const double t0 = bench_now();
  CGAL::box_intersection_d(
      facets.begin(), facets.end(), nodes.begin(), nodes.end(),
      [&](const Box &f, const Box &n)
      {
        const double *x = scene->secondary.position + 3L * n.info();
        if (!bench_is_pair(scene->facet + f.info(), x))
          return;
        ++r->n;
        r->sum += bench_pair_number(n.info(), f.info());
      });
  r->query = bench_now() - t0;
}

static Kernel::Point_3
node(const scene_mesh &m, const int f, const int a)
{
  const double *x = m.position + 3L * m.connectivity[4L * f + a];
  return Kernel::Point_3(x[0], x[1], x[2]);
}

static void
nearest(const bench_scene *scene, bench_result *r)
{
  Triangles triangles;
  const scene_mesh &m = scene->primary;
  for (int f = 0; f < m.n_facets; ++f)
  {
    triangles.emplace_back(node(m, f, 0), node(m, f, 1), node(m, f, 2));
    triangles.emplace_back(node(m, f, 3), node(m, f, 2), node(m, f, 1));
  }
  const double heap = bench_heap(), t0 = bench_now();
  Tree tree(triangles.begin(), triangles.end());
  tree.build();
  tree.accelerate_distance_queries();
  const double t1 = bench_now();
  r->bytes = bench_heap() - heap;
  for (int i = 0; i < scene->secondary.n_nodes; ++i)
  {
    const double *x = scene->secondary.position + 3L * i;
    const auto found =
        tree.closest_point_and_primitive(Kernel::Point_3(x[0], x[1], x[2]));
    const int f = static_cast<int>(found.second - triangles.begin()) / 2;
    const double d = bench_distance(scene, f, x);
    if (d <= 0.5 * scene->facet[f].size)
    {
      ++r->n;
      r->sum += d;
    }
  }
  r->build = t1 - t0;
  r->query = bench_now() - t1;
}

int
bench_cgal(const bench_scene *scene, bench_task task, bench_result *r)
{
  *r = bench_result();
  if (task == BENCH_CANDIDATES)
    candidates(scene, r);
  else
    nearest(scene, r);
  return 1;
}

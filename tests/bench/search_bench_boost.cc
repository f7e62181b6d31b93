/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Boost.Geometry's R-tree, bulk-loaded: what deal.II searches with. */
#include "search_bench.h"

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <cmath>
#include <vector>

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;

using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Value = std::pair<Box, int>;
using Tree = bgi::rtree<Value, bgi::rstar<16>>;

static std::vector<Value>
boxes(const bench_scene *scene, const bool inflate)
{
  std::vector<Value> v;
  v.reserve(scene->primary.n_facets);
  for (int f = 0; f < scene->primary.n_facets; ++f)
  {
    const bench_facet &b = scene->facet[f];
    const double h = inflate ? b.size : 0;
    v.emplace_back(Box(Point(b.lower[0] - h, b.lower[1] - h, b.lower[2] - h),
                       Point(b.upper[0] + h, b.upper[1] + h, b.upper[2] + h)),
                   f);
  }
  return v;
}

static void
candidates(const bench_scene *scene, const Tree &tree, bench_result *r)
{
  std::vector<Value> found;
  for (int i = 0; i < scene->secondary.n_nodes; ++i)
  {
    const double *x = scene->secondary.position + 3L * i;
    found.clear();
    tree.query(bgi::intersects(Point(x[0], x[1], x[2])),
               std::back_inserter(found));
    for (const Value &v : found)
      if (bench_is_pair(scene->facet + v.second, x))
      {
        ++r->n;
        r->sum += bench_pair_number(i, v.second);
      }
  }
}

/* Boxes in the order of their distance until it exceeds the best facet's. */
static void
nearest(const bench_scene *scene, const Tree &tree, bench_result *r)
{
  for (int i = 0; i < scene->secondary.n_nodes; ++i)
  {
    const double *x = scene->secondary.position + 3L * i;
    const Point p(x[0], x[1], x[2]);
    double best = INFINITY;
    for (auto it = tree.qbegin(bgi::nearest(p, 16)); it != tree.qend(); ++it)
    {
      if (bg::distance(p, it->first) > best)
        break;
      const double d = bench_distance(scene, it->second, x);
      if (d < best && d <= 0.5 * scene->facet[it->second].size)
        best = d;
    }
    if (best < INFINITY)
    {
      ++r->n;
      r->sum += best;
    }
  }
}

int
bench_boost(const bench_scene *scene, bench_task task, bench_result *r)
{
  const std::vector<Value> values = boxes(scene, task == BENCH_CANDIDATES);
  *r = bench_result();
  const double heap = bench_heap(), t0 = bench_now();
  const Tree tree(values);
  const double t1 = bench_now();
  r->bytes = bench_heap() - heap;
  if (task == BENCH_CANDIDATES)
    candidates(scene, tree, r);
  else
    nearest(scene, tree, r);
  r->build = t1 - t0;
  r->query = bench_now() - t1;
  return 1;
}

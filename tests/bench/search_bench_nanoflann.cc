/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* nanoflann's k-d tree of the facets' centres: all within the largest radius
 * of influence, then the exact test. It knows points only, so that it takes no
 * part where facets differ much in size or the nearest facet is asked for. */
#include "search_bench.h"

#include <nanoflann.hpp>

#include <cmath>
#include <vector>

namespace
{
  struct Centres
  {
    const bench_scene *scene;

    std::size_t kdtree_get_point_count() const
    {
      return scene->primary.n_facets;
    }

    double kdtree_get_pt(const std::size_t i, const std::size_t d) const
    {
      return scene->facet[i].centre[d];
    }

    template <class Box> bool kdtree_get_bbox(Box &) const
    {
      return false;
    }
  };
} // namespace

using Tree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, Centres>, Centres, 3, int>;

int
bench_nanoflann(const bench_scene *scene, bench_task task, bench_result *r)
{
  double largest = 0, smallest = INFINITY;
  for (int f = 0; f < scene->primary.n_facets; ++f)
  {
    const double influence = scene->facet[f].radius + scene->facet[f].size;
    largest = std::fmax(largest, influence);
    smallest = std::fmin(smallest, influence);
  }
  if (task != BENCH_CANDIDATES || largest > 4 * smallest)
    return 0;
  *r = bench_result();
  const Centres centres{scene};
  const double heap = bench_heap(), t0 = bench_now();
  Tree tree(3, centres, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  tree.buildIndex();
  const double t1 = bench_now();
  r->bytes = bench_heap() - heap;
  std::vector<std::pair<int, double>> found;
  nanoflann::SearchParams parameters;
  parameters.sorted = false;
  for (int i = 0; i < scene->secondary.n_nodes; ++i)
  {
    const double *x = scene->secondary.position + 3L * i;
    tree.radiusSearch(x, largest * largest * (1 + 1e-12), found, parameters);
    for (const auto &f : found)
      if (bench_is_pair(scene->facet + f.first, x))
      {
        ++r->n;
        r->sum += bench_pair_number(i, f.first);
      }
  }
  r->build = t1 - t0;
  r->query = bench_now() - t1;
  return 1;
}

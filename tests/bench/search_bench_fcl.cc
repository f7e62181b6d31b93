/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* FCL's dynamic tree of boxes for the candidates: every facet and every node is
 * an object, as in its broad phase. */
#include "search_bench.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace
{
  using Object = fcl::CollisionObject<double>;

  /* Rounding of boxes that are given by middle and extent. */
  const double slack = 1e-12;

  struct Query
  {
    const bench_scene *scene;
    int node;
    bench_result *result;
  };

  bool take(Object *a, Object *b, void *user)
  {
    const Query *q = static_cast<const Query *>(user);
    const auto i = reinterpret_cast<std::intptr_t>(a->getUserData()),
               j = reinterpret_cast<std::intptr_t>(b->getUserData());
    const int f = static_cast<int>(i + j) - 1; // the query's is 0
    if (bench_is_pair(q->scene->facet + f,
                      q->scene->secondary.position + 3L * q->node))
    {
      ++q->result->n;
      q->result->sum += bench_pair_number(q->node, f);
    }
    return false;
  }
} // namespace

int
bench_fcl(const bench_scene *scene, bench_task task, bench_result *r)
{
  *r = bench_result();
  if (task != BENCH_CANDIDATES)
    return 0;
  const double before = bench_heap();
  std::vector<std::unique_ptr<Object>> objects;
  std::vector<Object *> pointers;
  for (int f = 0; f < scene->primary.n_facets; ++f)
  {
    const bench_facet &b = scene->facet[f];
    fcl::Vector3d extent, middle;
    for (int d = 0; d < 3; ++d)
    {
      extent[d] = b.upper[d] - b.lower[d] + 2 * (b.size + slack);
      middle[d] = 0.5 * (b.lower[d] + b.upper[d]);
    }
    objects.push_back(
        std::make_unique<Object>(std::make_shared<fcl::Boxd>(extent),
                                 fcl::Matrix3d::Identity(), middle));
    objects.back()->setUserData(reinterpret_cast<void *>(f + std::intptr_t(1)));
    pointers.push_back(objects.back().get());
  }
  fcl::DynamicAABBTreeCollisionManager_Array<double> tree;
  const double t0 = bench_now();
  tree.registerObjects(pointers);
  tree.setup();
  const double t1 = bench_now();
  r->bytes = bench_heap() - before;
  Object point(std::make_shared<fcl::Sphered>(slack));
  point.setUserData(nullptr);
  for (int i = 0; i < scene->secondary.n_nodes; ++i)
  {
    const double *x = scene->secondary.position + 3L * i;
    Query q{scene, i, r};
    point.setTranslation(fcl::Vector3d(x[0], x[1], x[2]));
    point.computeAABB();
    tree.collide(&point, &q, take);
  }
  r->build = t1 - t0;
  r->query = bench_now() - t1;
  return 1;
}

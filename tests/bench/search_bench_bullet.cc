/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Bullet's dynamic tree of boxes, in single precision, for the candidates.
 * Facets are inserted one after the other, as its broad phase does, which takes
 * more than a minute for a million: it takes part up to a hundred thousand. */
#include "search_bench.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <cstdint>

namespace
{
  const float slack = 3e-7f;

  struct Query : btDbvt::ICollide
  {
    const bench_scene *scene;
    int node;
    bench_result *result;

    void Process(const btDbvtNode *leaf) override
    {
      const int f =
          static_cast<int>(reinterpret_cast<std::intptr_t>(leaf->data));
      if (bench_is_pair(scene->facet + f,
                        scene->secondary.position + 3L * node))
      {
        ++result->n;
        result->sum += bench_pair_number(node, f);
      }
    }
  };

  btVector3 vector(const double *x, const double shift)
  {
    return btVector3(static_cast<float>(x[0] + shift),
                     static_cast<float>(x[1] + shift),
                     static_cast<float>(x[2] + shift));
  }
} // namespace

int
bench_bullet(const bench_scene *scene, bench_task task, bench_result *r)
{
  *r = bench_result();
  if (task != BENCH_CANDIDATES || scene->primary.n_facets > 110000)
    return 0;
  const double before = bench_heap();
  const double t0 = bench_now();
  btDbvt tree;
  for (int f = 0; f < scene->primary.n_facets; ++f)
  {
    const bench_facet &b = scene->facet[f];
    const double h = b.size + slack;
    const btDbvtVolume box =
        btDbvtVolume::FromMM(vector(b.lower, -h), vector(b.upper, h));
    tree.insert(box, reinterpret_cast<void *>(std::intptr_t(f)));
  }
  const double t1 = bench_now();
  r->bytes = bench_heap() - before;
  Query q;
  q.scene = scene;
  q.result = r;
  for (q.node = 0; q.node < scene->secondary.n_nodes; ++q.node)
  {
    const double *x = scene->secondary.position + 3L * q.node;
    const btDbvtVolume point =
        btDbvtVolume::FromMM(vector(x, -slack), vector(x, slack));
    tree.collideTV(tree.m_root, point, q);
  }
  r->build = t1 - t0;
  r->query = bench_now() - t1;
  return 1;
}

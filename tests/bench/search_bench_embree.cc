/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Embree's point queries over its hierarchy of boxes, one thread. Its boxes
 * are in single precision, here rounded outwards (coordinates are 0 .. 1); the
 * tests are exact. */
#include "search_bench.h"

#include <embree3/rtcore.h>

#include <cmath>

namespace
{
  const float slack = 3e-7f;

  struct Boxes
  {
    const bench_scene *scene;
    bool inflate;
  };

  struct Query
  {
    const bench_scene *scene;
    const double *x;
    int node;
    double best;
    int facet;
    bench_result *result;
  };

  void bounds(const RTCBoundsFunctionArguments *a)
  {
    const Boxes *b = static_cast<const Boxes *>(a->geometryUserPtr);
    const bench_facet &f = b->scene->facet[a->primID];
    const double h = (b->inflate ? f.size : 0) + slack;
    RTCBounds *o = a->bounds_o;
    o->lower_x = static_cast<float>(f.lower[0] - h);
    o->lower_y = static_cast<float>(f.lower[1] - h);
    o->lower_z = static_cast<float>(f.lower[2] - h);
    o->upper_x = static_cast<float>(f.upper[0] + h);
    o->upper_y = static_cast<float>(f.upper[1] + h);
    o->upper_z = static_cast<float>(f.upper[2] + h);
  }

  bool take_candidate(RTCPointQueryFunctionArguments *a)
  {
    Query *q = static_cast<Query *>(a->userPtr);
    if (bench_is_pair(q->scene->facet + a->primID, q->x))
    {
      ++q->result->n;
      q->result->sum += bench_pair_number(q->node, a->primID);
    }
    return false;
  }

  bool take_nearest(RTCPointQueryFunctionArguments *a)
  {
    Query *q = static_cast<Query *>(a->userPtr);
    const double d = bench_distance(q->scene, a->primID, q->x);
    if (!(d < q->best))
      return false;
    q->best = d;
    q->facet = a->primID;
    a->query->radius = static_cast<float>(d) + slack;
    return true;
  }

  bool count_memory(void *total, const ssize_t bytes, const bool)
  {
    *static_cast<double *>(total) += static_cast<double>(bytes);
    return true;
  }

  void ask(RTCScene tree, const bench_task task, Query &q)
  {
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery p;
    p.x = static_cast<float>(q.x[0]);
    p.y = static_cast<float>(q.x[1]);
    p.z = static_cast<float>(q.x[2]);
    p.time = 0;
    p.radius = slack;
    if (task == BENCH_NEAREST)
      p.radius += static_cast<float>(0.5 * q.scene->largest);
    q.best = INFINITY;
    rtcPointQuery(tree, &p, &context,
                  task == BENCH_CANDIDATES ? take_candidate : take_nearest, &q);
    if (task == BENCH_NEAREST && q.best < INFINITY
        && q.best <= 0.5 * q.scene->facet[q.facet].size)
    {
      ++q.result->n;
      q.result->sum += q.best;
    }
  }
} // namespace

int
bench_embree(const bench_scene *scene, bench_task task, bench_result *r)
{
  *r = bench_result();
  Boxes boxes{scene, task == BENCH_CANDIDATES};
  double memory = 0;
  RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  rtcSetDeviceMemoryMonitorFunction(device, count_memory, &memory);
  RTCScene tree = rtcNewScene(device);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, scene->primary.n_facets);
  rtcSetGeometryUserData(geometry, &boxes);
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree, geometry);
  const double t0 = bench_now();
  rtcCommitScene(tree);
  const double t1 = bench_now();
  r->bytes = memory;
  Query q{scene, nullptr, 0, 0, 0, r};
  for (q.node = 0; q.node < scene->secondary.n_nodes; ++q.node)
  {
    q.x = scene->secondary.position + 3L * q.node;
    ask(tree, task, q);
  }
  r->build = t1 - t0;
  r->query = bench_now() - t1;
  rtcReleaseGeometry(geometry);
  rtcReleaseScene(tree);
  rtcReleaseDevice(device);
  return 1;
}

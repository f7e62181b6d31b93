/* SPDX-License-Identifier: LGPL-2.1-or-later */
/* Times Abut's three searches, and those of other authors where they are
 * installed, on the same scenes, and checks that all find the same.
 *
 *   search_bench [--sizes 100,316,1000] [--repeats 3] [--output DIR]
 *
 * A size is the number of facets along a side; facets and nodes are its
 * square. Times are processor times, the least of the repeats. */
#include "search_bench.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace
{
  struct Program
  {
    const char *name;
    bench_program run;
  };

  const Program programs[] = {
      {"adaptive buckets", bench_adaptive},
      {"uniform buckets", bench_uniform},
      {"all pairs", bench_all_pairs},
#ifdef ABUT_BENCH_EMBREE
      {"Embree", bench_embree},
#endif
#ifdef ABUT_BENCH_BOOST
      {"Boost R-tree", bench_boost},
#endif
#ifdef ABUT_BENCH_CGAL
      {"CGAL", bench_cgal},
#endif
#ifdef ABUT_BENCH_NANOFLANN
      {"nanoflann", bench_nanoflann},
#endif
#ifdef ABUT_BENCH_FCL
      {"FCL", bench_fcl},
#endif
#ifdef ABUT_BENCH_BULLET
      {"Bullet", bench_bullet},
#endif
  };

  const char *const task_names[BENCH_N_TASKS] = {"candidates", "nearest"};

  struct Options
  {
    std::vector<int> sizes = {100, 316, 1000};
    int repeats = 3;
    std::string output = ".";
  };

  const char *const scene_names[] = {"flat", "sphere", "graded", "shuffled"};

  /* Nodes lie a tenth of the smallest facet above the primary surface. */
  bench_scene make_scene(const int which, const int n)
  {
    bench_scene s = {};
    s.name = scene_names[which];
    const int m = n - 1; // secondary cells: n^2 nodes
    if (which == 1)
    {
      const double p[3] = {1, 2, 1}, q[3] = {1 + 0.1 / n, 2, 1};
      s.primary = scene_patch(ABUT_FACET_QUAD4, n, n, scene_sphere, p, false);
      s.secondary = scene_patch(ABUT_FACET_QUAD4, m, m, scene_sphere, q, true);
    }
    else if (which == 2)
    {
      // ln(1000) by 6 radian: square facets, the sizes in the ratio 1:1000
      const int nu = static_cast<int>(1.073 * n), nv = n * n / nu;
      const double p[4] = {1e-3, 1, 0, 6}, q[4] = {1e-3, 1, 6e-4 / nv, 6};
      s.primary = scene_patch(ABUT_FACET_QUAD4, nu, nv, scene_ring, p, false);
      s.secondary =
          scene_patch(ABUT_FACET_QUAD4, nu - 1, nv - 1, scene_ring, q, true);
    }
    else
    {
      const double p[5] = {0, 0, 1, 1, 0}, q[5] = {0, 0, 1, 1, 0.1 / n};
      s.primary = scene_patch(ABUT_FACET_QUAD4, n, n, scene_plane, p, false);
      s.secondary = scene_patch(ABUT_FACET_QUAD4, m, m, scene_plane, q, true);
    }
    if (which == 3)
    {
      uint64_t seed = 1;
      scene_shuffle(&s.primary, &seed, nullptr, nullptr);
      scene_shuffle(&s.secondary, &seed, nullptr, nullptr);
    }
    bench_measure_facets(&s);
    return s;
  }

  void free_scene(bench_scene &s)
  {
    scene_free(&s.primary);
    scene_free(&s.secondary);
    std::free(s.facet);
  }

  bool agree(const bench_result &a, const bench_result &b,
             const bench_task task)
  {
    if (task == BENCH_CANDIDATES)
      return a.n == b.n && a.sum == b.sum;
    return a.n == b.n && std::fabs(a.sum - b.sum) <= 1e-6 * std::fabs(a.sum);
  }

  /* Least times of the repeats; false if the program takes no part. Runs of
   * more than ten seconds are not repeated. */
  bool time_program(const Program &p, const bench_scene &s,
                    const bench_task task, const int repeats,
                    bench_result &best)
  {
    for (int k = 0; k < repeats; ++k)
    {
      bench_result r;
      if (p.run(&s, task, &r) == 0)
        return false;
      if (k == 0 || r.build + r.query < best.build + best.query)
        best = r;
      if (r.build + r.query > 10)
        break;
    }
    return true;
  }

  int compare(const Options &o, std::ofstream &csv)
  {
    int n_wrong = 0;
    std::printf("%-9s %8s %-10s %-17s %9s %9s %9s %11s %s\n", "scene", "facets",
                "task", "program", "build", "query", "total", "bytes/facet",
                "result");
    for (const int n : o.sizes)
      for (int which = 0; which < 4; ++which)
      {
        bench_scene s = make_scene(which, n);
        const double nodes = s.secondary.n_nodes;
        for (int t = 0; t < BENCH_N_TASKS; ++t)
        {
          const bench_task task = static_cast<bench_task>(t);
          bench_result first = {};
          for (const Program &p : programs)
          {
            bench_result r;
            if (!time_program(p, s, task, o.repeats, r))
              continue;
            if (p.run == bench_adaptive)
              first = r;
            const bool same = agree(first, r, task);
            n_wrong += !same;
            const double build = 1e9 * r.build / nodes,
                         query = 1e9 * r.query / nodes,
                         bytes = r.bytes / s.primary.n_facets;
            std::printf("%-9s %8d %-10s %-17s %9.1f %9.1f %9.1f %11.1f %s\n",
                        s.name, s.primary.n_facets, task_names[t], p.name,
                        build, query, build + query, bytes,
                        same ? "same" : "DIFFERENT");
            std::fflush(stdout);
            csv << s.name << ',' << s.primary.n_facets << ',' << task_names[t]
                << ',' << p.name << ',' << build << ',' << query << ','
                << build + query << ',' << bytes << ',' << r.n << ','
                << (same ? 1 : 0) << std::endl;
          }
        }
        free_scene(s);
      }
    return n_wrong;
  }

  void stages(const Options &o)
  {
    std::printf("\nStages of the detection, ns per node; with a skin, after "
                "small motion, renewal and\ncheck take the place of build and "
                "steps 2 to 11\n%-9s %8s %8s %8s %8s %8s %14s %8s %8s\n",
                "scene", "facets", "normals", "build", "rest", "total",
                "steps 2 to 11", "renewal", "check");
    for (const int n : o.sizes)
      for (int which = 0; which < 4; ++which)
      {
        bench_scene s = make_scene(which, n);
        bench_stages z;
        bench_stages_of(&s, o.repeats, &z);
        std::printf("%-9s %8d %8.1f %8.1f %8.1f %8.1f %14.1f %8.1f %8.1f\n",
                    s.name, s.primary.n_facets, z.normals, z.build, z.rest,
                    z.normals + z.build + z.rest, z.steps_2_to_11, z.renewal,
                    z.after_motion);
        std::fflush(stdout);
        free_scene(s);
      }
  }

  void bucket_sizes(const Options &o, std::ofstream &csv)
  {
    const int n =
        std::min(316, *std::max_element(o.sizes.begin(), o.sizes.end()));
    std::printf("\nTime against bucket size (0: chosen), ns per node, %d "
                "facets\n%-9s %6s %9s %9s\n",
                n * n, "scene", "size", "uniform", "adaptive");
    for (int which = 0; which < 3; ++which)
    {
      bench_scene s = make_scene(which, n);
      for (const double size : {0., 0.5, 1., 1.5, 2., 3., 4., 6., 10., 20.})
      {
        const double uniform = bench_bucket_size(&s, 1, size, o.repeats),
                     adaptive = bench_bucket_size(&s, 2, size, o.repeats);
        std::printf("%-9s %6.1f %9.1f %9.1f\n", s.name, size, uniform,
                    adaptive);
        std::fflush(stdout);
        csv << s.name << ',' << size << ',' << uniform << ',' << adaptive
            << std::endl;
      }
      free_scene(s);
    }
  }

  bool parse(const int argc, char **argv, Options &o)
  {
    for (int i = 1; i < argc; i += 2)
    {
      if (i + 1 == argc)
        return false;
      const std::string word = argv[i];
      if (word == "--repeats")
        o.repeats = std::max(1, std::atoi(argv[i + 1]));
      else if (word == "--output")
        o.output = argv[i + 1];
      else if (word == "--sizes")
      {
        o.sizes.clear();
        for (const char *c = argv[i + 1]; c != nullptr && *c != 0;)
        {
          o.sizes.push_back(std::max(4, std::atoi(c)));
          c = std::strchr(c, ',');
          c = c == nullptr ? nullptr : c + 1;
        }
      }
      else
        return false;
    }
    return !o.sizes.empty();
  }
} // namespace

int
main(int argc, char **argv)
{
  Options o;
  if (!parse(argc, argv, o))
  {
    std::fprintf(stderr, "usage: search_bench [--sizes 100,316,1000] "
                         "[--repeats 3] [--output DIR]\n");
    return 2;
  }
  std::ofstream csv(o.output + "/search.csv");
  std::ofstream buckets(o.output + "/search_bucket.csv");
  if (!csv || !buckets)
  {
    std::fprintf(stderr, "search_bench: cannot write to %s\n",
                 o.output.c_str());
    return 2;
  }
  csv << "scene,facets,task,program,build,query,total,bytes_per_facet,found,"
         "same\n";
  buckets << "scene,bucket_size,uniform,adaptive\n";
  const int n_wrong = compare(o, csv);
  stages(o);
  bucket_sizes(o, buckets);
  csv.close();
  buckets.close();
  return n_wrong == 0 ? 0 : 1;
}

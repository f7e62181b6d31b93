// SPDX-License-Identifier: LGPL-2.1-or-later
//
// When an answer is good enough: sequences of meshes whose errors are known.

#include "app/adapt/error_target.h"
#include "app/adapt/tighten_method.h"

#include "expect.h"
#include "run_checks.h"

using namespace abut;
using namespace abut::app;
using Step = ErrorTarget::Step;

namespace
{
  /** Meshes whose error halves each time, with a residual estimate five times
   * as large; the solution has norm 2, its contact force tends to 3. */
  struct Meshes
  {
    double error = 0.8;
    bool first = true;

    MeshEvidence next()
    {
      MeshEvidence mesh;
      const double before = error;
      error = first ? error : 0.5 * error;
      mesh.residual = 5. * error;
      if (!first)
        mesh.change = std::sqrt(before * before - error * error);
      mesh.norm = 2.;
      mesh.contact_force = 3. + 0.7 * error * error;
      first = false;
      return mesh;
    }
  };

  void calibration()
  {
    ErrorTarget target(1e-2, TargetQuantity::energy_norm);
    Meshes meshes;
    target.add(meshes.next(), false);
    Expect::near(target.errors().discretisation, 5. * 0.8 / 2., 1e-15,
                 "first mesh: the residual estimate itself");
    Expect::that(target.next() == Step::refine, "first mesh is not enough");
    unsigned int n = 1;
    while (target.next() == Step::refine && n < 20)
    {
      target.add(meshes.next(), false);
      ++n;
      Expect::near(target.errors().discretisation / meshes.error, 1.3 / 2.,
                   1e-12, "margin over the relative error");
    }
    // 1.3 * 0.8 / 2^(n-1) / 2 <= 1e-2 for n = 7
    Expect::that(n == 7, "meshes: " + std::to_string(n));
    Expect::that(target.next() == Step::stop, "target met");
  }

  /** Changes that chance has made small are not believed. */
  void bounds()
  {
    ErrorTarget target(1e-2, TargetQuantity::energy_norm);
    MeshEvidence mesh;
    mesh.norm = 1.;
    mesh.residual = 1.;
    target.add(mesh, false);
    mesh.residual = 0.1;
    mesh.change = 1e-9;
    target.add(mesh, false);
    Expect::near(target.calibration(), 1. / 20., 1e-15, "smallest factor");
    Expect::that(target.errors().total() <= 1e-2
                     && target.next() == Step::refine,
                 "no stop before it was measured twice");
    mesh.change = 10.;
    target.add(mesh, true);
    Expect::near(target.calibration(), 1. / 20., 1e-15,
                 "the same mesh keeps its change");
    mesh.residual = 0.05;
    target.add(mesh, false);
    Expect::near(target.calibration(), 1., 1e-15, "largest factor");
  }

  void parts()
  {
    const auto judged = [](const double law, const double increment)
    {
      ErrorTarget target(1e-2, TargetQuantity::energy_norm);
      Meshes meshes;
      for (unsigned int n = 0; n < 9; ++n)
      {
        MeshEvidence mesh = meshes.next();
        mesh.law = law;
        mesh.last_increment = increment;
        mesh.last_tolerance = 1e-2;
        target.add(mesh, false);
      }
      return target;
    };
    Expect::that(judged(0., 0.).next() == Step::stop, "nothing is left");
    ErrorTarget soft = judged(0.08, 0.);
    Expect::near(soft.errors().contact, 0.04, 1e-15, "law");
    Expect::that(soft.next() == Step::tighten_law, "the law decides");
    Expect::near(soft.law_factor(), 0.04 / (0.15 * 1e-2), 1e-12, "its factor");
    ErrorTarget loose = judged(0., 4.);
    Expect::near(loose.errors().algebraic, 0.02, 1e-15, "linear systems");
    Expect::that(loose.next() == Step::tighten_solver, "linear systems decide");
    Expect::near(loose.solver_factor(), 0.02 / (0.05 * 1e-2), 1e-12,
                 "their factor");
  }

  void force()
  {
    ErrorTarget target(1e-3, TargetQuantity::contact_force);
    Meshes meshes;
    target.add(meshes.next(), false);
    Expect::near(target.errors().discretisation, 1., 1e-15,
                 "one mesh says nothing");
    for (unsigned int n = 0; n < 4; ++n)
    {
      const MeshEvidence mesh = meshes.next();
      target.add(mesh, false);
      Expect::near(target.errors().discretisation,
                   2. * 0.7 * meshes.error * meshes.error / mesh.contact_force,
                   1e-12, "twice the error of the force");
    }
  }

  void fraction()
  {
    ErrorTarget target(0.1, TargetQuantity::energy_norm);
    Meshes meshes;
    target.add(meshes.next(), false);
    Expect::near(target.refine_fraction(0.1, 0.6), 0.6, 1e-15,
                 "far from the target");
    target.add(meshes.next(), false); // 1.3 * 0.4 / 2 = 0.26
    target.add(meshes.next(), false); // 0.13
    const double wanted = std::pow(0.1 / 0.13, 2);
    Expect::near(target.refine_fraction(0.1, 0.9),
                 4. / 3. * (1. - 0.8 * wanted), 1e-12, "near it");
  }

  void tightened()
  {
    MethodParameters method;
    abut_strategy_options &o = method.options;
    o.law = abut_law_find("penalty");
    o.penalty_cap = 1000.;
    Expect::that(tighten_law(method, 3., 50.) && o.penalty == 150.,
                 "stiffer penalty");
    Expect::that(tighten_law(method, 30., 150.) && o.penalty == 1000.,
                 "penalty at its cap");
    Expect::that(!tighten_law(method, 2., 1000.), "no stiffer than that");
    o.law = abut_law_find("barrier");
    const double end = o.barrier_end;
    Expect::that(tighten_law(method, 10., 0.) && o.barrier_end == end / 10.,
                 "smaller last barrier");
    const double tolerance = o.final_linear_tolerance;
    tighten_solver(method, 4.);
    Expect::that(o.final_linear_tolerance == tolerance / 4., "tolerance");
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(argc, argv,
                    [](const std::filesystem::path &)
                    {
                      calibration();
                      bounds();
                      parts();
                      force();
                      fraction();
                      tightened();
                    });
}

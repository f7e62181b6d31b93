// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Places where forces are in balance: springs with gaps, powers and couplings,
// whose answers are closed forms.

#include "app/physics/force_balance.h"

#include "expect.h"
#include "run_checks.h"

using namespace abut::app;
using Answer = ForceBalance::Answer;
using Values = std::vector<double>;

namespace
{
  /** What contact does at a place. */
  using Contact = std::function<Values(const Values &)>;

  struct Problem
  {
    Values load, mass, start;
    Contact contact;
    double way = 0.; ///< where nothing resists, along the load
    /** Where there is no answer. */
    std::function<bool(const Values &)> fails = [](const Values &)
    { return false; };
  };

  /** Go where the search says; the place where it ends. */
  Answer search(ForceBalance &balance, const Problem &problem)
  {
    const std::size_t n = problem.load.size();
    balance.begin(problem.start, problem.mass, 1e-10);
    for (double way = problem.way;; way *= 2.)
    {
      const Values x = balance.place();
      Answer answer;
      if (problem.fails(x))
        answer = balance.refuse();
      else
      {
        ForceBalance::Forces forces;
        forces.contact = problem.contact(x);
        forces.round_off.assign(n, 0.);
        forces.probe = 1e-7;
        double size = 0.;
        for (std::size_t i = 0; i < n; ++i)
        {
          const double inertia = problem.mass[i] * x[i];
          forces.rest.push_back(problem.load[i] + forces.contact[i] - inertia);
          size = std::max({size, std::abs(problem.load[i]),
                           std::abs(forces.contact[i]), std::abs(inertia)});
          forces.way.push_back(forces.contact[i] == 0.
                                   ? std::copysign(way, problem.load[i])
                                   : 0.);
        }
        forces.size.assign(n, size);
        answer = balance.take(forces);
      }
      if (answer != Answer::move)
        return answer;
    }
  }

  double spring(const double depth, const double power)
  {
    return depth > 0. ? std::pow(depth, power) : 0.;
  }

  void one_coordinate()
  {
    for (const double power : {1., 1.5, 2., 3., 0.7})
      for (const double load : {1e-6, 1e-3, 1., 100.})
        for (const double gap : {0., 0.3, 5.})
        {
          ForceBalance balance;
          const Answer answer =
              search(balance, {{load},
                               {0.},
                               {0.},
                               [&](const Values &x) -> Values
                               { return {-spring(x[0] - gap, power)}; },
                               0.07});
          const std::string what = "power " + std::to_string(power) + ", load "
                                   + std::to_string(load) + ", gap "
                                   + std::to_string(gap);
          Expect::that(answer == Answer::balanced, what);
          const double depth = std::pow(load, 1. / power);
          Expect::near(spring(balance.place()[0] - gap, power) / load, 1.,
                       1e-10 + 1e-14 * gap / depth, what);
          Expect::that(balance.n_places() < (load < 1e-4 ? 60 : 30),
                       what + ": places " + std::to_string(balance.n_places()));
        }
  }

  /** A mass in flight, one that meets a stiff wall, and one with an answer
   * near enough only. */
  void with_inertia()
  {
    ForceBalance balance;
    const auto wall = [](const Values &x) -> Values
    { return {-1e4 * spring(x[0] - 0.5, 1.)}; };
    Problem problem = {{0.3}, {1.}, {0.}, wall};
    Expect::that(search(balance, problem) == Answer::balanced, "flight");
    Expect::near(balance.place()[0], 0.3, 1e-12, "flight");
    Expect::that(balance.n_places() == 2, "places of a flight");
    problem.load = {1.};
    for (const double start : {0., 0.6, 3.})
    {
      problem.start = {start};
      balance.forget();
      Expect::that(search(balance, problem) == Answer::balanced, "impact");
      Expect::near(balance.place()[0], (1. + 5000.) / 10001., 1e-10, "impact");
    }
    problem.load = {0.1};
    Expect::that(search(balance, problem) == Answer::balanced, "leaves");
    Expect::near(balance.place()[0], 0.1, 1e-12, "leaves");
    Expect::that(!balance.knows_stiffness(), "no stiffness in flight");
    problem = {{2.},
               {0.},
               {0.2},
               [](const Values &x) -> Values { return {-x[0]}; },
               0.};
    problem.fails = [](const Values &x) { return x[0] > 2.5; };
    Expect::that(search(balance, problem) == Answer::balanced, "fails beyond");
    problem.fails = [](const Values &) { return true; };
    Expect::that(search(balance, problem) == Answer::stuck, "fails all over");
  }

  /** Three coordinates, one spring of power 1.5 along a slant and three weak
   * ones. */
  void several()
  {
    const Values normal = {0.6, 0., 0.8}, load = {0.05, -0.02, 0.5};
    const auto contact = [&](const Values &x) -> Values
    {
      double depth = 0.;
      for (int d = 0; d < 3; ++d)
        depth += normal[d] * x[d];
      const double f = 50. * spring(depth, 1.5);
      Values force(3, 0.);
      for (int d = 0; d < 3; ++d)
        force[d] = -f * normal[d] - 0.7 * x[d];
      return force;
    };
    for (const Values &start :
         {Values{0., 0., 0.1}, Values{0.3, 0.1, 0.3}, Values{1., 1., 1.}})
    {
      ForceBalance balance;
      Expect::that(search(balance, {load, {0., 0., 0.}, start, contact})
                       == Answer::balanced,
                   "slanting spring");
      const Values force = contact(balance.place());
      for (int d = 0; d < 3; ++d)
        Expect::near(force[d], -load[d], 1e-10, "slanting spring");
      Expect::that(balance.n_places() < 30,
                   "places " + std::to_string(balance.n_places()));
      // A little more: no differences are needed again.
      const Values more = {0.051, -0.02, 0.51};
      const unsigned int before = balance.n_places();
      Problem next = {more, {0., 0., 0.}, balance.place(), contact};
      const Values way = balance.way_under({0.001, 0., 0.01});
      for (int d = 0; d < 3; ++d)
        next.start[d] += way[d];
      Expect::that(search(balance, next) == Answer::balanced
                       && balance.n_places() < before,
                   "the next step: " + std::to_string(balance.n_places()));
    }
  }

  void loose()
  {
    ForceBalance balance;
    const auto along_first = [](const Values &x) -> Values {
      return {-spring(x[0], 1.), 0.};
    };
    Expect::that(search(balance, {{1., 1.}, {0., 0.}, {0.5, 0.}, along_first})
                         == Answer::loose
                     && balance.loose() == 1,
                 "nothing holds the second");
    balance.forget();
    Expect::that(search(balance, {{1., 0.}, {0., 0.}, {0.5, 0.}, along_first})
                     == Answer::balanced,
                 "nothing drives it");
    balance.forget();
    Expect::that(search(balance, {{1., 1.}, {0., 2.}, {0.5, 0.}, along_first})
                     == Answer::balanced,
                 "its mass holds it");
    Expect::near(balance.place()[1], 0.5, 1e-10, "its mass holds it");
    balance.forget();
    Expect::that(
        search(
            balance,
            {{1.}, {0.}, {0.}, [](const Values &) -> Values { return {0.}; }})
            == Answer::loose,
        "nothing there");
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(argc, argv,
                    [](const std::filesystem::path &)
                    {
                      one_coordinate();
                      with_inertia();
                      several();
                      loose();
                    });
}

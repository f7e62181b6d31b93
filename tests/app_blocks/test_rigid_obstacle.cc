// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Rigid obstacles as a deal.II program and as a scene file makes them:
// distances from formulas, motion, and bad input.

#include "app/mesh/make_rigid_obstacle.h"

#include "expect.h"
#include "run_checks.h"

#include <deal.II/base/function_signed_distance.h>
#include <deal.II/base/mpi.h>

#include <filesystem>
#include <fstream>

using namespace abut;
using namespace abut::app;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  std::filesystem::path folder;

  RunOptions options()
  {
    RunOptions result;
    result.communicator = MPI_COMM_WORLD;
    result.scene_file = folder / "scene.prm";
    return result;
  }

  using Settings = std::vector<std::pair<std::string, std::string>>;

  template <int dim>
  std::shared_ptr<RigidObstacle<dim>> make(const Settings &settings)
  {
    dealii::ParameterHandler prm;
    RigidObstacleParameters::declare(prm);
    for (const auto &[name, value] : settings)
      prm.set(name, value);
    RigidObstacleParameters parameters;
    parameters.parse(prm, "Obstacle 2");
    return make_rigid_obstacle<dim>(parameters, options());
  }

  template <int dim>
  void expect(const RigidObstacle<dim> &obstacle, const Point<dim> &point,
              const double distance, const Tensor<1, dim> &gradient,
              const std::string &what, const double tolerance = 1e-14)
  {
    std::vector<double> distances;
    std::vector<Tensor<1, dim>> gradients;
    obstacle.distance({point}, distances, &gradients);
    Expect::near(distances[0], distance, tolerance, what);
    Expect::near((gradients[0] - gradient).norm(), 0, tolerance,
                 what + ", gradient's error");
  }

  using Vector2 = Tensor<1, 2>;
  using Vector3 = Tensor<1, 3>;

  void shapes()
  {
    expect<2>(*make<2>({}), {3, 0.5}, 0.5, Vector2({0, 1}), "half plane");
    expect<3>(*make<3>({{"Normal", "0, 0, -2"}, {"Point", "0 0 1"}}),
              {3, 4, 0.25}, 0.75, Vector3({0, 0, -1}), "plane above");
    expect<2>(*make<2>({{"Kind", "sphere"},
                        {"Centre", "1, 2"},
                        {"Radius", "0.5"},
                        {"Hollow", "true"}}),
              {1.25, 2}, 0.25, Vector2({-1, 0}), "hole");
    expect<3>(*make<3>({{"Kind", "cylinder"},
                        {"Axis", "0, 3, 0"},
                        {"Length", "2"},
                        {"Radius", "1"}}),
              {4, 5, 0}, 5, Vector3({0.6, 0.8, 0}), "rim of a cylinder");
    expect<3>(*make<3>({{"Kind", "box"}, {"Size", "2, 4, 6"}}), {0, 3, 0}, 1,
              Vector3({0, 1, 0}), "box");
    expect<3>(*make<3>({{"Kind", "cone"}, {"Angle", "30"}, {"Point", "1 0 0"}}),
              {1, 0, -2}, 2, Vector3({0, 0, -1}), "tip of a cone");
    expect<2>(*make<2>({{"Kind", "cone"}, {"Angle", "30"}}), {std::sqrt(3.), 1},
              1, Vector2({std::sqrt(3.) / 2, -0.5}), "wedge");
    // edges of 2 along the diagonals, then moved
    expect<2>(*make<2>({{"Kind", "box"},
                        {"Size", "2"},
                        {"Rotate", "45"},
                        {"Move", "1, 0"}}),
              {1, 2}, 2 - std::sqrt(2.), Vector2({0, 1}), "turned box");
  }

  void formulas()
  {
    // a die above: a sphere's height, the gap along the axis
    const std::string cap = "1 - sqrt(0.25 - x^2 - y^2)";
    const double height = 1 - std::sqrt(0.25 - 0.01 - 0.04);
    const auto die =
        make<3>({{"Kind", "height"}, {"Expression", cap}, {"Axis", "0 0 -1"}});
    expect<3>(*die, {0.1, 0.2, 0.3}, height - 0.3, Vector3({0, 0, -1}),
              "height of a die");
    // on the surface the normal of the sphere about (0, 0, 1)
    const Point<3> on(0.1, 0.2, height);
    expect<3>(*make<3>({{"Kind", "height"},
                        {"Expression", cap},
                        {"Axis", "0 0 -1"},
                        {"Gap along", "normal"}}),
              on, 0, (on - Point<3>(0, 0, 1)) / 0.5, "normal of a die", 1e-8);
    expect<3>(*make<3>({{"Kind", "height"},
                        {"Expression", cap},
                        {"Gradient", "x/sqrt(0.25-x^2-y^2); "
                                     "y/sqrt(0.25-x^2-y^2); 0"},
                        {"Axis", "0 0 -1"},
                        {"Gap along", "normal"}}),
              on, 0, (on - Point<3>(0, 0, 1)) / 0.5, "with a formula of it");
    // ground whose height depends on y, measured along x
    expect<2>(
        *make<2>(
            {{"Kind", "height"}, {"Expression", "y^2 + t"}, {"Axis", "1 0"}}),
        {3, 1}, 2, Vector2({1, 0}), "height along x");
    // a level set made a distance to first order: 5 (r^2 - 1)
    expect<2>(*make<2>({{"Kind", "distance"},
                        {"Expression", "5*(x^2 + y^2 - 1)"},
                        {"Gradient", "10*x; 10*y"}}),
              {1.2, 1.6}, 0.75, Vector2({0.6, 0.8}), "level set");
    expect<2>(*make<2>({{"Kind", "distance"},
                        {"Expression", "sqrt(x^2 + y^2) - 1"},
                        {"Hollow", "true"}}),
              {1.2, 1.6}, -1, Vector2({-0.6, -0.8}), "distance", 1e-9);

    // not finite at a point: named, through the core and back
    std::vector<double> distances;
    Expect::input_error(
        [&]() {
          die->distance({Point<3>(), Point<3>(2, 0, 5)}, distances);
        },
        "Obstacle 2/Expression", {"(2, 0, 0)"});
    // and the next call is as if nothing had happened
    expect<3>(*die, {0, 0, 0.25}, 0.25, Vector3({0, 0, -1}), "after an error");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    try
    {
      die->distance({Point<3>(0, 0, nan)}, distances);
      Expect::that(false, "a point that is not finite is refused");
    }
    catch (const dealii::ExceptionBase &error)
    {
      Expect::that(std::string(error.what()).find("point 0")
                       != std::string::npos,
                   "the point is named");
    }
  }

  void motion()
  {
    const auto falling = make<3>({{"Kind", "sphere"},
                                  {"Centre", "0, 0, 2"},
                                  {"Motion", "0, 0, -0.5*t"}});
    expect<3>(*falling, Point<3>(), 1, Vector3({0, 0, -1}), "before it falls");
    falling->set_time(1);
    expect<3>(*falling, Point<3>(), 0.5, Vector3({0, 0, -1}), "fallen");
    falling->set_time(0);
    expect<3>(*falling, Point<3>(), 1, Vector3({0, 0, -1}), "and back");

    // a quarter turn about (1, 0), then up by 1: (3, 0) goes to (1, 3)
    const auto turning = make<2>({{"Kind", "sphere"},
                                  {"Centre", "3, 0"},
                                  {"Motion", "0; t"},
                                  {"Rotation angle", "90*t"},
                                  {"Rotation centre", "1, 0"}});
    turning->set_time(1);
    expect<2>(*turning, {1, 5}, 1, Vector2({0, 1}), "turned in the plane");
    // about the x axis through (0, 1, 0): (0, 3, 0) goes to (0, 1, 2)
    const auto rolling = make<3>({{"Kind", "sphere"},
                                  {"Move", "0, 3, 0"},
                                  {"Rotation angle", "90*t"},
                                  {"Rotation centre", "0, 1, 0"},
                                  {"Rotation axis", "7, 0, 0"}});
    rolling->set_time(1);
    expect<3>(*rolling, {0, 1, 4}, 1, Vector3({0, 0, 1}), "turned in space");
    // Rotate before Motion, and the formula's own time
    const auto rising =
        make<2>({{"Kind", "height"}, {"Expression", "t"}, {"Rotate", "90"}});
    rising->set_time(2);
    expect<2>(*rising, {-5, 7}, 3, Vector2({-1, 0}), "height turned");
  }

  /** A tetrahedron with the corners 0 and three unit vectors. */
  void write_tetrahedron(const std::string &name, const bool closed)
  {
    const int corners[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const int x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::ofstream out(folder / name);
    out << "solid\n";
    for (int f = 0; f < (closed ? 4 : 3); ++f)
    {
      out << "facet normal 0 0 0\nouter loop\n";
      for (const int c : corners[f])
        out << "vertex " << x[c][0] << ' ' << x[c][1] << ' ' << x[c][2] << '\n';
      out << "endloop\nendfacet\n";
    }
    out << "endsolid\n";
  }

  void surfaces()
  {
    write_tetrahedron("solid.stl", true);
    write_tetrahedron("leaking.stl", false);
    const double third = 1 / std::sqrt(3.);
    const auto solid = make<3>({{"Kind", "surface"},
                                {"File", "solid.stl"},
                                {"Scale", "2"},
                                {"Move", "0, 0, 1"},
                                {"Motion", "0; 0; t"}});
    // the oblique face x + y + z = 2, moved
    expect<3>(*solid, {1, 1, 2}, third, Vector3({third, third, third}),
              "oblique face");
    expect<3>(*solid, {-3, 0.5, -3}, 5, Vector3({-0.6, 0, -0.8}), "edge");
    expect<3>(*solid, {0.25, 0.5, 1.5}, -0.25, Vector3({-1, 0, 0}), "inside");
    solid->set_time(1);
    expect<3>(*solid, {1, 1, 3}, third, Vector3({third, third, third}),
              "moved");
    Expect::input_error(
        []() {
          make<3>({{"Kind", "surface"}, {"File", "leaking.stl"}});
        },
        "Obstacle 2/File", {"leaking.stl", "not closed", "Open surface"});
    expect<3>(*make<3>({{"Kind", "surface"},
                        {"File", "leaking.stl"},
                        {"Open surface", "true"}}),
              {0.2, 0.2, -1}, 1, Vector3({0, 0, -1}), "open surface");
    const auto near =
        make<3>({{"Kind", "surface"}, {"File", "solid.stl"}, {"Limit", "0.5"}});
    std::vector<double> distances;
    near->distance({Point<3>(0.2, 0.2, -0.25), Point<3>(9, 9, 9)}, distances);
    Expect::near(distances[0], 0.25, 1e-14, "within the limit");
    Expect::near(distances[1], 0.5, 0, "beyond it");
    Expect::near(double(near->view().n_beyond), 1, 0, "points beyond");

    // the boundary of a mesh: circle of 64 chords, to their height
    const auto disc = make<2>({{"Kind", "surface"},
                               {"Generator", "hyper_ball"},
                               {"Arguments", "1, 0 : 2 : false"},
                               {"Refinements", "4"}});
    expect<2>(*disc, {4, 0}, 1, Vector2({1, 0}), "disc",
              2 * (1 - std::cos(pi / 64)));
    const auto ball = make<3>({{"Kind", "surface"},
                               {"Generator", "hyper_ball"},
                               {"Arguments", "0, 0, 0 : 1 : false"},
                               {"Refinements", "3"},
                               {"Hollow", "true"}});
    std::vector<Tensor<1, 3>> gradients;
    ball->distance({Point<3>(0.3, 0.4, 0)}, distances, &gradients);
    Expect::near(distances[0], 0.5, 0.02, "ball");
  }

  void refusals()
  {
    const auto refuse2 = [](const Settings &settings, const std::string &name,
                            const std::vector<std::string> &words)
    {
      Expect::input_error([&]() { make<2>(settings); }, "Obstacle 2/" + name,
                          words);
    };
    const auto refuse3 = [](const Settings &settings, const std::string &name,
                            const std::vector<std::string> &words)
    {
      Expect::input_error([&]() { make<3>(settings); }, "Obstacle 2/" + name,
                          words);
    };
    refuse2({{"Kind", "sphere"}, {"Radius", "0"}}, "Radius", {"'0'"});
    refuse2({{"Kind", "sphere"}, {"Radius", "nan"}}, "Radius", {"finite"});
    refuse2({{"Kind", "sphere"}, {"Radius", ""}}, "Radius", {"positive"});
    refuse2({{"Kind", "cylinder"}}, "Kind", {"3 dimensions"});
    refuse2({{"Kind", "box"}, {"Size", "1, 0"}}, "Size", {"positive"});
    refuse3({{"Kind", "box"}, {"Size", "1, 2"}}, "Size", {"3"});
    refuse3({{"Kind", "cone"}, {"Angle", "90"}}, "Angle", {"0 and 90"});
    refuse3({{"Kind", "cone"}, {"Length", "-1"}}, "Length", {"'-1'"});
    refuse3({{"Normal", "0, 0, 0"}}, "Normal", {"zero"});
    refuse3({{"Normal", "0, 1"}}, "Normal", {"3 numbers"});
    refuse3({{"Radius", "2"}}, "Radius", {"'plane'", "sphere, cylinder"});
    refuse3({{"File", "a.stl"}}, "File", {"surface"});
    refuse3({{"Gap along", "normal"}}, "Gap along", {"height"});
    refuse3({{"Kind", "height"}}, "Expression", {"formula"});
    refuse3({{"Kind", "height"}, {"Expression", "x +"}}, "Expression", {"x +"});
    refuse3({{"Kind", "height"}, {"Expression", "x"}, {"Axis", "1, 0, 1"}},
            "Axis", {"coordinate axis"});
    refuse3({{"Kind", "distance"}, {"Expression", "x"}, {"Gradient", "1"}},
            "Gradient", {"3 formulas"});
    refuse3({{"Motion", "t"}}, "Motion", {"3 formulas"});
    refuse3({{"Motion", "x; 0; 0"}}, "Motion", {"depends on x"});
    refuse3({{"Motion", "0; 0; 1/t"}}, "Motion", {"infinite"});
    refuse3({{"Rotation axis", "0 0 0"}}, "Rotation axis", {"zero"});
    refuse3({{"Rotate", "1"}}, "Rotate", {"three angles"});
    refuse3({{"Kind", "surface"}, {"File", "none.stl"}}, "File", {"none.stl"});
    refuse2({{"Kind", "surface"}, {"File", "solid.stl"}}, "File",
            {"3 dimensions"});
    refuse3({{"Kind", "surface"}, {"Limit", "-1"}}, "Limit", {"'-1'"});
  }

  /** What the program asks of a host beside a scene file. */
  void hosts()
  {
    abut_obstacle_shape shape = abut_obstacle_shape_defaults();
    shape.dimension = 2;
    const auto throws =
        [](const std::function<void()> &action, const std::string &word)
    {
      try
      {
        action();
      }
      catch (const dealii::ExceptionBase &error)
      {
        Expect::that(std::string(error.what()).find(word) != std::string::npos,
                     word);
        return;
      }
      Expect::that(false, "an exception that names " + word);
    };
    throws([&]() { RigidObstacle<3> wrong(shape); }, "dimension");
    throws([&]() { RigidObstacle<2> wrong(shape); }, "axis");
    shape.axis[1] = 1;
    RigidObstacle<2> plane(shape);
    RigidPose<2> mirror;
    mirror.rotation[0][0] = 1;
    mirror.rotation[1][1] = -1;
    throws([&]() { plane.set_pose(mirror); }, "rotation");
    // a function of deal.II's: distance from a point, less a radius
    RigidObstacle<2> ball(
        std::make_shared<dealii::Functions::SignedDistance::Sphere<2>>(
            Point<2>(1, 0), 0.5));
    expect<2>(ball, {1, 2}, 1.5, Vector2({0, 1}), "deal.II's sphere");
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(argc, argv,
                    [](const std::filesystem::path &given)
                    {
                      folder = given;
                      shapes();
                      formulas();
                      motion();
                      surfaces();
                      refusals();
                      hosts();
                    });
}

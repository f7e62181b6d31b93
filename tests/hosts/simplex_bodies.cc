// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies of triangles and tetrahedra beside formulas and another program: tied
// beams, a patch at large strain, a slot that closes on itself, and rigid
// obstacles.
#include "elastic_bodies.h"
#include "expect.h"
#include "tied_beams.h"

#include <abut/dealii/rigid_obstacle.h>

#include <iostream>

using namespace abut;

namespace
{
  using dealii::Point;
  using dealii::Tensor;
  using hosts::CellList;
  using hosts::ElasticBodies;
  using hosts::expect;
  using hosts::Solid;

  void expect_near(const double value, const double exact, const double bound,
                   const std::string &what)
  {
    std::cout << what << ": " << value << ", off by " << value - exact
              << std::endl;
    expect(std::abs(value - exact) <= bound, what);
  }

  Point<3> at(const double x, const double y, const double z)
  {
    return {x, y, z};
  }

  /** All displacements of another program, which has nodes on segments. */
  void check_tied_beams(const hosts::TiedBeams &beams, const std::string &name)
  {
    CellList<3> list;
    std::vector<Tensor<1, 3>> expected;
    for (const auto &node : beams.nodes)
    {
      list.vertices.push_back(at(node.x[0], node.x[1], node.x[2]));
      expected.push_back(at(node.u[0], node.u[1], node.u[2]));
    }
    for (const auto &cell : beams.cells)
      list.add_cell(cell);
    enum : dealii::types::boundary_id
    {
      none,
      clamp,
      pressed,
      left,
      right
    };
    ElasticBodies<3> host(
        list, Solid(),
        [](const Point<3> &x) {
          return x[0] < 1e-9 ? clamp : x[1] > 1 - 1e-9 ? pressed : none;
        });
    for (const auto &cell : host.dof_handler.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && std::abs(face->center()[0] - 2.) < 1e-9)
          face->set_boundary_id(cell->center()[0] < 2. ? left : right);
    for (unsigned int c = 0; c < 3; ++c)
      host.fix(clamp, c);
    ContactAssembler<3> contact(MPI_COMM_SELF);
    MethodParameters method;
    method.discretisation = ABUT_DISCRETISATION_NODE_TO_SEGMENT;
    ContactPair<3> pair;
    pair.name = "tie";
    pair.secondary = {right};
    pair.primary = {left};
    pair.tied = true;
    host.prepare(contact, method, pair);
    // The load follows the faces: each round is some 20 times nearer.
    la::Vector u = host.zero();
    for (unsigned int round = 0; round < 12; ++round)
    {
      host.press(pressed, u);
      expect(host.solve(contact, u).converged(), name + ": no answer");
    }
    double error = 0.;
    for (const auto &cell : host.dof_handler.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int c = 0; c < 3; ++c)
          error =
              std::max(error, std::abs(u(cell->vertex_dof_index(v, c))
                                       - expected[cell->vertex_index(v)][c]));
    expect_near(error, 0., 1e-9, name + ": displacements");
  }

  /** Boxes (0, 1)^dim, the second on the first along the last axis. */
  template <int dim>
  CellList<dim> two_boxes(const unsigned int n_lower,
                          const unsigned int n_upper)
  {
    CellList<dim> list;
    Point<dim> low, high;
    for (unsigned int d = 0; d < dim; ++d)
      high[d] = 1.;
    list.add_box(low, high, std::vector<unsigned int>(dim, n_lower));
    low[dim - 1] = 1.;
    high[dim - 1] = 2.;
    list.add_box(low, high, std::vector<unsigned int>(dim, n_upper));
    return list;
  }

  /** Boundary ids of boxes; planes through the origin keep their normal
   * displacement. */
  enum Side : dealii::types::boundary_id
  {
    free_side,
    origin_x,
    origin_y,
    origin_z,
    top,
    interface
  };

  /** Two blocks of one material pressed flat to .95 with free sides:
   * S = E e, P = F S with e = (F^2 - 1) / 2, E / (1 - nu^2) in the plane. */
  template <int dim> void check_large_strain(const unsigned int degree)
  {
    const std::string name = "large strain, " + std::to_string(dim)
                             + "D, degree " + std::to_string(degree);
    Solid solid;
    solid.degree = degree;
    solid.large_strain = true;
    ElasticBodies<dim> host(
        two_boxes<dim>(dim == 2 ? 3 : 2, dim == 2 ? 4 : 3 - (degree - 1) * 2),
        solid,
        [](const Point<dim> &x) -> dealii::types::boundary_id
        {
          if (std::abs(x[dim - 1] - 2.) < 1e-9)
            return top;
          if (std::abs(x[dim - 1] - 1.) < 1e-9)
            return interface;
          for (unsigned int d = 0; d < dim; ++d)
            if (std::abs(x[d]) < 1e-9)
              return origin_x + d;
          return free_side;
        });
    for (const auto &cell : host.dof_handler.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->boundary_id() == interface && cell->center()[dim - 1] > 1.)
          face->set_boundary_id(interface + 1);
    for (unsigned int d = 0; d < dim; ++d)
      host.fix(origin_x + d, d);
    host.fix(top, dim - 1, -0.1);
    ContactAssembler<dim> contact(MPI_COMM_SELF);
    MethodParameters method;
    method.kinematics = ABUT_KINEMATICS_CURRENT;
    ContactPair<dim> pair;
    pair.name = "interface";
    pair.secondary = {interface + 1};
    pair.primary = {interface};
    host.prepare(contact, method, pair);
    la::Vector u = host.zero();
    const NewtonResult result = host.solve(contact, u);
    expect(result.converged(), name + ": " + result.explanation.text);
    const double F = 0.95, e = 0.5 * (F * F - 1.);
    const double exact = -F * e * (dim == 3 ? 1000. : 1000. / (1. - 0.3 * 0.3));
    expect_near(contact.results().pairs()[0].secondary_force.norm(), exact,
                1e-8 * exact, name + ": force");
  }

  struct SlotAnswer
  {
    la::Vector u;
    double force;
    unsigned int n_active;
  };

  /** A block with a slot from the right, whose top is pressed down. The slot
   * is one surface (@p secondary empty), or two. */
  template <int dim>
  SlotAnswer close_slot(const unsigned int degree, const int secondary)
  {
    constexpr dealii::types::boundary_id lower = 7, upper = 8;
    constexpr double height = 0.2;
    Point<dim> low, high;
    std::vector<unsigned int> n(dim, 1);
    high[0] = 2.;
    high[1] = 0.5;
    n[0] = dim == 2 ? 8 : 4;
    high[dim - 1] = 1.;
    n[dim - 1] = 5;
    const auto is_in_slot = [&](const Point<dim> &x)
    { return x[0] > 0.5 && std::abs(x[dim - 1] - 0.5) < 0.5 * height; };
    CellList<dim> list;
    list.add_box(low, high, n, is_in_slot);
    Solid solid;
    solid.degree = degree;
    ElasticBodies<dim> host(
        list, solid,
        [&](const Point<dim> &x) -> dealii::types::boundary_id
        {
          const double z = x[dim - 1];
          if (z < 1e-9)
            return origin_z;
          if (z > 1. - 1e-9)
            return top;
          if (x[0] < 0.5 + 1e-9 || x[0] > 2. - 1e-9)
            return free_side;
          if (std::abs(z - 0.4) < 1e-9)
            return lower;
          if (std::abs(z - 0.6) < 1e-9)
            return secondary < 0 ? lower : upper;
          return free_side;
        });
    for (unsigned int d = 0; d < dim; ++d)
      host.fix(origin_z, d);
    host.fix(top, dim - 1, -0.25);
    ContactAssembler<dim> contact(MPI_COMM_SELF);
    ContactPair<dim> pair;
    pair.name = "slot";
    pair.secondary = {secondary == 1 ? upper : lower};
    pair.primary = {secondary == 0 ? upper : lower};
    pair.reach = 0.5;
    host.prepare(contact, MethodParameters(), pair);
    SlotAnswer answer;
    answer.u = host.zero();
    expect(host.solve(contact, answer.u).converged(), "slot: no answer");
    const PairResult<dim> result = contact.results().pairs()[0];
    answer.force = result.secondary_force.norm();
    answer.n_active = result.n_active;
    return answer;
  }

  template <int dim> void check_self_contact(const unsigned int degree)
  {
    const std::string name =
        "slot, " + std::to_string(dim) + "D, degree " + std::to_string(degree);
    const SlotAnswer one = close_slot<dim>(degree, -1);
    expect(one.n_active > 1, name + ": does not touch");
    double nearest = 1.;
    for (const int secondary : {0, 1})
    {
      SlotAnswer two = close_slot<dim>(degree, secondary);
      two.u -= one.u;
      nearest =
          std::min(nearest, std::max(two.u.linfty_norm() / one.u.linfty_norm(),
                                     std::abs(two.force / one.force - 1.)));
    }
    expect_near(nearest, 0., 1e-10, name + ": difference of one id and two");
  }

  template <int dim>
  std::unique_ptr<ElasticBodies<dim>> make_block(const Solid &solid,
                                                 const unsigned int n)
  {
    CellList<dim> list;
    Point<dim> high;
    for (unsigned int d = 0; d < dim; ++d)
      high[d] = 1.;
    list.add_box(Point<dim>(), high, std::vector<unsigned int>(dim, n));
    auto block = std::make_unique<ElasticBodies<dim>>(
        list, solid,
        [](const Point<dim> &x) -> dealii::types::boundary_id
        {
          if (x[dim - 1] > 1. - 1e-9)
            return interface;
          for (unsigned int d = 0; d < dim; ++d)
            if (std::abs(x[d]) < 1e-9)
              return origin_x + d;
          return free_side;
        });
    for (unsigned int d = 0; d < dim; ++d)
      block->fix(origin_x + d, d);
    return block;
  }

  template <int dim> ContactPair<dim> against(const abut_obstacle_shape &shape)
  {
    ContactPair<dim> pair;
    pair.name = "obstacle";
    pair.secondary = {interface};
    pair.obstacle = std::make_shared<RigidObstacle<dim>>(shape);
    pair.reach = 0.5;
    return pair;
  }

  /** A rigid plate that presses a block to .95: E times .05. */
  void check_plate(const unsigned int degree)
  {
    Solid solid;
    solid.degree = degree;
    const auto host = make_block<3>(solid, 2);
    ContactAssembler<3> contact(MPI_COMM_SELF);
    host->prepare(contact, MethodParameters(),
                  against<3>(plane<3>(at(0., 0., 0.95), at(0., 0., -1.))));
    la::Vector u = host->zero();
    expect(host->solve(contact, u).converged(), "plate: no answer");
    expect_near(contact.results().pairs()[0].secondary_force.norm(), 50., 1e-9,
                "plate, degree " + std::to_string(degree));
  }

  /** How deep a ball is in facets between nodes is what a fine grid of points
   * in them shows. */
  void check_ball(const unsigned int degree)
  {
    Solid solid;
    solid.degree = degree;
    const auto host = make_block<3>(solid, 4);
    abut_obstacle_shape ball = abut_obstacle_shape_defaults();
    ball.dimension = 3;
    ball.kind = ABUT_OBSTACLE_SPHERE;
    ball.point[2] = 1.99;
    ContactAssembler<3> contact(MPI_COMM_SELF);
    host->prepare(contact, MethodParameters(), against<3>(ball));
    la::Vector u = host->zero();
    expect(host->solve(contact, u).converged(), "ball: no answer");
    (void)contact.checks().examine(u);
    constexpr unsigned int n = 20;
    std::vector<Point<2>> points;
    for (unsigned int i = 0; i <= n; ++i)
      for (unsigned int j = 0; i + j <= n; ++j)
        points.emplace_back(double(i) / n, double(j) / n);
    dealii::FEFaceValues<3> values(
        host->mapping, host->fe, dealii::Quadrature<2>(points),
        dealii::update_values | dealii::update_quadrature_points);
    std::vector<Tensor<1, 3>> motion(points.size());
    double depth = 0.;
    for (const auto &cell : host->dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary()
            && cell->face(f)->boundary_id() == interface)
        {
          values.reinit(cell, f);
          values[dealii::FEValuesExtractors::Vector(0)].get_function_values(
              u, motion);
          for (std::size_t q = 0; q < points.size(); ++q)
            depth =
                std::max(depth, 1.
                                    - at(0., 0., 1.99)
                                          .distance(values.quadrature_point(q)
                                                    + motion[q]));
        }
    expect(depth > 0., "a facet that the ball is in");
    const double found = contact.results().pairs()[0].between_rows;
    expect_near(found, depth, 0.1 * depth,
                "ball in facets of degree " + std::to_string(degree));
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout.precision(12);
  check_tied_beams(hosts::make_tied_beams(), "tied beams");
  for (const unsigned int degree : {1, 2})
  {
    check_large_strain<2>(degree);
    check_large_strain<3>(degree);
    check_self_contact<2>(degree);
    check_self_contact<3>(degree);
    check_plate(degree);
    check_ball(degree);
  }
  return hosts::good ? 0 : 1;
}

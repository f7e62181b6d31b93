// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Elastic bodies: Hooke's law, error norms, estimator, contact traction; forces
// at supports, those of membranes too.

#include "app/adapt/elastic_estimator.h"
#include "app/physics/contact_traction.h"
#include "app/physics/elasticity.h"
#include "app/physics/error_norms.h"
#include "app/physics/hooke.h"
#include "app/physics/membrane.h"

#include "expect.h"
#include "problem.h"
#include "run_checks.h"
#include "stiffening.h"

#include <abut/dealii/distribute.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/numerics/vector_tools.h>

#include <sstream>

using namespace abut;
using namespace abut::app;
using dealii::Point;
using dealii::Tensor;

namespace
{
  constexpr PlaneModel plane_models[] = {PlaneModel::strain, PlaneModel::stress,
                                         PlaneModel::axisymmetric};

  template <int dim>
  Hooke<dim> material(const PlaneModel plane = PlaneModel::strain)
  {
    return {7., 0.3, plane};
  }

  /** The same for all cells. */
  template <int dim>
  Materials<dim> everywhere(const PlaneModel plane = PlaneModel::strain)
  {
    return {{0, std::make_shared<Hooke<dim>>(material<dim>(plane))}};
  }

  std::string text(const double value)
  {
    std::ostringstream out;
    out.precision(17);
    out << value;
    return out.str();
  }

  /** Uniaxial states and thick-walled tubes, from the textbook. */
  void hooke()
  {
    const double e = 7;
    const double nu = 0.3;
    const Point<2> at(2., 0.5);
    Tensor<2, 2> du;
    // stress 1 along y, none along x; plane stress: strains 1/E and -nu/E
    du[1][1] = 1. / e;
    du[0][0] = -nu / e;
    Stress<2> s = material<2>(PlaneModel::stress).stress(du, {}, at);
    Expect::near(s.tensor[1][1], 1, 1e-15, "plane stress");
    Expect::near(s.tensor[0][0], 0, 1e-15, "plane stress, across");
    Expect::near(s.von_mises(), 1, 1e-15, "von Mises of uniaxial stress");
    // plane strain: E/(1-nu^2), nu/(1-nu)
    du[1][1] = (1 - nu * nu) / e;
    du[0][0] = -nu * (1 + nu) / e;
    s = material<2>().stress(du, {}, at);
    Expect::near(s.tensor[1][1], 1, 1e-15, "plane strain");
    Expect::near(s.tensor[0][0], 0, 1e-15, "plane strain, across");
    Expect::near(s.out_of_plane, nu, 1e-15, "plane strain, out of plane");
    Expect::near(s.von_mises(), std::sqrt(1 - nu + nu * nu), 1e-15,
                 "von Mises of plane strain");
    Tensor<2, 3> shear;
    shear[0][1] = 0.02;
    const Stress<3> t = material<3>().stress(shear, {}, Point<3>());
    Expect::near(t.tensor[1][0], 0.02 * material<3>().mu(), 1e-15, "shear");
    Expect::near(t.von_mises(), std::sqrt(3.) * t.tensor[1][0], 1e-15,
                 "von Mises of shear");
    // tube: u = a r + b/r has sigma_rr = 2 (lambda + mu) a - 2 mu b/r^2
    const double a = 0.01;
    const double b = 0.03;
    const double r = at[0];
    const Tensor<1, 2> u({a * r + b / r, 0.});
    Tensor<2, 2> ring;
    ring[0][0] = a - b / (r * r);
    Tensor<3, 2> second;
    second[0][0][0] = 2 * b / (r * r * r);
    const Hooke<2> tube = material<2>(PlaneModel::axisymmetric);
    const double lambda = tube.lambda();
    s = tube.stress(ring, u, at);
    Expect::near(s.tensor[0][0],
                 2 * (lambda + tube.mu()) * a - 2 * tube.mu() * b / (r * r),
                 1e-15, "radial stress");
    Expect::near(s.out_of_plane,
                 2 * (lambda + tube.mu()) * a + 2 * tube.mu() * b / (r * r),
                 1e-15, "hoop stress");
    Expect::near(tube.stress_divergence(second, ring, u, at).norm(), 0, 1e-15,
                 "equilibrium of the tube");
    Expect::near(2 * tube.energy(ring, u, at),
                 s.tensor[0][0] * ring[0][0] + s.out_of_plane * u[0] / r, 1e-15,
                 "energy of the tube");
    Expect::near(tube.measure(at), 4 * dealii::numbers::PI, 1e-14, "ring");
  }

  /** The unit square without supports, of one material. */
  class FreeSquare
  {
  public:
    explicit FreeSquare(const std::shared_ptr<const Material<2>> &material)
        : mesh(MPI_COMM_WORLD), elasticity(mesh, 2)
    {
      dealii::GridGenerator::hyper_cube(mesh);
      mesh.refine_global(2);
      data.materials = {{0, material}};
      elasticity.setup(data);
      elasticity.assemble_stiffness();
      elasticity.assemble_load(data);
    }

    la::Vector interpolate(const std::string &text) const
    {
      la::Vector result = elasticity.vector();
      dealii::VectorTools::interpolate(elasticity.mapping,
                                       elasticity.dof_handler,
                                       Expression<2>(text, "u", 2), result);
      return result;
    }

    dealii::parallel::distributed::Triangulation<2> mesh;
    ElasticData<2> data;
    Elasticity<2> elasticity;
  };

  /** Hooke's law, but the program is not told that it is linear. */
  class Hidden : public Hooke<2>
  {
  public:
    explicit Hidden(const PlaneModel plane) : Hooke<2>(material<2>(plane))
    {
    }

    bool is_linear() const override
    {
      return false;
    }
  };

  /** Forces by the stress, of which the matrix knows nothing. */
  void forces_of_stress()
  {
    for (const PlaneModel plane : plane_models)
    {
      FreeSquare known(std::make_shared<Hooke<2>>(material<2>(plane)));
      FreeSquare hidden(std::make_shared<Hidden>(plane));
      Expect::that(known.elasticity.is_linear()
                       && !hidden.elasticity.is_linear(),
                   "what is linear");
      const la::Vector u = known.interpolate("x^2*y; x - y^2");
      la::Vector by_matrix(u), by_stress(u);
      known.elasticity.residual(u, by_matrix);
      hidden.elasticity.residual(u, by_stress);
      Expect::near(hidden.elasticity.energy(u), known.elasticity.energy(u),
                   1e-12, "energy by points and by the matrix");
      const double size = by_matrix.linfty_norm();
      by_stress -= by_matrix;
      Expect::near(by_stress.linfty_norm(), 0, 1e-12 * size,
                   "forces by points and by the matrix");
    }
  }

  /** The unit square, with hanging nodes at its side x = 0. */
  void refine_at_the_side(dealii::parallel::distributed::Triangulation<2> &mesh)
  {
    dealii::GridGenerator::hyper_cube(mesh, 0., 1., true);
    mesh.refine_global(2);
    for (int step = 0; step < 2; ++step)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned()
            && cell->center().distance(Point<2>(0., 0.4)) < 0.3)
          cell->set_refine_flag();
      mesh.execute_coarsening_and_refinement();
    }
  }

  /** Forces by the matrix and by the cells at a support, against those by the
   * stress in all cells, whatever the support prescribes. */
  void forces_at_supports(const PlaneModel plane, const unsigned int degree)
  {
    const Expression<2> prescribed("0.2 + y; -y^2", "Support", 2);
    const auto forces =
        [&](const std::shared_ptr<const Material<2>> &law, const auto &take)
    {
      dealii::parallel::distributed::Triangulation<2> mesh(MPI_COMM_WORLD);
      refine_at_the_side(mesh);
      ElasticData<2> data;
      data.materials = {{0, law}};
      data.supports = {{0, {&prescribed, dealii::ComponentMask(2, true)}}};
      Elasticity<2> elasticity(mesh, degree);
      elasticity.setup(data);
      elasticity.assemble_stiffness();
      elasticity.assemble_load(data);
      la::Vector u = elasticity.vector();
      dealii::VectorTools::interpolate(
          elasticity.mapping, elasticity.dof_handler,
          Expression<2>("sin(5*y) + x^2*y; x - y^2 + 0.1", "u", 2), u);
      return take(elasticity, u);
    };
    const la::Vector by_stress = forces(
        std::make_shared<Hidden>(plane), [](const auto &problem, const auto &u)
        { return problem.nodal_forces(u).internal; });
    la::Vector by_matrix =
        forces(std::make_shared<Hooke<2>>(material<2>(plane)),
               [](const auto &problem, const auto &u)
               { return problem.stiffness_times(u); });
    by_matrix -= by_stress;
    Expect::near(by_matrix.linfty_norm(), 0, 1e-13 * by_stress.linfty_norm(),
                 "forces at supports, degree " + std::to_string(degree));
  }

  /** Virtual works of u = xy + y^2 on v = x^2 + y + 1, neither of which is 0
   * where u is prescribed. */
  void works_at_supports()
  {
    dealii::parallel::distributed::Triangulation<2> mesh(MPI_COMM_WORLD);
    refine_at_the_side(mesh);
    const Expression<2> conductivity("3", "k"), load("1.5", "f"),
        prescribed("y^2", "u"), flux("2", "flux");
    MembraneData<2> data;
    data.conductivity = &conductivity;
    data.load = &load;
    data.constant_conductivity = data.constant_load = true;
    data.dirichlet = {{0, &prescribed}};
    data.neumann = {{1, &flux}};
    Membrane<2> membrane(mesh, 2);
    membrane.setup(data);
    membrane.assemble(data);
    const auto interpolate = [&](const std::string &text)
    {
      la::Vector result = membrane.vector();
      dealii::VectorTools::interpolate(membrane.mapping, membrane.dof_handler,
                                       Expression<2>(text, "u"), result);
      membrane.hanging.set_zero(result);
      return result;
    };
    const NodalForces forces = membrane.nodal_forces(interpolate("x*y + y^2"));
    const la::Vector v = interpolate("x^2 + y + 1");
    Expect::near(forces.internal * v, 3 * 2., 1e-12, "work of internal forces");
    Expect::near(forces.external * v, 1.5 * 11. / 6. + 2 * 2.5, 1e-12,
                 "work of loads");
  }

  /** A nonlinear material: uniform strain has the stress of the formula, the
   * tangent is the derivative of the forces, and those of the energy. */
  void nonlinear_material()
  {
    const double c = 40., e = 0.1;
    FreeSquare square(std::make_shared<Stiffening<2>>(7., 0.3, c));
    Elasticity<2> &elasticity = square.elasticity;
    const la::Vector u = square.interpolate("0.1*x; 0");
    la::Vector forces(u);
    elasticity.residual(u, forces);
    // Forces on x = 1 by virtual work: with v = (x, 0) it is the stress.
    const Hooke<2> hooke = material<2>();
    const double stress = (hooke.lambda() + 2 * hooke.mu()) * e + c * e * e * e;
    Expect::near(forces * square.interpolate("x; 0"), stress, 1e-12,
                 "stress of uniaxial strain");
    Expect::near(elasticity.energy(u),
                 0.5 * (hooke.lambda() + 2 * hooke.mu()) * e * e
                     + 0.25 * c * e * e * e * e,
                 1e-12, "energy of uniaxial strain");
    const la::Vector at = square.interpolate("0.1*x + 0.2*x*y; 0.1*y*y");
    const la::Vector way = square.interpolate("x*y - y^2; x^2 + 0.5*y");
    constexpr double h = 1e-5;
    la::Vector ahead(at), behind(at), there(at), back(at), change(at);
    ahead.add(h, way);
    behind.add(-h, way);
    elasticity.residual(ahead, there);
    elasticity.residual(behind, back);
    elasticity.residual(at, forces);
    Expect::near((elasticity.energy(ahead) - elasticity.energy(behind))
                     / (2 * h),
                 forces * way, 1e-8, "forces from the energy");
    there -= back;
    there *= 1. / (2 * h);
    elasticity.tangent(at).vmult(change, way);
    const double size = change.linfty_norm();
    change -= there;
    Expect::near(change.linfty_norm(), 0, 1e-8 * size,
                 "tangent from the forces");
  }

  /** Errors of the interpolant of (x^2, 0): see the scalar test. On rings each
   * cell counts 2 pi times its middle radius, whose mean is 1/2. */
  void norms()
  {
    Problem<2> problem(1, 2);
    unit_cube(problem, 3);
    const la::Vector u = problem.interpolate("x^2; 0");
    const ExactSolution<2> exact("x^2; 0", "E/S", "2*x; 0; 0; 0", "E/G", 2);
    const double h = 1. / 8;
    const double pi = dealii::numbers::PI;
    for (const PlaneModel plane : plane_models)
    {
      const Materials<2> materials = everywhere<2>(plane);
      const bool rings = plane == PlaneModel::axisymmetric;
      const double factor = std::sqrt(rings ? pi : 1.);
      const ErrorNorms errors = error_norms(
          problem.mapping, problem.dof_handler, u, exact, &materials);
      Expect::near(errors.l2, factor * h * h / std::sqrt(30.), 1e-14, "L2");
      Expect::near(errors.h1_seminorm, factor * h / std::sqrt(3.), 1e-14, "H1");
      Expect::near(errors.largest_node, 0, 1e-15, "nodes");
      const double modulus =
          material<2>(plane).lambda() + 2 * material<2>(plane).mu();
      if (!rings)
        Expect::near(*errors.energy, std::sqrt(modulus / 3) * h, 1e-14,
                     "energy");
    }
    const ErrorNorms turned =
        error_norms(problem.mapping, problem.dof_handler,
                    problem.interpolate("0.5*y; -0.5*x"),
                    ExactSolution<2>("0; 0", "E/S", "", "E/G", 2));
    Expect::near(turned.h1_seminorm, std::sqrt(0.5), 1e-9, "turned");
    Expect::near(turned.largest_node, 0.5, 1e-15, "turned, node");
    Expect::that(!turned.energy, "no energy without materials");
  }

  template <int dim> double estimate(const ElasticEstimatorInput<dim> &input)
  {
    dealii::Vector<float> squared;
    const double total = estimate_elastic_error(input, squared);
    return expect_sum(input.dof_handler, squared, total);
  }

  template <int dim>
  std::map<dealii::types::boundary_id, dealii::ComponentMask>
  supported(const std::set<dealii::types::boundary_id> &ids)
  {
    std::map<dealii::types::boundary_id, dealii::ComponentMask> result;
    for (const auto id : ids)
      result[id] = dealii::ComponentMask(dim, true);
    return result;
  }

  /** u = (x^2, x y), or (x, 2 x + y): no residual at all, with traction on
   * x = 1 and pressure on y = 1; a missing traction is seen. */
  void estimator_in_the_plane(const PlaneModel plane, const unsigned int degree)
  {
    const bool quadratic = degree == 2;
    const bool rings = plane == PlaneModel::axisymmetric;
    Problem<2> problem(degree, 2);
    unit_cube(problem, 2);
    refine_corner(problem);
    const Materials<2> materials = everywhere<2>(plane);
    const double l = material<2>(plane).lambda();
    const double m = material<2>(plane).mu();
    const la::Vector u =
        problem.interpolate(quadratic ? "x^2; x*y" : "x; 2*x + y");
    // div sigma by hand; rings add the hoop strain x (or 1) to the trace and
    // (sigma_rr - sigma_hoop)/r, sigma_rz/r to the balance
    const std::string f =
        quadratic ? text(rings ? -(4 * l + 7 * m) : -(3 * l + 5 * m)) + "; "
                        + (rings ? text(-m) + "*y/x" : "0")
                  : "0; " + (rings ? text(-2 * m) + "/x" : "0");
    // sigma n on x = 1: (lambda tr + 2 mu e_xx, 2 mu e_xy)
    const double hoop = rings ? 1 : 0;
    const std::string side =
        quadratic ? text(l * (3 + hoop) + 4 * m) + "; " + text(m) + "*y"
                  : text(l * (2 + hoop) + 2 * m) + "; " + text(2 * m);
    // on y = 1: shear as traction, the rest as pressure
    const std::string top = quadratic ? text(m) + "; 0" : text(2 * m) + "; 0";
    const std::string pressure = quadratic
                                     ? text(-l * (3 + hoop) - 2 * m) + "*x"
                                     : text(-l * (2 + hoop) - 2 * m);
    const Expression<2> force(f, "f", 2);
    const Expression<2> on_side(side, "t", 2);
    const Expression<2> on_top(top, "t", 2);
    const Expression<2> push(pressure, "p");
    ElasticEstimatorInput<2> input{problem.mapping, problem.dof_handler, u,
                                   materials};
    input.body_force = {{0, &force}};
    input.traction = {{1, &on_side}, {3, &on_top}};
    input.pressure_load = {{3, &push}};
    input.supports = supported<2>({0, 2});
    Expect::near(estimate(input), 0, 1e-12, "estimate of an exact solution");
    input.pressure_load = {};
    Expect::that(estimate(input) > 0.1, "a missing pressure is seen");
    input.supports[3] = dealii::ComponentMask(std::vector<bool>{false, true});
    Expect::near(estimate(input), 0, 1e-12, "support along y");
    input.traction.erase(3);
    Expect::that(estimate(input) > 0.1, "shear at a sliding support is seen");
  }

  /** u = (x^2, y z, z) and all sides but x = 0 loaded through one traction. */
  void estimator_in_space()
  {
    Problem<3> problem(2, 3);
    unit_cube(problem, 1);
    refine_corner(problem);
    const Materials<3> materials = everywhere<3>();
    const double l = material<3>().lambda();
    const double m = material<3>().mu();
    const la::Vector u = problem.interpolate("x^2; y*z; z");
    // trace 2x + z + 1; Laplacian (2, 0, 0)
    const Expression<3> force(
        text(-2 * (l + m) - 2 * m) + "; 0; " + text(-(l + m)), "f", 3);
    const std::string trace = text(l) + "*(2*x + z + 1)";
    const Expression<3> side(trace + "+" + text(4 * m) + "*x; 0; 0", "t", 3);
    const Expression<3> top(
        "0; " + text(m) + "*y; " + trace + "+" + text(2 * m), "t", 3);
    ElasticEstimatorInput<3> input{problem.mapping, problem.dof_handler, u,
                                   materials};
    input.body_force = {{0, &force}};
    input.traction = {{1, &side}, {5, &top}};
    input.supports = supported<3>({0, 2, 3, 4});
    Expect::near(estimate(input), 0, 1e-12, "estimate in space");
    input.body_force = {};
    Expect::that(estimate(input) > 0.1, "a missing force is seen");
  }

  /** Each term alone, in closed form. */
  void estimator_terms()
  {
    Problem<2> problem(1, 2);
    unit_cube(problem, 3);
    const double h = 1. / 8;
    const Materials<2> materials = everywhere<2>();
    const double m = material<2>().mu();
    const la::Vector nothing = problem.interpolate("0; 0");
    ElasticEstimatorInput<2> input{problem.mapping, problem.dof_handler,
                                   nothing, materials};
    // f: h^2 |f|^2 / E over the square
    const Expression<2> force("3; 4", "f", 2);
    input.body_force = {{0, &force}};
    Expect::near(estimate(input), 5 * h / std::sqrt(7.), 1e-13, "force");
    input.body_force = {};
    // jumps of sigma n = 2h (0, mu) over (n-1) n faces for u = (0, x^2)
    const la::Vector bent = problem.interpolate("0; x^2");
    ElasticEstimatorInput<2> jumps{problem.mapping, problem.dof_handler, bent,
                                   materials};
    jumps.supports = supported<2>(all_sides<2>());
    Expect::near(estimate(jumps), 2 * h * m * std::sqrt((1 - h) / 7), 1e-13,
                 "jumps");
    // contact on y = 0 with p = 2 and tangential part 3 that has no answer
    const la::Vector contact = problem.interpolate("3; 2");
    input.contact = {2};
    input.contact_traction = &contact;
    Expect::near(estimate(input), std::sqrt(13 * h / 7), 1e-13,
                 "contact traction");
    input.contact = {3};
    input.contact_traction = nullptr;
    // outward normal (0, -1): penetration 0.01, then pressure 2 at gap 0.03
    const la::Vector pressure = problem.interpolate("0; -2");
    const la::Vector into = problem.interpolate("-0.01; 1");
    const la::Vector open = problem.interpolate("0.03; 1");
    input.secondary = {2};
    input.pressure = &pressure;
    input.gap = &into;
    Expect::near(estimate(input), 0.01 * std::sqrt(7 / h), 1e-13,
                 "penetration");
    input.gap = &open;
    Expect::near(estimate(input), std::sqrt(0.06), 1e-13,
                 "pressure across a gap");
    input.secondary = {1};
    Expect::near(estimate(input), 0, 1e-13, "other sides");
  }

  /** At the end of a surface with constraints. A gap of 0.16 at x = 0 alone is
   * a parabola on the first facet [0, 1/4], with values down to -0.02. Where
   * all nodes have constraints this is a penetration: with s = 4 x
   *   E/h int g^2 = E 0.16^2 int_{1/2}^1 (1 - s)^2 (1 - 2s)^2 ds,
   * which Gauss' rule of three points takes for (1 - sqrt(0.6))^2 / 24. Where
   * the nodes behind x = 0 have none it is nothing. */
  void estimator_at_the_end_of_contact()
  {
    Problem<2> problem(2, 2);
    unit_cube(problem, 2);
    const Materials<2> materials = everywhere<2>();
    const la::Vector nothing = problem.interpolate("0; 0");
    const la::Vector whole = problem.interpolate("0.16*(x < 0.1); 1");
    const la::Vector end = problem.interpolate("0.16*(x < 0.1); x < 0.1");
    ElasticEstimatorInput<2> input{problem.mapping, problem.dof_handler,
                                   nothing, materials};
    input.secondary = {2};
    input.pressure = &nothing;
    input.gap = &whole;
    Expect::near(estimate(input),
                 0.16 * (1 - std::sqrt(0.6)) * std::sqrt(7. / 24.), 1e-13,
                 "penetration between nodes");
    input.gap = &end;
    Expect::near(estimate(input), 0, 1e-13, "end of the constraints");
  }

  /** A load of 1 + x per area on y = 0 (and of 2 on z = 0 in space), given as
   * forces at nodes, comes back: also at supported and at hanging nodes. */
  template <int dim>
  void traction(const unsigned int degree, const PlaneModel plane)
  {
    Problem<dim> problem(degree, dim);
    unit_cube(problem, 2);
    refine_corner(problem);
    const Materials<dim> materials = everywhere<dim>(plane);
    const dealii::types::boundary_id id = 2 * (dim - 1);
    la::Vector open;
    open.reinit(problem.owned, problem.relevant, MPI_COMM_WORLD, true);
    const dealii::QGauss<dim - 1> quadrature(degree + 1);
    dealii::FEFaceValues<dim> points(problem.mapping, problem.fe, quadrature,
                                     dealii::update_values
                                         | dealii::update_quadrature_points
                                         | dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> dofs(
        problem.fe.n_dofs_per_cell());
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->is_locally_owned() && cell->face(f)->at_boundary()
            && cell->face(f)->boundary_id() == id)
        {
          points.reinit(cell, f);
          cell->get_dof_indices(dofs);
          dealii::Vector<double> local(dofs.size());
          for (unsigned int i = 0; i < dofs.size(); ++i)
            for (const unsigned int q : points.quadrature_point_indices())
              if (problem.fe.system_to_component_index(i).first == dim - 1)
                local[i] +=
                    2. * points.shape_value(i, q) * points.JxW(q)
                    * materials.at(0)->measure(points.quadrature_point(q));
          abut::versions::distribute_local_to_global(problem.constraints, local,
                                                     dofs, open);
        }
    open.compress(dealii::VectorOperation::add);
    la::Vector force(problem.owned, MPI_COMM_WORLD);
    force = open;
    dealii::AffineConstraints<double> constraints;
    abut::versions::reinit(constraints, problem.owned, problem.relevant);
    dealii::DoFTools::make_hanging_node_constraints(problem.dof_handler,
                                                    constraints);
    dealii::DoFTools::make_zero_boundary_constraints(problem.dof_handler, 1,
                                                     constraints);
    constraints.close();
    // what a support leaves there must not be read
    for (const auto dof : problem.owned)
      if (constraints.is_constrained(dof))
        force(dof) = 1e9;
    force.compress(dealii::VectorOperation::insert);
    const la::Vector result =
        contact_traction(problem.mapping, problem.dof_handler, constraints,
                         problem.constraints, materials, {id}, force);
    la::Vector difference = problem.interpolate(std::string(
        dim == 2 ? "0; if(y < 1e-9, 2, 0)" : "0; 0; if(z < 1e-9, 2, 0)"));
    double worst = 0;
    for (const auto dof : problem.relevant)
      worst = std::max(worst, std::abs(result(dof) - difference(dof)));
    Expect::near(worst, 0, 1e-12, "contact traction");
  }

  /** u_i = a_i S with the product S of sines, and the force that makes it. */
  template <int dim> class Sines : public dealii::Function<dim>
  {
  public:
    explicit Sines(const Material<dim> &material)
        : dealii::Function<dim>(dim), material(material)
    {
    }

    double value(const Point<dim> &x, const unsigned int c) const override
    {
      return amplitude(c) * product(x, dim, dim);
    }

    Tensor<1, dim> gradient(const Point<dim> &x,
                            const unsigned int c) const override
    {
      Tensor<1, dim> result;
      for (unsigned int j = 0; j < dim; ++j)
        result[j] = amplitude(c) * product(x, j, dim);
      return result;
    }

    Tensor<1, dim> force(const Point<dim> &x) const
    {
      Tensor<1, dim> u;
      Tensor<2, dim> du;
      Tensor<3, dim> d2u;
      for (unsigned int c = 0; c < dim; ++c)
      {
        u[c] = value(x, c);
        du[c] = gradient(x, c);
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int k = 0; k < dim; ++k)
            d2u[c][j][k] = amplitude(c) * product(x, j, k);
      }
      return -material.stress_divergence(d2u, du, u, x);
    }

  private:
    static double amplitude(const unsigned int c)
    {
      return 1. - 0.4 * c;
    }

    /** S differentiated along j and k (dim: not). */
    static double product(const Point<dim> &x, const unsigned int j,
                          const unsigned int k)
    {
      const double pi = dealii::numbers::PI;
      double result = 1;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int order = (d == j ? 1 : 0) + (d == k ? 1 : 0);
        const double s = std::sin(pi * x[d]);
        const double derivatives[3] = {s, pi * std::cos(pi * x[d]),
                                       -pi * pi * s};
        result *= derivatives[order];
      }
      return result;
    }

    const Material<dim> &material;
  };

  /** The force of Sines as a function. */
  template <int dim> class SinesForce : public dealii::Function<dim>
  {
  public:
    explicit SinesForce(const Sines<dim> &sines)
        : dealii::Function<dim>(dim), sines(sines)
    {
    }

    double value(const Point<dim> &x, const unsigned int c) const override
    {
      return sines.force(x)[c];
    }

  private:
    const Sines<dim> &sines;
  };

  /** Stiffness of a cell by the bilinear form that the energy is half the
   * square of. */
  template <int dim>
  void cell_system(const dealii::FEValues<dim> &points,
                   const Material<dim> &law, const Sines<dim> &exact,
                   dealii::FullMatrix<double> &a, dealii::Vector<double> &b)
  {
    const dealii::FEValuesExtractors::Vector displacement(0);
    const auto &u = points[displacement];
    for (const unsigned int q : points.quadrature_point_indices())
    {
      const Point<dim> &x = points.quadrature_point(q);
      const double weight = points.JxW(q) * law.measure(x);
      const Tensor<1, dim> force = exact.force(x);
      for (unsigned int i = 0; i < b.size(); ++i)
      {
        const auto s = law.stress(u.gradient(i, q), u.value(i, q), x);
        b[i] += force * u.value(i, q) * weight;
        for (unsigned int j = 0; j < b.size(); ++j)
          a(i, j) += (s.tensor * u.symmetric_gradient(j, q)
                      + (law.is_axisymmetric()
                             ? s.out_of_plane * u.value(j, q)[0] / x[0]
                             : 0.))
                     * weight;
      }
    }
  }

  /** Estimate over error in the energy norm: bounded, and the same on finer
   * and on locally refined meshes. */
  template <int dim>
  void effectivity(const PlaneModel plane, const unsigned int degree,
                   const unsigned int level)
  {
    const Materials<dim> materials = everywhere<dim>(plane);
    const Sines<dim> exact(*materials.at(0));
    const SinesForce<dim> force(exact);
    check_effectivity<dim>(
        degree, dim, level, 0.1, ", model " + std::to_string(int(plane)),
        [&](const Problem<dim> &problem)
        {
          const la::Vector u = solve_linear<dim>(
              problem,
              [&](const dealii::FEValues<dim> &points,
                  dealii::FullMatrix<double> &a, dealii::Vector<double> &b)
              { cell_system(points, *materials.at(0), exact, a, b); });
          ElasticEstimatorInput<dim> input{problem.mapping, problem.dof_handler,
                                           u, materials};
          input.body_force = {{0, &force}};
          input.supports = supported<dim>(all_sides<dim>());
          const ErrorNorms errors = error_norms(
              problem.mapping, problem.dof_handler, u, exact, &materials);
          return estimate(input) / *errors.energy;
        });
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(argc, argv,
                    [](const std::filesystem::path &)
                    {
                      hooke();
                      forces_of_stress();
                      for (const PlaneModel plane : plane_models)
                        for (const unsigned int degree : {1U, 2U})
                          forces_at_supports(plane, degree);
                      works_at_supports();
                      nonlinear_material();
                      norms();
                      for (const PlaneModel plane : plane_models)
                        for (const unsigned int degree : {1U, 2U})
                        {
                          estimator_in_the_plane(plane, degree);
                          traction<2>(degree, plane);
                          effectivity<2>(plane, degree, 5 - degree);
                        }
                      estimator_in_space();
                      estimator_terms();
                      estimator_at_the_end_of_contact();
                      traction<3>(1, PlaneModel::strain);
                      traction<3>(2, PlaneModel::strain);
                      effectivity<3>(PlaneModel::strain, 1, 2);
                    });
}

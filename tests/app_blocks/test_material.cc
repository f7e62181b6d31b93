// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What is asked of a material, at a point and of bodies: Hooke's law, those for
// large strain, and a nonlinear material that the program does not have.

#include "app/physics/elasticity.h"
#include "app/physics/material_kind.h"

#include "expect.h"
#include "problem.h"
#include "run_checks.h"
#include "stiffening.h"

using namespace abut;
using namespace abut::app;
using dealii::Point;
using dealii::Tensor;

namespace
{
  /** Lame's constants 1 and 1/2. */
  constexpr double lambda = 1, mu = 0.5;
  constexpr double young_modulus = 4. / 3, poisson_ratio = 1. / 3;
  constexpr double stiffening = 3;

  enum class Law
  {
    hooke,
    stiffening,
    neo_hooke,
    st_venant_kirchhoff,
    hooke_of_cells, ///< by the mean change of volume of a cell
    neo_hooke_of_cells
  };

  constexpr Law all_laws[] = {Law::hooke,          Law::stiffening,
                              Law::neo_hooke,      Law::st_venant_kirchhoff,
                              Law::hooke_of_cells, Law::neo_hooke_of_cells};

  bool is_of_cells(const Law law)
  {
    return law == Law::hooke_of_cells || law == Law::neo_hooke_of_cells;
  }

  /** Words of the materials in the table; Stiffening is no entry of it. */
  const char *word(const Law law)
  {
    static const char *const words[] = {"hooke",     nullptr,
                                        "neo-hooke", "st venant-kirchhoff",
                                        "hooke",     "neo-hooke"};
    return words[static_cast<unsigned int>(law)];
  }

  bool is_of_large_strain(const Law law)
  {
    return word(law) && find_material(word(law)).large_strain;
  }

  template <int dim>
  std::shared_ptr<const Material<dim>> make(const Law law,
                                            const PlaneModel plane)
  {
    if (!word(law))
      return std::make_shared<Stiffening<dim>>(young_modulus, poisson_ratio,
                                               stiffening, plane);
    return find_material(word(law)).make<dim>(
        {{young_modulus, poisson_ratio},
         plane,
         is_of_cells(law) ? VolumeChange::of_cell : VolumeChange::of_point});
  }

  /** The material at points: of a cell whose volume has grown by 0.3, where
   * that matters. */
  template <int dim>
  std::shared_ptr<const Material<dim>> at_points(const Law law,
                                                 const PlaneModel plane)
  {
    const auto material = make<dim>(law, plane);
    Expect::that((material->cell_volume() != nullptr) == is_of_cells(law),
                 "who asks for the volume of cells");
    return is_of_cells(law) ? material->cell_volume()->held_at(0.3) : material;
  }

  /** Whether the law has this plane model. */
  bool exists(const Law law, const PlaneModel plane)
  {
    return plane != PlaneModel::stress
           || (!is_of_large_strain(law) && !is_of_cells(law));
  }

  /** A displacement and its gradient at a point. */
  template <int dim> struct State
  {
    Tensor<2, dim> gradient;
    Tensor<1, dim> value;
    Point<dim> point;

    State plus(const double factor, const State &other) const
    {
      return {gradient + factor * other.gradient, value + factor * other.value,
              point};
    }
  };

  /** Without symmetry, with the given size. */
  template <int dim> State<dim> some_state(const double size, const double seed)
  {
    State<dim> result;
    for (unsigned int i = 0; i < dim; ++i)
    {
      result.value[i] = size * std::cos(seed + 2. * i);
      result.point[i] = 0.8 + 0.3 * i;
      for (unsigned int j = 0; j < dim; ++j)
        result.gradient[i][j] = size * std::sin(seed + 3. * i + 1.7 * j);
    }
    return result;
  }

  template <int dim>
  double energy(const Material<dim> &material, const State<dim> &at)
  {
    return material.energy(at.gradient, at.value, at.point);
  }

  template <int dim>
  NominalStress<dim> stress(const Material<dim> &material, const State<dim> &at)
  {
    return material.nominal_stress(at.gradient, at.value, at.point);
  }

  template <int dim>
  NominalStress<dim> tangent(const Material<dim> &material,
                             const State<dim> &at, const State<dim> &change)
  {
    return material.tangent(at.gradient, at.value, at.point, change.gradient,
                            change.value);
  }

  /** Power of a stress. */
  template <int dim>
  double power(const Material<dim> &material, const NominalStress<dim> &stress,
               const State<dim> &rate)
  {
    double sum = stress.out_of_plane
                 * material.hoop_strain(rate.gradient, rate.value, rate.point);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        sum += stress.tensor[i][j] * rate.gradient[i][j];
    return sum;
  }

  /** The stress is the energy's derivative, the tangent the stress's, by
   * symmetric differences. */
  template <int dim> void derivatives(const Material<dim> &material)
  {
    const double h = 1e-5;
    const auto at = some_state<dim>(0.2, 1.);
    const auto along = some_state<dim>(1., 2.), other = some_state<dim>(1., 5.);
    const auto forth = at.plus(h, along), back = at.plus(-h, along);
    Expect::near((energy(material, forth) - energy(material, back)) / (2 * h),
                 power(material, stress(material, at), along), 1e-8,
                 "stress, of the energy");
    const double change = power(material, stress(material, forth), other)
                          - power(material, stress(material, back), other);
    const double predicted =
        power(material, tangent(material, at, along), other);
    Expect::near(change / (2 * h), predicted, 1e-8, "tangent, of the stress");
    Expect::near(power(material, tangent(material, at, other), along),
                 predicted, 1e-13, "symmetry of the tangent");
  }

  /** sigma:eps = lambda tr^2 + 2 mu eps:eps by hand, but in plane stress, where
   * lambda is 2 mu lambda / (lambda + 2 mu) = 1/2. */
  template <int dim> void energy_by_hand(const PlaneModel plane)
  {
    const auto hooke = make<dim>(Law::hooke, plane);
    const auto at = some_state<dim>(1., 3.);
    const double hoop = dim == 2 && plane == PlaneModel::axisymmetric
                            ? at.value[0] / at.point[0]
                            : 0;
    const double modulus =
        dim == 2 && plane == PlaneModel::stress ? 0.5 : lambda;
    double square = hoop * hoop;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        square += std::pow((at.gradient[i][j] + at.gradient[j][i]) / 2, 2);
    const double expected =
        modulus / 2 * std::pow(trace(at.gradient) + hoop, 2) + mu * square;
    Expect::near(energy(*hooke, at), expected, 1e-13, "energy");
    Expect::near(hooke->stiffness(), young_modulus, 1e-15, "E");
    Expect::near(hooke->poisson_ratio(), poisson_ratio, 1e-15, "nu");
    Expect::near(hooke->dilation_stiffness(), modulus, 1e-14, "lambda");
  }

  /** Divergence as every material has it against differences of the stress of
   * u = (x^2, x y, ..) / 5, and against the material's own. */
  template <int dim> void divergence(const PlaneModel plane)
  {
    const auto state = [](const Point<dim> &x)
    {
      State<dim> result;
      result.point = x;
      for (unsigned int i = 0; i < dim; ++i)
      {
        result.value[i] = 0.2 * x[0] * x[i];
        result.gradient[i][0] += 0.2 * x[i];
        result.gradient[i][i] += 0.2 * x[0];
      }
      return result;
    };
    Point<dim> at;
    Tensor<3, dim> hessian;
    for (unsigned int i = 0; i < dim; ++i)
    {
      at[i] = 1. + 0.3 * i;
      hessian[i][0][i] += 0.2;
      hessian[i][i][0] += 0.2;
    }
    for (const Law law : all_laws)
    {
      if (!exists(law, plane))
        continue;
      const auto material = at_points<dim>(law, plane);
      const State<dim> here = state(at);
      const NominalStress<dim> s = stress(*material, here);
      Tensor<1, dim> expected;
      for (unsigned int j = 0; j < dim; ++j)
      {
        Point<dim> forth = at, back = at;
        forth[j] += 1e-5;
        back[j] -= 1e-5;
        const auto change = stress(*material, state(forth)).tensor
                            - stress(*material, state(back)).tensor;
        for (unsigned int i = 0; i < dim; ++i)
          expected[i] += change[i][j] / 2e-5;
      }
      if (material->is_axisymmetric())
      {
        expected[0] += (s.tensor[0][0] - s.out_of_plane) / at[0];
        expected[1] += s.tensor[1][0] / at[0];
      }
      const Tensor<1, dim> general = material->Material<dim>::stress_divergence(
          hessian, here.gradient, here.value, at);
      Expect::near((general - expected).norm(), 0, 1e-7, "divergence");
      const Tensor<1, dim> own =
          material->stress_divergence(hessian, here.gradient, here.value, at);
      Expect::near((own - general).norm(), 0, 1e-13,
                   "the material's own divergence");
    }
  }

  /** Hooke's stiffness by pairs of nodes against the tangent that every
   * material has, on a cell without right angles. */
  template <int dim>
  void cell_tangent(const PlaneModel plane, const unsigned int degree,
                    const Law law)
  {
    dealii::Triangulation<dim> mesh;
    dealii::GridGenerator::hyper_cube(mesh, 1, 2);
    mesh.begin_active()->vertex(0)[0] += 0.2;
    mesh.begin_active()->vertex(1)[1] -= 0.1;
    const dealii::FESystem<dim> fe(dealii::FE_Q<dim>(degree), dim);
    dealii::FEValues<dim> points(
        fe.base_element(0), dealii::QGauss<dim>(degree + 1),
        dealii::update_values | dealii::update_gradients
            | dealii::update_quadrature_points | dealii::update_JxW_values);
    points.reinit(mesh.begin_active());
    const unsigned int n = fe.n_dofs_per_cell();
    dealii::FullMatrix<double> own(n, n), general(n, n);
    const auto material = make<dim>(law, plane);
    material->cell_tangent(points, fe, CellState<dim>(), own);
    material->Material<dim>::cell_tangent(points, fe, CellState<dim>(),
                                          general);
    Expect::that(own.frobenius_norm() > 0.1, "stiffness");
    own.add(-1., general);
    Expect::near(own.frobenius_norm(), 0, 1e-12, "stiffness by pairs of nodes");
  }

  /** A square or cube of two bodies with hanging nodes, a support that moves,
   * a free side under pressure and weight. */
  template <int dim> class Bodies
  {
  public:
    Bodies(const Materials<dim> &materials, const unsigned int degree)
        : mesh(degree, dim),
          problem(mesh.mesh, degree),
          support(dim == 2 ? "0.05*y; 0.02" : "0.05*y; 0.02; 0.02*x", "s", dim),
          push("0.3", "p"),
          weight(1., nullptr, dim == 2 ? "0.1; -0.2" : "0.1; -0.2; 0.3", "f")
    {
      unit_cube(mesh, dim == 2 ? 2 : 1);
      refine_corner(mesh);
      for (const auto &cell : mesh.mesh.active_cell_iterators())
        if (cell->is_locally_owned())
          cell->set_material_id(cell->center()[1] < 0.5 ? 0 : 1);
      data.materials = materials;
      data.supports[1] = {&support, dealii::ComponentMask(dim, true)};
      data.pressures[3] = {&push, dealii::ComponentMask(1, true)};
      data.body_force[1] = &weight;
      data.name = [](dealii::types::boundary_id) { return "a side"; };
      problem.setup(data);
      problem.assemble_stiffness();
      problem.assemble_load(data);
    }

    /** Values at free nodes; the others follow. */
    la::Vector some(const double size, const double seed) const
    {
      la::Vector result = problem.vector();
      for (const auto i : problem.dof_handler.locally_owned_dofs())
        result(i) = size * std::sin(seed + 1.3 * double(i));
      result.compress(dealii::VectorOperation::insert);
      problem.constraints.set_zero(result);
      return result;
    }

    Problem<dim> mesh;
    Elasticity<dim> problem;

  private:
    Expression<dim> support, push;
    VolumeForce<dim> weight;
    ElasticData<dim> data;
  };

  /** The residual is the derivative of the energy and the tangent that of the
   * residual, at a displacement that is no solution. */
  template <int dim>
  void bodies(const PlaneModel plane, const unsigned int degree, const Law law,
              const Law other)
  {
    Bodies<dim> two({{0, make<dim>(law, plane)}, {1, make<dim>(other, plane)}},
                    degree);
    Elasticity<dim> &problem = two.problem;
    Expect::that(problem.is_linear()
                     == (!is_of_large_strain(law) && law != Law::stiffening
                         && other != Law::neo_hooke_of_cells
                         && other != Law::st_venant_kirchhoff
                         && other != Law::stiffening),
                 "linear if both are");
    const double h = 1e-4;
    la::Vector u = two.some(0.005, 1.);
    const la::Vector along = two.some(1e-1, 4.);
    problem.constraints.distribute(u);
    la::Vector forth(u), back(u), residual(u), difference(u), predicted(u);
    forth.add(h, along);
    back.add(-h, along);
    for (la::Vector *v : {&forth, &back})
      problem.constraints.distribute(*v);
    problem.residual(u, residual);
    const double power = residual * along;
    Expect::that(std::abs(power) > 1e-4, "a residual");
    Expect::near((problem.energy(forth) - problem.energy(back)) / (2 * h),
                 power, 1e-7 * (1 + std::abs(power)), "energy's derivative");
    problem.residual(forth, difference);
    problem.residual(back, residual);
    difference -= residual;
    difference /= 2 * h;
    problem.tangent(u).vmult(predicted, along);
    problem.constraints.set_zero(predicted);
    la::Vector second = two.some(1e-1, 7.), changed(u);
    problem.tangent(u).vmult(changed, second);
    const double back_and_forth = changed * along;
    Expect::near(predicted * second, back_and_forth,
                 1e-12 * std::abs(back_and_forth), "symmetry");
    const double size = predicted.l2_norm();
    predicted -= difference;
    Expect::near(predicted.l2_norm() / size, 0, 1e-6, "residual's derivative");
  }

  /** A strain of 0.2 along x and none across, held on all sides: its energy
   * and the force on x = 1, by hand. */
  template <int dim> void stretched(const Law law)
  {
    Problem<dim> mesh(1, dim);
    unit_cube(mesh, 1);
    Elasticity<dim> problem(mesh.mesh, 1);
    const double e = 0.2;
    const Expression<dim> value(dim == 2 ? "0.2*x; 0" : "0.2*x; 0; 0", "s",
                                dim);
    ElasticData<dim> data;
    data.materials[0] = make<dim>(law, PlaneModel::strain);
    for (const auto id : all_sides<dim>())
      data.supports[id] = {&value, dealii::ComponentMask(dim, true)};
    data.name = [](dealii::types::boundary_id) { return "a side"; };
    problem.setup(data);
    problem.assemble_stiffness();
    problem.assemble_load(data);
    la::Vector u = problem.vector(), residual = problem.vector();
    dealii::VectorTools::interpolate(problem.mapping, problem.dof_handler,
                                     value, u);
    const double c = law == Law::hooke ? 0 : stiffening;
    const double energy = (lambda + 2 * mu) / 2 * e * e + c / 4 * e * e * e * e;
    const double force = (lambda + 2 * mu) * e + c * e * e * e;
    Expect::near(problem.energy(u), energy, 1e-14, "energy of a stretch");
    problem.residual(u, residual);
    Expect::near(residual.l2_norm(), 0, 1e-14, "balance inside");
    const la::Vector forces = problem.unbalanced_forces(u);
    const dealii::IndexSet side = dealii::DoFTools::extract_boundary_dofs(
        problem.dof_handler, dealii::ComponentMask(dim, true), {1});
    // Those along the side cancel each other.
    double sum = 0;
    for (const auto dof : problem.dof_handler.locally_owned_dofs())
      if (side.is_element(dof))
        sum += forces(dof);
    Expect::near(dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD), force, 1e-14,
                 "force on a side");
  }

  /** A square deformed by u = (c x y, 0), which grows by c y: what one change
   * of volume for all of it, c/2, makes of energy and stress, by hand.
   * Logarithms are sums over Gauss' two points. */
  void mean_of_a_cell()
  {
    const double c = 0.6;
    Problem<2> mesh(1, 2);
    unit_cube(mesh, 0);
    Elasticity<2> problem(mesh.mesh, 1);
    const Expression<2> value("0.6*x*y; 0", "s", 2);
    const double points[] = {0.5 - std::sqrt(1. / 12),
                             0.5 + std::sqrt(1. / 12)};
    const double logs =
        (std::log(1 + c * points[0]) + std::log(1 + c * points[1])) / 2;
    const double small = lambda * c * c / 8 + mu * c * c / 2;
    const double large = mu / 2 * (c + 2 * c * c / 3 - 2 * logs)
                         + lambda / 2 * std::pow(std::log(1 + c / 2), 2);
    for (const Law law : {Law::hooke_of_cells, Law::neo_hooke_of_cells})
    {
      ElasticData<2> data;
      data.materials[0] = make<2>(law, PlaneModel::strain);
      data.name = [](dealii::types::boundary_id) { return "a side"; };
      problem.setup(data);
      problem.assemble_stiffness();
      problem.assemble_load(data);
      la::Vector u = problem.vector();
      dealii::VectorTools::interpolate(problem.mapping, problem.dof_handler,
                                       value, u);
      const bool is_small = law == Law::hooke_of_cells;
      Expect::near(problem.energy(u), is_small ? small : large, 1e-14,
                   "energy of a cell");
      const la::Vector ghosted = problem.ghosted_field(u);
      const CellMaterials<2> materials(problem.mapping, problem.dof_handler,
                                       ghosted, data.materials);
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          // At (1, 1), where grad u = ((c, c), (0, 0)).
          Tensor<2, 2> gradient;
          gradient[0][0] = gradient[0][1] = c;
          const Stress<2> s = materials.at(cell).stress(gradient, {}, {1., 1.});
          const double j = 1 + c, mean = 1 + c / 2;
          const double p =
              is_small ? lambda * c / 2 : lambda * std::log(mean) / mean;
          Expect::near(s.out_of_plane, p, 1e-14, "stress along z");
          Expect::near(s.tensor[0][1], is_small ? mu * c : mu * c / j, 1e-14,
                       "shear");
          Expect::near(
              s.tensor[0][0],
              p + (is_small ? 2 * mu * c : mu / j * (j * j + c * c - 1)), 1e-14,
              "stress along x");
        }
    }
  }

  /** A state whose F is a rotation, and one stretched by the given factors
   * before it. */
  template <int dim>
  State<dim> turned(const double angle, const Tensor<1, dim> &stretch)
  {
    Tensor<2, dim> turn, along;
    for (unsigned int d = 0; d < dim; ++d)
    {
      turn[d][d] = d < 2 ? std::cos(angle) : 1.;
      along[d][d] = stretch[d];
    }
    turn[1][0] = std::sin(angle);
    turn[0][1] = -std::sin(angle);
    State<dim> result;
    result.gradient = turn * along;
    for (unsigned int d = 0; d < dim; ++d)
    {
      result.gradient[d][d] -= 1.;
      result.point[d] = 1.;
    }
    return result;
  }

  /** Free sides under a stretch of 0.8 along the last axis, turned: stresses of
   * the roots of the scalar equations (E = 1, nu = 0.3). */
  template <int dim>
  void compressed(const double side, const double nominal, const double cauchy)
  {
    const auto made =
        find_material("neo-hooke").make<dim>({{1., 0.3}, PlaneModel::strain});
    const Material<dim> &material = *made;
    Tensor<1, dim> stretch;
    for (unsigned int d = 0; d < dim; ++d)
      stretch[d] = d + 1 < dim ? side : 0.8;
    const auto upright = turned<dim>(0., stretch);
    const NominalStress<dim> p = stress(material, upright);
    Expect::near(p.tensor[dim - 1][dim - 1], nominal, 1e-14, "nominal stress");
    Expect::near(p.tensor[0][0], 0., 1e-14, "free side");
    const Stress<dim> s =
        material.stress(upright.gradient, upright.value, upright.point);
    Expect::near(s.tensor[dim - 1][dim - 1], cauchy, 1e-14, "Cauchy's stress");
    const double angle = 1.1;
    const auto at = turned<dim>(angle, stretch);
    const Stress<dim> turned_stress =
        material.stress(at.gradient, at.value, at.point);
    Expect::near(turned_stress.von_mises(), s.von_mises(), 1e-14,
                 "von Mises' stress after a turn");
    if (dim == 2)
      Expect::near(turned_stress.tensor[0][0],
                   std::sin(angle) * std::sin(angle) * cauchy, 1e-14,
                   "stress that turns with the body");
  }

  /** No stress in what has only turned, nan in what is turned inside out. */
  template <int dim> void large_strain(const Law law)
  {
    const auto material = make<dim>(law, PlaneModel::strain);
    Tensor<1, dim> one;
    for (unsigned int d = 0; d < dim; ++d)
      one[d] = 1.;
    const auto at = turned<dim>(2.5, one);
    Expect::near(stress(*material, at).tensor.norm(), 0., 1e-14,
                 "stress of a turn");
    Expect::near(energy(*material, at), 0., 1e-14, "energy of a turn");
    one[0] = -0.1;
    const auto inside_out = turned<dim>(0., one);
    Expect::that(std::isnan(stress(*material, inside_out).tensor[0][0])
                     && std::isnan(energy(*material, inside_out)),
                 "no stress of what is inside out");
    const auto hooke = make<dim>(Law::hooke, PlaneModel::strain);
    const State<dim> none{Tensor<2, dim>(), Tensor<1, dim>(), at.point};
    const auto along = some_state<dim>(1., 2.), other = some_state<dim>(1., 5.);
    Expect::near(power(*material, tangent(*material, none, along), other),
                 power(*hooke, tangent(*hooke, none, along), other), 1e-14,
                 "Hooke's law of small strain");
  }

  /** Entries of the table say what their materials are: a body that has only
   * turned by 1 has stress, unless the material is for large strain; the stress
   * of twice a small state is twice that of a linear material. */
  template <int dim> void entry(const MaterialKind &kind)
  {
    MaterialData data;
    for (const MaterialNumber &number : kind.numbers)
    {
      data.numbers.push_back(std::stod(number.value));
      Expect::that(abut_limit_contains(&number.range, data.numbers.back()),
                   "default in its range");
    }
    const auto material = kind.make<dim>(data);
    Tensor<1, dim> one;
    for (unsigned int d = 0; d < dim; ++d)
      one[d] = 1.;
    const double turn = stress(*material, turned<dim>(1., one)).tensor.norm();
    Expect::that((turn < 1e-12) == kind.large_strain, "large strain");
    const auto twice =
        stress(*material, some_state<dim>(0.02, 1.)).tensor
        - 2. * stress(*material, some_state<dim>(0.01, 1.)).tensor;
    Expect::that((twice.norm() < 1e-14) == kind.linear, "linear");
    Expect::that(material->is_linear() == kind.linear, "is_linear()");
    Expect::that((material->least_stretch() == 0.)
                     == (kind.below_least_stretch == nullptr),
                 "what happens below the least stretch");
    data.volume = VolumeChange::of_cell;
    Expect::that((kind.make<dim>(data)->cell_volume() != nullptr)
                     == (kind.without_mean_dilatation == nullptr),
                 "mean dilatation");
  }

  template <int dim> void all(const PlaneModel plane)
  {
    energy_by_hand<dim>(plane);
    divergence<dim>(plane);
    for (const Law law : all_laws)
      if (exists(law, plane))
        derivatives(*at_points<dim>(law, plane));
    for (const unsigned int degree : {1U, 2U})
    {
      for (const Law law : {Law::hooke, Law::hooke_of_cells})
        if (exists(law, plane))
          cell_tangent<dim>(plane, degree, law);
      bodies<dim>(plane, degree, Law::hooke, Law::hooke);
      bodies<dim>(plane, degree, Law::stiffening, Law::hooke);
    }
    bodies<dim>(plane, 1, Law::stiffening, Law::stiffening);
    if (plane == PlaneModel::stress)
      return;
    bodies<dim>(plane, 1, Law::neo_hooke, Law::st_venant_kirchhoff);
    bodies<dim>(plane, 1, Law::neo_hooke_of_cells, Law::neo_hooke_of_cells);
    bodies<dim>(plane, 1, Law::neo_hooke_of_cells, Law::st_venant_kirchhoff);
    bodies<dim>(plane, 1, Law::hooke_of_cells, Law::hooke);
  }
} // namespace

int
main(int argc, char **argv)
{
  return run_checks(
      argc, argv,
      [](const std::filesystem::path &)
      {
        for (const PlaneModel plane :
             {PlaneModel::strain, PlaneModel::stress, PlaneModel::axisymmetric})
          all<2>(plane);
        all<3>(PlaneModel::strain);
        for (const MaterialKind *kind : material_kinds())
        {
          entry<2>(*kind);
          entry<3>(*kind);
        }
        for (const Law law : {Law::hooke, Law::stiffening})
        {
          stretched<2>(law);
          stretched<3>(law);
        }
        mean_of_a_cell();
        for (const Law law : {Law::neo_hooke, Law::st_venant_kirchhoff,
                              Law::neo_hooke_of_cells})
        {
          large_strain<2>(law);
          large_strain<3>(law);
        }
        compressed<2>(1.094876055993743, -.268631527879045, -.245353367998561);
        compressed<3>(1.067338369278968, -.240005381988023, -.210676811410696);
      });
}

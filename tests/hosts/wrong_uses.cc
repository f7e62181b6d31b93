// SPDX-License-Identifier: LGPL-2.1-or-later
// Mistakes of a first program, step-8 with an obstacle or a second body: each
// is an error or a finding that names its cause, and no answer in silence.
#include "expect.h"

#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/rigid_obstacle.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/fe/mapping_q_eulerian.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

using namespace abut;
using dealii::Point;
using dealii::Tensor;
using hosts::expect;

namespace
{
  using Vector = dealii::Vector<double>;
  constexpr int dim = 2;
  enum Side
  {
    bottom = 1,
    lower = 2,
    upper = 3,
    top = 4,
    left = 5
  };

  /** What a program does, right by default. */
  struct Use
  {
    bool two_bodies = false;
    unsigned int n_refinements = 1;
    bool has_supports = true;
    bool is_separate = false;   ///< loads are assembled in calls of their own
    double sign = 1.;           ///< R times this; 0: R of the start for ever
    bool is_cracked = false;    ///< one body, with a crack from its left side
    bool is_uniaxial = false;   ///< the body below the other is as wide as it,
                                ///< and nothing hinders them sideways
    double same_vertex = 1e-12; ///< distance of vertices that are merged
    double lift = 0.;           ///< the body is moved up by this
  };

  /** The square of step-8, lambda = mu = 1, fixed below; or another one on it
   * that is 1.2 wide, 0.01 apart and moved down by 0.05. Those of a uniaxial
   * problem touch, and have cells of two sizes. */
  class Program
  {
  public:
    explicit Program(const Use &use)
        : use(use),
          fe(dealii::FE_Q<dim>(1), dim),
          dof_handler(mesh),
          contact(MPI_COMM_SELF)
    {
      make_mesh();
      dof_handler.distribute_dofs(fe);
      dealii::DoFTools::make_hanging_node_constraints(dof_handler, constraints);
      const dealii::ComponentMask along(std::vector<bool>{true, false}),
          across(std::vector<bool>{!use.is_uniaxial, true});
      if (use.is_uniaxial)
        prescribe(left, {}, along);
      if (use.has_supports)
        prescribe(bottom, Tensor<1, dim>({0., use.lift}), across);
      if (use.two_bodies || use.is_cracked)
        prescribe(top, Tensor<1, dim>({0., -0.05}), across);
      constraints.close();
      dealii::DynamicSparsityPattern pattern(dof_handler.n_dofs());
      dealii::DoFTools::make_sparsity_pattern(dof_handler, pattern);
      sparsity.copy_from(pattern);
      matrix.reinit(sparsity);
      for (Vector *vector : {&u, &load, &residual, &increment, &internal})
        vector->reinit(dof_handler.n_dofs());
      assemble();
      constraints.distribute(u);
    }

    ContactPair<dim> bodies() const
    {
      ContactPair<dim> pair;
      pair.name = "lower on upper";
      pair.secondary = {lower};
      pair.primary = {upper};
      return pair;
    }

    static ContactPair<dim> under(const double height)
    {
      ContactPair<dim> pair;
      pair.name = "wall";
      pair.secondary = {lower};
      pair.obstacle = std::make_shared<RigidObstacle<dim>>(
          plane<dim>(Point<dim>(0., height), Tensor<1, dim>({0., -1.})));
      return pair;
    }

    void find_residual()
    {
      if (use.sign == 0.)
        return;
      matrix.vmult(residual, u);
      residual -= load;
      constraints.set_zero(residual);
      residual *= use.sign;
    }

    void prepare(const ContactPair<dim> &pair)
    {
      contact.set_pairs({pair});
      contact.reinit(mapping, dof_handler, constraints);
    }

    /** The loop of the document, after prepare(). */
    IterationReport iterate()
    {
      contact.detect(u);
      do
      {
        find_residual();
        contact.solve(matrix, residual, increment);
        u += increment;
        constraints.distribute(u);
      } while (contact.update(u));
      find_residual();
      return contact.iteration();
    }

    IterationReport solve(const ContactPair<dim> &pair)
    {
      prepare(pair);
      return iterate();
    }

    /** Sum of the internal forces on a boundary, which come from stresses. */
    Tensor<1, dim> force_on(const Side side)
    {
      internal = 0.;
      for_each_cell(
          [&](const auto &dofs, const auto &cell_matrix)
          {
            Vector values(dofs.size()), forces(dofs.size());
            for (unsigned int k = 0; k < dofs.size(); ++k)
              values(k) = u(dofs[k]);
            cell_matrix.vmult(forces, values);
            internal.add(dofs, forces);
          });
      Tensor<1, dim> sum;
      for (unsigned int d = 0; d < dim; ++d)
      {
        dealii::ComponentMask mask(dim, false);
        mask.set(d, true);
        for (const auto dof :
             dealii::DoFTools::extract_boundary_dofs(dof_handler, mask, {side}))
          sum[d] += internal(dof);
      }
      return sum;
    }

    /** Integral of -pressure() over a boundary. */
    Tensor<1, dim> integral_on(const Side side) const
    {
      Vector p(dof_handler.n_dofs());
      la::copy(contact.results().pressure(), p);
      const dealii::QGauss<dim - 1> rule(2);
      dealii::FEFaceValues<dim> values(
          mapping, fe, rule, dealii::update_values | dealii::update_JxW_values);
      std::vector<Tensor<1, dim>> at(rule.size());
      Tensor<1, dim> sum;
      for (const auto &cell : dof_handler.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == side)
          {
            values.reinit(cell, face);
            values[dealii::FEValuesExtractors::Vector(0)].get_function_values(
                p, at);
            for (unsigned int q = 0; q < rule.size(); ++q)
              sum -= values.JxW(q) * at[q];
          }
      return sum;
    }

    const Use use;
    dealii::Triangulation<dim> mesh;
    const dealii::FESystem<dim> fe;
    dealii::DoFHandler<dim> dof_handler;
    const dealii::MappingQ<dim> mapping{1};
    dealii::AffineConstraints<double> constraints;
    dealii::SparsityPattern sparsity;
    dealii::SparseMatrix<double> matrix;
    Vector u, load, residual, increment, internal;
    ContactAssembler<dim> contact;

  private:
    void make_mesh()
    {
      dealii::Triangulation<dim> one, other, both;
      if (use.is_cracked)
        make_crack(one);
      else
        dealii::GridGenerator::subdivided_hyper_rectangle(
            one, {4, 4}, Point<dim>(-1., -1.), Point<dim>(1., 1.));
      if (use.is_uniaxial)
        dealii::GridGenerator::subdivided_hyper_rectangle(
            other, {2, 1}, Point<dim>(-1., 1.), Point<dim>(1., 2.));
      else
        dealii::GridGenerator::subdivided_hyper_rectangle(
            other, {3, 3}, Point<dim>(-0.6, 1.01), Point<dim>(0.6, 2.01));
      if (use.two_bodies)
        dealii::GridGenerator::merge_triangulations(one, other, both,
                                                    use.same_vertex);
      else
        both.copy_triangulation(one);
      const double interface = use.is_cracked ? 0. : 1.;
      for (const auto &cell : both.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
          {
            const double x = face->center()[0], y = face->center()[1];
            face->set_boundary_id(
                y < -0.99                            ? bottom
                : y > (use.is_cracked ? 0.99 : 1.99) ? top
                : x < -0.99                          ? left
                : std::abs(y - interface) < 1e-9 && cell->center()[1] < interface ? lower
                : std::abs(y - interface) < 0.02 ? upper
                                                 : 0);
          }
      mesh.copy_triangulation(both);
      mesh.refine_global(use.n_refinements);
    }

    /** Four cells, two vertices at (-1, 0). */
    static void make_crack(dealii::Triangulation<dim> &mesh)
    {
      std::vector<Point<dim>> vertices;
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
          vertices.emplace_back(x, y);
      vertices.push_back(vertices[3]);
      std::vector<dealii::CellData<dim>> cells(4);
      const unsigned int corners[4][4] = {
          {0, 1, 3, 4}, {1, 2, 4, 5}, {9, 4, 6, 7}, {4, 5, 7, 8}};
      for (unsigned int c = 0; c < 4; ++c)
        cells[c].vertices.assign(corners[c], corners[c] + 4);
      mesh.create_triangulation(vertices, cells, dealii::SubCellData());
    }

    void prescribe(const Side side, const Tensor<1, dim> &value,
                   const dealii::ComponentMask &mask)
    {
      dealii::VectorTools::interpolate_boundary_values(
          mapping, dof_handler, side,
          dealii::Functions::ConstantFunction<dim>(&value[0], dim), constraints,
          mask);
    }

    template <typename Function>
    void for_each_cell(const Function &function) const
    {
      const dealii::QGauss<dim> rule(2);
      dealii::FEValues<dim> values(mapping, fe, rule,
                                   dealii::update_gradients
                                       | dealii::update_JxW_values);
      const dealii::FEValuesExtractors::Vector vector(0);
      const unsigned int n = fe.n_dofs_per_cell();
      std::vector<dealii::types::global_dof_index> dofs(n);
      dealii::FullMatrix<double> cell_matrix(n, n);
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        cell_matrix = 0.;
        for (unsigned int q = 0; q < rule.size(); ++q)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              cell_matrix(i, j) +=
                  values.JxW(q)
                  * (2.
                         * (values[vector].symmetric_gradient(i, q)
                            * values[vector].symmetric_gradient(j, q))
                     + values[vector].divergence(i, q)
                           * values[vector].divergence(j, q));
        cell->get_dof_indices(dofs);
        function(dofs, cell_matrix);
      }
    }

    void assemble()
    {
      for_each_cell(
          [&](const auto &dofs, const auto &cell_matrix)
          {
            const Vector no_load(dofs.size());
            if (use.is_separate)
            {
              constraints.distribute_local_to_global(cell_matrix, dofs, matrix);
              constraints.distribute_local_to_global(no_load, dofs, load);
            }
            else
              constraints.distribute_local_to_global(cell_matrix, no_load, dofs,
                                                     matrix, load);
          });
    }
  };

  /** The texts of the findings of examine() with this code, one a line. */
  std::string findings(Program &program, const abut_failure failure,
                       const bool is_error)
  {
    std::string result;
    for (const ContactFinding &finding :
         program.contact.checks().examine(program.u, program.residual).findings)
      if (finding.failure == failure && finding.is_error == is_error)
        result += finding.text + '\n';
    return result;
  }

  /** What a call throws; empty: nothing. */
  template <typename Function> std::string message_of(const Function &call)
  {
    try
    {
      call();
    }
    catch (const std::exception &error)
    {
      return error.what();
    }
    return "";
  }

  void expect_words(const std::string &text,
                    const std::vector<std::string> &words)
  {
    for (const std::string &word : words)
      expect(text.find(word) != std::string::npos,
             "'" + word + "' in '" + text + "'");
  }

  /** Nothing but an obstacle drives the body: there is no load that forces out
   * of balance could be compared with. */
  void check_residual()
  {
    Program good({});
    const IterationReport report = good.solve(Program::under(0.999));
    expect(report.reason == ABUT_REASON_CONVERGED
               && report.explanation == "converged",
           "the right sign: " + report.explanation);
    const auto pair = good.contact.results().pairs()[0];
    const Tensor<1, dim> reaction = good.force_on(bottom);
    expect(pair.secondary_force.norm() > 1e-3
               && (pair.secondary_force + reaction).norm()
                      < 1e-9 * reaction.norm(),
           "contact and support are in balance");
    const ContactExamination seen =
        good.contact.checks().examine(good.u, good.residual);
    expect(seen.findings.empty() && seen.imbalance < 1e-9,
           "nothing is found in a right answer");

    Use use;
    use.sign = -1.;
    expect_words(
        message_of([&] { Program(use).solve(Program::under(0.999)); }),
        {"ABUT-F38", "changes by -1 times K du", "internal minus external"});
    use.sign = 0.;
    expect_words(message_of([&] { Program(use).solve(Program::under(0.999)); }),
                 {"ABUT-F38", "changes by 0 times K du", "after each step"});
    use.sign = 2.;
    Program doubled(use);
    doubled.solve(Program::under(0.999));
    expect_words(findings(doubled, ABUT_FAILURE_UNBALANCED, false),
                 {"changes by 2 times K du"});
  }

  /** K is without the columns of prescribed unknowns, and R has no forces of
   * them either. */
  void check_prescribed()
  {
    for (const bool is_separate : {false, true})
    {
      Use use;
      use.two_bodies = true;
      use.is_separate = is_separate;
      Program program(use);
      const IterationReport report = program.solve(program.bodies());
      expect(report.reason == ABUT_REASON_CONVERGED, "prescribed displacement");
      const std::string lost = findings(program, ABUT_FAILURE_UNBALANCED, true);
      expect(lost.empty() != is_separate, "what is said of R: " + lost);
      if (is_separate)
      {
        expect_words(lost, {"0.05", "distribute_local_to_global()"});
        expect_words(findings(program, ABUT_FAILURE_LARGE_STRAIN, false),
                     {"residual has no forces of"});
      }
    }
  }

  /** The secondary surface is larger than the primary, whose end is inside of
   * facets: the integral of the pressures is the force all the same. */
  void check_pressure()
  {
    for (const char *const law : {"lagrange", "penalty"})
      for (const auto discretisation :
           {ABUT_DISCRETISATION_DUAL_MORTAR, ABUT_DISCRETISATION_MORTAR,
            ABUT_DISCRETISATION_QUADRATURE_POINT})
        for (const unsigned int refinements : {1, 2, 3})
        {
          const bool is_penalty = std::string(law) == "penalty";
          if (!is_penalty
              && discretisation == ABUT_DISCRETISATION_QUADRATURE_POINT)
            continue;
          Use use;
          use.two_bodies = true;
          use.n_refinements = refinements;
          for (const bool exchanged : {false, true})
          {
            Program program(use);
            MethodParameters method;
            method.options.law = abut_law_find(law);
            method.discretisation = discretisation;
            program.contact.set_parameters(method, SolverParameters());
            ContactPair<dim> pair = program.bodies();
            if (exchanged)
              std::swap(pair.secondary, pair.primary);
            program.solve(pair);
            const auto result = program.contact.results().pairs()[0];
            const Side side = exchanged ? upper : lower;
            const Tensor<1, dim> force = result.secondary_force;
            expect((force + program.force_on(exchanged ? top : bottom)).norm()
                       < 1e-8 * force.norm(),
                   "force and reaction");
            const double off =
                (program.integral_on(side) - force).norm() / force.norm();
            expect(off < 1e-10,
                   std::string(law) + ", " + discretisation_name(discretisation)
                       + ", " + std::to_string(refinements)
                       + " refinements: the integral of pressures differs from "
                         "the force by "
                       + std::to_string(off));
          }
        }
  }

  void check_pairs()
  {
    // Half a facet is 0.125.
    Program far({});
    const std::string said = far.solve(Program::under(1.5)).explanation;
    expect_words(said, {"converged", "'wall'", "no node"});
    ContactPair<dim> late = Program::under(1.5);
    late.may_be_apart = true;
    expect(Program({}).solve(late).explanation == "converged",
           "a wall that may be apart");

    Use use;
    use.two_bodies = true;
    Program program(use);
    ContactPair<dim> wrong = program.bodies();
    wrong.secondary = {bottom};
    wrong.primary = {top};
    expect_words(message_of([&] { program.solve(wrong); }),
                 {"ABUT-F11", "boundary ids"});
  }

  void check_constraints()
  {
    Use use;
    use.has_supports = false;
    Program floating(use);
    floating.solve(Program::under(0.98));
    const std::string lone =
        findings(floating, ABUT_FAILURE_FLOATING_BODY, false);
    expect_words(lone, {"Nothing supports body 1", "boundary values"});
    expect(std::count(lone.begin(), lone.end(), '\n') == 1, "once: " + lone);
    expect(findings(floating, ABUT_FAILURE_UNBALANCED, true).empty()
               && findings(floating, ABUT_FAILURE_UNBALANCED, false).empty(),
           "round-off is no lack of balance");

    Program program({});
    program.prepare(Program::under(0.98));
    dealii::AffineConstraints<double> other, open;
    open.add_line(0);
    expect_words(message_of(
                     [&] {
                       program.contact.reinit(program.mapping,
                                              program.dof_handler, open);
                     }),
                 {"close()"});
    other.close();
    program.contact.reinit(program.mapping, program.dof_handler, other);
    expect_words(message_of([&] { program.iterate(); }),
                 {"matrix given to solve()", "but a diagonal", "reinit()"});
  }

  /** Bodies of which the meshes have vertices in common are not two bodies. */
  void check_shared_vertices()
  {
    // Plane strain, lambda = mu = 1: E / (1 - nu^2) = 8/3; both are 2 wide.
    const double stiffness = 8. / 3., width = 2.;
    const auto expect_force = [&](Program &program, const double height)
    {
      const IterationReport report = program.solve(program.bodies());
      const double force = program.force_on(bottom)[1];
      const double expected = stiffness * width * 0.05 / height;
      expect(report.reason == ABUT_REASON_CONVERGED
                 && std::abs(force - expected) < 1e-9 * expected,
             "a force of " + std::to_string(force) + ", not "
                 + std::to_string(expected));
    };
    Use use;
    use.two_bodies = use.is_uniaxial = true;
    use.same_vertex = 0.;
    Program separate(use);
    expect_force(separate, 3.);
    use.same_vertex = 1e-12;
    Program merged(use);
    ContactPair<dim> pair = merged.bodies();
    expect_words(message_of([&] { merged.solve(pair); }),
                 {"lower on upper", "3 of the 9 nodes", "5 of the primary",
                  "merge_triangulations()", "duplicated_vertex_tolerance"});
    std::swap(pair.secondary, pair.primary);
    expect_words(message_of([&] { merged.solve(pair); }),
                 {"3 of the 5 nodes", "9 of the primary"});
    // The sides of a crack meet at its tip.
    use.two_bodies = false;
    use.is_cracked = true;
    Program cracked(use);
    expect_force(cracked, 2.);
  }

  /** Surfaces are where the mesh was at the last reinit(). */
  void check_moved_mesh()
  {
    Use use;
    use.two_bodies = true;
    Program program(use);
    const auto said = [&](const auto &call) { return message_of(call); };
    program.solve(program.bodies());
    program.contact.commit(program.u);
    // To write it to a file, and back.
    dealii::GridTools::scale(1.1, program.mesh);
    dealii::GridTools::scale(1. / 1.1, program.mesh);
    expect(said([&] { program.iterate(); }).empty(), "a mesh that was back");
    program.contact.detect(program.u);
    program.mesh.begin_active()->vertex(0)[1] -= 0.01;
    const std::vector<std::string> words = {"(-1 -1.01)", "(-1 -1)",
                                            "reinit()"};
    expect_words(said(
                     [&]
                     {
                       program.contact.solve(program.matrix, program.residual,
                                             program.increment);
                     }),
                 words);
    expect_words(said([&] { program.contact.detect(program.u); }), words);
    program.prepare(program.bodies());
    expect(said([&] { program.iterate(); }).empty(), "after reinit()");

    // Mappings move bodies, and no vertices of the mesh.
    Program eulerian(use);
    Vector motion(eulerian.u);
    expect(motion.linfty_norm() > 0., "a mapping that moves nothing");
    const dealii::MappingQEulerian<dim, Vector> mapping(1, eulerian.dof_handler,
                                                        motion);
    eulerian.contact.set_pairs({eulerian.bodies()});
    eulerian.contact.reinit(mapping, eulerian.dof_handler,
                            eulerian.constraints);
    eulerian.iterate();
    motion *= 1.1;
    expect_words(said([&] { eulerian.iterate(); }),
                 {"A vertex of the mesh", "mapping", "reinit()"});
    eulerian.contact.reinit(mapping, eulerian.dof_handler,
                            eulerian.constraints);
    expect(said([&] { eulerian.iterate(); }).empty(), "another mapping");

    for (const double reach :
         {-1., std::numeric_limits<double>::quiet_NaN(), 1e300})
    {
      Program wrong(use);
      ContactPair<dim> pair = wrong.bodies();
      pair.reach = reach;
      expect_words(message_of([&] { wrong.solve(pair); }),
                   {"lower on upper", "its reach"});
    }

    Program renumbered(use);
    renumbered.solve(renumbered.bodies());
    dealii::DoFRenumbering::Cuthill_McKee(renumbered.dof_handler);
    expect_words(said([&] { renumbered.contact.detect(renumbered.u); }),
                 {"unknowns have other numbers", "reinit()"});
  }

  /** Displacements that are not those of the constraints. */
  void check_violations()
  {
    Use use;
    use.two_bodies = true;
    Program program(use);
    program.solve(program.bodies());
    const auto found = [&](const Vector &u)
    { return program.contact.checks().examine(u).findings; };
    for (const ContactFinding &finding : found(program.u))
      expect(finding.failure != ABUT_FAILURE_UNBALANCED, finding.text);
    // Prescribed by 0.05 at the top, and 0.
    Vector forgotten(program.u);
    for (const auto &line : program.constraints.get_lines())
      if (line.inhomogeneity != 0.)
        forgotten(line.index) = 0.;
    const auto findings = found(forgotten);
    const auto seen =
        std::find_if(findings.begin(), findings.end(),
                     [](const ContactFinding &finding)
                     { return finding.failure == ABUT_FAILURE_UNBALANCED; });
    expect(seen != findings.end()
               && std::abs(seen->numbers.front().second - 0.05) < 1e-12,
           "prescribed values that are not in u");
  }

  /** What is not finite, zero or left over in K and R. */
  void check_values()
  {
    Program program({});
    const auto solve = [&](Program &wrong)
    {
      return message_of(
          [&]
          {
            wrong.contact.detect(wrong.u);
            wrong.contact.solve(wrong.matrix, wrong.residual, wrong.increment);
          });
    };
    program.prepare(Program::under(0.98));
    program.find_residual();
    expect(solve(program).empty(), "right values");
    const auto held = program.constraints.get_lines()[0].index;
    program.residual(held) = 1.;
    expect_words(solve(program), {"residual given to solve()", "eliminate",
                                  "set_zero()", "row " + std::to_string(held)});
    program.residual = std::numeric_limits<double>::quiet_NaN();
    expect_words(solve(program),
                 {"residual given to solve()", "not finite", "row 0"});
    program.residual = 0.;
    program.matrix = 0.;
    expect_words(solve(program), {"matrix given to solve()", "zero"});

    ContactPair<dim> rough = Program::under(0.98);
    auto friction = std::make_shared<Friction<dim>>();
    friction->cap = [](const Point<dim> &) { return 0.3; };
    rough.friction = friction;
    expect_words(message_of([&] { Program({}).solve(rough); }),
                 {"wall", "without a coefficient", "cap"});
  }

  /** An iteration that is looked at before its end, or goes wrong. */
  void check_iteration()
  {
    Program program({});
    program.prepare(Program::under(0.999));
    program.contact.detect(program.u);
    program.find_residual();
    program.contact.solve(program.matrix, program.residual, program.increment);
    program.u += program.increment;
    expect(program.contact.update(program.u), "a second step");
    const auto seen =
        program.contact.checks().examine(program.u, program.residual).findings;
    expect(seen.size() == 1 && seen[0].failure == ABUT_FAILURE_STEP_LIMIT
               && seen[0].is_error,
           "nothing but that it has no end: " + std::to_string(seen.size()));
    expect_words(seen[0].text, {"has not ended", "update()"});

    // The surface comes to the wall in the first step, from out of reach.
    Use use;
    use.lift = 0.7;
    Program lifted(use);
    lifted.solve(Program::under(1.5));
    expect_words(findings(lifted, ABUT_FAILURE_NO_PARTNER, true),
                 {"wall", "by up to 0.2", "out of reach", "0.7", "reach"});
    expect(findings(lifted, ABUT_FAILURE_UNSEEN, true).empty(),
           "nothing is between nodes");
    lifted.iterate();
    expect(findings(lifted, ABUT_FAILURE_NO_PARTNER, true).empty()
               && lifted.contact.results().pairs()[0].n_active > 0,
           "detect() at this displacement");
  }

  void check_history()
  {
    Use use;
    use.two_bodies = true;
    Program program(use);
    ContactPair<dim> rough = program.bodies();
    auto friction = std::make_shared<Friction<dim>>();
    friction->coefficient = [](const Point<dim> &) { return 0.3; };
    rough.friction = friction;
    program.solve(rough);
    program.contact.commit(program.u);
    std::stringstream saved;
    program.contact.state().save(saved);

    const auto load = [&](const ContactPair<dim> &pair, const Vector &committed)
    {
      std::istringstream stream(saved.str());
      Program again(use);
      again.u = program.u;
      again.prepare(pair);
      again.contact.state().load(stream);
      again.contact.state().set_committed(committed);
      again.contact.detect(again.u);
      std::string warnings;
      const PairCheck seen = again.contact.checks().pairs()[0];
      for (const Message &warning : seen.warnings)
        warnings += warning.text;
      return warnings;
    };
    expect(load(rough, program.u).empty(), "the same pair");
    ContactPair<dim> other = program.bodies();
    expect_words(message_of([&] { load(other, program.u); }),
                 {"lower on upper", "friction"});
    other = rough;
    std::swap(other.secondary, other.primary);
    expect_words(message_of([&] { load(other, program.u); }),
                 {"lower on upper", "secondary"});
    // As in another numbering of the unknowns.
    Vector reversed(program.u);
    for (unsigned int k = 0; k < reversed.size(); ++k)
      reversed(k) = program.u(reversed.size() - 1 - k);
    expect_words(load(rough, reversed), {"set_committed()", "numbering"});

    program.prepare(rough);
    std::ifstream none("there is no such file");
    expect_words(message_of([&] { program.contact.state().load(none); }),
                 {"empty or not open"});
  }

  void check_shapes()
  {
    const Point<2> at(1., 4.);
    std::vector<double> distance;
    RigidObstacle<2>(sphere<2>(Point<2>(1., 1.), 0.5)).distance({at}, distance);
    expect(std::abs(distance[0] - 2.5) < 1e-15, "a disc");
    RigidObstacle<2>(cylinder<2>(Point<2>(1., 1.), Tensor<1, 2>(), 0.5))
        .distance({at}, distance);
    expect(std::abs(distance[0] - 2.5) < 1e-15, "a cylinder in the plane");
    RigidObstacle<3>(
        cylinder<3>(Point<3>(1., 7., 1.), Tensor<1, 3>({0., 2., 0.}), 0.5))
        .distance({Point<3>(1., 0., 4.)}, distance);
    expect(std::abs(distance[0] - 2.5) < 1e-15, "a cylinder");
    RigidObstacle<3>(sphere<3>(Point<3>(1., 0., 1.), 0.5))
        .distance({Point<3>(1., 0., 4.)}, distance);
    expect(std::abs(distance[0] - 2.5) < 1e-15, "a ball");
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_residual();
  check_prescribed();
  check_pressure();
  check_pairs();
  check_constraints();
  check_shared_vertices();
  check_moved_mesh();
  check_violations();
  check_values();
  check_iteration();
  check_history();
  check_shapes();
  return hosts::good ? 0 : 1;
}

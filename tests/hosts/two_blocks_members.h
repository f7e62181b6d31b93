// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_TWO_BLOCKS_MEMBERS_H
#define ABUT_TESTS_TWO_BLOCKS_MEMBERS_H

/** @file
 * Members of TwoBlocks, for who instantiates it: two_blocks.cc for distributed
 * meshes, patch_serial.cc for others. */

#include "two_blocks.h"

#include <abut/dealii/distribute.h>
#include <abut/dealii/versions.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/hp/fe_values.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools.h>

namespace abut::hosts
{
  template <int dim, class Mesh>
  TwoBlocks<dim, Mesh>::TwoBlocks(const Case &run, const MPI_Comm communicator)
      : run_(run),
        triangulation_(make_triangulation(communicator)),
        communicator_(abut::versions::communicator(*triangulation_)),
        mapping_(make_collections()),
        rotation_(rotation<dim>(!run.pressed)),
        dof_handler_(*triangulation_),
        contact_(communicator_)
  {
  }

  template <int dim, class Mesh>
  const dealii::hp::MappingCollection<dim> &
  TwoBlocks<dim, Mesh>::make_collections()
  {
    add_element(run_.simplices, run_.degree);
    if (run_.other_degree > 0)
      add_element(!run_.simplices, run_.other_degree);
    return mappings_;
  }

  template <int dim, class Mesh>
  void TwoBlocks<dim, Mesh>::add_element(const bool simplices,
                                         const unsigned int degree)
  {
    if (simplices)
    {
      fe_.push_back(
          dealii::FESystem<dim>(dealii::FE_SimplexP<dim>(degree), dim));
      mappings_.push_back(dealii::MappingFE<dim>(dealii::FE_SimplexP<dim>(1)));
    }
    else
    {
      fe_.push_back(dealii::FESystem<dim>(dealii::FE_Q<dim>(degree), dim));
      mappings_.push_back(dealii::MappingQ<dim>(1));
    }
    points_.push_back(rule<dim>(simplices, degree));
    face_points_.push_back(rule<dim - 1>(simplices, degree));
  }

  template <int dim, class Mesh>
  ContactPair<dim> TwoBlocks<dim, Mesh>::pair() const
  {
    ContactPair<dim> pair;
    pair.name = "interface";
    pair.secondary = {run_.upper_is_secondary ? upper_interface
                                              : lower_interface};
    pair.primary = {run_.upper_is_secondary ? lower_interface
                                            : upper_interface};
    pair.tied = run_.tied;
    pair.holds_body = run_.pressed;
    return pair;
  }

  template <int dim, class Mesh>
  void TwoBlocks<dim, Mesh>::prepare(const std::vector<ContactPair<dim>> &pairs)
  {
    make_mesh();
    setup();
    assemble();
    contact_.set_pairs(pairs);
    SolverParameters solver;
    solver.linear = SolverParameters::Linear::direct;
    contact_.set_parameters(run_.method, solver);
    contact_.reinit(mapping_, dof_handler_, constraints_);
  }

  template <int dim, class Mesh>
  la::Vector TwoBlocks<dim, Mesh>::displacement(const double lift) const
  {
    la::Vector u(owned_, communicator_);
    Tensor<1, dim> normal;
    normal[dim - 1] = lift;
    normal = rotation_ * normal;
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (!cell->is_artificial() && cell->material_id() == 1)
      {
        dofs.resize(cell->get_fe().n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (owned_.is_element(dofs[i]))
            u(dofs[i]) =
                normal[cell->get_fe().system_to_component_index(i).first];
      }
    u.compress(dealii::VectorOperation::insert);
    return u;
  }

  template <int dim, class Mesh> Errors TwoBlocks<dim, Mesh>::solve()
  {
    prepare({pair()});
    la::Vector u = start();
    return solve(u);
  }

  template <int dim, class Mesh>
  Errors TwoBlocks<dim, Mesh>::solve(la::Vector &u)
  {
    la::Vector residual(u), increment(u);
    contact_.detect(u);
    Errors errors;
    const auto find_residual = [&]
    {
      stiffness_.vmult(residual, u);
      residual -= load_;
      constraints_.set_zero(residual);
    };
    const abut_law *law = run_.method.options.law;
    if (law != nullptr && law->outer == ABUT_OUTER_BARRIER)
    {
      find_residual();
      contact_.relax(stiffness_, residual, 1, u);
      constraints_.distribute(u);
    }
    do
    {
      find_residual();
      errors.steps += contact_.solve(stiffness_, residual, increment).n_systems;
      u += increment;
      constraints_.distribute(u);
    } while (contact_.update(u));
    measure(u, errors);
    return errors;
  }

  template <int dim, class Mesh>
  la::Vector TwoBlocks<dim, Mesh>::repartition(const la::Vector &u,
                                               const unsigned int weight,
                                               const bool refine)
  {
    la::Vector displacement(owned_, relevant_, communicator_),
        pressure(displacement);
    // Copied, because a temporary would be moved, and the ghosts be lost.
    const la::Vector present = contact_.results().pressure();
    displacement = u;
    pressure = present;
    if (refine)
    {
      flag(0.5, 0.25);
      triangulation_->prepare_coarsening_and_refinement();
    }
    abut::versions::SolutionTransfer<dim, la::Vector> transfer(dof_handler_);
    transfer.prepare_for_coarsening_and_refinement(
        std::vector<const la::Vector *>{&displacement, &pressure});
    const auto connection = triangulation_->signals.weight.connect(
        [weight](const auto &cell, const auto) -> unsigned int
        { return cell->material_id() == 1 ? weight : 1000; });
    if (refine)
      triangulation_->execute_coarsening_and_refinement();
    else
      triangulation_->repartition();
    connection.disconnect();
    setup();
    assemble();
    la::Vector moved(owned_, communicator_), p(moved);
    std::vector<la::Vector *> targets = {&moved, &p};
    transfer.interpolate(targets);
    constraints_.distribute(moved);
    forget();
    contact_.state().set_pressure(p);
    return moved;
  }

  template <int dim, class Mesh>
  void TwoBlocks<dim, Mesh>::lift_supports(const double lift)
  {
    la::Vector shift(owned_, relevant_, communicator_);
    const la::Vector owned_shift = displacement(lift);
    shift = owned_shift;
    for (const auto dof : relevant_)
      if (constraints_.is_constrained(dof)
          && constraints_.get_constraint_entries(dof)->empty())
        constraints_.set_inhomogeneity(dof, constraints_.get_inhomogeneity(dof)
                                                + shift(dof));
  }

  template <int dim, class Mesh> la::Vector TwoBlocks<dim, Mesh>::start() const
  {
    la::Vector u(owned_, communicator_);
    constraints_.distribute(u);
    return u;
  }

  template <int dim, class Mesh>
  la::Vector TwoBlocks<dim, Mesh>::sideways(const double way) const
  {
    la::Vector u(owned_, communicator_);
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (!cell->is_artificial() && cell->material_id() == 1)
      {
        dofs.resize(cell->get_fe().n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (owned_.is_element(dofs[i])
              && cell->get_fe().system_to_component_index(i).first == 0)
            u(dofs[i]) = way;
      }
    u.compress(dealii::VectorOperation::insert);
    return u;
  }

  template <int dim, class Mesh> void TwoBlocks<dim, Mesh>::make_mesh()
  {
    std::vector<Point<dim>> vertices;
    std::vector<dealii::CellData<dim>> cells;
    dealii::SubCellData faces;
    for (int block = 0; block < 2; ++block)
    {
      Point<dim> lower, upper;
      for (int d = 0; d < dim; ++d)
        upper[d] = 1.;
      lower[dim - 1] = block - 1;
      upper[dim - 1] = block;
      dealii::Triangulation<dim> part;
      const std::vector<unsigned int> n_cells(dim, run_.cells[block]);
      if (run_.has_simplices(block))
        dealii::GridGenerator::subdivided_hyper_rectangle_with_simplices(
            part, n_cells, lower, upper);
      else
        dealii::GridGenerator::subdivided_hyper_rectangle(part, n_cells, lower,
                                                          upper);
      for (const auto &face : part.active_face_iterators())
        if (face->at_boundary())
        {
          const double z = face->center()[dim - 1];
          if (std::abs(z - lower[dim - 1]) < 1e-12)
            face->set_boundary_id(block == 0 ? bottom : upper_interface);
          if (std::abs(z - upper[dim - 1]) < 1e-12)
            face->set_boundary_id(block == 0 ? lower_interface : top);
        }
      part.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
      auto [v, c, f] = dealii::GridTools::get_coarse_mesh_description(part);
      if (run_.has_simplices(block))
        for (Point<dim> &p : v)
          for (int d = 0; d < dim - 1; ++d)
            p[d] += (block == 0 ? 0.2 : -0.3) * p[d] * (1. - p[d]);
      if (block == 1)
        for (Point<dim> &p : v)
          p[dim - 1] += run_.separation + run_.tilt * p[0];
      const auto shift = [&](auto &list)
      {
        for (auto &entity : list)
          for (auto &vertex : entity.vertices)
            vertex += vertices.size();
      };
      shift(c);
      shift(f.boundary_lines);
      shift(f.boundary_quads);
      for (auto &cell : c)
        cell.material_id = block;
      cells.insert(cells.end(), c.begin(), c.end());
      faces.boundary_lines.insert(faces.boundary_lines.end(),
                                  f.boundary_lines.begin(),
                                  f.boundary_lines.end());
      faces.boundary_quads.insert(faces.boundary_quads.end(),
                                  f.boundary_quads.begin(),
                                  f.boundary_quads.end());
      vertices.insert(vertices.end(), v.begin(), v.end());
    }
    for (Point<dim> &p : vertices)
      p = Point<dim>(rotation_ * Tensor<1, dim>(p));
    create(vertices, cells, faces);
    if (run_.has_hanging_nodes())
      refine();
  }

  template <int dim, class Mesh>
  void
  TwoBlocks<dim, Mesh>::create(const std::vector<Point<dim>> &vertices,
                               const std::vector<dealii::CellData<dim>> &cells,
                               const dealii::SubCellData &faces)
  {
    using Parts = dealii::parallel::fullydistributed::Triangulation<dim>;
    if constexpr (std::is_same_v<Mesh, Parts>)
    {
      // Both blocks are cut, and no rank has cells that follow each other.
      dealii::Triangulation<dim> all;
      all.create_triangulation(vertices, cells, faces);
      const unsigned int n_ranks = MPI::n_mpi_processes(communicator_);
      for (const auto &cell : all.active_cell_iterators())
        cell->set_subdomain_id(cell->active_cell_index() / 2 % n_ranks);
      triangulation_->create_triangulation(
          dealii::TriangulationDescription::Utilities::
              create_description_from_triangulation(all, communicator_));
    }
    else
      triangulation_->create_triangulation(vertices, cells, faces);
  }

  template <int dim, class Mesh>
  void TwoBlocks<dim, Mesh>::flag(const double towards, const double depth)
  {
    const Tensor<2, dim> back = transpose(rotation_);
    for (const auto &cell : triangulation_->active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const Tensor<1, dim> x = back * Tensor<1, dim>(cell->center());
        if (x[0] < towards && x[0] > 0.2 && std::abs(x[dim - 1]) < depth)
          cell->set_refine_flag();
      }
  }

  template <int dim, class Mesh> void TwoBlocks<dim, Mesh>::refine()
  {
    for (int cycle = 0; cycle < 2; ++cycle)
    {
      flag(cycle == 0 ? 0.9 : 0.35, 0.5);
      triangulation_->execute_coarsening_and_refinement();
      if (dim == 3)
        return;
    }
  }

  template <int dim, class Mesh> void TwoBlocks<dim, Mesh>::setup()
  {
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (cell->is_locally_owned() && run_.other_degree > 0)
        cell->set_active_fe_index(cell->material_id());
    dof_handler_.distribute_dofs(fe_);
    owned_ = dof_handler_.locally_owned_dofs();
    relevant_ = dealii::DoFTools::extract_locally_relevant_dofs(dof_handler_);
    abut::versions::reinit(constraints_, owned_, relevant_);
    dealii::DoFTools::make_hanging_node_constraints(dof_handler_, constraints_);
    n_hanging_ = MPI::sum(constraints_.n_constraints(), communicator_);
    if (run_.pressed)
      let_slide();
    else
      move_ends();
    constraints_.close();
    dealii::DynamicSparsityPattern pattern(relevant_);
    dealii::DoFTools::make_sparsity_pattern(dof_handler_, pattern, constraints_,
                                            false);
    dealii::SparsityTools::distribute_sparsity_pattern(
        pattern, owned_, communicator_, relevant_);
    stiffness_.reinit(owned_, owned_, pattern, communicator_);
    load_.reinit(owned_, communicator_);
  }

  template <int dim, class Mesh> void TwoBlocks<dim, Mesh>::move_ends()
  {
    dealii::VectorTools::interpolate_boundary_values(
        mapping_, dof_handler_, bottom, ExactDisplacement<dim>(material(false)),
        constraints_);
    Tensor<1, dim> shift;
    shift[0] = run_.aside;
    dealii::VectorTools::interpolate_boundary_values(
        mapping_, dof_handler_, top,
        ExactDisplacement<dim>(material(true), shift), constraints_);
    if (run_.is_die)
      dealii::VectorTools::interpolate_boundary_values(
          mapping_, dof_handler_, upper_interface,
          dealii::Functions::ZeroFunction<dim>(dim), constraints_);
  }

  template <int dim, class Mesh> void TwoBlocks<dim, Mesh>::let_slide()
  {
    dealii::ComponentMask up(dim, false);
    up.set(dim - 1, true);
    dealii::VectorTools::interpolate_boundary_values(
        mapping_, dof_handler_, bottom,
        dealii::Functions::ZeroFunction<dim>(dim), constraints_, up);
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int v : cell->vertex_indices())
        {
          const Point<dim> &x = cell->vertex(v);
          Point<dim> corner;
          corner[dim - 1] = cell->material_id() == 1 ? 1. : -1.;
          if (x.distance(corner) < 1e-10
              && !(run_.slides && cell->material_id() == 1))
            for (int d = 0; d < dim - 1; ++d)
              constraints_.add_line(cell->vertex_dof_index(v, d));
        }
  }

  template <int dim, class Mesh> void TwoBlocks<dim, Mesh>::press()
  {
    dealii::hp::FEFaceValues<dim> all_values(mappings_, fe_, face_points_,
                                             dealii::update_values
                                                 | dealii::update_JxW_values);
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == top)
          {
            all_values.reinit(cell, cell->face_iterator_to_index(face));
            const auto &values = all_values.get_present_fe_values();
            dofs.resize(cell->get_fe().n_dofs_per_cell());
            dealii::Vector<double> force(dofs.size());
            for (unsigned int i = 0; i < force.size(); ++i)
              for (const unsigned int q : values.quadrature_point_indices())
                force(i) -=
                    values.shape_value_component(i, q, dim - 1) * values.JxW(q);
            cell->get_dof_indices(dofs);
            abut::versions::distribute_local_to_global(constraints_, force,
                                                       dofs, load_);
          }
  }

  template <int dim, class Mesh> void TwoBlocks<dim, Mesh>::assemble()
  {
    dealii::hp::FEValues<dim> all_values(mappings_, fe_, points_,
                                         dealii::update_gradients
                                             | dealii::update_JxW_values);
    const dealii::FEValuesExtractors::Vector displacement(0);
    std::vector<dealii::types::global_dof_index> dofs;
    dealii::AffineConstraints<double> homogeneous;
    abut::versions::reinit(homogeneous, owned_, relevant_);
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const Material &m = material(cell->material_id() == 1);
        all_values.reinit(cell);
        const auto &values = all_values.get_present_fe_values();
        const unsigned int n = cell->get_fe().n_dofs_per_cell();
        dofs.resize(n);
        dealii::FullMatrix<double> matrix(n, n);
        for (const unsigned int q : values.quadrature_point_indices())
          for (unsigned int i = 0; i < n; ++i)
          {
            const auto e = values[displacement].symmetric_gradient(i, q);
            for (unsigned int j = 0; j < n; ++j)
            {
              const auto f = values[displacement].symmetric_gradient(j, q);
              matrix(i, j) +=
                  (2. * m.mu() * (e * f) + m.lambda() * trace(e) * trace(f))
                  * values.JxW(q);
            }
          }
        cell->get_dof_indices(dofs);
        constraints_.distribute_local_to_global(matrix, dofs, stiffness_);
        // What prescribed displacements add to the load of free unknowns.
        dealii::Vector<double> prescribed(n), force(n);
        for (unsigned int i = 0; i < n; ++i)
          if (constraints_.is_inhomogeneously_constrained(dofs[i]))
            prescribed(i) = constraints_.get_inhomogeneity(dofs[i]);
        matrix.vmult(force, prescribed);
        force *= -1.;
        abut::versions::distribute_local_to_global(constraints_, force, dofs,
                                                   load_);
      }
    if (run_.pressed)
      press();
    stiffness_.compress(dealii::VectorOperation::add);
    load_.compress(dealii::VectorOperation::add);
    constraints_.set_zero(load_);
  }

  template <int dim, class Mesh>
  void TwoBlocks<dim, Mesh>::measure(const la::Vector &u, Errors &errors) const
  {
    la::Vector ghosted(owned_, relevant_, communicator_);
    ghosted = u;
    const auto results = contact_.results().pairs();
    errors.reason = contact_.iteration().reason;
    errors.area = results[0].covered_area;
    errors.force = results[0].secondary_force.norm();
    errors.imbalance = results[0].force_imbalance;
    errors.moment_imbalance = results[0].moment_imbalance;
    errors.n_rows = results[0].n_rows;
    errors.n_active = results[0].n_active;
    errors.hanging = n_hanging_;
    measure_stress(ghosted, errors);
    measure_pressure(errors);
    if (run_.yields)
      errors.displacement = 0.;
  }

  template <int dim, class Mesh>
  void TwoBlocks<dim, Mesh>::measure_stress(const la::Vector &u,
                                            Errors &errors) const
  {
    const double p = mean_pressure(errors);
    dealii::hp::FEValues<dim> all_values(
        mappings_, fe_, points_,
        dealii::update_gradients | dealii::update_values
            | dealii::update_quadrature_points);
    const dealii::FEValuesExtractors::Vector displacement(0);
    std::vector<dealii::SymmetricTensor<2, dim>> strain;
    std::vector<Tensor<1, dim>> value;
    Tensor<1, dim> normal;
    normal[dim - 1] = 1.;
    normal = rotation_ * normal;
    double scale = 0.;
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const Material &m = material(cell->material_id() == 1);
        const ExactDisplacement<dim> exact(m);
        all_values.reinit(cell);
        const auto &values = all_values.get_present_fe_values();
        strain.resize(values.n_quadrature_points);
        value.resize(values.n_quadrature_points);
        values[displacement].get_function_symmetric_gradients(u, strain);
        values[displacement].get_function_values(u, value);
        for (const unsigned int q : values.quadrature_point_indices())
        {
          dealii::SymmetricTensor<2, dim> stress = 2. * m.mu() * strain[q];
          for (int i = 0; i < dim; ++i)
            stress[i][i] += m.lambda() * trace(strain[q]);
          errors.normal_stress = std::max(
              errors.normal_stress, std::abs(normal * stress * normal + p));
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              errors.stress =
                  std::max(errors.stress,
                           std::abs(stress[i][j] + p * normal[i] * normal[j]));
          const auto e = exact.displacement(values.quadrature_point(q));
          scale = std::max(scale, e.norm());
          errors.displacement =
              std::max(errors.displacement, (value[q] - e).norm());
        }
      }
    errors.stress = MPI::max(errors.stress, communicator_);
    errors.normal_stress = MPI::max(errors.normal_stress, communicator_);
    errors.displacement = MPI::max(errors.displacement, communicator_)
                          / MPI::max(scale, communicator_);
  }

  template <int dim, class Mesh>
  void TwoBlocks<dim, Mesh>::measure_pressure(Errors &errors) const
  {
    const la::Vector p = contact_.results().pressure(),
                     status = contact_.results().status();
    const double mean = mean_pressure(errors);
    la::Vector pressure(owned_, relevant_, communicator_), has(pressure);
    pressure = p;
    has = status;
    Tensor<1, dim> normal;
    normal[dim - 1] = run_.upper_is_secondary ? -1. : 1.;
    normal = rotation_ * normal;
    const auto side =
        run_.upper_is_secondary ? upper_interface : lower_interface;
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == side)
          {
            const auto &fe = cell->get_fe();
            dofs.resize(fe.n_dofs_per_face());
            face->get_dof_indices(dofs, cell->active_fe_index());
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (has(dofs[i]) > 0.)
                errors.pressure = std::max(
                    errors.pressure,
                    std::abs(pressure(dofs[i])
                             - mean
                                   * normal[fe.face_system_to_component_index(i)
                                                .first]));
          }
    errors.pressure = MPI::max(errors.pressure, communicator_);
  }

  template <int dim, class Mesh>
  std::unique_ptr<Mesh> TwoBlocks<dim, Mesh>::make_triangulation(
      [[maybe_unused]] const MPI_Comm communicator)
  {
    using Shared = dealii::parallel::shared::Triangulation<dim>;
    if constexpr (std::is_same_v<Mesh, Shared>)
      return std::make_unique<Mesh>(communicator, Mesh::none, true,
                                    Shared::partition_zorder);
    else if constexpr (std::is_constructible_v<Mesh, MPI_Comm>)
      return std::make_unique<Mesh>(communicator);
    else
      return std::make_unique<Mesh>();
  }
} // namespace abut::hosts

#endif

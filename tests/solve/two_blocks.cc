// SPDX-License-Identifier: LGPL-2.1-or-later
#include "two_blocks.h"

#include "solve/row_stiffness.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>

namespace abut::tests
{
  using dealii::types::global_dof_index;

  namespace
  {
    enum Boundary
    {
      outside,
      held,      ///< bottom of the lower block, top of the upper
      primary,   ///< top of the lower block
      secondary, ///< bottom of the upper block
      side_of_x, ///< face x = 0 of the upper block
      side_of_y  ///< face y = 0 of the upper block
    };

    /** The gap between the blocks. */
    constexpr double gap = 1e-3;

    /** Cells and vertices of one block, appended. */
    template <int dim>
    void append_block(const unsigned int n, const double height,
                      const unsigned int body,
                      std::vector<dealii::Point<dim>> &vertices,
                      std::vector<dealii::CellData<dim>> &cells)
    {
      dealii::Triangulation<dim> block;
      dealii::GridGenerator::subdivided_hyper_cube(block, n);
      const auto first = vertices.size();
      for (dealii::Point<dim> vertex : block.get_vertices())
      {
        vertex[dim - 1] += height;
        vertices.push_back(vertex);
      }
      for (const auto &cell : block.active_cell_iterators())
      {
        dealii::CellData<dim> data;
        for (const unsigned int v : cell->vertex_indices())
          data.vertices[v] = first + cell->vertex_index(v);
        data.material_id = body;
        cells.push_back(data);
      }
    }

    /** The facets of a side on all ranks, with the unknowns of their nodes. */
    template <int dim> struct Side
    {
      std::vector<double> position;
      std::vector<std::int32_t> connectivity;
      /** [nodes] first unknown of each node; others follow. */
      std::vector<global_dof_index> unknown;

      void add(const std::vector<double> &facets)
      {
        // Per node: the numbers of its unknowns, then its position.
        for (std::size_t k = 0; k < facets.size(); k += 1 + dim)
        {
          const auto dof = static_cast<global_dof_index>(facets[k]);
          const auto inserted =
              node.emplace(dof, static_cast<std::int32_t>(unknown.size()));
          if (inserted.second)
          {
            unknown.push_back(dof);
            position.insert(position.end(), &facets[k] + 1,
                            &facets[k] + 1 + dim);
          }
          connectivity.push_back(inserted.first->second);
        }
      }

      abut_surface_data data() const
      {
        abut_surface_data result = abut_surface_data_defaults();
        const int n_corners = 1 << (dim - 1);
        result.dimension = dim;
        result.kind = dim == 2 ? ABUT_FACET_LINE2 : ABUT_FACET_QUAD4;
        result.n_nodes = static_cast<std::int32_t>(unknown.size());
        result.n_facets =
            static_cast<std::int32_t>(connectivity.size()) / n_corners;
        result.connectivity = connectivity.data();
        result.position = position.data();
        return result;
      }

      std::map<global_dof_index, std::int32_t> node;
    };

    /** Corners of a face in the order that gives the outward normal. */
    template <int dim>
    std::vector<unsigned int>
    corners(const typename dealii::DoFHandler<dim>::cell_iterator &cell,
            const unsigned int face)
    {
      std::vector<unsigned int> order = {0, 1};
      if (dim == 3)
        order = {0, 1, 2, 3};
      std::vector<dealii::Point<3>> x;
      for (const unsigned int v : order)
      {
        dealii::Point<3> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = cell->face(face)->vertex(v)[d];
        x.push_back(point);
      }
      dealii::Tensor<1, 3> normal;
      if (dim == 2)
        normal = dealii::Point<3>((x[1] - x[0])[1], -(x[1] - x[0])[0], 0.);
      else
        normal = dealii::cross_product_3d(x[1] - x[0], x[2] - x[0]);
      const auto out = cell->face(face)->center() - cell->center();
      double cosine = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        cosine += normal[d] * out[d];
      if (cosine < 0.)
        std::swap(order[dim - 2], order[dim - 1]);
      return order;
    }
  } // namespace

  template <int dim>
  TwoBlocks<dim>::TwoBlocks(const MPI_Comm communicator,
                            const TwoBlocksOptions &options)
      : communicator(communicator),
        options(options),
        triangulation(communicator),
        dof_handler(triangulation)
  {
    make_mesh();
    dof_handler.distribute_dofs(
        dealii::FESystem<dim>(dealii::FE_Q<dim>(1), dim));
    set_supports();
    assemble();
    couple();
  }

  template <int dim> void TwoBlocks<dim>::make_mesh()
  {
    std::vector<dealii::Point<dim>> vertices;
    std::vector<dealii::CellData<dim>> cells;
    append_block<dim>(options.n_lower, 0., 0, vertices, cells);
    append_block<dim>(options.n_upper, 1. + gap, 1, vertices, cells);
    triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
    const auto is_at = [](const double x, const double y)
    { return std::abs(x - y) < 1e-9; };
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
        {
          const auto x = face->center();
          const double z = x[dim - 1];
          const bool upper = cell->material_id() == 1;
          Boundary id = outside;
          if (is_at(z, 0.) || is_at(z, 2. + gap))
            id = held;
          else if (is_at(z, 1.))
            id = primary;
          else if (is_at(z, 1. + gap))
            id = secondary;
          else if (upper && is_at(x[0], 0.))
            id = side_of_x;
          else if (upper && dim == 3 && is_at(x[1], 0.))
            id = side_of_y;
          face->set_boundary_id(id);
        }
    triangulation.refine_global(options.refinements);
    const double cosine = std::cos(options.angle);
    const double sine = std::sin(options.angle);
    if (options.angle != 0.)
      dealii::GridTools::transform(
          [&](const dealii::Point<dim> &x)
          {
            dealii::Point<dim> y = x;
            y[0] = cosine * x[0] + sine * x[dim - 1];
            y[dim - 1] = -sine * x[0] + cosine * x[dim - 1];
            return y;
          },
          triangulation);
  }

  template <int dim> void TwoBlocks<dim>::set_supports()
  {
    using Support = TwoBlocksOptions::Support;
    const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
    abut::versions::reinit(constraints, dof_handler.locally_owned_dofs(),
                           relevant);
    // What is held of the face or of the sides of the upper block.
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (cell->is_artificial())
        continue;
      std::vector<global_dof_index> dofs(
          dof_handler.get_fe().n_dofs_per_face());
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary())
          continue;
        const bool upper = cell->material_id() == 1;
        const auto id = cell->face(f)->boundary_id();
        std::vector<bool> held_component(dim, false);
        if (id == held && (!upper || options.support == Support::both))
          held_component.assign(dim, true);
        if (options.support == Support::slide && id == side_of_x)
          held_component[0] = true;
        if (options.support == Support::slide && id == side_of_y)
          held_component[1] = true;
        cell->face(f)->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (held_component
                  [dof_handler.get_fe().face_system_to_component_index(i).first]
              && constraints.can_store_line(dofs[i]))
            constraints.add_line(dofs[i]);
      }
    }
    constraints.close();
  }

  template <int dim> void TwoBlocks<dim>::assemble()
  {
    const auto &fe = dof_handler.get_fe();
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
    dealii::DynamicSparsityPattern pattern(relevant);
    dealii::DoFTools::make_sparsity_pattern(dof_handler, pattern, constraints,
                                            false);
    dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned,
                                                       communicator, relevant);
    stiffness.reinit(owned, owned, pattern, communicator);
    residual.reinit(owned, communicator);
    space.n_components = dim;
    space.n_bodies = 2;
    space.resize(owned.n_elements());
    space.names = {"lower block", "upper block"};

    const dealii::QGauss<dim> quadrature(2);
    dealii::FEValues<dim> values(fe, quadrature,
                                 dealii::update_gradients
                                     | dealii::update_values
                                     | dealii::update_JxW_values);
    const unsigned int n = fe.n_dofs_per_cell();
    // All cells of a body are equal.
    dealii::FullMatrix<double> matrix[2];
    dealii::Vector<double> force[2];
    std::vector<global_dof_index> dofs(n);
    const double nu = options.poisson;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (cell->is_artificial())
        continue;
      const int body = cell->material_id();
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < n; ++i)
        if (owned.is_element(dofs[i]))
        {
          const auto node = fe.system_to_component_index(i);
          space.set(owned.index_within_set(dofs[i]), node.first, body,
                    cell->vertex(node.second));
        }
      if (!cell->is_locally_owned())
        continue;
      if (matrix[body].m() == 0)
      {
        const double young = body == 0 ? options.young_ratio : 1.;
        const double mu = young / (2. + 2. * nu);
        const double lambda = young * nu / ((1. + nu) * (1. - 2. * nu));
        matrix[body].reinit(n, n);
        force[body].reinit(n);
        values.reinit(cell);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int ci = fe.system_to_component_index(i).first;
            const auto gi = values.shape_grad(i, q);
            force[body][i] += values.shape_value(i, q) * values.JxW(q)
                              * (ci == dim - 1 ? -1. : 0.2) * (body + 1);
            for (unsigned int j = 0; j < n; ++j)
            {
              const unsigned int cj = fe.system_to_component_index(j).first;
              const auto gj = values.shape_grad(j, q);
              matrix[body](i, j) +=
                  (lambda * gi[ci] * gj[cj] + mu * gi[cj] * gj[ci]
                   + (ci == cj ? mu * (gi * gj) : 0.))
                  * values.JxW(q);
            }
          }
      }
      constraints.distribute_local_to_global(matrix[body], force[body], dofs,
                                             stiffness, residual);
    }
    stiffness.compress(dealii::VectorOperation::add);
    residual.compress(dealii::VectorOperation::add);
    residual *= -1.;
  }

  template <int dim> void TwoBlocks<dim>::couple()
  {
    Side<dim> sides[2];
    for (const Boundary id : {primary, secondary})
    {
      std::vector<double> facets;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary()
                && cell->face(f)->boundary_id() == id)
              for (const unsigned int v : corners<dim>(cell, f))
              {
                const auto vertex =
                    dealii::GeometryInfo<dim>::face_to_cell_vertices(
                        f, v, cell->face_orientation(f), cell->face_flip(f),
                        cell->face_rotation(f));
                facets.push_back(cell->vertex_dof_index(vertex, 0));
                for (unsigned int d = 0; d < dim; ++d)
                  facets.push_back(cell->vertex(vertex)[d]);
              }
      for (const auto &part :
           dealii::Utilities::MPI::all_gather(communicator, facets))
        sides[id == primary ? 0 : 1].add(part);
    }
    const auto lower = shim::create_surface(context.get(), sides[0].data());
    const auto upper = shim::create_surface(context.get(), sides[1].data());

    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    std::vector<std::uint8_t> wanted;
    for (const auto dof : sides[1].unknown)
      wanted.push_back(owned.is_element(dof));
    abut_coupling_options settings = abut_coupling_defaults();
    settings.discretisation = options.constants
                                  ? ABUT_DISCRETISATION_QUADRATURE_POINT
                                  : options.discretisation;
    abut_coupling *coupling = nullptr;
    shim::check(context.get(),
                abut_coupling_create(context.get(), upper.get(), lower.get(),
                                     &settings, &coupling));
    abut_coupling_nodes nodes = abut_coupling_nodes_defaults();
    nodes.wanted = wanted.data();
    const auto contact = shim::create_points(context.get(), dim);
    const abut_coupling_target target =
        abut_coupling_target_defaults(contact.get());
    shim::check(context.get(),
                abut_coupling_build(coupling, &nodes, 0., &target));
    abut_coupling_view view = {};
    abut_points_view points = {};
    shim::check(context.get(), abut_coupling_get(coupling, &view));
    shim::check(context.get(), abut_points_get(contact.get(), &points));

    std::map<std::int64_t, std::vector<int>> order;
    for (int j = 0; j < view.n_points; ++j)
      order[options.constants
                ? view.facet[j]
                : static_cast<std::int64_t>(sides[1].unknown[view.node[j]])]
          .push_back(j);
    for (const auto &[id, parts] : order)
    {
      double weight = 0., gap = 0.;
      for (const int j : parts)
        weight += points.weight[j];
      std::map<std::int64_t, double> entries;
      for (const int j : parts)
      {
        const double part = points.weight[j] / weight;
        const auto add =
            [&](const global_dof_index first, const double coefficient)
        {
          for (unsigned int d = 0; d < dim; ++d)
            if (!constraints.is_constrained(first + d)
                && points.frame[j * dim + d] != 0.)
              entries[static_cast<std::int64_t>(first + d)] +=
                  part * coefficient * points.frame[j * dim + d];
        };
        const auto n_secondary =
            static_cast<std::int32_t>(sides[1].unknown.size());
        for (auto e = points.start[j]; e < points.start[j + 1]; ++e)
          add(points.node[e] < n_secondary
                  ? sides[1].unknown[points.node[e]]
                  : sides[0].unknown[points.node[e] - n_secondary],
              -points.coefficient[e]);
        gap += part * points.gap[j];
      }
      std::vector<std::int32_t> columns;
      std::vector<double> values;
      for (const auto &[column, value] : entries)
      {
        columns.push_back(static_cast<std::int32_t>(column));
        values.push_back(value);
      }
      shim::check(context.get(),
                  abut_points_append_scalar(
                      row_set.get(), id, weight, gap, ABUT_POINT_CONTACT,
                      static_cast<std::int32_t>(columns.size()), columns.data(),
                      values.data()));
    }
    abut_coupling_destroy(&coupling);
    shim::check(context.get(), abut_points_get(row_set.get(), &rows));
    operation = solve::PointOperator(dof_handler.locally_owned_dofs(), rows,
                                     solve::NodeMap::numbered(0), communicator);
    row_stiffness = solve::row_stiffness(stiffness, operation);
    resize_laws(rows.n_points);
  }

  template <int dim> void TwoBlocks<dim>::set_constraint(const int i)
  {
    a[i] = 0.;
    b[i] = 1.;
    c[i] = rows.gap[i];
    pressure[i] = 0.;
    state[i] = ABUT_STATE_CLOSED;
  }

  template <int dim>
  void TwoBlocks<dim>::set_spring(const int i, const double kappa)
  {
    a[i] = 1. / (kappa * row_stiffness[i]);
    b[i] = 1.;
    c[i] = rows.gap[i];
    pressure[i] = 0.;
    state[i] = ABUT_STATE_CLOSED;
  }

  template <int dim> void TwoBlocks<dim>::set_open(const int i)
  {
    a[i] = 1.;
    b[i] = 0.;
    c[i] = pressure[i] = 0.;
    state[i] = ABUT_STATE_OPEN;
  }

  template <int dim>
  std::pair<double, double>
  TwoBlocks<dim>::errors(const la::Vector &increment) const
  {
    la::Vector force(residual);
    stiffness.vmult(force, increment);
    force.add(1., residual);
    std::vector<double> factor(rows.n_points), change(rows.n_points);
    operation.times(increment, change.data());
    double largest = 0., error = 0.;
    for (int i = 0; i < rows.n_points; ++i)
    {
      factor[i] = -rows.weight[i] * (pressure[i] + dp[i]);
      largest = std::max(largest, std::abs(b[i] * change[i]) + std::abs(c[i]));
      error = std::max(error, std::abs(a[i] * dp[i] + b[i] * change[i] + c[i]));
    }
    operation.add_transposed(factor.data(), force);
    largest = dealii::Utilities::MPI::max(largest, communicator);
    error = dealii::Utilities::MPI::max(error, communicator);
    return {force.l2_norm() / residual.l2_norm(), error / largest};
  }

  template class TwoBlocks<2>;
  template class TwoBlocks<3>;
} // namespace abut::tests

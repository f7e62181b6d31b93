// SPDX-License-Identifier: LGPL-2.1-or-later
// Obstacles of scalar fields on triangles and tetrahedra, and on triangles and
// quadrilaterals of one mesh, beside exact solutions that are linear, or exact
// at the nodes.
#include "expect.h"

#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/mapping_by_cell.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/hp/fe_collection.h>
#include <deal.II/hp/fe_values.h>
#include <deal.II/numerics/vector_tools.h>

#include <iostream>

using namespace abut;
using namespace dealii;

namespace
{
  /** -Laplace u = -load in the unit cube with the flux -flux at its top (side
   * 1); u is 0 on side 0 and not below -depth. */
  template <int dim> class Membrane
  {
  public:
    /** @param mixed whether the half x > 0.5 of a square is of quadrilaterals
     */
    Membrane(const unsigned int n,
             const std::function<types::boundary_id(const Point<dim> &)> &side,
             const bool mixed = false)
    {
      if (mixed)
        make_mixed_square(n);
      else
        GridGenerator::subdivided_hyper_cube_with_simplices(mesh, n);
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(side(face->center()));
      for (const auto &cell : dofs.active_cell_iterators())
        if (mixed && cell->reference_cell().is_hyper_cube())
          cell->set_active_fe_index(1);
      dofs.distribute_dofs(mixed ? both : hp::FECollection<dim>(both[0]));
      const IndexSet &owned = dofs.locally_owned_dofs();
      abut::versions::reinit(constraints, owned, owned);
      VectorTools::interpolate_boundary_values(
          mapping, dofs, 0, Functions::ZeroFunction<dim>(), constraints);
      constraints.close();
      DynamicSparsityPattern pattern(owned);
      DoFTools::make_sparsity_pattern(dofs, pattern, constraints, false);
      matrix.reinit(owned, owned, pattern, MPI_COMM_SELF);
      rhs.reinit(owned, MPI_COMM_SELF);
    }

    /** Squares, the left ones cut into two triangles. */
    void make_mixed_square(const unsigned int n)
    {
      std::vector<Point<dim>> vertices;
      std::vector<CellData<dim>> cells;
      const auto add = [&](const std::vector<unsigned int> &corners)
      {
        cells.emplace_back(corners.size());
        cells.back().vertices = corners;
      };
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
        {
          Point<dim> x;
          x[0] = double(i) / n;
          x[1] = double(j) / n;
          vertices.push_back(x);
          const unsigned int v = vertices.size() - 1;
          if (i == n || j == n)
            continue;
          if (2 * i >= n)
            add({v, v + 1, v + n + 1, v + n + 2});
          else
          {
            add({v, v + 1, v + n + 1});
            add({v + 1, v + n + 2, v + n + 1});
          }
        }
      mesh.create_triangulation(vertices, cells, SubCellData());
    }

    void assemble(const double load, const double flux)
    {
      hp::FEValues<dim> all_values(
          mappings, both,
          hp::QCollection<dim>(QGaussSimplex<dim>(2), QGauss<dim>(2)),
          update_values | update_gradients | update_JxW_values);
      hp::FEFaceValues<dim> on_faces(
          mappings, both,
          hp::QCollection<dim - 1>(QGaussSimplex<dim - 1>(2),
                                   QGauss<dim - 1>(2)),
          update_values | update_JxW_values);
      std::vector<types::global_dof_index> indices;
      for (const auto &cell : dofs.active_cell_iterators())
      {
        all_values.reinit(cell);
        const FEValues<dim> &values = all_values.get_present_fe_values();
        const unsigned int n = cell->get_fe().n_dofs_per_cell();
        FullMatrix<double> k(n, n);
        Vector<double> f(n);
        for (unsigned int i = 0; i < n; ++i)
          for (const unsigned int q : values.quadrature_point_indices())
          {
            f(i) -= load * values.shape_value(i, q) * values.JxW(q);
            for (unsigned int j = 0; j < n; ++j)
              k(i, j) += values.shape_grad(i, q) * values.shape_grad(j, q)
                         * values.JxW(q);
          }
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == 1)
          {
            on_faces.reinit(cell, cell->face_iterator_to_index(face));
            const FEFaceValues<dim> &on_face = on_faces.get_present_fe_values();
            for (unsigned int i = 0; i < n; ++i)
              for (const unsigned int q : on_face.quadrature_point_indices())
                f(i) -= flux * on_face.shape_value(i, q) * on_face.JxW(q);
          }
        indices.resize(n);
        cell->get_dof_indices(indices);
        constraints.distribute_local_to_global(k, f, indices, matrix, rhs);
      }
      matrix.compress(VectorOperation::add);
      rhs.compress(VectorOperation::add);
    }

    /** u >= -depth everywhere, or on the sides @p ids. */
    void solve(const double depth, const std::set<types::boundary_id> &ids)
    {
      Obstacle<dim> obstacle;
      obstacle.lower =
          std::make_shared<Functions::ConstantFunction<dim>>(-depth);
      obstacle.boundary_ids = ids;
      contact.set_obstacle(obstacle);
      contact.reinit(mapping, dofs, constraints);
      u.reinit(rhs);
      la::Vector residual(rhs), step(rhs);
      contact.detect(u);
      do
      {
        matrix.vmult(residual, u);
        residual -= rhs;
        contact.solve(matrix, residual, step);
        u += step;
      } while (contact.update(u));
    }

    const hp::MappingCollection<dim> mappings{
        MappingFE<dim>(FE_SimplexP<dim>(1)), MappingQ<dim>(1)};
    const MappingByCell<dim> mapping{mappings};
    const hp::FECollection<dim> both{FE_SimplexP<dim>(1), FE_Q<dim>(1)};
    Triangulation<dim> mesh;
    DoFHandler<dim> dofs{mesh};
    AffineConstraints<double> constraints;
    la::Matrix matrix;
    la::Vector rhs, u;
    ContactAssembler<dim> contact{MPI_COMM_SELF};
  };

  /** u'' = 8 up to the place a with u = -4 a^2 where u' = 0: for the depth 1/4
   * a is 1/4, and what is left of the load, half of 8, is carried. */
  void check_string(const bool mixed)
  {
    Membrane<2> string(
        8,
        [](const Point<2> &x)
        { return x[0] < 1e-9 || x[0] > 1. - 1e-9 ? 0 : 2; },
        mixed);
    string.assemble(8., 0.);
    string.solve(0.25, {});
    const double force = string.contact.results().measures().force;
    Vector<float> depth;
    string.contact.checks().missed_depth(string.u, depth);
    std::cout << "force " << force << ", obstacle inside cells by "
              << depth.linfty_norm() << std::endl;
    hosts::expect(depth.linfty_norm() < 1e-9, "an obstacle outside of cells");
    hosts::expect(std::abs(std::abs(force) - 4.) < 1e-6, "force of a string");
  }

  /** u = -depth z: all of the top has the pressure flux - depth. */
  template <int dim>
  void check_top(const unsigned int n_cells, const bool mixed)
  {
    constexpr int up = dim - 1;
    Membrane<dim> block(
        n_cells,
        [](const Point<dim> &x) {
          return x[up] < 1e-9 ? 0 : x[up] > 1. - 1e-9 ? 1 : 2;
        },
        mixed);
    block.assemble(0., 3.);
    block.solve(0.5, {1});
    const la::Vector pressure = block.contact.results().pressure();
    double error = 0.;
    unsigned int n = 0;
    for (const auto &[dof, x] :
         abut::versions::support_points(block.mapping, block.dofs))
    {
      const bool is_on_top = x[up] > 1. - 1e-9;
      error = std::max({error, std::abs(block.u(dof) + 0.5 * x[up]),
                        std::abs(pressure(dof) - (is_on_top ? 2.5 : 0.))});
      n += is_on_top;
    }
    std::cout << "error " << error << " at " << n << " nodes" << std::endl;
    hosts::expect(n == std::pow(n_cells + 1, up) && error < 1e-7,
                  "pressure on the top");
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const bool mixed : {false, true})
    check_string(mixed);
  check_top<3>(3, false);
  check_top<2>(4, true);
  return hosts::good ? 0 : 1;
}

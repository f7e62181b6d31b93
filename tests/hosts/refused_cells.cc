// SPDX-License-Identifier: LGPL-2.1-or-later
// Cells, elements and methods for which there is no contact are refused, on all
// ranks and with the reason.
#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/mapping_by_cell.h>
#include <abut/dealii/rigid_obstacle.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/function.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_q_iso_q1.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_wedge_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/hp/fe_collection.h>

#include <iostream>

using namespace abut;
using namespace dealii;

namespace
{
  bool good = true;

  using Mesh = parallel::shared::Triangulation<3>;

  /** @p function throws @p Error on all ranks, with these words. */
  template <class Error, typename Function>
  void refuses(const std::string &words, const Function &function)
  {
    std::string message = "nothing";
    try
    {
      function();
    }
    catch (const Error &error)
    {
      message = error.what();
    }
    const bool is_refused = message.find(words) != std::string::npos;
    if (!is_refused)
      std::cout << "FAILED: '" << words << "' in '" << message << "'"
                << std::endl;
    good = dealii::Utilities::MPI::min(is_refused ? 1 : 0, MPI_COMM_WORLD) == 1
           && good;
  }

  /** A cube of which side 5 is the top, with an element and contact of it. */
  struct Cube
  {
    explicit Cube(const FiniteElement<3> &fe, const bool refine_one = false)
        : dofs(mesh)
    {
      if (fe.reference_cell() == ReferenceCells::get_simplex<3>())
        GridGenerator::subdivided_hyper_cube_with_simplices(mesh, 2);
      else if (fe.reference_cell() == ReferenceCells::get_hypercube<3>())
        GridGenerator::subdivided_hyper_cube(mesh, 2);
      else
        GridGenerator::reference_cell(mesh, fe.reference_cell());
      for (const auto &face : mesh.active_face_iterators())
        if (face->at_boundary() && face->center()[2] > 1. - 1e-9)
          face->set_boundary_id(5);
      if (refine_one)
      {
        mesh.begin_active()->set_refine_flag();
        mesh.execute_coarsening_and_refinement();
      }
      dofs.distribute_dofs(fe);
      abut::versions::reinit(constraints, dofs.locally_owned_dofs(),
                             DoFTools::extract_locally_relevant_dofs(dofs));
      constraints.close();
    }

    void reinit()
    {
      if (dofs.get_fe().reference_cell() == ReferenceCells::get_hypercube<3>())
        contact.reinit(bricks, dofs, constraints);
      else
        contact.reinit(mapping, dofs, constraints);
    }

    void detect(const MethodParameters &method)
    {
      ContactPair<3> pair;
      pair.name = "plate";
      pair.secondary = {5};
      Tensor<1, 3> down;
      down[2] = -1.;
      pair.obstacle = std::make_shared<RigidObstacle<3>>(
          plane<3>(Point<3>(0., 0., 1.), down));
      contact.set_parameters(method, SolverParameters());
      contact.set_pairs({pair});
      reinit();
      contact.detect(zero());
    }

    la::Vector zero() const
    {
      return la::Vector(dofs.locally_owned_dofs(), MPI_COMM_WORLD);
    }

    const MappingFE<3> mapping{FE_SimplexP<3>(1)};
    const MappingQ<3> bricks{1};
    Mesh mesh{MPI_COMM_WORLD, Triangulation<3>::none, true,
              Mesh::partition_zorder};
    DoFHandler<3> dofs;
    AffineConstraints<double> constraints;
    ContactAssembler<3> contact{MPI_COMM_WORLD};
  };

  void refuse_cells()
  {
    const FESystem<3> linear(FE_SimplexP<3>(1), 3);
    refuses<ContactError>("hanging nodes",
                          [&]
                          {
                            Cube cube(linear, true);
                            cube.reinit();
                          });
    refuses<ContactError>("wedges",
                          [&]
                          {
                            Cube cube(FESystem<3>(FE_WedgeP<3>(1), 3));
                            cube.reinit();
                          });
    refuses<ContactError>("for the same kind",
                          [&]
                          {
                            Cube cube(linear);
                            cube.dofs.reinit(cube.mesh);
                            cube.dofs.distribute_dofs(
                                hp::FECollection<3>(linear, linear));
                            cube.reinit();
                          });
  }

  /** A cube beside a tetrahedron. */
  void refuse_mixtures()
  {
    const FESystem<3> cubes(FE_Q<3>(1), 3), simplices(FE_SimplexP<3>(1), 3);
    const auto reinit = [&](const Mapping<3> &mapping)
    {
      Triangulation<3> cube;
      GridGenerator::hyper_cube(cube);
      std::vector<Point<3>> vertices = cube.get_vertices();
      std::vector<CellData<3>> cells(2, CellData<3>(4));
      cells[0] = CellData<3>(8);
      for (unsigned int v = 0; v < 8; ++v)
        cells[0].vertices[v] = v;
      for (unsigned int v = 0; v < 4; ++v)
      {
        cells[1].vertices[v] = 8 + v;
        vertices.emplace_back(v == 1 ? 3. : 2., v == 2, v == 3);
      }
      Mesh mesh(MPI_COMM_WORLD, Triangulation<3>::none, true,
                Mesh::partition_zorder);
      mesh.create_triangulation(vertices, cells, SubCellData());
      DoFHandler<3> dofs(mesh);
      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned())
          cell->set_active_fe_index(cell->reference_cell().is_hyper_cube() ? 0
                                                                           : 1);
      dofs.distribute_dofs(hp::FECollection<3>(cubes, simplices));
      AffineConstraints<double> constraints;
      constraints.close();
      ContactAssembler<3> contact(MPI_COMM_WORLD);
      contact.reinit(mapping, dofs, constraints);
    };
    const MappingQ<3> bricks(1);
    const MappingFE<3> linear(FE_SimplexP<3>(1));
    const MappingByCell<3> both(hp::MappingCollection<3>(bricks, linear));
    for (const Mapping<3> *one : {static_cast<const Mapping<3> *>(&bricks),
                                  static_cast<const Mapping<3> *>(&linear)})
      refuses<ContactError>("abut::MappingByCell", [&] { reinit(*one); });
    reinit(both);
  }

  void refuse_elements()
  {
    refuses<ContactError>(
        "FE_SimplexP of degree 1 or 2",
        [] {
          Cube(FESystem<3>(FE_SimplexDGP<3>(1), 3)).detect(MethodParameters());
        });
    // Their nodes are those of FE_Q, but not their shape functions.
    refuses<ContactError>(
        "made of FE_Q or FE_SimplexP of degree 1 or 2",
        [] {
          Cube(FESystem<3>(FE_Q_iso_Q1<3>(2), 3)).detect(MethodParameters());
        });
    refuses<ContactError>(
        "not FESystem<3>[FE_Q_iso_Q1<3>(2)^3]",
        [] {
          Cube(FESystem<3>(FE_Q_iso_Q1<3>(2), 3)).detect(MethodParameters());
        });
    refuses<ObstacleError>(
        "have no positive weight",
        []
        {
          Cube cube(FE_SimplexP<3>(2));
          Obstacle<3> obstacle;
          obstacle.lower =
              std::make_shared<Functions::ConstantFunction<3>>(-1.);
          cube.contact.set_obstacle(obstacle);
          cube.reinit();
          cube.contact.detect(cube.zero());
        });
  }

  void refuse_methods()
  {
    const FESystem<3> quadratic(FE_SimplexP<3>(2), 3);
    for (const auto way :
         {ABUT_DISCRETISATION_DUAL_MORTAR, ABUT_DISCRETISATION_NODE_TO_SEGMENT})
      refuses<ContactError>("multipliers of degree 1",
                            [&]
                            {
                              MethodParameters method;
                              method.discretisation = way;
                              Cube(quadratic).detect(method);
                            });
    refuses<ContactError>("quadratic triangles",
                          [&]
                          {
                            MethodParameters method;
                            method.kinematics = ABUT_KINEMATICS_CURRENT;
                            Cube(quadratic).detect(method);
                          });
    // With a penalty there are points that follow.
    MethodParameters method;
    method.options.law = abut_law_find("penalty");
    method.kinematics = ABUT_KINEMATICS_CURRENT;
    Cube cube(quadratic);
    cube.detect(method);
    good = good && cube.contact.results().measures().n_rows > 0;
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  refuse_cells();
  refuse_mixtures();
  refuse_elements();
  refuse_methods();
  if (!good)
    std::cout << "FAILED" << std::endl;
  return good ? 0 : 1;
}

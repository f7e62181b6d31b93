// SPDX-License-Identifier: LGPL-2.1-or-later
// What SurfaceRows::find() makes anew, and what it leaves: points of the
// undeformed bodies are the same in each load step.
#include "shim/handles.h"
#include "shim/surface_rows.h"

#include <abut/dealii/versions.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/numerics/vector_tools.h>

#include <iostream>

using namespace abut;
using Change = shim::RowSource::Change;

namespace
{
  constexpr double distance = 0.05;
  constexpr unsigned int bottom = 1, below = 2, above = 3;

  bool good = true;

  void expect(const bool holds, const std::string &what)
  {
    if (!holds && dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "FAILED: " << what << std::endl;
    good = good && holds;
  }

  const char *name(const Change change)
  {
    return change == Change::none        ? "nothing"
           : change == Change::constants ? "constants"
                                         : "points";
  }

  /** Unit squares, one above the other, of 4 facets each. */
  struct Squares
  {
    Squares()
        : triangulation(MPI_COMM_WORLD),
          fe(dealii::FE_Q<2>(1), 2),
          mapping(1),
          dof_handler(triangulation)
    {
      dealii::Triangulation<2> lower, upper, both;
      dealii::GridGenerator::subdivided_hyper_rectangle(
          lower, {2, 2}, dealii::Point<2>(0., -1. - distance),
          dealii::Point<2>(1., -distance));
      dealii::GridGenerator::subdivided_hyper_rectangle(
          upper, {2, 2}, dealii::Point<2>(0., 0.), dealii::Point<2>(1., 1.));
      dealii::GridGenerator::merge_triangulations(lower, upper, both);
      for (const auto &face : both.active_face_iterators())
        if (face->at_boundary())
        {
          const double y = face->center()[1];
          face->set_boundary_id(y < -0.99 - distance            ? bottom
                                : std::abs(y + distance) < 1e-9 ? below
                                : std::abs(y) < 1e-9            ? above
                                                                : 0);
        }
      triangulation.copy_triangulation(both);
      triangulation.refine_global(1);
      dof_handler.distribute_dofs(fe);
      owned = dof_handler.locally_owned_dofs();
      prescribe(0.);
      u.reinit(owned, MPI_COMM_WORLD);
    }

    /** Height of the lower surface. */
    void prescribe(const double height)
    {
      constraints.clear();
      abut::versions::reinit(
          constraints, dof_handler.locally_owned_dofs(),
          dealii::DoFTools::extract_locally_relevant_dofs(dof_handler));
      dealii::VectorTools::interpolate_boundary_values(
          mapping, dof_handler, below,
          dealii::Functions::ConstantFunction<2>(height, 2), constraints,
          dealii::ComponentMask(std::vector<bool>{false, true}));
      constraints.close();
    }

    std::vector<ContactPair<2>> pairs(const double gap) const
    {
      ContactPair<2> pair;
      pair.name = "squares";
      pair.secondary = {above};
      pair.primary = {below};
      pair.gap = gap;
      return {pair};
    }

    dealii::parallel::distributed::Triangulation<2> triangulation;
    const dealii::FESystem<2> fe;
    const dealii::MappingQ<2> mapping;
    dealii::DoFHandler<2> dof_handler;
    dealii::IndexSet owned;
    dealii::AffineConstraints<double> constraints;
    la::Vector u;
  };

  void check(const abut_discretisation discretisation)
  {
    Squares squares;
    const auto context = shim::create_context();
    const auto points = shim::create_points(context.get(), 2);
    MethodParameters method;
    method.options.law = abut_law_find("augmented lagrangian");
    method.discretisation = discretisation;
    DetectionReport detection;
    shim::SurfaceRows<2> rows({squares.mapping, squares.dof_handler,
                               squares.constraints, method, SearchParameters(),
                               false, context.get(), detection},
                              squares.pairs(0.), nullptr);
    const auto find = [&](const Change wanted, const std::string &when)
    {
      const Change found = rows.find(squares.u, points.get());
      expect(found == wanted, std::string(name(found)) + " instead of "
                                  + name(wanted) + " " + when);
    };
    const auto gap = [&](const double wanted, const std::string &when)
    {
      abut_points_view view;
      abut_points_get(points.get(), &view);
      double worst = 0.;
      for (int i = 0; i < view.n_components; ++i)
        worst = std::max(worst, std::abs(view.gap[i] - wanted));
      expect(
          dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD) <= 1e-14
              && dealii::Utilities::MPI::sum(view.n_components, MPI_COMM_WORLD)
                     > 4,
          "gap " + when);
    };
    find(Change::points, "at first");
    gap(distance, "at first");
    find(Change::none, "where nothing has changed");
    squares.prescribe(-0.01);
    find(Change::constants, "with a prescribed value");
    find(Change::none, "with the same value");
    squares.u = 0.001;
    find(Change::none, "after a motion within half a facet");
    gap(distance, "after a motion");
    rows.set().set_gaps(squares.pairs(0.02));
    find(Change::points, "with another gap");
    gap(distance + 0.02, "with another gap");
    find(Change::none, "with the same gap");
    // Half a facet is 0.125.
    squares.prescribe(-0.2);
    find(Change::points, "after a motion beyond half a facet");
    find(Change::none, "after the same motion");
    shim::penetrations(rows.points(), squares.u, 1e-3);
    find(Change::none, "after a look at the deformed surfaces");
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check(ABUT_DISCRETISATION_DUAL_MORTAR);
  check(ABUT_DISCRETISATION_NODE_TO_SEGMENT);
  check(ABUT_DISCRETISATION_QUADRATURE_POINT);
  return good ? 0 : 1;
}

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nodal_error.h"

#include "load_error.h"
#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <map>

namespace abut::app
{
  namespace
  {
    /** A function at the nodes of its boundaries, with ghosts; 0 elsewhere. */
    template <int dim>
    la::Vector at_nodes(const DiscreteProblem<dim> &problem,
                        const OnBoundary<dim> &given)
    {
      std::map<dealii::types::boundary_id, const dealii::Function<dim> *> on;
      for (const auto id : given.ids)
        on[id] = given.function;
      std::map<dealii::types::global_dof_index, double> values;
      dealii::VectorTools::interpolate_boundary_values(
          problem.mapping, problem.dof_handler, on, values, given.components);
      la::Vector result = problem.vector();
      for (const auto &[dof, value] : values)
        if (problem.dof_handler.locally_owned_dofs().is_element(dof))
          result(dof) = value;
      result.compress(dealii::VectorOperation::insert);
      return problem.ghosted_field(result);
    }
  } // namespace

  template <int dim>
  std::optional<double>
  nodal_error(const DiscreteProblem<dim> &problem,
              const std::vector<OnBoundary<dim>> &functions)
  {
    namespace MPI = dealii::Utilities::MPI;
    if (functions.empty())
      return {};
    const MPI_Comm communicator = versions::communicator(problem.dof_handler);
    double wrong = 0., whole = 0.;
    for (const OnBoundary<dim> &given : functions)
    {
      const auto for_each_face = [&](const auto &action)
      {
        for (const auto &cell : problem.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int f : cell->face_indices())
              if (cell->face(f)->at_boundary()
                  && given.ids.count(cell->face(f)->boundary_id()) > 0)
                action(cell, f);
      };
      double n_faces = 0.;
      for_each_face([&](const auto &...) { n_faces += 1.; });
      n_faces = MPI::sum(n_faces, communicator);
      const auto values_of =
          shim::face_values(problem.mapping, problem.dof_handler,
                            points_between<dim - 1>(n_faces),
                            dealii::update_values | dealii::update_JxW_values
                                | dealii::update_quadrature_points);
      const la::Vector nodal = at_nodes(problem, given);
      std::vector<double> exact;
      std::vector<dealii::Vector<double>> found;
      for_each_face(
          [&](const auto &cell, const unsigned int f)
          {
            dealii::FEFaceValues<dim> &values = values_of.of(cell);
            values.reinit(cell, f);
            const auto &points = values.get_quadrature_points();
            exact.resize(points.size());
            found.resize(points.size(),
                         dealii::Vector<double>(problem.n_components()));
            values.get_function_values(nodal, found);
            for (unsigned int c = 0; c < problem.n_components(); ++c)
            {
              if (!given.components[c])
                continue;
              given.function->value_list(points, exact, c);
              for (unsigned int q = 0; q < points.size(); ++q)
                if (std::isfinite(exact[q]))
                {
                  wrong += std::abs(found[q](c) - exact[q]) * values.JxW(q);
                  whole += std::abs(exact[q]) * values.JxW(q);
                }
            }
          });
    }
    wrong = MPI::sum(wrong, communicator);
    whole = MPI::sum(whole, communicator);
    return whole > 0. ? wrong / whole : wrong > 0. ? 1. : 0.;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::optional<double> nodal_error<dim>(                             \
      const DiscreteProblem<dim> &, const std::vector<OnBoundary<dim>> &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

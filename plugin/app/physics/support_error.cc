// SPDX-License-Identifier: LGPL-2.1-or-later
#include "support_error.h"

#include "load_error.h"
#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/fe/fe_values.h>

#include <cmath>

namespace abut::app
{
  template <int dim>
  std::optional<double>
  support_error(const DiscreteProblem<dim> &problem,
                const std::map<dealii::types::boundary_id, Prescribed<dim>>
                    &displacements)
  {
    namespace MPI = dealii::Utilities::MPI;
    if (displacements.empty())
      return {};
    const MPI_Comm communicator = versions::communicator(problem.dof_handler);
    const auto for_each_face = [&](const auto &action)
    {
      for (const auto &cell : problem.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
          {
            if (!cell->face(f)->at_boundary())
              continue;
            const auto given = displacements.find(cell->face(f)->boundary_id());
            if (given != displacements.end())
              action(cell, f, given->second);
          }
    };
    double n_faces = 0.;
    for_each_face([&](const auto &...) { n_faces += 1.; });
    n_faces = MPI::sum(n_faces, communicator);
    const auto values_of = shim::face_values(
        problem.mapping, problem.dof_handler, points_between<dim - 1>(n_faces),
        dealii::update_values | dealii::update_JxW_values
            | dealii::update_quadrature_points);
    const la::Vector of_nodes = problem.ghosted(problem.vector());
    double wrong = 0., whole = 0.;
    std::vector<double> exact;
    std::vector<dealii::Vector<double>> found;
    for_each_face(
        [&](const auto &cell, const unsigned int f, const auto &prescribed)
        {
          dealii::FEFaceValues<dim> &values = values_of.of(cell);
          values.reinit(cell, f);
          const auto &points = values.get_quadrature_points();
          exact.resize(points.size());
          found.resize(points.size(),
                       dealii::Vector<double>(problem.n_components()));
          values.get_function_values(of_nodes, found);
          for (unsigned int c = 0; c < problem.n_components(); ++c)
          {
            if (!prescribed.components[c])
              continue;
            prescribed.function->value_list(points, exact, c);
            for (unsigned int q = 0; q < points.size(); ++q)
              if (std::isfinite(exact[q]))
              {
                wrong += std::abs(found[q](c) - exact[q]) * values.JxW(q);
                whole += std::abs(exact[q]) * values.JxW(q);
              }
          }
        });
    wrong = MPI::sum(wrong, communicator);
    whole = MPI::sum(whole, communicator);
    return whole > 0. ? wrong / whole : wrong > 0. ? 1. : 0.;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::optional<double> support_error<dim>(                           \
      const DiscreteProblem<dim> &,                                            \
      const std::map<dealii::types::boundary_id, Prescribed<dim>> &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

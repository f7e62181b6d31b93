// SPDX-License-Identifier: LGPL-2.1-or-later
#include "load_resultants.h"

#include "app/input/short_number.h"
#include "shim/by_element.h"
#include "shim/cell_quadrature.h"
#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Part of the sum of magnitudes that a sum of as many terms leaves. */
    constexpr double round_off = 1e-10;

    template <int dim>
    dealii::Tensor<1, 3> in_space(const dealii::Tensor<1, dim> &vector)
    {
      dealii::Tensor<1, 3> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = vector[d];
      return result;
    }

    template <int n>
    std::string text_of(const dealii::Tensor<1, n> &vector, const double small)
    {
      std::string text;
      for (unsigned int d = 0; d < n; ++d)
        text += (d > 0 ? ", " : "(")
                + short_number(std::abs(vector[d]) < small ? 0. : vector[d]);
      return text + ")";
    }
  } // namespace

  template <int dim>
  std::vector<Resultant<dim>>
  load_resultants(const DiscreteProblem<dim> &problem,
                  const unsigned int n_bodies)
  {
    // By body: forces, moments about the origin, magnitudes; boxes as
    // negative minima and maxima.
    constexpr unsigned int n_sums = dim + 4;
    std::vector<double> sums(n_sums * n_bodies, 0.);
    std::vector<double> bounds(2 * dim * n_bodies, -1e300);
    const MPI_Comm communicator = versions::communicator(problem.dof_handler);
    const dealii::IndexSet &owned = problem.dof_handler.locally_owned_dofs();
    const auto places_of = shim::cell_values(
        problem.mapping, problem.dof_handler, shim::nodes<dim>,
        dealii::update_quadrature_points, shim::ValuesOf::component);
    std::vector<bool> seen(owned.n_elements(), false);
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : problem.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      const unsigned int body = cell->material_id();
      dealii::FEValues<dim> &places = places_of.of(cell);
      places.reinit(
          static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
              cell));
      double *bound = &bounds[2 * dim * body];
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int d = 0; d < dim; ++d)
        {
          bound[2 * d] = std::max(bound[2 * d], -cell->vertex(v)[d]);
          bound[2 * d + 1] = std::max(bound[2 * d + 1], cell->vertex(v)[d]);
        }
      shim::get_dofs(cell, dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        if (!owned.is_element(dofs[i]) || seen[owned.index_within_set(dofs[i])])
          continue;
        seen[owned.index_within_set(dofs[i])] = true;
        const auto [component, node] =
            cell->get_fe().system_to_component_index(i);
        dealii::Tensor<1, dim> force;
        force[component] = problem.external(dofs[i]);
        const dealii::Tensor<1, 3> moment = dealii::cross_product_3d(
            in_space<dim>(places.quadrature_point(node)), in_space<dim>(force));
        double *sum = &sums[n_sums * body];
        sum[component] += force[component];
        for (unsigned int d = 0; d < 3; ++d)
          sum[dim + d] += moment[d];
        sum[dim + 3] += std::abs(force[component]);
      }
    }
    MPI::sum(sums, communicator, sums);
    MPI::max(bounds, communicator, bounds);
    std::vector<Resultant<dim>> result(n_bodies);
    for (unsigned int body = 0; body < n_bodies; ++body)
    {
      Resultant<dim> &here = result[body];
      const double *sum = &sums[n_sums * body];
      const double *bound = &bounds[2 * dim * body];
      dealii::Tensor<1, dim> diagonal;
      for (unsigned int d = 0; d < dim; ++d)
      {
        here.force[d] = sum[d];
        here.centre[d] = 0.5 * (bound[2 * d + 1] - bound[2 * d]);
        diagonal[d] = bound[2 * d + 1] + bound[2 * d];
      }
      here.size = diagonal.norm();
      for (unsigned int d = 0; d < 3; ++d)
        here.moment[d] = sum[dim + d];
      here.moment -= dealii::cross_product_3d(in_space<dim>(here.centre),
                                              in_space<dim>(here.force));
      here.magnitude = sum[dim + 3];
    }
    return result;
  }

  template <int dim>
  std::string in_words(const Resultant<dim> &resultant, const bool with_moment)
  {
    if (resultant.magnitude == 0.)
      return "none";
    const double small = round_off * resultant.magnitude;
    std::string text = "force " + text_of<dim>(resultant.force, small);
    if (!with_moment)
      return text;
    const double z = resultant.moment[2];
    return text + ", moment "
           + (dim == 2
                  ? short_number(std::abs(z) < small * resultant.size ? 0. : z)
                  : text_of<3>(resultant.moment, small * resultant.size))
           + " about the centre "
           + text_of<dim>(resultant.centre, round_off * resultant.size);
  }

  template std::vector<Resultant<2>> load_resultants(const DiscreteProblem<2> &,
                                                     unsigned int);
  template std::vector<Resultant<3>> load_resultants(const DiscreteProblem<3> &,
                                                     unsigned int);
  template std::string in_words(const Resultant<2> &, bool);
  template std::string in_words(const Resultant<3> &, bool);
} // namespace abut::app

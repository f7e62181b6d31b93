// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stretches.h"

#include "shim/cell_quadrature.h"
#include "shim/principal_values.h"
#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Least singular value of F, and det F. */
    template <int dim>
    std::pair<double, double> least_stretch(const Material<dim> &material,
                                            const dealii::Tensor<2, dim> &du,
                                            const dealii::Tensor<1, dim> &u,
                                            const dealii::Point<dim> &x)
    {
      dealii::Tensor<2, dim> f = du;
      for (unsigned int d = 0; d < dim; ++d)
        f[d][d] += 1.;
      const double around = 1. + material.hoop_strain(du, u, x);
      double square = around * around;
      for (const double value :
           shim::principal_values(symmetrize(transpose(f) * f)))
        square = std::min(square, value);
      return {std::sqrt(std::max(0., square)), determinant(f) * around};
    }
  } // namespace

  template <int dim>
  Stretches find_stretches(const dealii::Mapping<dim> &mapping,
                           const dealii::DoFHandler<dim> &dof_handler,
                           const la::Vector &displacement,
                           const Materials<dim> &materials)
  {
    const auto points_of =
        shim::cell_values(mapping, dof_handler, shim::mass_rule<dim>,
                          dealii::update_values | dealii::update_gradients
                              | dealii::update_quadrature_points);
    const auto corners_of = shim::cell_values(
        mapping, dof_handler, shim::vertex_rule<dim>, dealii::update_gradients);
    const dealii::FEValuesExtractors::Vector field(0);
    std::vector<dealii::Tensor<1, dim>> u;
    std::vector<dealii::Tensor<2, dim>> du, at_corners;
    Stretches result;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      dealii::FEValues<dim> &points = points_of.of(cell),
                            &corners = corners_of.of(cell);
      u.resize(points.n_quadrature_points);
      du.resize(points.n_quadrature_points);
      at_corners.resize(corners.n_quadrature_points);
      points.reinit(cell);
      points[field].get_function_values(displacement, u);
      points[field].get_function_gradients(displacement, du);
      corners.reinit(cell);
      corners[field].get_function_gradients(displacement, at_corners);
      for (dealii::Tensor<2, dim> &f : at_corners)
      {
        for (unsigned int d = 0; d < dim; ++d)
          f[d][d] += 1.;
        result.least_at_corners =
            std::min(result.least_at_corners, determinant(f));
      }
      const Material<dim> &material = *materials.at(cell->material_id());
      for (const unsigned int q : points.quadrature_point_indices())
      {
        const auto [stretch, volume] =
            least_stretch(material, du[q], u[q], points.quadrature_point(q));
        result.least = std::min(result.least, stretch);
        result.least_volume = std::min(result.least_volume, volume);
        if (material.least_stretch() - stretch <= result.excess)
          continue;
        result.excess = material.least_stretch() - stretch;
        result.where = cell->material_id();
      }
    }
    const MPI_Comm communicator = versions::communicator(dof_handler);
    result.least = MPI::min(result.least, communicator);
    result.least_volume = MPI::min(result.least_volume, communicator);
    result.least_at_corners = MPI::min(result.least_at_corners, communicator);
    const double excess = MPI::max(result.excess, communicator);
    // Of several materials that are as far beyond, the first.
    result.where = static_cast<dealii::types::material_id>(MPI::min(
        result.excess == excess ? unsigned(result.where) : unsigned(-1),
        communicator));
    result.excess = excess;
    if (const auto found = materials.find(result.where);
        found != materials.end())
      result.allowed = found->second->least_stretch();
    return result;
  }

  template Stretches find_stretches(const dealii::Mapping<2> &,
                                    const dealii::DoFHandler<2> &,
                                    const la::Vector &, const Materials<2> &);
  template Stretches find_stretches(const dealii::Mapping<3> &,
                                    const dealii::DoFHandler<3> &,
                                    const la::Vector &, const Materials<3> &);
} // namespace abut::app

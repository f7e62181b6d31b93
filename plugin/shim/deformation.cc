// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace abut::shim
{
  namespace
  {
    template <int dim>
    double principal(const dealii::SymmetricTensor<2, dim> &strain)
    {
      double largest = 0.;
      for (const double value : dealii::eigenvalues(strain))
        largest = std::max(largest, std::abs(value));
      return largest;
    }

    /** Sums over the cells of a material. */
    struct Sums
    {
      double volume = 0., strain = 0.;
    };

    double largest_mean(const std::map<unsigned int, Sums> &mine,
                        const MPI_Comm communicator)
    {
      std::map<unsigned int, std::pair<double, double>> sums;
      for (const auto &[material, sum] : mine)
        sums[material] = {sum.volume, sum.strain};
      std::map<unsigned int, Sums> all;
      for (const auto &some :
           dealii::Utilities::MPI::all_gather(communicator, sums))
        for (const auto &[material, sum] : some)
        {
          all[material].volume += sum.first;
          all[material].strain += sum.second;
        }
      double largest = 0.;
      for (const auto &entry : all)
        if (entry.second.volume > 0.)
          largest =
              std::max(largest, entry.second.strain / entry.second.volume);
      return largest;
    }
  } // namespace

  double deformation(const solve::NearNullSpace &space, const la::Vector &u,
                     const MPI_Comm communicator)
  {
    const unsigned int n = space.n_components;
    const double *values = la::data(u);
    // The largest value and the largest negative one, by body and component.
    std::vector<double> range(2 * n * space.n_bodies,
                              -std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < space.component.size(); ++k)
    {
      double *ends =
          range.data() + 2 * (n * space.body[k] + space.component[k]);
      ends[0] = std::max(ends[0], values[k]);
      ends[1] = std::max(ends[1], -values[k]);
    }
    dealii::Utilities::MPI::max(range, communicator, range);
    double sum = 0.;
    for (unsigned int body = 0; body < space.n_bodies; ++body)
    {
      double square = 0.;
      for (unsigned int c = 0; c < n; ++c)
      {
        const double *ends = range.data() + 2 * (n * body + c);
        const double width = ends[0] + ends[1];
        square += std::isfinite(width) ? width * width : 0.;
      }
      sum += std::sqrt(square);
    }
    return std::min(sum, u.linfty_norm());
  }

  template <int dim>
  Strains strains(const dealii::Mapping<dim> &mapping,
                  const dealii::DoFHandler<dim> &dof_handler,
                  const la::Vector &u, const bool axisymmetric)
  {
    const dealii::FiniteElement<dim> &fe = dof_handler.get_fe();
    const MPI_Comm communicator = dof_handler.get_communicator();
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    la::Vector ghosted(dof_handler.locally_owned_dofs(), relevant,
                       communicator);
    ghosted = u;
    // What turns about an axis is strained by its way to it, too.
    dealii::UpdateFlags flags =
        dealii::update_gradients | dealii::update_JxW_values;
    if (axisymmetric)
      flags |= dealii::update_values | dealii::update_quadrature_points;
    dealii::FEValues<dim> points(mapping, fe,
                                 dealii::QGauss<dim>(fe.degree + 1), flags);
    const dealii::FEValuesExtractors::Vector field(0);
    std::vector<dealii::SymmetricTensor<2, dim>> strain(
        points.n_quadrature_points);
    std::vector<dealii::Tensor<1, dim>> motion(points.n_quadrature_points);
    Strains result;
    std::map<unsigned int, Sums> sums;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      Sums &sum = sums[cell->material_id()];
      points.reinit(cell);
      points[field].get_function_symmetric_gradients(ghosted, strain);
      if (axisymmetric)
        points[field].get_function_values(ghosted, motion);
      for (unsigned int q = 0; q < strain.size(); ++q)
      {
        double here = principal(strain[q]);
        if (axisymmetric)
          here = std::max(
              here, std::abs(motion[q][0] / points.quadrature_point(q)[0]));
        result.largest = std::max(result.largest, here);
        sum.volume += points.JxW(q);
        sum.strain += here * points.JxW(q);
      }
    }
    result.largest = dealii::Utilities::MPI::max(result.largest, communicator);
    result.mean = largest_mean(sums, communicator);
    return result;
  }

  template Strains strains(const dealii::Mapping<2> &,
                           const dealii::DoFHandler<2> &, const la::Vector &,
                           bool);
  template Strains strains(const dealii::Mapping<3> &,
                           const dealii::DoFHandler<3> &, const la::Vector &,
                           bool);
} // namespace abut::shim

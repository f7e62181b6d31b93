// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation.h"

#include "by_element.h"
#include "cell_quadrature.h"
#include "principal_values.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace abut::shim
{
  namespace
  {
    template <int dim>
    double principal(const dealii::SymmetricTensor<2, dim> &strain)
    {
      double largest = 0.;
      for (const double value : principal_values(strain))
        largest = std::max(largest, std::abs(value));
      return largest;
    }

    template <int dim> double rotation(const dealii::Tensor<2, dim> &gradient)
    {
      return (gradient - transpose(gradient)).norm() / std::sqrt(8.);
    }

    /** Integrals of 1, strain and rotation over the cells of a material. */
    using Sums = dealii::Tensor<1, 3>;

    /** The displacement in one cell after the other: the first components of
     * an element, which have the same shape functions. */
    template <int dim> class CellMotion
    {
    public:
      CellMotion(const dealii::Mapping<dim> &mapping,
                 const dealii::FiniteElement<dim> &fe, const bool values)
          : points(mapping, fe.get_sub_fe(0, 1), gauss(fe, fe.degree + 1),
                   flags(values)),
            node_(fe.get_sub_fe(0, 1).n_dofs_per_cell()),
            dofs_(fe.n_dofs_per_cell()),
            place_(dofs_.size(), {dim, 0})
      {
        for (unsigned int i = 0; i < dofs_.size(); ++i)
          if (fe.is_primitive(i))
            place_[i] = fe.system_to_component_index(i);
      }

      /** Values in @p u must have the ghosts of the cell. */
      template <typename Cell>
      void reinit(const Cell &cell, const la::Vector &u)
      {
        points.reinit(
            static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
                cell));
        cell->get_dof_indices(dofs_);
        for (unsigned int i = 0; i < dofs_.size(); ++i)
          if (place_[i].first < dim)
            node_[place_[i].second][place_[i].first] = u(dofs_[i]);
      }

      dealii::Tensor<2, dim> gradient(const unsigned int q) const
      {
        dealii::Tensor<2, dim> result;
        for (unsigned int k = 0; k < node_.size(); ++k)
          result += outer_product(node_[k], points.shape_grad(k, q));
        return result;
      }

      dealii::Tensor<1, dim> value(const unsigned int q) const
      {
        dealii::Tensor<1, dim> result;
        for (unsigned int k = 0; k < node_.size(); ++k)
          result += points.shape_value(k, q) * node_[k];
        return result;
      }

      dealii::FEValues<dim> points;

    private:
      static dealii::UpdateFlags flags(const bool values)
      {
        const auto always =
            dealii::update_gradients | dealii::update_JxW_values;
        return values ? always | dealii::update_values
                            | dealii::update_quadrature_points
                      : always;
      }

      std::vector<dealii::Tensor<1, dim>> node_;
      std::vector<dealii::types::global_dof_index> dofs_;
      /** Component and shape function of an unknown. */
      std::vector<std::pair<unsigned int, unsigned int>> place_;
    };

    Sums largest_means(const std::map<unsigned int, Sums> &mine,
                       const MPI_Comm communicator)
    {
      std::map<unsigned int, Sums> all;
      for (const auto &some :
           dealii::Utilities::MPI::all_gather(communicator, mine))
        for (const auto &[material, sum] : some)
          all[material] += sum;
      Sums largest;
      for (const auto &entry : all)
        for (unsigned int k = 0; k < 3; ++k)
          if (entry.second[0] > 0.)
            largest[k] =
                std::max(largest[k], entry.second[k] / entry.second[0]);
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
      if (space.component[k] >= n)
        continue;
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
    return std::min(sum, largest_displacement(space, u, communicator));
  }

  double smallest_body(const solve::NearNullSpace &space,
                       const MPI_Comm communicator)
  {
    // Negative minima and maxima in one reduction.
    constexpr double none = -std::numeric_limits<double>::max();
    std::vector<double> bounds(6 * space.n_bodies, none);
    for (std::size_t i = 0; i < space.point.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
      {
        const int body = space.body.empty() ? 0 : space.body[i];
        double *const own = &bounds[2 * (3 * body + d)];
        own[0] = std::max(own[0], -space.point[i][d]);
        own[1] = std::max(own[1], space.point[i][d]);
      }
    dealii::Utilities::MPI::max(bounds, communicator, bounds);
    double result = 0.;
    for (unsigned int body = 0; body < space.n_bodies; ++body)
    {
      const double *const own = &bounds[6 * body];
      if (own[0] == none)
        continue; // no positions are known
      const double radius =
          0.5 * std::hypot(own[0] + own[1], own[2] + own[3], own[4] + own[5]);
      result = result > 0. ? std::min(result, radius) : radius;
    }
    return result;
  }

  double largest_displacement(const solve::NearNullSpace &space,
                              const la::Vector &u, const MPI_Comm communicator)
  {
    const double *values = la::data(u);
    double largest = 0.;
    for (std::size_t k = 0; k < space.component.size(); ++k)
      if (space.component[k] < space.n_components)
        largest = std::max(largest, std::abs(values[k]));
    return dealii::Utilities::MPI::max(largest, communicator);
  }

  template <int dim>
  Strains strains(const dealii::Mapping<dim> &mapping,
                  const dealii::DoFHandler<dim> &dof_handler,
                  const la::Vector &u, const bool axisymmetric)
  {
    const MPI_Comm communicator = versions::communicator(dof_handler);
    const dealii::IndexSet relevant =
        dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
    la::Vector ghosted(dof_handler.locally_owned_dofs(), relevant,
                       communicator);
    ghosted = u;
    const ByElement motions(dof_handler,
                            [&](const dealii::FiniteElement<dim> &fe) {
                              return CellMotion<dim>(mapping, fe, axisymmetric);
                            });
    Strains result;
    std::map<unsigned int, Sums> sums;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      Sums &sum = sums[cell->material_id()];
      CellMotion<dim> &motion = motions.of(cell);
      motion.reinit(cell, ghosted);
      for (const unsigned int q : motion.points.quadrature_point_indices())
      {
        const dealii::Tensor<2, dim> gradient = motion.gradient(q);
        const double angle = rotation(gradient);
        double here = principal(symmetrize(gradient));
        // In axisymmetry the displacement towards the axis is a strain, too.
        if (axisymmetric)
          here =
              std::max(here, std::abs(motion.value(q)[0]
                                      / motion.points.quadrature_point(q)[0]));
        result.largest = std::max(result.largest, here);
        result.largest_rotation = std::max(result.largest_rotation, angle);
        sum += motion.points.JxW(q) * Sums({1., here, angle});
      }
    }
    for (double *value : {&result.largest, &result.largest_rotation})
      *value = dealii::Utilities::MPI::max(*value, communicator);
    const Sums means = largest_means(sums, communicator);
    result.mean = means[1];
    result.mean_rotation = means[2];
    return result;
  }

  template Strains strains(const dealii::Mapping<2> &,
                           const dealii::DoFHandler<2> &, const la::Vector &,
                           bool);
  template Strains strains(const dealii::Mapping<3> &,
                           const dealii::DoFHandler<3> &, const la::Vector &,
                           bool);
} // namespace abut::shim

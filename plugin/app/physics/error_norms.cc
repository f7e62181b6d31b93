// SPDX-License-Identifier: LGPL-2.1-or-later

#include "error_norms.h"

#include "app/input/input_error.h"
#include "cell_volume.h"
#include "shim/cell_quadrature.h"
#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  template <int dim>
  ExactSolution<dim>::ExactSolution(const std::string &value,
                                    const std::string &value_parameter,
                                    const std::string &gradient,
                                    const std::string &gradient_parameter,
                                    const unsigned int n_components)
      : dealii::Function<dim>(n_components),
        value_expression(value, value_parameter, n_components)
  {
    if (gradient.find_first_not_of(" \t") != std::string::npos)
      gradient_expression = std::make_unique<Expression<dim>>(
          gradient, gradient_parameter, dim * n_components);
  }

  template <int dim>
  double ExactSolution<dim>::value(const dealii::Point<dim> &point,
                                   const unsigned int component) const
  {
    return value_expression.value(point, component);
  }

  template <int dim>
  dealii::Tensor<1, dim>
  ExactSolution<dim>::gradient(const dealii::Point<dim> &point,
                               const unsigned int component) const
  {
    if (!gradient_expression)
      return value_expression.gradient(point, component);
    dealii::Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = gradient_expression->value(point, dim * component + d);
    return result;
  }

  template <int dim>
  void ExactSolution<dim>::set_length(const double half_extent)
  {
    value_expression.set_length(half_extent);
  }

  template <int dim> void ExactSolution<dim>::set_time(const double time)
  {
    dealii::Function<dim>::set_time(time);
    value_expression.set_time(time);
    if (gradient_expression)
      gradient_expression->set_time(time);
  }

  namespace
  {
    /** Largest error at the nodes of this rank's cells, each node once. */
    template <int dim>
    double largest_nodal_error(const dealii::Mapping<dim> &mapping,
                               const dealii::DoFHandler<dim> &dof_handler,
                               const la::Vector &solution,
                               const dealii::Function<dim> &exact)
    {
      const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
      std::vector<bool> seen(owned.n_elements(), false);
      std::vector<dealii::types::global_dof_index> dofs;
      const auto nodes_of = shim::cell_values(
          mapping, dof_handler,
          [&](const dealii::FiniteElement<dim> &fe)
          { return dealii::Quadrature<dim>(fe.get_unit_support_points()); },
          dealii::update_quadrature_points);
      double largest = 0;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        dealii::FEValues<dim> &nodes = nodes_of.of(cell);
        nodes.reinit(cell);
        shim::get_dofs(cell, dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          if (!owned.is_element(dofs[i]))
            continue;
          const auto local = owned.index_within_set(dofs[i]);
          if (seen[local])
            continue;
          seen[local] = true;
          largest = std::max(
              largest,
              std::abs(solution(dofs[i])
                       - exact.value(
                           nodes.quadrature_point(i),
                           cell->get_fe().system_to_component_index(i).first)));
        }
      }
      return largest;
    }

    /** Error of a function at the points of a cell, by components. */
    template <int dim> class PointErrors
    {
    public:
      explicit PointErrors(const unsigned int n_components)
          : value(n_components), gradient(n_components)
      {
      }

      void reinit(const dealii::FEValues<dim> &points,
                  const la::Vector &solution,
                  const dealii::Function<dim> &exact)
      {
        for (unsigned int c = 0; c < value.size(); ++c)
        {
          const auto &u = points[dealii::FEValuesExtractors::Scalar(c)];
          value[c].resize(points.n_quadrature_points);
          gradient[c].resize(points.n_quadrature_points);
          u.get_function_values(solution, value[c]);
          u.get_function_gradients(solution, gradient[c]);
          for (const unsigned int q : points.quadrature_point_indices())
          {
            const dealii::Point<dim> &x = points.quadrature_point(q);
            value[c][q] -= exact.value(x, c);
            gradient[c][q] -= exact.gradient(x, c);
          }
        }
      }

      double value_square(const unsigned int q) const
      {
        double sum = 0;
        for (const auto &component : value)
          sum += component[q] * component[q];
        return sum;
      }

      double gradient_square(const unsigned int q) const
      {
        double sum = 0;
        for (const auto &component : gradient)
          sum += component[q].norm_square();
        return sum;
      }

      /** Integral over the cell, of the undeformed body where the stiffness
       * depends on the displacement. */
      double energy(const Material<dim> &material,
                    const dealii::FEValues<dim> &points) const
      {
        const CellVolume<dim> *of_cell = material.cell_volume();
        const auto held = of_cell != nullptr ? of_cell->held_at(0.) : nullptr;
        const Material<dim> &at_points = held ? *held : material;
        double sum = 0., volume = 0., change = 0.;
        for (const unsigned int q : points.quadrature_point_indices())
        {
          const dealii::Point<dim> &x = points.quadrature_point(q);
          const double weight = points.JxW(q) * material.measure(x);
          dealii::Tensor<1, dim> u;
          dealii::Tensor<2, dim> du;
          for (unsigned int c = 0; c < dim; ++c)
          {
            u[c] = value[c][q];
            du[c] = gradient[c][q];
          }
          const double hoop = material.hoop_strain(du, u, x);
          const NominalStress<dim> s = at_points.tangent({}, {}, x, du, u);
          sum +=
              weight * (scalar_product(s.tensor, du) + s.out_of_plane * hoop);
          volume += weight;
          change += weight * (trace(du) + hoop);
        }
        if (of_cell != nullptr)
          sum += of_cell->bulk_tangent(0.) * change * change / volume;
        return sum;
      }

    private:
      std::vector<std::vector<double>> value;
      std::vector<std::vector<dealii::Tensor<1, dim>>> gradient;
    };
  } // namespace

  template <int dim>
  ErrorNorms error_norms(const dealii::Mapping<dim> &mapping,
                         const dealii::DoFHandler<dim> &dof_handler,
                         const la::Vector &solution,
                         const dealii::Function<dim> &exact,
                         const Materials<dim> *materials)
  {
    const auto points_of = shim::cell_values(
        mapping, dof_handler,
        [&](const dealii::FiniteElement<dim> &fe)
        { return shim::gauss(fe, fe.degree + 2); },
        dealii::update_values | dealii::update_gradients
            | dealii::update_quadrature_points | dealii::update_JxW_values);
    PointErrors<dim> errors(dof_handler.get_fe().n_components());
    double l2 = 0;
    double h1 = 0;
    double energy = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      dealii::FEValues<dim> &points = points_of.of(cell);
      points.reinit(cell);
      errors.reinit(points, solution, exact);
      for (const unsigned int q : points.quadrature_point_indices())
      {
        const dealii::Point<dim> &x = points.quadrature_point(q);
        double weight = points.JxW(q);
        if (materials != nullptr)
          weight *= materials->at(cell->material_id())->measure(x);
        l2 += errors.value_square(q) * weight;
        h1 += errors.gradient_square(q) * weight;
      }
      if (materials != nullptr)
        energy += errors.energy(*materials->at(cell->material_id()), points);
    }
    const MPI_Comm communicator = versions::communicator(dof_handler);
    const double node =
        largest_nodal_error(mapping, dof_handler, solution, exact);
    ErrorNorms result{std::sqrt(dealii::Utilities::MPI::sum(l2, communicator)),
                      std::sqrt(dealii::Utilities::MPI::sum(h1, communicator)),
                      dealii::Utilities::MPI::max(node, communicator)};
    if (materials != nullptr)
      result.energy =
          std::sqrt(dealii::Utilities::MPI::sum(energy, communicator));
    return result;
  }

  template <int dim>
  double membrane_energy(const dealii::Mapping<dim> &mapping,
                         const dealii::DoFHandler<dim> &dof_handler,
                         const la::Vector &solution,
                         const dealii::Function<dim> &load,
                         const dealii::Function<dim> *coefficient,
                         const std::map<dealii::types::boundary_id,
                                        const dealii::Function<dim> *> &neumann)
  {
    const auto &fe = dof_handler.get_fe();
    const dealii::Quadrature<dim> quadrature = shim::gauss(fe, fe.degree + 1);
    const dealii::Quadrature<dim - 1> face_quadrature =
        shim::face_gauss(fe, fe.degree + 1);
    dealii::FEValues<dim> points(
        mapping, fe, quadrature,
        dealii::update_values | dealii::update_gradients
            | dealii::update_quadrature_points | dealii::update_JxW_values);
    dealii::FEFaceValues<dim> face_points(mapping, fe, face_quadrature,
                                          dealii::update_values
                                              | dealii::update_quadrature_points
                                              | dealii::update_JxW_values);
    std::vector<double> values(quadrature.size());
    std::vector<double> loads(quadrature.size());
    std::vector<double> coefficients(quadrature.size(), 1.);
    std::vector<dealii::Tensor<1, dim>> gradients(quadrature.size());
    std::vector<double> face_values(face_quadrature.size());
    std::vector<double> fluxes(face_quadrature.size());
    double energy = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      points.reinit(cell);
      points.get_function_values(solution, values);
      points.get_function_gradients(solution, gradients);
      load.value_list(points.get_quadrature_points(), loads);
      if (coefficient != nullptr)
        coefficient->value_list(points.get_quadrature_points(), coefficients);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        energy += (0.5 * coefficients[q] * gradients[q].norm_square()
                   - loads[q] * values[q])
                  * points.JxW(q);
      if (neumann.empty() || !cell->at_boundary())
        continue;
      for (const unsigned int f : cell->face_indices())
      {
        if (!cell->face(f)->at_boundary())
          continue;
        const auto flux = neumann.find(cell->face(f)->boundary_id());
        if (flux == neumann.end())
          continue;
        face_points.reinit(cell, f);
        face_points.get_function_values(solution, face_values);
        flux->second->value_list(face_points.get_quadrature_points(), fluxes);
        for (unsigned int q = 0; q < face_quadrature.size(); ++q)
          energy -= fluxes[q] * face_values[q] * face_points.JxW(q);
      }
    }
    return dealii::Utilities::MPI::sum(energy,
                                       versions::communicator(dof_handler));
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template class ExactSolution<dim>;                                           \
  template ErrorNorms error_norms<dim>(                                        \
      const dealii::Mapping<dim> &, const dealii::DoFHandler<dim> &,           \
      const la::Vector &, const dealii::Function<dim> &,                       \
      const Materials<dim> *);                                                 \
  template double membrane_energy<dim>(                                        \
      const dealii::Mapping<dim> &, const dealii::DoFHandler<dim> &,           \
      const la::Vector &, const dealii::Function<dim> &,                       \
      const dealii::Function<dim> *,                                           \
      const std::map<dealii::types::boundary_id,                               \
                     const dealii::Function<dim> *> &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One pass over cells and faces by MeshWorker::mesh_loop. A face between two
// ranks is integrated on both, each adding the half of its own cell, so that
// nothing has to be sent but the sum.

#include "estimator.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/meshworker/mesh_loop.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace abut::app
{
  namespace
  {
    /** Contributions to eta_K^2 by active cell index. */
    using Contributions = std::vector<std::pair<unsigned int, double>>;

    constexpr unsigned int whole_face = dealii::numbers::invalid_unsigned_int;

    template <int dim> struct Scratch
    {
      static dealii::UpdateFlags face_flags()
      {
        return dealii::update_values | dealii::update_gradients
               | dealii::update_quadrature_points
               | dealii::update_normal_vectors | dealii::update_JxW_values;
      }

      Scratch(const dealii::Mapping<dim> &mapping,
              const dealii::FiniteElement<dim> &fe)
          : cell(mapping, fe, dealii::QGauss<dim>(fe.degree + 1),
                 dealii::update_values | dealii::update_gradients
                     | dealii::update_hessians
                     | dealii::update_quadrature_points
                     | dealii::update_JxW_values),
            face(mapping, fe, dealii::QGauss<dim - 1>(fe.degree + 1),
                 face_flags()),
            other_face(mapping, fe, dealii::QGauss<dim - 1>(fe.degree + 1),
                       face_flags()),
            other_subface(mapping, fe, dealii::QGauss<dim - 1>(fe.degree + 1),
                          face_flags()),
            dofs(fe.n_dofs_per_cell())
      {
      }

      Scratch(const Scratch &other)
          : Scratch(other.cell.get_mapping(), other.cell.get_fe())
      {
      }

      dealii::FEValues<dim> cell;
      dealii::FEFaceValues<dim> face;
      dealii::FEFaceValues<dim> other_face;
      dealii::FESubfaceValues<dim> other_subface;
      std::vector<dealii::types::global_dof_index> dofs;
      std::vector<double> values;
      std::vector<double> loads;
      std::vector<double> coefficients;
      std::vector<double> other_coefficients;
      std::vector<dealii::Tensor<1, dim>> gradients;
      std::vector<dealii::Tensor<1, dim>> other_gradients;
      std::vector<dealii::Point<dim>> inner_points;
    };

    template <int dim> class Estimator
    {
    public:
      using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

      explicit Estimator(const EstimatorInput<dim> &input) : input(input)
      {
      }

      void on_cell(const Cell &cell, Scratch<dim> &scratch,
                   Contributions &out) const
      {
        if (is_held(cell, scratch))
          return;
        auto &points = scratch.cell;
        points.reinit(cell);
        const unsigned int n = points.n_quadrature_points;
        scratch.values.resize(n);
        scratch.loads.resize(n);
        scratch.coefficients.assign(n, 1.);
        points.get_function_laplacians(input.solution, scratch.values);
        input.load.value_list(points.get_quadrature_points(), scratch.loads);
        if (input.coefficient != nullptr)
          add_coefficient_terms(scratch);
        double sum = 0;
        for (unsigned int q = 0; q < n; ++q)
        {
          const double residual = scratch.loads[q] + scratch.values[q];
          sum += residual * residual / scratch.coefficients[q] * points.JxW(q);
        }
        const double h = side(cell);
        out.emplace_back(cell->active_cell_index(), h * h * sum);
      }

      /** Jump over a face; @p cell is never the coarser of the two. */
      void on_face(const Cell &cell, const unsigned int f, const Cell &neighbor,
                   const unsigned int neighbor_f, const unsigned int subface,
                   Scratch<dim> &scratch, Contributions &out) const
      {
        scratch.face.reinit(cell, f);
        fluxes(cell, scratch.face, scratch, scratch.coefficients,
               scratch.gradients);
        const dealii::FEFaceValuesBase<dim> *other = &scratch.other_face;
        if (subface == whole_face)
          scratch.other_face.reinit(neighbor, neighbor_f);
        else
        {
          scratch.other_subface.reinit(neighbor, neighbor_f, subface);
          other = &scratch.other_subface;
        }
        fluxes(neighbor, *other, scratch, scratch.other_coefficients,
               scratch.other_gradients);

        double sum = 0;
        for (unsigned int q = 0; q < scratch.face.n_quadrature_points; ++q)
        {
          const double k = scratch.coefficients[q];
          const double other_k = scratch.other_coefficients[q];
          const double jump = scratch.face.normal_vector(q)
                              * (k * scratch.gradients[q]
                                 - other_k * scratch.other_gradients[q]);
          sum += jump * jump / std::max(k, other_k) * scratch.face.JxW(q);
        }
        for (const Cell &side_cell : {cell, neighbor})
          if (side_cell->is_locally_owned())
            out.emplace_back(side_cell->active_cell_index(),
                             0.5 * side(side_cell) * sum);
      }

      void on_boundary(const Cell &cell, const unsigned int f,
                       Scratch<dim> &scratch, Contributions &out) const
      {
        const auto id = cell->face(f)->boundary_id();
        if (input.dirichlet.count(id) > 0)
          return;
        auto &points = scratch.face;
        points.reinit(cell, f);
        const unsigned int n = points.n_quadrature_points;
        fluxes(cell, points, scratch, scratch.coefficients, scratch.gradients);
        scratch.loads.assign(n, 0.);
        const auto traction = input.neumann.find(id);
        if (traction != input.neumann.end())
          traction->second->value_list(points.get_quadrature_points(),
                                       scratch.loads);
        scratch.values.assign(n, 0.);
        if (input.pressure != nullptr && input.contact.count(id) > 0)
          points.get_function_values(*input.pressure, scratch.values);
        double sum = 0;
        for (unsigned int q = 0; q < n; ++q)
        {
          const double k = scratch.coefficients[q];
          const double residual =
              scratch.loads[q] + scratch.values[q]
              - k * (scratch.gradients[q] * points.normal_vector(q));
          sum += residual * residual / k * points.JxW(q);
        }
        out.emplace_back(cell->active_cell_index(), side(cell) * sum);
      }

    private:
      /** Side of the cube with the cell's diameter. */
      static double side(const Cell &cell)
      {
        return cell->diameter() / std::sqrt(double(dim));
      }

      bool is_held(const Cell &cell, Scratch<dim> &scratch) const
      {
        if (input.active == nullptr)
          return false;
        cell->get_dof_indices(scratch.dofs);
        return std::all_of(scratch.dofs.begin(), scratch.dofs.end(),
                           [this](const dealii::types::global_dof_index dof)
                           { return (*input.active)(dof) != 0; });
      }

      /** From the Laplacian of u in scratch.values make div(k grad u). */
      void add_coefficient_terms(Scratch<dim> &scratch) const
      {
        const auto &points = scratch.cell;
        const auto &places = points.get_quadrature_points();
        scratch.gradients.resize(places.size());
        points.get_function_gradients(input.solution, scratch.gradients);
        input.coefficient->value_list(places, scratch.coefficients);
        for (unsigned int q = 0; q < places.size(); ++q)
          scratch.values[q] =
              scratch.coefficients[q] * scratch.values[q]
              + input.coefficient->gradient(places[q]) * scratch.gradients[q];
      }

      /** Gradients of u and coefficients on one side of a face. The
       * coefficient is taken a little inside the cell, where a jump that
       * follows the mesh has its value of this side. */
      void fluxes(const Cell &cell, const dealii::FEFaceValuesBase<dim> &points,
                  Scratch<dim> &scratch, std::vector<double> &coefficients,
                  std::vector<dealii::Tensor<1, dim>> &gradients) const
      {
        const unsigned int n = points.n_quadrature_points;
        gradients.resize(n);
        points.get_function_gradients(input.solution, gradients);
        coefficients.assign(n, 1.);
        if (input.coefficient == nullptr)
          return;
        scratch.inner_points = points.get_quadrature_points();
        const dealii::Point<dim> center = cell->center();
        for (dealii::Point<dim> &point : scratch.inner_points)
          point += 1e-10 * (center - point);
        input.coefficient->value_list(scratch.inner_points, coefficients);
      }

      const EstimatorInput<dim> &input;
    };
  } // namespace

  template <int dim>
  double estimate_error(const EstimatorInput<dim> &input,
                        dealii::Vector<float> &squared)
  {
    using Cell = typename Estimator<dim>::Cell;
    const Estimator<dim> estimator(input);
    squared.reinit(input.dof_handler.get_triangulation().n_active_cells());

    const auto cell_worker =
        [&](const Cell &cell, Scratch<dim> &scratch, Contributions &out)
    { estimator.on_cell(cell, scratch, out); };
    const auto boundary_worker = [&](const Cell &cell, const unsigned int f,
                                     Scratch<dim> &scratch, Contributions &out)
    { estimator.on_boundary(cell, f, scratch, out); };
    // mesh_loop comes to a face with hanging nodes from its finer side.
    const auto face_worker = [&](const Cell &cell, const unsigned int f,
                                 const unsigned int, const Cell &neighbor,
                                 const unsigned int neighbor_f,
                                 const unsigned int subface,
                                 Scratch<dim> &scratch, Contributions &out) {
      estimator.on_face(cell, f, neighbor, neighbor_f, subface, scratch, out);
    };
    double sum = 0;
    const auto copier = [&](const Contributions &contributions)
    {
      for (const auto &[cell, value] : contributions)
      {
        squared[cell] += float(value);
        sum += value;
      }
    };

    const dealii::DoFHandler<dim> &dof_handler = input.dof_handler;
    dealii::MeshWorker::mesh_loop(
        dof_handler.begin_active(), dof_handler.end(), cell_worker, copier,
        Scratch<dim>(input.mapping, dof_handler.get_fe()), Contributions(),
        dealii::MeshWorker::assemble_own_cells
            | dealii::MeshWorker::assemble_own_interior_faces_once
            | dealii::MeshWorker::assemble_ghost_faces_both
            | dealii::MeshWorker::assemble_boundary_faces,
        boundary_worker, face_worker);
    return std::sqrt(
        dealii::Utilities::MPI::sum(sum, dof_handler.get_communicator()));
  }

  template double estimate_error<2>(const EstimatorInput<2> &,
                                    dealii::Vector<float> &);
  template double estimate_error<3>(const EstimatorInput<3> &,
                                    dealii::Vector<float> &);
} // namespace abut::app

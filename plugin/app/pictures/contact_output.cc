// SPDX-License-Identifier: LGPL-2.1-or-later

#include "contact_output.h"

#include "app/physics/postprocessed.h"

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::app
{
  template <int dim>
  SignedLength<dim>::SignedLength(const std::string &name, const double outward)
      : dealii::DataPostprocessorScalar<dim>(
          name, dealii::update_values | dealii::update_normal_vectors),
        outward(outward)
  {
  }

  template <int dim>
  void SignedLength<dim>::evaluate_vector_field(
      const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
      std::vector<dealii::Vector<double>> &results) const
  {
    make_room(1, results);
    // Of faces with fewer points than others.
    const std::size_t n = std::min(results.size(), inputs.normals.size());
    for (unsigned int q = 0; q < n; ++q)
    {
      double square = 0;
      double along = 0;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double component = inputs.solution_values[q][d];
        square += component * component;
        along += component * inputs.normals[q][d];
      }
      // Across an edge of the surface it is the other facet's vector.
      const double length = std::sqrt(square);
      results[q][0] = std::abs(along) < 0.5 * length
                          ? 0.
                          : outward * std::copysign(length, along);
    }
  }

  template <int dim>
  TractionPart<dim>::TractionPart(const std::string &name, const Part part)
      : dealii::DataPostprocessorScalar<dim>(
          name, dealii::update_values | dealii::update_normal_vectors),
        part(part)
  {
  }

  template <int dim>
  void TractionPart<dim>::evaluate_vector_field(
      const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
      std::vector<dealii::Vector<double>> &results) const
  {
    make_room(1, results);
    // Of faces with fewer points than others.
    const std::size_t n = std::min(results.size(), inputs.normals.size());
    for (unsigned int q = 0; q < n; ++q)
    {
      dealii::Tensor<1, dim> traction;
      for (unsigned int d = 0; d < dim; ++d)
        traction[d] = inputs.solution_values[q][d];
      const double along =
          part == Part::all ? 0. : traction * inputs.normals[q];
      results[q][0] = part == Part::pressure
                          ? -along
                          : (traction - along * inputs.normals[q]).norm();
    }
  }

  template <int dim>
  FirstComponent<dim>::FirstComponent(const std::string &name)
      : dealii::DataPostprocessorScalar<dim>(name, dealii::update_values)
  {
  }

  template <int dim>
  void FirstComponent<dim>::evaluate_vector_field(
      const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
      std::vector<dealii::Vector<double>> &results) const
  {
    make_room(1, results);
    for (unsigned int q = 0; q < results.size(); ++q)
      results[q][0] = inputs.solution_values[q][0];
  }

  template <int dim>
  NumberOfBoundary<dim>::NumberOfBoundary(const std::string &name,
                                          Number number)
      : dealii::DataPostprocessorScalar<dim>(name, dealii::update_values),
        number(std::move(number))
  {
  }

  template <int dim>
  void NumberOfBoundary<dim>::evaluate_vector_field(
      const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
      std::vector<dealii::Vector<double>> &results) const
  {
    make_room(1, results);
    const auto face =
        inputs.template get_cell<dim>()->face(inputs.get_face_number());
    for (dealii::Vector<double> &result : results)
      result[0] = number(face->boundary_id());
  }

  double gap_of_row(const double gap, const double presence)
  {
    return presence > 1. - 1e-6 ? gap
                                : std::numeric_limits<double>::quiet_NaN();
  }

  template <int dim>
  la::Vector mark_rows(const dealii::DoFHandler<dim> &dof_handler,
                       const la::Vector &gap, const la::Vector &status)
  {
    dealii::ComponentMask second(dim, false);
    second.set(1, true);
    la::Vector result(gap);
    for (const auto dof : dealii::DoFTools::extract_dofs(dof_handler, second))
      result(dof) = status(dof) < -0.5 ? 0. : 1.;
    result.compress(dealii::VectorOperation::insert);
    return result;
  }

  template <int dim>
  GapOfRows<dim>::GapOfRows(const std::string &name)
      : dealii::DataPostprocessorScalar<dim>(name, dealii::update_values)
  {
  }

  template <int dim>
  void GapOfRows<dim>::evaluate_vector_field(
      const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
      std::vector<dealii::Vector<double>> &results) const
  {
    make_room(1, results);
    for (unsigned int q = 0; q < results.size(); ++q)
      results[q][0] = gap_of_row(inputs.solution_values[q][0],
                                 inputs.solution_values[q][1]);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template class GapOfRows<dim>;                                               \
  template la::Vector mark_rows<dim>(const dealii::DoFHandler<dim> &,          \
                                     const la::Vector &, const la::Vector &);  \
  template class SignedLength<dim>;                                            \
  template class TractionPart<dim>;                                            \
  template class FirstComponent<dim>;                                          \
  template class NumberOfBoundary<dim>;
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

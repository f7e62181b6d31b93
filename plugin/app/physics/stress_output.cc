// SPDX-License-Identifier: LGPL-2.1-or-later

#include "stress_output.h"

#include "nodal_means.h"
#include "postprocessed.h"
#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    namespace Meaning = dealii::DataComponentInterpretation;

    /** Components in the order of nodal_stress(). */
    template <int dim> std::vector<double> components(const Stress<dim> &stress)
    {
      std::vector<double> result;
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(stress.tensor[d][d]);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i + 1; j < dim; ++j)
          result.push_back(stress.tensor[i][j]);
      if (dim == 2)
        result.push_back(stress.out_of_plane);
      return result;
    }

    template <int dim> Stress<dim> from_components(const double *value)
    {
      Stress<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result.tensor[d][d] = *value++;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i + 1; j < dim; ++j)
          result.tensor[i][j] = *value++;
      if (dim == 2)
        result.out_of_plane = *value;
      return result;
    }

    template <int dim> constexpr unsigned int n_stresses()
    {
      return dim == 2 ? 4 : 6;
    }
  } // namespace

  template <int dim>
  StressPostprocessor<dim>::StressPostprocessor(
      const CellMaterials<dim> &materials)
      : materials(materials)
  {
  }

  template <int dim>
  std::vector<std::string> StressPostprocessor<dim>::get_names() const
  {
    std::vector<std::string> names(dim * dim, "stress");
    names.push_back("von_mises_stress");
    if (dim == 2)
      names.push_back("stress_out_of_plane");
    return names;
  }

  template <int dim>
  std::vector<Meaning::DataComponentInterpretation>
  StressPostprocessor<dim>::get_data_component_interpretation() const
  {
    std::vector<Meaning::DataComponentInterpretation> result(
        dim * dim, Meaning::component_is_part_of_tensor);
    result.resize(get_names().size(), Meaning::component_is_scalar);
    return result;
  }

  template <int dim>
  dealii::UpdateFlags StressPostprocessor<dim>::get_needed_update_flags() const
  {
    return dealii::update_values | dealii::update_gradients
           | dealii::update_quadrature_points;
  }

  template <int dim>
  void StressPostprocessor<dim>::evaluate_vector_field(
      const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
      std::vector<dealii::Vector<double>> &results) const
  {
    const Material<dim> &material =
        materials.at(inputs.template get_cell<dim>());
    make_room(get_names().size(), results);
    for (unsigned int q = 0; q < results.size(); ++q)
    {
      dealii::Tensor<1, dim> u;
      dealii::Tensor<2, dim> du;
      for (unsigned int c = 0; c < dim; ++c)
      {
        u[c] = inputs.solution_values[q][c];
        du[c] = inputs.solution_gradients[q][c];
      }
      const Stress<dim> s = material.stress(du, u, inputs.evaluation_points[q]);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          results[q][dim * i + j] = s.tensor[i][j];
      results[q][dim * dim] = s.von_mises();
      if (dim == 2)
        results[q][dim * dim + 1] = s.out_of_plane;
    }
  }

  namespace
  {
    bool is_finite(const std::vector<double> &values)
    {
      return std::all_of(values.begin(), values.end(),
                         [](const double value)
                         { return std::isfinite(value); });
    }

    template <int dim>
    void add_stresses(const dealii::Mapping<dim> &mapping,
                      const dealii::DoFHandler<dim> &dof_handler,
                      const la::Vector &displacement,
                      const Materials<dim> &materials, NodalMeans<dim> &means)
    {
      const auto points_of =
          shim::cell_values(mapping, dof_handler, shim::vertex_rule<dim>,
                            dealii::update_values | dealii::update_gradients
                                | dealii::update_quadrature_points);
      const CellMaterials<dim> of_cells(mapping, dof_handler, displacement,
                                        materials);
      const dealii::FEValuesExtractors::Vector field(0);
      std::vector<dealii::Tensor<1, dim>> u;
      std::vector<dealii::Tensor<2, dim>> du;
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        dealii::FEValues<dim> &points = points_of.of(cell);
        u.resize(points.n_quadrature_points);
        du.resize(points.n_quadrature_points);
        points.reinit(cell);
        points[field].get_function_values(displacement, u);
        points[field].get_function_gradients(displacement, du);
        const auto &dofs = means.nodes(cell);
        const Material<dim> &material = of_cells.at(cell);
        const double volume = cell->measure();
        // A cell that is inverted at a corner has no stress there: the mean of
        // its other corners.
        std::vector<std::vector<double>> stress(dofs.size());
        std::vector<double> sum(n_stresses<dim>(), 0.);
        unsigned int n_known = 0;
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          stress[i] = components(
              material.stress(du[i], u[i], points.quadrature_point(i)));
          if (!is_finite(stress[i]))
            continue;
          ++n_known;
          for (std::size_t c = 0; c < sum.size(); ++c)
            sum[c] += stress[i][c];
        }
        for (double &value : sum)
          value /= std::max(n_known, 1u);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          means.add(dofs[i], volume, is_finite(stress[i]) ? stress[i] : sum);
      }
    }
  } // namespace

  template <int dim>
  std::vector<la::Vector>
  nodal_stress(const dealii::Mapping<dim> &mapping,
               const dealii::DoFHandler<dim> &dof_handler,
               const la::Vector &displacement, const Materials<dim> &materials,
               const dealii::DoFHandler<dim> &scalar)
  {
    dealii::AffineConstraints<double> hanging;
    versions::reinit(hanging, scalar.locally_owned_dofs(),
                     dealii::DoFTools::extract_locally_relevant_dofs(scalar));
    dealii::DoFTools::make_hanging_node_constraints(scalar, hanging);
    hanging.close();
    const unsigned int n = n_stresses<dim>();
    NodalMeans<dim> means(scalar, n);
    add_stresses(mapping, dof_handler, displacement, materials, means);
    std::vector<la::Vector> fields = means.means();
    fields.emplace_back(scalar.locally_owned_dofs(),
                        versions::communicator(scalar));
    std::vector<double> values(n);
    for (int i = 0; i < la::n_owned(fields[n]); ++i)
    {
      for (unsigned int c = 0; c < n; ++c)
        values[c] = la::data(fields[c])[i];
      la::data(fields[n])[i] = from_components<dim>(values.data()).von_mises();
    }
    std::vector<la::Vector> result;
    for (la::Vector &field : fields)
    {
      field.compress(dealii::VectorOperation::insert);
      hanging.distribute(field);
      result.push_back(means.ghosted(field));
    }
    return result;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template class StressPostprocessor<dim>;                                     \
  template std::vector<la::Vector> nodal_stress<dim>(                          \
      const dealii::Mapping<dim> &, const dealii::DoFHandler<dim> &,           \
      const la::Vector &, const Materials<dim> &,                              \
      const dealii::DoFHandler<dim> &);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app

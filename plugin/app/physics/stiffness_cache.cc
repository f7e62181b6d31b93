// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stiffness_cache.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace abut::app
{
  namespace
  {
    /** Shapes closer than this, relative to their size, are one. */
    constexpr double resolution = 1e-11;

    /** Number of cells after which a cache that does not help is left. */
    constexpr std::size_t trial = 256;
  } // namespace

  template <int dim>
  StiffnessCache<dim>::StiffnessCache(const dealii::Mapping<dim> &mapping,
                                      const dealii::FiniteElement<dim> &fe,
                                      const ElasticMaterials &materials)
      : materials(materials),
        fe(fe),
        values(mapping, fe.base_element(0), dealii::QGauss<dim>(fe.degree + 1),
               dealii::update_values | dealii::update_gradients
                   | dealii::update_JxW_values
                   | dealii::update_quadrature_points),
        result(fe.n_dofs_per_cell(), fe.n_dofs_per_cell())
  {
  }

  template <int dim> bool StiffnessCache<dim>::has_shape(const Cell &cell) const
  {
    if (materials.at(cell->material_id()).template is_axisymmetric<dim>())
      return false;
    if (fe.degree == 1)
      return true;
    // Mappings of higher degree bend whatever has a manifold.
    constexpr auto flat = dealii::numbers::flat_manifold_id;
    if (cell->manifold_id() != flat)
      return false;
    for (const auto &face : cell->face_iterators())
      if (face->manifold_id() != flat)
        return false;
    for (unsigned int l = 0; l < cell->n_lines(); ++l)
      if (cell->line(l)->manifold_id() != flat)
        return false;
    return true;
  }

  template <int dim>
  typename StiffnessCache<dim>::Key
  StiffnessCache<dim>::key(const Cell &cell, const double size) const
  {
    Key key;
    key[0] = cell->material_id();
    unsigned int k = 1;
    for (unsigned int v = 1; v < cell->n_vertices(); ++v)
      for (unsigned int d = 0; d < dim; ++d)
        key[k++] = std::llround((cell->vertex(v)[d] - cell->vertex(0)[d])
                                / (size * resolution));
    return key;
  }

  template <int dim>
  void StiffnessCache<dim>::compute(const Cell &cell,
                                    dealii::FullMatrix<double> &matrix)
  {
    const ElasticMaterial &material = materials.at(cell->material_id());
    const double lambda = material.template lambda<dim>();
    const double mu = material.mu();
    const bool rings = material.template is_axisymmetric<dim>();
    values.reinit(
        static_cast<typename dealii::Triangulation<dim>::cell_iterator>(cell));
    const unsigned int n_nodes = fe.base_element(0).n_dofs_per_cell();
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int j = 0; j <= i; ++j)
      {
        dealii::Tensor<2, dim> product;
        // Hoop strain with div u: (i, j), (j, i); with itself.
        dealii::Tensor<1, dim> hoop_i, hoop_j;
        double hoop = 0.;
        for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
        {
          const double weight =
              values.JxW(q) * material.measure<dim>(values.quadrature_point(q));
          product +=
              weight
              * outer_product(values.shape_grad(i, q), values.shape_grad(j, q));
          if (rings)
          {
            const double r = values.quadrature_point(q)[0];
            hoop_i +=
                weight * values.shape_value(i, q) / r * values.shape_grad(j, q);
            hoop_j +=
                weight * values.shape_value(j, q) / r * values.shape_grad(i, q);
            hoop += weight * values.shape_value(i, q) * values.shape_value(j, q)
                    / (r * r);
          }
        }
        const double trace_of = trace(product);
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
          {
            double entry = lambda * product[a][b] + mu * product[b][a]
                           + (a == b ? mu * trace_of : 0.);
            if (rings)
              entry +=
                  lambda
                      * ((a == 0 ? hoop_i[b] : 0.) + (b == 0 ? hoop_j[a] : 0.))
                  + (a == 0 && b == 0 ? (lambda + 2. * mu) * hoop : 0.);
            const unsigned int row = fe.component_to_system_index(a, i);
            const unsigned int column = fe.component_to_system_index(b, j);
            matrix(row, column) = entry;
            matrix(column, row) = entry;
          }
      }
  }

  template <int dim>
  const dealii::FullMatrix<double> &
  StiffnessCache<dim>::matrix(const Cell &cell)
  {
    ++n_asked;
    const bool helps = n_asked < trial || 2 * known.size() < n_asked;
    if (!helps || !has_shape(cell))
    {
      compute(cell, result);
      return result;
    }
    constexpr unsigned int last_vertex =
        dealii::GeometryInfo<dim>::vertices_per_cell - 1;
    const double size = cell->vertex(last_vertex).distance(cell->vertex(0));
    const Key wanted = key(cell, size);
    auto entry = known.find(wanted);
    if (entry == known.end())
    {
      compute(cell, result);
      entry = known.emplace(wanted, std::make_pair(size, result)).first;
    }
    const auto &[size_of_known, shared] = entry->second;
    if (dim == 2)
      return shared;
    result.equ(size / size_of_known, shared);
    return result;
  }

  template class StiffnessCache<2>;
  template class StiffnessCache<3>;
} // namespace abut::app

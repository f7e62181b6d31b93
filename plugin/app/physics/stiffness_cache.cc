// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stiffness_cache.h"
#include "shim/cell_quadrature.h"

#include <abut/dealii/mapping_by_cell.h>

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

    /** The mapping of the cells of an element. */
    template <int dim>
    const dealii::Mapping<dim> &mapping_of(const dealii::Mapping<dim> &mapping,
                                           const dealii::FiniteElement<dim> &fe)
    {
      const auto *by_cell = dynamic_cast<const MappingByCell<dim> *>(&mapping);
      return by_cell != nullptr ? by_cell->of(fe.reference_cell()) : mapping;
    }
  } // namespace

  template <int dim>
  StiffnessCache<dim>::StiffnessCache(const dealii::Mapping<dim> &mapping,
                                      const dealii::FiniteElement<dim> &fe,
                                      const Materials<dim> &materials)
      : materials(materials),
        fe(fe),
        bent(dynamic_cast<const MiddleNodes<dim> *>(&mapping_of(mapping, fe))),
        values(mapping, fe.base_element(0), shim::gauss(fe, fe.degree + 1),
               dealii::update_values | dealii::update_gradients
                   | dealii::update_JxW_values
                   | dealii::update_quadrature_points),
        result(fe.n_dofs_per_cell(), fe.n_dofs_per_cell())
  {
  }

  template <int dim> bool StiffnessCache<dim>::has_shape(const Cell &cell) const
  {
    if (materials.at(cell->material_id())->is_axisymmetric())
      return false;
    if (fe.degree == 1)
      return true;
    if (bent != nullptr)
      return !bent->is_curved(cell);
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
    Key key = {};
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
    values.reinit(
        static_cast<typename dealii::Triangulation<dim>::cell_iterator>(cell));
    materials.at(cell->material_id())
        ->cell_tangent(values, fe, CellState<dim>(), matrix);
  }

  template <int dim>
  typename StiffnessCache<dim>::Scaled
  StiffnessCache<dim>::find(const Cell &cell)
  {
    ++n_asked;
    const bool helps = n_asked < trial || 2 * known.size() < n_asked;
    if (!helps || !has_shape(cell))
    {
      compute(cell, result);
      return {&result, 1.};
    }
    const double size =
        cell->vertex(cell->n_vertices() - 1).distance(cell->vertex(0));
    const Key wanted = key(cell, size);
    auto entry = known.find(wanted);
    if (entry == known.end())
    {
      compute(cell, result);
      entry = known.emplace(wanted, std::make_pair(size, result)).first;
    }
    const auto &[size_of_known, shared] = entry->second;
    return {&shared, dim == 2 ? 1. : size / size_of_known};
  }

  template <int dim>
  const dealii::FullMatrix<double> &
  StiffnessCache<dim>::matrix(const Cell &cell)
  {
    const auto [known_one, factor] = find(cell);
    if (factor == 1.)
      return *known_one;
    result.equ(factor, *known_one);
    return result;
  }

  template <int dim>
  void StiffnessCache<dim>::vmult(const Cell &cell,
                                  dealii::Vector<double> &product,
                                  const dealii::Vector<double> &values)
  {
    const auto entry = of_cell.find(cell->active_cell_index());
    const Scaled scaled = entry != of_cell.end() ? entry->second : find(cell);
    // Not what the next call changes.
    if (entry == of_cell.end() && scaled.first != &result)
      of_cell.emplace(cell->active_cell_index(), scaled);
    scaled.first->vmult(product, values);
    product *= scaled.second;
  }

  template class StiffnessCache<2>;
  template class StiffnessCache<3>;
} // namespace abut::app

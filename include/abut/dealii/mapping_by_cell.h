// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_MAPPING_BY_CELL_H
#define ABUT_DEALII_MAPPING_BY_CELL_H

/** @file
 * One mapping for meshes with cells of two kinds.
 */

#include <deal.II/fe/mapping.h>
#include <deal.II/hp/mapping_collection.h>
#include <deal.II/hp/q_collection.h>

#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace abut
{
  /** Gives each cell the mapping of a collection that is for cells of its
   * kind: quadrilaterals and triangles, or hexahedra and tetrahedra. With it
   * hp::FECollection is possible wherever deal.II takes one mapping:
   *
   *     const dealii::hp::MappingCollection<dim> mappings(
   *       dealii::MappingQ<dim>(1),
   *       dealii::MappingFE<dim>(dealii::FE_SimplexP<dim>(1)));
   *     const abut::MappingByCell<dim> mapping(mappings);
   *     contact.reinit(mapping, dof_handler, constraints);
   */
  template <int dim> class MappingByCell : public dealii::Mapping<dim>
  {
    using Base = dealii::Mapping<dim>;
    using Data = typename Base::InternalDataBase;
    using Output =
        dealii::internal::FEValuesImplementation::MappingRelatedData<dim>;

  public:
    /** A cell, active or not. */
    using Cell = typename dealii::Triangulation<dim>::cell_iterator;

    /** @param mappings one for each kind of cells; copied */
    explicit MappingByCell(dealii::hp::MappingCollection<dim> mappings)
        : mappings_(std::move(mappings))
    {
    }

    /** A kind of cells. */
#if DEAL_II_VERSION_GTE(9, 8, 0)
    using ReferenceCell = dealii::ReferenceCell<dim>;
#else
    using ReferenceCell = dealii::ReferenceCell;
#endif

    /** The mapping of cells of a kind. */
    const Base &of(const ReferenceCell &kind) const
    {
      for (unsigned int i = 0; i + 1 < mappings_.size(); ++i)
        if (mappings_[i].is_compatible_with(kind))
          return mappings_[i];
      return mappings_[mappings_.size() - 1];
    }

    /** The mapping of a cell. */
    const Base &of(const Cell &cell) const
    {
      return of(cell->reference_cell());
    }

    /** All of them. */
    const dealii::hp::MappingCollection<dim> &mappings() const
    {
      return mappings_;
    }

    /** @cond */

    std::unique_ptr<Base> clone() const override
    {
      return std::make_unique<MappingByCell>(mappings_);
    }

    auto get_vertices(const Cell &cell) const
        -> decltype(std::declval<const Base &>().get_vertices(cell)) override
    {
      return of(cell).get_vertices(cell);
    }

    dealii::BoundingBox<dim> get_bounding_box(const Cell &cell) const override
    {
      return of(cell).get_bounding_box(cell);
    }

    bool preserves_vertex_locations() const override
    {
      for (unsigned int i = 0; i < mappings_.size(); ++i)
        if (!mappings_[i].preserves_vertex_locations())
          return false;
      return true;
    }

    bool is_compatible_with(const ReferenceCell &kind) const override
    {
      for (unsigned int i = 0; i < mappings_.size(); ++i)
        if (mappings_[i].is_compatible_with(kind))
          return true;
      return false;
    }

    dealii::Point<dim>
    transform_unit_to_real_cell(const Cell &cell,
                                const dealii::Point<dim> &unit) const override
    {
      return of(cell).transform_unit_to_real_cell(cell, unit);
    }

    dealii::Point<dim>
    transform_real_to_unit_cell(const Cell &cell,
                                const dealii::Point<dim> &place) const override
    {
      return of(cell).transform_real_to_unit_cell(cell, place);
    }

    void transform(
        const dealii::ArrayView<const dealii::Tensor<1, dim>> &input,
        const dealii::MappingKind kind, const Data &data,
        const dealii::ArrayView<dealii::Tensor<1, dim>> &output) const override
    {
      transform_any(input, kind, data, output);
    }

    void transform(
        const dealii::ArrayView<const dealii::DerivativeForm<1, dim, dim>>
            &input,
        const dealii::MappingKind kind, const Data &data,
        const dealii::ArrayView<dealii::Tensor<2, dim>> &output) const override
    {
      transform_any(input, kind, data, output);
    }

    void transform(
        const dealii::ArrayView<const dealii::Tensor<2, dim>> &input,
        const dealii::MappingKind kind, const Data &data,
        const dealii::ArrayView<dealii::Tensor<2, dim>> &output) const override
    {
      transform_any(input, kind, data, output);
    }

    void transform(
        const dealii::ArrayView<const dealii::DerivativeForm<2, dim, dim>>
            &input,
        const dealii::MappingKind kind, const Data &data,
        const dealii::ArrayView<dealii::Tensor<3, dim>> &output) const override
    {
      transform_any(input, kind, data, output);
    }

    void transform(
        const dealii::ArrayView<const dealii::Tensor<3, dim>> &input,
        const dealii::MappingKind kind, const Data &data,
        const dealii::ArrayView<dealii::Tensor<3, dim>> &output) const override
    {
      transform_any(input, kind, data, output);
    }
    /** @endcond */

  private:
    /** Data of the mappings that have been used, and the last of these. */
    struct DataByCell : Data
    {
      using Make = std::function<std::unique_ptr<Data>(const Base &)>;

      explicit DataByCell(Make make) : make(std::move(make))
      {
      }

      const Data &of(const Base &mapping) const
      {
        std::unique_ptr<Data> &data = made[&mapping];
        if (data == nullptr)
          data = make(mapping);
        present = &mapping;
        return *data;
      }

      const Make make;
      mutable std::map<const Base *, std::unique_ptr<Data>> made;
      mutable const Base *present = nullptr;
    };

    /** Names of functions that deal.II protects, to call those of others. */
    struct Protected : Base
    {
      using Base::fill_fe_face_values;
      using Base::fill_fe_subface_values;
      using Base::fill_fe_values;
      using Base::get_data;
      using Base::get_face_data;
      using Base::get_subface_data;
      using Base::requires_update_flags;
    };

    static const DataByCell &by_cell(const Data &data)
    {
      return static_cast<const DataByCell &>(data);
    }

    template <class Input, class Result>
    void transform_any(const Input &input, const dealii::MappingKind kind,
                       const Data &data, const Result &output) const
    {
      const Base &present = *by_cell(data).present;
      present.transform(input, kind, by_cell(data).of(present), output);
    }

    dealii::UpdateFlags
    requires_update_flags(const dealii::UpdateFlags flags) const override
    {
      dealii::UpdateFlags all = flags;
      for (unsigned int i = 0; i < mappings_.size(); ++i)
        all |= (mappings_[i].*(&Protected::requires_update_flags))(flags);
      return all;
    }

    std::unique_ptr<Data>
    get_data(const dealii::UpdateFlags flags,
             const dealii::Quadrature<dim> &points) const override
    {
      return std::make_unique<DataByCell>(
          [flags, points](const Base &mapping)
          { return (mapping.*(&Protected::get_data))(flags, points); });
    }

    using Base::get_face_data;
    std::unique_ptr<Data>
    get_face_data(const dealii::UpdateFlags flags,
                  const dealii::hp::QCollection<dim - 1> &points) const override
    {
      std::unique_ptr<Data> (Base::*const get)(
          dealii::UpdateFlags, const dealii::hp::QCollection<dim - 1> &) const =
          &Protected::get_face_data;
      return std::make_unique<DataByCell>(
          [flags, points, get](const Base &mapping)
          { return (mapping.*get)(flags, points); });
    }

    std::unique_ptr<Data>
    get_subface_data(const dealii::UpdateFlags flags,
                     const dealii::Quadrature<dim - 1> &points) const override
    {
      return std::make_unique<DataByCell>(
          [flags, points](const Base &mapping)
          { return (mapping.*(&Protected::get_subface_data))(flags, points); });
    }

    dealii::CellSimilarity::Similarity
    fill_fe_values(const Cell &cell,
                   const dealii::CellSimilarity::Similarity similarity,
                   const dealii::Quadrature<dim> &points, const Data &data,
                   Output &output) const override
    {
      const Base &mapping = of(cell);
      return (mapping.*(&Protected::fill_fe_values))(
          cell, similarity, points, by_cell(data).of(mapping), output);
    }

    using Base::fill_fe_face_values;
    void fill_fe_face_values(const Cell &cell, const unsigned int face,
                             const dealii::hp::QCollection<dim - 1> &points,
                             const Data &data, Output &output) const override
    {
      void (Base::*const fill)(
          const Cell &, unsigned int, const dealii::hp::QCollection<dim - 1> &,
          const Data &, Output &) const = &Protected::fill_fe_face_values;
      const Base &mapping = of(cell);
      (mapping.*fill)(cell, face, points, by_cell(data).of(mapping), output);
    }

    void fill_fe_subface_values(const Cell &cell, const unsigned int face,
                                const unsigned int subface,
                                const dealii::Quadrature<dim - 1> &points,
                                const Data &data, Output &output) const override
    {
      const Base &mapping = of(cell);
      (mapping.*(&Protected::fill_fe_subface_values))(
          cell, face, subface, points, by_cell(data).of(mapping), output);
    }

    const dealii::hp::MappingCollection<dim> mappings_;
  };
} // namespace abut

#endif

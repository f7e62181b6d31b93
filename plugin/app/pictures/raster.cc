// SPDX-License-Identifier: LGPL-2.1-or-later

#include "raster.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe.h>

#include <algorithm>
#include <cmath>

namespace abut::app
{
  namespace
  {
    constexpr double nothing = -std::numeric_limits<double>::infinity();

    template <int dim>
    dealii::BoundingBox<dim>
    bounding_box(const dealii::Mapping<dim> &mapping,
                 const dealii::DoFHandler<dim> &dof_handler)
    {
      dealii::Point<dim> low;
      dealii::Point<dim> high;
      for (unsigned int d = 0; d < dim; ++d)
      {
        low[d] = -nothing;
        high[d] = nothing;
      }
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const dealii::Point<dim> &vertex : mapping.get_vertices(cell))
            for (unsigned int d = 0; d < dim; ++d)
            {
              low[d] = std::min(low[d], vertex[d]);
              high[d] = std::max(high[d], vertex[d]);
            }
      const MPI_Comm communicator = versions::communicator(dof_handler);
      for (unsigned int d = 0; d < dim; ++d)
      {
        low[d] = dealii::Utilities::MPI::min(low[d], communicator);
        high[d] = dealii::Utilities::MPI::max(high[d], communicator);
      }
      return dealii::BoundingBox<dim>({low, high});
    }

    /** Half-open range of raster indices whose centres lie in [low, high]. */
    std::pair<std::size_t, std::size_t>
    index_range(const double low, const double high, const double start,
                const double end, const std::size_t n)
    {
      const double step = (end - start) / double(n);
      const double slack = 1e-9 * step;
      const double first = std::ceil((low - slack - start) / step - 0.5);
      const double last = std::floor((high + slack - start) / step - 0.5);
      const double top = double(n);
      return {std::size_t(std::clamp(first, 0., top)),
              std::size_t(std::clamp(last + 1, 0., top))};
    }

    /** The affine map through the first vertices of a cell. */
    template <int dim> class AffineMap
    {
    public:
      template <typename Cell>
      void reinit(const dealii::Mapping<dim> &mapping, const Cell &cell)
      {
        const auto vertices = mapping.get_vertices(cell);
        const bool is_cube = cell->reference_cell().is_hyper_cube();
        origin = vertices[0];
        dealii::Tensor<2, dim> sides;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int i = 0; i < dim; ++i)
            sides[i][d] = vertices[is_cube ? 1U << d : 1U + d][i] - origin[i];
        const double tolerance = 1e-10 * sides.norm();
        hits = true;
        for (unsigned int v = 0; v < vertices.size() && is_cube; ++v)
        {
          dealii::Tensor<1, dim> unit;
          for (unsigned int d = 0; d < dim; ++d)
            unit[d] = v >> d & 1U;
          hits =
              hits && (origin + sides * unit - vertices[v]).norm() <= tolerance;
        }
        if (hits)
          inverse = invert(sides);
      }

      /** Whether it hits all vertices, so that it can be inverted without
       * Newton's method. */
      bool is_exact() const
      {
        return hits;
      }

      dealii::Point<dim> to_unit(const dealii::Point<dim> &point) const
      {
        return dealii::Point<dim>(inverse * (point - origin));
      }

    private:
      dealii::Point<dim> origin;
      dealii::Tensor<2, dim> inverse;
      bool hits = false;
    };

    template <int dim> class CellSampler
    {
    public:
      CellSampler(const dealii::Mapping<dim> &mapping,
                  const std::vector<RasterField> &fields)
          : mapping(mapping), fields(fields), values(fields.size())
      {
      }

      using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

      void reinit(const Cell &new_cell)
      {
        cell = new_cell;
        affine.reinit(mapping, cell);
        fe = &cell->get_fe();
        for (std::size_t f = 0; f < fields.size(); ++f)
        {
          values[f].reinit(fe->n_dofs_per_cell(), true);
          cell->get_dof_values(*fields[f].values, values[f]);
        }
      }

      /** Raise the raster's entry @p index to the values at @p point, if the
       * point lies in the cell. */
      void sample(const dealii::Point<dim> &point, const std::size_t index,
                  std::vector<std::vector<double>> &raster) const
      {
        dealii::Point<dim> unit;
        if (!to_unit(point, unit))
          return;
        for (std::size_t f = 0; f < fields.size(); ++f)
          raster[f][index] =
              std::max(raster[f][index], fields[f].nearest
                                             ? nearest(values[f], unit)
                                             : interpolated(values[f], unit));
      }

    private:
      bool to_unit(const dealii::Point<dim> &point,
                   dealii::Point<dim> &unit) const
      {
        if (affine.is_exact())
          unit = affine.to_unit(point);
        else
          try
          {
            unit = mapping.transform_real_to_unit_cell(cell, point);
          }
          catch (const typename dealii::Mapping<dim>::ExcTransformationFailed &)
          {
            return false;
          }
        return fe->reference_cell().contains_point(unit, 1e-8);
      }

      double interpolated(const dealii::Vector<double> &nodal,
                          const dealii::Point<dim> &unit) const
      {
        double sum = 0;
        for (unsigned int i = 0; i < nodal.size(); ++i)
          sum += nodal[i] * fe->shape_value(i, unit);
        return sum;
      }

      double nearest(const dealii::Vector<double> &nodal,
                     const dealii::Point<dim> &unit) const
      {
        const auto &nodes = fe->get_unit_support_points();
        const auto closer =
            [&unit](const dealii::Point<dim> &a, const dealii::Point<dim> &b)
        { return a.distance_square(unit) < b.distance_square(unit); };
        return nodal[static_cast<unsigned int>(
            std::min_element(nodes.begin(), nodes.end(), closer)
            - nodes.begin())];
      }

      const dealii::Mapping<dim> &mapping;
      const std::vector<RasterField> &fields;
      Cell cell;
      const dealii::FiniteElement<dim> *fe = nullptr; ///< of the cell
      AffineMap<dim> affine;
      std::vector<dealii::Vector<double>> values;
    };
  } // namespace

  template <int dim>
  Raster sample_raster(const dealii::Mapping<dim> &mapping,
                       const dealii::DoFHandler<dim> &dof_handler,
                       const std::vector<RasterField> &fields,
                       const unsigned int n, const double z)
  {
    const dealii::BoundingBox<dim> box = bounding_box(mapping, dof_handler);
    const double longer = std::max(box.side_length(0), box.side_length(1));
    const auto count = [&](const unsigned int d)
    {
      return std::size_t(
          std::max(1., std::round(n * box.side_length(d) / longer)));
    };
    Raster raster;
    raster.nx = count(0);
    raster.ny = count(1);
    raster.x_min = box.lower_bound(0);
    raster.x_max = box.upper_bound(0);
    raster.y_min = box.lower_bound(1);
    raster.y_max = box.upper_bound(1);
    if (dim == 3)
      raster.z = std::isnan(z) ? box.center()[dim - 1] : z;
    raster.fields.assign(fields.size(),
                         std::vector<double>(raster.nx * raster.ny, nothing));

    CellSampler<dim> sampler(mapping, fields);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      const dealii::BoundingBox<dim> around = mapping.get_bounding_box(cell);
      if (dim == 3
          && (raster.z < around.lower_bound(dim - 1)
              || raster.z > around.upper_bound(dim - 1)))
        continue;
      const auto columns =
          index_range(around.lower_bound(0), around.upper_bound(0),
                      raster.x_min, raster.x_max, raster.nx);
      const auto rows =
          index_range(around.lower_bound(1), around.upper_bound(1),
                      raster.y_min, raster.y_max, raster.ny);
      if (columns.first >= columns.second || rows.first >= rows.second)
        continue;
      sampler.reinit(cell);
      for (std::size_t j = rows.first; j < rows.second; ++j)
        for (std::size_t i = columns.first; i < columns.second; ++i)
        {
          dealii::Point<dim> point;
          point[0] = raster.x(i);
          point[1] = raster.y(j);
          if (dim == 3)
            point[dim - 1] = raster.z;
          sampler.sample(point, j * raster.nx + i, raster.fields);
        }
    }

    for (std::vector<double> &field : raster.fields)
    {
      const std::vector<double> mine = field;
      dealii::Utilities::MPI::max(mine, versions::communicator(dof_handler),
                                  field);
      std::replace(field.begin(), field.end(), nothing,
                   std::numeric_limits<double>::quiet_NaN());
    }
    return raster;
  }

  template Raster sample_raster<2>(const dealii::Mapping<2> &,
                                   const dealii::DoFHandler<2> &,
                                   const std::vector<RasterField> &,
                                   unsigned int, double);
  template Raster sample_raster<3>(const dealii::Mapping<3> &,
                                   const dealii::DoFHandler<3> &,
                                   const std::vector<RasterField> &,
                                   unsigned int, double);
} // namespace abut::app

// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact added to the matrix of a host with a linear solver of its own: the
// pressures of each point are condensed, and leave springs and forces.
#include "contact_problem.h"

#include <algorithm>

namespace abut
{
  using dealii::ExcMessage;
  using dealii::types::global_dof_index;

  namespace
  {
    /** Springs and forces of the rows of one point; a block of springs that is
     * not symmetric if they have friction. */
    struct CondensedPoint
    {
      int first, n_rows;
      const double *spring; ///< [n_rows^2]
      const double *force;  ///< [n_rows]
    };

    template <typename Function>
    void for_each_point(const solve::LocalElimination &local, const int n_rows,
                        const Function &function)
    {
      const solve::RowBlocks &blocks = local.blocks();
      const double *const force = local.force().data();
      for (int row = 0; blocks.empty() && row < n_rows; ++row)
        function(CondensedPoint{row, 1, &local.spring()[row], force + row});
      for (int b = 0; !blocks.empty() && b < blocks.n_blocks(); ++b)
        function(CondensedPoint{blocks.first[b], blocks.size(b),
                                local.spring_blocks().data() + blocks.at[b],
                                force + blocks.first[b]});
    }

    /** matrix += B^T Z B, residual -= B^T f. */
    class Addition
    {
    public:
      Addition(const solve::PointOperator &rows, const la::MatrixTarget &matrix,
               la::Vector &residual)
          : rows_(rows), matrix_(matrix), residual_(residual)
      {
      }

      void add(const CondensedPoint &point)
      {
        for (int r = 0; r < point.n_rows; ++r)
        {
          const int row = point.first + r;
          rows_.get_columns(row, lines_);
          for (std::size_t j = 0; j < lines_.size(); ++j)
            residual_(lines_[j]) -=
                point.force[r] * rows_.coefficient(rows_.begin(row) + j);
          for (int c = 0; c < point.n_rows; ++c)
            add_spring(row, point.first + c,
                       point.spring[r * point.n_rows + c]);
        }
      }

    private:
      /** The force on @p row that the gap of @p other makes. */
      void add_spring(const int row, const int other, const double stiffness)
      {
        if (stiffness == 0.)
          return;
        rows_.get_columns(other, columns_);
        values_.resize(columns_.size());
        for (std::size_t j = 0; j < lines_.size(); ++j)
        {
          const double b = rows_.coefficient(rows_.begin(row) + j);
          for (std::size_t k = 0; k < columns_.size(); ++k)
            values_[k] =
                stiffness * b * rows_.coefficient(rows_.begin(other) + k);
          matrix_.add(lines_[j], columns_, values_);
        }
      }

      const solve::PointOperator &rows_;
      const la::MatrixTarget &matrix_;
      la::Vector &residual_;
      std::vector<global_dof_index> lines_, columns_;
      std::vector<double> values_;
    };
  } // namespace

  template <int dim>
  void ContactAssembler<dim>::add_to_sparsity(
      dealii::DynamicSparsityPattern &pattern) const
  {
    const auto &i = *implementation;
    i.check_rows("add_to_sparsity()");
    const solve::PointOperator &rows = i.rows.coefficients;
    std::vector<global_dof_index> columns, all;
    for (int row = 0; row < rows.n_rows(); ++row)
    {
      if (!rows.is_tangent(row))
        all.clear();
      rows.get_columns(row, columns);
      all.insert(all.end(), columns.begin(), columns.end());
      // Friction couples the rows of a point.
      if (row + 1 < rows.n_rows() && rows.is_tangent(row + 1))
        continue;
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      for (const global_dof_index dof : all)
        pattern.add_entries(dof, all.begin(), all.end(), true);
    }
    for (const shim::MatrixLine &line :
         i.present_source().geometric_lines(nullptr))
      for (const global_dof_index column : line.column)
        pattern.add(line.row, column);
  }

  template <int dim>
  void ContactAssembler<dim>::add(const la::MatrixTarget &matrix,
                                  const la::MutableVectorView &given_residual)
  {
    auto &i = *implementation;
    i.check_rows("add()");
    i.host.check_places("add()");
    la::Vector &residual =
        i.host.mutable_vector("add()", "residual", given_residual);
    const solve::Stiffness stiffness =
        i.host.stiffness("add()", Tangent(matrix));
    AssertThrow(abut_law_has_penalty(i.input.method.options.law)
                    && !abut_law_needs_stress(i.input.method.options.law),
                ExcMessage(std::string("The law '")
                           + i.input.method.options.law->name
                           + "' cannot be added to a matrix row by row: use "
                             "ContactAssembler::solve()."));
    if (!i.is_started)
    {
      i.scales.find_compliance(stiffness);
      i.begin(stiffness, residual);
    }
    if (i.moving.has_geometry())
    {
      residual = i.moving.with_geometry(residual);
      for (const shim::MatrixLine &line :
           i.source->geometric_lines(i.start.pressure().data()))
        matrix.add(line.row, line.column, line.value);
    }
    const solve::PointOperator &rows = i.rows.coefficients;
    i.system.local.reinit(i.request, rows.n_rows(), rows.weights(),
                          i.communicator);
    Addition addition(rows, matrix, residual);
    for_each_point(i.system.local, rows.n_rows(),
                   [&](const CondensedPoint &point) { addition.add(point); });
    matrix.compress();
    residual.compress(dealii::VectorOperation::add);
    i.system.was_added = true;
  }

  template void
  ContactAssembler<2>::add_to_sparsity(dealii::DynamicSparsityPattern &) const;
  template void
  ContactAssembler<3>::add_to_sparsity(dealii::DynamicSparsityPattern &) const;
  template void ContactAssembler<2>::add(const la::MatrixTarget &,
                                         const la::MutableVectorView &);
  template void ContactAssembler<3>::add(const la::MatrixTarget &,
                                         const la::MutableVectorView &);
} // namespace abut
